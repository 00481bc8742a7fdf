// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"

namespace trueflank::loop {

/// An expression of named variables, as effects are declared with: numbers, pi, + - * / ^, brackets,
/// and the functions sin cos tan exp log sqrt abs step (1 above 0, else 0) min max.
class Formula {
 public:
  /// Names are those the expression may use; values are later given in their order.
  /// Errors: kSyntax with the text, the place and what was expected there.
  [[nodiscard]] static Result<Formula> make(std::string_view text,
                                            const std::vector<std::string>& names);

  /// Value for one value a name. Not finite where the expression has no value there.
  [[nodiscard]] double operator()(const double* values) const;
  [[nodiscard]] std::size_t operations() const { return operations_.size(); }

 private:
  enum class Step : unsigned char {
    kNumber, kVariable, kAdd, kSubtract, kMultiply, kDivide, kPower, kNegate,
    kSin, kCos, kTan, kExp, kLog, kSqrt, kAbs, kStep, kMin, kMax
  };
  struct Operation {
    Step step = Step::kNumber;
    double number = 0.0;
    int variable = 0;
  };
  /// Evaluated at every vertex of a corrected mesh and at every point of a scan.
  static constexpr std::size_t kMostOperations = 4000;
  static constexpr int kDeepest = 64;  ///< of the stack, so that no text can exhaust it

  friend class FormulaParser;
  std::vector<Operation> operations_;  ///< in the order of a stack machine
};

}  // namespace trueflank::loop
