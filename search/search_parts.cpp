// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_parts.h"

#include <algorithm>
#include <utility>

namespace trueflank {

PlaceInParts::PlaceInParts(SetValues& values, int layer, double distance, double shift,
                           double stop_below, CornerPlaces& corners)
    : values_(values),
      layer_(layer),
      shift_(shift),
      corners_(corners),
      limits_(values.limits_of(layer)) {
  PartlyJudged parts = values.in_parts(layer, distance, shift, stop_below);
  first_of_profiles_ = parts.first_of_profiles;
  evaluation_ = parts.evaluation;
  profiles_ = std::move(parts.profiles);
  const std::size_t known = profiles_ ? first_of_profiles_ : limits_;
  std::fill_n(state_.begin(), known, State::kComputed);
}

PlaceInParts::PlaceInParts(SetValues& values, int layer, double shift,
                           const LayerEvaluation& evaluation, double margin, CornerPlaces& corners)
    : values_(values),
      layer_(layer),
      shift_(shift),
      corners_(corners),
      limits_(values.limits_of(layer)),
      first_of_profiles_(limits_),
      evaluation_(evaluation),
      margin_(margin) {
  state_.fill(State::kComputed);
}

double PlaceInParts::kept(std::size_t limit, double enough) {
  double& margin = evaluation_.margins[limit];
  State& state = state_[limit];
  const auto known = [&] { return values_.kept(layer_, limit, margin); };
  if (state == State::kComputed || (state == State::kBounded && known() < enough)) return known();
  const std::size_t of_profiles = limit - first_of_profiles_;
  state = State::kComputed;
  if (!profiles_->exists(of_profiles)) return known();
  const CornerLook look =
      profiles_->look(of_profiles, values_.surely_below(layer_, limit, enough), corners_[limit]);
  margin = look.clearance_mm;
  if (!look.least) state = State::kBounded;
  return known();
}

bool PlaceInParts::is_feasible(PlaceInParts& beside, double enough) {
  for (std::size_t i = 0; i < limits_; ++i)
    if (is_known(i) && kept(i, enough) < 0.0) return false;
  for (std::size_t i = 0; i < limits_; ++i)
    if (beside.is_known(i) && beside.breaks(i) && kept(i, enough) < 0.0) return false;
  for (std::size_t i = 0; i < limits_; ++i)
    if (kept(i, enough) < 0.0) return false;
  return true;
}

std::optional<double> PlaceInParts::margin_above(double least) {
  for (std::size_t i = 0; i < limits_; ++i)
    if (is_known(i) && values_.kept(layer_, i, evaluation_.margins[i]) <= least)
      return std::nullopt;
  double margin = 1e9;
  for (std::size_t i = 0; i < limits_; ++i) {
    const double here = kept(i, least);
    if (here <= least) return std::nullopt;
    margin = here < margin ? here : margin;
  }
  return margin;
}

double PlaceInParts::margin() {
  if (!margin_) margin_ = margin_above(kLeastOfAll_mm);
  return *margin_;
}

bool break_the_same(PlaceInParts& p, PlaceInParts& q) {
  for (const bool known : {true, false})
    for (std::size_t i = 0; i < p.limits(); ++i)
      if ((p.is_known(i) && q.is_known(i)) == known && p.breaks(i) && q.breaks(i)) return true;
  return false;
}

bool are_close(PlaceInParts& p, PlaceInParts& q, double least) {
  std::array<std::size_t, kLayerLimits> both;
  std::size_t count = 0, looked_at = 0;
  bool far_p = false, far_q = false;
  const auto is_kept = [](PlaceInParts& place, std::size_t i) {
    return place.is_known(i) && !place.breaks(i);
  };
  for (std::size_t i = 0; i < p.limits(); ++i) {
    if (is_kept(p, i) || is_kept(q, i) || !p.breaks(i) || !q.breaks(i)) continue;
    both[count++] = i;
    far_p = far_p || !(p.kept(i, least) > least);
    for (; far_p && !far_q && looked_at < count; ++looked_at)
      far_q = !(q.kept(both[looked_at], least) > least);
    if (far_p && far_q) return false;
  }
  return true;
}

}  // namespace trueflank
