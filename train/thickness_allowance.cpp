// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/thickness_allowance.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr std::size_t kRanges = 11, kLetters = 11, kNumbers = 10;
/// Upper ends of the ranges of the reference diameter; each belongs to its range.
constexpr std::array<double, kRanges> kLargest_mm = {10,   50,   125,  280,  560,  1000,
                                                     1600, 2500, 4000, 6300, 10000};
constexpr std::array<std::string_view, kLetters> kSeries = {"a", "ab", "b", "bc", "c", "cd",
                                                            "d", "e",  "f", "g",  "h"};
constexpr int kFirstNumber = 21;

/// Table 1, sign left out [um].
constexpr std::array<std::array<int, kLetters>, kRanges> kUpper_um = {{
    {100, 85, 70, 58, 48, 40, 33, 22, 10, 5, 0},
    {135, 110, 95, 75, 65, 54, 44, 30, 14, 7, 0},
    {180, 150, 125, 105, 85, 70, 60, 40, 19, 9, 0},
    {250, 200, 170, 140, 115, 95, 80, 56, 26, 12, 0},
    {330, 280, 230, 190, 155, 130, 110, 75, 35, 17, 0},
    {450, 370, 310, 260, 210, 175, 145, 100, 48, 22, 0},
    {600, 500, 420, 340, 290, 240, 200, 135, 64, 30, 0},
    {820, 680, 560, 460, 390, 320, 270, 180, 85, 41, 0},
    {1100, 920, 760, 620, 520, 430, 360, 250, 115, 56, 0},
    {1500, 1250, 1020, 840, 700, 580, 480, 330, 155, 75, 0},
    {2000, 1650, 1350, 1150, 940, 780, 640, 450, 210, 100, 0},
}};
/// Table 2 [um].
constexpr std::array<std::array<int, kNumbers>, kRanges> kTolerance_um = {{
    {3, 5, 8, 12, 20, 30, 50, 80, 130, 200},
    {5, 8, 12, 20, 30, 50, 80, 130, 200, 300},
    {6, 10, 16, 25, 40, 60, 100, 160, 250, 400},
    {8, 12, 20, 30, 50, 80, 130, 200, 300, 500},
    {10, 16, 25, 40, 60, 100, 160, 250, 400, 600},
    {12, 20, 30, 50, 80, 130, 200, 300, 500, 800},
    {16, 25, 40, 60, 100, 160, 250, 400, 600, 1000},
    {20, 30, 50, 80, 130, 200, 300, 500, 800, 1300},
    {25, 40, 60, 100, 160, 250, 400, 600, 1000, 1600},
    {30, 50, 80, 130, 200, 300, 500, 800, 1300, 2000},
    {40, 60, 100, 160, 250, 400, 600, 1000, 1600, 2400},
}};

struct Columns {
  std::size_t letter = 0, number = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "cd25" or "25cd".
std::optional<Columns> columns_of(std::string_view series) {
  if (series.size() < 3) return std::nullopt;
  const bool number_first = is_digit(series.front());
  const std::string_view number = number_first ? series.substr(0, 2)
                                               : series.substr(series.size() - 2);
  const std::string_view letters = number_first ? series.substr(2)
                                                : series.substr(0, series.size() - 2);
  if (!is_digit(number[0]) || !is_digit(number[1])) return std::nullopt;
  const int value = 10 * (number[0] - '0') + (number[1] - '0');
  if (value < kFirstNumber || value >= kFirstNumber + static_cast<int>(kNumbers))
    return std::nullopt;
  for (std::size_t i = 0; i < kLetters; ++i)
    if (letters == kSeries[i]) return Columns{i, static_cast<std::size_t>(value - kFirstNumber)};
  return std::nullopt;
}

}  // namespace

Result<ThicknessAllowance> din3967_allowance(const std::string& series,
                                             double reference_diameter_mm) {
  const auto columns = columns_of(series);
  if (!columns)
    return fail(Error{.code = ErrorCode::kOutOfRange,
                      .message = "no series of DIN 3967",
                      .value = series,
                      .remedy = "a, ab, b, bc, c, cd, d, e, f, g or h and a number from 21 to 30, "
                                "like \"cd25\""});
  for (std::size_t i = 0; i < kRanges; ++i) {
    if (!(reference_diameter_mm <= kLargest_mm[i])) continue;
    const double upper = -kUpper_um[i][columns->letter];
    return ThicknessAllowance{
        .series = series,
        .upper_mm = mm_from_um(upper),
        .lower_mm = mm_from_um(upper - kTolerance_um[i][columns->number])};
  }
  return fail(Error{.code = ErrorCode::kOutOfRange,
                    .message = "DIN 3967 ends at a reference diameter of 10 m",
                    .value = series,
                    .remedy = "thickness_upper_um and thickness_lower_um instead"});
}

}  // namespace trueflank
