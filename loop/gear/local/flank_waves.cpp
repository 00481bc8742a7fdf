// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/flank_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "trueflank/base/many_sines.h"
#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/marching_leads.h"
#include "trueflank/loop/gear/local/own_waves.h"
#include "trueflank/loop/gear/local/wave_products.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {
namespace flank_waves {
namespace {

constexpr std::size_t kMostOfSpectrum = 40000;
constexpr int kFewestTeeth = 8;

class Spectrum {
 public:
  Spectrum(const FlankGeometry& geometry, const Observations& table,
           const std::vector<float>& row_um, const std::vector<bool>& used, ObservationKind kind)
      : teeth_(geometry.teeth()), kind_(kind), flanks_(2 * static_cast<std::size_t>(teeth_)) {
    gather(geometry, table, row_um, used);
    for (std::size_t f = 0; f < flanks_.size(); ++f)
      if (flanks_[f].count >= kFewestValues) ++known_;
  }

  FlankSpectrum run() {
    if (known_ < 2 * kFewestTeeth) return {};
    look_at_all();
    return {largest_wave(), apart(), forms_apart(),
            own_waves(flanks_, values_, {most_profile_, most_face_})};
  }

  /// Over the face alone, at most one of either side. Where few teeth have a trace one order looks
  /// like others.
  std::vector<FlankWaves> waves_of_leads() {
    constexpr double kMostTeeth = 0.7, kClearly = 0.1, kLevel = 1e-4;
    // Forms that hang on the tooth rise towards long waves, and are told as such.
    constexpr int kFewestOfLeads = 5;
    if (known_ < std::max(2.0 * kFewestTeeth, kMostTeeth * 2.0 * teeth_)) return {};
    orders_ = 2 * teeth_;
    fewest_ = kFewestOfLeads;
    look_at_all();
    std::vector<FlankWaves> found;
    const std::vector<Judged> waves = judged_waves();
    for (const int side : {1, -1}) {
      // A large wave shows at other lengths, too, and may stand out more there.
      const Judged* best = nullptr;
      for (const Judged& one : waves)
        if (one.wave.side == side && one.wave.p_value <= kLevel &&
            (best == nullptr || one.power > best->power))
          best = &one;
      if (best == nullptr) continue;
      FlankWaves wave = best->wave;
      sharpen(wave);
      if (0.5 * wave.amplitude_um * wave.amplitude_um >= kClearly * mean_square(side))
        found.push_back(wave);
    }
    return found;
  }

 private:
  using Flank = FlankSums;
  void look_at_all() {
    most_profile_ = kind_ == ObservationKind::kHelix ? 0 : most_waves(&Value::u, kProfile);
    most_face_ = most_waves(&Value::v, kFace);
    take_means_off();
    transform();
  }
  Flank& flank_of(const Value& value) {
    return flanks_[static_cast<std::size_t>(2 * (value.tooth - 1) + value.side)];
  }

