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

/// The columns of some effects over a few patches. They are written side by side in a small block
/// of their own and go to the matrix a row at a time: its rows lie kilobytes apart, so that a
/// column written straight into it would miss the cache with every value.
class ColumnBlock {
 public:
  ColumnBlock(const FlankGeometry& geometry, const Patches& patches,
              const std::vector<Effect>& effects, std::span<const std::size_t> asked,
              DiscoveryProblem& problem)
      : geometry_(geometry),
        patches_(patches),
        effects_(effects),
        asked_(asked),
        problem_(problem) {
    for (const std::size_t g : asked_) {
      const CandidateGroup& group = problem.groups[g];
      if (!runs_.empty() && runs_.back().column + runs_.back().columns == group.first_column)
        runs_.back().columns += group.columns;
      else
        runs_.push_back({group.first_column, group.columns});
      width_ += static_cast<std::size_t>(group.columns);
    }
    values_.resize(width_ * kPatchesAtOnce);
  }

  void write(std::span<const std::size_t> members) {
    std::size_t column = 0;
    for (const std::size_t g : asked_) {
      write_effect(members, effects_[g], column);
      column += static_cast<std::size_t>(problem_.groups[g].columns);
    }
    const float* from = values_.data();
    for (const std::size_t i : members)
      for (const Run& run : runs_) {
        std::copy_n(from, run.columns,
                    problem_.candidates.row(static_cast<Eigen::Index>(i)).data() + run.column);
        from += run.columns;
      }
  }

 private:
  /// Columns that stand beside each other in the matrix, too.
  struct Run {
    int column = 0, columns = 0;
  };

  /// The mean of an effect's columns over each patch.
  void write_effect(std::span<const std::size_t> members, const Effect& effect,
                    std::size_t column) {
    const int columns = effect.columns();
    const bool fine = effect.family->is_fine && effect.family->is_fine(geometry_, effect.shape);
    double one[8], sum[8];
    float* to = values_.data() + column;
    for (const std::size_t i : members) {
      const Patches::Patch& patch = patches_.patches[i];
      std::fill_n(sum, columns, 0.0);
      const auto add = [&](const Place& place, double weight) {
        effect.evaluate(geometry_, place, one);
        for (int k = 0; k < columns; ++k) sum[k] += weight * one[k];
      };
      if (fine && !patch.sample.empty())
        for (const Place& place : patch.sample)
          add(place, 1.0 / static_cast<double>(patch.sample.size()));
      else
        for (const WeightedPlace& place : patch.places) add(place.place, place.weight);
      for (int k = 0; k < columns; ++k) to[k] = static_cast<float>(sum[k]);
      to += width_;
    }
  }

  const FlankGeometry& geometry_;
  const Patches& patches_;
  const std::vector<Effect>& effects_;
  std::span<const std::size_t> asked_;
  DiscoveryProblem& problem_;
  std::vector<Run> runs_;
  std::size_t width_ = 0;
  std::vector<float> values_;
};

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
                      const std::span asked(changed.data() + first,
                                            std::min(kCandidatesOfWork, changed.size() - first));
                      ColumnBlock block(geometry, patches, effects, asked, problem);
                      for (std::size_t p = 0; p < order.size(); p += kPatchesAtOnce)
                        block.write({order.data() + p, std::min(kPatchesAtOnce, order.size() - p)});
                      return true;
                    },
                    {}});
  io::run_jobs(jobs);
}

}  // namespace trueflank::loop
