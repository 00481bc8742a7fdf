// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/simulation_comparison.h"

#include <cmath>
#include <cstdio>

#include "tests/check/mesh_simulation.h"
#include "tests/check/random_pairs.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_clearance.h"

namespace trueflank::test {
namespace {

void count_kind(const GearPair& pair, bool compound, Comparison& c) {
  ++c.meshes;
  if (!pair.internal()) ++c.external;
  if (pair.internal())
    ++(pair.gear2().ring_root == RingRoot::kShaper ? c.shaper_rings : c.fillet_rings);
  if (pair.profile1->notes().undercut || pair.profile2->notes().undercut) ++c.undercut;
  if (pair.gear1().thinning_mm > 0.0 || pair.gear2().thinning_mm > 0.0) ++c.thinned;
  if (compound) ++c.compound;
}

void compare_mesh(const GearTrain& train, const TrainMesh& mesh, std::uint64_t seed, Comparison& c) {
  const GearPair pair = train.pair(mesh);
  count_kind(pair, train.find("planet2") != nullptr, c);
  const MeshClearance ours = mesh_clearance(pair);
  const SimulatedClearance theirs = simulate_mesh(pair);
  const bool our_fail = ours.clearance_mm < -tolerance::kTouch_mm;
  const bool their_fail = theirs.clearance_mm < 0.0;
  const bool grey = std::abs(theirs.clearance_mm) < kGreyZone_mm;
  const double ours_cut = std::fmin(ours.clearance_mm, theirs.window_mm);
  double difference = std::abs(ours_cut - theirs.clearance_mm);
  if (theirs.clearance_mm <= -theirs.window_mm * 0.999) difference = 0.0;  // cut off
  c.largest_difference_mm = std::fmax(c.largest_difference_mm, difference);
  if (grey) ++c.grey;
  if (!grey && our_fail != their_fail) ++c.wrong;
  if (!grey && our_fail && their_fail) ++c.failing;
  const bool cross = ours.exact == ExactVerdict::kCross;
  const bool exact_wrong = std::abs(ours.clearance_mm) > ours.chord_error_mm && cross != our_fail;
  if (exact_wrong) ++c.exact_wrong;
  if ((!grey && our_fail != their_fail) || exact_wrong || difference > kGreyZone_mm)
    std::printf("seed %llu %s: sweep %.4f um, simulation %.4f um, exact %s, %s\n  %s\n",
                static_cast<unsigned long long>(seed), mesh.name.c_str(), 1e3 * ours.clearance_mm,
                1e3 * theirs.clearance_mm, cross ? "cross" : "apart",
                place_text(ours.place, "1", "2").c_str(), describe(train.design).c_str());
}

}  // namespace

Comparison compare_with_simulation(std::uint64_t first_seed, int designs) {
  Comparison c;
  for (std::uint64_t seed = first_seed; c.designs < designs; ++seed) {
    const auto train = lay_out(random_design(seed));
    if (!train) continue;
    ++c.designs;
    for (const TrainMesh& mesh : train->meshes) compare_mesh(*train, mesh, seed, c);
  }
  std::printf("%d designs, %d meshes (%d external, %d fillet rings, %d shaper rings, %d undercut, "
              "%d thinned, %d of 3k sets): %d penetrate, %d within the grey zone, %d wrong, "
              "%d exact verdicts wrong, largest difference %.3f um\n",
              c.designs, c.meshes, c.external, c.fillet_rings, c.shaper_rings, c.undercut, c.thinned,
              c.compound, c.failing, c.grey, c.wrong, c.exact_wrong, 1e3 * c.largest_difference_mm);
  return c;
}

}  // namespace trueflank::test
