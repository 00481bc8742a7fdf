// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_values.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/gear_train.h"
#include "trueflank/train/losses.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

/// A margin beyond this is as good or bad as can be: far values would spoil an optimiser's models.
constexpr double kFarMargin = 2.0;

}  // namespace

SetValues::SetValues(const SearchRequirements& requirements, const ToothSet& set,
                     const LimitReserve& reserve)
    : r_(requirements), model_(requirements, set), reserve_(reserve) {
  const double clearance = mm_from_um(requirements.clearance_um) / model_.least_module_mm();
  for (std::size_t i = 0; i < model_.limits(); ++i) {
    const Limit limit = model_.train().limits[i].limit;
    const int layer = model_.train().limits[i].layer;
    const bool corner = limit == Limit::kFillet || limit == Limit::kTrochoid;
    const double kept = layer == 2 ? clearance / set.layer2_module_ratio : clearance;
    offset_[i] = reserve_[static_cast<std::size_t>(limit)] + (corner ? kept : 0.0) + kLimitReserve;
  }
  if (requirements.objectives.front() == SearchObjective::kBackward)
    guide_ = DriveDirection::kBackward;
}

SetValues::State SetValues::state(const FreeShifts& free) {
  return {layer1(free.centre_distance, free.layer1_shift),
          layer2(free.centre_distance, free.layer2_shift)};
}

void SetValues::margins(const State& s, double* out) const {
  const std::size_t first2 = model_.train().layer1_limits;
  for (std::size_t i = 0; i < model_.limits(); ++i) {
    const double margin = i < first2 ? s.layer1.margins[i] : s.layer2.margins[i - first2];
    out[i] =
        margin == margin ? std::clamp(margin - offset_[i], -kFarMargin, kFarMargin) : -kFarMargin;
  }
}

double SetValues::breach(const State& s) const {
  std::array<double, kLimits> m;
  margins(s, m.data());
  double sum = 0.0;
  for (std::size_t i = 0; i < model_.limits(); ++i) sum += std::max(0.0, -m[i]);
  return sum;
}

double SetValues::least_margin(const State& s) const {
  std::array<double, kLimits> m;
  margins(s, m.data());
  // what the offset keeps back is no breach of the limit
  return *std::min_element(m.begin(), m.begin() + static_cast<std::ptrdiff_t>(model_.limits())) +
         kLimitReserve;
}

double SetValues::layer_margin(int layer, const LayerEvaluation& evaluation,
                               bool without_profiles) const {
  const std::size_t first = layer == 0 ? 0 : model_.train().layer1_limits;
  const std::size_t last = layer == 0 ? model_.train().layer1_limits : model_.limits();
  double least = 1e9;
  for (std::size_t i = first; i < last; ++i) {
    if (without_profiles && evaluation.margins[i - first] < -1e8) continue;
    const double margin = evaluation.margins[i - first] - offset_[i];
    least = margin < least ? margin : least;
  }
  return least + kLimitReserve;
}

double SetValues::bound_margin(const State& s, const FreeShifts& free,
                               const MeritBound& bound) const {
  const double margin =
      (told_merit(s, free, bound.objective) - bound.merit) / std::max(1e-9, std::abs(bound.merit));
  return std::isfinite(margin) ? std::clamp(margin, -kFarMargin, kFarMargin) : -kFarMargin;
}

const DesignValues& SetValues::design_values(const State& s, const FreeShifts& free) const {
  if (free == last_free_) return last_;
  last_ = trueflank::design_values(r_, model_, free,
                                   model_.efficiency(s.layer1, s.layer2, DriveDirection::kForward),
                                   model_.efficiency(s.layer1, s.layer2, DriveDirection::kBackward));
  last_free_ = free;
  return last_;
}

double SetValues::merit(const State& s, const FreeShifts& free, SearchObjective objective) const {
  switch (objective) {
    case SearchObjective::kForward:
      return model_.efficiency(s.layer1, s.layer2, DriveDirection::kForward);
    case SearchObjective::kBackward:
      return model_.efficiency(s.layer1, s.layer2, DriveDirection::kBackward);
    case SearchObjective::kSize:
      if (!r_.module_max_mm) return -model_.outer_diameter(free) * model_.module_mm(free);
      break;
    default:
      break;
  }
  return told_merit(s, free, objective);
}

