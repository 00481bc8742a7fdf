// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which effects are not asked about: what the data cannot show, what is given, what no gear can
// have.
#include "trueflank/loop/gear/part/bans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "trueflank/base/threads.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/taken_up.h"
#include "trueflank/loop/gear/possible_effects.h"
#include "trueflank/loop/gear/remainder_around.h"

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
    // (where no flank of a side was followed, the ends are infinite, and so is this)
    const bool followed = roll_mm[side].least <= roll_mm[side].most;
    seen.reach[side].profile = followed && std::abs(over_profile) > kSeveral;
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

/// Beside a drift around the gear that is larger, waves are what its even course leaves: no cause
/// of their own. True where any was banned.
bool ban_waves_of_a_drift(PartModel& model) {
  if (std::none_of(model.effects.begin(), model.effects.end(),
                   [](const Effect& e) { return e.family->is_drift; }))
    return false;
  const PointFit fit(model.geometry, model.table, model.patches, model.effects);
  double drift_um = 0.0;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (model.effects[e].family->is_drift)
      drift_um = std::max(drift_um, fit.effect_size_um(static_cast<int>(e)));
  bool any = false;
  for (std::size_t e = model.options.given.size(); e < model.effects.size(); ++e)
    if (model.effects[e].family->named && model.effects[e].family->doubt_share > 0.0 &&
        fit.effect_size_um(static_cast<int>(e)) < drift_um)
      any = ban_alike(model, model.effects[e]) || any;
  return any;
}

/// Effects that no gear can have (possible_effects.h) are not chosen again, at no shape.
bool ban_impossible(PartModel& model) {
  if (model.effects.empty()) return false;
  const auto fit = fit_of(model, model.effects);
  bool any = false;
  for (std::size_t e = model.options.given.size(); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (is_possible(model.geometry, *fit, static_cast<int>(e))) continue;
    for (std::size_t g = 0; g < model.candidates.size(); ++g)
      if (model.candidates[g].family == effect.family && model.candidates[g].flank == effect.flank)
        model.banned[g] = any = true;
  }
  return any;
}

}  // namespace

void ban_what_cannot_be_seen(PartModel& model) {
  const Seen seen = seen_in(model.geometry, model.table, model.patches);
  model.reach = seen.reach;
  const bool all_traced = seen.traced() >= model.geometry.teeth();
  // Less than half a wave over the profile is a slope of it, and so is a whole one where the teeth
  // between were not traced: on traces with zeros of their own no machine's order can be read from
  // that.
  const double fewest = gear_effects::lowest_order_with(all_traced ? 0.5 : 1.0, model.geometry);
  const auto is_a_slope = [&](const Effect& effect) {
    return effect.family->tells_order_along_profile && !seen.scanned &&
           (!seen.whole_ring || !all_traced) && effect.order() < fewest;
  };
  for (std::size_t g = 0; g < model.candidates.size(); ++g) {
    const Effect& effect = model.candidates[g];
    const NeedsToBeSeen needs = effect.needs();
    // (profiles at several heights show how they differ from one to the next)
    const bool follows =
        (!needs.along_profile || seen.along_profile) && (!needs.along_face || seen.along_face);
    if ((needs.crossed ? !seen.crossed : !follows) || !is_within_reach(model, effect) ||
        aliases(effect, seen) || is_alike_on_all(effect, seen, model.geometry.teeth()) ||
        is_a_slope(effect))
      model.banned[g] = true;
  }
}

void ban_pitch_in_runouts(PartModel& model) {
  const auto& rows = model.table->rows;
  const auto is_of = [](ObservationKind kind) {
    return [kind](const Observation& row) { return row.kind == kind; };
  };
  if (std::none_of(rows.begin(), rows.end(), is_of(ObservationKind::kRadial)) ||
      !std::all_of(rows.begin(), rows.end(), [&](const Observation& row) {
        return is_of(ObservationKind::kRadial)(row) || is_of(ObservationKind::kSize)(row);
      }))
    return;
  for (std::size_t g = 0; g < model.candidates.size(); ++g)
    if (model.candidates[g].family == find_family("pitch_wave")) model.banned[g] = true;
}

bool is_within_reach(const PartModel& model, const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  for (const int side : {0, 1}) {
    const FlankReach& reach = model.reach[static_cast<std::size_t>(side)];
    if ((effect.flank == FlankChoice::kBoth ||
         effect.flank == flank_choice(model.geometry, side)) &&
        (reach.profile || !needs.along_profile) && (reach.face || !needs.along_face) &&
        (reach.heights || !needs.several_heights))
      return true;
  }
  return false;
}

void ban_given(PartModel& model) {
  for (const Effect& given : model.options.given)
    for (std::size_t g = 0; g < model.candidates.size(); ++g) {
      const Effect& candidate = model.candidates[g];
      if (candidate.family == given.family && candidate.flank == given.flank &&
          (candidate.shape == given.shape || given.family->shape_is_continuous))
        model.banned[g] = true;
    }
}

std::vector<std::string> not_observable(const PartModel& model) {
  std::vector<std::string> seen, hidden;
  for (std::size_t g = 0; g < model.candidates.size(); ++g)
    if (g < model.discovery.observable.size() && model.discovery.observable[g] && !model.unseen[g])
      seen.push_back(model.candidates[g].family->id);
  for (const Effect& given : model.options.given) seen.push_back(given.family->id);
  const auto look = [&](const EffectFamily& family) {
    if (family.named && !family.local &&
        std::find(seen.begin(), seen.end(), family.id) == seen.end())
      hidden.push_back(family.id);
  };
  if (model.options.declared)
    for (const EffectFamily& family : *model.options.declared) look(family);
  for (const EffectFamily& family : effect_library())
    if (can_have(model.options.makings, family)) look(family);
  return hidden;
}

bool ban_misnamed(PartModel& model) {
  bool any = ban_impossible(model);
  any = ban_waves_of_a_drift(model) || any;
  const auto ban = [&](std::size_t group) {
    any = any || !model.banned[group];
    model.banned[group] = true;
  };
  for (const ChosenGroup& named : model.discovery.chosen) {
    if (named.group < 0) continue;
    const Effect& effect = model.candidates[named.group];
    const double order = effect.order(), share = effect.family->doubt_share;
    if (!(share > 0.0) || order < 2.0) continue;
    for (const ChosenGroup& other : model.discovery.chosen) {
      if (other.group < 0) continue;
      const Effect& term = model.candidates[other.group];
      if (!term.is_term() || other.gain < share * named.gain) continue;
      if (effect.family->doubted_by_any_order ? term.order() == 0.0 : term.order() != order)
        continue;
      for (std::size_t g = 0; g < model.candidates.size(); ++g)
        if (model.candidates[g].family->named && model.candidates[g].order() == order &&
            model.candidates[g].shape == effect.shape &&
            model.candidates[g].family->shape_names == effect.family->shape_names)
          ban(g);
    }
  }
  return any;
}

}  // namespace trueflank::loop
