// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/trace_zeros.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {

/// True where a value that far back begins another run: what came before went one way, and the
/// value stands back by more than half of it. Values in no order begin none.
bool TraceZeros::Run::ends_before(double along_mm) const {
  constexpr int kFewest = 8;
  constexpr double kStraight = 1.2, kBack = 0.5;
  const double span = high_mm - low_mm;
  return values >= kFewest && path_mm <= kStraight * span &&
         std::abs(along_mm - last_mm) > kBack * span &&
         (along_mm - last_mm) * (last_mm - first_mm) < 0.0;
}

void TraceZeros::Run::add(double along_mm) {
  if (values++ == 0) first_mm = last_mm = low_mm = high_mm = along_mm;
  path_mm += std::abs(along_mm - last_mm);
  last_mm = along_mm;
  low_mm = std::min(low_mm, along_mm);
  high_mm = std::max(high_mm, along_mm);
}

int TraceZeros::of_trace(const Record& record, double along_mm, double across_mm,
                         bool own_zero_there) {
  const long long place = std::llround(1000.0 * across_mm);
  Run& run = runs_[{record, place}];
  if (run.ends_before(along_mm)) run = {.number = run.number + 1};
  run.add(along_mm);
  return zero(record, own_zero_there ? place : kAllPlaces, run.number);
}

int TraceZeros::zero(const Record& record, long long place, int run) {
  const auto [found, is_new] = zeros_.emplace(std::tuple(record, place, run), count_);
  if (is_new) ++count_;
  return found->second;
}

}  // namespace trueflank::loop
