// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/part_sizes_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/gear_dimensions.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

void add_limits(Json& json, const SizeLimits& limits) {
  json["lower_mm"] = limits.lower_mm;
  json["upper_mm"] = limits.upper_mm;
  json["fit"] = text_or_null(limits.fit);
}

Json diameter_json(const PartDiameter& d) {
  Json json = Json::object();
  json["diameter_mm"] = d.diameter_mm;
  json["made_mm"] = d.made_mm;
  json["hole"] = d.hole;
  json["tips"] = d.tip;
  json["seat"] = d.seat;
  json["datum"] = d.datum ? Json("A") : Json(nullptr);
  add_limits(json, d.limits);
  json["shape"] = d.bore
                      ? Json(d.bore->kind == BoreKind::kHex ? "hexagon" : bore_shape_text(*d.bore))
                      : Json("");
  return json;
}

Json length_json(const PartWidth& w) {
  Json json = Json::object();
  json["from_mm"] = w.z_lower_mm;
  json["to_mm"] = w.z_upper_mm;
  json["length_mm"] = w.width_mm();
  add_limits(json, w.limits);
  return json;
}

Json step_json(const HolePattern& holes, const HoleStep& step) {
  Json json = Json::object();
  json["diameter_mm"] = step.drawn_mm;
  json["made_mm"] = step.diameter_mm;
  add_limits(json, step.limits);
  json["from_mm"] = step.z_lower_mm;
  json["to_mm"] = step.z_upper_mm;
  json["depth_mm"] = step.depth_mm();
  json["through"] = holes.open_below && holes.open_above;
  return json;
}

Json holes_json(const HolePattern& holes) {
  Json json = Json::object();
  json["count"] = holes.centres.size();
  json["circle_diameter_mm"] = holes.circle_diameter_mm;
  json["equally_spaced"] = holes.equally_spaced;
  json["at_mm"] = Json::array();
  for (const Point2& centre : holes.centres) json["at_mm"].push_back({centre.x(), centre.y()});
  json["opens_below"] = holes.open_below;
  json["opens_above"] = holes.open_above;
  json["steps"] = Json::array();
  for (const HoleStep& step : holes.steps) json["steps"].push_back(step_json(holes, step));
  json["for"] = text_or_null(holes.use.what);
  json["thread"] = text_or_null(holes.use.thread);
  json["words"] = hole_words(holes);
  return json;
}

const char* to_text(ToleratedFeature feature) {
  switch (feature) {
    case ToleratedFeature::kTips:
      return "tips";
    case ToleratedFeature::kUpperFace:
      return "upper_face";
    case ToleratedFeature::kLowerFace:
      return "lower_face";
    case ToleratedFeature::kSeat:
      return "seat";
    case ToleratedFeature::kHoles:
      return "holes";
  }
  return "";
}

Json tolerance_json(const GeometricTolerance& t) {
  Json json = Json::object();
  json["kind"] = io::to_text(t.kind);
  json["of"] = to_text(t.feature);
  if (t.gear) json["gear"] = t.gear->name;
  if (t.feature == ToleratedFeature::kSeat) json["diameter_mm"] = t.diameter_mm;
  if (t.feature == ToleratedFeature::kHoles) json["holes"] = t.pattern;
  json["value_mm"] = t.value_mm;
  json["datum"] = t.datum == 0 ? Json(nullptr) : Json(std::string(1, t.datum));
  return json;
}

template <class Items, class Write>
Json list_of(const Items& items, const Write& write) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(write(item));
  return list;
}

/// Class and texture of the flanks; without an allowance in the design the thickness that is held,
/// and what measures it.
Json flanks_json(const TrainGear& gear, const Workmanship& made) {
  const bool by_class = made.flank_class > 0;
  Json json = Json::object();
  json["tolerance_class"] = by_class ? Json(made.flank_class) : Json(nullptr);
  json["runout_mm"] = by_class ? kNaN : made.runout_mm;
  json["roughness_um"] = flank_roughness_um(gear, made);
  const double either = gear.thinning_limits ? kNaN : made.thickness_mm;
  const double thinning = gear.profile.gear().thinning_mm;
  const MeasuredLimits limits = std::isnan(either)
                                    ? MeasuredLimits{}
                                    : measured_limits(gear, thinning - either, thinning + either);
  json["thickness_holds_mm"] = either;
  json["span_min_mm"] = limits.span_min_mm;
  json["span_max_mm"] = limits.span_max_mm;
  json["over_pins_min_mm"] = limits.over_pins_min_mm;
  json["over_pins_max_mm"] = limits.over_pins_max_mm;
  return json;
}

Json part_json(const GearTrain& train, const PartShape& part, const Workmanship& made) {
  const PartDimensions dimensions = part_dimensions(train, part);
  Json json = Json::object();
  json["general_tolerances"] = general_tolerance_text(made);
  json["surfaces"] = text_or_null(general_surface_text(made));
  json["diameters"] = list_of(dimensions.diameters, diameter_json);
  json["widths"] = list_of(dimensions.widths, length_json);
  json["depths"] = list_of(dimensions.depths, length_json);
  json["holes"] = list_of(dimensions.holes, holes_json);
  json["tolerances"] = list_of(dimensions.tolerances, tolerance_json);
  json["flanks"] = Json::object();
  for (const TrainGear* gear : gears_of(train, part))
    json["flanks"][gear->name] = flanks_json(*gear, made);
  json["index_marks"] = part.marks.size();
  return json;
}

}  // namespace

std::string part_sizes_json_text(const GearTrain& train, const PartShapes& shapes) {
  const Workmanship made = workmanship(train);
  Json parts = Json::object();
  for (const PartShape& part : shapes.parts)
    if (part.bought.empty()) parts[part.name] = part_json(train, part, made);
  return parts.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trueflank::io
