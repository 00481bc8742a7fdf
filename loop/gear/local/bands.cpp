// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/bands.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "trueflank/loop/gear/effects/along_flank.h"

namespace trueflank::loop {
namespace {

/// Means over narrow strips of the face, of one side: roots of the weights, and values times these.
struct Strips {
  Eigen::VectorXd root, value;
};

/// A course over the face at a height.
using CourseOfBands = std::function<double(double)>;

constexpr int kFewestStrips = 40, kMostStrips = 480, kPhases = 24;
constexpr double kShortestInStrips = 5.0;

class BandSearch {
 public:
  BandSearch(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
             const std::vector<float>& row_um)
      : geometry_(geometry), face_(geometry.face_width_mm()) {
    std::array<std::vector<std::pair<double, double>>, 2> points;  // height, deviation
    const auto flanks = static_cast<std::size_t>(2 * geometry.teeth() + 2);
    std::vector<std::pair<double, double>> levels(  // of flanks, then of traces
        flanks + static_cast<std::size_t>(std::max(0, table.traces)));
    std::vector<std::pair<std::size_t, std::size_t>> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Observation& row = table.rows[i];
      const int patch = patches.patch_of_row[i];
      if ((row.kind != ObservationKind::kScanFlank && row.kind != ObservationKind::kHelix) ||
          patch < 0 || patches.patches[static_cast<std::size_t>(patch)].fold == 0)
        continue;
      const Place& place = table.place(row);
      const std::size_t unit =
          row.trace >= 0 ? flanks + static_cast<std::size_t>(row.trace)
                         : static_cast<std::size_t>(2 * place.tooth + (place.side > 0 ? 1 : 0));
      if (unit >= levels.size()) continue;
      auto& level = levels[unit];
      level.first += row_um[i];
      level.second += 1.0;
      rows.emplace_back(i, unit);
    }
    constexpr std::size_t kFewestRows = 150, kRowsOfStrip = 8;
    if (rows.size() < kFewestRows) return;
    count_ = std::clamp(static_cast<int>(rows.size() / kRowsOfStrip), kFewestStrips, kMostStrips);
    for (const std::size_t side : {0U, 1U}) {
      strips_[side].root = Eigen::VectorXd::Zero(count_);
      strips_[side].value = strips_[side].root;
    }
    std::array<Eigen::VectorXd, 2> square;
    square.fill(Eigen::VectorXd::Zero(count_));
    for (const auto& [i, unit] : rows) {
      const Place& place = table.place(table.rows[i]);
      const auto& level = levels[unit];
      const double um = row_um[i] - level.first / level.second;
      const std::size_t side = place.side > 0 ? 1 : 0;
      const int at = std::clamp(static_cast<int>(place.z_mm / face_ * count_), 0, count_ - 1);
      strips_[side].root[at] += 1.0;
      strips_[side].value[at] += um;
      square[side][at] += um * um;
    }
    // The error of a value, as those of a strip scatter.
    double left = 0.0, degrees = 0.0;
    for (const std::size_t side : {0U, 1U})
      for (int k = 0; k < count_; ++k) {
        const double n = strips_[side].root[k];
        if (n < 2.0) continue;
        left += square[side][k] - strips_[side].value[k] * strips_[side].value[k] / n;
        degrees += n - 1.0;
      }
    if (!(degrees > 30.0 && left > 0.0)) return;
    const double sigma = std::sqrt(left / degrees);
    for (Strips& strips : strips_) {
      strips.root = strips.root.cwiseSqrt() / sigma;
      strips.value = (strips.root.array() > 0.0)
                         .select(strips.value.array() / (sigma * sigma) / strips.root.array(), 0.0);
    }
    usable_ = true;
  }

  [[nodiscard]] std::optional<Bands> run() const {
    if (!usable_) return {};
    std::optional<Bands> best;
    double most = 0.0;
    // (one side alone is seen in either, and told by how much each has)
    for (const bool opposite : {false, true})
      if (auto found = look(opposite); found && found->second > most) {
        most = found->second;
        best = std::move(found->first);
      }
    return best;
  }

 private:
  /// Columns of free smooth courses and of those given, beside which square is left of the values.
  [[nodiscard]] double left_by(const Strips& strips, const std::vector<CourseOfBands>& courses,
                               int smooth, Eigen::VectorXd* found = nullptr) const {
    Eigen::MatrixXd columns(count_, smooth + static_cast<int>(courses.size()));
    for (int k = 0; k < count_; ++k) {
      const double share = (k + 0.5) / count_, v = 2.0 * share - 1.0;
      for (int degree = 0; degree < smooth; ++degree) columns(k, degree) = std::pow(v, degree);
      for (std::size_t c = 0; c < courses.size(); ++c)
        columns(k, smooth + static_cast<int>(c)) = mean_in_strip(courses[c], k);
    }
    columns = strips.root.asDiagonal() * columns;
    const Eigen::VectorXd x = columns.colPivHouseholderQr().solve(strips.value);
    if (found != nullptr) *found = x;
    return (strips.value - columns * x).squaredNorm();
  }
  [[nodiscard]] double mean_in_strip(const CourseOfBands& course, int k) const {
    constexpr int kOfStrip = 5;
    double sum = 0.0;
    for (int i = 0; i < kOfStrip; ++i) sum += course(face_ * (k + (i + 0.5) / kOfStrip) / count_);
    return sum / kOfStrip;
  }

