// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/fit_class.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

constexpr int kFirstGrade = 4, kLastGrade = 12;
using Row = std::array<double, 10>;  // um, by the steps of size
constexpr Row kUpTo_mm{3, 6, 10, 18, 30, 50, 80, 120, 180, 250};
constexpr std::array<Row, 9> kGrades{{{3, 4, 4, 5, 6, 7, 8, 10, 12, 14},
                                      {4, 5, 6, 8, 9, 11, 13, 15, 18, 20},
                                      {6, 8, 9, 11, 13, 16, 19, 22, 25, 29},
                                      {10, 12, 15, 18, 21, 25, 30, 35, 40, 46},
                                      {14, 18, 22, 27, 33, 39, 46, 54, 63, 72},
                                      {25, 30, 36, 43, 52, 62, 74, 87, 100, 115},
                                      {40, 48, 58, 70, 84, 100, 120, 140, 160, 185},
                                      {60, 75, 90, 110, 130, 160, 190, 220, 250, 290},
                                      {100, 120, 150, 180, 210, 250, 300, 350, 400, 460}}};

struct Letter {
  const char* name;
  Row um;
};
/// Upper deviations of shafts, all negative.
constexpr std::array<Letter, 5> kBelow{{{"d", {20, 30, 40, 50, 65, 80, 100, 120, 145, 170}},
                                        {"e", {14, 20, 25, 32, 40, 50, 60, 72, 85, 100}},
                                        {"f", {6, 10, 13, 16, 20, 25, 30, 36, 43, 50}},
                                        {"g", {2, 4, 5, 6, 7, 9, 10, 12, 14, 15}},
                                        {"h", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}};
/// Lower deviations of shafts; k to IT7, from there 0.
constexpr std::array<Letter, 4> kAbove{{{"k", {0, 1, 1, 1, 2, 2, 2, 3, 3, 4}},
                                        {"m", {2, 4, 6, 7, 8, 9, 11, 13, 15, 17}},
                                        {"n", {4, 8, 10, 12, 15, 17, 20, 23, 27, 31}},
                                        {"p", {6, 12, 15, 18, 22, 26, 32, 37, 43, 50}}}};
/// r and s have finer steps of size above 50 mm.
constexpr std::array<double, 14> kFineUpTo_mm{3,   6,   10,  18,  30,  50,  65,
                                              80,  100, 120, 140, 160, 180, 200};
constexpr std::array<double, 16> kR{10, 15, 19, 23, 28, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84};
constexpr std::array<double, 16> kS{14, 19, 23, 28,  35,  43,  53,  59,
                                    71, 79, 92, 100, 108, 122, 130, 140};
/// j5 and j6, j7: lower deviations, negative; J6 to J8: upper ones.
constexpr Row kJ56{2, 2, 2, 3, 4, 5, 7, 9, 11, 13}, kJ7{4, 4, 5, 6, 8, 10, 12, 15, 18, 21};
constexpr std::array<Row, 3> kHoleJ{{{2, 5, 5, 6, 8, 10, 13, 16, 18, 22},
                                     {4, 6, 8, 10, 12, 14, 18, 22, 26, 30},
                                     {6, 10, 12, 15, 20, 24, 28, 34, 41, 47}}};

std::size_t step_of(double size_mm) {
  return static_cast<std::size_t>(std::lower_bound(kUpTo_mm.begin(), kUpTo_mm.end(), size_mm) -
                                  kUpTo_mm.begin());
}

std::size_t fine_step_of(double size_mm) {
  if (size_mm > 225.0) return 15;
  return static_cast<std::size_t>(std::lower_bound(kFineUpTo_mm.begin(), kFineUpTo_mm.end(), size_mm) -
                                  kFineUpTo_mm.begin());
}

double grade_um(int grade, std::size_t step) {
  return kGrades[static_cast<std::size_t>(grade - kFirstGrade)][step];
}

struct Micrometres {
  double lower = 0.0, upper = 0.0;
};

/// A deviation above the nominal size, of a shaft; k to s.
std::optional<double> lower_deviation_um(const std::string& letter, int grade, double size_mm) {
  if (letter == "k" && grade > 7) return 0.0;
  for (const Letter& row : kAbove)
    if (letter == row.name) return row.um[step_of(size_mm)];
  if (letter == "r") return kR[fine_step_of(size_mm)];
  if (letter == "s") return kS[fine_step_of(size_mm)];
  return std::nullopt;
}

std::optional<Micrometres> shaft_um(const std::string& letter, int grade, double size_mm) {
  const std::size_t step = step_of(size_mm);
  const double width = grade_um(grade, step);
  for (const Letter& row : kBelow)
    if (letter == row.name) return Micrometres{-row.um[step] - width, -row.um[step]};
  if (letter == "j" && grade >= 5 && grade <= 7) {
    const double low = -(grade == 7 ? kJ7 : kJ56)[step];
    return Micrometres{low, low + width};
  }
  const auto lower = lower_deviation_um(letter, grade, size_mm);
  if (!lower) return std::nullopt;
  return Micrometres{*lower, *lower + width};
}

/// Holes mirror the shafts; K to S with the standard's Delta, the step to the next finer grade.
std::optional<Micrometres> hole_um(const std::string& letter, int grade, double size_mm) {
  const std::size_t step = step_of(size_mm);
  const double width = grade_um(grade, step);
  for (const Letter& row : kBelow)
    if (letter == row.name) return Micrometres{row.um[step], row.um[step] + width};
  if (letter == "j" && grade >= 6 && grade <= 8) {
    const double high = kHoleJ[static_cast<std::size_t>(grade - 6)][step];
    return Micrometres{high - width, high};
  }
  const bool shallow = letter == "k" || letter == "m" || letter == "n";
  // beyond these grades the standard goes on without Delta, and with exceptions
  if (grade > 8 || grade <= kFirstGrade) return std::nullopt;
  const auto shaft = lower_deviation_um(letter, std::min(grade, 7), size_mm);
  if (!shaft) return std::nullopt;
  const bool stepped = size_mm > 3.0 && grade <= (shallow ? 8 : 7);
  const double delta = stepped ? width - grade_um(grade - 1, step) : 0.0;
  const double upper = -*shaft + delta;
  return Micrometres{upper - width, upper};
}

}  // namespace

