// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/trace_evaluation.h"

#include <algorithm>
#include <cmath>

#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestValues = 8;

/// Length of trace a point stands for.
double share_of(const std::vector<TracePoint>& trace, std::size_t i) {
  const double before = i > 0 ? trace[i].at_mm - trace[i - 1].at_mm : 0.0;
  const double after = i + 1 < trace.size() ? trace[i + 1].at_mm - trace[i].at_mm : 0.0;
  return 0.5 * (before + after);
}

/// Least squares polynomial over -1 ... 1, every length of trace alike.
Eigen::VectorXd polynomial(const std::vector<TracePoint>& trace, double middle, double half, int degree) {
  const auto n = static_cast<Eigen::Index>(trace.size());
  Eigen::MatrixXd columns(n, degree + 1);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TracePoint& p = trace[static_cast<std::size_t>(i)];
    const double weight = std::sqrt(share_of(trace, static_cast<std::size_t>(i)));
    double power = weight;
    for (int k = 0; k <= degree; ++k, power *= (p.at_mm - middle) / half) columns(i, k) = power;
    values[i] = weight * p.deviation_um;
  }
  return least_squares(columns, values);
}

/// Mean under a Gaussian of unit scale about 0.
struct WeightedMean {
  double sum = 0.0, weight = 0.0;

  /// A course that runs straight from one value to the next: its integral, however long it is.
  void add_line(double from, double to, double value_from, double value_to) {
    if (!(to > from)) return;
    const double root = std::sqrt(kPi);
    const double own = 0.5 * (std::erf(root * to) - std::erf(root * from));
    const double moment =
        (std::exp(-kPi * from * from) - std::exp(-kPi * to * to)) / (2.0 * kPi);
    sum += value_from * own + (value_to - value_from) * (moment - from * own) / (to - from);
    weight += own;
  }
};

}  // namespace

double cut_off_mm(double length_mm) { return std::max(0.25, length_mm / 30.0); }

std::vector<TracePoint> gaussian_filtered(const std::vector<TracePoint>& trace, double cut_off_mm) {
  const double scale = std::sqrt(std::log(2.0) / kPi) * cut_off_mm;
  constexpr double kReach = 2.0;  // of the scale: beyond it lies less than 1e-6 of the weight
  std::vector<TracePoint> filtered = trace;
  std::size_t first = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    while (first + 1 < i && trace[i].at_mm - trace[first + 1].at_mm > kReach * scale) ++first;
    WeightedMean mean;
    for (std::size_t k = first; k + 1 < trace.size(); ++k) {
      const double from = (trace[k].at_mm - trace[i].at_mm) / scale;
      if (from > kReach) break;
      mean.add_line(from, (trace[k + 1].at_mm - trace[i].at_mm) / scale, trace[k].deviation_um,
                    trace[k + 1].deviation_um);
    }
    if (mean.weight > 0.0) filtered[i].deviation_um = mean.sum / mean.weight;
  }
  return filtered;
}

TraceFigures evaluate_trace(const std::vector<TracePoint>& trace, const EvaluationRange& range) {
  std::vector<TracePoint> inside;
  for (const TracePoint& p : trace)
    if (p.at_mm >= range.from_mm && p.at_mm <= range.to_mm) inside.push_back(p);
  if (inside.size() < kFewestValues) return {};
  const double middle = 0.5 * (range.from_mm + range.to_mm), half = 0.5 * (range.to_mm - range.from_mm);
  const Eigen::VectorXd line = polynomial(inside, middle, half, 1);
  const Eigen::VectorXd curve = polynomial(inside, middle, half, 2);
  double low = 1e300, high = -1e300, least = 1e300, most = -1e300;
  for (const TracePoint& p : trace) {
    if (p.at_mm < range.from_mm || p.at_mm > std::max(range.to_mm, range.excess_to_mm)) continue;
    const double off = p.deviation_um - line[0] - line[1] * (p.at_mm - middle) / half;
    high = std::max(high, off);
    most = std::max(most, p.deviation_um);
    if (p.at_mm > range.to_mm) continue;
    low = std::min(low, off);
    least = std::min(least, p.deviation_um);
  }
  return {2.0 * line[1], high - low, most - least, -curve[2]};
}

}  // namespace trueflank::loop