  /// The sides' strips put together, as they are or the other one turned over.
  [[nodiscard]] Strips together(bool opposite) const {
    Strips both{Eigen::VectorXd::Zero(count_), Eigen::VectorXd::Zero(count_)};
    for (int k = 0; k < count_; ++k) {
      const double a = strips_[1].root[k], b = strips_[0].root[k], weight = a * a + b * b;
      both.root[k] = std::sqrt(weight);
      if (weight > 0.0)
        both.value[k] =
            (a * strips_[1].value[k] + (opposite ? -b : b) * strips_[0].value[k]) / both.root[k];
    }
    return both;
  }

  struct Repeats {
    double period_mm = 0.0, place_mm = 0.0, width_mm = 0.0;  ///< width: of a band
    double left = 1e300;  ///< of what is folded: less what they take out
  };

  static double band(double z, const Repeats& r) {
    const double share = (z - r.place_mm) / r.period_mm;
    return (share - std::floor(share)) * r.period_mm < r.width_mm ? 1.0 : 0.0;
  }

  /// Squares that bands, or a sawtooth, of a period take out of values beside smooth courses: by
  /// the values folded over the period.
  struct Folded {
    Repeats bands, saw;
  };
  /// None where no form takes out so much, `least`.
  [[nodiscard]] Folded folded(const Strips& strips, const Eigen::VectorXd& level_less,
                              double period, double least) const {
    std::array<double, kPhases> weight{}, value{};
    for (int k = 0; k < count_; ++k) {
      const double share = face_ * (k + 0.5) / count_ / period;
      const auto cell = static_cast<std::size_t>((share - std::floor(share)) * kPhases) % kPhases;
      weight[cell] += strips.root[k] * strips.root[k];
      value[cell] += strips.root[k] * level_less[k];
    }
    double all_weight = 0.0, all_value = 0.0;
    for (std::size_t c = 0; c < kPhases; ++c) {
      all_weight += weight[c];
      all_value += value[c];
    }
    Folded best;
    double any_form = -all_value * all_value / all_weight;
    for (std::size_t c = 0; c < kPhases; ++c)
      if (weight[c] > 0.0) any_form += value[c] * value[c] / weight[c];
    if (any_form < least) return best;
    double most = -1.0, most_of_saw = -1.0;
    for (std::size_t from = 0; from < kPhases; ++from) {
      double w = 0.0, v = 0.0, sw = 0.0, sww = 0.0, sv = 0.0;
      for (std::size_t wide = 1; wide <= kPhases; ++wide) {
        const std::size_t c = (from + wide - 1) % kPhases;
        w += weight[c];
        v += value[c];
        const double saw = 0.5 - (static_cast<double>(wide) - 0.5) / kPhases;
        sw += saw * weight[c];
        sww += saw * saw * weight[c];
        sv += saw * value[c];
        if (wide < 3 || wide > kPhases - 3) continue;
        const double off = v - w * all_value / all_weight, square = w - w * w / all_weight;
        const double gain = square > 0.0 ? off * off / square : 0.0;
        if (gain > most) {
          most = gain;
          best.bands = {period, period * static_cast<double>(from) / kPhases,
                        period * static_cast<double>(wide) / kPhases, -gain};
        }
      }
      const double square = sww - sw * sw / all_weight, off = sv - sw * all_value / all_weight;
      const double gain = square > 0.0 ? off * off / square : 0.0;
      if (gain > most_of_saw) {
        most_of_saw = gain;
        best.saw = {period, period * static_cast<double>(from) / kPhases, 0.0, -gain};
      }
    }
    return best;
  }

