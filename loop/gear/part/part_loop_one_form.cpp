// SPDX-License-Identifier: GPL-3.0-or-later
// Names along the flanks that one form without a name says as well: they are told as that form.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {

namespace {

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

/// An S over all of the profile (0) or the face (1).
Effect s_over(int face, FlankChoice flank) {
  Effect s_shape = slope_over(face, flank);
  for (const std::size_t along : {0, 1}) s_shape.shape[along] *= 3.0;
  return s_shape;
}

/// Forms along the profile (0) or the face (1), and an S.
std::vector<Effect> forms_and_s_along(const FlankGeometry& geometry, int face, FlankChoice flank) {
  std::vector<Effect> forms = forms_along(geometry, face, flank, true);
  forms.push_back(s_over(face, flank));
  return forms;
}

/// True of what dies away over nearly the whole flank beside a slope: a slope and a bow, told
/// another way.
bool is_slope_beside_slope(const FlankGeometry& geometry, const std::vector<Effect>& with) {
  constexpr double kNearlyAll = 0.7;
  const Effect& rise = with.back();
  if (rise.family != find_family("unnamed_rise")) return false;
  const bool face = rise.shape[0] != 0.0;
  const double range_mm =
      face ? geometry.face_width_mm()
           : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  return rise.shape[1] > kNearlyAll * range_mm &&
         std::any_of(with.begin(), with.end() - 1, [&](const Effect& e) {
           return is_straight(geometry, e) &&
                  runs_of(geometry, e) == (face ? Runs::kOverFace : Runs::kOverProfile);
         });
}

}  // namespace

/// The form that leaves least in place of the last effect: of each family the best by trial, of the
/// best of these each in its place, then beside the others. Empty where all leave too much.
std::vector<Effect> PartLoop::best_form_sought(std::vector<Effect> rest,
                                               const std::vector<Effect>& forms,
                                               const MostLeft& most) const {
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
  for (std::size_t first = 0; first < forms.size();) {
    const EffectFamily* family = forms[first].family;
    std::vector<EffectShape> shapes;
    std::size_t next = first;
    for (; next < forms.size() && forms[next].family == family; ++next)
      if (is_within_reach(forms[next])) shapes.push_back(forms[next].shape);
    rest.back() = forms[first];
    if (shapes.empty()) {
      first = next;
      continue;
    }
    const TrialFit fit(geometry_, table_, patches_, rest, 1, cells_for(geometry_, rest));
    const std::vector<TrialFit::Trial> trials = fit.with_shapes(at, shapes, 1e300);
    Best own{.square = most.on_the_grid};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (trials[i].retained < kToldApart || !(trials[i].square < own.square)) continue;
      own = {trials[i].square, forms[first]};
      own.form.shape = shapes[i];
    }
    if (own.form.family != nullptr) best.push_back(std::move(own));
    first = next;
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
    return cells_for(geometry_, rest).profile > 0;
  }();
  if (in_cells || (best.size() > 1 && table_->points_mm.empty()))
    for (Best& one : best) {
      if (!moves(one.form)) continue;
      rest.back() = one.form;
      const FlankCells cells = cells_for(geometry_, rest);
      const TrialFit fit(geometry_, table_, patches_, rest, 1, cells);
      one.square = move_alone(geometry_, fit, at, one.form.shape);
    }
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < best.size(); ++i)
    if (best[i].square < best[chosen].square - kClearly) chosen = i;
  const Best& least = best[chosen];
  if (in_cells && moves(least.form) && least.square > most.in_place) return {};
  rest.back() = least.form;
  if (rest.back().family->shape_is_continuous)
    refine_shapes(geometry_, table_, patches_, rest, at);
  else
    refine_nearby(geometry_, table_, patches_, rest);
  return rest;
}

