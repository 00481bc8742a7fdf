// Fit coupon: print this first. A few teeth of both gears of a mesh, each copy thinner by a step, and
// holes for the bore: see which copy turns freely and which hole fits, and set `extra_thinning_um` of
// the parts (or `backlash_mm` of the design) accordingly. Written by Trueflank; go on from here.

/* [From the design] */
tip_diameter1 = 13.7;
teeth1 = 12;
tip_diameter2 = 41.7;
root_diameter2 = 37.2;
teeth2 = 39;
// gear 2 is a ring
internal2 = false;
bore = 5;

/* [Coupon] */
height = 4;
// what every wall is moved inwards, mm
steps = [0, 0.03, 0.06, 0.09];
// teeth of a copy
shown = 5; // [1:1:15]
hole_steps = [0, 0.05, 0.1, 0.15, 0.2];
$fn = 64;

// GEARS
module gear1_section() circle(d = 13.7);
module gear2_section() circle(d = 41.7);
// END GEARS

function wedge(angle, reach) = concat([[0, 0]], [for (i = [0:8]) let (a = angle*(i/8 - 0.5)) reach*[cos(a), sin(a)]]);
depth = 3*abs(tip_diameter2 - root_diameter2)/2;
module strip(teeth, inner, outer) intersection() {
  children();
  polygon(wedge(min(150, 360*shown/teeth), 2*outer));
  difference() { circle(d = outer); if (inner > 0) circle(d = inner); }
}
// every wall moved inwards
module moved_in(by) if (by > 0) offset(delta = -by) children(); else children();
module strip1(thinner) strip(teeth1, max(0, tip_diameter1 - 2*depth), tip_diameter1 + 1)
  moved_in(thinner) gear1_section();
module strip2(thinner) strip(teeth2, internal2 ? tip_diameter2 - 1 : max(0, tip_diameter2 - 2*depth),
                             internal2 ? tip_diameter2 + 2*depth : tip_diameter2 + 1)
  moved_in(thinner) gear2_section();
// as many notches as the copy's number
module notches(n) for (i = [0:n - 1]) rotate(40*i) translate([bore/2 + 1.8, -0.5]) square([1.7, 1]);

width2 = depth + 6;
// all in one height: one extrusion
module coupon() linear_extrude(height) {
  for (k = [0:len(steps) - 1]) {
    translate([k*(depth + 6) - tip_diameter1/2, 0]) strip1(steps[k]);
    translate([k*width2 - tip_diameter2/2, tip_diameter1 + 10 + 0.3*tip_diameter2]) strip2(steps[k]);
  }
  if (bore > 0) for (k = [0:len(hole_steps) - 1])
    translate([k*(bore + 9), -tip_diameter1/2 - bore - 8]) difference() {
      union() { circle(d = bore + 5); notches(k + 1); }
      circle(d = bore + hole_steps[k]);
    }
}

coupon();
