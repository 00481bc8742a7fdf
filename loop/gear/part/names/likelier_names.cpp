// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of names along the profile or the face: the likeliest is told, those as likely beside it.
#include "trueflank/loop/gear/part/names/settled_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

constexpr double kCostOfValue = 6.0;  // chi-square

/// Names that may run along a direction, by how many of them a set has.
struct NamesAlong {
  std::vector<Effect> plain;                    ///< without a place
  std::vector<std::vector<Effect>> with_place;  ///< of each family, at all its places
};

/// Places at which forms of the answer stand, as shapes of a name over the profile.
std::vector<EffectShape> places_of(const std::vector<Effect>& forms, std::size_t values) {
  std::vector<EffectShape> places;
  for (const Effect& form : forms)
    if ((form.family->is_like_many || form.family == find_family("unnamed_band")) &&
        form.shape.size() > values && form.shape[0] == 0.0)
      places.emplace_back(form.shape.begin() + 1,
                          form.shape.begin() + 1 + static_cast<std::ptrdiff_t>(values));
  return places;
}

NamesAlong names_of_direction(const PartModel& model, int face, const std::vector<Effect>& own) {
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  NamesAlong names;
  for (Effect& name : names_along(model, face)) {
    const auto is_like = [&](const Effect& other) {
      return run_alike(model.geometry, name, other);
    };
    if (name.flank == FlankChoice::kBoth &&
        std::none_of(names.plain.begin(), names.plain.end(), is_like))
      names.plain.push_back(std::move(name));
  }
  std::vector<const EffectFamily*> known;
  for (std::size_t c = 0; c < model.candidates.size(); ++c) {
    const Effect& name = model.candidates[c];
    const EffectFamily& family = *name.family;
    if (!family.named || family.local || !family.shape_is_continuous || family.shape_is_step ||
        model.unseen[c] || name.flank != FlankChoice::kBoth || name.columns() != 1 ||
        std::find(known.begin(), known.end(), &family) != known.end() ||
        runs_of(model.geometry, name) != runs)
      continue;
    known.push_back(&family);
    std::vector<Effect>& of_family = names.with_place.emplace_back();
    for (const EffectShape& shape : family.shapes(model.geometry))
      of_family.push_back({&family, name.flank, shape});
    if (face != 0) continue;
    const std::size_t values = family.shape_names.size();
    for (const EffectShape& place : places_of(own, values))
      if (values == 1 || place[1] > 0.0) of_family.push_back({&family, name.flank, place});
  }
  return names;
}

/// By how much chi-square grows faster with smooth forms than with the number of values: errors
/// that hang together along a trace have more of them, and teeth that differ. From the slopes, bows
/// and so on that every trace has for itself.
double share_of_long_waves(const PartModel& model, const PointFit& fit, ObservationKind kind) {
  constexpr int kForms = 4;
  struct OfTrace {
    std::array<double, kForms + 1> sums{};  // weighted, of the forms; the last of the weights
    std::array<double, kForms> products{}, squares{};
  };
  const auto row_um = fit.residuals_um();
  const auto forms_at = [&](const Place& place) {
    const double x = kind == ObservationKind::kHelix
                         ? model.geometry.face_coordinate(place.z_mm)
                         : model.geometry.profile_coordinate(place.roll_mm);
    const double x2 = x * x;
    return std::array<double, kForms>{x, 1.5 * x2 - 0.5, 2.5 * x2 * x - 1.5 * x,
                                      4.375 * x2 * x2 - 3.75 * x2 + 0.375};
  };
  const auto for_each_value = [&](const auto& visit) {
    for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
      const Observation& row = model.table->rows[i];
      const int patch = model.patches.patch_of_row[i];
      if (row.kind != kind || row.trace < 0 || patch < 0) continue;
      const Patches::Patch& of = model.patches.patches[static_cast<std::size_t>(patch)];
      const Place& place = model.table->place(row);
      visit(std::pair(place.side, row.trace), forms_at(place), of.weight / of.count, (*row_um)[i]);
    }
  };
  std::map<std::pair<int, int>, OfTrace> traces;  // of side and trace
  for_each_value([&](const auto& key, const auto& form, double weight, double) {
    OfTrace& of = traces[key];
    for (int k = 0; k < kForms; ++k) of.sums[k] += weight * form[k];
    of.sums.back() += weight;
  });
  for_each_value([&](const auto& key, const auto& form, double weight, double um) {
    OfTrace& of = traces[key];
    for (int k = 0; k < kForms; ++k) {
      const double own = form[k] - of.sums[k] / of.sums.back();
      of.products[k] += weight * own * um;
      of.squares[k] += weight * own * own;
    }
  });
  double squares = 0.0, degrees = 0.0;
  for (const int side : {1, -1})
    for (int k = 0; k < kForms; ++k) {
      double sum = 0.0, square = 0.0, count = 0.0;
      for (const auto& [key, of] : traces) {
        if (key.first != side || !(of.squares[k] > 0.0)) continue;
        const double size = of.products[k] / std::sqrt(of.squares[k]);
        sum += size;
        square += size * size;
        count += 1.0;
      }
      if (count < 2.0) continue;
      squares += square - sum * sum / count;
      degrees += count - 1.0;
    }
  return degrees > 0.0 ? std::max(1.0, squares / degrees) : 1.0;
}