  /// Moves places, periods and widths until nothing leaves less.
  template <class Left>
  [[nodiscard]] Repeats refined(Repeats from, bool bands, const Left& left) const {
    from.left = left(from);
    for (double step = 0.06; step > 0.002; step *= 0.5) {
      bool moved = true;
      for (int turn = 0; moved && turn < 4; ++turn) {
        moved = false;
        const Repeats now = from;
        const auto try_one = [&](double place, double period, double width) {
          Repeats other = now;
          other.place_mm += place * now.period_mm;
          other.period_mm *= 1.0 + period * now.period_mm / face_;
          other.width_mm += width * now.period_mm;
          if (bands &&
              !(other.width_mm > 0.1 * other.period_mm && other.width_mm < 0.9 * other.period_mm))
            return;
          other.left = left(other);
          if (other.left >= from.left - 1e-9) return;
          from = other;
          moved = true;
        };
        for (const double sign : {-step, step}) {
          try_one(sign, 0.0, 0.0);
          try_one(0.0, sign, 0.0);
          try_one(-0.5 * face_ / now.period_mm * sign, sign, 0.0);
          if (!bands) continue;
          try_one(0.0, 0.0, sign);
          try_one(sign, 0.0, -sign);
        }
      }
    }
    return from;
  }

  /// Least that a wave with its multiples leaves, of a period near to one.
  [[nodiscard]] double left_by_waves(const Strips& strips, double period_mm) const {
    constexpr int kMultiples = 4;
    double least = 1e300;
    for (const double off : {-0.12, -0.06, 0.0, 0.06, 0.12}) {
      const double period = period_mm * (1.0 + off * period_mm / face_);
      std::vector<CourseOfBands> waves;
      for (int m = 1; m <= kMultiples; ++m) {
        waves.emplace_back([m, period](double z) { return std::cos(kTwoPi * m * z / period); });
        waves.emplace_back([m, period](double z) { return std::sin(kTwoPi * m * z / period); });
      }
      least = std::min(least, left_by(strips, waves, 3));
    }
    return least;
  }

  [[nodiscard]] std::optional<std::pair<Bands, double>> look(bool opposite) const {
    constexpr double kGain = 80.0, kClearly = 25.0, kPart = 0.35;  // chi-square, of the gain
    const Strips strips = together(opposite);
    Eigen::VectorXd smooth;
    const double plain = left_by(strips, {}, 3, &smooth);
    Eigen::VectorXd level_less = strips.value;
    for (int k = 0; k < count_; ++k) {
      const double v = 2.0 * (k + 0.5) / count_ - 1.0;
      level_less[k] -= strips.root[k] * (smooth[0] + smooth[1] * v + smooth[2] * v * v);
    }
    const double shortest = kShortestInStrips * face_ / count_, longest = 0.5 * face_;
    Folded best;
    for (double period = shortest; period < longest; period *= 1.0 + 0.12 * period / face_) {
      const Folded found = folded(strips, level_less, period, kGain);
      if (found.bands.left < best.bands.left) best.bands = found.bands;
      if (found.saw.left < best.saw.left) best.saw = found.saw;
    }
    if (std::min(best.bands.left, best.saw.left) > -kGain) return {};
    const Repeats bands = refined(best.bands, true, [&](const Repeats& r) {
      return left_by(strips, {[&](double z) { return band(z, r); }}, 3);
    });
    const Repeats saw = refined(best.saw, false, [&](const Repeats& r) {
      return left_by(
          strips, {[&](double z) { return gear_effects::sawtooth(z - r.place_mm, r.period_mm); }},
          3);
    });
    const bool flight = saw.left < bands.left;
    const Repeats& found = flight ? saw : bands;
    const double gain = plain - found.left;
    if (gain < kGain || left_by_waves(strips, found.period_mm) < found.left + kClearly ||
        found.left - static_cast<double>(count_) > kPart * gain)
      return {};
    return flight ? told_flight(strips, found, plain, gain, opposite)
                  : told_bands(strips, found, gain, opposite, saw.left);
  }

  /// How much each side has of a course: alike, opposite, or one alone. Empty: neither.
  [[nodiscard]] std::optional<std::pair<FlankChoice, double>> flanks_of(const CourseOfBands& course,
                                                                        int smooth) const {
    std::array<double, 2> um{}, error{};
    for (const std::size_t side : {0U, 1U}) {
      Eigen::VectorXd x;
      const double left = left_by(strips_[side], {course}, smooth, &x);
      um[side] = x[smooth];
      double square = 0.0, weight = 0.0, mean = 0.0;
      for (int k = 0; k < count_; ++k) {
        const double w = strips_[side].root[k] * strips_[side].root[k];
        weight += w;
        mean += w * mean_in_strip(course, k);
      }
      if (!(weight > 0.0)) return {};
      for (int k = 0; k < count_; ++k)
        square += std::pow(strips_[side].root[k] * (mean_in_strip(course, k) - mean / weight), 2);
      error[side] = std::sqrt(std::max(1.0, left / count_) / std::max(square, 1e-12));
    }
    constexpr double kAlike = 4.5, kShare = 0.1;
    const double error_um = std::hypot(error[0], error[1]),
                 size = std::max(std::abs(um[0]), std::abs(um[1]));
    const double within = std::max(kAlike * error_um, kShare * size);
    if (std::abs(um[0] - um[1]) < within) return std::pair(FlankChoice::kBoth, 0.0);
    if (std::abs(um[0] + um[1]) < within) return std::pair(FlankChoice::kBoth, 1.0);
    for (const std::size_t side : {0U, 1U})
      if (std::abs(um[side]) < within) {
        // (the other side has it)
        return std::pair(
            flank_of(geometry_, geometry_.on_flank(1, side == 0 ? 1 : -1,
                                                   0.5 * (geometry_.root_form_roll_mm() +
                                                          geometry_.tip_form_roll_mm()),
                                                   0.0)),
            0.0);
      }
    return {};
  }

