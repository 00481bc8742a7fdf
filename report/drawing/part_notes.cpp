// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/part_notes.h"

#include <cmath>

#include "trueflank/report/drawing/drawn_part.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank::io {
namespace {

std::string index_mark_note(const PartShape& part) {
  const Slab& top = part.slabs.back();
  return "Index mark: " + std::to_string(part.marks.size()) + " x Ø" +
         drawing_number(2.0 * part.marks.front().radius_mm, 2) + ", about " +
         drawing_number(top.z_upper_mm - top.z_lower_mm, 2) +
         " deep, in the right face towards tooth 1 (x); place and size free.";
}

std::string bore_note(const PartDiameter& d) {
  const std::string shape = d.bore ? bore_shape_text(*d.bore) : std::string();
  return shape.empty() ? shape
                       : "Bore Ø" + drawing_number(d.diameter_mm, 3) + ": " + shape +
                             ", towards tooth 1 (x).";
}

/// What the process says where no standard does.
std::string process_note(const Workmanship& made) {
  switch (made.making) {
    case Making::kPrinted:
      return "Printed by " + made.process +
             ", layers across the axis: tolerances are what the process holds, and what the check "
             "of tolerances assumes.";
    case Making::kCut:
      return "Cut by " + made.process + ": tolerances of teeth are what the process holds.";
    case Making::kFormed:
      return "Made by " + made.process +
             ": general tolerances and surfaces as agreed with the maker.";
    case Making::kMachined:
      break;
  }
  return {};
}

}  // namespace

std::vector<std::string> part_notes(const DrawingModel& model, const PartShape& part,
                                    const PartDimensions& dimensions, const Workmanship& made) {
  const std::vector<const TrainGear*> gears = gears_of(*model.train, part);
  std::vector<std::string> all;
  const auto add = [&](const std::string& text) {
    if (!text.empty()) all.push_back(text);
  };
  add("Dimensions in mm.");
  if (!dimensions.holes.empty())
    add("Holes: left and right as in A-A, depths from the face where they open; hidden ones in "
        "dashes.");
  for (const PartDiameter& d : dimensions.diameters) add(bore_note(d));
  if (!gears.empty()) add("Teeth drawn by ISO 2203; true profile: " + part.name + ".step.");
  for (const TrainGear* gear : gears) add(modification_text(*model.train, gear->name));
  add(process_note(made));
  if (!part.marks.empty()) add(index_mark_note(part));
  if (const auto layout = machine_layout(*model.train);
      layout && part.bought.empty() && part.member == model.train->topology().input &&
      !gears.empty())
    add(set_screw_operation(*layout));
  if (made.making == Making::kMachined || made.making == Making::kCut)
    add("Edges broken 0.1 to 0.3.");
  return all;
}

}  // namespace trueflank::io
