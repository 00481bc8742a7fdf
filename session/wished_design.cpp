// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/wished_design.h"

#include <algorithm>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/machine/check_machine.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/search/search.h"
#include "trueflank/session/fixed_text.h"

namespace trueflank {
namespace {

/// How far the ratio may be off.
constexpr double kRatioTolerance = 0.02;
/// What is searched: small suns, rings of which the teeth can still be printed.
constexpr ToothRange kSun{12, 18}, kPlanet{20, 46}, kRing{60, 96};
constexpr double kLeastContactRatio = 1.2, kPrintedFriction = 0.15, kFace_mm = 10.0;
/// Of the rack: teeth a little short, whose tips a printer still makes; the narrow gaps of rings take no
/// rounder tool, and the sun's involute stays whole.
constexpr double kRootRadius = 0.2, kAddendum = 0.9, kDedendum = 1.15;

Error unknown(const char* key, const std::string& value, std::string known) {
  return {.code = ErrorCode::kUsage,
          .message = "not known",
          .key = key,
          .value = value,
          .remedy = std::move(known)};
}

template <class Element>
std::string names_of_all(const std::vector<Element>& elements) {
  std::string names;
  for (const Element& element : elements) names += (names.empty() ? "" : ", ") + element.name;
  return names;
}

/// Warnings that a design may have.
enum class Allowed { kNone, kUndercut, kEveryWarning };

/// The material of a name, or the only one whose name goes on after it: "pla" for "pla-printed". Empty:
/// none, or several.
std::string material_named(const std::string& text) {
  const MaterialTable table;
  if (table.find(text)) return text;
  std::string found;
  for (const Material& material : table.all()) {
    if (!material.name.starts_with(text + "-")) continue;
    if (!found.empty()) return "";
    found = material.name;
  }
  return found;
}

class Wish {
 public:
  Wish(const DesignWishes& wishes) : wishes_(wishes) {}

  Errors check() {
    Errors errors;
    if (wishes_.kind != "3k")
      errors.push_back({.code = ErrorCode::kUsage,
                        .message = "only 3k sets are searched for a ratio",
                        .key = "--kind",
                        .value = wishes_.kind,
                        .remedy = "3k, or no --ratio"});
    if (!(wishes_.ratio >= 10.0 && wishes_.ratio <= 1000.0))
      errors.push_back({.code = ErrorCode::kUsage,
                        .message = "no ratio of a 3k set",
                        .key = "--ratio",
                        .value = fixed_text(wishes_.ratio, 3),
                        .remedy = "10 to 1000"});
    if (!(wishes_.outer_diameter_mm >= 40.0 && wishes_.outer_diameter_mm <= 500.0))
      errors.push_back({.code = ErrorCode::kUsage,
                        .message = "no diameter of a gearbox",
                        .key = "--outer-diameter",
                        .value = fixed_text(wishes_.outer_diameter_mm, 3),
                        .remedy = "40 to 500"});
    const ToolTables& tools = standard_tools();
    process_ = tools.processes.find(wishes_.process);
    if (!process_)
      errors.push_back(unknown("--process", wishes_.process, names_of_all(tools.processes.all())));
    material_ = material_named(wishes_.material);
    if (material_.empty())
      errors.push_back(
          unknown("--material", wishes_.material, names_of_all(MaterialTable().all())));
    motor_ = find_element(tools.elements.motors, wishes_.motor);
    if (!motor_ && !wishes_.motor.empty())
      errors.push_back(unknown("--motor", wishes_.motor, names_of_all(tools.elements.motors)));
    return errors;
  }

  ResultAll<WishedDesign> find(const std::string& name) {
    const SearchRequirements asked = requirements();
    if (Errors errors = validate(asked); !errors.empty()) return fail_all(std::move(errors));
    const SetEnumeration sets = enumerate_sets(asked);
    const std::vector<SearchRecord> records = run_search(asked, sets);
    const auto judge = [this](const GearTrain& train) { return judged(train); };
    SearchReport report = conclude_search(asked, sets, records, judge);
    // none without a warning: then those whose sun is undercut, then those that only warn
    for (const Allowed allowed : {Allowed::kUndercut, Allowed::kEveryWarning}) {
      if (!report.designs.empty()) break;
      allowed_ = allowed;
      report = conclude_search(asked, sets, records, judge);
    }
    if (report.designs.empty())
      return fail_all({{.code = ErrorCode::kInfeasible,
                        .message = "no set of this ratio and size passes every check: of " +
                                   std::to_string(sets.sets.size()) + " sets " +
                                   std::to_string(report.feasible) +
                                   " have shifts that keep the limits" + most_fell(report),
                        .key = "--ratio",
                        .value = fixed_text(wishes_.ratio, 3),
                        .remedy = "another ratio, or a larger --outer-diameter"}});
    const FoundDesign& found = report.designs.front();
    GearboxDesign design = whole(found.design);
    design.name = design_name_from(name);
    WishedDesign result{.text = {}, .told = sentences(found, report, design)};
    std::string comment;
    for (const std::string& sentence : result.told) comment += sentence + "\n";
    result.text = design_file_text(design, comment);
    return result;
  }