/// All others with one of the forms, the last, and what is put beside it in place of these effects:
/// it needs no more values than they do, but for so many, and leaves clearly less; for every value
/// that it spares it may leave a little more, and for each that it needs it must leave less. Empty
/// where none does.
std::vector<Effect> PartLoop::one_form_for(const std::vector<std::size_t>& these,
                                           const std::vector<Effect>& forms,
                                           const std::vector<Effect>& beside,
                                           int more_values) const {
  constexpr double kClearly = 9.0, kValue = 6.0;  // chi-square
  constexpr double kNearly = 0.003, kMoreOrLess = 0.01;  // of what they take out
  constexpr double kUndo = 1.5, kMostly = 2.5;
  std::vector<Effect> others, own;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    (std::find(these.begin(), these.end(), e) == these.end() ? others : own).push_back(effects_[e]);
  std::vector<Effect> tried = forms;
  std::erase_if(tried, [&](const Effect& form) {
    return values_of({form}, true) + values_of(beside, true) > values_of(own, true) + more_values;
  });
  const auto out_of_reach = [this](const Effect& form) { return !is_within_reach(form); };
  if (tried.empty() || std::any_of(beside.begin(), beside.end(), out_of_reach)) return {};
  std::vector<Effect> rest = others;
  rest.insert(rest.end(), beside.begin(), beside.end());
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  // Of those that came to stand for others the best on the grid took out a share of 0.79 and more
  // of what these do, in its place nearly all.
  constexpr double kOnTheGrid = 0.5, kInPlace = 0.9;
  const double now = fit_of(effects_)->residual_square();
  const double none = fit_of(others)->residual_square() - now;
  const auto most = [&](double share) {
    return now + kValue * values_of(own, true) + (1.0 - share) * std::max(0.0, none);
  };
  std::vector<Effect> with =
      with_best_form(rest, tried, {.on_the_grid = most(kOnTheGrid), .in_place = most(kInPlace)});
  if (with.empty() || (own.size() == 1 && with.back() == own.front()) ||
      is_slope_beside_slope(geometry_, with))
    return {};
  // A name with a place, found beside other pieces, moves where these do not hold it.
  const Runs runs = runs_of(geometry_, with.back(), Flanks::kOfEither);
  if (std::any_of(with.begin() + static_cast<std::ptrdiff_t>(first_told_here()), with.end() - 1,
                  [&](const Effect& e) {
                    return e.family->named && e.family->shape_is_continuous &&
                           !e.family->shape_is_step && runs_of(geometry_, e) == runs;
                  }))
    refine_shapes(geometry_, table_, patches_, with, first_told_here());
  if (std::any_of(beside.begin(), beside.end(), [](const Effect& e) {
        return e.family->nearby && !e.family->shape_is_continuous;
      }))
    refine_nearby(geometry_, table_, patches_, with);
  if (with.back().family->named &&
      !is_possible(geometry_, *fit_of(with), static_cast<int>(with.size()) - 1))
    return {};
  const int spared =
      values_of(own, true) - values_of({with.back()}, true) - values_of(beside, true);
  if (spared < -more_values) return {};
  const double gain = now - fit_of(with)->residual_square();
  // Names that undo each other most of the way are no two causes.
  const double undo = undo_each_other(geometry_, *fit_of(effects_), these);
  const bool doubtful = spared >= 0 && (undo > kUndo || with.back().family->is_followed_nearly);
  // (where the noise is taken for more than it is, chi-square says little)
  constexpr double kMostLost = 0.1;
  if (with.back().family->is_followed_nearly && -gain > kMostLost * none) return {};
  const double nearly = undo > kMostly ? kMoreOrLess : kNearly;
  const double doubt = doubtful ? std::max(kClearly, nearly * none) : 0.0;
  // A bow with a name that needs a form beside it to follow what rises at both ends is less sure
  // itself.
  const Effect& one = with.back();
  const bool at_both_ends = (one.family == find_family("unnamed_rise") ||
                             one.family == find_family("unnamed_bend")) &&
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

/// True where one of the forms stands for these effects: it is put in their place.
bool PartLoop::put_one_form_for(const std::vector<std::size_t>& these,
                                const std::vector<Effect>& forms, const std::vector<Effect>& beside,
                                int more_values) {
  const std::vector<Effect> with = one_form_for(these, forms, beside, more_values);
  if (with.empty()) return false;
  put_in_place_of(these, with);
  return true;
}

/// Takes over an answer in which the last effects stand for these.
void PartLoop::put_in_place_of(const std::vector<std::size_t>& these,
                               const std::vector<Effect>& with) {
  ChosenGroup record;
  record.group = -1;
  for (const std::size_t e : these)
    record.p_value = std::min(record.p_value, discovery_.chosen[e].p_value);
  for (std::size_t i = these.size(); i-- > 0;) remove_effect(these[i]);
  // What else has a place beside its own moved with it.
  std::copy_n(with.begin(), effects_.size(), effects_.begin());
  std::copy_n(effects_.begin(), options_.given.size(), options_.given.begin());
  for (std::size_t e = effects_.size(); e < with.size(); ++e) {
    effects_.push_back(with[e]);
    discovery_.chosen.push_back(record);
  }
}

/// Few teeth show a wave over the profile, the same on every tooth, as orders around the gear.
bool PartLoop::tell_as_wave_over_profile(const std::vector<std::size_t>& over_profile,
                                         FlankChoice flank) {
  std::vector<std::size_t> orders;
  double order = 0.0;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e)
    if (effects_[e].family->tells_order_along_profile && effects_[e].flank == flank) {
      orders.push_back(e);
      order = effects_[e].order();
    }
  if (orders.empty()) return false;
  const std::vector<Effect> waves = waves_of_order(geometry_, order, flank);
  std::vector<std::size_t> all = orders;
  all.insert(all.end(), over_profile.begin(), over_profile.end());
  std::sort(all.begin(), all.end());
  if (put_one_form_for(all, waves) || put_one_form_for(orders, waves)) return true;
  if (over_profile.empty()) return false;
  const std::vector<Effect> s_shapes = long_waves(geometry_, 0.0, flank);
  return put_one_form_for(all, s_shapes) || put_one_form_for(all, s_shapes, {slope_over(0, flank)});
}

