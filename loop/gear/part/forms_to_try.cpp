// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/forms_to_try.h"

#include <cmath>
#include <set>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop {

using gear_effects::place_at;

namespace {

/// What dies away from both ends alike: a bell mouth. Longer ones are nearly a crowning.
std::vector<Effect> rises_at_both_ends(const FlankGeometry& geometry, double face,
                                       FlankChoice flank) {
  const double range_mm =
      face != 0.0 ? geometry.face_width_mm()
                  : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  std::vector<Effect> forms;
  for (const double within : {0.05, 0.1, 0.15})
    forms.push_back({find_family("unnamed_rise"), flank, {face, within * range_mm, 0.0}});
  return forms;
}

/// Strips between two places, to start from.
std::vector<Effect> strips(const FlankGeometry& geometry, double face, FlankChoice flank) {
  constexpr int kStarts = 12;
  constexpr double kSides = 0.03;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto at = [&](int part) {
    return place_at(geometry, face, static_cast<double>(part) / kStarts);
  };
  std::vector<Effect> forms;
  for (int from = 1; from < kStarts; ++from)
    for (int to = from + 1; to < kStarts; ++to)
      forms.push_back({find_family("unnamed_strip"),
                       flank,
                       {face, at(from), at(to),
                        kSides * std::abs(face != 0.0 ? geometry.face_width_mm() : high - low)}});
  return forms;
}

}  // namespace

std::vector<Effect> forms_along(const FlankGeometry& geometry, double face, FlankChoice flank,
                                bool bands) {
  constexpr double kFirst = 0.1, kStep = 0.1, kNearBothEnds = 0.65;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const double range_mm = face != 0.0 ? geometry.face_width_mm() : std::abs(high - low);
  std::vector<Effect> forms;
  for (const double within : {0.05, 0.1, 0.2, 0.4})
    for (const double end : {-1.0, 1.0})
      forms.push_back({find_family("unnamed_rise"), flank, {face, within * range_mm, end}});
  for (Effect& form : rises_at_both_ends(geometry, face, flank)) forms.push_back(std::move(form));
  for (double share = kFirst; share < 1.0 - 0.5 * kStep; share += kStep) {
    const double at = place_at(geometry, face, share);
    for (const double end : {-1.0, 1.0})
      for (const char* family : {"unnamed_kink", "unnamed_bend"})
        forms.push_back({find_family(family), flank, {face, at, end}});
    if (share > kNearBothEnds)
      forms.push_back({find_family("unnamed_bend"), flank, {face, at, 0.0}});
    if (bands)
      for (const double width : {0.1, 0.2, 0.35})
        forms.push_back({find_family("unnamed_band"), flank, {face, at, width * range_mm}});
  }
  if (bands)
    for (Effect& strip : strips(geometry, face, flank)) forms.push_back(std::move(strip));
  return forms;
}

std::vector<Effect> roofs_along(const FlankGeometry& geometry, double face, FlankChoice flank) {
  std::vector<Effect> roofs;
  for (const double share : {0.3, 0.4, 0.5, 0.6, 0.7})  // (one that leans far is a kink)
    roofs.push_back(
        {find_family("unnamed_kink"), flank, {face, place_at(geometry, face, share), 0.0}});
  constexpr double kToBothEnds = 2.0;
  for (const double share : {0.2, 0.3, 0.4, 0.6, 0.7, 0.8})
    roofs.push_back(
        {find_family("unnamed_kink"), flank, {face, place_at(geometry, face, share), kToBothEnds}});
  return roofs;
}

std::vector<Effect> sags_along(const FlankGeometry& geometry, double face, FlankChoice flank) {
  std::vector<Effect> sags;
  for (const double share : {0.36, 0.44, 0.56, 0.64})
    sags.push_back({find_family("unnamed_sag"), flank, {face, place_at(geometry, face, share)}});
  return sags;
}

std::vector<Effect> steps_along(const FlankGeometry& geometry, double face, FlankChoice flank) {
  constexpr int kParts = 12;
  std::vector<Effect> forms;
  for (int part = 1; part < kParts; ++part)
    forms.push_back(
        {find_family("unnamed_step"),
         flank,
         {face, place_at(geometry, face, static_cast<double>(part) / kParts), 0.0, 0.0}});
  return forms;
}

std::vector<Effect> waves_of_order(const FlankGeometry& geometry, double order, FlankChoice flank) {
  std::vector<Effect> waves;
  for (double times = 0.6; times < 1.6; times += 0.04)
    waves.push_back({find_family("unnamed_waviness"),
                     flank,
                     {0.0, times * kTwoPi * geometry.base_radius_mm() / order}});
  return waves;
}

