// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/geometry/tooth_span.h"
#include "trueflank/report/flank_limits.h"
#include "trueflank/report/gear_dimensions.h"
#include "trueflank/report/inch_sizes.h"
#include "trueflank/report/part_sizes_json.h"
#include "trueflank/report/report.h"
#include "trueflank/report/report_drive.h"
#include "trueflank/train/mesh_face.h"
#include "trueflank/train/planet_phase.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// -0 as 0: nothing in a report depends on the sign of zero.
void drop_signs_of_zero(Json& json) {
  if (json.is_structured()) for (Json& item : json) drop_signs_of_zero(item);
  else if (json.is_number_float() && json.get<double>() == 0.0) json = 0.0;
}

Json degrees(const std::vector<double>& angles_rad) {
  Json list = Json::array();
  for (double angle : angles_rad) list.push_back(deg_from_rad(angle));
  return list;
}

/// Which bodies the nearest angles are for; at equal spacing they are those of identical ones.
Json nearest_bodies(const AssemblyCondition& condition) {
  if (condition.nearest_angles_rad.empty()) return nullptr;
  return condition.equal_spacing || planet_bodies_alike(condition) ? "identical" : "indexed";
}

Json train_json(const GearTrain& train) {
  const double output = train.speeds.output;
  const Topology& topology = train.topology();
  const bool has_planets = topology.has_planets();
  Json json = Json::object();
  json["kind"] = topology.kind;
  json["output"] = topology.output == kNoMember ? "none" : topology.name_of(topology.output);
  json["input"] = topology.meshes.empty() ? "none" : topology.name_of(topology.input);
  const bool one_set = has_planets && train.stages.empty();
  json["planets"] = one_set ? Json(train.design.planets) : Json(nullptr);
  json["ratio"] = std::isnan(output) ? Json(nullptr) : Json(std::abs(1.0 / output));
  json["direction"] = std::isnan(output) ? Json(nullptr) : Json(output > 0.0 ? "same" : "opposite");
  json["centre_distance_mm"] = train.centre_distance_mm;
  if (one_set) {
    json["assembles"] = train.assembly.equal_spacing;
    json["identical_planets"] = train.assembly.identical_planets;
    json["planet_offsets_deg"] = degrees(train.assembly.planet_offsets_rad);
    json["nearest_angles_deg"] = degrees(train.assembly.nearest_angles_rad);
    json["nearest_bodies"] = nearest_bodies(train.assembly);
    const IndexedPlanets indexed = indexed_planets(train);
    json["indexed_angles_deg"] = degrees(indexed.angles_rad);
    json["indexed_offsets_deg"] = degrees(indexed.offsets_rad);
    json["angle_step_deg"] = deg_from_rad(train.assembly.angle_step_rad);
  } else {
    for (const char* key : {"assembles", "identical_planets", "planet_offsets_deg",
                            "nearest_angles_deg", "nearest_bodies", "indexed_angles_deg",
                            "indexed_offsets_deg", "angle_step_deg"})
      json[key] = nullptr;
  }
  if (!train.stages.empty()) {  // each with the same keys
    json["assembles"] = train.assembly.equal_spacing;
    json["identical_planets"] = train.assembly.identical_planets;
    json["stages"] = Json::array();
    for (const GearTrain& stage : train.stages) json["stages"].push_back(train_json(stage));
  }
  return json;
}

/// Sizes at both ends of a thickness allowance; null without one.
Json thickness_json(const TrainGear& gear) {
  if (!gear.thinning_limits) return nullptr;
  const ThinningLimits& limits = *gear.thinning_limits;
  const Gear thick = thinned(gear.profile.gear(), limits.least_mm);
  const Gear thin = thinned(gear.profile.gear(), limits.most_mm);
  const double r = reference_radius_mm(thick);
  const MeasuredLimits measured = measured_limits(gear, limits.least_mm, limits.most_mm);
  Json json = Json::object();
  json["upper_um"] = um_from_mm(limits.upper_mm);
  json["lower_um"] = um_from_mm(limits.lower_mm);
  json["reference_thickness_min_mm"] = tooth_thickness_mm(thin, r);
  json["reference_thickness_max_mm"] = tooth_thickness_mm(thick, r);
  json["span_min_mm"] = measured.span_min_mm;
  json["span_max_mm"] = measured.span_max_mm;
  json["over_pins_min_mm"] = measured.over_pins_min_mm;
  json["over_pins_max_mm"] = measured.over_pins_max_mm;
  return json;
}

