// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/clear_tips.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trueflank {
namespace {

constexpr double kLeastContact = 1.15;  // contact ratio, left to a mesh by a tip shortened for another

/// Roll length on a gear's flank at which its tip may make contact last: the largest of an external gear's, the
/// smallest of a ring's.
double last_contact_mm(const GearPair& pair, bool of_gear1) {
  const double m = pair.gear1().normal_module_mm;
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  const ToothProfile& mate = of_gear1 ? *pair.profile2 : *pair.profile1;
  const double form = std::max(0.0, mate.root_form_roll_length_mm());
  if (!pair.internal()) return span - form - kTipMargin * m;
  return of_gear1 ? form - kTipMargin * m - span : form + kTipMargin * m + span;
}

/// The tip radius with which contact ends at a roll length; the present one where that is not beyond it.
double cleared_tip_mm(const ToothProfile& profile, double roll_mm) {
  const Gear& gear = profile.gear();
  const bool ring = gear.kind == GearKind::kInternal;
  const double tip = profile.tip_form_roll_length_mm();
  if (ring ? tip >= roll_mm : tip <= roll_mm) return gear.tip_radius_mm;
  const double middle = 0.5 * (profile.root_form_roll_length_mm() + tip);
  if (ring ? roll_mm > middle : roll_mm < middle) return gear.tip_radius_mm;
  // a rounded tip makes contact up to where its rounding begins
  const double rounding = gear.tip_rounding_mm > 0.0 ? profile.tip_radius_mm() - profile.tip_form_radius_mm() : 0.0;
  return std::hypot(base_radius_mm(gear), roll_mm) + rounding;
}

double contact_ratio(const Gear& gear1, const Gear& gear2, double centre_distance_mm) {
  const auto profile1 = ToothProfile::make(gear1), profile2 = ToothProfile::make(gear2);
  if (!profile1 || !profile2) return 0.0;
  return contact_ratios(GearPair{&*profile1, &*profile2, centre_distance_mm}).effective;
}

/// A planet's tip that one mate wants shorter may be what its other mate lives on: then it stays.
void keep_contact(const std::vector<TrainMesh>& meshes, double centre_distance_mm,
                  const std::vector<std::optional<ToothProfile>>& profiles, std::vector<Gear>& gears,
                  std::vector<double>& shortened) {
  for (const TrainMesh& mesh : meshes) {
    const auto i = static_cast<std::size_t>(mesh.gear1), j = static_cast<std::size_t>(mesh.gear2);
    if ((shortened[i] == 0.0 && shortened[j] == 0.0) || !profiles[i] || !profiles[j]) continue;
    const double before = contact_ratio(profiles[i]->gear(), profiles[j]->gear(), centre_distance_mm);
    const double after = contact_ratio(gears[i], gears[j], centre_distance_mm);
    // what the margins of both tips cost is meant
    if (after >= kLeastContact || before - after < 0.03) continue;
    for (const std::size_t k : {i, j}) {
      gears[k].tip_radius_mm = profiles[k]->gear().tip_radius_mm;
      shortened[k] = 0.0;
    }
  }
}

}  // namespace

std::vector<double> clear_tips(const GearboxDesign& design, const std::vector<TrainMesh>& meshes,
                               double centre_distance_mm, std::vector<Gear>& gears) {
  std::vector<double> shortened(gears.size(), 0.0);
  std::vector<std::optional<ToothProfile>> profiles;
  for (const Gear& gear : gears) {
    auto profile = ToothProfile::make(gear);
    profiles.push_back(profile ? std::optional(std::move(*profile)) : std::nullopt);
  }
  for (const TrainMesh& mesh : meshes) {
    const auto &profile1 = profiles[static_cast<std::size_t>(mesh.gear1)],
               &profile2 = profiles[static_cast<std::size_t>(mesh.gear2)];
    if (!profile1 || !profile2) continue;  // reported where the train is laid out
    const GearPair pair{&*profile1, &*profile2, centre_distance_mm};
    if (!working_pressure_angle_rad(mesh_teeth(pair), centre_distance_mm)) continue;
    for (const bool of_gear1 : {true, false}) {
      const auto i = static_cast<std::size_t>(of_gear1 ? mesh.gear1 : mesh.gear2);
      if (design.gears[i].tip_diameter_mm) continue;
      const double by = std::abs(cleared_tip_mm(*profiles[i], last_contact_mm(pair, of_gear1)) -
                                 profiles[i]->gear().tip_radius_mm);
      shortened[i] = std::max(shortened[i], by);
    }
  }
  for (std::size_t i = 0; i < gears.size(); ++i)
    gears[i].tip_radius_mm += gears[i].kind == GearKind::kInternal ? shortened[i] : -shortened[i];
  keep_contact(meshes, centre_distance_mm, profiles, gears, shortened);
  return shortened;
}

}  // namespace trueflank