/// A set of names beside the rest, with places where they fit best.
struct NameSet {
  std::vector<Effect> with;  ///< all effects, the names last
  double cost = 0.0;
};

/// True where every one from the first on is possible and far above its error, all places free.
bool are_sure(const PartModel& model, const std::vector<Effect>& with, std::size_t first) {
  constexpr double kErrors = 4.0, kErrorsOfForm = 2.5;
  const auto fit = fit_of(model, with);
  const Eigen::MatrixXd covariance =
      shape_uncertainty(model.geometry, model.table, model.patches, *fit, FreeShapes::kAll)
          .covariance;
  for (std::size_t e = first; e < with.size(); ++e) {
    const int first_column = fit->first_column(static_cast<int>(e));
    const double errors = with[e].family->named ? kErrors : kErrorsOfForm;
    const double size = fit->coefficients().segment(first_column, with[e].columns()).norm();
    for (int column = first_column; column < first_column + with[e].columns(); ++column)
      if (size < errors * std::sqrt(covariance(column, column)) ||
          fit->retained(column) < kToldApart)
        return false;
    if (!is_possible(model.geometry, *fit, static_cast<int>(e))) return false;
  }
  return true;
}

/// What effects leave, in chi-square as smooth forms count, and how many values those from the
/// first on are told by; a form without a name is less likely.
double cost_of_names(const PartModel& model, const std::vector<Effect>& with, std::size_t first,
                     double share) {
  constexpr double kCostOfForm = 3.0;
  const std::vector<Effect> names(with.begin() + static_cast<std::ptrdiff_t>(first), with.end());
  const bool form =
      std::any_of(names.begin(), names.end(), [](const Effect& e) { return !e.family->named; });
  return fit_of(model, with)->residual_square() / share + kCostOfValue * values_of(names, true) +
         (form ? kCostOfForm : 0.0);
}

/// What these leave of smooth forms along a direction: chi-square that eight polynomials take out.
double left_of_smooth_forms(const PartModel& model, int face, double share) {
  constexpr int kDegrees = 8;
  std::vector<Effect> with = model.effects;
  for (int degree = 1; degree <= kDegrees; ++degree) {
    Effect form = slope_over(face, FlankChoice::kBoth);
    for (const std::size_t along : {0, 1}) form.shape[along] *= degree;
    with.push_back(std::move(form));
  }
  return (fit_of(model, model.effects)->residual_square() -
          fit_of(model, with)->residual_square()) /
         share;
}

