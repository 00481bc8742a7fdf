// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/formula.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank::loop {

/// Recursive descent: sum, product, sign, power, value.
class FormulaParser {
 public:
  FormulaParser(std::string_view text, const std::vector<std::string>& names)
      : text_(text), names_(names) {}

  Result<Formula> run() {
    sum(0);
    skip_blanks();
    if (problem_.empty() && at_ < text_.size()) expected("an operator");
    if (problem_.empty() && formula_.operations_.size() > Formula::kMostOperations) {
      problem_ = "more than " + std::to_string(Formula::kMostOperations) + " numbers and operators";
      where_ = text_.size();
    }
    if (problem_.empty()) return std::move(formula_);
    return fail({.code = ErrorCode::kSyntax,
                 .message = problem_ + " at character " + std::to_string(where_ + 1),
                 .value = std::string(text_.substr(0, 80)),
                 .remedy = "numbers, + - * / ^, brackets, sin cos tan exp log sqrt abs step min max, "
                           "and " + names_in_words()});
  }

 private:
  using Step = Formula::Step;

  std::string names_in_words() const {
    std::string all;
    for (const std::string& name : names_) all += (all.empty() ? "" : " ") + name;
    return all;
  }
  void expected(const std::string& what) {
    if (!problem_.empty()) return;
    problem_ = what + " is missing";
    where_ = at_;
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void emit(Step step, double number = 0.0, int variable = 0) {
    formula_.operations_.push_back({step, number, variable});
    const bool pushes = step == Step::kNumber || step == Step::kVariable;
    const bool joins = (step >= Step::kAdd && step <= Step::kPower) || step >= Step::kMin;
    depth_ += pushes ? 1 : joins ? -1 : 0;
    if (depth_ > Formula::kDeepest) expected("an end to so much nesting");
  }

  void sum(int level) {
    if (level > Formula::kDeepest) return expected("an end to so much nesting");
    product(level + 1);
    while (problem_.empty()) {
      const bool add = take('+');
      if (!add && !take('-')) return;
      product(level + 1);
      emit(add ? Step::kAdd : Step::kSubtract);
    }
  }
  void product(int level) {
    sign(level + 1);
    while (problem_.empty()) {
      const bool times = take('*');
      if (!times && !take('/')) return;
      sign(level + 1);
      emit(times ? Step::kMultiply : Step::kDivide);
    }
  }
  void sign(int level) {
    bool negative = false;
    while (take('-')) negative = !negative;
    power(level + 1);
    if (negative) emit(Step::kNegate);
  }
  void power(int level) {
    if (level > 4 * Formula::kDeepest) return expected("an end to so much nesting");
    value(level + 1);
    if (!take('^')) return;
    const bool negative = take('-');
    power(level + 1);
    if (negative) emit(Step::kNegate);
    emit(Step::kPower);
  }

  void value(int level) {
    if (!problem_.empty()) return;
    if (take('(')) {
      sum(level);
      if (!take(')')) expected("a closing bracket");
      return;
    }
    skip_blanks();
    double number = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (error == std::errc() && text_[at_] != 'i' && text_[at_] != 'n') {  // not inf, nan
      at_ += static_cast<std::size_t>(end - begin);
      emit(Step::kNumber, number);
      return;
    }
    word(level);
  }

  void word(int level) {
    const std::size_t begin = at_;
    const auto in_word = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    while (at_ < text_.size() && in_word(text_[at_])) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    const auto known = std::find(names_.begin(), names_.end(), name);
    if (known != names_.end())
      return emit(Step::kVariable, 0.0, static_cast<int>(known - names_.begin()));
    if (name == "pi") return emit(Step::kNumber, kPi);
    if (const auto function = function_called(name)) return arguments(*function, level);
    at_ = begin;
    expected(name.empty() ? "a value" : "a known name in place of \"" + name + "\"");
  }

  static std::optional<Step> function_called(const std::string& name) {
    constexpr std::array<std::pair<const char*, Step>, 10> kFunctions{{{"sin", Step::kSin},
                                                                       {"cos", Step::kCos},
                                                                       {"tan", Step::kTan},
                                                                       {"exp", Step::kExp},
                                                                       {"log", Step::kLog},
                                                                       {"sqrt", Step::kSqrt},
                                                                       {"abs", Step::kAbs},
                                                                       {"step", Step::kStep},
                                                                       {"min", Step::kMin},
                                                                       {"max", Step::kMax}}};
    for (const auto& [known, step] : kFunctions)
      if (name == known) return step;
    return std::nullopt;
  }

  void arguments(Step function, int level) {
    if (!take('(')) return expected("the bracket of a function");
    sum(level);
    if (function >= Step::kMin) {
      if (!take(',')) return expected("a comma");
      sum(level);
    }
    if (!take(')')) return expected("a closing bracket");
    emit(function);
  }

  std::string_view text_;
  const std::vector<std::string>& names_;
  Formula formula_;
  std::string problem_;
  std::size_t at_ = 0, where_ = 0;
  int depth_ = 0;
};

Result<Formula> Formula::make(std::string_view text, const std::vector<std::string>& names) {
  return FormulaParser(text, names).run();
}

double Formula::operator()(const double* values) const {
  std::array<double, kDeepest + 1> stack;
  int top = -1;
  for (const Operation& o : operations_) {
    const bool joins = (o.step >= Step::kAdd && o.step <= Step::kPower) || o.step >= Step::kMin;
    const double b = top >= 0 ? stack[static_cast<std::size_t>(top)] : 0.0;
    if (joins) --top;
    else if (o.step <= Step::kVariable) ++top;
    double& a = stack[static_cast<std::size_t>(top)];
    switch (o.step) {
      case Step::kNumber: a = o.number; break;
      case Step::kVariable: a = values[o.variable]; break;
      case Step::kAdd: a += b; break;
      case Step::kSubtract: a -= b; break;
      case Step::kMultiply: a *= b; break;
      case Step::kDivide: a /= b; break;
      case Step::kPower: a = std::pow(a, b); break;
      case Step::kNegate: a = -a; break;
      case Step::kSin: a = std::sin(a); break;
      case Step::kCos: a = std::cos(a); break;
      case Step::kTan: a = std::tan(a); break;
      case Step::kExp: a = std::exp(a); break;
      case Step::kLog: a = std::log(a); break;
      case Step::kSqrt: a = std::sqrt(a); break;
      case Step::kAbs: a = std::abs(a); break;
      case Step::kStep: a = a > 0.0 ? 1.0 : 0.0; break;
      case Step::kMin: a = std::min(a, b); break;
      case Step::kMax: a = std::max(a, b); break;
    }
  }
  return stack[0];
}

}  // namespace trueflank::loop
