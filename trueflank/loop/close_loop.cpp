// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/close_loop.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/finite_displacement.h"
#include "trueflank/loop/found_effects.h"
#include "trueflank/loop/point_fit.h"
#include "trueflank/loop/shape_refinement.h"

namespace trueflank::loop {
namespace {

class Loop {
 public:
  Loop(const FlankGeometry& geometry, Observations table, const std::string& gear)
      : geometry_(geometry), measured_(std::move(table)), table_(measured_) {
    result_.gear = gear;
  }

  GearLoop close() {
    patches_ = make_patches(geometry_, table_);
    candidates_ = candidate_effects(geometry_);
    banned_.assign(candidates_.size(), false);
    ban_waves_that_cannot_be_seen();
    for (int round = 0; round < 5; ++round) {
      select();
      // Off the grid: the choice is made again with the shapes that fit, lest what a coarse shape
      // leaves is taken for another effect.
      bool again = put_refined_shapes_on_the_grid();
      again = ban_misnamed() || again;
      again = linearise() || again;
      if (!again) break;
    }
    look_at_single_teeth();
    list_observable();
    report();
    GearLoop done{std::move(result_), geometry_, {}, {}, {}};
    std::vector<float> unused;
    PointFit(geometry_, measured_, patches_, {}).residuals(done.before_um, unused);
    PointFit(geometry_, table_, patches_, effects_).residuals(unused, done.after_um);
    finish_errors(done);
    done.table = std::move(table_);
    return done;
  }

 private:
  /// A wave over the generating rotation shows along the profile only; in values one a tooth every
  /// order looks like a lower one.
  void ban_waves_that_cannot_be_seen() {
    const bool along_profile =
        std::any_of(table_.rows.begin(), table_.rows.end(), [](const Observation& row) {
          return row.kind == ObservationKind::kScanFlank || row.kind == ObservationKind::kProfile;
        });
    for (std::size_t g = 0; !along_profile && g < candidates_.size(); ++g)
      if (candidates_[g].family->id == "ghost_order") banned_[g] = true;
  }

  void select() {
    const DiscoveryProblem problem = make_problem(geometry_, table_, patches_, candidates_);
    DiscoveryOptions options;
    options.banned = banned_;
    discovery_ = discover(problem, options);
    // What is smaller than the rounding of 32-bit mesh files is no finding, however regular it is.
    constexpr double kFileRounding_um = 0.01;
    if (PointFit(geometry_, measured_, patches_, {}).errors({}).rms_um < kFileRounding_um) {
      discovery_.chosen.clear();
      discovery_.first_p_value = discovery_.p_left = 1.0;
    }
    effects_.clear();
    for (const ChosenGroup& chosen : discovery_.chosen) effects_.push_back(candidates_[chosen.group]);
  }

  /// True where a shape moved noticeably.
  bool put_refined_shapes_on_the_grid() {
    const std::vector<Effect> chosen = effects_;
    refine_shapes(geometry_, table_, patches_, effects_);
    for (const Effect& effect : effects_)
      if (effect.family->id == "layer_shift") patches_.leave_out_across(effect.shape[0]);
    bool moved = false;
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      for (std::size_t k = 0; k < effects_[i].shape.size(); ++k)
        moved = moved || std::abs(effects_[i].shape[k] - chosen[i].shape[k]) >
                             3e-3 * std::abs(chosen[i].shape[k]);
      candidates_[discovery_.chosen[i].group].shape = effects_[i].shape;
    }
    return moved;
  }

  /// True where finite displacements changed the deviations by more than the noise can hide.
  bool linearise() {
    const bool body = std::any_of(effects_.begin(), effects_.end(), [](const Effect& effect) {
      return static_cast<bool>(effect.family->displacement_mm);
    });
    if (!body || measured_.points_mm.empty()) return false;
    const PointFit fit(geometry_, table_, patches_, effects_);
    const double change = linearise_at(geometry_, fit, measured_, table_);
    if (!(change > 0.02 * fit.noise_um())) return false;
    patches_ = make_patches(geometry_, table_);
    for (const Effect& effect : effects_)
      if (effect.family->id == "layer_shift") patches_.leave_out_across(effect.shape[0]);
    return true;
  }

