// Motor adapter: a plate between a stepper motor and the housing's floor. Written by Trueflank; go on
// from here. Millimetres.

/* [From the design] */
housing_diameter = 106.5;
// bore of the sun, for the motor's shaft
shaft_diameter = 5;

/* [Motor] */
motor = "nema17"; // [nema14, nema17, nema23, own]
// for "own": side of the square of its screws, screw, pilot diameter
own_square = 31;
own_screw = 3.4;
own_pilot = 22.4;

/* [Plate] */
thickness = 5;
// screws into the housing: its wall's middle circle
housing_screws = 6; // [0:1:24]
housing_screw = 3.2;
$fn = 120;

// square of screw holes, screw, pilot (with 0.4 mm of clearance)
size = motor == "nema14" ? [26, 3.4, 22.4] : motor == "nema17" ? [31, 3.4, 22.4]
  : motor == "nema23" ? [47.14, 5.5, 38.5] : [own_square, own_screw, own_pilot];
screw_circle = housing_diameter + 2*housing_screw;
assert(size[2] > shaft_diameter, "the shaft does not pass the pilot");
assert(size[0]*sqrt(2) + size[1] < screw_circle - housing_screw - 1, "the motor is too large for this housing");

module motor_adapter() linear_extrude(thickness) difference() {
  circle(d = screw_circle + 2*housing_screw);
  circle(d = size[2]);
  for (x = [-1, 1], y = [-1, 1]) translate([x, y]*size[0]/2) circle(d = size[1], $fn = 32);
  if (housing_screws > 0) for (i = [1:housing_screws]) rotate(360/housing_screws*i)
    translate([screw_circle/2, 0]) circle(d = housing_screw, $fn = 32);
}

motor_adapter();
