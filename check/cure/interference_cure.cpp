// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/interference_cure.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "trueflank/base/threads.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"

namespace trueflank {
namespace {

constexpr double kTipResolution_mm = 5e-4;
constexpr double kShiftResolution = 1e-3;
constexpr double kLargestShiftChange = 1.0;

using PairIsGood = std::function<bool(const GearPair&)>;

/// The train with the shifts of one layer moved together, so that no backlash changes.
std::optional<GearTrain> with_layer_shifted(const GearTrain& train, const TrainMesh& mesh,
                                            double change) {
  GearboxDesign design = train.design;
  const TrainGear& gear1 = train.gears[static_cast<std::size_t>(mesh.gear1)];
  // the inner gear of an external mesh (sun, pinion) moves against its mates, everything else with
  // them
  const auto moves_against = [&](std::size_t gear) {
    return std::any_of(train.meshes.begin(), train.meshes.end(), [&](const TrainMesh& other) {
      return other.gear1 == static_cast<int>(gear) && !train.pair(other).internal();
    });
  };
  const double planet_change = train.pair(mesh).internal() ? change : -change;
  design.centre_distance_mm = train.centre_distance_mm;
  for (std::size_t i = 0; i < design.gears.size(); ++i) {
    const TrainGear& gear = train.gears[i];
    double moved = gear.layer == gear1.layer ? planet_change : 0.0;
    if (moves_against(i)) moved = -moved;
    design.gears[i].shift = gear.shift + moved;
  }
  auto result = lay_out_teeth(design);
  if (!result) return std::nullopt;
  return std::move(*result);
}

bool good_with_shift(const GearTrain& train, const TrainMesh& mesh, double change,
                     const PairIsGood& good) {
  const auto shifted = with_layer_shifted(train, mesh, change);
  return shifted && good(shifted->pair(mesh));
}

/// Sought with the quick margin. The exact one is never above it: what the quick one refuses fails,
/// and what it finds holds where the exact one agrees.
template <class Seek, class Agrees>
auto found_by(const CureMargin& margin, const Seek& seek, const Agrees& agrees) {
  const PairIsGood exactly = [&](const GearPair& pair) { return margin.exact(pair) >= 0.0; };
  if (margin.quick) {
    const auto found = seek(margin.quick);
    if (!found || agrees(*found, exactly)) return found;
  }
  return seek(exactly);
}

bool good_with_tip(const GearPair& pair, bool of_gear1, double radius_mm, const PairIsGood& good) {
  Gear gear = (of_gear1 ? *pair.profile1 : *pair.profile2).gear();
  gear.tip_radius_mm = radius_mm;
  const auto made = ToothProfile::make(gear);
  if (!made) return false;
  GearPair changed = pair;
  (of_gear1 ? changed.profile1 : changed.profile2) = &*made;
  return good(changed);
}

std::optional<double> sought_tip_radius_mm(const GearPair& pair, bool of_gear1,
                                           const PairIsGood& good) {
  const ToothProfile& profile = of_gear1 ? *pair.profile1 : *pair.profile2;
  double bad = profile.tip_radius_mm();
  double fine = 0.5 * (profile.tip_form_radius_mm() + profile.root_form_radius_mm());
  if (!good_with_tip(pair, of_gear1, fine, good)) return std::nullopt;
  while (std::abs(fine - bad) > kTipResolution_mm) {
    const double mid = 0.5 * (fine + bad);
    (good_with_tip(pair, of_gear1, mid, good) ? fine : bad) = mid;
  }
  return fine;
}

std::optional<double> sought_shift(const GearTrain& train, const TrainMesh& mesh,
                                   const PairIsGood& good) {
  for (double step = 0.05; step <= kLargestShiftChange; step *= 2.0) {
    for (const double sign : {1.0, -1.0}) {
      double fine = sign * step, bad = step > 0.05 ? 0.5 * fine : 0.0;
      if (!good_with_shift(train, mesh, fine, good)) continue;
      while (std::abs(fine - bad) > kShiftResolution) {
        const double mid = 0.5 * (fine + bad);
        (good_with_shift(train, mesh, mid, good) ? fine : bad) = mid;
      }
      return fine;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> tip_radius_cure_mm(const GearPair& pair, bool of_gear1,
                                         const CureMargin& margin) {
  return found_by(
      margin, [&](const PairIsGood& good) { return sought_tip_radius_mm(pair, of_gear1, good); },
      [&](double radius, const PairIsGood& good) { return good_with_tip(pair, of_gear1, radius, good); });
}

std::optional<ShiftCure> shift_cure(const GearTrain& train, const TrainMesh& mesh,
                                    const CureMargin& margin) {
  const auto change = found_by(
      margin, [&](const PairIsGood& good) { return sought_shift(train, mesh, good); },
      [&](double shift, const PairIsGood& good) { return good_with_shift(train, mesh, shift, good); });
  if (!change) return std::nullopt;
  const auto shifted = with_layer_shifted(train, mesh, *change);
  return ShiftCure{*change, shifted->gears[static_cast<std::size_t>(mesh.gear1)].shift,
                   shifted->gears[static_cast<std::size_t>(mesh.gear2)].shift};
}

std::string cure_text(const GearTrain& train, const TrainMesh& mesh, bool tip_of_gear1,
                      const CureMargin& margin) {
  const GearPair pair = train.pair(mesh);
  const std::string &name1 = gear1_name(train, mesh), &name2 = gear2_name(train, mesh);
  // The two do not ask each other; a thread is worth it where the margin is costly.
  const auto seek_shift = [&] { return shift_cure(train, mesh, margin); };
  auto shift_sought = margin.quick ? begun_beside(seek_shift) : std::async(std::launch::deferred, seek_shift);
  std::string text;
  if (const auto radius = tip_radius_cure_mm(pair, tip_of_gear1, margin)) {
    const double now = (tip_of_gear1 ? pair.profile1 : pair.profile2)->tip_radius_mm();
    text = "tip diameter of " + (tip_of_gear1 ? name1 : name2) + " " +
           bound_text(2.0 * *radius, *radius > now ? Rounded::kUp : Rounded::kDown) + " mm (" + (*radius > now ? "+" : "") + mm_text(2.0 * (*radius - now)) + ")";
  }
  if (const auto shift = shift_sought.get()) {
    text += text.empty() ? "" : "; or ";
    text += "shift of " + name1 + " " + number_text(shift->shift1) + " (" +
            (shift->change > 0.0 ? "+" : "") + number_text(shift->change, 3) + ") with " + name2 +
            " " + number_text(shift->shift2);
    if (train.gears.size() > 2) text += ", the rest of the layer alike";
  }
  if (text.empty())
    text = "other tooth counts: neither a shorter tip nor a profile shift within 1 clears it";
  return text;
}

}  // namespace trueflank