/// One form along the profile (0) or the face (1) beside the slope, or the bow, that has a name,
/// for all that runs that way: an end relief or a bell mouth of a tapered gear, rounded ends of a
/// crowned one.
bool PartLoop::tell_as_form_beside_slope(const std::vector<std::size_t>& all, int face,
                                         FlankChoice flank) {
  constexpr int kValuesOfBoth = 3;
  std::vector<Effect> own;
  std::vector<std::size_t> curved;
  for (const std::size_t e : all) {
    own.push_back(effects_[e]);
    if (!effects_[e].family->named || !is_straight(geometry_, effects_[e])) curved.push_back(e);
  }
  if (curved.empty() || values_of(own, true) < kValuesOfBoth) return false;
  const std::vector<Effect> forms = forms_and_s_along(geometry_, face, flank);
  if (curved.size() < all.size() && put_one_form_for(curved, forms)) return true;
  for (const std::size_t kept : curved) {
    std::vector<std::size_t> others = all;
    std::erase(others, kept);
    if (effects_[kept].family->named && !others.empty() && put_one_form_for(others, forms))
      return true;
  }
  if (curved.size() < all.size()) return false;
  for (const bool straight : {true, false})
    for (const Effect& name : names_along(face))
      if (name.flank == flank && is_straight(geometry_, name) == straight &&
          put_one_form_for(all, forms, {name}))
        return true;
  return false;
}

/// A hollow or swelling of these flanks that ends by itself, or with an edge, for these effects.
bool PartLoop::put_dish_for(const std::vector<std::size_t>& these, FlankChoice flank) {
  for (const char* family : {"unnamed_dish", "unnamed_patch"})
    if (put_one_form_for(these, dishes(geometry_, flank, family))) return true;
  return false;
}