/// All sets of one or two of these names, beside the rest; and, where forms are asked too, one of
/// these, alone or beside a name without a place.
std::vector<NameSet> sets_of_names(const PartModel& model, const std::vector<Effect>& rest,
                                   const NamesAlong& names, int face, double share,
                                   bool with_forms) {
  std::vector<NameSet> sets;
  const auto add = [&](std::vector<Effect> with) {
    if (with.size() <= rest.size()) return;
    const double cost = cost_of_names(model, with, rest.size(), share);
    sets.push_back({std::move(with), cost});
  };
  const auto beside = [&](const std::vector<Effect>& others, const std::vector<Effect>& places) {
    std::vector<Effect> with = with_best_form(model, others, places, {});
    if (with.size() > rest.size() + 1 && with[rest.size()].family->shape_is_continuous)
      refine_shapes(model.geometry, model.table, model.patches, with, rest.size());
    return with;
  };
  for (std::size_t a = 0; a < names.plain.size(); ++a) {
    std::vector<Effect> with = rest;
    with.push_back(names.plain[a]);
    add(with);
    for (const std::vector<Effect>& places : names.with_place) add(beside(with, places));
    for (std::size_t b = a + 1; b < names.plain.size(); ++b) {
      with.resize(rest.size() + 1);
      with.push_back(names.plain[b]);
      add(with);
    }
  }
  for (std::size_t a = 0; a < names.with_place.size(); ++a) {
    const std::vector<Effect> with = beside(rest, names.with_place[a]);
    add(with);
    if (with.empty()) continue;
    for (std::size_t b = 0; b < names.with_place.size(); ++b)
      if (b != a) add(beside(with, names.with_place[b]));
  }
  if (!with_forms) return sets;
  std::vector<Effect> forms = forms_along(model.geometry, face, FlankChoice::kBoth, true);
  for (Effect& sag : sags_along(model.geometry, face, FlankChoice::kBoth))
    forms.push_back(std::move(sag));
  Effect s_shape = slope_over(face, FlankChoice::kBoth);
  for (const std::size_t along : {0, 1}) s_shape.shape[along] *= 3.0;
  forms.push_back(std::move(s_shape));
  std::stable_sort(forms.begin(), forms.end(),
                   [](const Effect& a, const Effect& b) { return a.family->id < b.family->id; });
  const std::vector<Effect> waves = long_waves(model.geometry, face, FlankChoice::kBoth);
  std::vector<std::vector<Effect>> beside_forms{rest};
  for (const Effect& name : names.plain) {
    beside_forms.push_back(rest);
    beside_forms.back().push_back(name);
  }
  for (const std::vector<Effect>& others : beside_forms)
    for (const std::vector<Effect>& of : {forms, waves}) add(with_best_form(model, others, of, {}));
  return sets;
}

bool has_name_of(const std::vector<Effect>& effects, std::size_t first,
                 const EffectFamily* family) {
  return std::any_of(effects.begin() + static_cast<std::ptrdiff_t>(first), effects.end(),
                     [&](const Effect& e) { return e.family == family; });
}

/// The candidate that stands for a family in what effects are confounded with; -1: none.
int candidate_of(const PartModel& model, const EffectFamily* family) {
  for (std::size_t c = 0; c < model.candidates.size(); ++c)
    if (model.candidates[c].family == family && !model.unseen[c]) return static_cast<int>(c);
  return -1;
}

/// Names of another set that these do not have are what those of these can be confounded with that
/// it does not have.
void confound(PartModel& model, const std::vector<std::size_t>& these,
              const std::vector<Effect>& other, std::size_t first) {
  for (const std::size_t e : these) {
    if (has_name_of(other, first, model.effects[e].family)) continue;
    for (std::size_t o = first; o < other.size(); ++o) {
      const bool told = std::any_of(these.begin(), these.end(), [&](std::size_t t) {
        return model.effects[t].family == other[o].family;
      });
      const int candidate = candidate_of(model, other[o].family);
      std::vector<int>& like = model.discovery.chosen[e].confounded;
      if (!told && candidate >= 0 && std::find(like.begin(), like.end(), candidate) == like.end())
        like.push_back(candidate);
    }
  }
}

/// How much less names must cost than the names they stand for: clearly less where they need more
/// values, or where a form without a name is among them.
double asked_of(const std::vector<Effect>& own, const std::vector<Effect>& names) {
  constexpr double kSimpler = 3.0, kClearly = 9.0;
  const bool with_form =
      std::any_of(names.begin(), names.end(), [](const Effect& e) { return !e.family->named; });
  return with_form || values_of(names, true) > values_of(own, true) ? kClearly : kSimpler;
}