double standard_tolerance_mm(int grade, double size_mm) {
  TRUEFLANK_EXPECTS(grade >= kFirstGrade && grade <= kLastGrade && size_mm > 0.0 &&
                    size_mm <= kLargestFit_mm);
  return grade_um(grade, step_of(size_mm)) / 1000.0;
}

std::optional<FitLimits> fit_limits(const std::string& name, double size_mm) {
  std::size_t letters = 0;
  while (letters < name.size() && is_letter(name[letters])) ++letters;
  const std::string digits = name.substr(letters);
  if (letters == 0 || letters > 2 || digits.empty() || digits.size() > 2 || digits[0] == '0' ||
      !std::all_of(digits.begin(), digits.end(), is_digit) ||
      !(size_mm > 0.0 && size_mm <= kLargestFit_mm))
    return std::nullopt;
  const int grade = std::stoi(digits);
  if (grade < kFirstGrade || grade > kLastGrade) return std::nullopt;
  std::string letter = name.substr(0, letters);
  const bool hole = is_capital(letter[0]);
  for (char& c : letter) {
    if (is_capital(c) != hole) return std::nullopt;
    c = as_small(c);
  }
  if (letter == "js") {
    const double half = 0.5 * standard_tolerance_mm(grade, size_mm);
    return FitLimits{-half, half};
  }
  const auto um = hole ? hole_um(letter, grade, size_mm) : shaft_um(letter, grade, size_mm);
  if (!um) return std::nullopt;
  return FitLimits{um->lower / 1000.0, um->upper / 1000.0};
}

std::string FitClasses::text() const {
  return hole + (hole.empty() || shaft.empty() ? "" : "/") + shaft;
}

std::optional<FitClasses> fit_classes(const std::string& text) {
  constexpr double kAnySize_mm = 10.0;
  const auto is_hole = [](const std::string& name) { return !name.empty() && is_capital(name[0]); };
  const std::size_t bar = text.find('/');
  FitClasses classes;
  if (bar != std::string::npos)
    classes = {text.substr(0, bar), text.substr(bar + 1)};
  else if (is_hole(text))
    classes.hole = text;
  else
    classes.shaft = text;
  const auto known = [&](const std::string& name, bool hole) {
    return is_hole(name) == hole && fit_limits(name, kAnySize_mm).has_value();
  };
  const bool both = bar != std::string::npos;
  if ((both || !classes.hole.empty()) && !known(classes.hole, true)) return std::nullopt;
  if ((both || !classes.shaft.empty()) && !known(classes.shaft, false)) return std::nullopt;
  if (classes == FitClasses{}) return std::nullopt;
  return classes;
}

}  // namespace trueflank
