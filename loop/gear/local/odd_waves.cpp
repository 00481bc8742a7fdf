// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/odd_waves.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {
namespace {

constexpr double kRootOrLower = -1.0, kTipOrUpper = 1.0;
constexpr std::size_t kBins = 240;

/// The mean course of the traces of one side, at shares of the way from root or lower end.
struct MeanCourse {
  std::vector<double> share, um;
  double noise = 0.0;  ///< square that the scatter of the traces leaves in all
};

/// Of the sides; 1 is the one that lies counter-clockwise; then of both.
std::array<MeanCourse, 3> mean_courses(const FlankGeometry& geometry, const Observations& table,
                                       const Patches& patches, const std::vector<float>& row_um,
                                       bool face) {
  const double low = gear_effects::end_mm(geometry, face ? 1.0 : 0.0, kRootOrLower),
               range = gear_effects::end_mm(geometry, face ? 1.0 : 0.0, kTipOrUpper) - low;
  struct Sums {
    double count = 0.0, um = 0.0, share = 0.0, square = 0.0;
  };
  const auto rows_of = [&](auto&& with) {
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const Observation& row = table.rows[r];
      const int patch = patches.patch_of_row[r];
      if (row.kind != (face ? ObservationKind::kHelix : ObservationKind::kProfile) || patch < 0 ||
          patches.patches[static_cast<std::size_t>(patch)].fold == 0)
        continue;
      const Place& place = table.place(row);
      with(std::pair{place.side > 0 ? 1 : 0, place.tooth},
           (gear_effects::along(face ? 1.0 : 0.0, place) - low) / range,
           static_cast<double>(row_um[r]));
    }
  };
  std::map<std::pair<int, int>, Sums> traces;
  rows_of([&](const std::pair<int, int>& flank, double, double um) {
    traces[flank].count += 1.0;
    traces[flank].um += um;
  });
  std::array<std::vector<Sums>, 3> bins;
  bins.fill(std::vector<Sums>(kBins));
  rows_of([&](const std::pair<int, int>& flank, double share, double um) {
    const Sums& trace = traces[flank];
    const double off_um = um - trace.um / trace.count;
    for (const std::size_t of : {static_cast<std::size_t>(flank.first), std::size_t{2}}) {
      Sums& bin = bins[of][static_cast<std::size_t>(std::clamp(share * kBins, 0.0, kBins - 1.0))];
      bin.count += 1.0;
      bin.um += off_um;
      bin.share += share;
      bin.square += off_um * off_um;
    }
  });
  std::array<MeanCourse, 3> courses;
  for (std::size_t of = 0; of < courses.size(); ++of)
    for (const Sums& bin : bins[of]) {
      if (bin.count < 2.0) continue;
      courses[of].share.push_back(bin.share / bin.count);
      courses[of].um.push_back(bin.um / bin.count);
      courses[of].noise +=
          (bin.square - bin.um * bin.um / bin.count) / (bin.count - 1.0) / bin.count;
    }
  return courses;
}

/// A course against forms along it, each beside a line.
class FitsAlong {
 public:
  explicit FitsAlong(const MeanCourse& course)
      : share_(Eigen::Map<const Eigen::ArrayXd>(course.share.data(), std::ssize(course.share))),
        um_(Eigen::Map<const Eigen::VectorXd>(course.um.data(), std::ssize(course.um))) {
    Eigen::MatrixXd line(um_.size(), 2);
    line << Eigen::VectorXd::Ones(um_.size()), share_.matrix();
    line_ = line.householderQr().householderQ() * Eigen::MatrixXd::Identity(um_.size(), 2);
    um_ -= line_ * (line_.transpose() * um_);
    square_ = um_.squaredNorm();
  }

  [[nodiscard]] double values() const { return static_cast<double>(um_.size()); }
  [[nodiscard]] double square() const { return square_; }
  [[nodiscard]] const Eigen::ArrayXd& share() const { return share_; }

