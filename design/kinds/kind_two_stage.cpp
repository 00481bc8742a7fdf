// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kNewDesign = R"(
[gearbox]
kind = "two-stage"             # two simple stages in series: the carrier of the first drives the sun of the second
planets = 3                    # of stage 1; sun1 + ring1 teeth must be a multiple of it
module_mm = 0.8                # of stage 1
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.05             # per mesh; 3D prints rather want 0.1 to 0.2
layer_gap_mm = 1.0             # between the stages

[stage2]
planets = 4                    # sun2 + ring2 teeth must be a multiple of it
module_mm = 1.0                # it carries more torque

[sun1]
teeth = 18
shift = 0.0                    # profile shift in modules
face_width_mm = 8.0
bore_mm = 5.0                  # motor shaft ...
bore_d_flat_mm = 4.5           # ... with a flat; or bore_hex_mm, or a keyway

[planet1]
teeth = 36                     # (ring1 - sun1) / 2
shift = 0.0
face_width_mm = 8.0
bore_mm = 8.0

[ring1]
teeth = 90                     # stands
shift = 0.0                    # positive moves a ring's teeth outwards
face_width_mm = 8.0
outer_diameter_mm = 86.0

[sun2]                         # on the carrier of stage 1
teeth = 20
shift = 0.0
face_width_mm = 14.0

[planet2]
teeth = 26                     # (ring2 - sun2) / 2
shift = 0.0
face_width_mm = 14.0
bore_mm = 8.0

[ring2]
teeth = 72                     # stands
shift = 0.0
face_width_mm = 14.0
outer_diameter_mm = 86.0

[carrier]                      # of both stages; leave it out where you build carriers yourself
plate_thickness_mm = 4.0
)";

/// The ratio is the product (1 + ring1/sun1) (1 + ring2/sun2).
Topology topology(std::string_view, std::string_view) {
  enum { kSun1, kPlanet1, kCarrier1, kRing1, kPlanet2, kCarrier2, kRing2 };
  return {.kind = "two-stage",
          .axes = {{}, {.carrier = kCarrier1}, {.carrier = kCarrier2}},
          .members = {{"sun1"}, {"planet1", 1}, {"carrier1"}, {"ring1"}, {"planet2", 2}, {"carrier2"}, {"ring2"}},
          .gears = {{"sun1", kSun1},
                    {"planet1", kPlanet1},
                    {"ring1", kRing1, 1, GearForm::kRing},
                    {.name = "sun2", .member = kCarrier1, .layer = 2, .stage = 2},
                    {.name = "planet2", .member = kPlanet2, .layer = 2, .stage = 2},
                    {.name = "ring2", .member = kRing2, .layer = 2, .form = GearForm::kRing, .stage = 2}},
          .meshes = {{0, 1}, {1, 2}, {3, 4}, {4, 5}},
          .fixed = {kRing1, kRing2},
          .input = kSun1,
          .output = kCarrier2};
}

}  // namespace

TrainKind kind_two_stage() {
  return {.name = "two-stage",
          .meaning = "two simple stages in series, the carrier of the first with the sun of the second",
          .output_meaning = "carrier2 (ring1 and ring2 are fixed)",
          .outputs = {"carrier2"},
          .inputs = {"sun1"},
          .topology = &topology,
          .new_design = kNewDesign};
}

}  // namespace trueflank
