// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/contact_judgement.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/axial.h"
#include "trueflank/check/backlash.h"
#include "trueflank/check/centre_distance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/contact_ratio.h"
#include "trueflank/check/corner_contact.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/check/planet_spacing.h"
#include "trueflank/check/tip_clearance.h"

namespace trueflank {
namespace {

/// Several heights are turned, driving both ways.
constexpr int kTurnsOfModified = 6;

void add(Judgement& all, const std::string& id, int layer, double lacking, bool fails) {
  all.complaints.push_back({id, layer, std::max(lacking, 1e-6), fails});
}

/// A finding of a check that computes nothing costly.
void take(Judgement& all, const GearTrain& train, const Finding& finding, int layer, int wanted) {
  if (wanted != 0 && layer != wanted) return;
  if (finding.status != CheckStatus::kFail && finding.status != CheckStatus::kWarn) return;
  const double scale = finding.unit == "mm" ? train.design.module_mm : 1.0;
  add(all, finding.id, layer, std::isnan(finding.margin) ? 1.0 : -finding.margin / scale,
      finding.status == CheckStatus::kFail);
}

int layer_of_place(const GearTrain& train, const std::string& where) {
  for (const TrainMesh& mesh : train.meshes)
    if (mesh.name == where) return layer_of(train, mesh);
  const TrainGear* gear = train.find(where);
  return gear ? gear->layer : 0;
}

/// How much of the line of action lies in a root fillet or beyond a base circle.
double in_fillet_mm(const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  return std::max({line.effective_start_mm - line.start_mm, line.end_mm - line.effective_end_mm, 0.0});
}

void append(std::string& key, double value) { key.append(reinterpret_cast<const char*>(&value), sizeof value); }

void append(std::string& key, const Gear& gear) {
  for (const double value : {static_cast<double>(gear.teeth), gear.normal_module_mm, gear.helix_angle_rad, gear.shift,
                             gear.thinning_mm, gear.tip_radius_mm, gear.tip_rounding_mm,
                             gear.rack.pressure_angle_rad, gear.rack.addendum, gear.rack.dedendum,
                             gear.rack.root_radius})
    append(key, value);
}

}  // namespace

double Judgement::failing() const {
  double sum = 0.0;
  for (const Complaint& c : complaints)
    if (c.fails) sum += 1.0 + std::min(c.lacking, 1.0);
  return sum;
}

double Judgement::worrying() const {
  double sum = 0.0;
  for (const Complaint& c : complaints)
    if (!c.fails) sum += 1.0 + std::min(c.lacking, 1.0);
  return sum;
}

int layer_of(const GearTrain& train, const TrainMesh& mesh) {
  return train.gears[static_cast<std::size_t>(mesh.gear1)].layer;
}

Judgement ContactJudge::without_turning(const GearTrain& train, int layer) {
  Judgement all;
  for (const auto check : {check_centre_distance, check_backlash, check_tip_clearance, check_contact_ratio,
                           check_planet_spacing, check_axial})
    for (const Finding& finding : check(train))
      take(all, train, finding, layer_of_place(train, finding.where), layer);
  for (const TrainMesh& mesh : train.meshes) {
    const int l = layer_of(train, mesh);
    if (layer != 0 && l != layer) continue;
    const GearPair pair = train.pair(mesh);
    const double inside = in_fillet_mm(pair);
    if (inside > 1e-9) add(all, "fillet_interference", l, inside / pair.gear1().normal_module_mm, false);
  }
  if (layer == 0 && train.design.planets > 1 && !train.assembly.equal_spacing)
    add(all, "assembly", 0, 1.0, true);
  return all;
}

const ContactJudge::Clearances& ContactJudge::clearances(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  std::string key;
  append(key, pair.gear1());
  append(key, pair.gear2());
  append(key, pair.centre_distance_mm);
  // Modifications are the mesh's own, and the same in all designs of a search.
  const bool modified = is_modified(train, mesh);
  if (modified) append(key, static_cast<double>(&mesh - train.meshes.data()));
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  turned_ += modified ? kTurnsOfModified : 1;
  Clearances c;
  MeshPlace place;
  if (modified) {
    const MeshState state = modified_state(train, mesh);
    c.centred_mm = state.centred.clearance_mm;
    c.driving_mm = state.driving.clearance_mm;
    place = c.centred_mm < -tolerance::kTouch_mm ? state.centred.place : state.driving.place;
  } else {
    const MeshClearance driving = driving_clearance(pair);
    c.driving_mm = driving.clearance_mm;
    place = driving.place;
    // what clears with the play taken up clears with it shared out
    const bool asked = train.design.made.clearance_mm.value_or(0.0) > 0.0;
    c.centred_mm = driving.clearance_mm >= 0.0 && !asked ? 0.0 : sweep_clearance_mm(pair);
    if (std::isnan(driving.clearance_mm)) place = mesh_clearance(pair).place;
  }
  if (std::isnan(c.driving_mm)) c.driving_mm = c.centred_mm;
  c.tip_of_gear1 = std::abs(place.radius1_mm - pair.profile1->tip_radius_mm()) <
                   std::abs(place.radius2_mm - pair.profile2->tip_radius_mm());
  return known_[key] = c;
}

Judgement ContactJudge::by_turning(const GearTrain& train, int layer) {
  Judgement all;
  for (const TrainMesh& mesh : train.meshes) {
    const int l = layer_of(train, mesh);
    if (layer != 0 && l != layer) continue;
    const double m = train.pair(mesh).gear1().normal_module_mm;
    const Clearances& c = clearances(train, mesh);
    const double asked = train.design.made.clearance_mm.value_or(0.0);
    if (c.centred_mm < asked - tolerance::kTouch_mm) add(all, "overlap", l, (asked - c.centred_mm) / m, true);
    const double limit = train.design.corner_contact_limit_mm.value_or(corner_contact_limit_mm(m));
    if (c.driving_mm < -tolerance::kTouch_mm)
      add(all, "corner_contact", l, -c.driving_mm / m, -c.driving_mm > limit);
  }
  return all;
}

}  // namespace trueflank
