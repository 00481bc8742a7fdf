// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/wave_spectrum.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

using Complex = std::complex<double>;

constexpr double kHighest = 14.0;  ///< of all orders
constexpr double kHighestWhole = 96.0;
constexpr double kMostLines = 3e5;
/// Rows times lines from which on the lines are summed by a transform.
constexpr double kMuch = 2e7;

class Spectrum {
 public:
  Spectrum(const DriveContext& context, const Eigen::VectorXd& left)
      : turns_(context.table.turns), wrapped_(turns_ <= 1.01) {
    const BenchTable& table = context.table;
    for (std::size_t i = 0; i < table.points.size(); ++i) {
      const BenchPoint& p = table.points[i];
      if (p.fold == 0) continue;
      angle_.push_back(p.angle_rad);
      left_.push_back(left[static_cast<Eigen::Index>(i)] / p.sigma_nm);
      forward_.push_back(p.forward);
      load_.push_back(p.load_nm / table.most_load_nm);
      sum_ += left_.back() * left_.back();
    }
    rows_ = static_cast<double>(angle_.size());
    both_ = table.has(true) && table.has(false);
    step_ = wrapped_ ? 1.0 : std::max(0.25 / turns_, kHighest / kMostLines);
    first_ = wrapped_ ? 1.0 : std::max(step_, 1.5 / turns_);
  }

  LikeliestOrder highest() {
    if (rows_ < 12.0 || !(sum_ > 0.0)) return best_;
    for (const bool with_load : {false, true})
      for (const bool opposite : {false, true})
        if (both_ || !opposite) look_at(opposite, with_load);
    // Every line tried could have been the highest.
    const double single = std::pow(std::max(0.0, 1.0 - highest_ / sum_), 0.5 * (rows_ - 3.0));
    best_.p_value = std::min(1.0, single * tried_);
    return best_;
  }

 private:
  /// One spectrum: of what is left with this weight of every row.
  void look_at(bool opposite, bool with_load) {
    opposite_ = opposite;
    with_load_ = with_load;
    size_.clear();
    square_.clear();
    weights_ = 0.0;
    lines_ = 0;
    for (std::size_t i = 0; i < angle_.size(); ++i) {
      const double weight = (with_load ? load_[i] : 1.0) * (opposite && !forward_[i] ? -1.0 : 1.0);
      size_.push_back(weight * left_[i]);
      square_.push_back(weight * weight);
      weights_ += square_.back();
    }
    if (rows_ * (kHighest - first_) / step_ > kMuch) all_lines_at_once();
    else
      all_lines();
    // Poles, slots and teeth of the input's shaft: whole orders beyond.
    for (double order = std::floor(kHighest) + 1.0; order <= kHighestWhole; order += 1.0)
      judge_alone(order);
    tried_ += lines_;
    if (best_.opposite != opposite || best_.with_load != with_load) return;
    // Between the lines: over the whole run a wave of the nearest one falls out of step.
    for (double off = 0.5 * step_; !wrapped_ && best_.order <= kHighest && off * turns_ > 1e-3; off *= 0.5) {
      const double middle = best_.order;
      judge_alone(middle - off);
      judge_alone(middle + off);
    }
  }

  void judge(double order, double c, double s, double cc, double cs) {
    ++lines_;
    const double ss = weights_ - cc, determinant = cc * ss - cs * cs;
    if (!(determinant > 1e-3 * weights_ * weights_)) return;
    const double power = (c * c * ss - 2.0 * c * s * cs + s * s * cc) / determinant;
    if (power <= highest_) return;
    highest_ = power;
    best_ = {.order = order, .opposite = opposite_, .with_load = with_load_};
  }

  void judge_alone(double order) {
    double c = 0.0, s = 0.0, cc = 0.0, cs = 0.0;
    for (std::size_t i = 0; i < angle_.size(); ++i) {
      const double x = std::cos(order * angle_[i]), y = std::sin(order * angle_[i]);
      c += size_[i] * x;
      s += size_[i] * y;
      cc += square_[i] * x * x;
      cs += square_[i] * x * y;
    }
    judge(order, c, s, cc, cs);
  }

