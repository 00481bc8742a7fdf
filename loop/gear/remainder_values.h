// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "trueflank/loop/discovery/rougher_members.h"
#include "trueflank/loop/gear/local/remainder_courses.h"
#include "trueflank/loop/gear/remainder_around.h"

// What the search through residuals looks at, gathered once.
namespace trueflank::loop {

/// Residuals along traces and scanned flanks, and of every flank.
struct RemainderValues {
  std::map<CourseKey, Courses> courses;
  std::map<CourseKey, Courses> coarse_courses;  ///< of values read coarsely, spread widely
  MomentsOfTeeth moments;
};

/// Which rows are looked at.
[[nodiscard]] std::vector<bool> rows_looked_at(const Observations& table, const Patches& patches,
                                               RemainderOf which);

/// Gathers the rows looked at (`used`). `row_um`: the residual of every row.
[[nodiscard]] RemainderValues gather_values(const FlankGeometry& geometry,
                                            const Observations& table, const Patches& patches,
                                            const std::vector<float>& row_um, RemainderOf which,
                                            const std::vector<bool>& used);

/// How much louder than the usual one of its side each flank or trace is: to the moments of its
/// tooth.
void tell_loudness(const std::vector<MemberScatter>& scatters, std::vector<ToothMoments>& moments);

}  // namespace trueflank::loop
