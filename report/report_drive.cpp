// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/report_drive.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity; a locked train's inertia is reported as null beside self_locking.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json drive_json(const DirectionEfficiency& drive) {
  Json json = Json::object();
  json["members"] = Json::object();
  for (const auto& member : drive.members)
    json["members"][member.name] = {{"speed", member.speed},
                                    {"torque", member.torque},
                                    {"power", member.power}};
  json["meshes"] = Json::object();
  for (const auto& mesh : drive.meshes)
    json["meshes"][mesh.name] = {{"driving_gear", mesh.driving_gear},
                                 {"rolling_power", mesh.rolling_power},
                                 {"loss", mesh.loss},
                                 {"torque1", mesh.torque1},
                                 {"torque2", mesh.torque2}};
  return json;
}

Json tooth_json(const MeshStrength::Tooth& tooth) {
  return {{"gear", tooth.gear},
          {"material", tooth.material},
          {"form_factor", tooth.form_factor},
          {"bends_both_ways", tooth.bends_both_ways},
          {"bending_force_n", tooth.bending_force_n},
          {"bending_torque_nm", tooth.bending_torque_nm}};
}

Json iso_tooth_json(const Iso6336Mesh::Tooth& tooth) {
  return {{"gear", tooth.gear},           {"Y_Fa", tooth.form_factor},     {"Y_Sa", tooth.notch_factor},
          {"Y_B", tooth.rim_factor},      {"Y_NT", tooth.life_factor},     {"Y_X", tooth.size_factor},
          {"Y_deltarelT", tooth.sensitivity_factor},
          {"stress_mpa_per_n", tooth.stress_per_n},
          {"limit_mpa", tooth.limit_mpa}, {"output_nm", tooth.output_nm}, {"cycles", tooth.cycles}};
}

Json iso6336_json(const Iso6336Result& iso) {
  Json json = {{"output_torque_nm", iso.output_torque_nm},
               {"limiting_mesh", iso.limiting_mesh},
               {"limiting_gear", iso.limiting_gear},
               {"limiting_mode", iso.limiting_mode},
               {"meshes", Json::object()}};
  for (const Iso6336Mesh& mesh : iso.meshes)
    json["meshes"][mesh.name] = {{"tooth1", iso_tooth_json(mesh.tooth1)},
                                 {"tooth2", iso_tooth_json(mesh.tooth2)},
                                 {"Z_H", mesh.zone_factor},
                                 {"Z_E", mesh.elasticity_factor},
                                 {"Z_epsilon", mesh.contact_ratio_factor},
                                 {"Z_beta", mesh.helix_factor},
                                 {"Z_B", mesh.single_contact_factor1},
                                 {"Z_D", mesh.single_contact_factor2},
                                 {"contact_output_nm", mesh.contact_output_nm}};
  return json;
}

Json plastic_json(const PlasticResult& plastic) {
  Json json = {{"output_torque_nm", plastic.output_torque_nm},
               {"limiting_gear", plastic.limiting_gear},
               {"limiting_mode", plastic.limiting_mode},
               {"teeth", Json::array()}};
  for (const PlasticTooth& t : plastic.teeth)
    json["teeth"].push_back({{"mesh", t.mesh}, {"gear", t.gear}, {"material", t.material}, {"root_c", t.root_c},
                             {"flank_c", t.flank_c}, {"root_stress_mpa", t.root_stress_mpa},
                             {"root_limit_mpa", t.root_limit_mpa}, {"flank_stress_mpa", t.flank_stress_mpa},
                             {"flank_limit_mpa", t.flank_limit_mpa}, {"cycles", t.cycles}, {"wear_um", t.wear_um},
                             {"bent_um", t.bent_um}});
  return json;
}

}  // namespace

std::string limiting_material(const StrengthResult& strength) {
  std::string materials;
  for (const MeshStrength& mesh : strength.meshes) {
    if (mesh.name != strength.limiting_mesh) continue;
    for (const auto* tooth : {&mesh.tooth1, &mesh.tooth2})
      if (strength.limiting_gear.find(tooth->gear) != std::string::npos &&
          materials.find(tooth->material) == std::string::npos)
        materials += (materials.empty() ? "" : ", ") + tooth->material;
  }
  return materials;
}