double SetValues::told_merit(const State& s, const FreeShifts& free,
                             SearchObjective objective) const {
  const bool efficiency =
      objective == SearchObjective::kForward || objective == SearchObjective::kBackward;
  ToldEfficiencies told;
  if (efficiency || objective == SearchObjective::kWeighted)
    told = told_efficiencies(r_, model_.ratio(),
                             model_.efficiency(s.layer1, s.layer2, DriveDirection::kForward),
                             model_.efficiency(s.layer1, s.layer2, DriveDirection::kBackward));
  if (objective == SearchObjective::kForward) return told.forward;
  if (objective == SearchObjective::kBackward) return told.backward;
  const DesignValues& values = design_values(s, free);
  if (objective == SearchObjective::kWeighted) return weighted_score(r_, told, values);
  if (objective == SearchObjective::kTorque) return values.torque_nm;
  if (objective == SearchObjective::kSize) return -values.size_mm;
  return merit_of_figure(objective, figure_of(values.figures, objective));
}

std::vector<FigureLimit> asked_limits(const SearchRequirements& r) {
  std::vector<FigureLimit> asked;
  if (r.output_torque_nm) asked.push_back({SearchObjective::kTorque, *r.output_torque_nm});
  asked.insert(asked.end(), r.figure_limits.begin(), r.figure_limits.end());
  return asked;
}

double merit_of_figure(SearchObjective objective, double value) {
  return objective_entry(objective).larger_is_better ? value : -value;
}

double allowable_torque_nm(const SearchRequirements& r, const GearTrain& train) {
  const auto result = strength(train, r.strength);
  return result && std::isfinite(result->output_torque_nm) ? result->output_torque_nm : 0.0;
}

Growth growth_for(const SearchRequirements& r, double asked_nm, double torque_nm,
                  double module_mm) {
  if (!(asked_nm > 0.0 && torque_nm > 0.0)) return {};
  // the allowable torque is in proportion to the width and to the square of the module
  constexpr double kEnough = 1.0 + 1e-9;
  const double wanted = kEnough * asked_nm / torque_nm;
  const double wider = std::clamp(
      wanted, 1.0, std::max(1.0, r.face_width_max_mm.value_or(0.0) / r.face_width_mm));
  const double larger = std::clamp(std::sqrt(wanted / wider), 1.0,
                                   std::max(1.0, r.module_max_mm.value_or(0.0) / module_mm));
  return {wider, larger};
}

DesignValues design_values(const SearchRequirements& r, const SearchModel& model,
                           const FreeShifts& free, double mesh_forward, double mesh_backward) {
  DesignValues values;
  const double module = model.module_mm(free);
  values.size_mm = model.outer_diameter(free) * module;
  auto train = lay_out(model.design(free));
  if (!train) return values;
  values.torque_nm = allowable_torque_nm(r, *train);
  if (r.output_torque_nm) {
    const auto [wider, larger] =
        growth_for(r, *r.output_torque_nm, values.torque_nm, module);
    if (wider > 1.0 || larger > 1.0) {
      values.dimensions = {.face_width_mm = r.face_width_mm * wider, .module_mm = module * larger};
      values.size_mm *= larger;
      train = lay_out(model.design(free, values.dimensions));
      if (!train) return {};
      values.torque_nm = allowable_torque_nm(r, *train);
    }
  }
  values.figures = design_figures(r, *train, mesh_forward, mesh_backward, values.torque_nm);
  return values;
}

ToldEfficiencies told_efficiencies(const SearchRequirements& r, double ratio, double mesh_forward,
                                   double mesh_backward) {
  if (!r.losses) return {mesh_forward, mesh_backward};
  // A mesh's loss is in proportion to its friction.
  const double forward = 1.0 - mesh_forward, backward = 1.0 - mesh_backward;
  const MeshEfficiencies meshes = [&](double mu_forward, double mu_backward) {
    const double friction = std::max(r.friction, 1e-9);
    return std::pair(1.0 - forward * mu_forward / friction,
                     mesh_backward > 0.0 ? 1.0 - backward * mu_backward / friction : 0.0);
  };
  const LossyEfficiency lossy =
      lossy_efficiency(*r.losses, r.friction, std::abs(ratio), meshes);
  return {lossy.forward, lossy.backward};
}

double weighted_score(const SearchRequirements& r, const ToldEfficiencies& told,
                      const DesignValues& values) {
  double score = 0.0;
  for (const ObjectiveWeight& w : r.weights) {
    const SearchObjective o = w.objective;
    const double value = o == SearchObjective::kForward    ? told.forward
                         : o == SearchObjective::kBackward ? told.backward
                         : o == SearchObjective::kTorque   ? values.torque_nm
                         : o == SearchObjective::kSize     ? values.size_mm
                                                           : figure_of(values.figures, o);
    score += w.weight * merit_of_figure(o, std::log(std::max(value, 1e-12)));
  }
  return score;
}

}  // namespace trueflank
