// Housing: a cup that holds the fixed ring and clears the moving one. Written by Trueflank; go on from
// here. Millimetres; the gearbox stands in it as in its assembly, the fixed ring at its own height.

/* [From the design] */
fixed_ring_diameter = 98.5;
fixed_ring_bottom = 0;
fixed_ring_top = 12;
moving_ring_diameter = 92.5;
moving_ring_bottom = 13;
moving_ring_top = 27;
// lowest face of anything that turns below the rings
lowest = -8.3;
shaft_opening = 14.3;

/* [Housing] */
wall = 4;
floor_thickness = 5;
// around everything that turns
clearance = 0.5;
// the ring is pressed in: diametral, positive is loose
ring_fit = 0.05;
// cut the fixed ring's teeth into the housing itself
ring_in_one_piece = false;
screws = 6; // [0:1:24]
screw_hole = 3.2;
$fn = 120;

// GEARS
module fixed_ring_section() difference() { circle(d = 98.5); circle(d = 89); }
// END GEARS

moving = moving_ring_top > moving_ring_bottom;
outer = max(fixed_ring_diameter, moving ? moving_ring_diameter + 2*clearance : 0) + 2*wall;
floor_top = min(lowest, fixed_ring_bottom) - clearance;
top = moving ? max(fixed_ring_top, moving_ring_top) : fixed_ring_top;
flange = outer + (screws > 0 ? 4*screw_hole : 0);
assert(wall > 0 && floor_thickness > 0, "wall and floor need a thickness");

module housing_floor() translate([0, 0, floor_top - floor_thickness]) linear_extrude(floor_thickness)
  difference() {
    circle(d = flange);
    circle(d = shaft_opening);
    if (screws > 0) for (i = [1:screws]) rotate(360/screws*i)
      translate([(outer + flange)/4, 0]) circle(d = screw_hole, $fn = 32);
  }

// the wall in one turn of its section: a shoulder under the ring, its seat, the room above it
module housing_wall() {
  seat = fixed_ring_diameter + (ring_in_one_piece ? -0.2 : ring_fit);
  above = max(seat, moving ? moving_ring_diameter + 2*clearance : 0);
  shoulder = fixed_ring_diameter - 2;
  foot = floor_top - floor_thickness/2;  // inside the floor, so that both are one body
  rotate_extrude() polygon(concat(
    [[outer/2, foot], [outer/2, top]],
    top > fixed_ring_top ? [[above/2, top], [above/2, fixed_ring_top]] : [[seat/2, top]],
    top > fixed_ring_top && above != seat ? [[seat/2, fixed_ring_top]] : [],
    [[seat/2, fixed_ring_bottom], [shoulder/2, fixed_ring_bottom], [shoulder/2, foot]]));
}

module housing() {
  housing_floor();
  housing_wall();
  if (ring_in_one_piece) translate([0, 0, fixed_ring_bottom])
    linear_extrude(fixed_ring_top - fixed_ring_bottom) fixed_ring_section();
}

housing();