std::string efficiency_json_text(const EfficiencyResult& efficiency) {
  Json json = {{"friction", efficiency.friction},
               {"forward", efficiency.forward},
               {"backward", efficiency.backward},
               {"self_locking", efficiency.self_locking},
               {"forward_locking", efficiency.forward_locking},
               {"load_sharing", "equal"},
               {"by_formula",
                {{"forward", efficiency.by_formula.forward},
                 {"backward", efficiency.by_formula.backward},
                 {"self_locking", efficiency.by_formula.self_locking},
                 {"applies", efficiency.by_formula.applies}}}};
  static_assert(kLoadSharing == LoadSharing::kEqual);
  if (efficiency.losses)
    json["losses"] = {{"mesh_forward", efficiency.mesh_forward},
                      {"mesh_backward", efficiency.mesh_backward},
                      {"friction_forward", efficiency.losses->friction_forward},
                      {"friction_backward", efficiency.losses->friction_backward},
                      {"loss_forward_nm", efficiency.losses->loss_forward_nm},
                      {"loss_backward_nm", efficiency.losses->loss_backward_nm}};
  json["meshes"] = Json::object();
  for (const MeshEfficiency& mesh : efficiency.meshes)
    json["meshes"][mesh.name] = {{"by_contact_ratios", mesh.by_contact_ratios},
                                 {"by_path_integral", mesh.by_path_integral},
                                 {"by_path_integral_gear2_driving", mesh.by_path_integral_gear2_driving},
                                 {"formula_applies", mesh.formula_applies}};
  if (!efficiency.meshes.empty()) {
    json["forward_drive"] = drive_json(efficiency.forward_drive);
    json["backward_drive"] = drive_json(efficiency.backward_drive);
  }
  return json.dump();
}

std::string strength_json_text(const Report& report) {
  const StrengthResult& strength = *report.strength;
  Json json = {{"output_torque_nm", strength.output_torque_nm},
               {"input_torque_nm", strength.input_torque_nm},
               {"limiting_mesh", strength.limiting_mesh},
               {"limiting_gear", strength.limiting_gear},
               {"limiting_mode", strength.limiting_mode},
               {"limiting_material", limiting_material(strength)}};
  json["meshes"] = Json::object();
  for (const MeshStrength& mesh : strength.meshes) {
    Json entry = {{"bending_output_nm", mesh.bending_output_nm},
                  {"contact_output_nm", mesh.contact_output_nm},
                  {"contact_force_n", mesh.contact_force_n},
                  {"tooth1", tooth_json(mesh.tooth1)},
                  {"tooth2", tooth_json(mesh.tooth2)}};
    entry["factors"] = Json::object();
    for (const StrengthFactor& factor : mesh.factors)
      entry["factors"][factor.symbol] = {{"value", factor.value},
                                         {"from", factor.computed ? "computed" : "assumed"}};
    json["meshes"][mesh.name] = std::move(entry);
  }
  json["iso6336"] = report.iso6336 ? iso6336_json(*report.iso6336) : Json(nullptr);
  json["plastic"] = report.plastic ? plastic_json(*report.plastic) : Json(nullptr);
  return json.dump();
}

std::string inertia_json_text(const ReportedInertia& inertia) {
  const ReflectedInertia& r = inertia.reflected;
  const Json json = {{"density_kg_m3", inertia.density_kg_m3},
                     {"input_side_kg_m2", finite(r.input_side_kg_m2)},
                     {"output_side_kg_m2", finite(r.output_side_kg_m2)},
                     {"at_input_forward_kg_m2", finite(r.at_input_forward_kg_m2)},
                     {"at_output_forward_kg_m2", finite(r.at_output_forward_kg_m2)},
                     {"at_input_backward_kg_m2", finite(r.at_input_backward_kg_m2)},
                     {"at_output_backward_kg_m2", finite(r.at_output_backward_kg_m2)},
                     {"starting_torque_nm", finite(r.starting_torque_nm)}};
  return json.dump();
}

std::string axial_thrust_json_text(const AxialThrust& thrust, double input_torque_nm) {
  Json json = Json::object();
  json["input_torque_nm"] = finite(input_torque_nm);
  json["meshes"] = Json::object();
  for (const auto& mesh : thrust.meshes)
    json["meshes"][mesh.name] = {
        {"on_gear1_n_per_nm", finite(mesh.on_gear1_n_per_nm)},
        {"on_gear1_n", finite(mesh.on_gear1_n_per_nm * input_torque_nm)}};
  json["bodies"] = Json::object();
  for (const auto& body : thrust.bodies)
    json["bodies"][body.name] = {{"n_per_nm", finite(body.n_per_nm)},
                                 {"n", finite(body.n_per_nm * input_torque_nm)}};
  return json.dump();
}

}  // namespace trueflank::io
