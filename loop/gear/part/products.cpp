// SPDX-License-Identifier: GPL-3.0-or-later
// Steps with an edge, corners, and products of simple courses in place of what follows them in
// pieces: over profile and face, from tooth to tooth, and waves weighed by a course. Places and
// widths are sought in what is left without the pieces, which do not lead to them.
#include "trueflank/loop/gear/part/products.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/products/likeliest_products.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/waves.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {
namespace {

using Indices = std::vector<std::size_t>;

/// Sets of what is told: all that is the same on every tooth, and that less each name, and less all
/// names; empty where nothing of it runs over profile and face at once, or it has fewer values.
std::vector<Indices> crossed_sets(const PartModel& model, int fewest_values,
                                  Flanks flanks = Flanks::kAlike) {
  Indices all, names;
  std::vector<Effect> own;
  bool crossed = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Runs runs = runs_of(model.geometry, model.effects[e], flanks);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(model.effects[e]);
    if (model.effects[e].family->named) names.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
  }
  if (!crossed || values_of(own, true) < fewest_values) return {};
  return with_and_without(all, names);
}

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
  void ask_jumps(const Indices& set, const LikeliestProducts& likeliest, int face);
  void ask_facets_with_levels(const Indices& set, const std::vector<LikelyForms>& jumps,
                              const std::vector<Effect>& beside);
  void ask_the_same_on_every_tooth();
  void ask_around_the_gear();
  void ask_orders();
  void ask_fading_straight(double order, const Indices& set, bool face);
  void ask_profile_waves();
  void ask_scallops();
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
  [[nodiscard]] bool mends_a_name(const std::vector<Effect>& with) const;
  [[nodiscard]] bool earns_its_place(const std::vector<Effect>& with) const;
  void ask(const Indices& set, const std::vector<LikelyForms>& forms, double least_gain,
           const std::vector<Effect>& beside = {}, std::ptrdiff_t stay = 0);

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
  // Chi-square. Waves are sought among many lengths.
  const double kClearly = is_wave_along(with.back()) ? 60.0 : 9.0;
  std::vector<Effect> without = with;
  without.pop_back();
  return cost_of(model_, with) < cost_of(model_, without) - kClearly;
}

/// True where the last is a wave that is small beside a name with a place: it mends a name that is
/// not there.
bool Products::mends_a_name(const std::vector<Effect>& with) const {
  constexpr double kSmall = 0.25;
  if (!is_wave_along(with.back())) return false;
  const auto fit = fit_of(model_, with);
  const auto last = static_cast<int>(with.size()) - 1;
  for (int e = 0; e < last; ++e)
    if (with[static_cast<std::size_t>(e)].family->named &&
        with[static_cast<std::size_t>(e)].family->shape_is_continuous &&
        fit->effect_size_um(last) < kSmall * fit->effect_size_um(e))
      return true;
  return false;
}

/// Forms for a set; names that are free beside them do not stay: they are chosen anew. So many, the
/// last, do.
void Products::ask(const Indices& set, const std::vector<LikelyForms>& forms, double least_gain,
                   const std::vector<Effect>& beside, std::ptrdiff_t stay) {
  for (const LikelyForms& likely : forms) {
    if (likely.gain < least_gain) continue;
    Indices taken;
    std::vector<Effect> with = cheapest_one_form(model_, {set}, likely.forms, beside, taken);
    // (what grows over profile and face is told as that: tell_as_product)
    if (with.empty() || gear_effects::is_product_of_polynomials(model_.geometry, with.back()))
      continue;
    const double cost = cost_of(model_, with);
    if (!(cost < least_) || (!beside.empty() && !earns_its_place(with))) continue;
    if (mends_a_name(with) || are_no_stairs(model_.geometry, with, beside.size() + 1)) continue;
    least_ = cost;
    best_ = std::move(with);
    best_.erase(best_.end() - 1 - std::ssize(beside), best_.end() - 1 - stay);
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
    ask_jumps(set, likeliest, face);
  }
}

