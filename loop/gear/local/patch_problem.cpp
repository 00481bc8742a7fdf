// SPDX-License-Identifier: GPL-3.0-or-later
// The patches as rows of the problem that discovery solves.
#include <algorithm>
#include <map>
#include <numeric>
#include <span>

#include "trueflank/export/parallel_jobs.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

NuisanceColumns::NuisanceColumns(const FlankGeometry& geometry, const Observations& table)
    : geometry_(geometry), cos_base_helix_(geometry.cos_base_helix()) {
  // Scans come first among the sources (make_observations).
  for (const bool free : table.pose_is_free) {
    first_of_source_.push_back(count_);
    free_of_source_.push_back(free);
    count_ += free ? 5 : 1;
  }
}

void NuisanceColumns::add(const Place& place, ObservationKind kind, int source, double weight,
                          double* values) const {
  if (source >= static_cast<int>(first_of_source_.size())) return;
  if (kind == ObservationKind::kScanTip || kind == ObservationKind::kScanRoot) return;
  double* c = values + first_of_source_[source];
  const double x = place.radius_mm * place.polar_direction[0];
  const double y = place.radius_mm * place.polar_direction[1];
  const double transverse = place.surface == Surface::kFlank ? cos_base_helix_ : 1.0;
  const double nx = transverse * place.normal_direction[0];
  const double ny = transverse * place.normal_direction[1];
  c[0] += weight * (x * ny - y * nx);  // turn about the axis
  if (!free_of_source_[source]) return;
  const double nz = geometry_.normal_z(place);
  const double z = place.z_mm - 0.5 * geometry_.face_width_mm();
  c[1] += weight * nx;
  c[2] += weight * ny;
  c[3] += weight * (y * nz - z * ny);
  c[4] += weight * (z * nx - x * nz);
}

namespace {

constexpr std::size_t kCandidatesOfWork = 64, kPatchesAtOnce = 64;

/// Patches of one tooth after the other: what differs from tooth to tooth alone is asked for the
/// same angle many times in a row.
std::vector<std::size_t> by_tooth(const Patches& patches) {
  std::vector<std::size_t> order(patches.patches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return patches.patches[a].places.front().place.tooth <
           patches.patches[b].places.front().place.tooth;
  });
  return order;
}

/// Writes the columns of one effect over some patches: its mean over each of them.
void write_columns(const FlankGeometry& geometry, const Patches& patches,
                   std::span<const std::size_t> members, const Effect& effect,
                   const CandidateGroup& group, DiscoveryProblem& problem) {
  const bool fine = effect.family->is_fine && effect.family->is_fine(geometry, effect.shape);
  double one[8], sum[8];
  for (const std::size_t i : members) {
    const Patches::Patch& patch = patches.patches[i];
    std::fill_n(sum, group.columns, 0.0);
    const auto add = [&](const Place& place, double weight) {
      effect.evaluate(geometry, place, one);
      for (int k = 0; k < group.columns; ++k) sum[k] += weight * one[k];
    };
    if (fine && !patch.sample.empty())
      for (const Place& place : patch.sample)
        add(place, 1.0 / static_cast<double>(patch.sample.size()));
    else
      for (const WeightedPlace& place : patch.places) add(place.place, place.weight);
    for (int k = 0; k < group.columns; ++k)
      problem.candidates(static_cast<Eigen::Index>(i), group.first_column + k) =
          static_cast<float>(sum[k]);
  }
}

