// Carrier: two plates with holes for the planets' pins and seats for bearings. Written by Trueflank; go
// on from here. Millimetres; the lower plate's lower face at z = 0, pin 1 on +x.

/* [From the design] */
centre_distance = 25.6826;
// where the pins stand, degrees
pin_angles = [0, 120, 240];
pin_diameter = 10;
// from planet face to planet face
planet_height = 27;
opening = 20.5;
plate_thickness = 8;
bearing_diameter = 32; // 0: no seat
bearing_width = 7;
plate_diameter = 76;

/* [Fit] */
// pin in plate, diametral
pin_fit = 0.02;
// bearing in its seat, diametral
bearing_fit = 0.02;
// between planets and plates
axial_clearance = 0.3;

/* [Output] */
part = "lower"; // [all, lower, upper, pin]
$fn = 64;

assert(plate_diameter > 2*centre_distance + pin_diameter, "the plate must reach around its pins");
assert(opening < 2*centre_distance - pin_diameter, "the opening runs into the pins");
assert(bearing_diameter == 0 || bearing_width < plate_thickness, "the seat goes through the plate");
seat = bearing_diameter > 0 ? bearing_width : 0;

module plate_section(middle) difference() {
  circle(d = plate_diameter);
  circle(d = middle);
  for (a = pin_angles) rotate(a) translate([centre_distance, 0]) circle(d = pin_diameter + pin_fit);
}
// the seat below
module plate() {
  if (seat > 0) linear_extrude(seat) plate_section(bearing_diameter + bearing_fit);
  translate([0, 0, seat]) linear_extrude(plate_thickness - seat) plate_section(opening);
}
module upper_plate() translate([0, 0, plate_thickness]) mirror([0, 0, 1]) plate();
length = 2*plate_thickness + 2*axial_clearance + planet_height;
module pin() cylinder(d = pin_diameter, h = length);

if (part == "all") {
  plate();
  translate([0, 0, length - plate_thickness]) upper_plate();
  for (a = pin_angles) rotate(a) translate([centre_distance, 0, 0]) pin();
} else if (part == "lower") plate();
else if (part == "upper") upper_plate();
else pin();
