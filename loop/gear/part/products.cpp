// SPDX-License-Identifier: GPL-3.0-or-later
// Steps with an edge, and products of simple courses in place of what follows them in pieces: over
// profile and face, from tooth to tooth, and waves weighed by a course. Places and widths are
// sought in what is left without the pieces, which do not lead to them.
#include "trueflank/loop/gear/part/products.h"

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/likeliest_products.h"
#include "trueflank/loop/gear/part/crossed_forms.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/sets_to_try.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {
namespace {

using Indices = std::vector<std::size_t>;

/// By how much squares grow without an effect.
double loss_without(const PointFit& fit, std::size_t e) {
  const int first = fit.first_column(static_cast<int>(e)), count = fit.effects()[e].columns();
  const Eigen::VectorXd own = fit.coefficients().segment(first, count);
  return own.dot(symmetric_solution(fit.covariance().block(first, first, count, count), own));
}

bool is_wave_along(const Effect& effect) {
  const std::vector<std::string>& names = effect.family->shape_names;
  return effect.family == find_family("unnamed_marks") ||
         std::find(names.begin(), names.end(), "wavelength_mm") != names.end();
}

/// The cheapest step or product that stands for effects of an answer, as they are asked one after
/// the other.
class Products {
 public:
  explicit Products(const PartModel& model)
      : model_(model), now_(fit_of(model, model.effects)->residual_square()) {
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      all_.push_back(e);
      if (!model.effects[e].family->named) nameless_.push_back(e);
    }
  }

  [[nodiscard]] bool found() const { return !best_.empty(); }
  [[nodiscard]] std::vector<Effect> best(Indices& these) && {
    these = std::move(these_);
    return std::move(best_);
  }

  void ask_steps(int face);
  void ask_the_same_on_every_tooth();
  void ask_around_the_gear();
  void ask_orders();
  void ask_waves();

 private:
  [[nodiscard]] std::vector<Effect> without(const Indices& set) const;
  [[nodiscard]] LikeliestProducts likeliest_beside(const std::vector<Effect>& others) const {
    return {model_.geometry, model_.table, model_.patches, *fit_of(model_, others)->residuals_um()};
  }
  /// Of these squares, what a form must take out before it is fitted: half of what the answer does
  /// beyond other effects.
  [[nodiscard]] double least_gain(double square, const std::vector<Effect>& others) const {
    constexpr double kMostOfIt = 0.5;
    return kMostOfIt * (1.0 - now_ / fit_of(model_, others)->residual_square()) * square;
  }
  [[nodiscard]] std::vector<Effect> common_names_beside(const std::vector<Effect>& others,
                                                        std::optional<Runs> along = {}) const;
  [[nodiscard]] Indices pieces_of(const Effect& form, const Indices& set) const;
  [[nodiscard]] bool earns_its_place(const std::vector<Effect>& with) const;
  void ask(const Indices& set, const std::vector<LikelyForms>& forms, double least_gain,
           const std::vector<Effect>& beside = {}, bool beside_stays = false);

  const PartModel& model_;
  double now_;
  Indices all_, nameless_;  ///< of what is told here
  std::vector<Effect> best_;
  Indices these_;  ///< that it stands for
  double least_ = 1e300;
};

std::vector<Effect> Products::without(const Indices& set) const {
  std::vector<Effect> others;
  for (std::size_t e = 0; e < model_.effects.size(); ++e)
    if (std::find(set.begin(), set.end(), e) == set.end()) others.push_back(model_.effects[e]);
  return others;
}

/// Levels, slopes and bows of all teeth that have a name and are not among these; of a level the
/// form. Along one direction, or any.
std::vector<Effect> Products::common_names_beside(const std::vector<Effect>& others,
                                                  std::optional<Runs> along) const {
  const auto runs = [&](const Effect& name) {
    const Runs own = runs_of(model_.geometry, name, Flanks::kOfEither);
    return along ? own == *along : own != Runs::kNowhere;
  };
  std::vector<Effect> names{{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}}};
  for (std::size_t c = 0; c < model_.candidates.size(); ++c)
    if (const Effect& name = model_.candidates[c];
        is_name_of_all_teeth(name) && name.shape.empty() && name.flank == FlankChoice::kBoth &&
        !model_.unseen[c] && runs(name))
      names.push_back(name);
  std::vector<Effect> beside, all = others;
  for (const Effect& name : names) {
    if (std::find(all.begin(), all.end(), name) != all.end() || !is_told_apart(model_, name, all))
      continue;
    beside.push_back(name);
    all.push_back(name);
  }
  return beside;
}