  void list_observable() {
    std::vector<std::string> seen;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (g < discovery_.observable.size() && discovery_.observable[g])
        seen.push_back(candidates_[g].family->id);
    for (const EffectFamily& family : effect_library())
      if (family.named && !family.local && std::find(seen.begin(), seen.end(), family.id) == seen.end())
        result_.not_observable.push_back(family.id);
  }

  /// Bans named effects that cannot be meant: an amount of the wrong sign; a wave whose kin of the same
  /// order remain unexplained, which is not that wave and is better described. True where any was.
  [[nodiscard]] bool ban_misnamed() {
    bool any = ban_wrong_signs();
    const auto ban = [&](int group) {
      any = any || !banned_[group];
      banned_[group] = true;
    };
    for (const ChosenGroup& named : discovery_.chosen) {
      const Effect& effect = candidates_[named.group];
      const std::string& id = effect.family->id;
      if (id != "pitch_wave" && id != "lobing" && id != "ghost_order") continue;
      if (effect.shape[0] < 2.0) continue;
      for (const ChosenGroup& other : discovery_.chosen) {
        const Effect& term = candidates_[other.group];
        if (term.family->id != "unnamed" || other.gain < 0.05 * named.gain) continue;
        const bool kin = id == "ghost_order" ? term.shape[2] != 0.0 : term.shape[2] == effect.shape[0];
        if (!kin) continue;
        for (std::size_t g = 0; g < candidates_.size(); ++g)
          if (candidates_[g].family->named && candidates_[g].shape == effect.shape &&
              candidates_[g].family->shape_names == effect.family->shape_names)
            ban(static_cast<int>(g));
      }
    }
    return any;
  }

  [[nodiscard]] bool ban_wrong_signs() {
    if (effects_.empty()) return false;
    const PointFit fit(geometry_, table_, patches_, effects_);
    bool any = false;
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      const Effect& effect = effects_[e];
      if (!effect.family->only_positive) continue;
      if (fit.coefficients()[fit.first_column(static_cast<int>(e))] > 0.0) continue;
      for (std::size_t g = 0; g < candidates_.size(); ++g)
        if (candidates_[g].family == effect.family && candidates_[g].flank == effect.flank)
          banned_[g] = any = true;
    }
    return any;
  }

  /// Single teeth once more with the hold-out: what stands in one tooth cannot be learnt from others.
  void look_at_single_teeth() {
    std::vector<Effect> local;
    for (const Effect& effect : candidates_) {
      if (!effect.family->local) continue;
      const bool chosen = std::any_of(effects_.begin(), effects_.end(), [&](const Effect& e) {
        return e.family == effect.family && e.shape == effect.shape && e.flank == effect.flank;
      });
      if (!chosen) local.push_back(effect);
    }
    DiscoveryProblem problem = make_problem(geometry_, table_, patches_, local);
    const auto before = problem.nuisance.cols();
    const DiscoveryProblem fitted = make_problem(geometry_, table_, patches_, effects_);
    problem.nuisance.conservativeResize(Eigen::NoChange, before + fitted.candidates.cols());
    problem.nuisance.rightCols(fitted.candidates.cols()) = fitted.candidates.cast<double>();
    for (int& fold : problem.fold)
      if (fold == 0) fold = 1;
    DiscoveryOptions options;
    options.first_level = options.next_level = 0.0;
    options.flips = 1;
    options.most_effects = 3;
    for (const ChosenGroup& chosen : discover(problem, options).chosen) {
      effects_.push_back(local[chosen.group]);
      ChosenGroup record = chosen;
      record.group = -1;
      discovery_.chosen.push_back(record);
    }
  }