/// A jump that dies away, a sawtooth, facets, or several steps at once, which a single step does
/// not lead to.
void Products::ask_jumps(const Indices& set, const LikeliestProducts& likeliest, int face) {
  const std::vector<Effect> others = without(set);
  const Runs along = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  // (a name with a place and a width of its own stood for some of what the pieces are)
  if (std::any_of(others.begin(), others.end(), [&](const Effect& other) {
        return other.family->named && other.family->shape_is_continuous && other.shape.size() > 1 &&
               runs_of(model_.geometry, other, Flanks::kOfEither) == along;
      }))
    return;
  const std::vector<Effect> names = common_names_beside(others, along);
  for (const bool beside_names : {false, true}) {
    // (few traces do not choose such names anew)
    if (beside_names && model_.table->points_mm.empty()) continue;
    std::vector<Effect> beside;
    if (beside_names) beside = names;
    const std::vector<LikelyForms> jumps = likeliest.jumps(face, beside_names);
    ask(set, jumps, 0.0, beside);
    ask_facets_with_levels(set, jumps, beside);
    for (const LikelyForms& steps : likeliest.stairs(face, beside_names)) {
      beside.resize(beside_names ? names.size() : 0);
      beside.insert(beside.end(), steps.forms.begin(), steps.forms.end() - 1);
      ask(set, {{steps.gain, {steps.forms.back()}}}, 0.0, beside, std::ssize(steps.forms) - 1);
    }
  }
}

/// Facets whose edges are as designed are a level too.
void Products::ask_facets_with_levels(const Indices& set, const std::vector<LikelyForms>& jumps,
                                      const std::vector<Effect>& beside) {
  Indices with_levels = set;
  for (const std::size_t e : all_)
    if (runs_of(model_.geometry, model_.effects[e], Flanks::kOfEither) == Runs::kNowhere)
      with_levels.push_back(e);
  if (with_levels.size() == set.size()) return;
  std::sort(with_levels.begin(), with_levels.end());
  for (const LikelyForms& likely : jumps)
    if (likely.forms.front().family == find_family("unnamed_arches"))
      ask(with_levels, {likely}, 0.0, beside);
}

