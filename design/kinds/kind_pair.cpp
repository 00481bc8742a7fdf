// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kNewDesign = R"(
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

Topology topology(std::string_view, std::string_view) {
  return {.kind = "pair",
          .axes = {{}, {}},
          .members = {{"pinion"}, {"wheel", 1}},
          .gears = {{"pinion", 0}, {"wheel", 1, 1, GearForm::kEither}},
          .meshes = {{0, 1}},
          .input = 0,
          .output = 1};
}

}  // namespace

TrainKind kind_pair() {
  return {.name = "pair",
          .meaning = "two gears",
          .output_meaning = "wheel",
          .outputs = {"wheel"},
          .inputs = {"pinion"},
          .topology = &topology,
          .new_design = kNewDesign};
}

}  // namespace trueflank