/// Two names imitate many a form without a name: they stand for as many effects, of as many values.
bool imitates(const std::vector<Effect>& own, const std::vector<Effect>& names) {
  return std::any_of(own.begin(), own.end(), [](const Effect& e) { return !e.family->named; }) &&
         (names.size() > own.size() || values_of(names, true) > values_of(own, true));
}

void tell_likeliest_along(PartModel& model, int face) {
  constexpr double kAlike = 6.0, kWorthForms = 15.0;  // of cost
  const Runs runs = face == 0 ? Runs::kOverProfile : Runs::kOverFace;
  std::vector<std::size_t> these;
  std::vector<Effect> rest;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const EffectFamily& family = *effect.family;
    if (e < first_told_here(model) || effect.flank != FlankChoice::kBoth || effect.columns() != 1 ||
        family.local || family.shape_is_step || effect.order() > 0.0 ||
        runs_of(model.geometry, effect) != runs) {
      rest.push_back(effect);
      // (of what differs from tooth to tooth or between the flanks they may be the mean)
      const NeedsToBeSeen needs = effect.needs();
      if (effect.is_term() && !family.local && (face == 0 ? needs.along_profile : needs.along_face))
        return;
      continue;
    }
    these.push_back(e);
  }
  if (these.empty()) return;
  std::vector<Effect> own;
  for (const std::size_t e : these) own.push_back(model.effects[e]);
  std::vector<Effect> as_told = rest;
  as_told.insert(as_told.end(), own.begin(), own.end());
  const double share =
      share_of_long_waves(model, *fit_of(model, model.effects),
                          face == 0 ? ObservationKind::kProfile : ObservationKind::kHelix);
  const double now = cost_of_names(model, as_told, rest.size(), share);
  std::vector<NameSet> sets =
      sets_of_names(model, rest, names_of_direction(model, face, own), face, share,
                    left_of_smooth_forms(model, face, share) > kWorthForms);
  std::stable_sort(sets.begin(), sets.end(),
                   [](const NameSet& a, const NameSet& b) { return a.cost < b.cost; });
  double cost = now;
  // (where other sets say clearly more, though none of them is sure, it is none of these)
  std::erase_if(sets, [most = (sets.empty() ? 0.0 : sets.front().cost) + kAlike](const NameSet& s) {
    return s.cost > most;
  });
  for (const NameSet& set : sets) {
    const std::vector<Effect> names(set.with.begin() + static_cast<std::ptrdiff_t>(rest.size()),
                                    set.with.end());
    if (imitates(own, names) || set.cost > now - asked_of(own, names) ||
        !are_sure(model, set.with, rest.size()))
      continue;
    constexpr double kStillAlike = 12.0;
    const bool still_alike = now - set.cost < kStillAlike;
    cost = set.cost;
    std::map<const EffectFamily*, std::vector<int>> like;
    for (const std::size_t e : these)
      like[model.effects[e].family] = model.discovery.chosen[e].confounded;
    put_in_place_of(model, these, set.with);
    these.clear();
    for (std::size_t e = rest.size(); e < model.effects.size(); ++e) {
      these.push_back(e);
      // (what the same name could not be told from before, it cannot be now)
      if (const auto known = like.find(model.effects[e].family); known != like.end())
        model.discovery.chosen[e].confounded = known->second;
    }
    if (still_alike) {
      as_told.erase(as_told.begin(), as_told.begin() + static_cast<std::ptrdiff_t>(rest.size()));
      confound(model, these, as_told, 0);
    }
    break;
  }
  for (const NameSet& set : sets)
    if (set.cost < cost + kAlike && are_sure(model, set.with, rest.size()))
      confound(model, these, set.with, rest.size());
}

}  // namespace

void tell_likeliest_names(PartModel& model) {
  // (all teeth of a large gear show by themselves what one after the other finds)
  constexpr std::size_t kMostValues = 40'000;
  if (model.options.joined || !model.table->points_mm.empty() || model.table->rows.empty() ||
      model.table->rows.size() > kMostValues)
    return;
  for (const int face : {0, 1}) tell_likeliest_along(model, face);
}

}  // namespace trueflank::loop
