// Output flange: a disc on the moving ring. Written by Trueflank; go on from here. Millimetres; its
// lower face lies on the ring's upper face.

/* [From the design] */
ring_diameter = 92.5;
ring_root_diameter = 87.5;
ring_height = 14;
// what turns inside the ring above its upper face (a carrier's plate); 0: nothing
inner_height = 0;
inner_diameter = 0;

/* [Flange] */
thickness = 5;
// the ring and its flange in one piece
ring_in_one_piece = false;
clearance = 0.5;
bearing_diameter = 19;
output_screws = 6; // [0:1:24]
output_circle = 40;
output_screw = 3.2;
// through the flange into the ring's rim
ring_screws = 6; // [0:1:24]
ring_screw = 2.2;
$fn = 180;

// GEARS
module moving_ring_section() difference() { circle(d = 92.5); circle(d = 83); }
// END GEARS

spacer = max(0, inner_height) + (inner_height > 0 ? clearance : 0);
assert(output_circle - output_screw > bearing_diameter, "the output's screws run into the bearing");
assert(ring_diameter > ring_root_diameter, "the ring needs a rim");

module flange_section(middle) difference() {
  circle(d = ring_diameter);
  circle(d = middle);
  if (ring_screws > 0 && !ring_in_one_piece) for (i = [1:ring_screws]) rotate(360/ring_screws*i)
    translate([(ring_diameter + ring_root_diameter)/4, 0]) circle(d = min(ring_screw, (ring_diameter - ring_root_diameter)/2 - 0.4), $fn = 24);
}
module output_flange() {
  if (ring_in_one_piece) translate([0, 0, -ring_height]) linear_extrude(ring_height) moving_ring_section();
  if (spacer > 0) linear_extrude(spacer) flange_section(max(ring_root_diameter, inner_diameter + 2*clearance));
  translate([0, 0, spacer]) linear_extrude(thickness) difference() {
    flange_section(bearing_diameter);
    if (output_screws > 0) for (i = [1:output_screws]) rotate(360/output_screws*i)
      translate([output_circle/2, 0]) circle(d = output_screw, $fn = 32);
  }
}

output_flange();
