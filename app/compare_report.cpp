// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/compare_report.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "trueflank/base/units.h"

namespace trueflank::app {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

const SurfaceDistance& worst_of(const MeshComparison& c) {
  return c.worst_is_on_golden() ? c.from_golden : c.from_new;
}

std::string coordinates_text(const std::array<double, 3>& p) {
  return "(" + number("%.4f", p[0]) + ", " + number("%.4f", p[1]) + ", " + number("%.4f", p[2]) +
         ") mm, radius " + number("%.4f", std::hypot(p[0], p[1])) + " mm, " +
         number("%.2f", deg_from_rad(wrapped_rad(std::atan2(p[1], p[0])))) + " deg";
}

std::string mesh_text(const char* name, const std::string& path, const MeshSummary& mesh) {
  return std::string(name) + path + "\n           " + std::to_string(mesh.triangles) + " triangles, " +
         std::to_string(mesh.components) + (mesh.components == 1 ? " body, " : " bodies, ") +
         (mesh.closed ? "closed" : "NOT closed") + ", volume " + number("%.6f", mesh.volume_mm3) +
         " mm3\n";
}

std::string distance_text(const char* name, const SurfaceDistance& distance) {
  return std::string(name) + number("%.4f", um_from_mm(distance.largest_mm)) + " um, rms " +
         number("%.4f", um_from_mm(distance.rms_mm)) + " um, " +
         number("%.3g", 100.0 * distance.share_beyond) + " % of it beyond\n";
}

/// "on the left flank of tooth 3", "at the face at z = 10 mm"
std::string where_text(const MeshDifference& d) {
  const bool at = !d.across_axis || d.place.starts_with("root");
  return (at ? "at the " : "on the ") + d.place;
}

std::string regions_text(const MeshDifference& d, double tolerance_um) {
  std::string text = "teeth      beyond " + number("%g", tolerance_um) +
                     " um     deviation in the section, + too much material\n";
  for (const RegionDifference& region : d.regions) {
    char line[120];
    // + 0.0: rounding is no deviation and has no sign
    std::snprintf(line, sizeof line, "           %-12s %4d of %-4d  %+10.2f to %+10.2f um\n",
                  (std::string(to_text(region.region)) + "s").c_str(), region.teeth_off, d.teeth->count,
                  std::round(1e5 * region.least_mm) * 1e-2 + 0.0,
                  std::round(1e5 * region.greatest_mm) * 1e-2 + 0.0);
    text += line;
  }
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
          {"share_beyond_tolerance", distance.share_beyond},
          {"worst_place_mm", distance.worst_place_mm}};
}

nlohmann::ordered_json difference_json(const MeshDifference& d) {
  nlohmann::ordered_json json = {{"place", d.place}, {"deviation_um", um_from_mm(d.worst_deviation_mm)}};
  if (d.teeth) json["teeth"] = d.teeth->count;
  for (const RegionDifference& region : d.regions)
    json["regions"].push_back({{"region", to_text(region.region)},
                               {"teeth_beyond", region.teeth_off},
                               {"least_um", um_from_mm(region.least_mm)},
                               {"greatest_um", um_from_mm(region.greatest_mm)}});
  return json;
}

}  // namespace

std::string CompareReport::part() const { return std::filesystem::path(options.fresh).stem().string(); }

std::string headline(const CompareReport& report) {
  const std::string size = number("%.2f", um_from_mm(report.comparison.largest_mm())) + " um";
  if (!report.difference) return report.part() + ": " + size + " apart at most";
  const MeshDifference& d = *report.difference;
  return report.part() + ": " + size + (d.worst_deviation_mm > 0.0 ? " too much" : " too little") +
         " material " + where_text(d);
}

std::string comparison_text(const CompareReport& report) {
  const CompareOptions& options = report.options;
  const MeshComparison& c = report.comparison;
  std::string text = "part       " + report.part() + "\n" + mesh_text("golden     ", options.golden, c.golden) +
                     mesh_text("new        ", options.fresh, c.made);
  text += "volume     new less golden " +
          number("%+.6f", c.made.volume_mm3 - c.golden.volume_mm3) + " mm3\n";
  text += distance_text("distance   golden to new at most ", c.from_golden);
  text += distance_text("           new to golden at most ", c.from_new);
  text += "worst      on the " + std::string(c.worst_is_on_golden() ? "golden" : "new") +
          " mesh" + (report.difference ? ", " + report.difference->place : "") + "\n           " +
          coordinates_text(worst_of(c).worst_place_mm) + "\n";
  if (report.difference && !report.difference->regions.empty())
    text += regions_text(*report.difference, options.tolerance_um);
  if (!options.picture.empty()) text += "picture    " + options.picture + "\n";
  text += "\n" + std::string(c.same ? "same" : "DIFFERENT") + " within " +
          number("%g", options.tolerance_um) + " um\n";
  if (!c.same) text += headline(report) + "\n";
  return text;
}

std::string comparison_json(const CompareReport& report) {
  const MeshComparison& c = report.comparison;
  nlohmann::ordered_json json;
  json["format"] = "trueflank-compare";
  json["version"] = 1;
  json["part"] = report.part();
  json["tolerance_um"] = report.options.tolerance_um;
  json["golden"] = mesh_json(report.options.golden, c.golden);
  json["new"] = mesh_json(report.options.fresh, c.made);
  json["golden_to_new"] = distance_json(c.from_golden);
  json["new_to_golden"] = distance_json(c.from_new);
  json["max_um"] = um_from_mm(c.largest_mm());
  json["worst_place_mm"] = worst_of(c).worst_place_mm;
  json["difference"] = report.difference ? difference_json(*report.difference) : nullptr;
  json["same"] = c.same;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace trueflank::app