 private:
  [[nodiscard]] double wall_mm() const { return std::max(1.2, 1.5 * process_->least_wall_mm); }

  [[nodiscard]] SearchRequirements requirements() const {
    // around the larger ring's roots: seat, screws and three walls of the housing
    const Screw screw = screw_of("M3");
    const double around = motor_ ? HousingDesign{}.clearance_mm + 3.0 * wall_mm() +
                                       0.5 * (screw.insert_hole_mm + screw.hole_mm) + 0.15
                                 : 0.0;
    SearchRequirements r;
    r.friction = kPrintedFriction;
    r.face_width_mm = kFace_mm;
    r.backlash_mm = process_->backlash_mm;
    r.rack.root_radius = kRootRadius;
    r.rack.addendum = kAddendum;
    r.rack.dedendum = kDedendum;
    if (motor_) r.rim = 0.0;
    r.outer_diameter_mm = wishes_.outer_diameter_mm - 2.0 * around;
    r.ratio_min = wishes_.ratio * (1.0 - kRatioTolerance);
    r.ratio_max = wishes_.ratio * (1.0 + kRatioTolerance);
    r.sun = kSun;
    r.planet1 = r.planet2 = kPlanet;
    r.ring1 = r.ring2 = kRing;
    r.shift_min = -0.5;
    r.shift_max = 1.5;
    r.contact_ratio_min = kLeastContactRatio;
    r.tip_thickness = std::max(0.2, process_->least_tip_mm * (kRing.max + 5) / *r.outer_diameter_mm);
    r.strength.material = material_;
    r.results = 1;
    return r;
  }

  [[nodiscard]] static Screw screw_of(const std::string& name) {
    return *find_element(standard_elements().screws, name);
  }

  /// The gears with what is asked for around them.
  [[nodiscard]] GearboxDesign whole(GearboxDesign design) const {
    design.material = material_;
    design.made.process = *process_;
    if (!motor_) return design;
    design.machine = MachineDesign{.motor = *motor_};
    MachineDesign& machine = *design.machine;
    machine.fasteners = {.housing = screw_of("M3"),
                         .carrier = screw_of("M3-short"),
                         .output = screw_of("M3"),
                         .motor = screw_of(motor_->screw)};
    for (GearDesign& gear : design.gears) gear.outer_diameter_mm.reset();  // the housing's
    machine.bearings = {.output = *find_element(standard_elements().bearings, "6804")};
    for (GearDesign& gear : design.gears)
      if (gear.name == "sun") gear.bore = shaft_bore(machine);
    choose_bearings(design);
    return design;
  }

  /// The largest bearings that the planets' roots and the lid have room for.
  void choose_bearings(GearboxDesign& design) const {
    MachineDesign& machine = *design.machine;
    const auto train = lay_out(design);
    if (!train) return;
    double root = 1e300;
    for (std::size_t i = 0; i < train->gears.size(); ++i)
      if (train->topology().is_planet_gear(i))
        root = std::min(root, train->gears[i].profile.root_radius_mm());
    for (const char* name : {"608", "626", "625", "624", "623"}) {
      const Bearing& bearing = *find_element(standard_elements().bearings, name);
      if (0.5 * (bearing.outer_mm + machine.housing.fit_mm) + wall_mm() > root) continue;
      machine.bearings.planet = bearing;
      break;
    }
    if (!machine.bearings.planet) return;
    design.gears[static_cast<std::size_t>(planet_with_bore(design) - design.gears.data())]
        .bore.diameter_mm = bore_between(*machine.bearings.planet);
    for (const char* name : {"6810", "6808", "6806", "6804"}) {
      machine.bearings.output = *find_element(standard_elements().bearings, name);
      const auto again = lay_out(design);
      const auto layout = again ? machine_layout(*again) : std::nullopt;
      if (layout && layout->retainer_radius_mm <= layout->cup_radius_mm) return;
    }
  }

