// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "trueflank/search/search_optimise.h"

// Which tooth sets, or pairs of stages, are listed. By one objective the best; by several those
// that have a design which fewer than so many others beat in every objective: the same where there
// is one, and the Pareto front first where there are several.
namespace trueflank {

/// What a design is worth in each objective, or at most; larger is better.
using Merits = std::vector<double>;

[[nodiscard]] Merits merits_of(const SearchCandidate& candidate,
                               const std::vector<SearchObjective>& objectives);

/// At least as good in every objective and better in one.
[[nodiscard]] bool dominates(const Merits& p, const Merits& q);

/// What is known of those that can be listed. What it excludes stays excluded, whatever is added
/// later and in whatever order.
class Listing {
 public:
  /// Of `listed` sets, 0: all. Where one objective ranks, none below `better_than`; NaN: any.
  explicit Listing(std::size_t listed, double better_than = kNaN);

  /// The designs of one set; none where it has none.
  void add(std::vector<Merits> designs);

  /// Whether no design of these merits, or of merits no better, is listed.
  [[nodiscard]] bool excludes(const Merits& merits) const;

  /// Whether as many sets with designs are known as are listed.
  [[nodiscard]] bool is_full() const { return listed_ > 0 && known_ >= listed_; }
  /// Whether a set would be listed for having a design at all.
  [[nodiscard]] bool wants_any() const { return !is_full() && better_than_ != better_than_; }
  /// Of one objective: the merit of the last one listed, as far as is known.
  [[nodiscard]] double least() const;

 private:
  std::size_t listed_, known_ = 0;
  double better_than_;
  std::multiset<double> best_;             ///< of one objective
  std::vector<std::vector<Merits>> sets_;  ///< of several: each set's designs
};

}  // namespace trueflank
