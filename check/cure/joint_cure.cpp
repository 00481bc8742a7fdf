// SPDX-License-Identifier: GPL-3.0-or-later
//
// Candidates in the order of their size. For every set of common values (centre distance, backlash, rack) each
// layer seeks the smallest shift of its leading gear by itself; tips follow, as short as the mates ask. What
// needs no turning sorts most candidates out; the best are judged by every check.
#include "trueflank/check/cure/joint_cure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/contact_judgement.h"
#include "trueflank/check/cure/cure_trial.h"
#include "trueflank/check/cure/design_change.h"
#include "trueflank/check/cure/farther_designs.h"
#include "trueflank/check/cure/joint_cure_moves.h"
#include "trueflank/check/cure/needed_changes.h"
#include "trueflank/check/cure/shortened_tips.h"
#include "trueflank/check/design_tolerances.h"
#include "trueflank/train/stages.h"

namespace trueflank {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kMoreForHousing =
    1.0;  // more expensive teeth are tried too: a housing may not take the first
constexpr int kMostSets = 40, kMostPairs = 150;  // tooth counts tried of planetary sets and of pairs
constexpr int kMostJudged = 6;                // candidates that every check judges

class Search {
 public:
  Search(const GearTrain& train, const JointCureOptions& options, const AroundGears& around)
      : train_(train),
        options_(options),
        around_(around),
        layers_(meshing_layers(train)),
        warned_(warned_gears(train, 0)) {
    fits_ = shifts_fit(train);
    for (const Complaint& c : ContactJudge::without_turning(train).complaints)
      if (c.id == "axial") layer_gap_mm_ = c.lacking * train.design.module_mm + 0.2 * train.design.module_mm;
    lacking_backlash_ = wanted_backlash_mm() / train.design.module_mm;
    if (around)
      for (const Finding& f : around(train).value_or(Findings{})) ids_around_.insert(f.id);
  }

  JointCure run(const Findings& before) {
    JointCure result{.design = train_.design, .findings = before, .changed = false, .conflict = {}};
    for (DesignChange common : common_moves(train_)) {
      common.backlash += lacking_backlash_;
      if (spent() || common.cost() >= cost_of_cleanest_) break;
      try_common(common);
      // planets that do not mesh at equal spacing: nothing but teeth and their number mends that
      if (!train_.assembly.equal_spacing) break;
    }
    result.search_ended = !spent();
    if (trials_.empty() || !trials_.front().passes()) try_teeth();
    choose(result);
    if (!result.cured())
      result.conflict = gears_pass(result.findings)
                            ? "the gears pass; what is around them has to follow by hand"
                            : conflict_text(failed_together_, result.findings);
    return result;
  }

  /// Every check of a design; nothing where it cannot be laid out or its parts cannot be made.
  [[nodiscard]] std::optional<Findings> judged(const GearboxDesign& design) const {
    const auto laid = lay_out(design);
    if (!laid) return std::nullopt;
    Findings findings = check_gearbox(*laid);
    if (!around_) return findings;
    const auto more = around_(*laid);
    if (!more) return std::nullopt;
    findings.insert(findings.end(), more->begin(), more->end());
    return findings;
  }

  /// Without what the verdict does not need.
  void reduce(JointCure& result) const {
    const bool cured = result.cured();
    const DesignJudge judge = [&](const GearboxDesign& d) {
      return cured ? judged_where_gears_pass(d) : judged(d);
    };
    JudgedDesign needed =
        with_needed_changes(train_, {std::move(result.design), std::move(result.findings)}, judge,
                            options_.most_judged);
    result.changed = !(needed.design == train_.design);
    result.design = std::move(needed.design);
    result.findings = std::move(needed.findings);
  }

  /// The verdict on the gears alone.
  [[nodiscard]] bool gears_pass(const Findings& findings) const {
    return std::none_of(findings.begin(), findings.end(), [&](const Finding& f) {
      return f.status == CheckStatus::kFail && !ids_around_.contains(f.id);
    });
  }