  /// Of gears and everything around them; a warning counts as a failure.
  [[nodiscard]] DesignVerdict judged(const GearTrain& gears) const {
    DesignVerdict verdict;
    const auto take = [&](const Findings& findings) {
      for (const Finding& finding : findings) {
        const bool allowed = allowed_ == Allowed::kEveryWarning ||
                             (allowed_ == Allowed::kUndercut && finding.id == "undercut");
        const bool fails = finding.status == CheckStatus::kFail ||
                           (finding.status == CheckStatus::kWarn && !allowed);
        if (fails)
          verdict.failed.push_back(finding.id);
        else if (finding.status == CheckStatus::kWarn)
          verdict.warned.push_back(finding.id + " " + finding.where);
      }
    };
    const auto train = lay_out(whole(gears.design));
    if (!train) return {.failed = {"assembly"}, .warned = {}};
    if (motor_) {
      const auto shapes = part_shapes(*train);
      if (!shapes) return {.failed = {"wall"}, .warned = {}};
      take(check_machine(*train, *shapes));
      if (const auto layout = machine_layout(*train);
          2.0 * layout->least_outer_radius_mm > wishes_.outer_diameter_mm)
        verdict.failed.push_back("housing_size");
    }
    if (verdict.failed.empty()) take(check_gearbox(*train));
    return verdict;
  }

  /// What most of those fell in that were judged.
  static std::string most_fell(const SearchReport& report) {
    const auto& classes = report.fell_in_checks;
    const auto most =
        std::max_element(classes.begin(), classes.end(),
                         [](const SetClass& a, const SetClass& b) { return a.count < b.count; });
    return most == classes.end() ? "" : "; most of them fall in " + most->id;
  }

  [[nodiscard]] std::vector<std::string> sentences(const FoundDesign& found,
                                                   const SearchReport& report,
                                                   const GearboxDesign& design) const {
    const ToothSet& set = found.set;
    std::vector<std::string> told{
        "ratio " + fixed_text(std::abs(signed_ratio(set)), 3) + " for " +
            fixed_text(wishes_.ratio, 3) + " asked: sun " + std::to_string(set.sun) + ", planet1 " +
            std::to_string(set.planet1) + ", ring1 " + std::to_string(set.ring1) + ", planet2 " +
            std::to_string(set.planet2) + ", ring2 " + std::to_string(set.ring2) + " teeth",
        "the best forward efficiency (" + fixed_text(100.0 * found.exact_forward, 1) + " %) of " +
            std::to_string(report.feasible) +
            " sets with shifts that keep every limit, of which no check fails" +
            (allowed_ == Allowed::kNone ? " or warns" : "") + "; " + std::to_string(report.judged) +
            " were judged",
        "module " + fixed_text(design.module_mm, 4) +
            " mm: the largest that the outer diameter of " +
            fixed_text(wishes_.outer_diameter_mm, 1) + " mm leaves"};
    if (!found.verdict.warned.empty()) {
      std::string list;
      for (const std::string& id : found.verdict.warned) list += (list.empty() ? "" : ", ") + id;
      told.push_back("no set is without a warning; this one warns: " + list);
    }
    if (!motor_) return told;
    const BearingsDesign& bearings = design.machine->bearings;
    told.push_back("bearings " + (bearings.planet ? bearings.planet->name : std::string("none")) +
                   " in the planets and " + bearings.output.name +
                   " at the output: the largest that leave the walls that " + process_->name +
                   " makes");
    told.push_back("motor " + motor_->name + ": the sun's bore is that of its shaft");
    return told;
  }

  const DesignWishes& wishes_;
  Allowed allowed_ = Allowed::kNone;
  const Process* process_ = nullptr;
  std::string material_;
  const Motor* motor_ = nullptr;
};

}  // namespace

ResultAll<WishedDesign> wished_design(const std::string& name, const DesignWishes& wishes) {
  Wish wish(wishes);
  if (Errors errors = wish.check(); !errors.empty()) return fail_all(std::move(errors));
  return wish.find(name);
}

}  // namespace trueflank
