// SPDX-License-Identifier: GPL-3.0-or-later
// Steps with an edge, as residuals in cells look like most: the same on every tooth, beside levels,
// and beside slopes and bows.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop::product_cells {
namespace {

constexpr Eigen::Index kCells = kProductCells;
using InCells = Eigen::Matrix<double, kCells, 1>;

/// Middles of the cells, 0 to 1.
InCells places() {
  return (InCells::LinSpaced(0.0, kCells - 1.0).array() + 0.5) / static_cast<double>(kCells);
}

/// Flanks of all teeth together along one direction, as a form acts on them, and what polynomials
/// of low degrees leave of courses there.
class FlanksAlike {
 public:
  FlanksAlike(const OfTeeth& teeth, double face, const FlankWay& way) {
    for (const auto& tooth : teeth)
      for (const std::size_t side : {0U, 1U}) {
        const Along& along = face != 0.0 ? tooth[side].face : tooth[side].profile;
        const double sign = way.signs[side];
        for (std::size_t i = 0; i < kProductCells; ++i) {
          weight_[static_cast<Eigen::Index>(i)] += sign * sign * along[i].weight;
          value_[static_cast<Eigen::Index>(i)] += sign * along[i].value;
        }
      }
  }
  /// A step's square, what is left of it beside polynomials of fewer degrees than this, and what it
  /// takes out then.
  struct Taken {
    double square = 0.0, left = 0.0, gain = 0.0;
  };
  [[nodiscard]] Taken taken_by(const InCells& course, int degrees) const {
    const InCells rest = beside(course, degrees);
    const double left = rest.dot(weight_.cwiseProduct(rest)), product = rest.dot(value_);
    return {course.dot(weight_.cwiseProduct(course)), left,
            left > 0.0 ? product * product / left : 0.0};
  }

 private:
  [[nodiscard]] InCells beside(const InCells& course, int degrees) const {
    Eigen::MatrixXd all(kCells, degrees);
    for (int degree = 0; degree < degrees; ++degree)
      all.col(degree) = (2.0 * places().array() - 1.0).pow(degree);
    const Eigen::MatrixXd weighted = weight_.asDiagonal() * all;
    Eigen::MatrixXd normal = all.transpose() * weighted;
    normal.diagonal().array() += 1e-9 * normal.trace();
    return course - all * symmetric_solution(normal, weighted.transpose() * course);
  }

  InCells weight_ = InCells::Zero(), value_ = InCells::Zero();
};

}  // namespace

std::vector<LikelyForms> likeliest_steps(const FlankGeometry& g, const OfTeeth& teeth, double face,
                                         bool beside_names) {
  constexpr double kNearestEnd = 0.06;
  constexpr double kAnything = 1e-3;                 // of a step's square
  constexpr std::array kEdges{0.0, 0.05, 0.1, 0.2};  // of the range
  const int degrees = beside_names ? 3 : 1;
  const double range = std::abs(gear_effects::range_mm(g, face));
  const InCells at = places();
  std::vector<LikelyForms> lists;
  double most = 0.0;
  for (const FlankWay& way : flank_ways(g)) {
    const FlanksAlike flanks(teeth, face, way);
    LikelyForms list;
    for (const double edge : kEdges) {
      Likely best;
      for (int place = 1; place < 2 * kProductCells; ++place) {
        const double share = 0.5 * place / kProductCells;
        const double place_mm = gear_effects::place_at(g, face, share);
        if (share < kNearestEnd || share > 1.0 - kNearestEnd ||
            !gear_effects::is_step_with_edge(g, face, place_mm, edge * range))
          continue;
        InCells course;
        for (Eigen::Index i = 0; i < kCells; ++i)
          course[i] = gear_effects::beyond_edge(at[i] - share, edge);
        const auto taken = flanks.taken_by(course, degrees);
        if (!(taken.left > kAnything * taken.square) || !(taken.gain > best.gain)) continue;
        best = {taken.gain,
                {find_family("unnamed_step"),
                 way.flank,
                 {face, place_mm, way.opposite ? 1.0 : 0.0, edge * range}}};
      }
      if (best.form.family == nullptr) continue;
      list.gain = std::max(list.gain, best.gain);
      list.forms.push_back(std::move(best.form));
    }
    if (list.forms.empty()) continue;
    most = std::max(most, list.gain);
    lists.push_back(std::move(list));
  }
  std::erase_if(lists, [&](const LikelyForms& list) { return list.gain < kNearly * most; });
  return lists;
}

}  // namespace trueflank::loop::product_cells
