// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/observations.h"
#include "trueflank/loop/measured/measurement.h"

// The order in which measured values stand says nothing of the gear, but the hold-out, the flips of
// signs and every sum follow it. So values stand in an order that is theirs, and not their files'.
namespace trueflank::loop {

/// Puts files, and the processes that they name, into an order that their parts and contents decide.
void put_files_in_order(MeasuredData& data);

/// Puts the rows behind those of scans into an order that their values decide: records by kind,
/// tooth and flank, values by their place. Zeros and sources are numbered in that order, of each
/// kind by itself: it is the same whether records come in one file or in several. Places stay.
/// Returns where each of these rows went, the first behind the scans first.
std::vector<std::size_t> put_rows_in_order(Observations& table);

}  // namespace trueflank::loop
