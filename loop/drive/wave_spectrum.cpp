// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/wave_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace wave_spectra {

using Complex = std::complex<double>;

constexpr double kHighest = 14.0;  ///< of all orders
constexpr double kHighestWhole = 96.0;
constexpr double kMostLines = 3e5;
/// Rows times lines from which on the lines are summed by a transform.
constexpr double kMuch = 2e7;

/// Lines at equal steps of the order.
struct Lines {
  double first = 0.0, step = 0.0;
  int count = 0;
  bool operator==(const Lines&) const = default;
};

/// Every row is spread by a Gaussian on a grid of twice the lines; the grid's fast Fourier
/// transform is the wanted sum times the Gaussian's own transform, which is divided out.
class LineSums {
 public:
  LineSums() { transform_.SetFlag(Eigen::FFT<double>::Unscaled); }
  std::vector<Complex> of(const std::vector<double>& angle_rad, const std::vector<double>& size,
                          const Lines& lines) {
    // The Gaussian falls to 1e-12 over so many places of a grid twice as fine as the lines.
    constexpr int kReach = 12;
    const int half = length_from(lines.count), grid = 2 * half;
    const double n = half, spread = kPi * kReach / (n * n * 3.0);
    const double place = kTwoPi / grid, middle = 0.5 * n;
    spread_out_.assign(static_cast<std::size_t>(grid), Complex());
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      const double turned = lines.step * angle_rad[i] / kTwoPi;
      const double x = kTwoPi * (turned - std::floor(turned));
      const Complex value = size[i] * std::polar(1.0, lines.first * angle_rad[i] + middle * x);
      const int nearest = static_cast<int>(x / place);
      for (int j = nearest - kReach + 1; j <= nearest + kReach; ++j) {
        const double off = x - j * place;
        spread_out_[static_cast<std::size_t>((j + grid) % grid)] +=
            value * std::exp(-off * off / (4.0 * spread));
      }
    }
    transform_.inv(sums_, spread_out_);
    std::vector<Complex> result(static_cast<std::size_t>(lines.count));
    for (int k = 0; k < lines.count; ++k) {
      const double off = k - middle;
      result[static_cast<std::size_t>(k)] =
          sums_[static_cast<std::size_t>((k - half / 2 + grid) % grid)] *
          (std::sqrt(kPi / spread) * std::exp(off * off * spread) / grid);
    }
    return result;
  }

 private:
  /// The least multiple of 16 from this on without prime factors but 2, 3 and 5: the transform goes
  /// by them.
  static int length_from(int lines) {
    const auto is_smooth = [](int n) {
      for (const int factor : {2, 3, 5})
        while (n % factor == 0) n /= factor;
      return n == 1;
    };
    int sixteenth = std::max(1, (lines + 15) / 16);
    while (!is_smooth(sixteenth)) ++sixteenth;
    return 16 * sixteenth;
  }

  /// Keeps the factors of its length.
  Eigen::FFT<double> transform_;
  std::vector<Complex> spread_out_, sums_;
};

/// What a spectrum is asked of: rows that count.
struct SpectrumRows {
  std::vector<double> angle_rad, left, load;
  std::vector<bool> forward;
  double turns = 0.0;
  bool both = false;  ///< directions
  bool operator==(const SpectrumRows&) const = default;
};

SpectrumRows rows_of_spectrum(const BenchTable& table, const Eigen::VectorXd& left) {
  SpectrumRows rows{.turns = table.turns, .both = table.has(true) && table.has(false)};
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const BenchPoint& p = table.points[i];
    if (p.fold == 0) continue;
    rows.angle_rad.push_back(p.angle_rad);
    rows.left.push_back(left[static_cast<Eigen::Index>(i)] / p.sigma_nm);
    rows.forward.push_back(p.forward);
    rows.load.push_back(p.load_nm / table.most_load_nm);
  }
  return rows;
}

/// Line sums of the squares of weights that rows have, without the load and with it: they hang on
/// what was run, not on what is left.
struct SumsOfSquares {
  std::vector<double> angle_rad, square;
  Lines lines;
  std::vector<Complex> sums;
};

