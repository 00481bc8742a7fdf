// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/new_design.h"

#include "trueflank/design/design_name.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

constexpr const char* kRackText = R"(
[rack]                         # ISO 53 profile A; all but the angle in modules
pressure_angle_deg = 20.0
addendum = 1.0
dedendum = 1.25
root_radius = 0.38
)";

}  // namespace

std::string new_design_text(const TrainKind& kind, const std::string& name) {
  const std::string title = toml_string(design_name_from(name));
  return "# A Trueflank design. Lengths in mm, angles in degrees; every key: docs/design-file.md\n"
         "# Check it: trueflank check FILE      Make it: trueflank make FILE -o FOLDER\n\n"
         "format = 1\nname = " +
         title + "\n" + kind.new_design + kRackText;
}

}  // namespace trueflank
