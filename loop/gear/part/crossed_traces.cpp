// SPDX-License-Identifier: GPL-3.0-or-later
// Forms along traces that grow, or begin, from trace to trace of a flank: profiles at several
// heights, leads at several diameters, and that come and go. What they have in the mean was told as
// a form, or a name, alike all over.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/products.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {
namespace {

using gear_effects::FlankCourse;

/// Whether profiles (0) were traced at heights, and leads (1) at diameters, that lie far apart.
std::array<bool, 2> are_traced_apart(const PartModel& model) {
  constexpr double kApart = 0.4;  // of half the way from end to end
  std::array<double, 2> least{1e300, 1e300}, most{-1e300, -1e300};
  for (const Patches::Patch& patch : model.patches.patches) {
    const bool profile = patch.kind == ObservationKind::kProfile;
    if (!profile && patch.kind != ObservationKind::kHelix) continue;
    const Place& place = patch.places.front().place;
    const double at = profile ? model.geometry.face_coordinate(place.z_mm)
                              : model.geometry.profile_coordinate(place.roll_mm);
    least[profile ? 0 : 1] = std::min(least[profile ? 0 : 1], at);
    most[profile ? 0 : 1] = std::max(most[profile ? 0 : 1], at);
  }
  return {most[0] - least[0] > kApart, most[1] - least[1] > kApart};
}

/// Half way between neighbouring heights of profiles (0), or diameters of leads (1), as places
/// there: some, evenly among them.
std::vector<double> between_traces(const PartModel& model, int along) {
  constexpr std::size_t kMost = 8;
  constexpr double kSame = 0.05;  // of half the way from end to end
  const FlankGeometry& geometry = model.geometry;
  const auto other = static_cast<double>(1 - along);
  std::set<double> shares;
  for (const Patches::Patch& patch : model.patches.patches) {
    if (patch.kind != (along == 0 ? ObservationKind::kProfile : ObservationKind::kHelix)) continue;
    const Place& place = patch.places.front().place;
    const double end = gear_effects::end_mm(geometry, other, -1.0),
                 at = along == 0 ? place.z_mm : place.roll_mm;
    const double share = (at - end) / gear_effects::range_mm(geometry, other);
    const auto next = shares.lower_bound(share - kSame);
    if (next == shares.end() || *next > share + kSame) shares.insert(share);
  }
  std::vector<double> places;
  for (auto it = shares.begin(); !shares.empty() && std::next(it) != shares.end(); ++it)
    places.push_back(gear_effects::place_at(geometry, other, 0.5 * (*it + *std::next(it))));
  std::vector<double> some;
  for (std::size_t k = 0; k < std::min(kMost, places.size()); ++k)
    some.push_back(places[k * places.size() / std::min(kMost, places.size())]);
  return some;
}

/// Courses over the profile (0) or the face (1), of which there is nothing at one end of the other
/// direction and evenly more towards the other, or all from one of these places on.
std::vector<Effect> growing_courses(const FlankGeometry& geometry, int along, FlankChoice flank,
                                    const std::vector<double>& places) {
  const auto other = static_cast<double>(1 - along);
  std::vector<FlankCourse> growths;
  for (const double towards : {-1.0, 1.0}) {
    growths.push_back({FlankCourse::kKink,
                       gear_effects::place_at(geometry, other, towards > 0.0 ? 0.0 : 1.0),
                       towards});
    for (const double place : places) growths.push_back({FlankCourse::kStep, place, towards});
  }
  std::vector<Effect> forms;
  for (const FlankCourse& course : gear_effects::courses_over(geometry, along))
    for (const FlankCourse& growth : growths) {
      EffectShape shape(2 * FlankCourse::kValues + 1);
      course.put_in(shape, along == 0 ? 0 : FlankCourse::kValues);
      growth.put_in(shape, along == 0 ? FlankCourse::kValues : 0);
      forms.push_back({find_family("unnamed_crossed"), flank, std::move(shape)});
    }
  return forms;
}

/// Forms along one direction times what comes and goes in the other one in waves of a length.
std::vector<Effect> swelling_courses(const FlankGeometry& geometry, const FlankCourse& course,
                                     int along, double length_mm, FlankChoice flank) {
  constexpr double kPhases = 8.0;
  const auto other = static_cast<double>(1 - along);
  std::vector<Effect> forms;
  for (double phase = 0.0; phase < kPhases; phase += 1.0) {
    const double share = length_mm / std::abs(gear_effects::range_mm(geometry, other));
    const FlankCourse swells{FlankCourse::kSwells,
                             gear_effects::place_at(geometry, other, phase / kPhases * share), 0.0,
                             0.5 * length_mm};
    EffectShape shape(2 * FlankCourse::kValues + 1);
    course.put_in(shape, along == 0 ? 0 : FlankCourse::kValues);
    swells.put_in(shape, along == 0 ? FlankCourse::kValues : 0);
    forms.push_back({find_family("unnamed_crossed"), flank, std::move(shape)});
  }
  return forms;
}

}  // namespace

