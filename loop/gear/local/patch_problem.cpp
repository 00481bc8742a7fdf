// SPDX-License-Identifier: GPL-3.0-or-later
// The patches as rows of the problem that discovery solves.
#include <algorithm>
#include <map>
#include <span>

#include "trueflank/base/large_pages.h"
#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/kept_sums.h"
#include "trueflank/loop/gear/local/patches.h"

namespace trueflank::loop {

NuisanceColumns::NuisanceColumns(const FlankGeometry& geometry, const Observations& table)
    : geometry_(geometry), cos_base_helix_(geometry.cos_base_helix()) {
  // Scans come first among the sources (make_observations).
  for (const bool free : table.pose_is_free) {
    sources_.push_back({count_, free});
    count_ += free ? kOfFreePose : 1;
  }
}

namespace {

constexpr std::size_t kRowsOfColumns = 256, kRowsOfProblem = 2048;

/// Effects of one family that stand beside each other, in the matrix too.
struct EffectRun {
  EffectsTogether effects;
  int column = 0;
  bool fine = false;  ///< they vary within a patch
};

std::vector<EffectRun> runs_of(const FlankGeometry& geometry, const std::vector<Effect>& effects,
                               const std::vector<CandidateGroup>& groups,
                               const std::vector<std::size_t>& asked) {
  const auto is_fine = [&](const Effect& effect) {
    return effect.family->is_fine && effect.family->is_fine(geometry, effect.shape);
  };
  std::vector<EffectRun> runs;
  for (std::size_t i = 0, end = 0; i < asked.size(); i = end) {
    const std::size_t first = asked[i];
    const bool fine = is_fine(effects[first]);
    for (end = i + 1; end < asked.size(); ++end)
      if (asked[end] != first + (end - i) || effects[asked[end]].family != effects[first].family ||
          is_fine(effects[asked[end]]) != fine)
        break;
    runs.push_back({EffectsTogether(std::span(effects).subspan(first, end - i)),
                    groups[first].first_column, fine});
  }
  return runs;
}

/// Writes the mean of the effects' columns over a patch into its row.
class RowOfPatch {
 public:
  RowOfPatch(const FlankGeometry& geometry, const std::vector<EffectRun>& runs)
      : geometry_(geometry), runs_(runs) {
    int widest = 0;
    for (const EffectRun& run : runs) widest = std::max(widest, run.effects.columns());
    one_.resize(static_cast<std::size_t>(widest));
    sum_.resize(static_cast<std::size_t>(widest));
  }

  void write(const Patches::Patch& patch, float* row) {
    for (const EffectRun& run : runs_) {
      const int columns = run.effects.columns();
      if (is_one_place(patch) && !run.fine) {
        run.effects.evaluate(geometry_, patch.places.front().place, one_.data());
        std::transform(one_.begin(), one_.begin() + columns, row + run.column,
                       [](double value) { return static_cast<float>(value); });
        continue;
      }
      std::fill_n(sum_.begin(), columns, 0.0);
      if (run.fine && !patch.sample.empty())
        for (const Place& place : patch.sample)
          add(run, place, 1.0 / static_cast<double>(patch.sample.size()));
      else
        for (const WeightedPlace& place : patch.places) add(run, place.place, place.weight);
      std::transform(sum_.begin(), sum_.begin() + columns, row + run.column,
                     [](double value) { return static_cast<float>(value); });
    }
  }

 private:
  static bool is_one_place(const Patches::Patch& patch) {
    return patch.places.size() == 1 && patch.places.front().weight == 1.0;
  }
  void add(const EffectRun& run, const Place& place, double weight) {
    run.effects.evaluate(geometry_, place, one_.data());
    for (std::size_t k = 0; k < static_cast<std::size_t>(run.effects.columns()); ++k)
      sum_[k] += weight * one_[k];
  }

  const FlankGeometry& geometry_;
  const std::vector<EffectRun>& runs_;
  std::vector<double> one_, sum_;
};

/// Neighbouring columns that another problem has.
struct CopiedColumns {
  int from = 0, to = 0, count = 0;
};

/// Takes out of `asked` what is known. Not of families whose effects are computed from each other:
/// their last digits depend on which are asked together.
std::vector<CopiedColumns> take_known(const KnownColumns& known, const std::vector<Effect>& effects,
                                      const std::vector<CandidateGroup>& groups,
                                      std::vector<std::size_t>& asked) {
  std::vector<CopiedColumns> copies;
  std::erase_if(asked, [&](std::size_t g) {
    if (effects[g].family->evaluate_together) return false;
    const auto found = std::find(known.effects.begin(), known.effects.end(), effects[g]);
    if (found == known.effects.end()) return false;
    const auto at = static_cast<std::size_t>(found - known.effects.begin());
    const CopiedColumns copy{known.problem.groups[at].first_column, groups[g].first_column,
                             groups[g].columns};
    if (!copies.empty() && copies.back().from + copies.back().count == copy.from &&
        copies.back().to + copies.back().count == copy.to)
      copies.back().count += copy.count;
    else
      copies.push_back(copy);
    return true;
  });
  return copies;
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
    if (effect.family->shape_is_continuous || effect.family->is_one_of_its_shapes)
      group.kin = 3 * kin + static_cast<int>(effect.flank);
    groups.push_back(group);
    columns += group.columns;
  }
  return groups;
}

}  // namespace