  /// Every row's phase is turned on by one step of the order a line.
  void all_lines() {
    std::vector<Complex> phase, turn;
    for (const double a : angle_) {
      phase.push_back(std::polar(1.0, first_ * a));
      turn.push_back(std::polar(1.0, step_ * a));
    }
    for (double order = first_; order <= kHighest; order = first_ + step_ * lines_) {
      double c = 0.0, s = 0.0, cc = 0.0, cs = 0.0;
      for (std::size_t i = 0; i < angle_.size(); ++i) {
        const double x = phase[i].real(), y = phase[i].imag();
        c += size_[i] * x;
        s += size_[i] * y;
        cc += square_[i] * x * x;
        cs += square_[i] * x * y;
        const double u = turn[i].real(), v = turn[i].imag();
        phase[i] = {x * u - y * v, x * v + y * u};
      }
      judge(order, c, s, cc, cs);
    }
  }

  void all_lines_at_once() {
    const int lines = static_cast<int>((kHighest - first_) / step_) + 1;
    const std::vector<Complex> of_size = line_sums(angle_, size_, first_, step_, lines);
    // The sums of squares are waves of twice the order; the directions' signs are not in them.
    if (!opposite_) of_one_ = line_sums(angle_, square_, 2.0 * first_, 2.0 * step_, lines);
    for (int k = 0; k < lines; ++k) {
      const auto at = static_cast<std::size_t>(k);
      judge(first_ + step_ * k, of_size[at].real(), of_size[at].imag(),
            0.5 * (weights_ + of_one_[at].real()), 0.5 * of_one_[at].imag());
    }
  }

  const double turns_;
  const bool wrapped_;
  std::vector<double> angle_, left_, load_, size_, square_;
  std::vector<Complex> of_one_;  ///< line sums of the squares, with the load or without
  std::vector<bool> forward_;
  double sum_ = 0.0, rows_ = 0.0, weights_ = 0.0, step_ = 1.0, first_ = 1.0, highest_ = 0.0;
  bool both_ = false, opposite_ = false, with_load_ = false;
  int lines_ = 0, tried_ = 0;
  LikeliestOrder best_;
};

}  // namespace

LikeliestOrder likeliest_order(const DriveContext& context, const Eigen::VectorXd& left) {
  if (!context.table.has_angle || context.table.turns < 0.9) return {};
  return Spectrum(context, left).highest();
}

std::vector<Complex> line_sums(const std::vector<double>& angle_rad, const std::vector<double>& size,
                               double first, double step, int lines) {
  // The Gaussian falls to 1e-12 over so many places of a grid twice as fine as the lines.
  constexpr int kReach = 12;
  int half = 16;
  while (half < lines) half *= 2;
  const int grid = 2 * half;
  const double n = half, spread = kPi * kReach / (n * n * 3.0);
  const double place = kTwoPi / grid, middle = 0.5 * n;
  std::vector<Complex> spread_out(static_cast<std::size_t>(grid)), sums;
  for (std::size_t i = 0; i < angle_rad.size(); ++i) {
    const double turned = step * angle_rad[i] / kTwoPi;
    const double x = kTwoPi * (turned - std::floor(turned));
    const Complex value = size[i] * std::polar(1.0, first * angle_rad[i] + middle * x);
    const int nearest = static_cast<int>(x / place);
    for (int j = nearest - kReach + 1; j <= nearest + kReach; ++j) {
      const double off = x - j * place;
      spread_out[static_cast<std::size_t>((j + grid) % grid)] +=
          value * std::exp(-off * off / (4.0 * spread));
    }
  }
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::Unscaled);
  transform.inv(sums, spread_out);
  std::vector<Complex> result(static_cast<std::size_t>(lines));
  for (int k = 0; k < lines; ++k) {
    const double off = k - middle;
    result[static_cast<std::size_t>(k)] = sums[static_cast<std::size_t>((k - half / 2 + grid) % grid)] *
                                          (std::sqrt(kPi / spread) * std::exp(off * off * spread) / grid);
  }
  return result;
}

}  // namespace trueflank::loop