std::vector<Effect> names_with_shapes(const FlankGeometry& geometry,
                                      const std::vector<Effect>& effects) {
  std::vector<Effect> names;
  for (const Effect& effect : effects) {
    const EffectFamily& family = *effect.family;
    if (!family.named || !family.shape_is_continuous || family.shape_is_step) continue;
    names.push_back(effect);
    for (const EffectShape& shape : family.shapes(geometry))
      names.push_back({&family, effect.flank, shape});
  }
  return names;
}

std::vector<Effect> long_waves(const FlankGeometry& geometry, double face, FlankChoice flank) {
  const double range_mm =
      face != 0.0 ? geometry.face_width_mm()
                  : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  std::vector<Effect> waves;
  for (const double lengths : {0.3, 0.36, 0.43, 0.5, 0.59, 0.7, 0.85, 1.0, 1.2, 1.45})
    waves.push_back({find_family("unnamed_waviness"), flank, {face, lengths * range_mm}});
  return waves;
}

Effect slope_over(int face, FlankChoice flank) {
  return {find_family("unnamed"), flank, {face == 0 ? 1.0 : 0.0, face == 0 ? 0.0 : 1.0, 0.0, 0.0}};
}

std::vector<Effect> dishes(const FlankGeometry& geometry, FlankChoice flank, const char* family) {
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const double face_mm = geometry.face_width_mm();
  std::vector<Effect> forms;
  for (const double u : {0.2, 0.35, 0.5, 0.65, 0.8})
    for (const double v : {0.2, 0.35, 0.5, 0.65, 0.8})
      for (const double wide : {0.2, 0.4})
        for (const double long_ : {0.2, 0.4})
          forms.push_back({find_family(family),
                           flank,
                           {2.0 * geometry.on_flank(1, 1, low + u * (high - low), 0.0).radius_mm,
                            v * face_mm, wide * std::abs(high - low), long_ * face_mm}});
  return forms;
}

std::vector<Effect> lines_aslant(const FlankGeometry& geometry, FlankChoice flank) {
  const double face_mm = geometry.face_width_mm();
  std::vector<Effect> forms;
  for (const double rise : {0.3, 0.5, 0.8, 1.2, 1.7, 2.4})
    for (const double sign : {-1.0, 1.0})
      for (double height = 0.1; height < 0.95; height += 0.1)
        for (const double width : {0.05, 0.09, 0.15})
          forms.push_back(
              {find_family("unnamed_slanted_ridge"),
               flank,
               {height * face_mm, sign * rise * face_mm, 0.0, width * face_mm, 0.0, 0.0}});
  return forms;
}

std::vector<Effect> corners(const FlankGeometry& geometry, FlankChoice flank) {
  const double profile_mm = std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm()),
               face_mm = geometry.face_width_mm();
  std::vector<Effect> forms;
  for (const double tip : {0.0, 1.0})
    for (const double upper : {0.0, 1.0})
      for (const double over_profile : {0.35, 0.6, 1.0})
        for (const double over_face : {0.35, 0.6, 1.0})
          for (const double power : {1.2, 1.8})
            forms.push_back({find_family("unnamed_corner"),
                             flank,
                             {tip, upper, over_profile * profile_mm, over_face * face_mm, power}});
  return forms;
}

std::vector<Effect> bows_of_the_axis() {
  std::vector<Effect> bows;
  for (const double held_at : {-1.0, 0.0, 1.0, 2.0})
    bows.push_back({find_family("unnamed_bow"), FlankChoice::kBoth, {held_at}});
  return bows;
}

std::vector<Effect> kinks_of_the_axis(const FlankGeometry& geometry) {
  std::vector<Effect> kinks;
  for (const double share : {0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85})
    for (const double towards : {-1.0, 1.0})
      kinks.push_back({find_family("unnamed_axis_kink"),
                       FlankChoice::kBoth,
                       {share * geometry.face_width_mm(), towards}});
  return kinks;
}

std::vector<Effect> soft_shifts(const FlankGeometry& geometry) {
  std::vector<Effect> shifts;
  const double face_mm = geometry.face_width_mm();
  for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
    for (const double half : {0.05, 0.12, 0.25})
      for (const double moves : {0.0, 1.0, -1.0})
        shifts.push_back({find_family("unnamed_soft_shift"),
                          FlankChoice::kBoth,
                          {share * face_mm, half * face_mm, moves}});
  return shifts;
}

