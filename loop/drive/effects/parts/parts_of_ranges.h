// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"

// What stands in a part of a range, or in some of the rows: where that is, of what it is, and how
// both are said.
namespace trueflank::loop::drive_effects {

/// True where the load, the speed, the temperature, the run (kOverRun) or the load that drives
/// (kOverDrivingLoad) was run at enough values that a part of it can be told.
[[nodiscard]] bool has_parts_over(const DriveContext& context, double over);
/// 0 ... 1 from the least to the largest that was run.
[[nodiscard]] double share_in_range(const DriveContext& context, const BenchPoint& p, double over);
/// The load, the speed and the temperature where a part of them can be told. Of loads what drives:
/// what is driven has the effect itself in it.
[[nodiscard]] std::vector<double> ranges_with_edges(const DriveContext& context);
/// share_in_range() of every row.
[[nodiscard]] std::vector<double> shares_of_rows(const DriveContext& context, double over);
/// The same of every row of a log, worked out once.
[[nodiscard]] const std::vector<double>& shares_of_every_row(const DriveContext& context,
                                                             double over);
/// Places between rows, with about as many rows between two of them.
[[nodiscard]] std::vector<double> edges_to_try(std::vector<double> shares, std::size_t most);
/// Nearly at both ends of the gap between rows in which a place lies: an edge may be anywhere in
/// it.
[[nodiscard]] std::vector<double> ends_of_gap(const std::vector<double>& shares, double place);
/// The place of a share: a figure whose name ends with `output_nm`, `input_nm`, `rpm`, `c`, `line`.
[[nodiscard]] Parameter figure_at_share(const DriveContext& context, double over,
                                        const std::string& key, double share);
/// "a speed of 400 (395 to 404) rpm", "line 20".
[[nodiscard]] std::string place_in_range(double over, const Parameter& place);
/// "400 (395 to 404) rpm".
[[nodiscard]] std::string value_in_range(double over, const Parameter& place);
/// "speed", "load", "run".
[[nodiscard]] const char* name_of_range(double over);

/// A loss by what rubs, or a reading of the output's torque.
[[nodiscard]] std::vector<double> kinds_of(bool reads);
/// True of what is in proportion to the load.
[[nodiscard]] bool is_beside_the_load(double what);
/// "a loss at the input", or whose reading it is.
[[nodiscard]] std::string subject_of(double what);
/// "0.2 (0.19 to 0.21) N m more", of a reading as the output reads it; `than` comes after "more".
[[nodiscard]] std::string more_of(const std::vector<Parameter>& figures, double what, double amount,
                                  const std::string& than = {});
/// Of a reading what the output reads, last of the figures.
void add_reading(const DriveContext& context, double what, double amount,
                 std::vector<Parameter>& figures);
/// That the sign is the same in both directions, where it is a reading and both were run.
[[nodiscard]] std::string same_sign(const DriveContext& context, double what);

}  // namespace trueflank::loop::drive_effects
