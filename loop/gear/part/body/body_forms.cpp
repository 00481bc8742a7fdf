// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of the body that carries the teeth, by the direction and the height at which a point lies:
// forms of single teeth, sectors, combs and waves around the gear are pieces of them.
#include "trueflank/loop/gear/part/body/body_forms.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/moved_sector.h"
#include "trueflank/loop/gear/part/body/wider_body.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

using gear_effects::FlankCourse;
using Indices = std::vector<std::size_t>;

/// Along what effects run.
struct RunAlong {
  bool profile = false, face = false;
  void operator|=(const RunAlong& other) {
    profile = profile || other.profile;
    face = face || other.face;
  }
};

/// Teeth that a form of some teeth is on, none of one that all have, and along what it runs there.
struct OnTeeth {
  std::set<int> teeth;
  RunAlong along;
};

OnTeeth teeth_under(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kSeen = 0.1;  // of what it is at most
  constexpr int kOfGrid = 9;
  if (effect.columns() != 1 || effect.order() > 0.0) return {};
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  using Grid = Eigen::Array<double, kOfGrid, kOfGrid>;  // profile, face
  std::vector<std::array<Grid, 2>> of_tooth(static_cast<std::size_t>(geometry.teeth()));
  double all = 0.0;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {0, 1}) {
      Grid& grid = of_tooth[static_cast<std::size_t>(tooth - 1)][static_cast<std::size_t>(side)];
      for (int i = 0; i < kOfGrid; ++i)
        for (int k = 0; k < kOfGrid; ++k)
          effect.evaluate(
              geometry,
              geometry.on_flank(tooth, side == 0 ? -1 : 1, low + (i + 0.5) / kOfGrid * (high - low),
                                (k + 0.5) / kOfGrid * geometry.face_width_mm()),
              &grid(i, k));
      all = std::max(all, grid.abs().maxCoeff());
    }
  OnTeeth found;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const Grid& grid : of_tooth[static_cast<std::size_t>(tooth - 1)]) {
      if (!(grid.abs().maxCoeff() > kSeen * all)) continue;
      found.teeth.insert(tooth);
      const Eigen::Array<double, 1, kOfGrid> over_profile =
          grid.colwise().maxCoeff() - grid.colwise().minCoeff();
      const Eigen::Array<double, kOfGrid, 1> over_face =
          grid.rowwise().maxCoeff() - grid.rowwise().minCoeff();
      found.along |= {over_profile.maxCoeff() > kSeen * all, over_face.maxCoeff() > kSeen * all};
    }
  return 2 * std::ssize(found.teeth) > geometry.teeth() ? OnTeeth{} : found;
}

/// Teeth that lie side by side: effects that are on these and on no others, the middle and half
/// their number, and along what all runs that is on them.
struct SideBySide {
  Indices effects;
  double middle = 0.0, half = 0.0;
  RunAlong along;
};

/// Every run of teeth, without gaps of two and more, on which effects stand; and these effects.
std::vector<SideBySide> side_by_side(const PartModel& model, Indices& on_some) {
  const int z = model.geometry.teeth();
  std::vector<OnTeeth> under;
  std::vector<bool> taken(static_cast<std::size_t>(z) + 1);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    OnTeeth of_effect = teeth_under(model.geometry, model.effects[e]);
    if (of_effect.teeth.empty()) continue;
    for (const int tooth : of_effect.teeth) taken[static_cast<std::size_t>(tooth)] = true;
    on_some.push_back(e);
    under.push_back(std::move(of_effect));
  }
  const auto is_taken = [&](int tooth) {
    return static_cast<bool>(taken[static_cast<std::size_t>((tooth + 2 * z - 1) % z + 1)]);
  };
  std::vector<SideBySide> found;
  for (int first = 1; first <= z; ++first) {
    if (!is_taken(first) || is_taken(first - 1) || is_taken(first - 2)) continue;
    int last = first;
    while (last < first + z && (is_taken(last + 1) || is_taken(last + 2))) ++last;
    SideBySide run{{}, 0.5 * (first + last), 0.5 * (last - first + 1), {}};
    for (std::size_t i = 0; i < under.size(); ++i) {
      const std::set<int>& teeth = under[i].teeth;
      const auto here = std::count_if(teeth.begin(), teeth.end(), [&](int tooth) {
        return (tooth - first + z) % z <= last - first;
      });
      if (here == std::ssize(teeth)) run.effects.push_back(on_some[i]);
      if (here > 0) run.along |= under[i].along;
    }
    found.push_back(std::move(run));
  }
  return found;
}