std::vector<Effect> swellings_around(int teeth, FlankChoice flank) {
  std::vector<Effect> forms;
  for (int number = 2; number <= kMostSwellings; ++number) {
    const double apart = static_cast<double>(teeth) / number;
    for (double half = 0.7; half < 0.4 * apart; half *= 1.4)
      for (double tooth = 1.0; tooth < 1.0 + apart; tooth += 0.5 * half)
        forms.push_back({find_family("unnamed_swellings"), flank, {double(number), tooth, half}});
  }
  return forms;
}

std::vector<Effect> swellings_at_ends(const FlankGeometry& geometry, int number) {
  std::vector<Effect> forms;
  const double apart_deg = 360.0 / number;
  const double tooth_deg = 360.0 / geometry.teeth();
  for (double half = std::max(0.5 * tooth_deg, 0.1 * apart_deg); half < 0.35 * apart_deg;
       half *= 1.8)
    for (double at = 0.0; at < apart_deg; at += 0.8 * half)
      for (const double end : {-1.0, 1.0})
        for (const double within : {0.08, 0.18})
          forms.push_back({find_family("unnamed_swellings_at_end"),
                           FlankChoice::kBoth,
                           {double(number), at, half, end, within * geometry.face_width_mm()}});
  return forms;
}

std::vector<Effect> combs_of(int every, FlankChoice flank, double opposite) {
  std::vector<Effect> combs;
  for (int first = 1; first <= every; ++first)
    combs.push_back(
        {find_family("unnamed_comb"), flank, {double(every), double(first), 0.0, 0.0, opposite}});
  return combs;
}

