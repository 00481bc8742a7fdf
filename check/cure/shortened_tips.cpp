// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/shortened_tips.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/cure/interference_cure.h"
#include "trueflank/check/mesh_clearance.h"

namespace trueflank {
namespace {

constexpr double kWantedTipClearance = 0.1;  // of the module
constexpr double kWrittenTips_per_mm = 1e3;  // tip diameters are written so

bool complained(const Judgement& judgement, const char* id) {
  return std::any_of(judgement.complaints.begin(), judgement.complaints.end(),
                     [&](const Complaint& c) { return c.id == id; });
}

void set_tip(const GearTrain& laid, std::size_t gear, double radius_mm, DesignChange& change) {
  const bool ring = laid.gears[gear].profile.gear().kind == GearKind::kInternal;
  const double steps = 2.0 * radius_mm * kWrittenTips_per_mm;
  change.tip_diameter_mm[gear] =
      (ring ? std::ceil(steps + 1e-6) : std::floor(steps - 1e-6)) / kWrittenTips_per_mm;
}

}  // namespace

bool shorten_given(const GearTrain& laid, const Judgement& judgement, DesignChange& change) {
  const bool in_fillet = complained(judgement, "fillet_interference");
  const bool short_contact = complained(judgement, "contact_ratio");
  if (!in_fillet && !short_contact) return false;
  GearboxDesign open = laid.design;
  for (GearDesign& gear : open.gears) gear.tip_diameter_mm.reset();
  const auto clear = lay_out(open);
  if (!clear) return false;
  bool any = false;
  for (std::size_t i = 0; i < laid.gears.size(); ++i) {
    const double given = laid.gears[i].profile.gear().tip_radius_mm;
    const double wanted = clear->gears[i].profile.gear().tip_radius_mm;
    const bool ring = laid.gears[i].profile.gear().kind == GearKind::kInternal;
    if (!laid.design.gears[i].tip_diameter_mm || change.tip_diameter_mm.contains(i)) continue;
    const double too_long = ring ? wanted - given : given - wanted;
    const bool digs = in_fillet && too_long > 1e-6 && clear->gears[i].tip_shortened_mm > 0.0;
    if (!digs && !(short_contact && too_long < -1e-3)) continue;
    set_tip(laid, i, wanted, change);
    any = true;
  }
  return any;
}

bool shorten_at_roots(const GearTrain& laid, const Judgement& judgement, DesignChange& change) {
  bool any = false;
  const auto shorten = [&](int gear, double by_mm) {
    if (!(by_mm > 1e-9)) return;
    const auto i = static_cast<std::size_t>(gear);
    const Gear& g = laid.gears[i].profile.gear();
    if (by_mm > kMostShortenedTip * g.normal_module_mm) return;
    set_tip(laid, i, g.tip_radius_mm + (g.kind == GearKind::kInternal ? by_mm : -by_mm), change);
    any = true;
  };
  if (complained(judgement, "tip_clearance"))
    for (const TrainMesh& mesh : laid.meshes) {
      const GearPair pair = laid.pair(mesh);
      const double wanted = kWantedTipClearance * pair.gear1().normal_module_mm;
      shorten(mesh.gear1, wanted - tip_clearance_of_gear1_mm(pair));
      shorten(mesh.gear2, wanted - tip_clearance_of_gear2_mm(pair));
    }
  if (!any && complained(judgement, "planet_spacing"))
    for (std::size_t i = 0; i < laid.gears.size(); ++i) {
      if (!laid.topology().is_planet_gear(i)) continue;
      const double room = laid.centre_distance_mm * std::sin(kPi / laid.design.planets);
      shorten(static_cast<int>(i),
              laid.gears[i].profile.tip_radius_mm() - room + 0.02 * laid.design.module_mm);
    }
  return any;
}

bool shorten_in_the_way(const GearTrain& laid, int layer, ContactJudge& judge, int& bisected,
                        DesignChange& change) {
  bool any = false;
  for (const TrainMesh& mesh : laid.meshes) {
    if (layer != 0 && layer_of(laid, mesh) != layer) continue;
    const ContactJudge::Clearances c = judge.clearances(laid, mesh);
    const double asked = laid.design.made.clearance_mm.value_or(0.0);
    if (!(c.driving_mm < -tolerance::kTouch_mm || c.centred_mm < asked - tolerance::kTouch_mm))
      continue;
    const double less_mm = 0.5 * tolerance::kTouch_mm;
    const CureMargin margin{
        .exact =
            [&](const GearPair& pair) {
              ++bisected;
              const double driving = driving_clearance(pair).clearance_mm;
              const double open =
                  std::isnan(driving) || asked > 0.0 ? sweep_clearance_mm(pair) - asked : driving;
              return std::fmin(driving, open) + less_mm;
            },
        .quick =
            [&](const GearPair& pair) {
              return tips_clear_driving(pair, -less_mm) &&
                     (!(asked > 0.0) || tips_clear(pair, asked - less_mm));
            }};
    for (const bool of_gear1 : {c.tip_of_gear1, !c.tip_of_gear1}) {
      const auto radius = tip_radius_cure_mm(laid.pair(mesh), of_gear1, margin);
      if (!radius) continue;
      set_tip(laid, static_cast<std::size_t>(of_gear1 ? mesh.gear1 : mesh.gear2), *radius, change);
      any = true;
      break;
    }
  }
  return any;
}

}  // namespace trueflank
