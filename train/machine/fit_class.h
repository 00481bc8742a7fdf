// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

// Tolerance classes of ISO 286 for the seats of a gearbox.
namespace trueflank {

/// How far a size may lie from its nominal one.
struct FitLimits {
  double lower_mm = 0.0, upper_mm = 0.0;
  [[nodiscard]] double middle_mm() const { return 0.5 * (lower_mm + upper_mm); }
};

/// Largest size with a tolerance class.
inline constexpr double kLargestFit_mm = 250.0;

/// Standard tolerance of a grade. Requires: 0 < size <= kLargestFit_mm, grade 4 to 12.
/// Source: ISO 286-1, values as printed there.
[[nodiscard]] double standard_tolerance_mm(int grade, double size_mm);

/// Limits of a class by its name, "H7" (holes) or "k6" (shafts): letters d e f g h js j k m n p r s,
/// grades 4 to 12; holes K to S 5 to 8, j 5 to 7, J 6 to 8. Nothing of another name or size.
/// Source: ISO 286-1, values as printed there.
[[nodiscard]] std::optional<FitLimits> fit_limits(const std::string& name, double size_mm);

/// Classes of a gearbox whose fit_mm is 0: of holes for bearings, shaft, collar and pins, and of
/// journals in bearings.
inline constexpr const char *kSeatClass = "H7", *kJournalClass = "g6";

/// A hole for, and a journal in, what has a size, with a diametral clearance; with 0 the middle of
/// the limits of kSeatClass and kJournalClass.
[[nodiscard]] double seat_mm(double size_mm, double fit_mm);
[[nodiscard]] double journal_mm(double size_mm, double fit_mm);

}  // namespace trueflank
