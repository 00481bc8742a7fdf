// SPDX-License-Identifier: GPL-3.0-or-later
// Names along the flanks that one form without a name says as well: they are told as that form.
#include "trueflank/loop/gear/part/one_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/body/body_forms.h"
#include "trueflank/loop/gear/part/drifts.h"
#include "trueflank/loop/gear/part/fields.h"
#include "trueflank/loop/gear/part/forms_around.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/one_flank.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/products.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/sectors.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/part/waves.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {
constexpr int kValuesOfDish = 5;

/// By how much effects are larger, each by itself, than they are together: squares.
double undo_each_other(const FlankGeometry& geometry, const PointFit& fit,
                       const std::vector<std::size_t>& these) {
  Eigen::VectorXd sum;
  double squares = 0.0;
  for (const std::size_t e : these) {
    const Effect& effect = fit.effects()[e];
    Eigen::VectorXd own =
        over_a_tooth(geometry, effect) *
        fit.coefficients().segment(fit.first_column(static_cast<int>(e)), effect.columns());
    const Eigen::Index flank = own.size() / 2;
    for (const Eigen::Index first : {Eigen::Index{0}, flank})
      own.segment(first, flank).array() -= own.segment(first, flank).mean();
    squares += own.squaredNorm();
    sum = sum.size() == 0 ? own : Eigen::VectorXd(sum + own);
  }
  return squares / sum.squaredNorm();
}

/// Cells in which forms like the last of these are tried in scans: small over what they run along.
FlankCells cells_for(const FlankGeometry& geometry, const std::vector<Effect>& effects) {
  constexpr int kAlong = 600, kBoth = 32;
  constexpr double kShortest = 20.0;  // cells of a wave
  const Effect& form = effects.back();
  if (!form.is_term() || !form.family->same_on_every_tooth ||
      !form.family->same_on_every_tooth(form.shape))
    return {};
  const Runs runs = runs_of(geometry, form, Flanks::kOfEither);
  const bool profile = runs == Runs::kOverProfile;
  if (!profile && runs != Runs::kOverFace)
    return form.columns() == 1 ? FlankCells{kBoth, kBoth} : FlankCells{};
  const double range_mm = profile
                              ? std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm())
                              : geometry.face_width_mm();
  const std::vector<std::string>& names = form.family->shape_names;
  const auto length = std::find(names.begin(), names.end(), "wavelength_mm");
  if (length != names.end() && length - names.begin() < std::ssize(form.shape) &&
      form.shape[static_cast<std::size_t>(length - names.begin())] * kAlong < kShortest * range_mm)
    return {};
  return profile ? FlankCells{kAlong, 1} : FlankCells{1, kAlong};
}

/// Few teeth show a wave over the profile, the same on every tooth, as orders around the gear.
bool tell_as_wave_over_profile(PartModel& model, const std::vector<std::size_t>& over_profile,
                               FlankChoice flank) {
  std::vector<std::size_t> orders;
  double order = 0.0;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (model.effects[e].family->tells_order_along_profile && model.effects[e].flank == flank) {
      orders.push_back(e);
      order = model.effects[e].order();
    }
  if (orders.empty()) return false;
  const std::vector<Effect> waves = waves_of_order(model.geometry, order, flank);
  std::vector<std::size_t> all = orders;
  all.insert(all.end(), over_profile.begin(), over_profile.end());
  std::sort(all.begin(), all.end());
  if (put_one_form_for(model, all, waves) || put_one_form_for(model, orders, waves)) return true;
  if (over_profile.empty()) return false;
  const std::vector<Effect> s_shapes = long_waves(model.geometry, 0.0, flank);
  return put_one_form_for(model, all, s_shapes) ||
         put_one_form_for(model, all, s_shapes, {slope_over(0, flank)});
}

