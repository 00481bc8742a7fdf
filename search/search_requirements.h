// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/gear.h"
#include "trueflank/train/efficiency.h"
#include "trueflank/train/gearbox_design.h"
#include "trueflank/train/strength.h"

// What a search for designs is asked for (docs/requirements-file.md); the file is read by design/.
namespace trueflank {

/// Inclusive range of tooth numbers.
struct ToothRange {
  int min = 0, max = 0;
  [[nodiscard]] long long count() const { return max < min ? 0 : max - min + 1LL; }
};

/// A range of which either end may be left open.
struct OpenToothRange {
  std::optional<int> min = {}, max = {};
  [[nodiscard]] ToothRange over(const ToothRange& usual) const {
    return {min.value_or(usual.min), max.value_or(usual.max)};
  }
};

/// What a design is ranked by, or held to; search_figures.h says what each is and which way is better.
enum class SearchObjective {
  kForward,
  kBackward,
  kTorque,
  kSize,
  kMass,
  kLength,
  kTorqueDensity,
  kStartingTorque,
  kInputInertia,
  kOutputInertia,
  kContactRatio,
  kSliding,
  kBacklash,
  kAcceleration,
  kSettling,
  kWeighted,  ///< SearchRequirements::weights
};
[[nodiscard]] const char* to_text(SearchObjective objective);

/// A figure that every design keeps: at least `value` where large is better, else at most.
struct FigureLimit {
  SearchObjective figure;
  double value = 0.0;
  bool operator==(const FigureLimit&) const = default;
};

/// An objective's share in a weighted ranking.
struct ObjectiveWeight {
  SearchObjective objective;
  double weight = 1.0;
  bool operator==(const ObjectiveWeight&) const = default;
};

/// The motor on the input and what hangs on the output.
struct MotorDesign {
  double torque_nm = kNaN;  ///< at the input, either way; NaN: not known
  double speed_rpm = kNaN;  ///< it turns no faster; NaN: no bound
  double rotor_kg_m2 = 0.0;
  double load_kg_m2 = 0.0;
  double load_nm = 0.0;          ///< against the motion of the output
  double move_rad = 0.5 * kPi;  ///< of the output, from rest to rest, for the settling time
};

/// What parts may be off by, for the share of sets that assemble; as `check --tolerance` takes it.
struct SearchTolerance {
  std::optional<int> tolerance_class;  ///< ISO 1328-1
  double centre_distance_um = 0.0, tooth_thickness_um = 0.0;
};

enum class OutputDirection { kAny, kSame, kOpposite };

/// Circumferential backlash of designs for which none is asked, in modules: what textbooks give
/// gears of ordinary accuracy (0.03 to 0.05).
inline constexpr double kUsualBacklash = 0.04;

struct SearchRequirements {
  std::string name = "search";
  std::vector<std::string> kinds{"3k"};  ///< all ranked together
  /// Members that drive out and in; empty: the usual one of each kind; "any": every one. A kind
  /// that has none of those named takes its usual one.
  std::vector<std::string> outputs, inputs;
  std::vector<int> planets{3};                           ///< numbers of planet bodies
  bool external_wheels = true, internal_wheels = false;  ///< of pairs
  double friction = 0.1;
  double face_width_mm = 10.0;
  /// A design that does not carry the torque asked for gets wider up to this, then its module grows
  /// up to that below; omitted: neither.
  std::optional<double> face_width_max_mm, module_max_mm;
  std::optional<double> backlash_mm;  ///< of every mesh of the designs; omitted: kUsualBacklash
  BasicRack rack;
  double helix_angle_rad = 0.0;         ///< of every gear, right hand positive on the first one
  std::optional<ShaperCutter> cutter;   ///< that shapes every ring; omitted: their roots are fillets

  /// Normal module of layer 1; with an outer diameter the module follows from it instead.
  double module_mm = 1.0;
  std::optional<double> outer_diameter_mm;
  double rim = 2.5;  ///< of a ring outside its root circle, coefficient of its module
  std::vector<double> layer2_module_ratios{1.0};  ///< module of layer 2 over that of layer 1

  double ratio_min = kNaN, ratio_max = kNaN;  ///< of |input speed / output speed|
  OutputDirection direction = OutputDirection::kAny;
  ToothRange sun{6, 60}, planet1{6, 60}, ring1{12, 120}, planet2{6, 60}, ring2{12, 120};
  /// Gears of kinds with other names; what is open is as planet1, ring1 (stepped: ring2), sun, and
  /// planet1 (internal: ring1).
  OpenToothRange planet, ring, pinion, wheel;
  bool identical_planets = true;  ///< bodies must all be alike at equal spacing

  double shift_min = -2.0, shift_max = 2.0;
  double contact_ratio_min = 1.0, contact_ratio_max = 2.0;
  double clearance_um = 2.0;               ///< least, of tip corners to the mate's profile
  double tip_clearance = 0.1;              ///< least, coefficient of the module
  double tip_thickness = 0.2;              ///< least, coefficient of the module
  double planet_clearance_mm = 0.5;        ///< least, between tip circles of neighbouring planets
  std::optional<double> output_torque_nm;  ///< to be carried
  std::vector<FigureLimit> figure_limits;  ///< each figure at most once
  bool hunting = false;     ///< no two teeth of a mesh have a common divisor in their numbers
  bool sequential = false;  ///< in every mesh the planets engage one after another
  double assembling_share_min = 0.0;  ///< of sets made within `tolerance`
  std::optional<SearchTolerance> tolerance;
  MotorDesign motor;
  std::optional<LossesDesign> losses;      ///< measured on a like drive; written into the designs
  StrengthOptions strength;
  LossModel loss_model = LossModel::kPathIntegral;

  /// One: designs are ranked by it. Several: the Pareto front of them, ranked by the first.
  std::vector<SearchObjective> objectives{SearchObjective::kForward};
  std::vector<ObjectiveWeight> weights;  ///< of kWeighted, which is then the only objective
  int results = 20;  ///< design files written
  /// Tooth sets in the ranking, the best: what cannot be among them need not be optimised. Never
  /// fewer than results; 0: all.
  int listed = 200;
};

/// Everything that contradicts itself or cannot be, all at once; empty where nothing does.
[[nodiscard]] Errors validate(const SearchRequirements& requirements);

/// A text of every value that decides the answer, the same for equal requirements: journals of a
/// search carry it, so that no run resumes or merges another's.
[[nodiscard]] std::string fingerprint(const SearchRequirements& requirements);

}  // namespace trueflank