/// Those of these that mean little beside a form: its pieces. What keeps its size is a thing of its
/// own.
std::vector<std::size_t> Products::pieces_of(const Effect& form, const Indices& set) const {
  constexpr double kLittle = 0.3;
  std::vector<Effect> with = model_.effects;
  with.push_back(form);
  const auto now = fit_of(model_, model_.effects), beside = fit_of(model_, with);
  Indices pieces;
  for (const std::size_t e : set)
    if (loss_without(*beside, e) < kLittle * loss_without(*now, e)) pieces.push_back(e);
  return pieces;
}

/// False where the names beside a form, the last, say nearly as much without it.
bool Products::earns_its_place(const std::vector<Effect>& with) const {
  constexpr double kClearly = 9.0;  // chi-square
  std::vector<Effect> without = with;
  without.pop_back();
  return cost_of(model_, with) < cost_of(model_, without) - kClearly;
}

/// Forms for a set; names that are free beside them do not stay: they are chosen anew.
void Products::ask(const Indices& set, const std::vector<LikelyForms>& forms, double least_gain,
                   const std::vector<Effect>& beside, bool beside_stays) {
  for (const LikelyForms& likely : forms) {
    if (likely.gain < least_gain) continue;
    Indices taken;
    std::vector<Effect> with = cheapest_one_form(model_, {set}, likely.forms, beside, taken);
    // (what grows over profile and face is told as that: tell_as_product)
    if (with.empty() || gear_effects::is_product_of_polynomials(model_.geometry, with.back()))
      continue;
    const double cost = cost_of(model_, with);
    if (!(cost < least_) || (!beside.empty() && !earns_its_place(with))) continue;
    least_ = cost;
    best_ = std::move(with);
    if (!beside_stays) best_.erase(best_.end() - 1 - std::ssize(beside), best_.end() - 1);
    these_ = std::move(taken);
  }
}

/// A step, sharp or with an edge, for all that runs over the profile (0) or the face (1) alike on
/// every tooth, on both flanks and on either: slopes, bows, kinks, ridges and waves follow an edge.
/// A level and names that the pieces have taken up may stand beside it.
void Products::ask_steps(int face) {
  constexpr int kFewestValues = 3;
  const Runs along = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  Indices all, names;
  for (const std::size_t e : all_) {
    const Effect& effect = model_.effects[e];
    if (runs_of(model_.geometry, effect, Flanks::kOfEither) != along) continue;
    all.push_back(e);
    if (effect.family->named) names.push_back(e);
  }
  if (all.size() < 2 || names.size() == all.size()) return;
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  for (const Indices& set : with_and_without(all, names)) {
    std::vector<Effect> own;
    for (const std::size_t e : set) own.push_back(model_.effects[e]);
    if (set.size() < 2 || values_of(own, true) < kFewestValues) continue;
    const std::vector<Effect> others = without(set);
    const LikeliestProducts likeliest = likeliest_beside(others);
    const std::vector<LikelyForms> alone = likeliest.steps(face, false);
    ask(set, alone, 0.0);
    if (is_told_apart(model_, level, others)) ask(set, alone, 0.0, {level});
    ask(set, likeliest.steps(face, true), 0.0, common_names_beside(others, along));
  }
}

/// For all that is the same on every tooth. Where none stands, names that the pieces have taken up
/// may stand beside it.
void Products::ask_the_same_on_every_tooth() {
  constexpr int kFewestValues = 5;
  if (model_.table->points_mm.empty()) return;
  std::vector<Indices> sets = crossed_sets(model_, kFewestValues);
  for (Indices& set : sets) {
    // (by how much all flanks stand out is a thing of its own, or chosen anew)
    std::erase_if(set, [&](std::size_t e) {
      return runs_of(model_.geometry, model_.effects[e]) == Runs::kNowhere;
    });
    if (set.size() < 2) continue;
    const std::vector<Effect> others = without(set);
    const LikeliestProducts likeliest = likeliest_beside(others);
    ask(set, likeliest.same_on_every_tooth(), least_gain(likeliest.square(), others));
  }
  if (found() || sets.empty() || sets.front().size() < 2) return;
  const std::vector<Effect> others = without(sets.front()), names = common_names_beside(others);
  std::vector<Effect> with_names = others;
  with_names.insert(with_names.end(), names.begin(), names.end());
  const auto [forms, square] = likeliest_beside(others).beside_names();
  ask(sets.front(), forms, least_gain(square, with_names), names);
}

