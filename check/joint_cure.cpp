// SPDX-License-Identifier: GPL-3.0-or-later
//
// Candidates in the order of their size. For every set of common values (centre distance, backlash, rack) each
// layer seeks the smallest shift of its leading gear by itself; tips follow, as short as the mates ask. What
// needs no turning sorts most candidates out; the best are judged by every check.
#include "trueflank/check/joint_cure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/contact_judgement.h"
#include "trueflank/check/design_change.h"
#include "trueflank/check/design_tolerances.h"
#include "trueflank/check/interference_cure.h"
#include "trueflank/check/joint_cure_moves.h"
#include "trueflank/check/profile.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/check/undercut.h"

namespace trueflank {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kWantedTipClearance = 0.1;   // of the module
constexpr double kWrittenTip_mm = 1e-3;       // tip diameters are written so
constexpr int kMostJudged = 6;                // candidates that every check judges

struct Trial {
  DesignChange change;
  double cost = kFar;
  double failing = kFar, worrying = kFar;
  [[nodiscard]] bool passes() const { return failing == 0.0; }
  [[nodiscard]] bool clean() const { return passes() && worrying == 0.0; }
};

/// Cleaner first, then smaller.
bool better(const Trial& a, const Trial& b) {
  if (a.failing != b.failing) return a.failing < b.failing;
  if (a.clean() != b.clean()) return a.clean();
  if (!a.clean() && std::abs(a.worrying - b.worrying) > 0.5) return a.worrying < b.worrying;
  return a.cost < b.cost;
}

std::set<std::string> warned(const GearTrain& train, int layer) {
  std::set<std::string> places;
  for (const auto check : {check_profile, check_undercut, check_tip_thickness})
    for (const Finding& f : check(train)) {
      const TrainGear* gear = train.find(f.where);
      if (f.status == CheckStatus::kWarn && gear && (layer == 0 || gear->layer == layer))
        places.insert(f.id + "@" + f.where);
    }
  return places;
}

int count(const Findings& findings, CheckStatus status) {
  return static_cast<int>(std::count_if(findings.begin(), findings.end(),
                                        [&](const Finding& f) { return f.status == status; }));
}

/// A check that passed fails now.
bool any_newly_fails(const Findings& before, const Findings& after) {
  const auto passed = [&](const Finding& asked) {
    return std::any_of(before.begin(), before.end(), [&](const Finding& f) {
      return f.id == asked.id && f.where == asked.where && f.status == CheckStatus::kPass;
    });
  };
  return std::any_of(after.begin(), after.end(),
                     [&](const Finding& f) { return f.status == CheckStatus::kFail && passed(f); });
}

bool complained(const Judgement& judgement, const char* id) {
  return std::any_of(judgement.complaints.begin(), judgement.complaints.end(),
                     [&](const Complaint& c) { return c.id == id; });
}

class Search {
 public:
  Search(const GearTrain& train, const JointCureOptions& options)
      : train_(train), options_(options), layers_(meshing_layers(train)), warned_(warned(train, 0)) {
    fits_ = std::all_of(train.meshes.begin(), train.meshes.end(), [&](const TrainMesh& mesh) {
      const double implied = mesh.implied_backlash_mm / train.design.module_mm;
      return implied > -1e-4 && implied < 0.25;
    });
    for (const Complaint& c : ContactJudge::without_turning(train).complaints)
      if (c.id == "axial") layer_gap_mm_ = c.lacking * train.design.module_mm + 0.2 * train.design.module_mm;
    lacking_backlash_ = wanted_backlash_mm() / train.design.module_mm;
  }

  JointCure run(const Findings& before) {
    JointCure result{.design = train_.design, .findings = before, .changed = false, .conflict = {}};
    for (DesignChange common : common_moves()) {
      common.backlash += lacking_backlash_;
      if (spent() || common.cost() >= cost_of_cleanest_) break;
      try_common(common);
    }
    result.search_ended = !spent();
    if (trials_.empty() || !trials_.front().passes()) try_teeth();
    choose(result);
    if (!result.cured()) result.conflict = conflict_text();
    return result;
  }

 private:
  /// What tolerances and the clearance that is asked for need beyond the backlash there is.
  [[nodiscard]] double wanted_backlash_mm() const {
    double wanted = lacking_backlash_mm(train_);
    const double asked = train_.design.made.clearance_mm.value_or(0.0);
    if (asked > 0.0)
      for (const TrainMesh& mesh : train_.meshes) {
        const GearPair pair = train_.pair(mesh);
        const double normal = std::cos(working_pressure_angle_rad(pair)) * std::cos(base_helix_angle_rad(pair.gear1()));
        wanted = std::max(wanted, 2.0 * asked / normal - mesh.backlash_mm);
      }
    return wanted > 0.0 ? wanted + 2e-4 : 0.0;  // centre distances and backlash are written to 0.1 um
  }