  void report() {
    const PointFit fit(geometry_, table_, patches_, effects_);
    result_.observations = fit.observations();
    result_.held_out = fit.held_out();
    result_.outliers = table_.outliers;
    result_.noise = fit.noise_um();
    result_.notes = table_.notes;
    const PointFit as_designed(geometry_, measured_, patches_, {});
    const auto none = as_designed.errors({});
    const auto all = fit.errors(std::vector<bool>(effects_.size(), true));
    result_.before = {none.rms_um, none.held_out_rms_um, 0.0};
    result_.after = {all.rms_um, all.held_out_rms_um, 0.0};
    result_.structure_p_value = discovery_.first_p_value;
    result_.structure_left_p_value = discovery_.p_left;
    const ShapeUncertainty uncertainty = shape_uncertainty(geometry_, table_, patches_, fit);
    result_.effects = describe_effects(
        {geometry_, fit, discovery_, candidates_, uncertainty, result_.not_observable});
    result_.measure_next = measurements_that_separate(result_.effects, result_.not_observable);
    judge();
  }

  void judge() {
    constexpr double kLeft = 0.02;
    const bool left = discovery_.p_left <= kLeft && discovery_.likest_left >= 0;
    if (effects_.empty())
      result_.verdict = discovery_.first_p_value <= 0.01 ? Verdict::kPartlyExplained
                                                        : Verdict::kNoEffect;
    else
      result_.verdict = left ? Verdict::kPartlyExplained : Verdict::kExplained;
    if (result_.verdict == Verdict::kPartlyExplained && discovery_.likest_left >= 0)
      result_.structure_left =
          "what is left looks most like " + words_for(candidates_[discovery_.likest_left]);
    else
      result_.structure_left = "nothing beyond the measurement's own noise was found";
  }

  void finish_errors(GearLoop& done) const {
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      if (!counts_as_error(table_.rows[i].kind)) continue;
      done.result.before.max = std::max(done.result.before.max,
                                        static_cast<double>(std::abs(done.before_um[i])));
      done.result.after.max = std::max(done.result.after.max,
                                       static_cast<double>(std::abs(done.after_um[i])));
    }
  }

  const FlankGeometry& geometry_;
  const Observations measured_;  ///< deviations of the gear as designed
  Observations table_;           ///< about the effects found: exact for finite displacements
  Patches patches_;
  std::vector<Effect> candidates_;
  std::vector<bool> banned_;
  DiscoveryResult discovery_;
  std::vector<Effect> effects_;
  LoopResult result_;
};

}  // namespace

ResultAll<GearLoop> close_loop(const FlankGeometry& geometry, const std::string& gear_name,
                               const MeasuredData& data, const LoopOptions& options) {
  auto table = make_observations(geometry, data, {.aligned = options.aligned});
  if (!table) return fail_all(std::move(table.error()));
  if (table->rows.size() < 3)
    return fail_all({{.code = ErrorCode::kOutOfRange,
                      .message = "the data hold " + std::to_string(table->rows.size()) +
                                 " usable values; the loop needs more than that"}});
  return Loop(geometry, std::move(*table), gear_name).close();
}

ResultAll<GearLoop> close_loop(const GearTrain& train, const std::string& gear_name,
                               const std::vector<std::string>& files, const LoopOptions& options) {
  const TrainGear* gear = train.find(gear_name);
  if (gear == nullptr) {
    std::string names;
    for (const TrainGear& known : train.gears) names += (names.empty() ? "" : ", ") + known.name;
    return fail_all({{.code = ErrorCode::kUsage,
                      .message = "the design has no gear \"" + gear_name + "\"",
                      .key = "--gear",
                      .value = gear_name,
                      .remedy = "one of " + names}});
  }
  auto data = read_measured_files(files);
  if (!data) return fail_all(std::move(data.error()));
  double bore_radius = 0.0;
  if (const GearDesign* design = find_gear(train.design, gear_name))
    if (design->bore.kind == BoreKind::kRound) bore_radius = 0.5 * design->bore.diameter_mm;
  const FlankGeometry geometry(gear->profile, gear->face_width_mm, bore_radius,
                               train.design.herringbone);
  return close_loop(geometry, gear_name, *data, options);
}

}  // namespace trueflank::loop
