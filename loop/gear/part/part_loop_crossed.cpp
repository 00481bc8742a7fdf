// SPDX-License-Identifier: GPL-3.0-or-later
// Forms over profile and face at once, the same on every tooth: corners, and what grows over the
// profile times over the face.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/likeliest_products.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {

/// All that is the same on every tooth, and that less each name, and less all names; empty where
/// nothing of it runs over profile and face at once, or it has fewer values.
std::vector<std::vector<std::size_t>> PartLoop::crossed_sets(int fewest_values) const {
  std::vector<std::size_t> all, names;
  std::vector<Effect> own;
  bool crossed = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Runs runs = runs_of(geometry_, effects_[e]);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(effects_[e]);
    if (effects_[e].family->named) names.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
  }
  if (!crossed || values_of(own, true) < fewest_values) return {};
  std::vector<std::vector<std::size_t>> sets{all};
  for (const std::size_t kept : names) {
    sets.push_back(all);
    std::erase(sets.back(), kept);
  }
  if (names.size() > 1) {
    sets.push_back(all);
    for (const std::size_t kept : names) std::erase(sets.back(), kept);
  }
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

/// A corner of the flanks of one side, or of both, for all that is the same on every tooth: slopes
/// of both flanks, alike and opposite, are one of one side. A name may stand beside it.
bool PartLoop::tell_as_corner() {
  constexpr int kValuesOfCorner = 5;
  for (const std::vector<std::size_t>& these : crossed_sets(kValuesOfCorner + 1))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (put_one_form_for(these, corners(geometry_, flank))) return true;
  return false;
}

/// What grows over the profile times over the face, for two or more that are the same on every
/// tooth: a taper, a twist and a bow of a cure that reaches less far down.
bool PartLoop::tell_as_product() {
  for (const std::vector<std::size_t>& these : crossed_sets(2))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (these.size() > 1 && put_one_form_for(these, gear_effects::products(flank))) return true;
  return false;
}

/// Levels, slopes and bows of all teeth that have a name and are not among these; of a level the
/// form.
std::vector<Effect> PartLoop::common_names_beside(const std::vector<Effect>& others) const {
  std::vector<Effect> names{{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}}};
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (const Effect& name = candidates_[c];
        is_name_of_all_teeth(name) && name.shape.empty() && name.flank == FlankChoice::kBoth &&
        !unseen_[c] && runs_of(geometry_, name, Flanks::kOfEither) != Runs::kNowhere)
      names.push_back(name);
  std::vector<Effect> beside, all = others;
  for (const Effect& name : names) {
    if (std::find(all.begin(), all.end(), name) != all.end() || !is_told_apart(name, all)) continue;
    beside.push_back(name);
    all.push_back(name);
  }
  return beside;
}

namespace {

/// By how much squares grow without an effect.
double loss_without(const PointFit& fit, std::size_t e) {
  const int first = fit.first_column(static_cast<int>(e)), count = fit.effects()[e].columns();
  const Eigen::VectorXd own = fit.coefficients().segment(first, count);
  return own.dot(symmetric_solution(fit.covariance().block(first, first, count, count), own));
}

}  // namespace

/// Those of these that mean little beside a form: its pieces. What keeps its size is a thing of its
/// own.
std::vector<std::size_t> PartLoop::pieces_of(const Effect& form,
                                             const std::vector<std::size_t>& these) const {
  constexpr double kLittle = 0.3;
  std::vector<Effect> with = effects_;
  with.push_back(form);
  const auto now = fit_of(effects_), beside = fit_of(with);
  std::vector<std::size_t> pieces;
  for (const std::size_t e : these)
    if (loss_without(*beside, e) < kLittle * loss_without(*now, e)) pieces.push_back(e);
  return pieces;
}