bool tell_as_swelling_form(PartModel& model) {
  constexpr std::size_t kAcross = 2;
  for (std::size_t w = first_told_here(model); w < model.effects.size(); ++w) {
    const Effect& waves = model.effects[w];
    if (waves.family != find_family("unnamed_crossed_waves")) continue;
    const FlankCourse course = FlankCourse::at(waves.shape, kAcross);
    const int along = waves.shape[0] != 0.0 ? 0 : 1;
    if (course.kind == FlankCourse::kWhole) continue;
    const Runs runs = along == 0 ? Runs::kOverProfile : Runs::kOverFace;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const Effect& mean = model.effects[e];
      // (a name with a place, too, may be the mean)
      const bool name = mean.family->named && !mean.family->shape_is_continuous;
      if (e == w || name || mean.flank != waves.flank || mean.columns() != 1 ||
          runs_of(model.geometry, mean, Flanks::kOfEither) != runs)
        continue;
      if (put_one_form_for(
              model, {std::min(e, w), std::max(e, w)},
              swelling_courses(model.geometry, course, along, waves.shape[1], waves.flank)))
        return true;
    }
  }
  return false;
}

std::vector<Effect> with_form_growing_across(const PartModel& model,
                                             std::vector<std::size_t>& these) {
  constexpr double kClearly = 25.0;  // chi-square
  constexpr int kMoreValues = 2;
  if (!model.table->points_mm.empty() || model.options.joined) return {};
  const std::array<bool, 2> apart = are_traced_apart(model);
  if (!apart[0] && !apart[1]) return {};
  CheapestAnswer best{.least = cost_of(model, model.effects) - kClearly};
  for (const int along : {0, 1}) {
    if (!apart[static_cast<std::size_t>(along)]) continue;
    const Runs runs = along == 0 ? Runs::kOverProfile : Runs::kOverFace;
    std::vector<std::size_t> all, with_orders;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const bool runs_here = runs_of(model.geometry, model.effects[e], Flanks::kOfEither) == runs;
      const bool order = along == 0 && model.effects[e].family->tells_order_along_profile;
      if (runs_here) all.push_back(e);
      if (runs_here || order) with_orders.push_back(e);
    }
    if (all.empty()) continue;
    std::vector<std::vector<std::size_t>> sets{all};
    if (with_orders.size() > all.size()) sets.push_back(with_orders);
    if (all.size() > 1)
      for (const std::size_t e : all) sets.push_back({e});
    const std::vector<double> places = between_traces(model, along);
    for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
      const std::vector<Effect> forms = growing_courses(model.geometry, along, flank, places);
      for (const std::vector<std::size_t>& set : sets)
        best.ask(model, one_form_for(model, set, forms, {}, kMoreValues), set);
    }
  }
  if (!best.effects.empty()) these = std::move(best.these);
  return std::move(best.effects);
}

}  // namespace trueflank::loop