/// One form along the profile (0) or the face (1) beside the slope, or the bow, that has a name,
/// for all that runs that way: an end relief or a bell mouth of a tapered gear, rounded ends of a
/// crowned one.
bool tell_as_form_beside_slope(PartModel& model, const std::vector<std::size_t>& all, int face,
                               FlankChoice flank) {
  constexpr int kValuesOfBoth = 3;
  std::vector<Effect> own;
  std::vector<std::size_t> curved;
  for (const std::size_t e : all) {
    own.push_back(model.effects[e]);
    if (!model.effects[e].family->named || !is_straight(model.geometry, model.effects[e]))
      curved.push_back(e);
  }
  if (curved.empty() || values_of(own, true) < kValuesOfBoth) return false;
  const std::vector<Effect> forms = forms_and_s_along(model.geometry, face, flank);
  if (curved.size() < all.size() && put_one_form_for(model, curved, forms)) return true;
  for (const std::size_t kept : curved) {
    std::vector<std::size_t> others = all;
    std::erase(others, kept);
    if (model.effects[kept].family->named && !others.empty() &&
        put_one_form_for(model, others, forms))
      return true;
  }
  if (curved.size() < all.size()) return false;
  for (const bool straight : {true, false})
    for (const Effect& name : names_along(model, face))
      if (name.flank == flank && is_straight(model.geometry, name) == straight &&
          put_one_form_for(model, all, forms, {name}))
        return true;
  return false;
}

/// A waist beside the slope that has a name, for a kink, that slope and what lifts all flanks:
/// these undo its mean and one of its sides.
bool tell_as_waist_beside_slope(PartModel& model, const std::vector<std::size_t>& along, int face,
                                FlankChoice flank) {
  constexpr double kToBothEnds = 2.0;
  std::vector<std::size_t> these = along, slopes;
  bool kink = false, level = false;
  for (const std::size_t e : along) {
    const Effect& effect = model.effects[e];
    kink = kink || (effect.family == find_family("unnamed_kink") && effect.shape[2] != kToBothEnds);
    if (effect.family->named && is_straight(model.geometry, effect)) slopes.push_back(e);
  }
  for (std::size_t e = first_told_here(model); kink && e < model.effects.size(); ++e)
    if (model.effects[e].flank == flank &&
        runs_of(model.geometry, model.effects[e]) == Runs::kNowhere) {
      these.push_back(e);
      level = true;
    }
  if (!kink || !level || slopes.size() != 1) return false;
  std::sort(these.begin(), these.end());
  std::vector<Effect> rest = without(model.effects, these), waists;
  rest.push_back(model.effects[slopes.front()]);
  for (Effect& roof : roofs_along(model.geometry, face, flank))
    if (roof.shape[2] == kToBothEnds) waists.push_back(std::move(roof));
  const std::vector<Effect> with = with_best_form(model, rest, waists, {});
  if (with.empty() || cost_of(model, with) > cost_of(model, model.effects)) return false;
  put_in_place_of(model, these, with);
  return true;
}

/// A hollow or swelling of these flanks that ends by itself, or with an edge, for these effects.
bool put_dish_for(PartModel& model, const std::vector<std::size_t>& these, FlankChoice flank) {
  for (const char* family : {"unnamed_dish", "unnamed_patch"})
    if (put_one_form_for(model, these, dishes(model.geometry, flank, family))) return true;
  return false;
}