/// Groups of the effects, in order.
std::vector<CandidateGroup> groups_of(const Patches& patches, const std::vector<Effect>& effects) {
  const bool traces_only =
      std::all_of(patches.patches.begin(), patches.patches.end(), [](const auto& patch) {
        return patch.kind == ObservationKind::kProfile || patch.kind == ObservationKind::kHelix ||
               patch.kind == ObservationKind::kIndex;
      });
  std::vector<CandidateGroup> groups;
  int columns = 0, kin = 0;
  const EffectFamily* before = nullptr;
  std::map<const EffectFamily*, int> local_families;
  for (const Effect& effect : effects) {
    if (effect.family != before) ++kin;
    before = effect.family;
    CandidateGroup group;
    group.first_column = columns;
    group.columns = effect.columns();
    group.preference = effect.family->preference +
                       (effect.flank != FlankChoice::kBoth && !effect.family->local ? 2 : 0);
    if (traces_only) group.preference += effect.family->penalty_of_traces;
    group.named = effect.family->named;
    if (effect.family->complexity) group.complexity = effect.family->complexity(effect.shape);
    if (effect.family->local)
      group.local_family =
          local_families.emplace(effect.family, static_cast<int>(local_families.size()))
              .first->second;
    if (effect.family->shape_is_continuous) group.kin = 3 * kin + static_cast<int>(effect.flank);
    groups.push_back(group);
    columns += group.columns;
  }
  return groups;
}

}  // namespace

DiscoveryProblem make_problem(const FlankGeometry& geometry, const Observations& table,
                              const Patches& patches, const std::vector<Effect>& effects) {
  const NuisanceColumns nuisance(geometry, table);
  DiscoveryProblem problem;
  const auto n = static_cast<Eigen::Index>(patches.patches.size());
  if (std::any_of(patches.patches.begin(), patches.patches.end(),
                  [](const auto& patch) { return patch.fold == kAnchorFold; }))
    problem.anchor_fold = kAnchorFold;
  problem.value.resize(n);
  problem.weight.resize(n);
  problem.nuisance.setZero(n, nuisance.count());
  Eigen::VectorXd pose(nuisance.count());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Patches::Patch& patch = patches.patches[static_cast<std::size_t>(i)];
    problem.value[i] = patch.mean_um;
    problem.weight[i] = patch.weight;
    problem.unit.push_back(patch.unit);
    problem.fold.push_back(patch.fold);
    problem.zero.push_back(patch.zero);
    problem.whole.push_back(patch.whole);
    pose.setZero();
    for (const WeightedPlace& place : patch.places)
      nuisance.add(place.place, patch.kind, patch.source, place.weight, pose.data());
    problem.nuisance.row(i) = pose.transpose();
  }
  set_candidates(geometry, patches, {}, effects, problem);
  return problem;
}

void set_candidates(const FlankGeometry& geometry, const Patches& patches,
                    const std::vector<Effect>& before, const std::vector<Effect>& effects,
                    DiscoveryProblem& problem) {
  const std::vector<CandidateGroup> stood = std::move(problem.groups);
  problem.groups = groups_of(patches, effects);
  const auto n = static_cast<Eigen::Index>(patches.patches.size());
  const Eigen::Index columns =
      problem.groups.empty() ? 0
                             : problem.groups.back().first_column + problem.groups.back().columns;
  problem.candidates.conservativeResize(n, columns);
  std::vector<std::size_t> changed;
  for (std::size_t g = 0; g < effects.size(); ++g)
    if (g >= before.size() || g >= stood.size() || !(before[g] == effects[g]) ||
        stood[g].first_column != problem.groups[g].first_column)
      changed.push_back(g);
  // Candidates do not ask each other: the same columns on any number of processors. A few patches
  // at a time, so that their rows of the matrix stay at hand.
  const std::vector<std::size_t> order = by_tooth(patches);
  std::vector<io::QueuedJob> jobs;
  for (std::size_t first = 0; first < changed.size(); first += kCandidatesOfWork)
    jobs.push_back({[&, first] {
                      const std::size_t end = std::min(changed.size(), first + kCandidatesOfWork);
                      for (std::size_t p = 0; p < order.size(); p += kPatchesAtOnce) {
                        const std::span members(order.data() + p,
                                                std::min(kPatchesAtOnce, order.size() - p));
                        for (std::size_t i = first; i < end; ++i)
                          write_columns(geometry, patches, members, effects[changed[i]],
                                        problem.groups[changed[i]], problem);
                      }
                      return true;
                    },
                    {}});
  io::run_jobs(jobs);
}

}  // namespace trueflank::loop
