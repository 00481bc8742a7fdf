// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/wave_spectrum.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

using Complex = std::complex<double>;

constexpr double kHighest = 14.0;  ///< of all orders
constexpr double kHighestWhole = 96.0;
constexpr double kMostLines = 3e5;
/// Rows times lines from which on the lines are summed by a transform.
constexpr double kMuch = 2e7;

/// The inverse Fourier transform, unscaled, of a power of two of places: what Eigen::FFT (kissfft)
/// gives, to the last bit, in half its time. What its stages read stands beside each other: their
/// factors and the values of the first parts. In one table it stands powers of two apart, for which
/// a cache has few lines.
class InverseTransform {
 public:
  explicit InverseTransform(std::size_t places) : places_(places) {
    const std::vector<Complex> factors = roots_of_one(places);
    for (std::size_t rest = places, apart = 1; rest > 1;) {
      Stage stage{.parts = rest % 4 == 0 ? 4U : 2U};
      stage.of_part = rest /= stage.parts;
      for (std::size_t k = 0; k < stage.of_part; ++k)
        for (std::size_t part = 1; part < stage.parts; ++part)
          stage.factors.push_back(factors[k * apart * part]);
      apart *= stage.parts;
      stages_.push_back(std::move(stage));
    }
  }

  [[nodiscard]] std::size_t places() const { return places_; }

  [[nodiscard]] std::vector<Complex> of(const std::vector<Complex>& values) const {
    constexpr std::size_t kPartsBeside = 16;
    std::size_t deep = 0, parts = 1;
    while (deep + 1 < stages_.size() && parts < kPartsBeside) parts *= stages_[deep++].parts;
    const std::size_t m = places_ / parts;
    std::vector<Complex> beside(places_), result(places_);
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t part = 0; part < parts; ++part)
        beside[part * m + k] = values[k * parts + part];
    transform_parts({beside.data(), deep, m}, 0, 0, 1, result.data());
    return result;
  }

 private:
  struct Stage {
    std::size_t parts = 0, of_part = 0;
    std::vector<Complex> factors;  ///< of each place; not of the first part, whose is 1
  };
  /// Values of the parts that the first stages leave, each beside itself.
  struct Parts {
    const Complex* values = nullptr;
    std::size_t stages = 0, of_one = 0;
  };

  /// By sines and cosines of less than an eighth of a turn.
  static std::vector<Complex> roots_of_one(std::size_t count) {
    const int n = static_cast<int>(count);
    const double eighth = 0.25 * kPi / n;
    std::vector<Complex> roots(count);
    const auto put = [&](int i, double c, double s) {
      roots[static_cast<std::size_t>(i)] = {c, s};
      roots[static_cast<std::size_t>(n - i)] = {c, -s};
    };
    roots[0] = {1.0, 0.0};
    roots[count / 2] = {-1.0, 0.0};
    int i = 1;
    for (; i * 8 < n; ++i) put(i, std::cos(i * 8 * eighth), std::sin(i * 8 * eighth));
    for (; i * 4 < n; ++i)
      put(i, std::sin((2 * n - 8 * i) * eighth), std::cos((2 * n - 8 * i) * eighth));
    for (; i * 8 < 3 * n; ++i)
      put(i, -std::sin((8 * i - 2 * n) * eighth), std::cos((8 * i - 2 * n) * eighth));
    for (; i * 2 < n; ++i)
      put(i, -std::cos((4 * n - 8 * i) * eighth), std::sin((4 * n - 8 * i) * eighth));
    return roots;
  }

  /// Without the case of products that are no numbers, for which the operator looks.
  static Complex product(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  /// Of every `apart`-th part from the first on.
  void transform_parts(const Parts& parts, std::size_t at, std::size_t first, std::size_t apart,
                       Complex* to) const {
    if (at == parts.stages) return transform(at, parts.values + first * parts.of_one, 1, to);
    const Stage& stage = stages_[at];
    for (std::size_t part = 0; part < stage.parts; ++part)
      transform_parts(parts, at + 1, first + part * apart, apart * stage.parts,
                      to + part * stage.of_part);
    join(stage, to);
  }

  /// Of every `apart`-th value.
  void transform(std::size_t at, const Complex* values, std::size_t apart, Complex* to) const {
    const Stage& stage = stages_[at];
    for (std::size_t part = 0; part < stage.parts; ++part) {
      if (stage.of_part > 1)
        transform(at + 1, values + part * apart, apart * stage.parts, to + part * stage.of_part);
      else
        to[part] = values[part * apart];
    }
    join(stage, to);
  }

  static void join(const Stage& stage, Complex* to) {
    const std::size_t m = stage.of_part;
    const Complex* factor = stage.factors.data();
    if (stage.parts == 2) {
      for (std::size_t k = 0; k < m; ++k) {
        const Complex one = product(to[m + k], factor[k]);
        to[m + k] = to[k] - one;
        to[k] += one;
      }
      return;
    }
    for (std::size_t k = 0; k < m; ++k, factor += 3) {
      const Complex one = product(to[k + m], factor[0]), two = product(to[k + 2 * m], factor[1]),
                    three = product(to[k + 3 * m], factor[2]);
      const Complex even = to[k] + two, odd = to[k] - two, sum = one + three, off = one - three;
      const Complex turned{-off.imag(), off.real()};
      to[k] = even + sum;
      to[k + m] = odd + turned;
      to[k + 2 * m] = even - sum;
      to[k + 3 * m] = odd - turned;
    }
  }

  std::size_t places_ = 0;
  std::vector<Stage> stages_;
};

/// A grid twice as fine as so many lines, and the next power of two.
std::size_t grid_of(int lines) {
  std::size_t half = 16;
  while (half < static_cast<std::size_t>(lines)) half *= 2;
  return 2 * half;
}

std::vector<Complex> line_sums_by(const InverseTransform& transform,
                                  const std::vector<double>& angle_rad,
                                  const std::vector<double>& size, double first, double step,
                                  int lines) {
  // The Gaussian falls to 1e-12 over so many places of a grid twice as fine as the lines.
  constexpr int kReach = 12;
  const int grid = static_cast<int>(transform.places()), half = grid / 2;
  const double n = half, spread = kPi * kReach / (n * n * 3.0);
  const double place = kTwoPi / grid, middle = 0.5 * n;
  std::vector<Complex> spread_out(static_cast<std::size_t>(grid));
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
  const std::vector<Complex> sums = transform.of(spread_out);
  std::vector<Complex> result(static_cast<std::size_t>(lines));
  for (int k = 0; k < lines; ++k) {
    const double off = k - middle;
    result[static_cast<std::size_t>(k)] =
        sums[static_cast<std::size_t>((k - half / 2 + grid) % grid)] *
        (std::sqrt(kPi / spread) * std::exp(off * off * spread) / grid);
  }
  return result;
}

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
    if (!transform_) transform_ = std::make_unique<const InverseTransform>(grid_of(lines));
    const std::vector<Complex> of_size =
        line_sums_by(*transform_, angle_, size_, first_, step_, lines);
    // The sums of squares are waves of twice the order; the directions' signs are not in them.
    if (!opposite_)
      of_one_ = line_sums_by(*transform_, angle_, square_, 2.0 * first_, 2.0 * step_, lines);
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
  std::unique_ptr<const InverseTransform> transform_;  ///< for all lines at once
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
  return line_sums_by(InverseTransform(grid_of(lines)), angle_rad, size, first, step, lines);
}

}  // namespace trueflank::loop