namespace {

/// Numbers from one to another, each beyond a few a fifth larger than the one before: between them
/// forms differ by little, and the best is moved (`nearby`).
std::vector<int> counts_between(int fewest, int most) {
  constexpr double kLarger = 1.2;
  std::vector<int> counts;
  for (int count = fewest; count <= most;
       count = std::max(count + 1, static_cast<int>(kLarger * count)))
    counts.push_back(count);
  return counts;
}

/// Places for what is so many teeth long.
int step_of(int count) { return std::max(1, count / 6); }

/// Combs and saws: what begins anew after some teeth.
void add_repeating(int z, FlankChoice flank, double opposite,
                   std::vector<std::vector<Effect>>& sets) {
  constexpr int kFewestTeeth = 4;  // of a saw
  std::vector<Effect> combs, saws;
  for (int every = 2; every <= kMostOfComb && 3 * every <= z; ++every)
    for (Effect& comb : combs_of(every, flank, opposite)) combs.push_back(std::move(comb));
  for (const int every : counts_between(kFewestTeeth, z / 2))
    for (int first = 1; first <= (z % every == 0 ? every : z); first += step_of(every))
      saws.push_back(
          {find_family("unnamed_saw"),
           flank,
           {double(every), double(first), 0.0, 0.0, opposite, gear_effects::kMeanOfDrift}});
  sets.push_back(std::move(combs));
  sets.push_back(std::move(saws));
}

/// What some neighbouring teeth have and the others do not: a drift, waves; and steps at three
/// teeth.
void add_of_some_teeth(int z, const CourseOverFlanks& course, FlankChoice flank, double opposite,
                       std::vector<std::vector<Effect>>& sets) {
  const auto [u, v] = course;
  std::vector<Effect> drifts, waves, stairs;
  const bool heights = u == 0.0 && v == 0.0;
  if (heights && flank != FlankChoice::kBoth) return;
  // (where a drift jumps counts, not where it begins or ends)
  for (const int count : counts_between(std::max(4, z / 6), 17 * z / 20))
    for (int jump = 1; jump <= z; ++jump)
      for (const double falls : {0.0, 1.0}) {
        const int first = falls != 0.0 ? jump : (jump - count + z) % z + 1;
        drifts.push_back({find_family("unnamed_drift_of_some"),
                          flank,
                          {double(first), double(count), u, v, opposite, falls}});
      }
  sets.push_back(std::move(drifts));
  if (!heights) return;
  // Waves of two periods and more, of three teeth and more each.
  constexpr int kFewestTeeth = 8, kMostPlaces = 12, kMostPeriods = 16;
  for (const double share : {0.3, 0.5, 0.7})
    for (int periods = static_cast<int>(std::ceil(1.5 / share));
         3 * periods <= z && periods <= kMostPeriods; ++periods) {
      const int count = static_cast<int>(share * z);
      if (count < kFewestTeeth) continue;
      for (int first = 1; first <= z; first += std::max(1, count / 4))
        waves.push_back({find_family("unnamed_wave_of_some"),
                         flank,
                         {double(first), double(count), double(periods), opposite}});
    }
  const int step = std::max(2, z / kMostPlaces);
  for (int first = 1; first + 2 * step <= z; first += step)
    for (int second = first + step; second + step <= z; second += step)
      for (int third = second + step; third <= z && third <= z + first - step; third += step)
        stairs.push_back({find_family("unnamed_stairs"),
                          flank,
                          {double(first), double(second), double(third), opposite}});
  sets.push_back(std::move(waves));
  sets.push_back(std::move(stairs));
}

/// Drifts from cut to cut of teeth that are not cut one beside the other.
std::vector<Effect> cut_orders(int z, FlankChoice flank, double opposite) {
  constexpr int kMostSteps = 40;
  std::vector<Effect> forms;
  // (steps of so many teeth less go the other way around)
  for (int step = 2; 2 * step < z && step <= kMostSteps; ++step)
    for (int first = 1; gear_effects::can_be_cut_in_steps(z, step) && first <= z; ++first)
      forms.push_back(
          {find_family("unnamed_cut_order"), flank, {double(step), double(first), opposite, 0.0}});
  return forms;
}

/// Waves that grow, fade or die away from one tooth on.
std::vector<Effect> changing_waves(int z, FlankChoice flank, double opposite) {
  constexpr int kPlaces = 12, kPlacesOfDying = 30, kMostPeriods = 30;
  constexpr double kFewest = 2.0;
  std::vector<Effect> forms;
  const auto add = [&](double periods, int first, double course, double within) {
    forms.push_back({find_family("unnamed_changing_wave"),
                     flank,
                     {periods, double(first), course, within, opposite}});
  };
  for (double periods = kFewest; 3.0 * periods <= z && periods <= kMostPeriods; periods += 1.0) {
    for (int first = 1; first <= z; first += std::max(1, z / kPlaces))
      for (const double course : {0.0, 1.0}) add(periods, first, course, z);
    for (int first = 1; first <= z; first += std::max(1, z / kPlacesOfDying))
      for (const double share : {0.08, 0.2}) add(periods, first, 2.0, share * z);
  }
  return forms;
}

/// Sectors and drifts: what begins at one tooth.
void add_beginning(int z, const CourseOverFlanks& course, FlankChoice flank, double opposite,
                   std::vector<std::vector<Effect>>& sets) {
  const auto [u, v] = course;
  std::vector<Effect> sectors, ramps, levellings, broken_waves;
  for (const int count : counts_between(2, z / 2))
    for (int first = 1; first <= z; first += step_of(count))
      sectors.push_back(
          {find_family("unnamed_sector"), flank, {double(first), double(count), u, v, opposite}});
  // (all teeth of an index stand on a zero of its own)
  std::vector<double> zeros{gear_effects::kMeanOfDrift};
  if (u != 0.0 || v != 0.0)
    zeros.insert(zeros.end(), {gear_effects::kFirstOfDrift, gear_effects::kLastOfDrift});
  for (int first = 1; first <= z; ++first) {
    ramps.push_back({find_family("unnamed_ramp"),
                     flank,
                     {double(first), u, v, opposite, gear_effects::kMeanOfDrift}});
    for (const double share : {0.06, 0.12, 0.25, 0.5})
      for (const double grows : {0.0, 1.0})
        for (const double zero : zeros)
          levellings.push_back({find_family("unnamed_levelling"),
                                flank,
                                {double(first), u, v, opposite, grows, share * z, zero}});
    if (flank == FlankChoice::kBoth && u == 0.0 && v == 0.0)
      for (const double periods : {0.5, 0.75, 1.25, 1.5, 1.75, 2.25, 2.5, 2.75, 3.5})
        broken_waves.push_back(
            {find_family("unnamed_broken_wave"), flank, {periods, double(first), opposite}});
  }
  for (std::vector<Effect>* forms : {&sectors, &ramps, &levellings, &broken_waves})
    sets.push_back(std::move(*forms));
}

/// A swelling or hollow over a few teeth.
std::vector<Effect> dents_around(int z, FlankChoice flank) {
  std::vector<Effect> dents;
  for (const double half : {1.0, 1.5, 2.2, 3.3, 5.0})
    for (double tooth = 1.0; 4.0 * half < z && tooth <= z; tooth += 0.5)
      dents.push_back({find_family("unnamed_dent"), flank, {tooth, half, 0.0, 0.0}});
  return dents;
}

}  // namespace

