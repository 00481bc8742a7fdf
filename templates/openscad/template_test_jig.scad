// Test jig: a plate with two posts, on which two gears of a mesh turn at their centre distance and a
// little more, to feel their backlash before the whole is built. Written by Trueflank; go on from
// here. Millimetres.

/* [From the design] */
centre_distance = 25.6826;
// bores of the two gears; without one the gear is printed with a post's hole by hand
bore1 = 5;
bore2 = 19;
tip_diameter1 = 13.7;
tip_diameter2 = 41.7;

/* [Jig] */
// further posts for gear 2, each this much farther out
steps = [0, 0.1, 0.2];
post_clearance = 0.1;
post_height = 10;
plate_thickness = 4;
margin = 3;
$fn = 64;

post1 = bore1 - post_clearance;
post2 = bore2 - post_clearance;
assert(bore1 > 0 && bore2 > 0, "both gears need a bore to turn on a post");
row = max(tip_diameter1, tip_diameter2) + margin;

module test_jig() {
  linear_extrude(plate_thickness) hull() for (i = [0:len(steps) - 1]) translate([0, i*row])
    for (x = [0, centre_distance + max(steps)]) translate([x, 0]) circle(d = max(post1, post2) + 2*margin);
  // one pair of posts for each step, side by side
  translate([0, 0, plate_thickness]) linear_extrude(post_height)
    for (i = [0:len(steps) - 1]) translate([0, i*row]) {
      circle(d = post1);
      translate([centre_distance + steps[i], 0]) circle(d = post2);
    }
}

test_jig();
