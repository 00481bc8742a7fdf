// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/html_document.h"

#include "trueflank/export/report_html.h"

namespace trueflank::app {

std::string html_document(const io::Report& report, const PartShapes* shapes) {
  return io::report_html(
      report, {.shapes = shapes, .strength = report.strength ? &*report.strength : nullptr});
}

}  // namespace trueflank::app