/// For all that is the same on every tooth. Where none stands, names that the pieces have taken up
/// may stand beside it.
void Products::ask_the_same_on_every_tooth() {
  constexpr int kFewestValues = 3;
  if (model_.table->points_mm.empty()) return;
  std::vector<Indices> sets = crossed_sets(model_, kFewestValues, Flanks::kOfEither);
  for (Indices& set : sets) {
    // (by how much all flanks stand out is a thing of its own, or chosen anew)
    std::erase_if(set, [&](std::size_t e) {
      return runs_of(model_.geometry, model_.effects[e], Flanks::kOfEither) == Runs::kNowhere;
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
  constexpr std::size_t kFewestOfComb = 3;
  std::vector<Effect> own;
  std::set<double> teeth;  // that have spots of their own
  bool around = false;
  for (const std::size_t e : nameless_) {
    own.push_back(model_.effects[e]);
    const NeedsToBeSeen needs = own.back().needs();
    if (own.back().family->is_of_one_tooth) teeth.insert(own.back().shape[0]);
    around = around || (runs_of(model_.geometry, own.back()) == Runs::kOtherwise &&
                        (needs.along_profile || needs.along_face));
  }
  if (!(around || teeth.size() >= kFewestOfComb) || values_of(own, true) < kFewestValues) return;
  std::vector<Indices> sets{nameless_};
  if (all_ != nameless_) sets.push_back(all_);
  for (const Indices& set : sets) {
    if (set.size() < 2) continue;
    const std::vector<Effect> others = without(set);
    const LikeliestProducts likeliest = likeliest_beside(others);
    std::vector<LikelyForms> forms = likeliest.around_the_gear();
    if (!around)
      std::erase_if(forms, [](const LikelyForms& likely) {
        return !gear_effects::is_of_a_comb(likely.forms.front());
      });
    ask(set, forms, least_gain(likeliest.square(), others));
    if (found() && best_.back().family == find_family("unnamed_crossed_around")) continue;
    for (const LikelyForms& likely : forms)
      if (const Indices pieces = pieces_of(likely.forms.front(), set);
          pieces.size() > 1 && pieces.size() < set.size())
        ask(pieces, {likely}, 0.0);
  }
}

/// A wave over the profile that is the same on every tooth, mirrored on the two flanks or in a
/// phase of either, for all that runs over the profile: one wave on two flanks, beside a relief,
/// ended in pieces. Names may stand beside it.
void Products::ask_profile_waves() {
  constexpr int kFewestValues = 4;
  constexpr double kFar = 100.0;  // chi-square
  constexpr double kSmall = 0.25;
  Indices all, nameless;
  std::vector<Effect> own;
  double wave_um = 0.0, largest_um = 0.0;
  const auto fit = fit_of(model_, model_.effects);
  for (const std::size_t e : all_) {
    const Effect& effect = model_.effects[e];
    const NeedsToBeSeen needs = effect.needs();
    const bool of_teeth =
        gear_effects::is_of_teeth(effect) && needs.along_profile && !needs.along_face;
    if (!of_teeth && runs_of(model_.geometry, effect, Flanks::kOfEither) != Runs::kOverProfile)
      continue;
    all.push_back(e);
    const double size_um = fit->effect_size_um(static_cast<int>(e));
    largest_um = std::max(largest_um, size_um);
    if (effect.family->named) continue;
    nameless.push_back(e);
    own.push_back(effect);
    if (is_wave_along(effect)) wave_um = std::max(wave_um, size_um);
  }
  // (a small wave is what mends a larger form)
  if (!(wave_um > kSmall * largest_um) || values_of(own, true) < kFewestValues ||
      fit_of(model_, without(nameless))->residual_square() < now_ + kFar)
    return;
  std::vector<Indices> sets{all};
  if (nameless.size() < all.size()) sets.push_back(nameless);
  for (const Indices& set : sets) {
    const std::vector<Effect> others = without(set);
    const std::vector<Effect> straight = common_names_beside(others, Runs::kOverProfile);
    std::vector<std::vector<std::vector<Effect>>> kinds{{{}}, {straight}};
    if (set.size() == all.size())
      for (auto& kind : names_with_a_place(model_, straight)) kinds.push_back(std::move(kind));
    const LikeliestProducts likeliest = likeliest_beside(others);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::ptrdiff_t stay = k > 1 ? 1 : 0;  // a name with a place
      const LikelyWavesBeside found = likeliest.profile_waves(kinds[k]);
      ask(set, {found.mirrored.waves}, 0.0, found.mirrored.beside, stay);
      std::vector<Effect> beside = found.of_either_flank.beside;
      beside.push_back(found.of_either_flank.waves.forms.front());
      beside.back().flank = FlankChoice::kRight;
      ask(set, {found.of_either_flank.waves}, 0.0, beside, stay + 1);
    }
  }
}

/// One wave across the flanks, straight, on both flanks or one, or with its multiples scallops, for
/// all waves that are the same on every tooth, and for all that is.
void Products::ask_scallops() {
  constexpr int kFewestValues = 4;
  constexpr double kFar = 100.0;   // chi-square
  constexpr double kFewest = 2.0;  // waves over the face
  Indices all, nameless, no_orders;
  std::vector<Effect> own;
  const auto fit = fit_of(model_, model_.effects);
  WaveAcross most;
  std::set<FlankChoice> flanks;  // of the waves
  for (const std::size_t e : all_) {
    const Effect& effect = model_.effects[e];
    const bool wave = effect.columns() == 2 && (effect.family == find_family("unnamed_marks") ||
                                                effect.family == find_family("unnamed_waviness"));
    const bool alike =
        (effect.family->same_on_every_tooth && effect.family->same_on_every_tooth(effect.shape)) ||
        (wave && effect.shape.back() == 0.0);
    const bool order = effect.family->tells_order_along_profile;  // (lines that run on over teeth)
    const bool name = effect.family->named && !order;
    if (!(alike || order) || (name && runs_of(model_.geometry, effect) != Runs::kOverProfile))
      continue;
    all.push_back(e);
    if (name) continue;
    nameless.push_back(e);
    if (!order) no_orders.push_back(e);
    own.push_back(effect);
    if (!wave) continue;
    const Effect on_both{effect.family, FlankChoice::kBoth, effect.shape};
    WaveAcross here = wave_across(model_.geometry, on_both, 1);
    here.size_um = fit->effect_size_um(static_cast<int>(e));
    if (std::abs(here.face) > kFewest && here.size_um > most.size_um) most = here;
    flanks.insert(effect.flank);
  }
  if (most.size_um == 0.0 || values_of(own, true) < kFewestValues ||
      fit_of(model_, without(nameless))->residual_square() < now_ + kFar)
    return;
  std::vector<Indices> sets{nameless};
  if (all.size() > nameless.size()) sets.push_back(all);
  if (no_orders.size() < nameless.size()) sets.push_back(no_orders);
  for (const Indices& set : sets) {
    if (set.size() < 2) continue;
    // The wave first, in any direction.
    std::vector<Effect> waves;
    for (double profile = -2.0; profile <= 2.0; profile += 0.125)
      for (const double times : {0.94, 0.97, 1.0, 1.03, 1.06})
        waves.push_back({find_family("unnamed_marks"),
                         flanks.size() == 1 ? *flanks.begin() : FlankChoice::kBoth,
                         {profile, times * std::abs(most.face), 0.0}});
    std::vector<Effect> with = with_best_form(model_, without(set), waves, {});
    if (with.empty() || std::abs(with.back().shape[1]) < kFewest) continue;
    ask(set, {{0.0, {with.back()}}}, 0.0);
    const auto fitted = fit_of(model_, with);
    const int first = fitted->first_column(static_cast<int>(with.size()) - 1);
    // (marks count from the root's lower corner, as scallops do)
    const double crest =
        std::atan2(fitted->coefficients()[first + 1], fitted->coefficients()[first]) / kTwoPi;
    std::vector<Effect> scallops;
    for (const double middle : {0.0, 0.5})
      for (const double parabolas : {0.0, 1.0}) {
        const double from = 0.5 - crest + middle;
        scallops.push_back(
            {find_family("unnamed_scallops"),
             with.back().flank,
             {with.back().shape[0], with.back().shape[1], from - std::floor(from), parabolas}});
      }
    ask(set, {{0.0, scallops}}, 0.0);
  }
}

/// A wave that fades evenly to none at the other end, for a plain one and one that slopes: these
/// say all that it does, and nobody sees in them that one end is good.
void Products::ask_fading_straight(double order, const Indices& set, bool face) {
  using gear_effects::FlankCourse;
  const std::vector<Effect> others = without(set);
  std::vector<Effect> own;
  for (const std::size_t e : set) own.push_back(model_.effects[e]);
  const double cost_now = cost_of(model_, model_.effects);
  for (const double towards : {-1.0, 1.0}) {
    EffectShape shape(2 * FlankCourse::kValues);
    const double from =
        gear_effects::place_at(model_.geometry, face ? 1.0 : 0.0, towards > 0.0 ? 0.0 : 1.0);
    const FlankCourse course{FlankCourse::kKink, from, towards};
    course.put_in(shape, face ? FlankCourse::kValues : 0);
    shape.push_back(0.0);
    shape.push_back(order);
    const EffectFamily* family = find_family("unnamed_crossed_order");
    for (const double opposite : {0.0, 1.0})
      for (const FlankChoice flank :
           {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
        if (opposite != 0.0 && flank != FlankChoice::kBoth) continue;
        shape[shape.size() - 2] = opposite;
        std::vector<Effect> with = others;
        with.push_back({family, flank, shape});
        if (values_of({with.back()}, true) >= values_of(own, true)) continue;
        const double cost = cost_of(model_, with);
        if (!(cost < cost_now) || !(cost < least_)) continue;
        least_ = cost;
        best_ = std::move(with);
        these_ = set;
      }
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
      for (const bool over_face : {false, true})
        if (over_face ? face : profile) ask_fading_straight(order, set, over_face);
      asked.phase_of_each_flank = true;
      for (const LikelyForms& likely : likeliest.of_order(asked)) {
        Effect other = likely.forms.front();
        other.flank = FlankChoice::kRight;
        ask(set, {likely}, least, {other}, 1);
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
  products.ask_profile_waves();
  products.ask_scallops();
  if (!products.found()) products.ask_waves();
  if (!products.found()) model.no_products_in = model.effects;
  return std::move(products).best(these);
}

bool tell_as_corner(PartModel& model) {
  constexpr int kValuesOfCorner = 5;
  for (const Indices& these : crossed_sets(model, kValuesOfCorner + 1))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (put_one_form_for(model, these, corners(model.geometry, flank))) return true;
  // (two courses that are most at one corner follow a line across it)
  constexpr int kMoreValues = 2;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (model.effects[e].family == find_family("unnamed_crossed") &&
        put_one_form_for(model, {e}, corners(model.geometry, model.effects[e].flank), {},
                         kMoreValues))
      return true;
  return false;
}

bool tell_as_product(PartModel& model) {
  for (const Indices& these : crossed_sets(model, 2))
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
      if (these.size() > 1 && put_one_form_for(model, these, gear_effects::products(flank)))
        return true;
  return false;
}

}  // namespace trueflank::loop