 private:
  /// What tolerances and the clearance that is asked for need beyond the backlash there is.
  [[nodiscard]] double wanted_backlash_mm() const {
    return rounded_up(std::max(lacking_backlash_mm(train_), lacking_for_clearance_mm(train_)));
  }

  /// Centre distances and backlash are written to 0.1 um.
  [[nodiscard]] static double rounded_up(double backlash_mm) { return backlash_mm > 0.0 ? backlash_mm + 2e-4 : 0.0; }

  /// So many times what the options allow.
  [[nodiscard]] bool spent(int times = 1) const {
    return designs_ >= times * options_.most_designs ||
           judge_.turned() + bisected_ / 2 >= times * options_.most_turned;
  }

  /// The parts of a change can be made, with the gears what stands around them.
  [[nodiscard]] bool can_be_made(const DesignChange& change) const {
    const auto laid = lay_out(changed_design(train_, change, fits_));
    return !around_ || (laid && around_(*laid));
  }

  void keep(CureTrial trial) {
    if (trial.clean() && !can_be_made(trial.change)) return;  // others are to be sought
    if (trial.clean()) cost_of_cleanest_ = std::min(cost_of_cleanest_, trial.cost);
    trials_.push_back(std::move(trial));
    std::stable_sort(trials_.begin(), trials_.end(), better);
    if (trials_.size() > kMostJudged) trials_.pop_back();
  }

  /// Every layer's smallest shift with these common values.
  void try_common(DesignChange common) {
    common.layer_gap_mm = layer_gap_mm_;
    DesignChange joint = common;
    bool all = true;
    for (const int layer : layers_) {
      std::optional<CureTrial> best;
      for (const double shift : shift_moves()) {
        if (spent() || common.cost() + std::abs(shift) >= std::min(cost_of_cleanest_, best && best->clean() ? best->cost : kEndless))
          break;
        DesignChange change = common;
        change.shift_of_layer[layer] = shift;
        const CureTrial trial = tried(change, layer);
        if (!best || better(trial, *best)) best = trial;
      }
      if (!best) return;
      all = all && best->passes();
      joint.shift_of_layer[layer] = best->change.shift_of_layer[layer];
    }
    const bool nearest = trials_.empty() || !trials_.front().passes();
    if (layers_.size() > 1 || all || nearest) keep(tried(joint, 0));
  }

  void try_teeth() {
    cost_of_cleanest_ = kEndless;
    int tried_sets = 0;
    for (const DesignChange& move : teeth_moves(train_)) {
      if (spent(2)) return;
      if (move.cost() >= cost_of_cleanest_ + (train_.design.machine ? kMoreForHousing : 0.0))
        continue;
      DesignChange change = move;
      change.layer_gap_mm = layer_gap_mm_;
      change.backlash = lacking_backlash_;
      const auto laid = lay_out(changed_design(train_, change, fits_));
      ++designs_;
      if (!laid || !laid->assembly.equal_spacing || planets_collide(*laid)) continue;
      if (++tried_sets > (train_.design.planets < 2 ? kMostPairs : kMostSets)) return;
      DesignChange joint = change;
      for (const int layer : layers_) {
        std::optional<CureTrial> best;
        for (const double shift : coarse_shift_moves()) {
          DesignChange moved = change;
          moved.shift_of_layer[layer] = shift;
          const CureTrial trial = tried(moved, layer);
          if (!best || better(trial, *best)) best = trial;
          if (best->clean()) break;
        }
        joint.shift_of_layer[layer] = best->change.shift_of_layer[layer];
      }
      keep(tried(joint, 0));
    }
  }