/// A form of one flank, or of both in opposite directions, along the profile (0) or the face (1),
/// for what runs that way on any flank: slopes that turn the section and bows of either flank were
/// what it is made of. Or waves of one length on either flank, each in a phase of its own.
bool PartLoop::tell_as_form_of_other_flanks(int face) {
  constexpr int kFewestValues = 3, kValuesOfWaves = 6;
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> all, levels;
  bool one_flank = false, both = false, equal = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Runs own = runs_of(geometry_, effects_[e], Flanks::kOfEither);
    const bool on_one = effects_[e].flank != FlankChoice::kBoth;
    if (own == Runs::kNowhere) levels.push_back(e);
    if (own != runs) continue;
    all.push_back(e);
    one_flank = one_flank || on_one;
    const bool opposite = !on_one && runs_of(geometry_, effects_[e]) == Runs::kOtherwise;
    both = both || opposite;
    equal = equal || !(on_one || opposite);
  }
  // What is equal on both flanks and what is opposite on them may leave one of them alone.
  one_flank = one_flank || (both && equal);
  std::vector<Effect> own;
  for (const std::size_t e : all) own.push_back(effects_[e]);
  if (all.size() < 2 || !(one_flank || both) || values_of(own, true) < kFewestValues) return false;
  std::vector<std::vector<std::size_t>> sets{all};
  if (!levels.empty()) {
    sets.insert(sets.begin(), all);
    sets.front().insert(sets.front().end(), levels.begin(), levels.end());
    std::sort(sets.front().begin(), sets.front().end());
  }
  // (beside a form of one flank the others may be one of the other)
  for (const std::size_t e : all)
    if ((effects_[e].family->named || effects_[e].flank != FlankChoice::kBoth) && all.size() > 2) {
      sets.push_back(all);
      std::erase(sets.back(), e);
    }
  std::vector<Effect> opposite;
  for (Effect form : forms_along(geometry_, face, FlankChoice::kBoth, true)) {
    form.shape.push_back(1.0);
    opposite.push_back(std::move(form));
  }
  for (const std::vector<std::size_t>& these : sets) {
    if (put_one_form_for(these, opposite)) return true;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
      if (one_flank && put_one_form_for(these, forms_and_s_along(geometry_, face, flank)))
        return true;
  }
  // Beside a name that these pieces have taken up.
  for (const Effect& name : names_along(face, true)) {
    if (name.flank != FlankChoice::kBoth || std::find(own.begin(), own.end(), name) != own.end())
      continue;
    for (const std::vector<std::size_t>& these : sets)
      for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
        if (one_flank && put_one_form_for(these, forms_and_s_along(geometry_, face, flank), {name}))
          return true;
  }
  if (values_of(own, true) <= kValuesOfWaves) return false;
  for (const Effect& right : long_waves(geometry_, face, FlankChoice::kRight))
    if (put_one_form_for(all, {{right.family, FlankChoice::kLeft, right.shape}}, {right}))
      return true;
  return false;
}

/// A name with a place beside a slope that is opposite on the two flanks, or beside an S, for all
/// that runs along the profile (0) or the face (1).
bool PartLoop::tell_as_name_with_a_place(int face) {
  constexpr int kFewestValues = 4;
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> all;
  std::vector<Effect> own;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e)
    if (runs_of(geometry_, effects_[e], Flanks::kOfEither) == runs) {
      all.push_back(e);
      own.push_back(effects_[e]);
    }
  if (all.size() < 2 || values_of(own, true) < kFewestValues) return false;
  std::vector<Effect> names = names_with_shapes(geometry_, own);
  // What undoes itself may be a name that is not among them beside a rise at an end.
  const bool undo = undo_each_other(geometry_, *fit_of(effects_), all);
  for (std::size_t c = 0; undo && c < candidates_.size(); ++c)
    if (const Effect& name = candidates_[c];
        name.family->named && name.family->shape_is_continuous && !name.family->shape_is_step &&
        !unseen_[c] && name.shape.size() == 1 && runs_of(geometry_, name) == runs)
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
  for (Effect& form : forms_along(geometry_, face, FlankChoice::kBoth, false))
    if (undo && form.family == find_family("unnamed_rise") && form.shape[2] != 0.0)
      beside.push_back(std::move(form));
  return std::any_of(beside.begin(), beside.end(), [&](const Effect& form) {
    return std::find(own.begin(), own.end(), form) == own.end() &&
           put_one_form_for(all, names, {form});
  });
}

