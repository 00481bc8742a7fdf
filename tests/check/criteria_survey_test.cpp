// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the textbook criteria are worth, counted on random designs; docs/interference.md has the figures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/check/random_pairs.h"
#include "tests/support/survey_size.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/check/ring_criteria.h"
#include "trueflank/geometry/involute.h"

namespace trueflank::test {
namespace {

/// Four cells: what the criterion says against what the geometry says.
struct Table {
  int good_clear = 0, good_hit = 0, bad_clear = 0, bad_hit = 0;
  void count(bool good, bool hit) {
    ++(good ? (hit ? good_hit : good_clear) : (hit ? bad_hit : bad_clear));
  }
  void print(const char* name) const {
    std::printf("%-44s criterion good: %5d clear, %5d penetrate; bad: %5d clear, %5d penetrate\n", name,
                good_clear, good_hit, bad_clear, bad_hit);
  }
};

struct Survey {
  Table fillet_external, fillet_ring, fillet_ring_tight, involute_ring, trochoid_tight, trochoid_loose,
      trimming;
  double worst_good_clearance = 0.0;  ///< tip clearance / m of a penetrating mesh whose criterion is good
  double khk_difference = 0.0;        ///< of thinned margin and KHK's plus (t1 + t2) / (2 r)
};

bool at_root(const MeshPlace& place) {
  const auto root = [](PieceKind kind) {
    return kind == PieceKind::kFillet || kind == PieceKind::kRoot;
  };
  return root(place.piece1) || root(place.piece2);
}

bool tips_meet(const MeshPlace& place) {
  return place.piece1 == PieceKind::kTip && place.piece2 == PieceKind::kTip;
}

/// KHK's own formula of the trochoid criterion, and what thinning adds; NaN where it does not exist.
double khk_trochoid_rad(const GearPair& pair) {
  const Gear &g1 = pair.gear1(), &g2 = pair.gear2();
  const double r1 = g1.tip_radius_mm, r2 = g2.tip_radius_mm, a = pair.centre_distance_mm;
  const auto inv_at = [](double r, double r_b) { return involute_function(std::acos(r_b / r)); };
  const double inv_w = involute_function(working_pressure_angle_rad(pair));
  const double theta1 = std::acos((r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1)) +
                        inv_at(r1, base_radius_mm(g1)) - inv_w;
  const double theta2 = std::acos((a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2));
  return theta1 * g1.teeth / g2.teeth + inv_w - inv_at(r2, base_radius_mm(g2)) - theta2 +
         (g1.thinning_mm + g2.thinning_mm) / (2.0 * reference_radius_mm(g2));
}

void survey_mesh(const GearTrain& train, const TrainMesh& mesh, Survey& s) {
  const GearPair pair = train.pair(mesh);
  const double backlash = circumferential_backlash_mm(pair);
  if (backlash < -tolerance::kTouch_mm) return;  // the flanks themselves overlap
  const double clearance = sweep_clearance_mm(pair);
  const MeshPlace place = mesh_clearance(pair).place;
  const bool hit = clearance < -tolerance::kTouch_mm;
  const LineOfAction line = line_of_action(pair);
  const double gap1 = start_of_active_profile1_mm(pair) - pair.profile1->root_form_radius_mm();
  const double gap2 = (pair.internal() ? -1.0 : 1.0) *
                      (start_of_active_profile2_mm(pair) - pair.profile2->root_form_radius_mm());
  const bool fillet_good = gap1 >= -1e-9 && gap2 >= -1e-9 && line.start_mm >= 0.0;
  const bool fillet_hit = hit && at_root(place);
  const double tip_clearance =
      std::min(tip_clearance_of_gear1_mm(pair), tip_clearance_of_gear2_mm(pair));
  const bool tight = std::abs(backlash) < tolerance::kTouch_mm;
  if (fillet_good && fillet_hit) s.worst_good_clearance = std::max(s.worst_good_clearance, tip_clearance);
  (pair.internal() ? (tight ? s.fillet_ring_tight : s.fillet_ring) : s.fillet_external)
      .count(fillet_good, fillet_hit);
  if (!pair.internal()) return;
  s.involute_ring.count(line.start_mm >= 0.0, hit);
  const double margin = trochoid_margin_rad(pair);
  if (std::isfinite(margin)) {
    const bool other_hit = hit && !tips_meet(place);
    if (!(margin >= 0.0 && other_hit))  // hit elsewhere: says nothing of the tips
      (tight ? s.trochoid_tight : s.trochoid_loose).count(margin >= 0.0, hit);
    const bool plain = !pair.profile1->notes().pointed && !pair.profile2->notes().pointed &&
                       !pair.profile2->notes().tip_trimmed && !pair.profile2->notes().tip_inside_base &&
                       std::abs(mesh.implied_backlash_mm) < 1e-9;
    if (plain)
      s.khk_difference = std::max(s.khk_difference, std::abs(khk_trochoid_rad(pair) - margin));
  }
  if (!hit && !std::isnan(trimming_margin_rad(pair)))
    s.trimming.count(trimming_margin_rad(pair) >= 0.0, !radial_removal(pair).at_every_rotation);
}

TEST(Criteria, AreWorthWhatTheDocumentationSays) {
  Survey s;
  int designs = 0;
  for (std::uint64_t seed = 500000; designs < survey_size(500, 2000); ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    ++designs;
    for (const TrainMesh& mesh : train->meshes) survey_mesh(*train, mesh, s);
  }
  s.fillet_external.print("start of active profile, external");
  s.fillet_ring_tight.print("start of active profile, ring, no backlash");
  s.fillet_ring.print("start of active profile, ring, backlash");
  s.involute_ring.print("KHK involute, ring");
  s.trochoid_tight.print("trochoid, no backlash");
  s.trochoid_loose.print("trochoid, backlash");
  s.trimming.print("trimming (penetrate: not radially)");
  std::printf("largest tip clearance of a penetrating mesh with a good start of active profile: %.4f m\n"
              "largest difference of the trochoid margin from KHK's with thinning: %.3g rad\n",
              s.worst_good_clearance, s.khk_difference);
  EXPECT_LT(s.khk_difference, 1e-9);
  EXPECT_EQ(s.trochoid_tight.bad_clear, 0);
  EXPECT_EQ(s.trochoid_tight.good_hit, 0);
  EXPECT_EQ(s.trochoid_loose.bad_clear, 0);
  EXPECT_GT(s.involute_ring.good_hit, 0);   // not sufficient
  EXPECT_GT(s.involute_ring.bad_clear, 0);  // not necessary
}

}  // namespace
}  // namespace trueflank::test
