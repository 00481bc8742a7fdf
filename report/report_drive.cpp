// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/report_drive.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity; a locked train's inertia is told as null beside self_locking.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json drive_json(const DirectionEfficiency& drive) {
  Json json;
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

}  // namespace

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

std::string strength_json_text(const StrengthResult& strength) {
  Json json = {{"output_torque_nm", strength.output_torque_nm},
               {"input_torque_nm", strength.input_torque_nm},
               {"limiting_mesh", strength.limiting_mesh},
               {"limiting_gear", strength.limiting_gear},
               {"limiting_mode", strength.limiting_mode}};
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
  Json json;
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