/// A name with a place beside a slope that is opposite on the two flanks, or beside an S, for all
/// that runs along the profile (0) or the face (1).
bool tell_as_name_with_a_place(PartModel& model, int face) {
  constexpr int kFewestValues = 4;
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> all;
  std::vector<Effect> own;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (runs_of(model.geometry, model.effects[e], Flanks::kOfEither) == runs) {
      all.push_back(e);
      own.push_back(model.effects[e]);
    }
  if (all.size() < 2 || values_of(own, true) < kFewestValues) return false;
  std::vector<Effect> names = names_with_shapes(model.geometry, own);
  // It may be a name that is not among them beside a rise at an end.
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (const Effect& name = model.candidates[c];
        name.family->named && name.family->shape_is_continuous && !name.family->shape_is_step &&
        !model.unseen[c] && name.shape.size() == 1 && runs_of(model.geometry, name) == runs)
      names.push_back(name);
  if (names.empty()) return false;
  for (Effect& name : names) name.flank = FlankChoice::kBoth;
  std::stable_sort(names.begin(), names.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  Effect turned = slope_over(face, FlankChoice::kBoth);
  turned.shape.back() = 1.0;
  std::vector<Effect> beside{turned};
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
    beside.push_back(s_over(face, flank));
  for (Effect& form : forms_along(model.geometry, face, FlankChoice::kBoth, false))
    if (form.family == find_family("unnamed_rise") && form.shape[2] != 0.0)
      beside.push_back(std::move(form));
  return std::any_of(beside.begin(), beside.end(), [&](const Effect& form) {
    return std::find(own.begin(), own.end(), form) == own.end() &&
           put_one_form_for(model, all, names, {form});
  });
}

/// A hollow of every flank, for all that is the same on every tooth: waves across the flanks of
/// either side, and levels, were what it is made of.
bool tell_as_dish_of_all_flanks(PartModel& model) {
  std::vector<std::size_t> all, uneven;
  std::vector<Effect> own;
  bool crossed = false, one_flank = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Runs runs = runs_of(model.geometry, model.effects[e]);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(model.effects[e]);
    if (runs != Runs::kNowhere) uneven.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
    one_flank = one_flank || model.effects[e].flank != FlankChoice::kBoth;
  }
  if (!crossed || !(one_flank || uneven.size() < all.size()) ||
      values_of(own, true) < kValuesOfDish)
    return false;
  return put_dish_for(model, all, FlankChoice::kBoth) ||
         (uneven.size() < all.size() && put_dish_for(model, uneven, FlankChoice::kBoth));
}

/// A bent axis, beside an eccentricity or a lean that has a name, for what moves the sections or
/// comes once per turn.
bool tell_as_bow(PartModel& model) {
  std::vector<std::size_t> all;
  bool curved = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const bool moves = effect.family->displacement_mm && effect.columns() == 2;
    const bool form = effect.is_term() && effect.order() == 1.0 && effect.columns() == 2;
    if (effect.flank != FlankChoice::kBoth || !(moves || form)) continue;
    all.push_back(e);
    curved = curved || effect.family->shape_is_step || (form && effect.needs().along_face);
  }
  if (!curved) return false;
  const std::vector<Effect> bows = bows_of_the_axis();
  if (put_one_form_for(model, all, bows)) return true;
  for (const std::size_t kept : all) {
    if (!model.effects[kept].family->named || model.effects[kept].family->shape_is_step) continue;
    std::vector<std::size_t> others = all;
    std::erase(others, kept);
    if (!others.empty() && put_one_form_for(model, others, bows)) return true;
  }
  std::erase_if(all, [&](std::size_t e) {
    return model.effects[e].family->named && !model.effects[e].family->shape_is_step;
  });
  return !all.empty() && put_one_form_for(model, all, bows);
}

/// Squares that some rows of a large scan leave, as those of all rows: the search takes so many;
/// what is chosen is judged by all.
struct SquaresOfSome {
  std::size_t stride = 1;
  double now = 0.0, now_of_some = 0.0;  ///< of the effects as they are

  explicit SquaresOfSome(const PartModel& model)
      : stride(std::max<std::size_t>(1, model.table->rows.size() / kMostRowsSought)) {
    if (stride == 1) return;
    now = fit_of(model, model.effects)->residual_square();
    now_of_some = TrialFit(model.geometry, model.table, model.patches, model.effects, stride)
                      .residual_square();
  }
  [[nodiscard]] double of_all(double square) const {
    return stride == 1 ? square : now + static_cast<double>(stride) * (square - now_of_some);
  }

 private:
  static constexpr std::size_t kMostRowsSought = 100000;
};

}  // namespace

