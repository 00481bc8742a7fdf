// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "trueflank/loop/discovery/rough_zone.h"
#include "trueflank/loop/discovery/rougher_members.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/local/remainder_courses.h"

namespace trueflank::loop {

/// A part of the traces of both sides (-1) or of one in which the surface, or the probe on it, is
/// rougher. Without a length: there is none.
struct RoughFlanks {
  int side = -1;
  RoughZone zone;
};

/// The surest one, its p-value corrected for the sides looked at.
[[nodiscard]] RoughFlanks rough_flanks(const Courses& courses);

/// True where it is the surface: a probe may see a part of all traces, most of all their ends, two
/// or two and a half times worse.
[[nodiscard]] bool is_rough_surface(const RoughZone& zone);

/// "all traces over the face of left flanks are rougher between heights of 2 and 5 mm: ...".
[[nodiscard]] std::string words_of(const RoughZone& zone, FlankChoice flank, bool face,
                                   double low_mm, double high_mm);

/// How much every trace of the courses scatters: its tooth and side.
[[nodiscard]] std::vector<MemberScatter> scatters_of(const Courses& courses);

/// "the traces over the face of right flanks are rougher on teeth 7 to 9: ...". `what` stands
/// before the flanks.
[[nodiscard]] std::string words_of(const RougherMembers& rougher, const std::string& what,
                                   FlankChoice flank);

/// "on tooth 4", "on teeth 27 to 29", "on teeth 2, 5 and 9", "on 12 teeth, ...".
[[nodiscard]] std::string words_of_teeth(const std::set<int>& teeth);

}  // namespace trueflank::loop