  /// Lays a change out, shortens tips until they clear, and judges it.
  CureTrial tried(DesignChange change, int layer) {
    CureTrial trial;
    trial.cost = change.cost();
    ++designs_;
    auto laid = lay_out(changed_design(train_, change, fits_));
    if (const double more = laid ? lacking_for_clearance_mm(*laid) : 0.0; more > 0.0) {
      change.backlash += rounded_up(more) / train_.design.module_mm;
      laid = lay_out(changed_design(train_, change, fits_));
    }
    if (!laid) {
      trial.change = std::move(change);
      return trial;
    }
    Judgement judgement;
    for (int round = 0; round < 4; ++round) {
      judgement = ContactJudge::without_turning(*laid, layer);
      bool shortened = shorten_given(*laid, judgement, change) || shorten_at_roots(*laid, judgement, change);
      if (!shortened && judgement.failing() == 0.0) {
        const Judgement turned = judge_.by_turning(*laid, layer);
        judgement.complaints.insert(judgement.complaints.end(), turned.complaints.begin(), turned.complaints.end());
        shortened = !turned.clean() && round < 3 &&
                    shorten_in_the_way(*laid, layer, judge_, bisected_, change);
      }
      if (!shortened) break;
      auto again = lay_out(changed_design(train_, change, fits_));
      if (!again) break;
      laid = std::move(again);
    }
    for (const std::string& place : warned_gears(*laid, layer))
      if (!warned_.contains(place))
        judgement.complaints.push_back({.id = place.substr(0, place.find('@')), .layer = layer, .lacking = 0.01});
    trial.failing = judgement.failing();
    trial.worrying = judgement.worrying();
    trial.cost = change.cost() + tip_cost(train_, change);
    remember(judgement);
    trial.change = std::move(change);
    return trial;
  }

  void remember(const Judgement& judgement) {
    std::set<std::string> ids;
    for (const Complaint& c : judgement.complaints)
      if (c.fails) ids.insert(c.id);
    if (!ids.empty()) ++failed_together_[ids];
  }

  /// The same, but no answer where the contact fails already.
  [[nodiscard]] std::optional<Findings> judged_where_gears_pass(const GearboxDesign& design) const {
    const auto laid = lay_out(design);
    if (!laid || ContactJudge::without_turning(*laid).failing() > 0.0) return std::nullopt;
    return judged(design);
  }

  /// The design, and where parts around it fail, the same with a housing as large as it must be.
  [[nodiscard]] std::optional<JudgedDesign> judged_with_housing(const GearboxDesign& design) const {
    std::optional<JudgedDesign> best;
    if (auto findings = judged(design)) best = {design, std::move(*findings)};
    const bool passes = best && verdict(best->findings) != CheckStatus::kFail,
               fixed_size = design.machine && design.machine->housing.outer_diameter_mm;
    if (passes || !fixed_size) return best;
    GearboxDesign free = design;
    free.machine->housing.outer_diameter_mm.reset();
    auto freed = judged(free);
    if (freed && (!best || count_of(*freed, CheckStatus::kFail) <
                               count_of(best->findings, CheckStatus::kFail)))
      best = {std::move(free), std::move(*freed)};
    return best;
  }

  /// The best that every check agrees with.
  void choose(JointCure& result) {
    const Findings before = result.findings;
    int fails = count_of(before, CheckStatus::kFail), warns = count_of(before, CheckStatus::kWarn);
    for (CureTrial& trial : trials_) {
      if (trial.passes()) shrink(trial);
      auto found = judged_with_housing(changed_design(train_, trial.change, fits_));
      if (!found || found->design == train_.design) continue;
      const int f = count_of(found->findings, CheckStatus::kFail),
                w = count_of(found->findings, CheckStatus::kWarn);
      if (f > fails || (f == fails && w >= warns) ||
          any_newly_fails(before, found->findings, ids_around_))
        continue;
      fails = f;
      warns = w;
      result.design = std::move(found->design);
      result.findings = std::move(found->findings);
      result.changed = true;
      if (fails == 0 && trial.clean()) break;
    }
    if (result.changed) reduce(result);
  }