std::vector<Effect> best_form_sought(const PartModel& model, std::vector<Effect> rest,
                                     const std::vector<Effect>& forms, const MostLeft& most) {
  // A kink is nearer to a rise than that is at its first width.
  constexpr std::size_t kFamilies = 3;
  constexpr double kClearly = 25.0;  // chi-square
  const std::size_t at = rest.size();
  struct Best {
    double square = 0.0;
    Effect form;
  };
  std::vector<Best> best;
  rest.emplace_back();
  const SquaresOfSome squares(model);
  std::optional<TrialFit> kept;  // (the next form is put in place of the last one where it can be)
  const auto fit_of_rest = [&]() -> TrialFit& {
    const FlankCells cells = cells_for(model.geometry, rest);
    if (!kept || !kept->put_effect(at, rest.back(), cells))
      kept.emplace(model.geometry, model.table, model.patches, rest, squares.stride, cells);
    return *kept;
  };
  for (std::size_t first = 0, next = 0; first < forms.size(); first = next) {
    const EffectFamily* family = forms[first].family;
    std::vector<EffectShape> shapes;
    for (; next < forms.size() && forms[next].family == family; ++next)
      if (is_within_reach(model, forms[next])) shapes.push_back(forms[next].shape);
    if (shapes.empty()) continue;
    rest.back() = forms[first];
    const std::vector<TrialFit::Trial> trials = fit_of_rest().with_shapes(at, shapes, 1e300);
    Best own{.square = most.on_the_grid};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const double square = squares.of_all(trials[i].square);
      if (trials[i].retained < kToldApart || !(square < own.square)) continue;
      own = {square, forms[first]};
      own.form.shape = shapes[i];
    }
    if (own.form.family != nullptr) best.push_back(std::move(own));
  }
  if (best.empty()) return {};
  std::stable_sort(best.begin(), best.end(),
                   [](const Best& a, const Best& b) { return a.square < b.square; });
  best.resize(std::min(best.size(), kFamilies));
  const auto moves = [](const Effect& form) {
    return form.family->nearby && !form.family->shape_is_continuous;
  };
  const bool in_cells = [&] {
    rest.back() = best.front().form;
    return cells_for(model.geometry, rest).profile > 0;
  }();
  if (in_cells || (best.size() > 1 && model.table->points_mm.empty()))
    for (Best& one : best) {
      if (!moves(one.form)) continue;
      rest.back() = one.form;
      one.square = squares.of_all(move_alone(model.geometry, fit_of_rest(), at, one.form.shape));
    }
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < best.size(); ++i)
    if (best[i].square < best[chosen].square - kClearly) chosen = i;
  const Best& least = best[chosen];
  if (in_cells && moves(least.form) && least.square > most.in_place) return {};
  rest.back() = least.form;
  if (rest.back().family->shape_is_continuous)
    refine_shapes(model.geometry, model.table, model.patches, rest, at);
  else if (model.table->points_mm.empty() && is_refined_by_all_rows(model.table) &&
           kept->put_effect(at, rest.back())) {
    refine_nearby(model.geometry, *kept);
    rest = kept->effects();
  } else
    refine_nearby(model.geometry, model.table, model.patches, rest);
  return rest;
}

std::vector<Effect> with_best_form(const PartModel& model, const std::vector<Effect>& rest,
                                   const std::vector<Effect>& forms, const MostLeft& most) {
  constexpr std::size_t kMostKept = 64;
  const auto known =
      std::find_if(model.sought.rbegin(), model.sought.rend(), [&](const SoughtForm& one) {
        return one.most == most && one.rest == rest && one.forms == forms;
      });
  if (known != model.sought.rend()) return known->found;
  std::vector<Effect> found = best_form_sought(model, rest, forms, most);
  if (model.sought.size() == kMostKept) model.sought.pop_front();
  model.sought.push_back({rest, forms, most, found});
  return found;
}

std::vector<Effect> without(const std::vector<Effect>& effects,
                            const std::vector<std::size_t>& these) {
  std::vector<Effect> others;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) others.push_back(effects[e]);
  return others;
}