class Spectrum {
 public:
  Spectrum(const SpectrumRows& rows, LineSums& line_sums, std::array<SumsOfSquares, 2>& squares)
      : turns_(rows.turns),
        wrapped_(turns_ <= 1.01),
        angle_(rows.angle_rad),
        left_(rows.left),
        load_(rows.load),
        forward_(rows.forward),
        line_sums_(line_sums),
        squares_(squares),
        both_(rows.both) {
    for (const double one : left_) sum_ += one * one;
    rows_ = static_cast<double>(angle_.size());
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
    const std::vector<Complex> of_size = line_sums_.of(angle_, size_, {first_, step_, lines});
    // The sums of squares are waves of twice the order; the directions' signs are not in them.
    const std::vector<Complex>& of_one = of_squares({2.0 * first_, 2.0 * step_, lines});
    for (int k = 0; k < lines; ++k) {
      const auto at = static_cast<std::size_t>(k);
      judge(first_ + step_ * k, of_size[at].real(), of_size[at].imag(),
            0.5 * (weights_ + of_one[at].real()), 0.5 * of_one[at].imag());
    }
  }

  const std::vector<Complex>& of_squares(const Lines& lines) {
    SumsOfSquares& known = squares_[with_load_ ? 1 : 0];
    if (known.lines != lines || known.angle_rad != angle_ || known.square != square_)
      known = {angle_, square_, lines, line_sums_.of(angle_, square_, lines)};
    return known.sums;
  }

  const double turns_;
  const bool wrapped_;
  const std::vector<double>&angle_, &left_, &load_;
  const std::vector<bool>& forward_;
  LineSums& line_sums_;
  std::array<SumsOfSquares, 2>& squares_;
  std::vector<double> size_, square_;
  double sum_ = 0.0, rows_ = 0.0, weights_ = 0.0, step_ = 1.0, first_ = 1.0, highest_ = 0.0;
  const bool both_;
  bool opposite_ = false, with_load_ = false;
  int lines_ = 0, tried_ = 0;
  LikeliestOrder best_;
};

}  // namespace wave_spectra

struct WaveSpectra::Kept {
  struct Answer {
    wave_spectra::SpectrumRows rows;
    LikeliestOrder order;
  };
  wave_spectra::LineSums line_sums;
  std::array<wave_spectra::SumsOfSquares, 2> squares;
  std::deque<Answer> answers;
};

WaveSpectra::WaveSpectra() : kept_(std::make_unique<Kept>()) {}
WaveSpectra::~WaveSpectra() = default;

LikeliestOrder WaveSpectra::likeliest_order(const BenchTable& table, const Eigen::VectorXd& left) {
  constexpr std::size_t kMostKept = 4;
  if (!table.has_angle || table.turns < 0.9) return {};
  wave_spectra::SpectrumRows rows = wave_spectra::rows_of_spectrum(table, left);
  for (const Kept::Answer& known : kept_->answers)
    if (known.rows == rows) return known.order;
  const LikeliestOrder found =
      wave_spectra::Spectrum(rows, kept_->line_sums, kept_->squares).highest();
  if (kept_->answers.size() == kMostKept) kept_->answers.pop_front();
  kept_->answers.push_back({std::move(rows), found});
  return found;
}

WaveAmounts WaveProducts::solved(double least_determinant) const {
  const double determinant = cos_cos * sin_sin - cos_sin * cos_sin;
  if (!(determinant > least_determinant)) return {};
  const double cos = (sin_sin * cos_left - cos_sin * sin_left) / determinant,
               sin = (cos_cos * sin_left - cos_sin * cos_left) / determinant;
  return {cos, sin, cos * cos_left + sin * sin_left};
}

std::vector<std::complex<double>> line_sums(const std::vector<double>& angle_rad,
                                            const std::vector<double>& size, double first,
                                            double step, int lines) {
  return wave_spectra::LineSums().of(angle_rad, size, {first, step, lines});
}

}  // namespace trueflank::loop
