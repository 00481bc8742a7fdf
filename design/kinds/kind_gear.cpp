// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kNewDesign = R"(
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

Topology topology(std::string_view, std::string_view) {
  return {.kind = "gear", .members = {{"gear"}}, .gears = {{"gear", 0, 1, GearForm::kEither}}, .input = 0};
}

}  // namespace

TrainKind kind_gear() {
  return {.name = "gear",
          .meaning = "one gear alone",
          .output_meaning = "none",
          .topology = &topology,
          .new_design = kNewDesign};
}

}  // namespace trueflank
