// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kNewDesign = R"(
[gearbox]
kind = "stepped"               # sun, planets of two steps, one ring: more ratio than one step gives
output = "carrier"             # the ring is fixed; "ring" would fix the carrier
planets = 3
module_mm = 1.0
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.06             # per mesh; 3D prints rather want 0.1 to 0.2
layer_gap_mm = 1.0             # between the two steps

[sun]
teeth = 18
shift = 0.0                    # profile shift in modules
face_width_mm = 10.0
bore_mm = 6.0                  # or bore_hex_mm; with bore_d_flat_mm a D, with a keyway ...
bore_d_flat_mm = 5.5

[planet1]                      # meshes with the sun; one body with planet2
teeth = 36
shift = 0.0
face_width_mm = 10.0
bore_mm = 8.0                  # through the whole planet

[planet2]                      # meshes with the ring
teeth = 18
shift = 0.0
face_width_mm = 10.0

[ring]
teeth = 72                     # sun + planet1 + planet2 of one module: no shifts are needed
shift = 0.0                    # positive moves a ring's teeth outwards
face_width_mm = 10.0
outer_diameter_mm = 90.0
# bolt_circle_diameter_mm = 82.0
# bolt_count = 6
# bolt_hole_diameter_mm = 4.5
)";

Topology topology(std::string_view output, std::string_view) {
  enum { kSun, kPlanet, kCarrier, kRing };
  const bool ring_out = output == "ring";
  return {.kind = "stepped",
          .axes = {{}, {.carrier = kCarrier}},
          .members = {{"sun"}, {"planet", 1}, {"carrier"}, {"ring"}},
          .gears = {{"sun", kSun},
                    {"planet1", kPlanet},
                    {"planet2", kPlanet, 2},
                    {"ring", kRing, 2, GearForm::kRing}},
          .meshes = {{0, 1}, {2, 3}},
          .fixed = {ring_out ? kCarrier : kRing},
          .input = kSun,
          .output = ring_out ? kRing : kCarrier};
}

}  // namespace

TrainKind kind_stepped() {
  return {.name = "stepped",
          .meaning = "sun, compound planets and one ring",
          .output_meaning = "carrier (the ring is fixed) or ring (the carrier is fixed)",
          .outputs = {"carrier", "ring"},
          .inputs = {"sun"},
          .topology = &topology,
          .new_design = kNewDesign};
}

}  // namespace trueflank
