// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "trueflank/report/report.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/strength.h"

namespace trueflank::io {

/// What the page shows beside the report.
struct HtmlModel {
  const PartShapes* shapes = nullptr;        ///< not owned; none: the bare toothings are drawn
  const StrengthResult* strength = nullptr;  ///< not owned; none: no allowable torques
  double solid_chord_error_mm = 0.01;        ///< of the picture in 3D
  double mesh_chord_error_mm = 0.001;        ///< of the drawings of the meshes
};

/// report.html: one page that needs nothing else, no network either. It holds report_json(report)
/// whole (script element "report-data", '<' written as \u003c) and shows its numbers, the gearbox in
/// 3D, and every mesh turning. Same input, same bytes.
/// Not guaranteed: the picture in 3D, which needs WebGL in the browser and three.js at build time
/// (report_html_has_3d); without it the page says so and is whole otherwise.
[[nodiscard]] std::string report_html(const Report& report, const HtmlModel& model = {});

/// The same, of report_json(report) and report_model_json(report, model) that are there already.
[[nodiscard]] std::string report_html(const Report& report, std::string_view report_json_text,
                                      std::string_view model_json_text);

/// Whether three.js was there when this library was built (scripts/install-dependencies).
[[nodiscard]] bool report_html_has_3d();

}  // namespace trueflank::io