bool is_evenly_spaced(const std::vector<SideBySide>& runs, int teeth) {
  constexpr double kNearly = 1.5;  // teeth
  if (runs.size() < 2 || runs.size() > std::size_t{kMostSwellings}) return false;
  const double apart = static_cast<double>(teeth) / static_cast<double>(runs.size());
  return std::all_of(runs.begin() + 1, runs.end(), [&](const SideBySide& run) {
    return std::abs(std::remainder(run.middle - runs.front().middle, apart)) < kNearly;
  });
}

/// What one flank has is no form of the body.
bool are_on_both_flanks(const PartModel& model, const Indices& effects) {
  const auto on = [&](FlankChoice flank) {
    return std::any_of(effects.begin(), effects.end(), [&](std::size_t e) {
      return model.effects[e].flank == flank || model.effects[e].flank == FlankChoice::kBoth;
    });
  };
  return on(FlankChoice::kLeft) && on(FlankChoice::kRight);
}

Effect body_place(double number, double radial, double at_deg, double half_deg,
                  const FlankCourse& profile = {}, const FlankCourse& face = {}) {
  constexpr std::size_t kProfile = 4, kFace = kProfile + FlankCourse::kValues;
  EffectShape shape{number, radial, at_deg, half_deg};
  shape.resize(kFace + FlankCourse::kValues + 1);  // (the last: how it dies away around the gear)
  profile.put_in(shape, kProfile);
  face.put_in(shape, kFace);
  return {find_family("unnamed_body_place"), FlankChoice::kBoth, std::move(shape)};
}

/// Places of the body to be sought.
struct PlacesAsked {
  double number = 1.0;  ///< evenly spaced
  std::vector<double> at_deg, half_deg;
  RunAlong along;
};

/// Beside these effects: the best place all over the flanks, then with a course over the profile
/// or the face about there. Each answer ends with its place.
std::vector<std::vector<Effect>> with_places(const PartModel& model,
                                             const std::vector<Effect>& others,
                                             const PlacesAsked& asked) {
  std::vector<std::vector<Effect>> found;
  const auto seek = [&](const std::vector<Effect>& forms) {
    if (std::vector<Effect> with = with_best_form(model, others, forms, {}); !with.empty())
      found.push_back(std::move(with));
  };
  std::vector<Effect> forms;
  // (at one height of the profile both say the same)
  for (const double radial :
       has_single_values_only(model) ? std::vector{0.0} : std::vector{0.0, 1.0})
    for (const double half : asked.half_deg)
      for (const double at : asked.at_deg)
        forms.push_back(body_place(asked.number, radial, at, half));
  seek(forms);
  if (found.empty()) return found;
  const EffectShape best = found.front().back().shape;
  // Edges by themselves: before they are moved to their places a step may come nearer to a bump
  // than any bump does.
  const auto about_there = [&](double face, bool edges) {
    forms.clear();
    for (const FlankCourse& course : coarse_courses(model.geometry, face))
      if ((course.kind == FlankCourse::kStep) == edges)
        for (const double radial : {0.0, 1.0})
          for (const double times : {0.7, 1.0})
            forms.push_back(
                face == 0.0 ? body_place(best[0], radial, best[2], times * best[3], course)
                            : body_place(best[0], radial, best[2], times * best[3], {}, course));
    if (!forms.empty()) seek(forms);
  };
  if (asked.along.profile) about_there(0.0, false);
  if (asked.along.face)
    for (const bool edges : {false, true}) about_there(1.0, edges);
  return found;
}

/// The answer that tells these effects as places of the body: of those that may stand for them the
/// one that costs least; empty where none may.
std::vector<Effect> told_as_places(const PartModel& model, const Indices& these,
                                   const PlacesAsked& asked, int more_values) {
  std::vector<Effect> others, best;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) others.push_back(model.effects[e]);
  double least = kNaN;
  for (const std::vector<Effect>& place : with_places(model, others, asked)) {
    std::vector<Effect> with = one_form_for(model, these, {place.back()}, {}, more_values);
    if (with.empty()) continue;
    const double cost = cost_of(model, with);
    if (cost >= least) continue;
    least = cost;
    best = std::move(with);
  }
  return best;
}

