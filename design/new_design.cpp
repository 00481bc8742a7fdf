// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/new_design.h"

#include "trueflank/design/design_name.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

constexpr const char* k3kText = R"(
[gearbox]
kind = "3k"                    # sun, planets of two layers, two rings: high ratios in one stage
output = "ring2"               # ring1 is fixed; "ring1" would fix ring2
planets = 3
module_mm = 1.0
centre_distance_mm = 27.41     # shifts that are left out are solved from it
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.05             # per mesh; 3D prints rather want 0.1 to 0.2
layer_gap_mm = 1.0             # between the two layers

[sun]
teeth = 15
face_width_mm = 12.0
bore_mm = 5.0                  # motor shaft ...
bore_d_flat_mm = 4.5           # ... with a flat; or bore_hex_mm, or a keyway

[planet1]                      # one body with planet2
teeth = 39
face_width_mm = 12.0
bore_mm = 10.0                 # through the whole planet

[ring1]
teeth = 93
shift = 0.67                   # profile shift in modules; positive moves a ring's teeth outwards
face_width_mm = 12.0
outer_diameter_mm = 114.0
# bolt_circle_diameter_mm = 105.5
# bolt_count = 8
# bolt_hole_diameter_mm = 4.5

[planet2]
teeth = 32
face_width_mm = 12.0

[ring2]
teeth = 86
shift = 0.65
face_width_mm = 12.0
outer_diameter_mm = 108.0
)";

constexpr const char* kSimpleText = R"(
[gearbox]
kind = "simple"                # sun, planets, ring
output = "carrier"             # the ring is fixed; "ring" would fix the carrier
planets = 3                    # sun + ring teeth must be a multiple of it
module_mm = 1.0
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.06             # per mesh; 3D prints rather want 0.1 to 0.2

[sun]
teeth = 18
shift = 0.0                    # profile shift in modules
face_width_mm = 10.0
bore_mm = 6.0                  # or bore_hex_mm; with bore_d_flat_mm a D, with a keyway ...
bore_d_flat_mm = 5.5

[planet]
teeth = 27                     # (ring - sun) / 2
shift = 0.0
face_width_mm = 10.0
bore_mm = 10.0

[ring]
teeth = 72
shift = 0.0                    # positive moves a ring's teeth outwards
tip_diameter_mm = 70.4         # 0.4 more than usual: the tips keep clear of the planets' fillets
face_width_mm = 10.0
outer_diameter_mm = 90.0
# bolt_circle_diameter_mm = 82.0
# bolt_count = 6
# bolt_hole_diameter_mm = 4.5
)";

constexpr const char* kPairText = R"(
[gearbox]
kind = "pair"                  # two gears
module_mm = 2.0
centre_distance_mm = 60.0      # a shift that is left out is solved from it
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.1              # circumferential; 3D prints rather want 0.1 to 0.2

[pinion]
teeth = 17
shift = 0.3                    # profile shift in modules; avoids undercut of few teeth
face_width_mm = 18.0
bore_mm = 12.0
bore_keyway_width_mm = 4.0     # or bore_d_flat_mm for a D, or bore_hex_mm instead of bore_mm
bore_keyway_depth_mm = 1.8

[wheel]
# internal = true              # would make the wheel a ring
teeth = 43
face_width_mm = 16.0
bore_mm = 20.0
)";

constexpr const char* kGearText = R"(
[gearbox]
kind = "gear"                  # one gear alone
module_mm = 1.0

[gear]
# internal = true              # would make it a ring
teeth = 24
shift = 0.0                    # profile shift in modules
face_width_mm = 8.0
bore_mm = 5.0                  # or bore_hex_mm; with bore_d_flat_mm a D, with a keyway ...
)";

constexpr const char* kRackText = R"(
[rack]                         # ISO 53 profile A; all but the angle in modules
pressure_angle_deg = 20.0
addendum = 1.0
dedendum = 1.25
root_radius = 0.38
)";

const char* body(TrainKind kind) {
  switch (kind) {
    case TrainKind::k3k: return k3kText;
    case TrainKind::kSimple: return kSimpleText;
    case TrainKind::kPair: return kPairText;
    case TrainKind::kGear: break;
  }
  return kGearText;
}

}  // namespace

std::string new_design_text(TrainKind kind, const std::string& name) {
  const std::string title = toml_string(design_name_from(name));
  return "# A Trueflank design. Lengths in mm, angles in degrees; every key: docs/design-file.md\n"
         "# Check it: trueflank check FILE      Make it: trueflank make FILE -o FOLDER\n\n"
         "format = 1\nname = " +
         title + "\n" + body(kind) + kRackText;
}

}  // namespace trueflank