  /// Shifts and centre distance as near to the old ones as the verdict allows.
  void shrink(CureTrial& trial) {
    const auto smaller = [&](const auto& change_at) {
      for (double share = 0.5; share > 0.1; share *= 0.5) {
        DesignChange change = trial.change;
        change.tip_diameter_mm.clear();
        change_at(change, 1.0 - share);
        const CureTrial shrunk = tried(change, 0);
        if (better(shrunk, trial)) trial = shrunk;
      }
    };
    if (!trial.change.teeth.empty()) return;
    if (trial.change.centre_distance != 0.0)
      smaller([](DesignChange& c, double factor) { c.centre_distance *= factor; });
    for (const int layer : layers_)
      if (trial.change.shift_of_layer[layer] != 0.0)
        smaller([layer](DesignChange& c, double factor) { c.shift_of_layer[layer] *= factor; });
  }

  const GearTrain& train_;
  JointCureOptions options_;
  const AroundGears& around_;
  std::set<std::string> ids_around_;
  std::vector<int> layers_;
  std::set<std::string> warned_;
  bool fits_ = true;
  double layer_gap_mm_ = 0.0;
  double lacking_backlash_ = 0.0;  ///< modules
  ContactJudge judge_;
  int designs_ = 0, bisected_ = 0;
  double cost_of_cleanest_ = kEndless;
  std::vector<CureTrial> trials_;  ///< the best, best first
  FailedTogether failed_together_;
};

/// Each stage that fails (or, where none does, that warns) cured by itself, one after the other, and the whole
/// judged.
JointCure cure_of_stages(const GearTrain& train, const Findings& findings, const JointCureOptions& options) {
  JointCure whole{.design = train.design, .findings = findings};
  const bool failing = verdict(findings) == CheckStatus::kFail;
  for (int number = 1; number <= train.topology().stage_count(); ++number) {
    const auto stage = lay_out(stage_design(whole.design, number));
    if (!stage) continue;
    const Findings own = check_gearbox(*stage);
    if (failing && verdict(own) != CheckStatus::kFail) continue;
    const JointCure cure = joint_cure(*stage, own, options);
    whole.search_ended = whole.search_ended && cure.search_ended;
    if (whole.conflict.empty()) whole.conflict = cure.conflict;
    if (!cure.changed) continue;
    GearboxDesign changed = whole.design;
    set_stage(cure.design, number, changed);
    const auto laid = lay_out(changed);
    if (!laid) continue;
    Findings after = check_gearbox(*laid);
    if (count_of(after, CheckStatus::kFail) > count_of(whole.findings, CheckStatus::kFail)) continue;
    whole.design = std::move(changed);
    whole.findings = std::move(after);
    whole.changed = true;
  }
  if (whole.cured()) whole.conflict.clear();
  return whole;
}

}  // namespace

JointCure joint_cure(const GearTrain& train, const JointCureOptions& options) {
  return joint_cure(train, check_gearbox(train), options);
}

JointCure joint_cure(const GearTrain& train, const Findings& findings,
                     const JointCureOptions& options, const AroundGears& around) {
  if (!train.stages.empty()) return cure_of_stages(train, findings, options);
  Search search(train, options, around);
  JointCure near = search.run(findings);
  if (near.cured() || !options.farther || search.gears_pass(near.findings)) return near;
  // from a design that is farther away, with what is not needed of the way taken back
  for (const GearboxDesign& start : farther_designs(train)) {
    const auto laid = lay_out(start);
    if (!laid) continue;
    Search there(*laid, kCheckSearch, around);
    auto judged = there.judged(start);
    if (!judged) continue;
    JointCure far = there.run(*judged);
    if (!far.cured()) continue;
    far.changed = true;
    far.search_ended = near.search_ended;
    search.reduce(far);
    return far;
  }
  return near;
}

}  // namespace trueflank