Json gear_json(const GearTrain& train, const TrainGear& gear) {
  const ToothProfile& profile = gear.profile;
  const Gear& g = profile.gear();
  const bool external = g.kind == GearKind::kExternal;
  const int span_teeth = recommended_span_teeth(g);
  const double pin = recommended_pin_diameter_mm(g);
  const ProfileNotes& notes = profile.notes();
  Json json = Json::object();
  json["teeth"] = g.teeth;
  json["internal"] = !external;
  json["shift"] = gear.shift;
  json["module_mm"] = g.normal_module_mm;
  json["reference_diameter_mm"] = 2.0 * reference_radius_mm(g);
  json["base_diameter_mm"] = 2.0 * base_radius_mm(g);
  json["tip_diameter_mm"] = 2.0 * profile.tip_radius_mm();
  json["tip_shortened_mm"] = gear.tip_shortened_mm;
  json["root_diameter_mm"] = 2.0 * profile.root_radius_mm();
  json["root_form_diameter_mm"] = 2.0 * profile.root_form_radius_mm();
  json["tip_form_diameter_mm"] = 2.0 * profile.tip_form_radius_mm();
  json["start_active_profile_diameter_mm"] = 2.0 * start_of_active_profile_mm(train, gear);
  json["tip_thickness_mm"] = profile.tip_thickness_mm();
  json["reference_thickness_mm"] = tooth_thickness_mm(g, reference_radius_mm(g));
  json["thinning_um"] = um_from_mm(g.thinning_mm);
  json["face_width_mm"] = gear.face_width_mm;
  json["root_radius_coefficient"] = profile.root_radius_coefficient();
  json["undercut"] = notes.undercut;
  json["pointed"] = notes.pointed;
  json["full_round_root"] = notes.full_round;
  json["closed_space"] = notes.space_closed;
  json["tip_inside_base_circle"] = notes.tip_inside_base;
  json["tip_trimmed_by_cutter"] = notes.tip_trimmed;
  json["span_teeth"] = external ? Json(span_teeth) : Json(nullptr);
  const std::string no_span = span_obstacle(gear, span_teeth);
  json["span_mm"] = no_span.empty() ? base_tangent_length_mm(g, span_teeth) : kNaN;
  json["span_note"] = no_span.empty() ? Json(nullptr) : Json(no_span);
  json["pin_diameter_mm"] = pin;
  json["over_pins_mm"] = over_pins_mm(g, pin);
  json["over_pins_with"] = measured_with(g);
  json["normal_module_mm"] = g.normal_module_mm;
  json["transverse_module_mm"] = transverse_module_mm(g);
  json["normal_pressure_angle_deg"] = deg_from_rad(g.rack.pressure_angle_rad);
  json["transverse_pressure_angle_deg"] = deg_from_rad(transverse_pressure_angle_rad(g));
  json["helix_angle_deg"] = deg_from_rad(g.helix_angle_rad);
  json["base_helix_angle_deg"] = deg_from_rad(base_helix_angle_rad(g));
  json["hand"] = g.helix_angle_rad == 0.0 ? Json(nullptr)
                 : gear.twist.herringbone ? Json("herringbone")
                                          : Json(g.helix_angle_rad > 0.0 ? "right" : "left");
  json["lead_mm"] = g.helix_angle_rad == 0.0
                        ? kNaN
                        : kTwoPi * reference_radius_mm(g) / std::tan(std::abs(g.helix_angle_rad));
  json["iso_1328_limits_um"] = nlohmann::ordered_json::parse(flank_limits_json_text(gear));
  json["relief_groove_mm"] = gear.twist.relief_groove_mm;
  json["modified"] = !gear.deviation.empty() || gear.edge_chamfer_mm > 0.0 || g.tip_rounding_mm > 0.0;
  json["protuberance_undercut_um"] = um_from_mm(notes.protuberance_undercut_mm);
  json["thickness_allowance"] = thickness_json(gear);
  return json;
}

Json mesh_json(const Report& report, std::size_t index) {
  const GearTrain& train = *report.train;
  const TrainMesh& mesh = train.meshes[index];
  const GearPair pair = train.pair(mesh);
  const ContactRatios ratios = contact_ratios(pair);
  Json json = Json::object();
  json["working_pressure_angle_deg"] = deg_from_rad(working_pressure_angle_rad(pair));
  json["contact_ratio"] = ratios.total;
  json["effective_contact_ratio"] = ratios.effective;
  json["approach_contact_ratio"] = ratios.approach;
  json["recess_contact_ratio"] = ratios.recess;
  const ModifiedMesh modified = modified_mesh(train, mesh);
  json["overlap_ratio"] = overlap_ratio(train, mesh);
  json["total_contact_ratio"] = ratios.effective + overlap_ratio(train, mesh);
  json["unrelieved_contact_ratio"] = modified.unrelieved_contact_ratio;
  json["carrying_face_width_mm"] = common_face(train, mesh).carrying_mm;
  json["backlash_mm"] = mesh.backlash_mm;
  json["modified_backlash_mm"] = modified.backlash_mm;
  json["implied_backlash_mm"] = mesh.implied_backlash_mm;
  json["backlash_min_mm"] = mesh.smallest_backlash_mm;
  json["backlash_max_mm"] = mesh.largest_backlash_mm;
  // the paper's word for its own formula; the sliding itself is under `efficiency`
  json["basic_efficiency"] = kNaN;
  for (const MeshEfficiency& e : report.efficiency.meshes)
    if (e.name == mesh.name) json["basic_efficiency"] = e.by_contact_ratios;
  const bool swept = index < report.sweeps.size();
  json["minimum_clearance_um"] = swept ? report.sweeps[index].minimum_clearance_um : kNaN;
  json["penetration_um"] = swept ? report.sweeps[index].penetration_um : kNaN;
  return json;
}

