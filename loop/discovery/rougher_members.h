// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

// Courses of numbered members whose values scatter more the higher their number, or more in a run
// of neighbours. Knows nothing of gears.
namespace trueflank::loop {

/// How much the values of one course scatter from place to place.
struct MemberScatter {
  int number = 0;        ///< of the member, 1 ... as many as there are
  int set = 0;           ///< 0 or 1: a member has a course in either, or in one
  double scatter = 0.0;  ///< robust; 0 where it is not known
  double values = 0.0;   ///< differences it was told from
};

/// Members whose courses are rougher than those of the others.
struct RougherMembers {
  int set = -1;             ///< -1: both
  bool grows = false;       ///< from the lowest number to the highest, or the other way round
  int first = 0, last = 0;  ///< of a run; where it grows, the quietest and the loudest
  double times = 1.0;       ///< of the run over the others; of the loudest over the quietest
  double inside = 0.0;      ///< the usual scatter of the run, or at the loudest end
  double p_value = 1.0;     ///< corrected for all that was looked at
};

/// True where there are so many members that the question is asked.
[[nodiscard]] bool are_asked(const std::vector<MemberScatter>& members);

/// The surer of a growth with the number and a run of two to a third of the members, by the
/// logarithms of the scatters. Members that differ each by itself are judged by how much they
/// differ. Empty of fewer than eight members, and where it is less than twice as loud.
[[nodiscard]] std::optional<RougherMembers> rougher_members(
    const std::vector<MemberScatter>& members);

}  // namespace trueflank::loop
