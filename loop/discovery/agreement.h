// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/discovery/projected_candidates.h"

namespace trueflank::loop {

/// Whether few traces or flanks agree on a group: p of an F test, uncorrected, for each group; 1 where
/// it does not live in 4 ... 24 whole traces; empty where there are no so few. Every trace says by itself
/// how much of the group it holds; what they have in common is compared with how they scatter. Of traces
/// that scatter is helped by what they show about their own courses, as much as four more traces would: a
/// slope of three traces alone has two degrees of freedom.
/// What a trace says of a group is taken to be normal; errors within it may hang together.
/// Asks the sums over units and wholes alone, no value again.
/// Requires: `projected`, the groups' Gram matrices beside what is fitted. Panels that `beside` was not asked
/// about have 1.
/// Accuracy: false alarms in tests/loop/few_traces_test.cpp; docs/decisions/0134-few-traces.md.
[[nodiscard]] std::vector<double> agreement_of_wholes(const DiscoveryProblem& problem,
                                                      const BlockStatistics& statistics,
                                                      const ProjectedCandidates& beside,
                                                      const std::vector<Eigen::MatrixXd>& projected,
                                                      const std::vector<bool>& observable);

/// Variance that slow candidates meet in a trace; 0 where there are no traces of enough values. Does not
/// depend on the model: BlockStatistics keeps it.
[[nodiscard]] double scatter_within(const DiscoveryProblem& problem,
                                    const BlockStatistics& statistics);

}  // namespace trueflank::loop