/// A hollow of every flank, for all that is the same on every tooth: waves across the flanks of
/// either side, and levels, were what it is made of.
bool PartLoop::tell_as_dish_of_all_flanks() {
  constexpr int kValuesOfDish = 5;
  std::vector<std::size_t> all, uneven;
  std::vector<Effect> own;
  bool crossed = false, one_flank = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Runs runs = runs_of(geometry_, effects_[e]);
    if (runs == Runs::kOtherwise) continue;
    all.push_back(e);
    own.push_back(effects_[e]);
    if (runs != Runs::kNowhere) uneven.push_back(e);
    crossed = crossed || runs == Runs::kOverBoth;
    one_flank = one_flank || effects_[e].flank != FlankChoice::kBoth;
  }
  if (!crossed || !(one_flank || uneven.size() < all.size()) ||
      values_of(own, true) < kValuesOfDish)
    return false;
  return put_dish_for(all, FlankChoice::kBoth) ||
         (uneven.size() < all.size() && put_dish_for(uneven, FlankChoice::kBoth));
}

/// A bent axis, beside an eccentricity or a lean that has a name, for what moves the sections or
/// comes once per turn.
bool PartLoop::tell_as_bow() {
  std::vector<std::size_t> all;
  bool curved = false;
  for (std::size_t e = first_told_here(); e < effects_.size(); ++e) {
    const Effect& effect = effects_[e];
    const bool moves = effect.family->displacement_mm && effect.columns() == 2;
    const bool form = effect.is_term() && effect.order() == 1.0 && effect.columns() == 2;
    if (effect.flank != FlankChoice::kBoth || !(moves || form)) continue;
    all.push_back(e);
    curved = curved || effect.family->shape_is_step || (form && effect.needs().along_face);
  }
  if (!curved) return false;
  const std::vector<Effect> bows = bows_of_the_axis();
  if (put_one_form_for(all, bows)) return true;
  for (const std::size_t kept : all) {
    if (!effects_[kept].family->named || effects_[kept].family->shape_is_step) continue;
    std::vector<std::size_t> others = all;
    std::erase(others, kept);
    if (!others.empty() && put_one_form_for(others, bows)) return true;
  }
  std::erase_if(all, [&](std::size_t e) {
    return effects_[e].family->named && !effects_[e].family->shape_is_step;
  });
  return !all.empty() && put_one_form_for(all, bows);
}