/// Where to begin a place of teeth that lie side by side.
PlacesAsked place_of(const FlankGeometry& geometry, const SideBySide& run) {
  constexpr double kNarrowest = 0.5, kWidest_deg = 60.0;  // teeth
  const double pitch_deg = 360.0 / geometry.teeth();
  PlacesAsked asked{.along = run.along};
  for (const double times : {0.5, 0.8, 1.2}) {
    const double half = std::max(kNarrowest, times * run.half) * pitch_deg;
    asked.half_deg.push_back(std::min(kWidest_deg, half));
  }
  for (const double off : {-0.5, -0.25, 0.0, 0.25, 0.5})
    asked.at_deg.push_back((run.middle - 1.0 + off * run.half) * pitch_deg);
  return asked;
}

/// Of teeth that lie side by side.
bool tell_as_one_place(PartModel& model, const std::vector<SideBySide>& runs) {
  // (the first tooth of a sector and their number are sought as a place and a width are)
  constexpr int kMoreValues = 2;
  for (const SideBySide& run : runs) {
    Indices nameless = run.effects;
    std::erase_if(nameless, [&](std::size_t e) { return model.effects[e].family->named; });
    if (nameless.empty() || !are_on_both_flanks(model, nameless) ||
        (run.effects.size() == 1 &&
         model.effects[run.effects.front()].family == find_family("unnamed_body_place")))
      continue;
    const PlacesAsked asked = place_of(model.geometry, run);
    for (const Indices* these : {&run.effects, static_cast<const Indices*>(&nameless)}) {
      if (these == &nameless && nameless.size() == run.effects.size()) break;
      const std::vector<Effect> with = told_as_places(model, *these, asked, kMoreValues);
      if (with.empty()) continue;
      put_in_place_of(model, *these, with);
      return true;
    }
  }
  return false;
}

/// True where these places, one after the other, stand for these effects: they are put in their
/// place.
bool put_places_for(PartModel& model, const Indices& these,
                    const std::vector<PlacesAsked>& places) {
  constexpr double kClearly = 9.0;  // chi-square
  constexpr int kMoreOfEach = 2;    // values, as of one place
  std::vector<Effect> with;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) with.push_back(model.effects[e]);
  for (const PlacesAsked& asked : places) {
    std::vector<std::vector<Effect>> answers = with_places(model, with, asked);
    if (answers.empty()) return false;
    with = std::move(*std::min_element(
        answers.begin(), answers.end(),
        [&](const auto& a, const auto& b) { return cost_of(model, a) < cost_of(model, b); }));
  }
  refine_nearby(model.geometry, model.table, model.patches, with);
  if (values_of(with, true) >
          values_of(model.effects, true) + kMoreOfEach * static_cast<int>(places.size()) ||
      cost_of(model, with) > cost_of(model, model.effects) - kClearly)
    return false;
  put_in_place_of(model, these, with);
  return true;
}

/// Each run of teeth a place, where an effect is on several of them: a comb that some places happen
/// to fall on.
bool tell_as_several_places(PartModel& model, const std::vector<SideBySide>& runs,
                            const Indices& on_some) {
  constexpr std::size_t kMost = 8;
  std::size_t of_runs = 0;
  for (const SideBySide& run : runs) of_runs += run.effects.size();
  if (runs.size() < 2 || runs.size() > kMost || of_runs == on_some.size() ||
      !are_on_both_flanks(model, on_some))
    return false;
  std::vector<PlacesAsked> places;
  for (const SideBySide& run : runs) places.push_back(place_of(model.geometry, run));
  return put_places_for(model, on_some, places);
}

