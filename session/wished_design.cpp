// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/wished_design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/search/search.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/session/known_wishes.h"
#include "trueflank/session/wished_machine.h"
#include "trueflank/session/wished_sentences.h"
#include "trueflank/session/wished_sets.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

/// How far the ratio may be off.
constexpr double kRatioTolerance = 0.02;
/// Tooth sets are searched in lots, those nearest to the ratio first: one lot takes some seconds.
/// More lots are for a design without a warning, where there is one that warns.
constexpr std::size_t kLot = 48, kMostSets = 240, kLeastSets = 72, kTriedSets = 16, kAllTrials = 48;
/// A part of the first lot that tells whether the wishes can be met at all; and a lot of what is
/// tried besides.
constexpr std::size_t kProbe = 12, kTrialLot = 8;
/// Where nothing is found: so much larger is tried.
constexpr std::array<double, 3> kLarger{1.25, 1.6, 2.2};
/// So many are judged of a lot at most; what as many warn of alike is put up with.
constexpr std::size_t kMostJudged = 32, kMany = 8;
constexpr double kLeastContactRatio = 1.2, kPrintedFriction = 0.15;

/// The module is what so many teeth more than the largest gear's leave of the diameter; tips wider
/// than this part of it leave no choice of shifts.
constexpr double kTipTeeth = 5.0, kWidestTip = 0.6;
/// Some housings want more room than the estimate has: the module becomes so much smaller.
constexpr double kTipReserve = 1.05;

/// Of the rack: teeth a little short, whose tips a printer still makes; the narrow gaps of rings
/// take no rounder tool, and the sun's involute stays whole.
constexpr double kRootRadius = 0.2, kAddendum = 0.9, kDedendum = 1.15;

constexpr const char* kShaftGrip = "shaft_grip";
/// What is on the motor's shaft has an overhang: the foot of a set screw stands out over its hub.
/// It has a name of its own here; where it is tolerated, its check is.
struct OverhangOfFoot {
  static constexpr const char* kName = "overhang of the foot";
  static constexpr const char* kCheck = "overhang";
};

/// What a warning is called when designs are compared.
std::string name_of_warning(const Finding& warning, const std::string& on_shaft) {
  const bool of_foot = warning.id == OverhangOfFoot::kCheck && warning.where == on_shaft;
  return of_foot ? OverhangOfFoot::kName : warning.id;
}

/// The check that gives a warning of this name.
std::string check_of_warning(const std::string& name) {
  return name == OverhangOfFoot::kName ? OverhangOfFoot::kCheck : name;
}
/// A flat that is filed on a round shaft: what it leaves of the diameter, how long it is at most,
/// and the shaft left round over the motor's face, where no file gets to.
constexpr double kFiled = 0.9, kLongestFlat_mm = 15.0, kNotFiled_mm = 3.0;

Motor with_filed_flat(Motor motor) {
  motor.flat_mm = 0.1 * std::round(10.0 * kFiled * motor.shaft_diameter_mm);
  motor.flat_length_mm =
      std::min(kLongestFlat_mm, std::floor(motor.shaft_length_mm - kNotFiled_mm));
  return motor;
}

/// Warnings that a design may have.
enum class Allowed { kNone, kUndercut, kEveryWarning };

class Wish {
 public:
  explicit Wish(const DesignWishes& wishes, std::size_t most_sets = kMostSets)
      : wishes_(wishes), most_sets_(most_sets) {}

  Errors check() {
    Errors errors = known_.read(wishes_);
    motor_ = known_.motor;
    return errors;
  }

  /// What gives a design instead, of each sort the first that does: each was tried.
  [[nodiscard]] std::string what_would() const {
    std::string found;
    std::size_t left = kAllTrials;
    for (const std::vector<Trial>& sort : trials())
      for (const Trial& trial : sort) {
        if (left == 0) break;
        Wish wish(trial.wishes, std::min(left, kTriedSets));
        const bool gives = wish.check().empty() && wish.find("trial").has_value();
        left -= std::min(left, wish.tried_sets_);
        if (!gives) continue;
        found += (found.empty() ? "" : ", or ") + trial.option;
        break;
      }
    if (!found.empty()) return found + ": each was tried and gives a design";
    return "another ratio: no larger diameter, other motor or kind that was tried gives a design";
  }

