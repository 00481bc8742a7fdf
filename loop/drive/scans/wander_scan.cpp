// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/scans/wander_scan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/drive/effects/columns.h"

namespace trueflank::loop {
namespace {

constexpr int kFew = 4, kMany = 8;      ///< half waves that are called slow, and of a long run
constexpr int kPlain = 5, kCurved = 7;  ///< degrees of the polynomial for a short run and others
constexpr int kBeside = 24;             ///< faster half waves that they are compared with
constexpr int kLongRun = 96, kShortRun = 48, kShortest = 24;  ///< units

/// Squares that the constant and each half wave take off what is left beside all slower ones, in
/// the noise's units.
Eigen::VectorXd squares_of_half_waves(const DriveContext& context, const Eigen::VectorXd& left,
                                      double what, int waves) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(waves + 1, waves + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(waves + 1), column(waves + 1);
  const auto& points = context.table.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BenchPoint& p = points[i];
    if (p.fold == 0) continue;
    const double changed = drive_effects::changed_nm(context, p, what) / p.sigma_nm;
    for (int k = 0; k <= waves; ++k) column[k] = changed * std::cos(kPi * k * p.taken);
    gram.selfadjointView<Eigen::Lower>().rankUpdate(column);
    right += left[static_cast<Eigen::Index>(i)] / p.sigma_nm * column;
  }
  // With unit diagonal; a wave that the slower ones hold already takes nothing off.
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd unit = scale.asDiagonal() * gram * scale.asDiagonal();
  unit.diagonal().array() += 1e-9;
  const Eigen::LLT<Eigen::MatrixXd> factor(unit);
  const Eigen::VectorXd scaled = scale.asDiagonal() * right;
  return factor.matrixL().solve(scaled).array().square();
}

}  // namespace

LikeliestWander likeliest_wander(const DriveContext& context, const Eigen::VectorXd& left) {
  LikeliestWander best;
  const int units = context.table.units;
  if (units < kShortest || !drive_effects::has_one_course(context)) return best;
  const int most = units < kLongRun ? kFew : kMany;
  const int waves = std::min(most + kBeside, units / 2);
  double looks = 0.0;
  for (const double what :
       {drive_effects::kFlanks, drive_effects::kDrag, drive_effects::kOutputReads}) {
    const Eigen::VectorXd squares = squares_of_half_waves(context, left, what, waves);
    const double beside = squares.tail(waves - most).mean();
    if (!(beside > 0.0)) continue;
    for (int slow = kFew; slow <= most; slow += kFew) {
      ++looks;
      const double p = f_tail(squares.segment(1, slow).mean() / beside, slow, waves - most);
      if (p < best.p_value)
        best = {.p_value = p, .what = what, .degree = units < kShortRun ? kPlain : kCurved};
    }
  }
  best.p_value = std::min(1.0, best.p_value * looks);
  return best;
}

}  // namespace trueflank::loop