/// Up to three places anywhere, for what goes around the gear in several ways, with what is the
/// same on every tooth or without: wide places, and places of unequal depth, are such sums.
bool tell_as_few_places(PartModel& model, const Indices& on_some) {
  constexpr std::size_t kMostPlaces = 3, kFewest = 2;
  Indices around = on_some, names, alike;
  bool told_as_place = true;
  PlacesAsked anywhere;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth || effect.family->tells_order_along_profile) continue;
    if (runs_of(model.geometry, effect) != Runs::kOtherwise) {
      alike.push_back(e);
      continue;
    }
    if (std::find(on_some.begin(), on_some.end(), e) != on_some.end()) continue;
    (effect.family->named && effect.order() <= 1.0 ? names : around).push_back(e);
  }
  for (const std::size_t e : around)
    told_as_place = told_as_place && model.effects[e].family == find_family("unnamed_body_place") &&
                    model.effects[e].shape[0] == 1.0;
  if (around.empty() || told_as_place || around.size() + names.size() < kFewest) return false;
  for (double half = std::max(8.0, 270.0 / model.geometry.teeth()); half < 75.0; half *= 1.7)
    anywhere.half_deg.push_back(half);
  for (double at = 0.0; at < 360.0; at += 12.0) anywhere.at_deg.push_back(at);
  std::vector<Indices> sets;
  for (const Indices& more : {Indices(), names, alike}) {
    if (!sets.empty() && more.empty()) continue;
    sets.push_back(around);
    sets.back().insert(sets.back().end(), more.begin(), more.end());
  }
  if (sets.size() > 2) {
    sets.push_back(sets[1]);
    sets.back().insert(sets.back().end(), alike.begin(), alike.end());
  }
  std::reverse(sets.begin(), sets.end());  // the most first
  for (Indices& these : sets) {
    std::sort(these.begin(), these.end());
    if (these.size() < kFewest) continue;
    for (std::size_t places = 1; places <= kMostPlaces; ++places)
      if (put_places_for(model, these, std::vector(places, anywhere))) return true;
  }
  return false;
}

/// Evenly spaced, for waves around the gear of an order and its multiples and for forms of teeth
/// that lie so, with what is the same on every tooth, or without.
bool tell_as_places_around(PartModel& model, const std::vector<SideBySide>& runs,
                           const Indices& on_some) {
  constexpr std::size_t kFewest = 2;
  Indices waves, alike;
  double largest_um = 0.0, largest = 0.0;  // wave, and its order
  RunAlong along;
  const auto fit = fit_of(model, model.effects);
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (is_wave_around(effect) && effect.columns() == 2) {
      if (!(effect.order() > 1.0) || effect.order() != std::floor(effect.order())) continue;
      waves.push_back(e);
      if (const double um = fit->effect_size_um(static_cast<int>(e)); um > largest_um) {
        largest_um = um;
        largest = effect.order();
      }
      along |= {effect.needs().along_profile, effect.needs().along_face};
    } else if (runs_of(model.geometry, effect) != Runs::kOtherwise) {
      alike.push_back(e);
      along |= {effect.needs().along_profile, effect.needs().along_face};
    }
  }
  for (const SideBySide& run : runs) along |= run.along;
  const auto is_of = [&](int number) {
    return [&model, number](std::size_t e) {
      return std::remainder(model.effects[e].order(), number) == 0.0;
    };
  };
  // (a wave and its mean, along the face: a squared cosine)
  const auto has_mean = [&](int number) {
    return along.face && !alike.empty() && largest == double(number);
  };
  const int z = model.geometry.teeth();
  std::set<int> numbers;
  if (is_evenly_spaced(runs, z)) numbers.insert(static_cast<int>(runs.size()));
  for (int number = 2; number <= kMostSwellings; ++number)
    if (largest > 0.0 && std::remainder(largest, number) == 0.0 &&
        std::count_if(waves.begin(), waves.end(), is_of(number)) + (has_mean(number) ? 1 : 0) >=
            std::ptrdiff_t{kFewest})
      numbers.insert(number);
  const double pitch_deg = 360.0 / z;
  for (const int number : numbers) {
    PlacesAsked asked{.number = static_cast<double>(number), .along = along};
    const double apart_deg = 360.0 / number;
    for (double half = std::max(0.5 * pitch_deg, 0.06 * apart_deg); half < 0.35 * apart_deg;
         half *= 1.6)
      asked.half_deg.push_back(half);
    if (asked.half_deg.empty()) continue;
    for (double at = 0.0; at < apart_deg; at += 0.6 * asked.half_deg.front())
      asked.at_deg.push_back(at);
    Indices around = on_some;
    std::copy_if(waves.begin(), waves.end(), std::back_inserter(around), is_of(number));
    Indices all = around;
    all.insert(all.end(), alike.begin(), alike.end());
    for (Indices* these : {&all, &around}) {
      if (these->size() < kFewest || (these == &around && alike.empty())) continue;
      std::sort(these->begin(), these->end());
      const std::vector<Effect> with = told_as_places(model, *these, asked, 0);
      if (with.empty()) continue;
      put_in_place_of(model, *these, with);
      return true;
    }
  }
  return false;
}