  ResultAll<WishedDesign> find(const std::string& name) {
    const SearchRequirements asked = requirements();
    if (Errors errors = validate(asked); !errors.empty()) return fail_all(std::move(errors));
    const SearchReport report = searched(asked);
    if (report.designs.empty())
      return fail_all({{.code = ErrorCode::kInfeasible,
                        .message = refusal(report),
                        .key = "--ratio",
                        .value = fixed_text(wishes_.ratio, 3),
                        .remedy = {}}});
    const FoundDesign& found = report.designs.front();
    GearboxDesign design = whole(found.design);
    design.name = design_name_from(name);
    design.tools_file = wishes_.tools_named;
    WishedDesign result{.text = {}, .told = wished_sentences({.wishes = wishes_,
                                                  .known = known_,
                                                  .found = found,
                                                  .report = report,
                                                  .design = design,
                                                  .motor = motor_,
                                                  .filed = filed_ && motor_ == &*filed_})};
    std::string comment;
    for (const std::string& sentence : result.told) comment += sentence + "\n";
    result.text = design_file_text(design, comment);
    return result;
  }

 private:
  /// One change of the wishes each: what a person would try next.
  struct Trial {
    std::string option;
    DesignWishes wishes;
  };
  [[nodiscard]] std::vector<std::vector<Trial>> trials() const {
    std::vector<Trial> larger, motors, kinds;
    for (const double factor : kLarger) {
      Trial trial{"", wishes_};
      trial.wishes.outer_diameter_mm = 5.0 * std::ceil(0.2 * factor * wishes_.outer_diameter_mm);
      if (trial.wishes.outer_diameter_mm > kLargestWish_mm) break;
      trial.option = "--outer-diameter " + printed_number(trial.wishes.outer_diameter_mm, "%g");
      larger.push_back(std::move(trial));
    }
    for (const char* motor : {"nema17", "nema14"}) {
      if (!motor_ || wishes_.motor == motor) continue;
      motors.push_back({std::string("--motor ") + motor, wishes_});
      motors.back().wishes.motor = motor;
    }
    for (const WishedSets& sets : all_wished_sets()) {
      const bool tried = std::any_of(kinds.begin(), kinds.end(), [&](const Trial& trial) {
        return trial.wishes.kind == sets.kind;
      });
      if (tried || sets.kind == wishes_.kind || wishes_.ratio < sets.ratio_min ||
          wishes_.ratio > sets.ratio_max)
        continue;
      kinds.push_back({"--kind " + sets.kind, wishes_});
      kinds.back().wishes.kind = sets.kind;
      kinds.back().wishes.input.clear();
      kinds.back().wishes.output.clear();
    }
    return {std::move(larger), std::move(motors), std::move(kinds)};
  }

  /// The best pairs of stages, without a warning where there are such.
  SearchReport searched_stages(SearchRequirements asked, const SetEnumeration& found) {
    asked.listed = static_cast<int>(kLot);
    const auto judge = [this](const GearTrain& train) { return judged(train); };
    const SearchRecords records = run_search(asked, found);
    SearchReport report;
    do {
      begin_judging();
      report = conclude_search(asked, found, records, judge);
    } while (report.designs.empty() && tolerate_what_all_warn());
    for (const Allowed allowed : {Allowed::kUndercut, Allowed::kEveryWarning}) {
      if (!report.designs.empty()) break;
      allowed_ = allowed;
      begin_judging();
      report = conclude_search(asked, found, records, judge);
    }
    return report;
  }