Json finding_json(const Finding& finding) {
  Json json = Json::object();
  json["id"] = finding.id;
  json["where"] = finding.where;
  json["status"] = to_text(finding.status);
  json["value"] = finding.value;
  json["limit"] = finding.limit;
  json["margin"] = finding.margin;
  json["unit"] = finding.unit;
  json["message"] = finding.message;
  json["cure"] = finding.cure;
  return json;
}

Json file_json(const ReportedFile& file) {
  Json json = Json::object();
  json["path"] = file.path;
  json["part"] = file.part;
  json["format"] = file.format;
  json["bytes"] = file.bytes;
  json["triangles"] = file.triangles > 0 ? Json(file.triangles) : Json(nullptr);
  json["accuracy_um"] = file.accuracy_um;
  json["volume_mm3"] = file.volume_mm3;
  if (!file.compensated_for.empty()) json["compensated_for"] = file.compensated_for;
  if (!std::isnan(file.kerf_mm)) {
    json["kerf_mm"] = file.kerf_mm;
    json["unreached_corners"] = file.unreached_corners;
    json["left_um"] = file.unreached_corners > 0 ? Json(file.left_um) : Json(nullptr);
  }
  return json;
}

Json bill_json(const BillLine& line) {
  Json json = Json::object();
  json["part"] = line.part.empty() ? Json(nullptr) : Json(line.part);
  json["designation"] = line.designation.empty() ? Json(nullptr) : Json(line.designation);
  json["count"] = line.count;
  json["material"] = line.material.empty() ? Json(nullptr) : Json(line.material);
  json["mass_g"] = line.mass_g;
  return json;
}

}  // namespace

std::string report_json(const Report& report) {
  const GearTrain& train = *report.train;
  Json json = Json::object();
  json["format"] = "trueflank-report";
  json["version"] = 1;
  json["design"] = train.design.name;
  json["train"] = train_json(train);
  json["gears"] = Json::object();
  for (const TrainGear& gear : train.gears) json["gears"][gear.name] = gear_json(train, gear);
  if (report.shapes) json["parts"] = Json::parse(part_sizes_json_text(train, *report.shapes));
  json["meshes"] = Json::object();
  for (std::size_t i = 0; i < train.meshes.size(); ++i)
    json["meshes"][train.meshes[i].name] = mesh_json(report, i);
  json["efficiency"] = Json::parse(efficiency_json_text(report.efficiency));
  if (!train.meshes.empty()) {
    const double torque = report.strength ? report.strength->input_torque_nm : kNaN;
    json["axial_thrust"] = Json::parse(
        axial_thrust_json_text(axial_thrust(train, report.efficiency.forward_drive), torque));
  }
  if (report.strength) json["strength"] = Json::parse(strength_json_text(report));
  if (report.inertia) json["inertia"] = Json::parse(inertia_json_text(*report.inertia));
  if (!report.bill.empty()) {
    json["bill_of_materials"] = Json::array();
    for (const BillLine& line : report.bill) json["bill_of_materials"].push_back(bill_json(line));
  }
  if (!report.files.empty()) {
    json["tolerance_um"] = report.tolerance_um;
    json["files"] = Json::array();
    for (const ReportedFile& file : report.files) json["files"].push_back(file_json(file));
  }
  json["checks"] = Json::array();
  for (const Finding& finding : report.findings) json["checks"].push_back(finding_json(finding));
  if (report.inches) json["inches"] = Json::parse(inch_json_text(*report.train));
  json["joint_cure"] = report.cure ? Json::parse(cure_json_text(*report.cure)) : Json(nullptr);
  json["verdict"] = to_text(verdict(report.findings));
  drop_signs_of_zero(json);
  // names come from users: what is no UTF-8 is shown as the replacement character
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trueflank::io