  /// What one or two columns leave.
  [[nodiscard]] double left(Eigen::VectorXd a, Eigen::VectorXd b = {}) const {
    constexpr double kNothing = 1e-9;
    const double whole = a.squaredNorm();
    a -= line_ * (line_.transpose() * a);
    const double own = a.squaredNorm();
    if (!(own > kNothing * whole)) return square_;
    a /= std::sqrt(own);
    double taken = std::pow(a.dot(um_), 2);
    if (b.size() > 0) {
      const double all = b.squaredNorm();
      b -= line_ * (line_.transpose() * b);
      b -= a * a.dot(b);
      if (b.squaredNorm() > kNothing * all) taken += std::pow(b.dot(um_), 2) / b.squaredNorm();
    }
    return square_ - taken;
  }
  [[nodiscard]] double left_by_wave(const Eigen::ArrayXd& phase, const Eigen::ArrayXd& size) const {
    return left((size * phase.cos()).matrix(), (size * phase.sin()).matrix());
  }

 private:
  Eigen::ArrayXd share_;
  Eigen::VectorXd um_;
  Eigen::MatrixXd line_;
  double square_ = 0.0;
};

/// What forms that are no odd waves leave at least.
double left_by_simple_forms(const FitsAlong& fits, double most_waves) {
  const Eigen::ArrayXd& s = fits.share();
  const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(s.size());
  double least = fits.left(s.square().matrix(), s.cube().matrix());
  for (double waves = 0.5; waves <= most_waves; waves += 0.1)
    for (const Eigen::ArrayXd& size : {ones, Eigen::ArrayXd(s), Eigen::ArrayXd(1.0 - s)})
      least = std::min(least, fits.left_by_wave(kTwoPi * waves * s, size));
  for (const double within : {0.02, 0.04, 0.08, 0.15, 0.3, 0.6})
    least = std::min({least, fits.left((-s / within).exp().matrix()),
                      fits.left(((s - 1.0) / within).exp().matrix())});
  for (double at = 0.02; at < 1.0; at += 0.02) {
    least = std::min({least, fits.left((s > at).cast<double>().matrix()),
                      fits.left((s - at).max(0.0).matrix()),
                      fits.left((s - at).max(0.0).square().matrix()),
                      fits.left((at - s).max(0.0).square().matrix())});
    for (const double half : {0.015, 0.03, 0.06, 0.12, 0.2})
      least = std::min(least, fits.left((-((s - at) / half).square()).exp().matrix()));
  }
  return least;
}

struct LikeliestWave {
  bool dies = false;
  double waves = 0.0, change = 0.0;    ///< changes
  double within = 0.0, towards = 0.0;  ///< dies away: a share of the way, from an end
  double left = 1e300, p_value = 1.0;

  [[nodiscard]] double left_of(const FitsAlong& fits) const {
    const Eigen::ArrayXd& s = fits.share();
    if (!dies)
      return fits.left_by_wave(kTwoPi * waves * (s + change * (s.square() - s)),
                               Eigen::ArrayXd::Ones(s.size()));
    const double end = towards < 0.0 ? 0.0 : 1.0;
    return fits.left_by_wave(kTwoPi * waves * s, (-(s - end).abs() / within).exp());
  }
};

/// Between those of the grid: both values together, in ever smaller steps.
void move_between(const FitsAlong& fits, LikeliestWave& wave) {
  constexpr int kHalvings = 12;
  double waves_step = 0.1, other_step = wave.dies ? 0.1 : 0.025;
  for (int round = 0; round < kHalvings; ++round) {
    bool moved = true;
    for (int again = 0; moved && again < 8; ++again) {
      moved = false;
      const LikeliestWave from = wave;
      for (const double a : {-1.0, 0.0, 1.0})
        for (const double b : {-1.0, 0.0, 1.0}) {
          LikeliestWave beside = from;
          beside.waves += a * waves_step;
          if (wave.dies)
            beside.within *= std::exp(b * other_step);
          else
            beside.change = std::clamp(from.change + b * other_step, -0.97, 0.97);
          beside.left = beside.left_of(fits);
          if (beside.left >= wave.left) continue;
          wave = beside;
          moved = true;
        }
    }
    waves_step *= 0.5;
    other_step *= 0.5;
  }
}

