// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/flank_strips.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueflank {

std::vector<std::array<PatchNode, 3>> strips(int columns, int rows, bool falling,
                                             double column_step, double row_step) {
  // the ends of the diagonal whose column and row add up to d
  const auto right = [&](int d) { return PatchNode{std::min(d, columns), d - std::min(d, columns)}; };
  const auto left = [&](int d) { return PatchNode{d - std::min(d, rows), std::min(d, rows)}; };
  const auto span = [&](const PatchNode& p, const PatchNode& q) {
    return std::abs((p[0] - q[0]) * column_step + (p[1] - q[1]) * row_step);
  };
  std::vector<std::array<PatchNode, 3>> triangles;
  const auto add = [&](PatchNode a, PatchNode b, PatchNode c) {
    if (!falling) {
      for (PatchNode* node : {&a, &b, &c}) (*node)[0] = columns - (*node)[0];
      std::swap(b, c);
    }
    triangles.push_back({a, b, c});
  };
  for (int d = 0; d < columns + rows; ++d) {
    const PatchNode p = right(d), next_p = right(d + 1), q = left(d), next_q = left(d + 1);
    if (p == q) {
      add(p, next_p, next_q);
    } else if (next_p == next_q) {
      add(p, next_p, q);
    } else if (span(next_p, q) <= span(p, next_q)) {
      add(p, next_p, q);
      add(next_p, next_q, q);
    } else {
      add(p, next_p, next_q);
      add(p, next_q, q);
    }
  }
  return triangles;
}

}  // namespace trueflank
