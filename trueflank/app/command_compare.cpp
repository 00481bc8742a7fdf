// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/base/units.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/solid/mesh_compare.h"

namespace trueflank::app {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string place_text(const std::array<double, 3>& p) {
  const double radius = std::hypot(p[0], p[1]);
  const double angle = wrapped_rad(std::atan2(p[1], p[0]));
  return "(" + number("%.4f", p[0]) + ", " + number("%.4f", p[1]) + ", " + number("%.4f", p[2]) +
         ") mm, at radius " + number("%.4f", radius) + " mm and " +
         number("%.2f", deg_from_rad(angle)) + " deg";
}

std::string mesh_line(const char* name, const MeshSummary& mesh) {
  return std::string(name) + std::to_string(mesh.triangles) + " triangles, " +
         std::to_string(mesh.components) + (mesh.components == 1 ? " body, " : " bodies, ") +
         (mesh.closed ? "closed" : "NOT closed") + ", volume " + number("%.6f", mesh.volume_mm3) +
         " mm3\n";
}

std::string distance_line(const char* name, const SurfaceDistance& distance) {
  return std::string(name) + number("%.4f", um_from_mm(distance.largest_mm)) + " um, rms " +
         number("%.4f", um_from_mm(distance.rms_mm)) + " um\n";
}

std::string comparison_text(const CompareOptions& options, const MeshComparison& c) {
  const SurfaceDistance& worst = c.worst_is_on_golden() ? c.from_golden : c.from_new;
  std::string text = "golden " + options.golden + "\nnew    " + options.fresh + "\n\n";
  text += mesh_line("golden: ", c.golden) + mesh_line("new:    ", c.made);
  text += "volume of new less golden: " + number("%.6f", c.made.volume_mm3 - c.golden.volume_mm3) +
          " mm3\n\n";
  text += distance_line("golden surface to new, at most: ", c.from_golden);
  text += distance_line("new surface to golden, at most: ", c.from_new);
  text += "worst: on the " + std::string(c.worst_is_on_golden() ? "golden" : "new") + " mesh\n       " +
          place_text(worst.worst_place_mm) + "\n\n";
  text += std::string(c.same ? "same" : "DIFFERENT") + " within " +
          number("%g", options.tolerance_um) + " um\n";
  return text;
}

nlohmann::ordered_json mesh_json(const std::string& path, const MeshSummary& mesh) {
  return {{"path", path},
          {"triangles", mesh.triangles},
          {"bodies", mesh.components},
          {"closed", mesh.closed},
          {"volume_mm3", mesh.volume_mm3},
          {"lower_mm", mesh.lower_mm},
          {"upper_mm", mesh.upper_mm}};
}

nlohmann::ordered_json distance_json(const SurfaceDistance& distance) {
  return {{"max_um", um_from_mm(distance.largest_mm)},
          {"bound_um", um_from_mm(distance.bound_mm)},
          {"rms_um", um_from_mm(distance.rms_mm)},
          {"worst_place_mm", distance.worst_place_mm}};
}

std::string comparison_json(const CompareOptions& options, const MeshComparison& c) {
  nlohmann::ordered_json json;
  json["format"] = "trueflank-compare";
  json["version"] = 1;
  json["tolerance_um"] = options.tolerance_um;
  json["golden"] = mesh_json(options.golden, c.golden);
  json["new"] = mesh_json(options.fresh, c.made);
  json["golden_to_new"] = distance_json(c.from_golden);
  json["new_to_golden"] = distance_json(c.from_new);
  json["max_um"] = um_from_mm(c.largest_mm());
  json["same"] = c.same;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
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
  const MeshComparison comparison =
      compare_meshes(*golden, *fresh, {.tolerance_mm = mm_from_um(options.tolerance_um)});
  if (!options.json.empty())
    if (auto ok = write_document(options.json, comparison_json(options, comparison)); !ok)
      return report_errors({ok.error()});
  if (!options.quiet && options.json != "-")
    if (auto ok = print(comparison_text(options, comparison)); !ok)
      return report_errors({ok.error()});
  return comparison.same ? 0 : 1;
}

}  // namespace trueflank::app
