// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which effects are not asked about: what the data cannot show, what is given, what no gear can
// have.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/possible_effects.h"

namespace trueflank::loop {
namespace {

/// What these data can show, and where they were taken.
struct Seen {
  bool scanned = false, whole_ring = false;  ///< some value on every tooth
  bool along_profile = false, along_face = false;
  bool several_heights = false;
  bool crossed = false;  ///< profiles at several heights, or helices at several diameters
  std::set<int> traced_teeth;
  std::array<FlankReach, 2> reach;  ///< of the sides

  [[nodiscard]] int traced() const { return static_cast<int>(traced_teeth.size()); }
};

/// Ends of what was looked at.
struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void take_in(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void take_in(const Range& range) {
    least = std::min(least, range.least);
    most = std::max(most, range.most);
  }
};

Seen seen_in(const FlankGeometry& geometry, const Observations& table, const Patches& patches) {
  // A product of both coordinates shows where flanks were scanned, or traced at several heights or
  // diameters.
  constexpr double kSeveral = 0.2;
  struct OfRows {
    Seen seen;
    Range height_mm, diameters, heights;
    std::array<Range, 2> roll_mm, face_mm;  ///< of traces and scans, by side
  };
  constexpr std::size_t kRowsOfWork = 65536;
  std::vector<OfRows> parts((table.rows.size() + kRowsOfWork - 1) / kRowsOfWork);
  for_each_run(table.rows.size(), kRowsOfWork, [&](std::size_t from, std::size_t to) {
    OfRows& part = parts[from / kRowsOfWork];
    for (std::size_t i = from; i < to; ++i) {
      const Observation& row = table.rows[i];
      const bool scan = row.kind == ObservationKind::kScanFlank;
      const bool helix = row.kind == ObservationKind::kHelix,
                 profile = row.kind == ObservationKind::kProfile;
      part.seen.whole_ring = part.seen.whole_ring || row.kind == ObservationKind::kIndex ||
                             row.kind == ObservationKind::kRadial;
      part.seen.scanned = part.seen.scanned || scan;
      part.seen.along_profile = part.seen.along_profile || scan || profile;
      part.seen.along_face = part.seen.along_face || scan || helix;
      const Place& place = table.place(row);
      part.height_mm.take_in(place.z_mm);
      if ((scan || helix || profile) && patches.patch_of_row[i] >= 0) {
        const std::size_t side = place.side > 0 ? 1 : 0;
        part.roll_mm[side].take_in(place.roll_mm);
        part.face_mm[side].take_in(place.z_mm);
      }
      if (helix) part.diameters.take_in(geometry.profile_coordinate(place.roll_mm));
      if (profile) part.heights.take_in(geometry.face_coordinate(place.z_mm));
    }
  });
  Seen seen;
  Range height_mm, diameters, heights;
  std::array<Range, 2> roll_mm, face_mm;
  for (const OfRows& part : parts) {
    seen.whole_ring = seen.whole_ring || part.seen.whole_ring;
    seen.scanned = seen.scanned || part.seen.scanned;
    seen.along_profile = seen.along_profile || part.seen.along_profile;
    seen.along_face = seen.along_face || part.seen.along_face;
    height_mm.take_in(part.height_mm);
    diameters.take_in(part.diameters);
    heights.take_in(part.heights);
    for (const std::size_t side : {0U, 1U}) {
      roll_mm[side].take_in(part.roll_mm[side]);
      face_mm[side].take_in(part.face_mm[side]);
    }
  }
  for (const std::size_t side : {0U, 1U}) {
    // (of a ring the roll falls towards the tip)
    const double over_profile = geometry.profile_coordinate(roll_mm[side].most) -
                                geometry.profile_coordinate(roll_mm[side].least);
    const double over_face = geometry.face_coordinate(face_mm[side].most) -
                             geometry.face_coordinate(face_mm[side].least);
    seen.reach[side].profile = std::abs(over_profile) > kSeveral;
    seen.reach[side].face = over_face > kSeveral;
  }
  const double lowest = std::min(1.0, geometry.face_coordinate(height_mm.least));
  const double highest = std::max(-1.0, geometry.face_coordinate(height_mm.most));
  seen.several_heights = highest > lowest + kSeveral;
  for (FlankReach& reach : seen.reach) reach.heights = seen.several_heights;
  seen.crossed = seen.scanned || diameters.most > diameters.least + kSeveral ||
                 heights.most > heights.least + kSeveral;
  // Teeth that are held out tell nothing.
  for (const Patches::Patch& patch : patches.patches)
    if (patch.fold != 0 &&
        (patch.kind == ObservationKind::kHelix || patch.kind == ObservationKind::kProfile))
      seen.traced_teeth.insert(patch.places.front().place.tooth);
  return seen;
}

/// Between few teeth a wave of a higher order looks like one of a lower, or like what all share,
/// with a name or without. One over the generating rotation differs along the profile; in values
/// one a tooth every order looks like a lower one.
bool aliases(const Effect& effect, const Seen& seen) {
  const NeedsToBeSeen needs = effect.needs();
  const bool in_traces_only = needs.along_profile || needs.along_face || !seen.whole_ring;
  return !seen.scanned && !effect.family->tells_order_along_profile && in_traces_only &&
         seen.traced() > 0 && 2.0 * effect.order() >= seen.traced();
}

/// Waves that stand alike on every tooth looked at are a form of the flank, and no machine's order.
bool is_alike_on_all(const Effect& effect, const Seen& seen, int teeth) {
  if (!effect.family->tells_order_along_profile) return false;
  const double z = teeth;
  if (seen.scanned || seen.traced() == 0) return std::fmod(effect.order(), z) == 0.0;
  return std::all_of(seen.traced_teeth.begin(), seen.traced_teeth.end(), [&](int tooth) {
    return std::fmod(effect.order() * (tooth - *seen.traced_teeth.begin()), z) == 0.0;
  });
}

}  // namespace

/// What the data cannot show is not looked for under another name: shapes over the profile where
/// nothing was measured along it, over the face likewise.
void PartLoop::ban_what_cannot_be_seen() {
  const Seen seen = seen_in(geometry_, table_, patches_);
  reach_ = seen.reach;
  const bool all_traced = seen.traced() >= geometry_.teeth();
  // Less than half a wave over the profile is a slope of it, and so is a whole one where the teeth
  // between were not traced: on traces with zeros of their own no machine's order can be read from
  // that.
  const double fewest = gear_effects::lowest_order_with(all_traced ? 0.5 : 1.0, geometry_);
  const auto is_a_slope = [&](const Effect& effect) {
    return effect.family->tells_order_along_profile && !seen.scanned &&
           (!seen.whole_ring || !all_traced) && effect.order() < fewest;
  };
  for (std::size_t g = 0; g < candidates_.size(); ++g) {
    const Effect& effect = candidates_[g];
    const NeedsToBeSeen needs = effect.needs();
    if ((needs.along_profile && !seen.along_profile) || (needs.along_face && !seen.along_face) ||
        (needs.crossed && !seen.crossed) || !is_within_reach(effect) || aliases(effect, seen) ||
        is_alike_on_all(effect, seen, geometry_.teeth()) || is_a_slope(effect))
      banned_[g] = true;
  }
}

/// True where values of one of its flanks differ in every direction in which the effect has a
/// course or a place: with all of them at one height its size would be that where nothing was
/// measured.
bool PartLoop::is_within_reach(const Effect& effect) const {
  const NeedsToBeSeen needs = effect.needs();
  for (const int side : {0, 1}) {
    const FlankReach& reach = reach_[static_cast<std::size_t>(side)];
    if ((effect.flank == FlankChoice::kBoth || effect.flank == flank_choice(geometry_, side)) &&
        (reach.profile || !needs.along_profile) && (reach.face || !needs.along_face) &&
        (reach.heights || !needs.several_heights))
      return true;
  }
  return false;
}

/// What is given does not enter again, nor at a neighbouring shape.
void PartLoop::ban_given() {
  for (const Effect& given : options_.given)
    for (std::size_t g = 0; g < candidates_.size(); ++g) {
      const Effect& candidate = candidates_[g];
      if (candidate.family == given.family && candidate.flank == given.flank &&
          (candidate.shape == given.shape || given.family->shape_is_continuous))
        banned_[g] = true;
    }
}

std::vector<std::string> PartLoop::not_observable() const {
  std::vector<std::string> seen, hidden;
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (g < discovery_.observable.size() && discovery_.observable[g] && !unseen_[g])
      seen.push_back(candidates_[g].family->id);
  for (const Effect& given : options_.given) seen.push_back(given.family->id);
  const auto look = [&](const EffectFamily& family) {
    if (family.named && !family.local &&
        std::find(seen.begin(), seen.end(), family.id) == seen.end())
      hidden.push_back(family.id);
  };
  if (options_.declared)
    for (const EffectFamily& family : *options_.declared) look(family);
  for (const EffectFamily& family : effect_library())
    if (can_have(options_.makings, family)) look(family);
  return hidden;
}

/// Bans named effects that cannot be meant: an amount of the wrong sign; a wave whose kin of the
/// same order remain unexplained, which is not that wave and is better described. True where any
/// was.
bool PartLoop::ban_misnamed() {
  bool any = ban_impossible();
  any = ban_waves_of_a_drift() || any;
  const auto ban = [&](std::size_t group) {
    any = any || !banned_[group];
    banned_[group] = true;
  };
  for (const ChosenGroup& named : discovery_.chosen) {
    if (named.group < 0) continue;
    const Effect& effect = candidates_[named.group];
    const double order = effect.order(), share = effect.family->doubt_share;
    if (!(share > 0.0) || order < 2.0) continue;
    for (const ChosenGroup& other : discovery_.chosen) {
      if (other.group < 0) continue;
      const Effect& term = candidates_[other.group];
      if (!term.is_term() || other.gain < share * named.gain) continue;
      if (effect.family->doubted_by_any_order ? term.order() == 0.0 : term.order() != order)
        continue;
      for (std::size_t g = 0; g < candidates_.size(); ++g)
        if (candidates_[g].family->named && candidates_[g].order() == order &&
            candidates_[g].shape == effect.shape &&
            candidates_[g].family->shape_names == effect.family->shape_names)
          ban(g);
    }
  }
  return any;
}

/// Beside a drift around the gear that is larger, waves are what its even course leaves: no cause
/// of their own. True where any was banned.
bool PartLoop::ban_waves_of_a_drift() {
  if (std::none_of(effects_.begin(), effects_.end(),
                   [](const Effect& e) { return e.family->is_drift; }))
    return false;
  const PointFit fit(geometry_, table_, patches_, effects_);
  double drift_um = 0.0;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    if (effects_[e].family->is_drift)
      drift_um = std::max(drift_um, fit.effect_size_um(static_cast<int>(e)));
  bool any = false;
  for (std::size_t e = options_.given.size(); e < effects_.size(); ++e)
    if (effects_[e].family->named && effects_[e].family->doubt_share > 0.0 &&
        fit.effect_size_um(static_cast<int>(e)) < drift_um)
      any = ban_alike(effects_[e]) || any;
  return any;
}

/// Effects that no gear can have (possible_effects.h) are not chosen again, at no shape.
bool PartLoop::ban_impossible() {
  if (effects_.empty()) return false;
  const auto fit = fit_of(effects_);
  bool any = false;
  for (std::size_t e = options_.given.size(); e < effects_.size(); ++e) {
    const Effect& effect = effects_[e];
    if (is_possible(geometry_, *fit, static_cast<int>(e))) continue;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (candidates_[g].family == effect.family && candidates_[g].flank == effect.flank)
        banned_[g] = any = true;
  }
  return any;
}

}  // namespace trueflank::loop