void CheapestAnswer::ask(const PartModel& model, std::vector<Effect> with,
                         const std::vector<std::size_t>& of) {
  if (with.empty()) return;
  const double cost = cost_of(model, with);
  if (!(cost < least)) return;
  least = cost;
  effects = std::move(with);
  these = of;
}

std::vector<Effect> one_form_for(const PartModel& model, const std::vector<std::size_t>& these,
                                 const std::vector<Effect>& forms,
                                 const std::vector<Effect>& beside, int more_values) {
  constexpr double kClearly = 9.0, kValue = 6.0;         // chi-square
  constexpr double kNearly = 0.003, kMoreOrLess = 0.01;  // of what they take out
  constexpr double kUndo = 1.5, kMostly = 2.5;
  std::vector<Effect> others, own;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    (std::find(these.begin(), these.end(), e) == these.end() ? others : own)
        .push_back(model.effects[e]);
  std::vector<Effect> tried = forms;
  std::erase_if(tried, [&](const Effect& form) {
    return values_of({form}, true) + values_of(beside, true) > values_of(own, true) + more_values;
  });
  const auto out_of_reach = [&model](const Effect& form) { return !is_within_reach(model, form); };
  if (tried.empty() || std::any_of(beside.begin(), beside.end(), out_of_reach)) return {};
  std::vector<Effect> rest = others;
  rest.insert(rest.end(), beside.begin(), beside.end());
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  // Of those that came to stand for others the best on the grid took out a share of 0.79 and more
  // of what these do, in its place nearly all.
  constexpr double kOnTheGrid = 0.5, kInPlace = 0.9;
  const double now = fit_of(model, model.effects)->residual_square();
  const double none = fit_of(model, others)->residual_square() - now;
  const auto most = [&](double share) {
    return now + kValue * values_of(own, true) + (1.0 - share) * std::max(0.0, none);
  };
  std::vector<Effect> with = with_best_form(
      model, rest, tried, {.on_the_grid = most(kOnTheGrid), .in_place = most(kInPlace)});
  if (with.empty() || (own.size() == 1 && with.back() == own.front()) ||
      is_slope_beside_slope(model.geometry, with))
    return {};
  // A name with a place, found beside other pieces, moves where these do not hold it.
  const Runs runs = runs_of(model.geometry, with.back(), Flanks::kOfEither);
  if (std::any_of(with.begin() + static_cast<std::ptrdiff_t>(first_told_here(model)),
                  with.end() - 1, [&](const Effect& e) {
                    return e.family->named && e.family->shape_is_continuous &&
                           !e.family->shape_is_step && runs_of(model.geometry, e) == runs;
                  }))
    refine_shapes(model.geometry, model.table, model.patches, with, first_told_here(model));
  if (std::any_of(beside.begin(), beside.end(), [](const Effect& e) {
        return e.family->nearby && !e.family->shape_is_continuous;
      }))
    refine_nearby(model.geometry, model.table, model.patches, with);
  if (with.back().family->named &&
      !is_possible(model.geometry, *fit_of(model, with), static_cast<int>(with.size()) - 1))
    return {};
  const int spared =
      values_of(own, true) - values_of({with.back()}, true) - values_of(beside, true);
  if (spared < -more_values) return {};
  const double gain = now - fit_of(model, with)->residual_square();
  // Names that undo each other most of the way are no two causes.
  const double undo = undo_each_other(model.geometry, *fit_of(model, model.effects), these);
  const bool doubtful = spared >= 0 && (undo > kUndo || with.back().family->is_followed_nearly);
  // (where the noise is taken for more than it is, chi-square says little)
  constexpr double kMostLost = 0.1;
  if (with.back().family->is_followed_nearly && -gain > kMostLost * none) return {};
  const double nearly = undo > kMostly ? kMoreOrLess : kNearly;
  const double doubt = doubtful ? std::max(kClearly, nearly * none) : 0.0;
  // A bow with a name that needs a form beside it to follow what rises at both ends is less sure
  // itself.
  const Effect& one = with.back();
  const bool at_both_ends =
      (one.family == find_family("unnamed_rise") || one.family == find_family("unnamed_bend")) &&
      one.shape[2] == 0.0;
  const bool beside_a_form =
      at_both_ends && std::any_of(own.begin(), own.end(), [](const Effect& e) {
        return e.is_term() && e.family->form_word.empty();
      });
  // Several forms without a name prove nothing against one that says the same with fewer values.
  const bool nameless =
      own.size() > 1 && spared > 0 && !with.back().family->named &&
      std::none_of(own.begin(), own.end(), [](const Effect& e) { return e.family->named; });
  const double asked = kClearly - kValue * spared;
  const double least = nameless ? std::min(0.0, asked) : beside_a_form ? -kValue * spared : asked;
  if (gain < least - doubt) return {};
  return with;
}

