// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/machine/check_overhang.h"

#include <algorithm>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/overhang.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

/// One of the ways in which a part hangs, and what the process prints of it.
struct Judged {
  double value = 0.0, limit = 0.0;
  const char* unit = "mm";
  std::string message, cure;
  [[nodiscard]] double share() const { return value / limit; }
};

Judged ledge(const Overhang& hangs, const Process& process) {
  return {.value = hangs.ledge_mm,
          .limit = process.ledge_mm,
          .message = "an underside stands out by " + mm_text(hangs.ledge_mm) + ", " +
                     mm_text(hangs.ledge_height_mm) + " above the bed",
          .cure = "supports in the slicer under it, to be cut away"};
}

Judged bridge(const Overhang& hangs, const Process& process) {
  return {.value = hangs.bridge_mm,
          .limit = process.bridge_mm,
          .message = "an underside bridges " + mm_text(hangs.bridge_mm) + ", " +
                     mm_text(hangs.bridge_height_mm) + " above the bed",
          .cure = "supports in the slicer in the hole under it"};
}

Judged lean(const Overhang& hangs, const Process& process) {
  return {.value = deg_from_rad(hangs.lean_rad),
          .limit = deg_from_rad(process.overhang_rad),
          .unit = "deg",
          .message = "the flanks lean by " + number_text(deg_from_rad(hangs.lean_rad), 1) + " deg",
          .cure = "a smaller helix_angle_deg"};
}

/// Of those that have a limit, of which there is one at least.
Judged worst_of(std::vector<Judged> ways) {
  std::erase_if(ways, [](const Judged& way) { return !(way.limit > 0.0); });
  return *std::max_element(ways.begin(), ways.end(),
                           [](const Judged& a, const Judged& b) { return a.share() < b.share(); });
}

/// A planet whose upper teeth stand out over the neck.
bool is_stacked(const GearTrain& train, const PartShape& part) {
  return part.member != kNoMember && train.topology().is_planet(part.member) &&
         train.topology().gears_of(part.member).size() > 1;
}

/// Teeth and the foot of a set screw stand out over the hub between them.
bool has_set_screw(const GearTrain& train, const PartShape& part) {
  if (part.member != train.topology().input) return false;
  const auto layout = machine_layout(train);
  return layout && layout->set_screw.is_there();
}

Finding judge_part(const GearTrain& train, const PartShape& part, const Process& process) {
  const Overhang hangs = overhang(part, part.upside_down, process);
  Judged worst = worst_of({ledge(hangs, process), bridge(hangs, process), lean(hangs, process)});
  // one that is not needed is not told
  if (is_stacked(train, part) && worst.value == hangs.ledge_mm)
    worst.cure =
        "teeth of planet1 and planet2 so far apart in number that one lies inside the other's "
        "roots, "
        "and straight; or " +
        worst.cure;
  if (has_set_screw(train, part))
    worst.cure =
        "set_screw = \"never\" in [fasteners], with a flat filed on the shaft (flat_mm and "
        "flat_length_mm in [motor]); or " +
        worst.cure;
  Finding finding =
      judged({.id = "overhang",
              .where = part.name,
              .value = worst.limit,
              .limit = worst.value,
              .unit = worst.unit,
              .message = part.name + ": as it lies on the bed" +
                         (part.upside_down ? ", turned over, " : " ") + worst.message + "; " +
                         process.name + " prints " + number_text(worst.limit, 1) + " " +
                         worst.unit + " without support",
              .cure = worst.cure},
             0.0);
  std::swap(finding.value, finding.limit);
  return finding;
}

}  // namespace

Findings check_overhangs(const GearTrain& train, const PartShapes& shapes) {
  const auto& process = train.design.made.process;
  if (!process ||
      !(process->ledge_mm > 0.0 || process->bridge_mm > 0.0 || process->overhang_rad > 0.0))
    return {};
  Findings findings;
  for (const PartShape& part : shapes.parts)
    if (part.bought.empty()) findings.push_back(judge_part(train, part, *process));
  return findings;
}

}  // namespace trueflank
