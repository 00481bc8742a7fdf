// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/html_document.h"

#include "trueflank/export/report_html.h"
#include "trueflank/export/report_model.h"

namespace trueflank::app {

std::string html_drawing(const io::Report& report, const PartShapes* shapes) {
  return io::report_model_json(
      report, {.shapes = shapes, .strength = report.strength ? &*report.strength : nullptr});
}

std::string html_document(const io::Report& report, const PartShapes* shapes) {
  return io::report_html(report, io::report_json(report), html_drawing(report, shapes));
}

}  // namespace trueflank::app