std::vector<Effect> sectors_around(int z, FlankChoice flank, double opposite, int number) {
  constexpr double kFewestTeeth = 2.0;
  const double apart = static_cast<double>(z) / number;
  std::vector<Effect> sectors;
  std::set<int> counts;
  for (const double share : {0.25, 0.4, 0.5, 0.6, 0.75})
    if (const double count = std::rint(share * apart);
        count >= kFewestTeeth && apart - count >= kFewestTeeth)
      counts.insert(static_cast<int>(count));
  for (const int count : counts)
    for (int first = 1; first < apart + 1.0; ++first)
      sectors.push_back({find_family("unnamed_sectors"),
                         flank,
                         {double(first), double(count), 0.0, 0.0, opposite, double(number)}});
  return sectors;
}

std::vector<std::vector<Effect>> forms_from_tooth_to_tooth(int teeth,
                                                           const CourseOverFlanks& course) {
  const bool heights = course.profile == 0.0 && course.face == 0.0;
  std::vector<std::vector<Effect>> sets;
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
    for (const double opposite : {0.0, 1.0}) {
      if (opposite != 0.0 && flank != FlankChoice::kBoth) continue;
      add_beginning(teeth, course, flank, opposite, sets);
      add_of_some_teeth(teeth, course, flank, opposite, sets);
      if (heights) add_repeating(teeth, flank, opposite, sets);
      if (heights)
        for (int number = 2; number <= kMostSectors; ++number)
          sets.push_back(sectors_around(teeth, flank, opposite, number));
      if (heights && flank == FlankChoice::kBoth) {
        sets.push_back(cut_orders(teeth, flank, opposite));
        sets.push_back(changing_waves(teeth, flank, opposite));
      }
    }
    if (!heights) continue;
    sets.push_back(dents_around(teeth, flank));
    sets.push_back(swellings_around(teeth, flank));
  }
  std::erase_if(sets, [](const std::vector<Effect>& set) { return set.empty(); });
  return sets;
}

std::vector<std::vector<std::size_t>> with_and_without(const std::vector<std::size_t>& all,
                                                       const std::vector<std::size_t>& names) {
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

std::vector<std::vector<std::size_t>> all_pairs_and_each(const std::vector<std::size_t>& all) {
  std::vector<std::vector<std::size_t>> sets;
  if (all.size() > 2) sets.push_back(all);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b) sets.push_back({all[a], all[b]});
  for (const std::size_t one : all) sets.push_back({one});
  return sets;
}

Effect s_over(int face, FlankChoice flank) {
  Effect s_shape = slope_over(face, flank);
  for (const std::size_t along : {0, 1}) s_shape.shape[along] *= 3.0;
  return s_shape;
}

std::vector<Effect> forms_and_s_along(const FlankGeometry& geometry, int face, FlankChoice flank) {
  std::vector<Effect> forms = forms_along(geometry, face, flank, true);
  forms.push_back(s_over(face, flank));
  return forms;
}

std::vector<Effect> slips_around(int teeth, FlankChoice flank, double opposite) {
  constexpr double kFewest = 2.0, kStays = 3.0;
  std::vector<Effect> forms;
  for (double over = kFewest; over < 0.6 * teeth; over = std::ceil(1.4 * over))
    for (double first = 2.0; first + over + kStays <= teeth + 1.0; first += 1.0)
      forms.push_back({find_family("unnamed_slip"), flank, {first, over, 1.0, opposite}});
  return forms;
}

std::vector<std::vector<Effect>> slits_arches_bursts(int z, double opposite) {
  // (noise alone of fewer values looks like one of so many)
  constexpr int kMostPeriods = 30, kFewestTeeth = 24;
  constexpr double kFewestWaves = 1.5, kBurst = 3.0;  // in a burst; the course of it
  constexpr FlankChoice kFlank = FlankChoice::kBoth;
  if (z < kFewestTeeth) return {};
  std::vector<std::vector<Effect>> sets(3);
  // (stress and a table that drifts move teeth, and no height)
  for (int tooth = 1; opposite != 0.0 && tooth <= z; ++tooth) {
    for (const double within : {1.0, 1.7, 2.8, 4.6})
      if (5.0 * within <= z)
        sets[0].push_back({find_family("unnamed_slit"), kFlank, {double(tooth), within, opposite}});
    sets[1].push_back({find_family("unnamed_arch_around"), kFlank, {double(tooth), opposite}});
  }
  for (const double share : {0.06, 0.13})
    for (double periods = 3.0; 3.0 * periods <= z && periods <= kMostPeriods; periods += 1.0)
      for (int tooth = 1; 2.0 * share * periods >= kFewestWaves && tooth <= z;
           tooth += std::max(1, static_cast<int>(0.5 * share * z)))
        sets[2].push_back({find_family("unnamed_changing_wave"),
                           kFlank,
                           {periods, double(tooth), kBurst, share * z, opposite}});
  return sets;
}

}  // namespace trueflank::loop