  /// Lot by lot, until one holds a design without a warning; where none does, one that warns least.
  SearchReport searched(const SearchRequirements& asked) {
    const SetEnumeration found = enumerate_sets(asked);
    if (!found.stages.empty()) return searched_stages(asked, found);
    std::vector<ToothSet> all(found.sets.begin(), found.sets.end());
    all_sets_ = all.size();
    const auto off = [this](const ToothSet& set) {
      return std::abs(std::abs(signed_ratio(set)) - wishes_.ratio);
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const ToothSet& a, const ToothSet& b) { return off(a) < off(b); });
    const auto judge = [this](const GearTrain& train) { return judged(train); };
    std::vector<ToothSet> tried;
    SearchRecords records;
    SearchReport report;
    const std::size_t most = std::min(all.size(), most_sets_);
    for (std::size_t from = 0, to = 0; from < most && (from < kLeastSets || warned_alone_);
         from = to) {
      // what is searched by way of trial needs no best
      to = std::min(most, from + (most_sets_ < kMostSets ? kTrialLot : kLot));
      if (from > 0 && !warned_alone_) to = std::min(to, kLeastSets);
      const auto at = [&](std::size_t index) {
        return all.begin() + static_cast<std::ptrdiff_t>(index);
      };
      SetEnumeration lot;
      SearchRunOptions run;
      const auto look = [&] {
        const SearchRecords own = run_search(asked, lot, run);
        begin_judging();
        report = conclude_search(asked, lot, own, judge);
        return own;
      };
      tried_sets_ = to;
      if (from == 0 && to > kProbe) {
        lot.sets = std::vector<ToothSet>(at(0), at(kProbe));
        run.done = look().optimised;
        if (report.designs.empty() && fall_alike()) return report;
      }
      lot.sets = std::vector<ToothSet>(at(from), at(to));
      SearchRecords own = look();
      while (report.designs.empty() && tolerate_what_all_warn()) {
        begin_judging();
        report = conclude_search(asked, lot, own, judge);
      }
      if (!report.designs.empty() || fall_alike()) return report;
      if (judged_ >= kMostJudged && !warned_alone_) return report;
      for (SearchRecord& record : own.optimised) {
        record.index += from;
        records.optimised.push_back(std::move(record));
      }
      tried.insert(tried.end(), at(from), at(to));
    }
    SetEnumeration all_tried;
    all_tried.sets = std::move(tried);
    // those whose sun is undercut, then those that only warn
    for (const Allowed allowed : {Allowed::kUndercut, Allowed::kEveryWarning}) {
      allowed_ = allowed;
      begin_judging();
      report = conclude_search(asked, all_tried, records, judge);
      if (!report.designs.empty()) break;
    }
    return report;
  }

  [[nodiscard]] double wall_mm() const { return std::max(1.2, 1.5 * known_.process->least_wall_mm); }

  [[nodiscard]] SearchRequirements requirements() const {
    // around the larger ring's roots: seat, screws and three walls of the housing
    const Screw screw = *find_element(standard_elements().screws, "M3");
    const double around = motor_ ? HousingDesign{}.clearance_mm + 3.0 * wall_mm() +
                                       0.5 * (screw.insert_hole_mm + screw.hole_mm) + 0.15
                                 : 0.0;
    SearchRequirements r;
    r.kinds = {known_.sets->kind};
    r.inputs = {known_.sets->input};
    r.outputs = {known_.sets->output};
    r.objectives = {known_.sets->objective};
    r.friction = kPrintedFriction;
    r.face_width_mm = known_.sets->face_width_mm;
    r.backlash_mm = known_.process->backlash_mm;
    r.rack.root_radius = kRootRadius;
    r.rack.addendum = kAddendum;
    r.rack.dedendum = kDedendum;
    if (motor_) r.rim = 0.0;
    r.outer_diameter_mm = wishes_.outer_diameter_mm - 2.0 * around;
    r.ratio_min = wishes_.ratio * (1.0 - kRatioTolerance);
    r.ratio_max = wishes_.ratio * (1.0 + kRatioTolerance);
    // no more teeth than leave the tips that the process makes
    const double most = known_.process->least_tip_mm > 0.0
                            ? kWidestTip * *r.outer_diameter_mm / known_.process->least_tip_mm - kTipTeeth
                            : 1e9;
    const auto fewer = [&](ToothRange range) {
      range.max = std::min(range.max, std::max(range.min, static_cast<int>(std::min(most, 1e6))));
      return range;
    };
    r.sun = known_.sets->sun;
    r.planet1 = fewer(known_.sets->planet1);
    if (known_.sets->planet2.max > 0) r.planet2 = fewer(known_.sets->planet2);
    if (known_.sets->ring.max > 0) r.ring1 = r.ring2 = fewer(known_.sets->ring);
    r.shift_min = -0.5;
    r.shift_max = 1.5;
    r.contact_ratio_min = kLeastContactRatio;
    const int most_teeth =
        std::max({r.sun.max, r.planet1.max, fewer(known_.sets->planet2).max, fewer(known_.sets->ring).max});
    r.tip_thickness = std::max(0.2, kTipReserve * known_.process->least_tip_mm *
                                        (most_teeth + kTipTeeth) / *r.outer_diameter_mm);
    r.strength.material = known_.material;
    r.results = 1;
    r.listed = 0;  // the first that passes may rank anywhere
    return r;
  }

  /// The gears with what is asked for around them.
  [[nodiscard]] GearboxDesign whole(GearboxDesign design) const {
    design.material = known_.material;
    design.made.process = *known_.process;
    design.made.bed = wishes_.bed;
    if (!motor_) return design;
    return with_machine(std::move(design), *motor_, wishes_.outer_diameter_mm, wall_mm());
  }

  /// Of gears and everything around them; a warning counts as a failure.
  DesignVerdict judged(const GearTrain& gears) {
    // what fell so often falls for a reason that other teeth do not mend
    if (++judged_ > kMostJudged) return {.failed = {last_failed_}, .warned = {}};
    std::vector<std::string> warns, fails;
    DesignVerdict verdict = judged(gears, warns, fails);
    if (!verdict.failed.empty()) last_failed_ = verdict.failed.front();
    grip_alone_ |= fails.empty() && !warns.empty() &&
                   std::all_of(warns.begin(), warns.end(), [](const auto& id) {
                     return id == kShaftGrip || id == OverhangOfFoot::kName;
                   });
    warned_alone_ |= !verdict.failed.empty() && fails.empty();
    keep_common(warns, common_);
    keep_common(fails, common_failures_);
    return verdict;
  }

  void begin_judging() {
    judged_ = 0;
    common_.clear();
    common_failures_.clear();
  }

  /// Of what all said that were judged before, what this one says too.
  void keep_common(const std::vector<std::string>& said, std::vector<std::string>& common) const {
    if (judged_ == 1) common = said;
    std::erase_if(common, [&](const std::string& one) {
      return std::find(said.begin(), said.end(), one) == said.end();
    });
  }

  /// Many fail in the same place, which comes of the wishes: other teeth will fail too.
  [[nodiscard]] bool fall_alike() const { return judged_ >= kMany && !common_failures_.empty(); }

  /// What every design of many warns of comes of the wishes, not of the teeth. Where a round shaft
  /// is all that one lacks, a flat is filed on it.
  bool tolerate_what_all_warn() {
    if (grip_alone_ && !filed_ && !(motor_->flat_mm > 0.0)) {
      filed_ = with_filed_flat(*motor_);
      motor_ = &*filed_;
      return true;
    }
    if (judged_ < kMany || common_.empty()) return false;
    // it did not help
    if (filed_ && std::count(common_.begin(), common_.end(), kShaftGrip) > 0)
      motor_ = find_element(known_.tools.elements.motors, wishes_.motor);
    for (const std::string& name : common_) tolerated_.push_back(check_of_warning(name));
    return true;
  }

  [[nodiscard]] bool is_allowed(const Finding& finding) const {
    return allowed_ == Allowed::kEveryWarning ||
           (allowed_ == Allowed::kUndercut && finding.id == "undercut") ||
           std::find(tolerated_.begin(), tolerated_.end(), finding.id) != tolerated_.end();
  }

  /// `warns` gets the names of the warnings that are not allowed, `fails` what fails and where.
  [[nodiscard]] DesignVerdict judged(const GearTrain& gears, std::vector<std::string>& warns,
                                     std::vector<std::string>& fails) {
    DesignVerdict verdict;
    const std::string on_shaft = gears.topology().name_of(gears.design.topology.input);
    const auto take = [&](const Findings& findings) {
      for (const Finding& finding : findings) {
        const bool warning = finding.status == CheckStatus::kWarn;
        if (warning && is_allowed(finding)) {
          verdict.warned.push_back(finding.id + " " + finding.where);
        } else if (warning || finding.status == CheckStatus::kFail) {
          verdict.failed.push_back(finding.id);
          examples_.insert({finding.id, finding.message});
          if (warning)
            warns.push_back(name_of_warning(finding, on_shaft));
          else
            fails.push_back(finding.id + " " + finding.where);
        }
      }
    };
    const auto train = lay_out(whole(gears.design));
    if (!train) {
      fails.push_back("assembly");
      return {.failed = fails, .warned = {}};
    }
    if (train->design.machine) {
      const auto shapes = part_shapes(*train);
      if (!shapes) {
        examples_.insert({"wall", shapes.error().front().message});
        fails.push_back(shapes.error().front().key);
        return {.failed = {"wall"}, .warned = {}};
      }
      take(check_machine(*train, *shapes));
      if (const auto layout = machine_layout(*train);
          2.0 * layout->least_outer_radius_mm > wishes_.outer_diameter_mm)
        verdict.failed.push_back("housing_size"), fails.push_back("housing_size");
    }
    if (verdict.failed.empty()) take(check_gearbox(*train));
    return verdict;
  }

  [[nodiscard]] std::string refusal(const SearchReport& report) const {
    if (all_sets_ == 0)
      return "none of the sets that are searched has this ratio" +
             (known_.process->least_tip_mm > 0.0
                  ? "; the tips that " + known_.process->name + " makes leave few teeth in this diameter"
                  : std::string());
    return "no set of this ratio and size passes every check: of " + std::to_string(all_sets_) +
           " sets " + std::to_string(report.sets) + " were tried, " +
           std::to_string(report.feasible) + " have shifts that keep the limits" +
           most_fell(report);
  }

  /// What most of those fell in that were judged.
  [[nodiscard]] std::string most_fell(const SearchReport& report) const {
    const auto& classes = report.fell_in_checks;
    const auto most =
        std::max_element(classes.begin(), classes.end(),
                         [](const SetClass& a, const SetClass& b) { return a.count < b.count; });
    if (most == classes.end()) return "";
    const auto example = examples_.find(most->id);
    return "; most of them fall in " + most->id +
           (example == examples_.end() ? "" : " (one: " + example->second + ")");
  }

  const DesignWishes& wishes_;
  std::size_t most_sets_;
  Allowed allowed_ = Allowed::kNone;
  std::vector<std::string> tolerated_;        ///< ids of warnings
  std::size_t judged_ = 0;                    ///< since judging began
  std::vector<std::string> common_;           ///< what all of those warn of
  std::vector<std::string> common_failures_;  ///< and fail in, with the place
  std::string last_failed_;
  std::map<std::string, std::string> examples_;  ///< what the first said that fell, by check
  KnownWishes known_;
  const Motor* motor_ = nullptr;  ///< the one asked for, or that with a flat
  std::optional<Motor> filed_;    ///< with a flat on its shaft, that it does not come with
  bool warned_alone_ = false;   ///< one of those judged passes with warnings
  bool grip_alone_ = false;     ///< one of those judged passes but for the round shaft
  std::size_t all_sets_ = 0;    ///< of the ratio
  std::size_t tried_sets_ = 0;  ///< of them
};

}  // namespace

ResultAll<WishedDesign> wished_design(const std::string& name, const DesignWishes& wishes) {
  Wish wish(wishes);
  if (Errors errors = wish.check(); !errors.empty()) return fail_all(std::move(errors));
  auto found = wish.find(name);
  if (found) return found;
  Errors errors = found.error();
  if (errors.size() == 1 && errors.front().code == ErrorCode::kInfeasible)
    errors.front().remedy = wish.what_would();
  return fail_all(std::move(errors));
}

}  // namespace trueflank