/// Waves that change or die away.
std::optional<LikeliestWave> likeliest_odd_wave(const MeanCourse& course) {
  constexpr std::size_t kFewest = 40;
  constexpr double kValuesOfWave = 5.0, kMostLeft = 0.12, kBetter = 2.0, kLevel = 1e-6;
  constexpr double kClearly = 40.0;  // chi-square
  // Errors that hang together leave some odd course in the mean of few traces, as large as theirs.
  constexpr double kAboveErrors = 6.0;
  constexpr double kFewestChanging = 3.0, kFewestDying = 4.0, kWavesWithin = 0.4;
  if (course.um.size() < kFewest) return {};
  const FitsAlong fits(course);
  const double most_waves = fits.values() / kValuesOfWave;
  LikeliestWave best;
  int asked = 0;
  const auto ask = [&](LikeliestWave wave) {
    ++asked;
    wave.left = wave.left_of(fits);
    if (wave.left < best.left) best = wave;
  };
  for (double waves = kFewestChanging; waves <= 0.6 * most_waves; waves += 0.2)
    for (double change = -0.95; change < 0.96; change += 0.05)
      if (std::abs(change) > 0.04) ask({.waves = waves, .change = change});
  for (const double towards : {kRootOrLower, kTipOrUpper})
    for (double within = 0.03; within < 0.5; within *= 1.25)
      for (double waves = std::max(kFewestDying, kWavesWithin / within); waves <= most_waves;
           waves += 0.25)
        ask({.dies = true, .waves = waves, .within = within, .towards = towards});
  const double noise = course.noise;
  if (best.left - noise > kMostLeft * (fits.square() - noise)) return {};
  const double extent = best.dies ? std::min(1.0, 2.0 * best.within) : 1.0;
  if (fits.square() - best.left < kAboveErrors * extent * noise) return {};
  const double free = fits.values() - 6.0;
  best.p_value = std::min(
      1.0, asked * f_tail((fits.square() - best.left) / 2.0 / (best.left / free), 2.0, free));
  if (best.p_value > kLevel) return {};
  const double simple = left_by_simple_forms(fits, most_waves);
  if (simple - noise < kBetter * (best.left - noise) ||
      simple - best.left < kClearly * std::max(noise, best.left) / fits.values())
    return {};
  move_between(fits, best);
  return best;
}

/// Whether a wave, in a phase of its own, is most of a course.
bool is_most_of(const LikeliestWave& wave, const MeanCourse& course) {
  constexpr double kMost = 0.6;
  if (course.um.empty()) return false;
  const FitsAlong fits(course);
  return fits.square() - wave.left_of(fits) > kMost * (fits.square() - course.noise);
}

}  // namespace

std::vector<OddWave> odd_waves(const FlankGeometry& geometry, const Observations& table,
                               const Patches& patches, const std::vector<float>& row_um) {
  std::vector<OddWave> found;
  for (const bool face : {false, true}) {
    const double range = std::abs(gear_effects::end_mm(geometry, face ? 1.0 : 0.0, kTipOrUpper) -
                                  gear_effects::end_mm(geometry, face ? 1.0 : 0.0, kRootOrLower));
    const auto add = [&](const LikeliestWave& wave, FlankChoice flank) {
      const double along = face ? 1.0 : 0.0, length_mm = range / wave.waves;
      found.push_back({wave.dies ? Effect{find_family("unnamed_waves_dying"),
                                          flank,
                                          {along, length_mm, wave.within * range, wave.towards}}
                                 : Effect{find_family("unnamed_waves_changing"),
                                          flank,
                                          {along, length_mm, wave.change}},
                       wave.p_value});
    };
    const std::array<MeanCourse, 3> courses = mean_courses(geometry, table, patches, row_um, face);
    const std::optional<LikeliestWave> both = likeliest_odd_wave(courses[2]);
    const bool alike = both && is_most_of(*both, courses[0]) && is_most_of(*both, courses[1]);
    for (const int side : {0, 1})
      if (const std::optional<LikeliestWave> wave =
              alike ? both : likeliest_odd_wave(courses[static_cast<std::size_t>(side)]))
        add(*wave, flank_choice(geometry, side));
  }
  return found;
}

}  // namespace trueflank::loop
