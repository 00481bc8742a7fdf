// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_values.h"

#include <algorithm>
#include <cmath>

#include "trueflank/train/gear_train.h"
#include "trueflank/train/strength.h"

namespace trueflank {
namespace {

/// A margin beyond this is as good or bad as can be: far values would spoil an optimiser's models.
constexpr double kFarMargin = 2.0;
/// Corners in roots are approached to this where no clearance is asked for: more than sampling
/// hides. Near its fillet a tip keeps a nearly constant distance over a wide range of shifts, and
/// 1e-3 costs half a percent.
constexpr double kCornerReserve = 1e-6;

}  // namespace

SetValues::SetValues(const SearchRequirements& requirements, const ToothSet& set,
                     const LimitReserve& reserve)
    : r_(requirements), model_(requirements, set), reserve_(reserve) {
  const double clearance = mm_from_um(requirements.clearance_um) / model_.least_module_mm();
  for (std::size_t i = 0; i < model_.limits(); ++i) {
    const auto& [limit, layer, where] = model_.train().limits[i];
    const bool corner = limit == Limit::kFillet || limit == Limit::kTrochoid;
    const double kept =
        std::max(kCornerReserve, layer == 2 ? clearance / set.layer2_module_ratio : clearance);
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

std::uint64_t SetValues::broken_limits(int layer, const LayerEvaluation& evaluation) const {
  const std::size_t first = layer == 0 ? 0 : model_.train().layer1_limits;
  const std::size_t last = layer == 0 ? model_.train().layer1_limits : model_.limits();
  std::uint64_t broken = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double margin = evaluation.margins[i - first];
    if (margin > -1e8 && margin - offset_[i] + kLimitReserve < 0.0)
      broken |= std::uint64_t{1} << (i - first);
  }
  return broken;
}

double SetValues::margin_of_limits(int layer, const LayerEvaluation& evaluation,
                                   std::uint64_t limits) const {
  const std::size_t first = layer == 0 ? 0 : model_.train().layer1_limits;
  double least = 1e9;
  for (std::size_t i = 0; limits != 0; ++i, limits >>= 1)
    if (limits & 1)
      least = std::min(least, evaluation.margins[i] - offset_[first + i] + kLimitReserve);
  return least;
}

double SetValues::bound_margin(const State& s, const FreeShifts& free,
                               const MeritBound& bound) const {
  const double margin =
      (merit(s, free, bound.objective) - bound.merit) / std::max(1e-9, std::abs(bound.merit));
  return std::isfinite(margin) ? std::clamp(margin, -kFarMargin, kFarMargin) : -kFarMargin;
}

double SetValues::allowable_torque(const FreeShifts& free) const {
  auto train = lay_out(model_.design(free));
  if (!train) return 0.0;
  auto result = strength(*train, r_.strength);
  return result && std::isfinite(result->output_torque_nm) ? result->output_torque_nm : 0.0;
}

double SetValues::merit(const State& s, const FreeShifts& free, SearchObjective objective) const {
  switch (objective) {
    case SearchObjective::kForward:
      return model_.efficiency(s.layer1, s.layer2, DriveDirection::kForward);
    case SearchObjective::kBackward:
      return model_.efficiency(s.layer1, s.layer2, DriveDirection::kBackward);
    case SearchObjective::kTorque:
      return allowable_torque(free);
    case SearchObjective::kSize:
      return -model_.outer_diameter(free) * model_.module_mm(free);
  }
  return kNaN;
}

}  // namespace trueflank
