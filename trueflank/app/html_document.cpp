// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/html_document.h"

#include "trueflank/export/report_html.h"
#include "trueflank/train/strength.h"

namespace trueflank::app {

std::string html_document(const io::Report& report, const PartShapes* shapes) {
  const bool has_meshes = !report.train->meshes.empty();
  const auto torques = strength(*report.train);
  return io::report_html(
      report, {.shapes = shapes, .strength = torques && has_meshes ? &*torques : nullptr});
}

}  // namespace trueflank::app
