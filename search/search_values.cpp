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
/// Corners in roots are approached to this where no clearance is asked for: more than sampling hides. Near its
/// fillet a tip keeps a nearly constant distance over a wide range of shifts, and 1e-3 costs half a percent.
constexpr double kCornerReserve = 5e-6;

}  // namespace

SetValues::SetValues(const SearchRequirements& requirements, const ToothSet& set,
                     const LimitReserve& reserve)
    : r_(requirements), model_(requirements, set), reserve_(reserve) {
  const double clearance = mm_from_um(requirements.clearance_um) / model_.least_module_mm();
  for (std::size_t i = 0; i < kLimits; ++i) {
    const auto [limit, layer, where] = limit_entries()[i];
    const bool corner = limit == Limit::kFillet || limit == Limit::kTrochoid;
    const double kept = std::max(kCornerReserve, layer == 2 ? clearance / set.layer2_module_ratio : clearance);
    offset_[i] = reserve_[static_cast<std::size_t>(limit)] + (corner ? kept : 0.0) + kLimitReserve;
    grid_margin_ = std::max(grid_margin_, offset_[i]);
  }
  if (requirements.objectives.front() == SearchObjective::kBackward)
    guide_ = DriveDirection::kBackward;
}

SetValues::State SetValues::state(const FreeShifts& free) {
  return {layer1(free.centre_distance, free.ring1_shift),
          layer2(free.centre_distance, free.ring2_shift)};
}

void SetValues::margins(const State& s, double* out) const {
  for (std::size_t i = 0; i < kLimits; ++i) {
    const double margin =
        i < kLayer1Limits ? s.layer1.margins[i] : s.layer2.margins[i - kLayer1Limits];
    out[i] = margin == margin ? std::clamp(margin - offset_[i], -kFarMargin, kFarMargin)
                              : -kFarMargin;
  }
}

double SetValues::breach(const State& s) const {
  std::array<double, kLimits> m;
  margins(s, m.data());
  double sum = 0.0;
  for (const double margin : m) sum += std::max(0.0, -margin);
  return sum;
}

double SetValues::least_margin(const State& s) const {
  std::array<double, kLimits> m;
  margins(s, m.data());
  // what the offset keeps back is no breach of the limit
  return *std::min_element(m.begin(), m.end()) + kLimitReserve;
}

double SetValues::bound_margin(const State& s, const FreeShifts& free,
                               const MeritBound& bound) const {
  const double margin = (merit(s, free, bound.objective) - bound.merit) /
                        std::max(1e-9, std::abs(bound.merit));
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
      return model_.efficiency(s.layer1.sun_planet, s.layer1.planet_ring, s.layer2.planet_ring,
                               DriveDirection::kForward);
    case SearchObjective::kBackward:
      return model_.efficiency(s.layer1.sun_planet, s.layer1.planet_ring, s.layer2.planet_ring,
                               DriveDirection::kBackward);
    case SearchObjective::kTorque: return allowable_torque(free);
    case SearchObjective::kSize: return -model_.outer_diameter(free) * model_.module_mm(free);
  }
  return kNaN;
}

double at_grid(double low, double high, int i, int count) {
  if (i == 0) return low + 1e-6 * (high - low);
  if (i == count - 1) return high - 1e-6 * (high - low);
  return low + (high - low) * i / (count - 1);
}

}  // namespace trueflank