bool put_one_form_for(PartModel& model, const std::vector<std::size_t>& these,
                      const std::vector<Effect>& forms, const std::vector<Effect>& beside,
                      int more_values) {
  const std::vector<Effect> with = one_form_for(model, these, forms, beside, more_values);
  if (with.empty()) return false;
  put_in_place_of(model, these, with);
  return true;
}

void tell_as_one_form(PartModel& model) {
  if (model.options.joined || model.table->rows.empty()) return;
  const std::size_t told = first_told_here(model);
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  const auto has_name = [&](const std::vector<std::size_t>& set) {
    return std::any_of(set.begin(), set.end(),
                       [&](std::size_t e) { return model.effects[e].family->named; });
  };
  const auto of_set = [&](const std::vector<std::size_t>& set) {
    std::vector<Effect> effects;
    for (const std::size_t e : set) effects.push_back(model.effects[e]);
    return effects;
  };
  const auto values = [&](const std::vector<std::size_t>& set) {
    return values_of(of_set(set), true);
  };
  // One form for a set along the profile (0) or the face (1).
  const auto along_one = [&](const std::vector<std::size_t>& set, int face, FlankChoice flank) {
    if (values(set) < 2) return false;
    if (set.size() > 1) {
      // What all flanks stand out by may hang on these: it is free.
      const std::vector<Effect> names = names_with_shapes(model.geometry, of_set(set));
      if (put_one_form_for(model, set, names) || (is_told_apart(model, level, model.effects) &&
                                                  put_one_form_for(model, set, names, {level})))
        return true;
    }
    std::vector<Effect> forms = forms_along(model.geometry, face, flank, set.size() > 1);
    if (set.size() > 1)
      for (Effect& roof : roofs_along(model.geometry, face, flank))
        forms.push_back(std::move(roof));
    // (A bow and a slope alone are two names, and a sag a little off.)
    constexpr int kValuesOfSag = 3;
    if (values(set) >= kValuesOfSag)
      for (Effect& sag : sags_along(model.geometry, face, flank)) forms.push_back(std::move(sag));
    if (put_one_form_for(model, set, forms)) return true;
    if (set.size() < 2) return false;
    const std::vector<Effect> waves = long_waves(model.geometry, face, flank);
    return put_one_form_for(model, set, waves) ||
           put_one_form_for(model, set, waves, {slope_over(face, flank)});
  };
  const auto once = [&] {
    if (tell_as_moved_part(model) || tell_as_sector(model) || tell_of_the_other_teeth(model) ||
        tell_as_drift(model) || tell_from_nothing(model) || tell_as_form_that_grows_anew(model) ||
        tell_as_drift_aside(model) || tell_as_swellings_at_end(model) || tell_as_repeating(model) ||
        tell_as_views(model) || tell_as_body_wave(model) || tell_as_body_place(model) ||
        tell_as_field(model) || tell_as_facing(model) || tell_as_product(model) ||
        tell_as_swelling_form(model) || tell_as_corner(model) ||
        tell_as_dish_of_all_flanks(model) || tell_as_alternating_wave(model) ||
        tell_as_walking_waves(model) || tell_as_waves_of_both_flanks(model) ||
        tell_as_name_with_a_place(model, 0) || tell_as_name_with_a_place(model, 1))
      return true;
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
      std::array<std::vector<std::size_t>, 2> along;  // profile, face
      std::vector<std::size_t> all_over, with_waves;
      for (std::size_t e = told; e < model.effects.size(); ++e) {
        if (model.effects[e].flank != flank) continue;
        const Runs runs = runs_of(model.geometry, model.effects[e]);
        if (runs == Runs::kOverProfile) along[0].push_back(e);
        if (runs == Runs::kOverFace) along[1].push_back(e);
        if (runs == Runs::kOtherwise || runs == Runs::kNowhere) continue;
        with_waves.push_back(e);
        if (model.effects[e].columns() == 1) all_over.push_back(e);
      }
      const auto whole = [&](std::size_t e) { return model.effects[e].columns() == 1; };
      const std::array<std::ptrdiff_t, 2> straight{
          std::count_if(along[0].begin(), along[0].end(), whole),
          std::count_if(along[1].begin(), along[1].end(), whole)};
      const bool crossed =
          std::ssize(all_over) > straight[0] + straight[1] || (straight[0] > 0 && straight[1] > 0);
      if (tell_as_wave_over_profile(model, along[0], flank)) return true;
      if (crossed && values(all_over) >= kValuesOfDish && put_dish_for(model, all_over, flank))
        return true;
      // (waves across the flank are crossed by themselves)
      if (with_waves.size() > all_over.size() && values(with_waves) >= kValuesOfDish &&
          put_dish_for(model, with_waves, flank))
        return true;
      for (const int face : {0, 1}) {
        const std::vector<std::size_t>& all = along[static_cast<std::size_t>(face)];
        if (tell_as_part_of_a_wave(model, all, face, flank)) return true;
        // Forms alone are asked all at once: a rise towards an end was a kink beside a groove.
        for (const std::vector<std::size_t>& set : all_pairs_and_each(all))
          if ((has_name(set) || (set.size() > 1 && set.size() == all.size())) &&
              along_one(set, face, flank))
            return true;
        if (tell_as_waist_beside_slope(model, all, face, flank) ||
            tell_as_form_beside_slope(model, all, face, flank))
          return true;
      }
    }
    for (const int face : {0, 1})
      if (tell_as_form_of_other_flanks(model, face)) return true;
    return tell_as_bow(model) || tell_as_form_for_a_name(model);
  };
  constexpr int kMost = 10;
  int taken = 0;
  while (taken < kMost && once()) ++taken;
  if (taken > 0) drop_idle_beside_one_form(model);
}