  [[nodiscard]] std::optional<std::pair<Bands, double>> told_bands(const Strips& strips,
                                                                   Repeats found, double gain,
                                                                   bool opposite,
                                                                   double left_by_saw) const {
    constexpr double kClearly = 25.0;
    constexpr int kFewestEdges = 4;
    if (left_by_saw < found.left + kClearly ||
        edges_at(found.place_mm, found.period_mm) +
                edges_at(found.place_mm + found.width_mm, found.period_mm) <
            kFewestEdges)
      return {};
    const CourseOfBands course = [&](double z) { return band(z, found); };
    const auto flanks = flanks_of(course, 3);
    if (!flanks || (flanks->first == FlankChoice::kBoth && (flanks->second != 0.0) != opposite))
      return {};
    Eigen::VectorXd x;
    (void)left_by(strips, {course}, 3, &x);
    // (low bands between high ones: what stands out is the band)
    if (x[3] < 0.0) {
      found.place_mm += found.width_mm;
      found.width_mm = found.period_mm - found.width_mm;
    }
    found.place_mm = first_place(found);
    const Bands bands{{find_family("unnamed_bands"),
                       flanks->first,
                       {1.0, found.place_mm, found.period_mm, found.width_mm, flanks->second}},
                      p_of(gain),
                      std::abs(x[3])};
    return std::pair(bands, gain);
  }

  /// A sawtooth beside just the slope that makes steps of it.
  [[nodiscard]] std::optional<std::pair<Bands, double>> told_flight(const Strips& strips,
                                                                    Repeats found, double plain,
                                                                    double gain,
                                                                    bool opposite) const {
    constexpr double kSlope = 0.1, kNoWorse = 12.0;
    found = refined(found, false, [&](const Repeats& r) {
      return left_by(strips, {[&](double z) { return std::floor((z - r.place_mm) / r.period_mm); }},
                     3);
    });
    if (found.left > plain - gain + kNoWorse) return {};
    // (one step, or two, are told as these)
    constexpr int kFewestSteps = 3;
    if (edges_at(found.place_mm, found.period_mm) < kFewestSteps) return {};
    found.place_mm = first_place(found);
    const CourseOfBands course = [&](double z) {
      return std::floor((z - found.place_mm) / found.period_mm) + 1.0;
    };
    Eigen::VectorXd x;
    (void)left_by(strips, {course}, 3, &x);
    const double rise = std::abs(x[3]) * face_ / found.period_mm;
    if (2.0 * std::abs(x[1]) > kSlope * rise) return {};
    const auto flanks = flanks_of(course, 3);
    if (!flanks || (flanks->first == FlankChoice::kBoth && (flanks->second != 0.0) != opposite))
      return {};
    const Bands steps{{find_family("unnamed_flight"),
                       flanks->first,
                       {1.0, found.place_mm, found.period_mm, flanks->second}},
                      p_of(gain),
                      std::abs(x[3])};
    return std::pair(steps, gain);
  }

  /// Places of the face, away from its ends, at which edges stand that come again.
  [[nodiscard]] int edges_at(double place_mm, double period_mm) const {
    constexpr double kEnd = 0.02;
    int edges = 0;
    for (double at = place_mm - period_mm * std::floor(place_mm / period_mm); at < face_;
         at += period_mm)
      edges += at > kEnd * face_ && at < (1.0 - kEnd) * face_ ? 1 : 0;
    return edges;
  }
  [[nodiscard]] static double first_place(const Repeats& r) {
    const double first = r.place_mm - r.period_mm * std::floor(r.place_mm / r.period_mm);
    return first > 0.0 ? first : r.period_mm;
  }
  [[nodiscard]] static double p_of(double gain) {
    constexpr double kSurest = 1e-30;
    return std::max(kSurest, std::exp(-0.5 * gain));
  }

  const FlankGeometry& geometry_;
  double face_;
  int count_ = 0;
  std::array<Strips, 2> strips_;
  bool usable_ = false;
};

}  // namespace

std::optional<Bands> bands_over_face(const FlankGeometry& geometry, const Observations& table,
                                     const Patches& patches, const std::vector<float>& row_um) {
  return BandSearch(geometry, table, patches, row_um).run();
}

}  // namespace trueflank::loop