  void gather(const FlankGeometry& geometry, const Observations& table,
              const std::vector<float>& row_um, const std::vector<bool>& used) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i)
      count += used[i] && table.rows[i].kind == kind_ ? 1 : 0;
    if (count == 0) return;
    const ThinnedRows some(count, kMostOfSpectrum);
    share_ = std::min(1.0, static_cast<double>(kMostOfSpectrum) / static_cast<double>(count));
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!some.has(i) || !used[i] || table.rows[i].kind != kind_) continue;
      const Place& place = table.place(table.rows[i]);
      values_.push_back({place.tooth, place.side > 0 ? 1 : 0,
                         0.5 * (geometry.profile_coordinate(place.roll_mm) + 1.0),
                         0.5 * (geometry.face_coordinate(place.z_mm) + 1.0), row_um[i]});
      ++flank_of(values_.back()).count;
    }
  }

  /// In halves of a wave: where the values of all flanks stand in few lines, as those of a mesh of rows and
  /// columns do, shorter waves look like longer ones.
  [[nodiscard]] int most_waves(double Value::*along, int most) const {
    constexpr std::size_t kPlaces = 128;
    constexpr double kScattered = 0.7;
    std::array<bool, kPlaces> known{};
    for (const Value& value : values_)
      known[static_cast<std::size_t>(std::clamp(value.*along * kPlaces, 0.0, kPlaces - 1.0))] = true;
    if (static_cast<double>(std::count(known.begin(), known.end(), true)) > kScattered * kPlaces) return most;
    int lines = known[0] ? 1 : 0;
    for (std::size_t i = 1; i < kPlaces; ++i) lines += known[i] && !known[i - 1] ? 1 : 0;
    return std::min(most, lines - 1);
  }

  void take_means_off() {
    take_common_courses_off();
    for (Flank& flank : flanks_) flank.mean = 0.0;
    for (const Value& value : values_) flank_of(value).mean += value.um;
    for (Flank& flank : flanks_) flank.mean /= std::max(1, flank.count);
    double square = 0.0;
    for (Value& value : values_) {
      value.um -= flank_of(value).mean;
      square += value.um * value.um;
    }
    // Wild values count no more than a few spreads.
    const double most = 4.0 * std::sqrt(square / static_cast<double>(values_.size()));
    for (Value& value : values_) value.um = std::clamp(value.um, -most, most);
  }

  /// What the teeth of a side share along one direction, over the profile or over the face, is looked for
  /// elsewhere: it would show as the waves next to it.
  void take_common_courses_off() {
    constexpr std::size_t kParts = 96;
    constexpr double kValuesAPart = 20.0;
    for (const auto along : {&Value::u, &Value::v}) {
      struct Part {
        double sum = 0.0, count = 0.0;
      };
      std::array<std::array<Part, kParts>, 2> parts{};
      const auto part_of = [&](const Value& value) -> Part& {
        const auto at = static_cast<std::size_t>(std::clamp(value.*along * kParts, 0.0, kParts - 1.0));
        return parts[static_cast<std::size_t>(value.side)][at];
      };
      for (const Value& value : values_) {
        part_of(value).sum += value.um;
        part_of(value).count += 1.0;
      }
      for (Value& value : values_)
        if (const Part& part = part_of(value); part.count >= kValuesAPart) value.um -= part.sum / part.count;
    }
  }

  /// Values in the order of their flanks; `first` of each flank.
  [[nodiscard]] std::vector<const Value*> by_flank(std::vector<std::size_t>& first) {
    first.assign(flanks_.size() + 1, 0);
    for (std::size_t f = 0; f < flanks_.size(); ++f)
      first[f + 1] = first[f] + static_cast<std::size_t>(flanks_[f].count);
    std::vector<std::size_t> next = first;
    std::vector<const Value*> sorted(values_.size());
    for (const Value& value : values_)
      sorted[next[static_cast<std::size_t>(&flank_of(value) - flanks_.data())]++] = &value;
    return sorted;
  }

  /// Sums of all waves of every flank. Cosines and sines over the profile times those over the
  /// face: waves that rise and waves that fall are made of the same four products.
  void transform() {
    std::vector<std::size_t> first;
    const std::vector<const Value*> sorted = by_flank(first);
    // Flanks do not ask each other: the same sums on any number of processors.
    for_each_piece(flanks_.size(), [&](std::size_t f) {
      Flank& flank = flanks_[f];
      WaveProducts products;
      const std::size_t end = first[f + 1];
      for (std::size_t next = first[f]; next < end; next += kWavesAtOnce)
        products.add({sorted.data() + next, std::min(kWavesAtOnce, end - next)});
      flank.real.assign(static_cast<std::size_t>((kProfile + 1) * kColumns), 0.0);
      flank.imaginary = flank.real;
      for (int a = 0; a <= kProfile; ++a)
        for (int b = 0; b <= kFace; ++b)
          for (const int sign : {1, -1}) {
            const Complex sum = products.sum(a, b, sign);
            flank.real[FlankSums::at(a, sign * b)] = sum.real();
            flank.imaginary[FlankSums::at(a, sign * b)] = sum.imag();
          }
    });
  }

  using OfColumns = std::array<double, kColumns>;

  /// Powers of one order at one wavelength over the profile and all over the face, on one side.
  OfColumns powers(int a, int n, int side, double count) const {
    OfColumns real{}, imaginary{};
    const Complex step = std::polar(1.0, -kTwoPi * n / orders_);
    Complex turn = 1.0;
    for (int k = 0; k < teeth_; ++k, turn = product(turn, step)) {
      const Flank& flank = flanks_[static_cast<std::size_t>(2 * k + side)];
      const double *const x = &flank.real[FlankSums::at(a, -kFace)],
                          *const y = &flank.imaginary[FlankSums::at(a, -kFace)];
      in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
        for (std::size_t b = 0; b < kColumns; ++b) {
          real[b] += x[b] * turn.real() - y[b] * turn.imag();
          imaginary[b] += x[b] * turn.imag() + y[b] * turn.real();
        }
      });
    }
    for (std::size_t b = 0; b < kColumns; ++b)
      real[b] = (real[b] * real[b] + imaginary[b] * imaginary[b]) / std::max(1.0, count);
    return real;
  }

  /// The powers of all orders at one pair of wavelengths on one side, in short.
  struct Orders {
    int a = 0, b = 0;
    double order = 0.0, median = 0.0, largest = 0.0;
  };

  /// At one wavelength over the profile and all over the face that are asked about.
  std::vector<Orders> orders_at(int a, int side) const {
    double count = 0.0;
    for (int k = 0; k < teeth_; ++k) count += flanks_[static_cast<std::size_t>(2 * k + side)].count;
    std::vector<OfColumns> of_order;
    for (int n = 0; n < orders_; ++n) of_order.push_back(powers(a, n, side, count));
    std::vector<Orders> all;
    std::vector<double> power(of_order.size());
    for (int b = a == 0 ? fewest_ : -most_face_; b <= most_face_; ++b) {
      if (a + std::abs(b) < fewest_) continue;
      for (std::size_t n = 0; n < power.size(); ++n)
        power[n] = of_order[n][static_cast<std::size_t>(b + kFace)];
      all.push_back(in_short(a, b, power));
    }
    return all;
  }

  Orders in_short(int a, int b, std::vector<double>& power) const {
    Orders found{a, b};
    for (int n = 0; n < orders_; ++n) {
      // The same on every tooth along one direction is looked for elsewhere.
      if (n == 0 && (a < 1 || std::abs(b) < 1)) continue;
      if (power[static_cast<std::size_t>(n)] <= found.largest) continue;
      found.largest = power[static_cast<std::size_t>(n)];
      found.order = static_cast<double>(2 * n > orders_ ? n - orders_ : n) * teeth_ / orders_;
    }
    found.median = median(power);
    return found;
  }

  /// A wave, its amplitude left out, and how it stands out.
  struct Judged {
    FlankWaves wave;
    double ratio = 0.0;  ///< of its power to the level at its wavelengths
    double power = 0.0;
  };

  /// The orders that stand out most, at every pair of wavelengths on either side.
  std::vector<Judged> judged_waves() const {
    // Wavelengths over the profile do not ask each other: the same powers on any number of
    // processors.
    const auto asked = static_cast<std::size_t>(most_profile_ + 1);
    std::vector<std::vector<Orders>> of_profile(2 * asked);
    for_each_piece(of_profile.size(), [&](std::size_t i) {
      of_profile[i] = orders_at(static_cast<int>(i % asked), static_cast<int>(i / asked));
    });
    std::array<std::vector<Orders>, 2> of_side;
    std::array<double, 2> usual{};  // a probe may be noisier on one side
    for (std::size_t i = 0; i < of_profile.size(); ++i)
      for (const Orders& one : of_profile[i]) {
        of_side[i / asked].push_back(one);
        usual[i / asked] += one.median;
      }
    if (of_side[0].empty() || !(usual[0] > 0.0 && usual[1] > 0.0)) return {};
    // The level is a median of as many: known as well as a mean of half of them.
    const double known = teeth_, tested = 2.0 * orders_ * static_cast<double>(of_side[0].size());
    std::vector<Judged> waves;
    for (std::size_t i = 0; i < of_side[0].size(); ++i) {
      const double level =
          0.5 * (of_side[0][i].median / usual[0] + of_side[1][i].median / usual[1]) / std::log(2.0);
      for (std::size_t side = 0; side < 2 && level > 0.0; ++side) {
        const Orders& one = of_side[side][i];
        const double ratio = one.largest / usual[side] / level;
        const double p_value = std::min(1.0, tested * std::pow(1.0 + ratio / known, -known));
        waves.push_back({{p_value, side == 1 ? 1 : -1, 0.5 * one.a, 0.5 * one.b, one.order, 0.0},
                         ratio,
                         one.largest});
      }
    }
    return waves;
  }

  std::optional<FlankWaves> largest_wave() const {
    const std::vector<Judged> waves = judged_waves();
    const auto best =
        std::max_element(waves.begin(), waves.end(),
                         [](const Judged& a, const Judged& b) { return a.ratio < b.ratio; });
    if (best == waves.end() || best->wave.p_value >= 1.0) return {};
    FlankWaves found = best->wave;
    sharpen(found);
    return found;
  }

  [[nodiscard]] double mean_square(int side) const {
    double square = 0.0, count = 0.0;
    for (const Value& value : values_)
      if ((value.side == 1) == (side > 0)) {
        square += value.um * value.um;
        count += 1.0;
      }
    return square / std::max(1.0, count);
  }

  static constexpr int kAround = 2, kSteps = 2 * kAround + 1;
  using Amplitudes = std::array<std::array<double, kSteps>, kSteps>;

  /// Wavelengths between those asked about, and the amplitude.
  void sharpen(FlankWaves& wave) const {
    double best = 0.0;
    for (const double step : {0.25, 0.1, 0.04, 0.016}) {
      const double a = wave.waves_profile, b = wave.waves_face;
      const Amplitudes amplitudes = amplitudes_around(wave, step);
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double amplitude =
              amplitudes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
          if ((most_profile_ == 0 && i != kAround) || amplitude <= best) continue;
          best = amplitude;
          wave.waves_profile = a + (i - kAround) * step;
          wave.waves_face = b + (j - kAround) * step;
        }
    }
    wave.amplitude_um = best;
  }

  /// Amplitudes of a wave and of those some steps of wavelength off.
  [[nodiscard]] Amplitudes amplitudes_around(const FlankWaves& wave, double step) const {
    std::vector<double> um, angles;  // of the values; of their waves and of both steps
    for (const Value& value : values_) {
      if ((value.side == 1) != (wave.side > 0)) continue;
      const double phase = (wave.waves_profile - kAround * step) * value.u +
                           (wave.waves_face - kAround * step) * value.v +
                           wave.order * (value.tooth - 1) / teeth_;
      um.push_back(value.um);
      for (const double angle :
           {-kTwoPi * phase, -kTwoPi * step * value.u, -kTwoPi * step * value.v})
        angles.push_back(angle);
    }
    std::vector<double> sines(angles.size()), cosines(angles.size());
    sines_and_cosines(angles, sines, cosines);
    // Of all steps over the profile at once, in whole registers, by steps over the face.
    constexpr std::size_t kInRegisters = 8;
    using OfRows = std::array<double, kInRegisters>;
    std::array<OfRows, kSteps> real{}, imaginary{};
    OfRows row_real{}, row_imaginary{};
    for (std::size_t k = 0; k < um.size(); ++k) {
      const auto turn = [&](std::size_t of) {
        return Complex(cosines[3 * k + of], sines[3 * k + of]);
      };
      const Complex step_u = turn(1), step_v = turn(2);
      Complex of_row = um[k] * turn(0);
      for (std::size_t i = 0; i < kSteps; ++i, of_row = product(of_row, step_u)) {
        row_real[i] = of_row.real();
        row_imaginary[i] = of_row.imag();
      }
      in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
        const double turn_real = step_v.real(), turn_imaginary = step_v.imag();
        for (std::size_t i = 0; i < kInRegisters; i += 4) {
          FourDoubles re, im;
          load(re, row_real.data() + i);
          load(im, row_imaginary.data() + i);
          for (std::size_t j = 0; j < kSteps; ++j) {
            FourDoubles sum;
            load(sum, real[j].data() + i);
            store(sum + re, real[j].data() + i);
            load(sum, imaginary[j].data() + i);
            store(sum + im, imaginary[j].data() + i);
            const FourDoubles next = re * turn_real - im * turn_imaginary;
            im = re * turn_imaginary + im * turn_real;
            re = next;
          }
        }
      });
    }
    const auto count = static_cast<double>(um.size());
    Amplitudes amplitudes{};
    for (std::size_t i = 0; i < kSteps; ++i)
      for (std::size_t j = 0; j < kSteps; ++j)
        amplitudes[i][j] =
            2.0 * std::abs(Complex(real[j][i], imaginary[j][i])) / std::max(1.0, count);
    return amplitudes;
  }

  /// Squares of one Fourier sum of the flanks, in shares of their values, about the mean of their
  /// side.
  std::vector<double> squares_at(int a, int b) const {
    std::array<Complex, 2> mean{};
    std::array<double, 2> count{};
    const auto sum_of = [&](const Flank& flank) {
      return a == 0 && b == 0 ? Complex(flank.mean * flank.count) : flank.sum(a, b);
    };
    for (std::size_t f = 0; f < flanks_.size(); ++f) {
      mean[f % 2] += sum_of(flanks_[f]);
      count[f % 2] += flanks_[f].count;
    }
    std::vector<double> squares;
    for (std::size_t f = 0; f < flanks_.size(); ++f) {
      const Flank& flank = flanks_[f];
      if (flank.count < kFewestValues) continue;
      squares.push_back(std::norm(sum_of(flank) - mean[f % 2] * (flank.count / count[f % 2])) /
                        flank.count);
    }
    return squares;
  }

  /// What the errors alone make of the heights of the flanks.
  struct LevelOfHeights {
    double level = 0.0;    ///< 0: not bounded
    double degrees = 0.0;  ///< how well it is known, as of a chi-square
  };

  /// Told by one and two waves along one direction. No spectrum of errors that hang together over
  /// some length rises further towards long waves than one of which each error keeps a share of the
  /// last: its inverse is a straight line over the square of the frequency.
  [[nodiscard]] LevelOfHeights extended_level(double one, double two) const {
    const double inverse = (4.0 / one - 1.0 / two) / 3.0;
    const double variance = (16.0 / (one * one) + 1.0 / (two * two)) / 9.0 / (kToldByWaves * known_);
    if (!(inverse > 0.0) || !std::isfinite(inverse)) return {};
    return {1.0 / inverse, 2.0 * inverse * inverse / variance};
  }

  /// The most it can be where errors hang together over no more than so many values in a row: a
  /// slower one is a form of each flank.
  [[nodiscard]] LevelOfHeights most_level(double one, double two, double values) const {
    constexpr double kHangTogether = 12.0;
    const double x = std::pow(kTwoPi * kHangTogether / values, 2);
    return {0.5 * (one * (1.0 + x) + two * (1.0 + 4.0 * x)), kToldByWaves * known_};
  }

  /// A sum over the flanks' values, as one of their forms makes it, against what the errors alone make
  /// of it, told by one and two waves more along one direction.
  struct Against {
    double p_value = 1.0, level = 0.0;
  };
  [[nodiscard]] Against against(const LevelOfHeights& errors, double usual, double degrees) const {
    constexpr double kClearly = 1.6;
    if (!(errors.level > 0.0) || usual < kClearly * errors.level) return {};
    return {f_tail(usual / errors.level, degrees, errors.degrees), errors.level};
  }
  /// Either bound of the errors holds: two tests.
  [[nodiscard]] Against against_either(double usual, double degrees, double one, double two) const {
    const Against extended = against(extended_level(one, two), usual, degrees),
                  most = against(most_level(one, two, values_a_flank()), usual, degrees);
    const Against& best = most.p_value < extended.p_value ? most : extended;
    return {2.0 * best.p_value, best.level};
  }
  /// Beyond both bounds; so many values stand in a row.
  [[nodiscard]] Against against_both(double usual, double degrees, double one, double two,
                                     double values) const {
    const Against extended = against(extended_level(one, two), usual, degrees),
                  most = against(most_level(one, two, values), usual, degrees);
    return most.p_value < extended.p_value ? extended : most;
  }
  [[nodiscard]] double usual_at(int a, int b) const { return median(squares_at(a, b)) / std::log(2.0); }
  [[nodiscard]] double values_a_flank() const {
    double values = 0.0;
    for (const Flank& flank : flanks_) values += flank.count;
    return values / known_;
  }
  /// Along one direction. Where the scan runs to and fro along it, in lines, errors of a line hang together
  /// over all that lines are long; where the values come in no order, they stand anywhere.
  [[nodiscard]] double values_in_a_row(double Value::*along) const {
    constexpr double kLine = 3.0;
    std::vector<const Value*> last(flanks_.size(), nullptr);
    struct Run {
      int way = 0, steps = 0;
    };
    std::vector<Run> runs(flanks_.size());
    double all = 0.0, rows = 0.0;  // a jump back to where the next line begins is a run, and no row
    for (const Value& value : values_) {
      const auto f = static_cast<std::size_t>(2 * (value.tooth - 1) + value.side);
      if (last[f] != nullptr && value.*along != last[f]->*along) {
        const int way = value.*along > last[f]->*along ? 1 : -1;
        Run& run = runs[f];
        if (way != run.way) {
          run = {way, 0};
          all += 1.0;
        }
        rows += ++run.steps == 2 ? 1.0 : 0.0;
      }
      last[f] = &value;
    }
    const auto values = static_cast<double>(values_.size());
    const double in_a_row = values < kLine * all ? 0.0 : values / std::max(1.0, rows);
    return in_a_row < kLine ? values_a_flank() : in_a_row / share_;
  }
  [[nodiscard]] double spread_of(const std::vector<double>& squares, double level) const {
    double sum = 0.0;
    for (const double square : squares) sum += square;
    return std::sqrt(std::max(0.0, sum / known_ - level) / values_a_flank());
  }

  /// Heights of the flanks against the longest waves within them, over the face and over the
  /// profile: the direction that allows more.
  std::optional<TeethApart> apart() const {
    // A median tells less than a mean: of a chi-square with one degree as much as 0.37 of the
    // values.
    constexpr double kToldByMedian = 0.37;
    std::vector<double> squares = squares_at(0, 0);
    const double height = median(squares) / kMedianOfSquare;
    TeethApart found{.p_value = 0.0};
    double level = 0.0;
    for (const auto& [a, b] : {std::array{0, 2}, std::array{2, 0}}) {
      const Against errors =
          against_either(height, kToldByMedian * known_, usual_at(a, b), usual_at(2 * a, 2 * b));
      if (errors.p_value >= 1.0) return {};
      found.p_value = std::max(found.p_value, errors.p_value);
      level = std::max(level, errors.level);
    }
    found.spread_um = spread_of(squares, level);
    return found;
  }

  /// Waves that are constant along one direction, in a phase and height of their own on every flank,
  /// against those of the same length that are not.
  std::optional<FormsApart> forms_apart() const {
    constexpr int kLongest = 2, kAcross = 4;  // halves: one whole wave, two
    if (std::min(most_profile_, most_face_) < kAcross) return {};
    const auto shortest = [&](bool face) { return face ? std::min(most_face_, kFace / 2) : most_profile_; };
    FormsApart found;
    int looks = 0;
    double squares = 0.0;
    for (const bool face : {false, true}) {
      const double in_a_row = values_in_a_row(face ? &Value::u : &Value::v);
      for (int n = kLongest; n <= shortest(face); ++n) {
        ++looks;
        const auto at = [&](int across) { return face ? usual_at(across, n) : usual_at(n, across); };
        const double usual = at(0);
        const Against errors =
            against_both(usual, kToldByWaves * known_, at(kLongest), at(kAcross), in_a_row);
        if (errors.p_value < found.p_value)
          found = {.p_value = errors.p_value, .face = face, .waves = 0.5 * n};
      }
    }
    found.p_value = std::min(1.0, looks * found.p_value);
    if (found.p_value >= 1.0) return {};
    // Whole waves make up the form; the sum of a wave's squares is half of a flank's.
    for (int n = kLongest; n <= shortest(found.face); n += 2) {
      const auto at = [&](int across) { return found.face ? squares_at(across, n) : squares_at(n, across); };
      squares += 2.0 * std::pow(spread_of(at(0), median(at(2)) / std::log(2.0)), 2);
    }
    found.spread_um = std::sqrt(squares);
    return found;
  }

  int teeth_, orders_ = teeth_, known_ = 0;  ///< orders_: asked about, of teeth_ periods a turn
  ObservationKind kind_;
  double share_ = 1.0;  ///< of the scan's values that are asked
  int most_profile_ = kProfile, most_face_ = kFace, fewest_ = 4;  ///< halves of a wave
  std::vector<Flank> flanks_;
  std::vector<Value> values_;
};

}  // namespace
}  // namespace flank_waves

FlankSpectrum flank_spectrum(const FlankGeometry& geometry, const Observations& table,
                             const std::vector<float>& row_um, const std::vector<bool>& used) {
  return flank_waves::Spectrum(geometry, table, row_um, used, ObservationKind::kScanFlank).run();
}

std::vector<FlankWaves> waves_of_leads(const FlankGeometry& geometry, const Observations& table,
                                       const std::vector<float>& row_um,
                                       const std::vector<bool>& used) {
  std::vector<FlankWaves> found =
      flank_waves::Spectrum(geometry, table, row_um, used, ObservationKind::kHelix)
          .waves_of_leads();
  return found.empty() ? marching_leads(geometry, table, row_um, used) : found;
}

}  // namespace trueflank::loop
