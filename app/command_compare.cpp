// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>

#include "trueflank/app/commands.h"
#include "trueflank/app/compare_picture.h"
#include "trueflank/app/compare_report.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/base/units.h"
#include "trueflank/export/mesh_reader.h"

namespace trueflank::app {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string picture_of(const CompareReport& report) {
  const MeshComparison& c = report.comparison;
  const std::string subtitle =
      "golden " + report.options.golden + ", new " + report.options.fresh + ": " +
      (c.same ? "same" : "different") + " within " + number("%g", report.options.tolerance_um) +
      " µm; volume " + number("%+.4f", c.made.volume_mm3 - c.golden.volume_mm3) + " mm³";
  std::string title = headline(report);
  if (const auto unit = title.find(" um "); unit != std::string::npos) title.replace(unit, 4, " µm ");
  return compare_picture_svg(*report.difference,
                             {.title = title,
                              .subtitle = subtitle,
                              .tolerance_mm = mm_from_um(report.options.tolerance_um)});
}

}  // namespace

int run_compare(const CompareOptions& options) {
  if (!(options.tolerance_um > 0.0 && std::isfinite(options.tolerance_um)))
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "no tolerance",
                           .key = "--tolerance-um",
                           .value = number("%g", options.tolerance_um),
                           .remedy = "a number above 0"}});
  const auto golden = io::read_mesh(options.golden);
  const auto fresh = io::read_mesh(options.fresh);
  Errors errors;
  if (!golden) errors.push_back(golden.error());
  if (!fresh) errors.push_back(fresh.error());
  if (!errors.empty()) return report_errors(errors);
  const trueflank::CompareOptions within{.tolerance_mm = mm_from_um(options.tolerance_um)};
  CompareReport report{.options = options,
                       .comparison = compare_meshes(*golden, *fresh, within),
                       .difference = {}};
  const bool comparable = std::isfinite(report.comparison.largest_mm());
  if (comparable && (!report.comparison.same || !options.picture.empty()))
    report.difference = mesh_difference(*golden, *fresh, report.comparison, within);
  if (!options.json.empty())
    if (auto ok = write_document(options.json, comparison_json(report)); !ok)
      return report_errors({ok.error()});
  if (!options.picture.empty() && report.difference)
    if (auto ok = write_document(options.picture, picture_of(report)); !ok)
      return report_errors({ok.error()});
  const bool output_taken = options.json == "-" || options.picture == "-";
  if (!options.quiet && !output_taken)
    if (auto ok = print(comparison_text(report)); !ok) return report_errors({ok.error()});
  return report.comparison.same ? 0 : 1;
}

}  // namespace trueflank::app