/// A course over the profile times one over the face, for all that is the same on every tooth; or
/// courses that go from tooth to tooth, for all that has no name. Places and widths are sought in
/// what is left without these: the pieces do not lead to them. Where none stands, names that the
/// pieces have taken up may stand beside it: they are chosen anew.
std::vector<Effect> PartLoop::with_products(std::vector<std::size_t>& these) const {
  constexpr int kFewestValues = 5, kFewestAround = 3;
  constexpr double kMostOfIt = 0.5;
  if (effects_ == no_products_in_) return {};
  std::vector<Effect> best;
  double least = 1e300;
  const double now = fit_of(effects_)->residual_square();
  const auto others_of = [&](const std::vector<std::size_t>& set) {
    std::vector<Effect> others;
    for (std::size_t e = 0; e < effects_.size(); ++e)
      if (std::find(set.begin(), set.end(), e) == set.end()) others.push_back(effects_[e]);
    return others;
  };
  const auto likeliest_without = [&](const std::vector<Effect>& others) {
    return LikeliestProducts(geometry_, table_, patches_, *fit_of(others)->residuals_um());
  };
  const auto try_forms = [&](const std::vector<std::size_t>& set,
                             const std::vector<LikelyForms>& forms, double least_gain,
                             const std::vector<Effect>& beside) {
    for (const LikelyForms& likely : forms) {
      if (likely.gain < least_gain) continue;
      std::vector<std::size_t> taken;
      std::vector<Effect> with = cheapest_one_form({set}, likely.forms, beside, taken);
      // (what grows over profile and face is told as that: tell_as_product)
      if (with.empty() || gear_effects::is_product_of_polynomials(geometry_, with.back())) continue;
      const double cost = cost_of(with);
      if (!(cost < least)) continue;
      least = cost;
      best = std::move(with);
      best.erase(best.end() - 1 - std::ssize(beside), best.end() - 1);
      these = std::move(taken);
    }
  };
  std::vector<std::vector<std::size_t>> crossed;
  if (!table_->points_mm.empty()) crossed = crossed_sets(kFewestValues);
  for (std::vector<std::size_t>& set : crossed) {
    // (by how much all flanks stand out is a thing of its own, or chosen anew)
    std::erase_if(set,
                  [&](std::size_t e) { return runs_of(geometry_, effects_[e]) == Runs::kNowhere; });
    if (set.size() < 2) continue;
    const std::vector<Effect> others = others_of(set);
    const LikeliestProducts likeliest = likeliest_without(others);
    const double share = 1.0 - now / fit_of(others)->residual_square();
    try_forms(set, likeliest.same_on_every_tooth(), kMostOfIt * share * likeliest.square(), {});
  }
  if (best.empty() && !crossed.empty() && crossed.front().size() > 1) {
    const std::vector<Effect> others = others_of(crossed.front()),
                              names = common_names_beside(others);
    std::vector<Effect> with_names = others;
    with_names.insert(with_names.end(), names.begin(), names.end());
    const auto [forms, square] = likeliest_without(others).beside_names();
    const double share = 1.0 - now / fit_of(with_names)->residual_square();
    try_forms(crossed.front(), forms, kMostOfIt * share * square, names);
  }
  std::vector<std::size_t> nameless, all;
  std::vector<Effect> own;
  bool around = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    all.push_back(e);
    if (effects_[e].family->named) continue;
    nameless.push_back(e);
    own.push_back(effects_[e]);
    const NeedsToBeSeen needs = effects_[e].needs();
    around = around || (runs_of(geometry_, effects_[e]) == Runs::kOtherwise &&
                        (needs.along_profile || needs.along_face));
  }
  std::vector<std::vector<std::size_t>> sets;
  if (around && values_of(own, true) >= kFewestAround) sets = {nameless, all};
  if (all == nameless && !sets.empty()) sets.pop_back();
  for (const std::vector<std::size_t>& set : sets) {
    if (set.size() < 2) continue;
    const std::vector<Effect> others = others_of(set);
    const LikeliestProducts likeliest = likeliest_without(others);
    const std::vector<LikelyForms> forms = likeliest.around_the_gear();
    const double share = 1.0 - now / fit_of(others)->residual_square();
    try_forms(set, forms, kMostOfIt * share * likeliest.square(), {});
    if (best.empty() || best.back().family != find_family("unnamed_crossed_around"))
      for (const LikelyForms& likely : forms)
        if (const auto pieces = pieces_of(likely.forms.front(), set);
            pieces.size() > 1 && pieces.size() < set.size())
          try_forms(pieces, {likely}, 0.0, {});
  }
  // Waves whose size follows a course: what follows them are waves.
  const bool waves = std::any_of(own.begin(), own.end(), [](const Effect& e) {
    const auto& names = e.family->shape_names;
    return std::find(names.begin(), names.end(), "wavelength_mm") != names.end() ||
           e.family == find_family("unnamed_marks");
  });
  if (best.empty() && waves && nameless.size() > 1) {
    for (const LikelyForms& likely : likeliest_without(others_of(nameless)).waves()) {
      const auto pieces = pieces_of(likely.forms.front(), nameless);
      if (pieces.size() > 1) try_forms(pieces, {likely}, 0.0, {});
    }
  }
  if (best.empty()) no_products_in_ = effects_;
  return best;
}

}  // namespace trueflank::loop
