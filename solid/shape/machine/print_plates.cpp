// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/machine/print_plates.h"

#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

double reach_mm(const PartShape& part) {
  double reach = 0.0;
  for (const Slab& slab : part.slabs) {
    const OutlineExtent outer = extent(slab.outer);
    reach = std::max(reach, outer.centre.norm() + outer.outer_radius_mm);
  }
  return reach;
}

struct Square {
  int part = 0;
  double side_mm = 0.0;
};

/// Fills beds row by row.
class Rows {
 public:
  Rows(const Bed& bed, double gap_mm) : bed_(bed), gap_mm_(gap_mm) {}

  void put(const Square& square) {
    if (plates_.empty()) plates_.emplace_back();
    if (x_ + square.side_mm > bed_.width_mm) {
      y_ += row_;
      x_ = row_ = 0.0;
    }
    if (y_ + square.side_mm > bed_.depth_mm) {
      plates_.emplace_back();
      x_ = y_ = row_ = 0.0;
    }
    plates_.back().push_back({square.part, {x_ + 0.5 * square.side_mm, y_ + 0.5 * square.side_mm}});
    x_ += square.side_mm + gap_mm_;
    row_ = std::max(row_, square.side_mm + gap_mm_);
  }
  std::vector<PrintPlate> take() { return std::move(plates_); }

 private:
  const Bed& bed_;
  double gap_mm_;
  double x_ = 0.0, y_ = 0.0, row_ = 0.0;
  std::vector<PrintPlate> plates_;
};

}  // namespace

Result<std::vector<PrintPlate>> print_plates(const PartShapes& shapes, const Bed& bed,
                                             double gap_mm) {
  std::vector<Square> squares;
  for (const Placement& body : shapes.assembly) {
    const PartShape& part = shapes.parts[static_cast<std::size_t>(body.part)];
    if (!part.bought.empty()) continue;
    const double side = 2.0 * reach_mm(part);
    if (side > std::min(bed.width_mm, bed.depth_mm))
      return fail({.code = ErrorCode::kInfeasible,
                   .message = part.name + " is wider than the bed " + bed.name,
                   .key = "made.bed",
                   .remedy = "a bed of " + std::to_string(static_cast<int>(std::ceil(side))) +
                             " mm at least, or no bed"});
    squares.push_back({body.part, side});
  }
  std::stable_sort(squares.begin(), squares.end(),
                   [](const Square& a, const Square& b) { return a.side_mm > b.side_mm; });
  Rows rows(bed, gap_mm);
  for (const Square& square : squares) rows.put(square);
  return rows.take();
}

}  // namespace trueflank