DiscoveryProblem make_problem(const FlankGeometry& geometry, const Observations& table,
                              const Patches& patches, const std::vector<Effect>& effects,
                              const KnownColumns* known) {
  const NuisanceColumns nuisance(geometry, table);
  DiscoveryProblem problem;
  const auto n = static_cast<Eigen::Index>(patches.patches.size());
  if (std::any_of(patches.patches.begin(), patches.patches.end(),
                  [](const auto& patch) { return patch.fold == kAnchorFold; }))
    problem.anchor_fold = kAnchorFold;
  problem.value.resize(n);
  problem.weight.resize(n);
  problem.nuisance.setZero(n, nuisance.count());
  // Of few values, each its own, flips tell as little as of few traces.
  const bool single_values_only =
      std::all_of(patches.patches.begin(), patches.patches.end(), [](const auto& patch) {
        return patch.kind == ObservationKind::kIndex || patch.kind == ObservationKind::kRadial;
      });
  for (std::vector<int>* numbers : {&problem.unit, &problem.fold, &problem.zero, &problem.whole})
    numbers->resize(patches.patches.size());
  for_each_run(patches.patches.size(), kRowsOfProblem, [&](std::size_t from, std::size_t to) {
    Eigen::VectorXd pose(nuisance.count());
    for (std::size_t at = from; at < to; ++at) {
      const Patches::Patch& patch = patches.patches[at];
      const auto i = static_cast<Eigen::Index>(at);
      problem.value[i] = patch.mean_um;
      problem.weight[i] = patch.weight;
      problem.unit[at] = patch.unit;
      problem.fold[at] = patch.fold;
      problem.zero[at] = patch.zero;
      problem.whole[at] = single_values_only ? static_cast<int>(i) : patch.whole;
      pose.setZero();
      for (const WeightedPlace& place : patch.places)
        nuisance.add(place.place, patch.kind, patch.source, place.weight, pose.data());
      problem.nuisance.row(i) = pose.transpose();
    }
  });
  set_candidates(geometry, patches, {}, effects, problem, known);
  return problem;
}

void set_candidates(const FlankGeometry& geometry, const Patches& patches,
                    const std::vector<Effect>& before, const std::vector<Effect>& effects,
                    DiscoveryProblem& problem, const KnownColumns* known) {
  const std::vector<CandidateGroup> stood = std::move(problem.groups);
  problem.groups = groups_of(patches, effects);
  const auto n = static_cast<Eigen::Index>(patches.patches.size());
  const Eigen::Index columns =
      problem.groups.empty() ? 0
                             : problem.groups.back().first_column + problem.groups.back().columns;
  problem.candidates.conservativeResize(n, columns);
  if (before.empty())
    ask_for_large_pages(problem.candidates.data(),
                        static_cast<std::size_t>(problem.candidates.size()) * sizeof(float));
  std::vector<std::size_t> changed;
  for (std::size_t g = 0; g < effects.size(); ++g)
    if (g >= before.size() || g >= stood.size() || !(before[g] == effects[g]) ||
        stood[g].first_column != problem.groups[g].first_column)
      changed.push_back(g);
  if (problem.kept)
    for (const std::size_t g : changed) problem.kept->forget(g);
  const std::vector<CopiedColumns> copies =
      known != nullptr ? take_known(*known, effects, problem.groups, changed)
                       : std::vector<CopiedColumns>();
  // Patches do not ask each other: the same columns on any number of processors.
  const std::vector<EffectRun> runs = runs_of(geometry, effects, problem.groups, changed);
  if (runs.empty() && copies.empty()) return;
  for_each_run(patches.patches.size(), kRowsOfColumns, [&](std::size_t from, std::size_t to) {
    RowOfPatch row(geometry, runs);
    for (std::size_t i = from; i < to; ++i) {
      float* const values = problem.candidates.row(static_cast<Eigen::Index>(i)).data();
      row.write(patches.patches[i], values);
      if (copies.empty()) continue;
      const float* const other = known->problem.candidates.row(static_cast<Eigen::Index>(i)).data();
      for (const CopiedColumns& copy : copies)
        std::copy_n(other + copy.from, copy.count, values + copy.to);
    }
  });
}

}  // namespace trueflank::loop
