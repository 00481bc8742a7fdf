// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace trueflank::loop {

/// Which values of inspection files share one unknown zero. A trace has a zero of its own, all
/// index values of a flank share theirs. A trace that was measured again starts anew at the same
/// height or diameter: it is another trace with another zero, or the difference of the two would
/// pass for noise. Traces of one flank at several heights or diameters share theirs, as a
/// topography does, but where they are said to have their own (zeros_at_places.h).
class TraceZeros {
 public:
  /// What tells records apart: kind, tooth, side, file.
  using Record = std::array<int, 4>;

  /// The zero of a value of a record that is no trace.
  [[nodiscard]] int of(const Record& record) { return zero(record, kAllPlaces, 0); }
  /// The zero of the next value of a trace, in the order of the file. `along_mm`: where it stands
  /// in the trace's direction; `across_mm`: the height of a profile, the diameter of a helix.
  [[nodiscard]] int of_trace(const Record& record, double along_mm, double across_mm,
                             bool own_zero_there);
  [[nodiscard]] int count() const { return count_; }

 private:
  /// One run along the flank so far.
  struct Run {
    int number = 0, values = 0;
    double first_mm = 0.0, last_mm = 0.0, low_mm = 0.0, high_mm = 0.0, path_mm = 0.0;
    [[nodiscard]] bool ends_before(double along_mm) const;
    void add(double along_mm);
  };
  int zero(const Record& record, long long place, int run);

  static constexpr long long kAllPlaces = -1;
  std::map<std::tuple<Record, long long, int>, int> zeros_;  ///< of a record's runs at a place
  std::map<std::pair<Record, long long>, Run> runs_;  ///< at a height or diameter, in um
  int count_ = 0;
};

}  // namespace trueflank::loop