  [[nodiscard]] bool spent() const {
    return designs_ >= options_.most_designs || judge_.turned() + bisected_ / 2 >= options_.most_turned;
  }

  void keep(Trial trial) {
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
      std::optional<Trial> best;
      for (const double shift : shift_moves()) {
        if (spent() || common.cost() + std::abs(shift) >= std::min(cost_of_cleanest_, best && best->clean() ? best->cost : kFar))
          break;
        DesignChange change = common;
        change.shift_of_layer[layer] = shift;
        const Trial trial = tried(change, layer);
        if (!best || better(trial, *best)) best = trial;
      }
      if (!best) return;
      all = all && best->passes();
      joint.shift_of_layer[layer] = best->change.shift_of_layer[layer];
    }
    if (layers_.size() > 1 || all) keep(tried(joint, 0));
    else keep_nearest(joint);
  }

  void keep_nearest(const DesignChange& change) {
    if (trials_.empty() || !trials_.front().passes()) keep(tried(change, 0));
  }

  void try_teeth() {
    cost_of_cleanest_ = kFar;
    int tried_sets = 0;
    for (const DesignChange& move : teeth_moves(train_)) {
      if (designs_ >= 2 * options_.most_designs || judge_.turned() + bisected_ / 2 >= 2 * options_.most_turned) return;
      if (move.cost() >= cost_of_cleanest_) return;
      DesignChange change = move;
      change.layer_gap_mm = layer_gap_mm_;
      change.backlash = lacking_backlash_;
      const auto laid = lay_out(changed_design(train_, change, fits_));
      ++designs_;
      if (!laid || !laid->assembly.equal_spacing) continue;
      if (++tried_sets > 40) return;
      DesignChange joint = change;
      for (const int layer : layers_) {
        std::optional<Trial> best;
        for (const double shift : {0.0, 0.1, -0.1, 0.2, -0.2, 0.4, -0.4}) {
          DesignChange moved = change;
          moved.shift_of_layer[layer] = shift;
          const Trial trial = tried(moved, layer);
          if (!best || better(trial, *best)) best = trial;
          if (best->clean()) break;
        }
        joint.shift_of_layer[layer] = best->change.shift_of_layer[layer];
      }
      keep(tried(joint, 0));
    }
  }