/// For all that has no name, and for all; or for those that are pieces of it.
void Products::ask_around_the_gear() {
  constexpr int kFewestValues = 3;
  std::vector<Effect> own;
  bool around = false;
  for (const std::size_t e : nameless_) {
    own.push_back(model_.effects[e]);
    const NeedsToBeSeen needs = own.back().needs();
    around = around || (runs_of(model_.geometry, own.back()) == Runs::kOtherwise &&
                        (needs.along_profile || needs.along_face));
  }
  if (!around || values_of(own, true) < kFewestValues) return;
  std::vector<Indices> sets{nameless_};
  if (all_ != nameless_) sets.push_back(all_);
  for (const Indices& set : sets) {
    if (set.size() < 2) continue;
    const std::vector<Effect> others = without(set);
    const LikeliestProducts likeliest = likeliest_beside(others);
    const std::vector<LikelyForms> forms = likeliest.around_the_gear();
    ask(set, forms, least_gain(likeliest.square(), others));
    if (found() && best_.back().family == find_family("unnamed_crossed_around")) continue;
    for (const LikelyForms& likely : forms)
      if (const Indices pieces = pieces_of(likely.forms.front(), set);
          pieces.size() > 1 && pieces.size() < set.size())
        ask(pieces, {likely}, 0.0);
  }
}

/// For what runs along the flanks in waves of one order, and for waves of that order that are alike
/// on whole flanks, with a name or without: these may be things of their own. Both flanks may have
/// a phase of their own.
void Products::ask_orders() {
  constexpr int kFewestValues = 4;
  std::map<double, Indices> of_order;
  for (const std::size_t e : all_)
    if (is_wave_around(model_.effects[e]) && model_.effects[e].columns() == 2)
      of_order[model_.effects[e].order()].push_back(e);
  for (const auto& [order, all] : of_order) {
    Indices plain, names;
    std::vector<Effect> own;
    bool profile = false, face = false;
    for (const std::size_t e : all) {
      own.push_back(model_.effects[e]);
      const NeedsToBeSeen needs = own.back().needs();
      profile = profile || needs.along_profile;
      face = face || needs.along_face;
      if (own.back().family->named)
        names.push_back(e);
      else if (!needs.along_profile && !needs.along_face)
        plain.push_back(e);
    }
    if (!(profile || face) || values_of(own, true) < kFewestValues) continue;
    Indices kept = names;
    kept.insert(kept.end(), plain.begin(), plain.end());
    for (const Indices& set : with_and_without(all, kept)) {
      if (set.size() < 2) continue;
      const std::vector<Effect> others = without(set);
      const LikeliestProducts likeliest = likeliest_beside(others);
      const double least = least_gain(likeliest.square(), others);
      OrderAsked asked{.order = order,
                       .along_profile = profile,
                       .crossed = profile && face,
                       .beside_plain = set.size() < all.size()};
      ask(set, likeliest.of_order(asked), least);
      asked.phase_of_each_flank = true;
      for (const LikelyForms& likely : likeliest.of_order(asked)) {
        Effect other = likely.forms.front();
        other.flank = FlankChoice::kRight;
        ask(set, {likely}, least, {other}, true);
      }
    }
  }
}

/// Waves whose size follows a course, for those without a name that are pieces of them: waves, too.
void Products::ask_waves() {
  const auto is_wave = [&](std::size_t e) { return is_wave_along(model_.effects[e]); };
  if (nameless_.size() < 2 || std::none_of(nameless_.begin(), nameless_.end(), is_wave)) return;
  for (const LikelyForms& likely : likeliest_beside(without(nameless_)).waves())
    if (const Indices pieces = pieces_of(likely.forms.front(), nameless_); pieces.size() > 1)
      ask(pieces, {likely}, 0.0);
}

}  // namespace

std::vector<Effect> with_products(const PartModel& model, std::vector<std::size_t>& these) {
  if (model.effects == model.no_products_in) return {};
  Products products(model);
  for (const int face : {0, 1}) products.ask_steps(face);
  if (!products.found()) products.ask_the_same_on_every_tooth();
  products.ask_around_the_gear();
  products.ask_orders();
  if (!products.found()) products.ask_waves();
  if (!products.found()) model.no_products_in = model.effects;
  return std::move(products).best(these);
}

}  // namespace trueflank::loop
