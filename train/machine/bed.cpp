// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/machine/bed.h"

#include <charconv>

namespace trueflank {
namespace {

constexpr double kSmallest_mm = 20.0, kLargest_mm = 5000.0;

/// A length that fills its text, spaces aside; nothing else, and nothing out of reason.
std::optional<double> length_of(std::string text) {
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  if (!(value >= kSmallest_mm && value <= kLargest_mm)) return std::nullopt;
  return value;
}

}  // namespace

const std::vector<Bed>& standard_beds() {
  static const std::vector<Bed> beds{{"prusa-mini", 180, 180},    {"prusa-mk4", 250, 210},
                                     {"prusa-xl", 360, 360},      {"ender-3", 220, 220},
                                     {"bambu-a1-mini", 180, 180}, {"bambu-x1", 256, 256},
                                     {"voron-300", 300, 300}};
  return beds;
}

std::optional<Bed> find_bed(const std::string& text) {
  for (const Bed& bed : standard_beds())
    if (bed.name == text) return bed;
  const auto cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const auto width = length_of(text.substr(0, cross)), depth = length_of(text.substr(cross + 1));
  if (!width || !depth) return std::nullopt;
  return Bed{text, *width, *depth};
}

std::vector<std::string> known_beds() {
  std::vector<std::string> known;
  for (const Bed& bed : standard_beds()) known.push_back(bed.name);
  known.emplace_back("or its size in mm from 20 to 5000, as \"250x210\"");
  return known;
}

}  // namespace trueflank