std::vector<Effect> body_waves(double order, double radial,
                               const std::vector<FlankCourse>& courses) {
  constexpr std::size_t kFace = 2;
  std::vector<Effect> forms;
  for (const FlankCourse& course : courses) {
    EffectShape shape{order, radial};
    shape.resize(kFace + FlankCourse::kValues + 1);  // (the last: by how much it turns)
    course.put_in(shape, kFace);
    forms.push_back({find_family("unnamed_body_wave"), FlankChoice::kBoth, std::move(shape)});
  }
  return forms;
}

/// Whose crests turn with the height, as of a body that twists while it is out of round, beside
/// those along a part of it.
std::vector<Effect> body_waves_by_height(const FlankGeometry& geometry, double order) {
  constexpr double kLeast_deg = 40.0, kMost_deg = 320.0;  // of a wave
  std::vector<Effect> forms = body_waves(order, 1.0, coarse_courses(geometry, 1.0));
  const Effect whole = body_waves(order, 1.0, {{}}).front();
  for (double turns = kLeast_deg; turns <= kMost_deg; turns += kLeast_deg)
    for (const double sign : {-1.0, 1.0}) {
      forms.push_back(whole);
      forms.back().shape.back() = sign * turns / order;
    }
  return forms;
}

/// For all of these, or all but one: that may be a thing of its own, a name, a small lean.
bool tell_as_wave_of(PartModel& model, const Indices& all, const std::vector<Effect>& forms) {
  constexpr std::size_t kFewest = 2;
  if (put_one_form_for(model, all, forms)) return true;
  for (const std::size_t kept : all) {
    Indices others = all;
    std::erase(others, kept);
    if (others.size() >= kFewest && put_one_form_for(model, others, forms)) return true;
  }
  return false;
}

/// A body that is wider along a part of its height, for forms over the face without a name and the
/// lean of the profiles that goes with it: a radius is worth more at the tip.
bool tell_as_wider_part(PartModel& model) {
  Indices these;
  bool nameless = false, leans = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth) continue;
    const Runs runs = runs_of(model.geometry, effect);
    if (runs == Runs::kOverBoth && !effect.family->named && effect.columns() == 1) {
      these.push_back(e);
      nameless = leans = true;
    } else if (runs == Runs::kOverFace && !effect.family->named) {
      these.push_back(e);
      nameless = true;
    } else if (runs == Runs::kOverProfile && is_straight(model.geometry, effect)) {
      these.push_back(e);
      leans = true;
    }
  }
  if (!nameless || !leans) return false;
  return put_one_form_for(model, these, body_waves(0.0, 1.0, courses_of_a_width(model.geometry)));
}

}  // namespace

std::vector<FlankCourse> coarse_courses(const FlankGeometry& geometry, double face) {
  const double range = std::abs(gear_effects::range_mm(geometry, face));
  std::vector<FlankCourse> courses;
  for (const double towards : {-1.0, 1.0}) {
    for (const double length : {1.0, 0.75, 0.5, 0.25})
      for (const FlankCourse::Kind kind : {FlankCourse::kKink, FlankCourse::kBend})
        courses.push_back(
            {kind, gear_effects::place_at(geometry, face, towards > 0.0 ? 1.0 - length : length),
             towards});
    for (const double within : {0.06, 0.12, 0.25})
      courses.push_back({FlankCourse::kRise, within * range, towards});
  }
  for (const double share : {0.15, 0.38, 0.62, 0.85})
    for (const double half : {0.1, 0.2})
      courses.push_back(
          {FlankCourse::kBand, gear_effects::place_at(geometry, face, share), 0.0, half * range});
  // What holds a part of the face ends at an edge.
  constexpr double kSharp = 0.0, kSoft = 0.04, kSofter = 0.12;
  for (const double share : {0.12, 0.25, 0.38, 0.5, 0.62, 0.75, 0.88})
    for (const double towards : {-1.0, 1.0})
      for (const double half : {kSharp, kSoft, kSofter})
        if (face == 1.0)
          courses.push_back({FlankCourse::kStep, gear_effects::place_at(geometry, face, share),
                             towards, half * range});
  return courses;
}