  /// Lays a change out, shortens tips until they clear, and judges it.
  Trial tried(DesignChange change, int layer) {
    Trial trial;
    trial.cost = change.cost();
    ++designs_;
    auto laid = lay_out(changed_design(train_, change, fits_));
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
        shortened = !turned.clean() && round < 3 && shorten_in_the_way(*laid, layer, change);
      }
      if (!shortened) break;
      auto again = lay_out(changed_design(train_, change, fits_));
      if (!again) break;
      laid = std::move(again);
    }
    for (const std::string& place : warned(*laid, layer))
      if (!warned_.contains(place))
        judgement.complaints.push_back({.id = place.substr(0, place.find('@')), .layer = layer, .lacking = 0.01});
    trial.failing = judgement.failing();
    trial.worrying = judgement.worrying();
    trial.cost = change.cost() + tip_cost(change);
    remember(judgement);
    trial.change = std::move(change);
    return trial;
  }

  void set_tip(const GearTrain& laid, std::size_t gear, double radius_mm, DesignChange& change) const {
    const bool ring = laid.gears[gear].profile.gear().kind == GearKind::kInternal;
    const double steps = 2.0 * radius_mm / kWrittenTip_mm;
    change.tip_diameter_mm[gear] = kWrittenTip_mm * (ring ? std::ceil(steps + 1e-6) : std::floor(steps - 1e-6));
  }

  /// Tips whose written diameter reaches into a fillet, or leaves too little contact, end where clear ones would.
  bool shorten_given(const GearTrain& laid, const Judgement& judgement, DesignChange& change) const {
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

  /// Tips that come too near the mate's root circle, or to their neighbour.
  bool shorten_at_roots(const GearTrain& laid, const Judgement& judgement, DesignChange& change) const {
    bool any = false;
    const auto shorten = [&](int gear, double by_mm) {
      if (!(by_mm > 1e-9)) return;
      const auto i = static_cast<std::size_t>(gear);
      const Gear& g = laid.gears[i].profile.gear();
      if (by_mm > 0.6 * g.normal_module_mm) return;
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
    if (!any && complained(judgement, "planet_spacing") && laid.design.planets > 1)
      for (std::size_t i = 0; i < laid.gears.size(); ++i) {
        if (!laid.topology().is_planet_gear(i)) continue;
        const double room = laid.centre_distance_mm * std::sin(kPi / laid.design.planets);
        shorten(static_cast<int>(i), laid.gears[i].profile.tip_radius_mm() - room + 0.02 * laid.design.module_mm);
      }
    return any;
  }

  /// The tip that turning shows in the way, by bisection.
  bool shorten_in_the_way(const GearTrain& laid, int layer, DesignChange& change) {
    bool any = false;
    for (const TrainMesh& mesh : laid.meshes) {
      if (layer != 0 && layer_of(laid, mesh) != layer) continue;
      const ContactJudge::Clearances c = judge_.clearances(laid, mesh);
      if (!(c.driving_mm < -tolerance::kTouch_mm || c.centred_mm < -tolerance::kTouch_mm)) continue;
      const auto margin = [this](const GearPair& pair) {
        ++bisected_;
        const double driving = driving_clearance(pair).clearance_mm;
        return (std::isnan(driving) ? sweep_clearance_mm(pair) : driving) + 0.5 * tolerance::kTouch_mm;
      };
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

  /// What is taken off tips beyond what they have, in modules.
  [[nodiscard]] double tip_cost(const DesignChange& change) const {
    double sum = 0.0;
    for (const auto& [i, diameter] : change.tip_diameter_mm)
      sum += 0.5 * std::abs(diameter - 2.0 * train_.gears[i].profile.gear().tip_radius_mm) / train_.design.module_mm;
    return sum;
  }

  void remember(const Judgement& judgement) {
    std::set<std::string> ids;
    for (const Complaint& c : judgement.complaints)
      if (c.fails) ids.insert(c.id);
    if (!ids.empty()) ++failed_together_[ids];
  }

  /// The best that every check agrees with.
  void choose(JointCure& result) {
    const Findings before = result.findings;
    const int fails_before = count(result.findings, CheckStatus::kFail);
    const int warns_before = count(result.findings, CheckStatus::kWarn);
    int fails = fails_before, warns = warns_before;
    for (Trial& trial : trials_) {
      if (trial.passes()) shrink(trial);
      const GearboxDesign design = changed_design(train_, trial.change, fits_);
      const auto laid = lay_out(design);
      if (!laid || (design == train_.design)) continue;
      Findings findings = check_gearbox(*laid);
      const int f = count(findings, CheckStatus::kFail), w = count(findings, CheckStatus::kWarn);
      if (f > fails || (f == fails && w >= warns) || any_newly_fails(before, findings)) continue;
      fails = f;
      warns = w;
      result.design = design;
      result.findings = std::move(findings);
      result.changed = true;
      if (fails == 0 && trial.clean()) return;
    }
  }

  /// Shifts and centre distance as near to the old ones as the verdict allows.
  void shrink(Trial& trial) {
    const auto smaller = [&](const auto& change_at) {
      for (double share = 0.5; share > 0.1; share *= 0.5) {
        DesignChange change = trial.change;
        change.tip_diameter_mm.clear();
        change_at(change, 1.0 - share);
        const Trial shrunk = tried(change, 0);
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

  [[nodiscard]] std::string conflict_text() const {
    std::vector<std::pair<std::set<std::string>, int>> sets(failed_together_.begin(), failed_together_.end());
    std::stable_sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
      return a.first.size() != b.first.size() ? a.first.size() < b.first.size() : a.second > b.second;
    });
    if (sets.empty()) return "";
    if (sets.front().first.size() == 1) {
      const std::string first = *sets.front().first.begin();
      for (const auto& [ids, times] : sets)
        if (ids.size() == 1 && *ids.begin() != first)
          return first + " and " + *ids.begin() + " contradict each other near this design: what clears one fails the other";
      return "nothing near this design clears " + first;
    }
    auto it = sets.front().first.begin();
    const std::string first = *it++;
    return first + " and " + *it + " fail together in every design near this one";
  }

  const GearTrain& train_;
  JointCureOptions options_;
  std::vector<int> layers_;
  std::set<std::string> warned_;
  bool fits_ = true;
  double layer_gap_mm_ = 0.0;
  double lacking_backlash_ = 0.0;  ///< modules
  ContactJudge judge_;
  int designs_ = 0, bisected_ = 0;
  double cost_of_cleanest_ = kFar;
  std::vector<Trial> trials_;  ///< the best, best first
  std::map<std::set<std::string>, int> failed_together_;
};

}  // namespace

JointCure joint_cure(const GearTrain& train, const JointCureOptions& options) {
  return joint_cure(train, check_gearbox(train), options);
}

JointCure joint_cure(const GearTrain& train, const Findings& findings, const JointCureOptions& options) {
  return Search(train, options).run(findings);
}

}  // namespace trueflank
