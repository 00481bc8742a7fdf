// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/remainder.h"

// What the teeth say of each other: height, slope and bow of every flank, around the gear.
namespace trueflank::loop {

/// False alarms of all that is looked for along flanks, of that around the gear.
constexpr double kRemainderLevel = 0.004;

/// Values of a flank of a tooth that a ring of teeth is asked about: sums of products with low
/// forms, and of the forms' squares.
struct ToothMoments {
  static constexpr std::size_t kForms = 5;
  std::array<double, kForms> sum{}, square{};
  std::array<double, kForms> form{};  ///< sums of the forms
  int count = 0;
  double total = 0.0, squares = 0.0;  ///< sums of the values and of their squares
  double loud = 1.0;  ///< the random error of its trace over that of the usual one
  /// Its scatter from place to place over the usual one, and from how many values that is known: 0
  /// where it is not.
  double scatter = 0.0, scatter_values = 0.0;

  /// Height, slope and bow over the profile coordinate u and the face coordinate v (-1 ... 1): 1,
  /// u, v, u^2 - 1/3, v^2 - 1/3.
  [[nodiscard]] static std::array<double, kForms> forms_at(double u, double v) {
    return {1.0, u, v, u * u - 1.0 / 3.0, v * v - 1.0 / 3.0};
  }
  /// Takes a value at a place to the sums that know of levels.
  void add(const std::array<double, kForms>& at, double um) {
    ++count;
    total += um;
    squares += um * um;
    for (std::size_t k = 0; k < kForms; ++k) form[k] += at[k];
  }
  /// Of a form the part that is no level: its square, and its product with the values.
  [[nodiscard]] double square_beside_level(std::size_t k) const {
    return square[k] - (count > 0 ? form[k] * form[k] / count : 0.0);
  }
  [[nodiscard]] double sum_beside_level(std::size_t k) const {
    return sum[k] - (count > 0 ? form[k] * total / count : 0.0);
  }
  /// Where a flank stands: side 0 right, 1 left.
  [[nodiscard]] static std::size_t at(int side, int tooth) {
    return 2 * static_cast<std::size_t>(tooth) + static_cast<std::size_t>(side);
  }
};

enum class MomentsOf { kScan, kProfiles, kHelices, kOthers };
/// Of every kind of record and source.
using MomentsOfTeeth = std::map<std::pair<MomentsOf, int>, std::vector<ToothMoments>>;

/// Neighbouring teeth that stand out with a slope or bow over the face, or as a whole.
struct ToothSector {
  int first = 0, count = 0;
  double face_degree = 0.0;
  bool opposite = false;  ///< on the two flanks
};

/// Whether the sign of an amount is that of the form's coefficient.
enum class SignOf { kForm, kUnknown };
/// The finding of a form, with its words. `amount` in um.
[[nodiscard]] RemainderFinding finding_of(const FlankGeometry& geometry, const char* family,
                                          FlankChoice flank, EffectShape shape, double p_value,
                                          double amount, bool local, double square = 0.0,
                                          SignOf sign = SignOf::kForm);
/// `side` 1 left and 0 right in the gear's own sense, -1 both.
[[nodiscard]] FlankChoice flank_choice(const FlankGeometry& geometry, int side);

/// What stands in place of a sector of a scan, where it takes out more.
using InPlaceOfSector =
    std::function<std::optional<RemainderFinding>(const ToothSector& sector, double p_value)>;

/// Arcs, waves, ramps and combs of the teeth's forms (scan_ring), and slopes and bows of traces that
/// both flanks of a tooth share and the teeth do not. Findings at `kRemainderLevel` or below.
[[nodiscard]] std::vector<RemainderFinding> look_around_gear(const FlankGeometry& geometry,
                                                             const MomentsOfTeeth& moments,
                                                             const InPlaceOfSector& dent);

}  // namespace trueflank::loop