/// Two slopes and bows, or one name with a place and a width, follow many forms: a profile that is
/// thicker at its root alone was a pressure angle and a hollow. A sum in which a name stands is
/// told as one form where that says as much with no more values.
void PartLoop::tell_as_one_form() {
  if (options_.joined || table_->rows.empty()) return;
  const std::size_t told = first_told_here();
  const Effect level{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}};
  const auto has_name = [&](const std::vector<std::size_t>& set) {
    return std::any_of(set.begin(), set.end(),
                       [&](std::size_t e) { return effects_[e].family->named; });
  };
  const auto of_set = [&](const std::vector<std::size_t>& set) {
    std::vector<Effect> effects;
    for (const std::size_t e : set) effects.push_back(effects_[e]);
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
      const std::vector<Effect> names = names_with_shapes(geometry_, of_set(set));
      if (put_one_form_for(set, names) ||
          (is_told_apart(level, effects_) && put_one_form_for(set, names, {level})))
        return true;
    }
    std::vector<Effect> forms = forms_along(geometry_, face, flank, set.size() > 1);
    // (A bow and a slope alone are two names, and a sag a little off.)
    constexpr int kValuesOfSag = 3;
    if (values(set) >= kValuesOfSag)
      for (Effect& sag : sags_along(geometry_, face, flank)) forms.push_back(std::move(sag));
    if (put_one_form_for(set, forms)) return true;
    if (set.size() < 2) return false;
    const std::vector<Effect> waves = long_waves(geometry_, face, flank);
    return put_one_form_for(set, waves) || put_one_form_for(set, waves, {slope_over(face, flank)});
  };
  const auto once = [&] {
    if (tell_as_sector() || tell_as_drift() || tell_as_drift_aside() ||
        tell_as_swellings_at_end() || tell_as_repeating() || tell_as_field() || tell_as_facing() ||
        tell_as_product() || tell_as_corner() || tell_as_dish_of_all_flanks() ||
        tell_as_alternating_wave() || tell_as_walking_waves() || tell_as_name_with_a_place(0) ||
        tell_as_name_with_a_place(1))
      return true;
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
      std::array<std::vector<std::size_t>, 2> along;  // profile, face
      std::vector<std::size_t> all_over, with_waves;
      for (std::size_t e = told; e < effects_.size(); ++e) {
        if (effects_[e].flank != flank) continue;
        const Runs runs = runs_of(geometry_, effects_[e]);
        if (runs == Runs::kOverProfile) along[0].push_back(e);
        if (runs == Runs::kOverFace) along[1].push_back(e);
        if (runs == Runs::kOtherwise || runs == Runs::kNowhere) continue;
        with_waves.push_back(e);
        if (effects_[e].columns() == 1) all_over.push_back(e);
      }
      const auto whole = [&](std::size_t e) { return effects_[e].columns() == 1; };
      const std::array<std::ptrdiff_t, 2> straight{
          std::count_if(along[0].begin(), along[0].end(), whole),
          std::count_if(along[1].begin(), along[1].end(), whole)};
      const bool crossed =
          std::ssize(all_over) > straight[0] + straight[1] || (straight[0] > 0 && straight[1] > 0);
      if (tell_as_wave_over_profile(along[0], flank)) return true;
      constexpr int kValuesOfDish = 5;
      if (crossed && values(all_over) >= kValuesOfDish && put_dish_for(all_over, flank))
        return true;
      // (waves across the flank are crossed by themselves)
      if (with_waves.size() > all_over.size() && values(with_waves) >= kValuesOfDish &&
          put_dish_for(with_waves, flank))
        return true;
      for (const int face : {0, 1}) {
        const std::vector<std::size_t>& all = along[static_cast<std::size_t>(face)];
        if (tell_as_part_of_a_wave(all, face, flank)) return true;
        std::vector<std::vector<std::size_t>> sets;
        if (all.size() > 2) sets.push_back(all);
        for (std::size_t a = 0; a < all.size(); ++a)
          for (std::size_t b = a + 1; b < all.size(); ++b) sets.push_back({all[a], all[b]});
        for (const std::size_t e : all) sets.push_back({e});
        // Forms alone are asked all at once: a rise towards an end was a kink beside a groove.
        for (const std::vector<std::size_t>& set : sets)
          if ((has_name(set) || (set.size() > 1 && set.size() == all.size())) &&
              along_one(set, face, flank))
            return true;
        if (tell_as_form_beside_slope(all, face, flank)) return true;
      }
    }
    for (const int face : {0, 1})
      if (tell_as_form_of_other_flanks(face)) return true;
    return tell_as_bow();
  };
  constexpr int kMost = 6;
  int taken = 0;
  while (taken < kMost && once()) ++taken;
  if (taken > 0) drop_idle_beside_one_form();
}

/// What stood beside several effects and is nothing beside the one form.
void PartLoop::drop_idle_beside_one_form() {
  constexpr double kNothing = 9.0;  // chi-square
  while (effects_.size() > 1) {
    const auto [idle, loss] = least_missed(first_told_here(), effects_.size(),
                                           [](const Effect& e) { return !e.family->local; });
    if (!(loss < kNothing)) return;
    remove_effect(idle);
  }
}

}  // namespace trueflank::loop
