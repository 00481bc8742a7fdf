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

/// Classes of a hole and of what goes into it, either may be missing.
struct FitClasses {
  std::string hole, shaft;
  [[nodiscard]] std::string text() const;  ///< "H7/k6", "H7" or "k6"
  bool operator==(const FitClasses&) const = default;
};
/// Of a text like "H7/k6", "H7" or "k6"; nothing where that is no class of ISO 286.
[[nodiscard]] std::optional<FitClasses> fit_classes(const std::string& text);

}  // namespace trueflank