void drop_idle_beside_one_form(PartModel& model) {
  constexpr double kNothing = 9.0;  // chi-square
  while (model.effects.size() > 1) {
    const auto [idle, loss] = least_missed(model, first_told_here(model), model.effects.size(),
                                           [](const Effect& e) { return !e.family->local; });
    if (!(loss < kNothing)) break;
    remove_effect(model, idle);
  }
  // (what is followed nearly leaves small echoes)
  constexpr double kEcho = 0.05, kLittle = 49.0;  // of its size; chi-square: seven errors
  while (model.effects.size() > 1) {
    const auto fit = fit_of(model, model.effects);
    double form_um = 0.0;
    for (std::size_t e = 0; e < model.effects.size(); ++e)
      if (model.effects[e].family->is_followed_nearly)
        form_um = std::max(form_um, fit->effect_size_um(static_cast<int>(e)));
    const auto is_echo = [&](const Effect& effect) {
      const auto e = std::find(model.effects.begin(), model.effects.end(), effect);
      return effect.is_term() &&
             fit->effect_size_um(static_cast<int>(e - model.effects.begin())) < kEcho * form_um;
    };
    const auto [idle, loss] =
        least_missed(model, first_told_here(model), model.effects.size(), is_echo);
    if (!(loss < kLittle)) return;
    remove_effect(model, idle);
  }
}

}  // namespace trueflank::loop