std::vector<FlankCourse> courses_of_a_width(const FlankGeometry& geometry) {
  std::vector<FlankCourse> courses = coarse_courses(geometry, 1.0);
  for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8})  // a waist
    courses.push_back({FlankCourse::kVee, gear_effects::place_at(geometry, 1.0, share)});
  return courses;
}

std::vector<Effect> wider_bodies(const std::vector<FlankCourse>& courses) {
  constexpr double kWithLands = 3.0;
  return body_waves(0.0, kWithLands, courses);
}

bool tell_as_views(PartModel& model) {
  constexpr int kMostMore = 9;       // values
  constexpr double kClearly = 25.0;  // chi-square
  if (model.table->points_mm.empty()) return false;
  Indices all, names;
  bool around = false, nameless = false;  // (names alone are simpler than lists of values)
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const Runs runs = runs_of(model.geometry, effect, Flanks::kOfEither);
    const bool scales = effect.family->displacement_mm && effect.columns() == 1;
    if (effect.family->tells_order_along_profile || effect.family == find_family("unnamed_views") ||
        effect.family == find_family("unnamed_spiral") ||
        !(runs == Runs::kOtherwise || runs == Runs::kNowhere || scales))
      continue;
    all.push_back(e);
    around = around || runs == Runs::kOtherwise;
    nameless = nameless || !effect.family->named;
    if (moves_the_teeth(effect)) names.push_back(e);
  }
  if (!around || !nameless || all.size() < 2) return false;
  CheapestAnswer best{.least = cost_of(model, model.effects)};
  for (const Indices& set : with_and_without(all, names)) {
    if (set.size() < 2) continue;
    const auto fit = fit_of(model, without(model.effects, set));
    for (const Effect& form :
         views_and_spirals(model.geometry, model.table, model.patches, *fit->residuals_um())) {
      std::vector<Effect> with = one_form_for(model, set, {form}, {}, kMostMore);
      // (more views follow what fewer do, and a little of the error)
      if (!with.empty() && cost_of(model, with) < best.least - kClearly)
        best.ask(model, std::move(with), set);
    }
  }
  if (best.effects.empty()) return false;
  put_in_place_of(model, best.these, best.effects);
  return true;
}

bool tell_as_body_wave(PartModel& model) {
  if (tell_as_wider_body(model)) return true;
  std::map<double, Indices> of_order;
  std::set<double> over_face;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const double order = moves_the_teeth(effect) ? 1.0 : effect.order();
    if (effect.columns() != 2 || order == 0.0 || effect.family->tells_order_along_profile ||
        effect.family == find_family("unnamed_body_wave"))
      continue;
    of_order[order].push_back(e);
    if (effect.needs().along_face) over_face.insert(order);
  }
  for (const double order : over_face)
    if (order > 1.0 &&
        tell_as_wave_of(model, of_order[order], body_waves_by_height(model.geometry, order)))
      return true;
  const bool is_helical = model.geometry.normal_z(model.geometry.on_flank(
                              1, 1, model.geometry.root_form_roll_mm(), 0.0)) != 0.0;
  for (const auto& [order, all] : of_order)
    for (const double moves : {0.0, 2.0})  // along the normals, along the axis
      if (all.size() > 1 && (moves == 0.0 || is_helical) &&
          put_one_form_for(model, all, body_waves(order, moves, {{}})))
        return true;
  return tell_as_wider_part(model);
}

bool tell_as_body_place(PartModel& model) {
  Indices on_some;
  const std::vector<SideBySide> runs = side_by_side(model, on_some);
  return tell_as_places_around(model, runs, on_some) || tell_as_one_place(model, runs) ||
         tell_as_several_places(model, runs, on_some) || tell_as_few_places(model, on_some);
}

}  // namespace trueflank::loop
