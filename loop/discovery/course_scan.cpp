// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/course_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/course_forms.h"
#include "trueflank/loop/discovery/course_waves.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/nicks.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/discovery/window_roughness.h"

namespace trueflank::loop {
namespace {

using CourseKind = CourseFinding::Kind;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Spectra are smoothed until so many degrees of freedom tell each value.
constexpr double kDegrees = 24.0, kMostDegrees = 200.0;
/// Gauges filter their traces. What little stands at the wavelengths that a filter took away is no
/// line: it counts from this share of what errors without a filter would have at each wavelength.
/// The longest waves, forms rather than errors, do not say how large those are.
constexpr double kFilteredAway = 0.1;
constexpr Index kLongest = 2;  // less than so many on the course
/// Wild points count no more than so many spreads.
constexpr double kClip = 3.5;

bool is_beyond_doubt(double p_value) { return p_value < 1e-8; }

class CourseScan {
 public:
  explicit CourseScan(const std::vector<MatrixXd>& sets) : sets_(sets), m_(sets.front().rows()) {
    for (const MatrixXd& set : sets_) louds_.push_back(loudness(set));
    tell_noise();
    tell_louder_of_few();
    std::vector<std::vector<double>> scatters;
    for (const Louder& of_set : louds_) scatters.push_back(of_set.scatters);
    loud_places_ = loudness_of_places(sets_, scatters);
    clip();
    tell_spectrum();
  }

  std::vector<CourseFinding> run() {
    if (degrees_ >= 8.0) {
      std::vector<int> asked;
      for (int s = 0; s < static_cast<int>(sets_.size()); ++s)
        if (sets_[s].cols() >= 2) asked.push_back(s);
      const bool two = asked.size() == 2 && sets_.size() == 2;
      if (asked.size() > 1) asked.push_back(kMean);
      std::vector<Common> commons;
      for (const int set : asked) commons.push_back(common(set));
      measure_waves(commons);
      for (const Common& one : commons) look_for_common(one);
      if (two) look_for_opposite_step();
      look_beside_lines(commons, two);
      count_ = static_cast<double>(asked.size());
      // Two kinds of question, localised and wavelike, share the level.
      keep(step_, 2.0 * (count_ + (two ? 1.0 : 0.0)) * forms_);
      for (const Best* best : {&kink_, &band_}) keep(*best, 2.0 * count_ * forms_);
      keep_beside_lines(2.0 * (count_ + (two ? 1.0 : 0.0)) * forms_);
      keep(wave_, 2.0 * count_ * frequencies_);
    }
    look_for_own_waves();
    look_for_spots();
    return std::move(found_);
  }

 private:
  /// Of the forms of a kind beside the straight line the one that takes out most.
  struct Surest {
    const CourseForm* form = nullptr;
    double square = 0.0, score = 0.0, t = 0.0;
  };
  /// The best of a kind, and where that stands in one set alone the best of what all have in common:
  /// a line that rises in one set and falls in the other hides in these.
  struct Best {
    CourseFinding of_all, in_common;
    double t = 0.0, t_in_common = 0.0;
  };
  void keep(const Best& best, double tests) {
    keep(best.of_all, tests);
    if (best.of_all.set >= 0 && is_beyond_doubt(best.in_common.p_value)) keep(best.in_common, tests);
  }
  void keep(CourseFinding finding, double tests) {
    if (!(tests > 0.0)) return;
    finding.p_value *= tests;
    if (finding.p_value < 1.0) found_.push_back(finding);
  }

  /// One set may be measured worse: where its courses scatter more by more than chance, it has an
  /// error of its own.
  void tell_noise() {
    constexpr double kSure = 4.0, kMore = 1.3;
    noise_.assign(sets_.size(), 1.0);
    double squares = 0.0, degrees = 0.0, least = 1e300, most = 0.0, fewest = 1e300;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      std::vector<double> scatters = louds_[s].scatters;
      const double own = scatters.empty() ? 0.0 : median(scatters);
      const auto courses = static_cast<double>(sets_[s].cols());
      if (!(own > 0.0) || courses < 2.0) return;
      noise_[s] = own;
      squares += (courses - 1.0) * own * own;
      degrees += courses - 1.0;
      least = std::min(least, own);
      most = std::max(most, own);
      fewest = std::min(fewest, courses * static_cast<double>(m_));
    }
    const double by_chance = kSure * std::sqrt(2.0 * kVarianceOfLogScatter / fewest);
    if (std::log(most / least) < std::max(std::log(kMore), by_chance)) {
      noise_.assign(sets_.size(), 1.0);
      return;
    }
    for (double& noise : noise_) noise /= std::sqrt(squares / degrees);
  }

  void clip() {
    std::vector<double> all;
    for (std::size_t s = 0; s < sets_.size(); ++s)
      for (const double value : (sets_[s].array().colwise() / loud_places_.array()).reshaped())
        all.push_back(value / noise_[s]);
    const double usual = kClip * robust_sigma(all);
    for (double& value : all) value = std::clamp(value, -usual, usual);
    excess_ = excess_kurtosis(all);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const MatrixXd& set = sets_[s];
      const MatrixXd limit = (usual * noise_[s] * loud_places_).replicate(1, set.cols());
      clipped_.push_back(set.cwiseMax(-limit).cwiseMin(limit));
      mean_.push_back(set.cols() > 0 ? VectorXd(set.rowwise().mean()) : VectorXd::Zero(m_));
      mean_.back().array() -= mean_.back().mean();
      courses_ += static_cast<double>(set.cols());
    }
  }

  /// Variance of every cosine's coefficient in one course, from how courses of a set scatter.
  void tell_spectrum() {
    const MatrixXd& basis = forms_of_rows(m_).basis;
    VectorXd squares = VectorXd::Zero(m_);
    double degrees = 0.0;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (sets_[s].cols() < 2) continue;
      const MatrixXd apart = sets_[s].colwise() - sets_[s].rowwise().mean();
      squares += (basis * apart).rowwise().squaredNorm();
      degrees += static_cast<double>(sets_[s].cols() - 1);
    }
    spectrum_ = VectorXd::Zero(m_);
    if (degrees < 1.0) return;
    Index half = 0;
    while (degrees * static_cast<double>(2 * half + 1) < kDegrees && half < m_ / 6) ++half;
    degrees_ = std::min(kMostDegrees, degrees * static_cast<double>(half + 1));
    for (Index k = 1; k < m_; ++k) {
      const Index from = std::max<Index>(1, k - half), to = std::min<Index>(m_ - 1, k + half);
      spectrum_[k] = squares.segment(from, to - from + 1).mean() / degrees;
    }
    const double least = kFilteredAway * spectrum_.tail(m_ - 2 * kLongest).mean();
    spectrum_ = spectrum_.cwiseMax(least);
  }

  /// What the courses of a set, or of all sets, have in common.
  struct Common {
    int set = -1;
    VectorXd mean;
    double courses = 0.0;            ///< as many of the usual error
    std::vector<double> amplitudes;  ///< of kWaveStep apart numbers of waves
  };
  static constexpr double kFewestWaves = 2.0, kWaveStep = 0.25;
  [[nodiscard]] double most_waves() const { return 0.42 * static_cast<double>(m_); }

  static constexpr int kMean = -1, kHalfDifference = -2;
  [[nodiscard]] Common common(int set) const {
    if (set >= 0)
      return {set,
              mean_[set],
              static_cast<double>(sets_[set].cols()) / (noise_[set] * noise_[set]),
              {}};
    VectorXd sum = VectorXd::Zero(m_);
    double inverse = 0.0, n = 0.0;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (sets_[s].cols() < 2) continue;
      sum += mean_[s];
      inverse += noise_[s] * noise_[s] / static_cast<double>(sets_[s].cols());
      n += 1.0;
    }
    return {set, sum / n, n * n / inverse, {}};
  }

  /// The cosines and sines of a wave are computed once for all.
  void measure_waves(std::vector<Common>& commons) {
    frequencies_ = std::floor((most_waves() - kFewestWaves) / kWaveStep) + 1.0;
    if (!(frequencies_ > 0.0)) return;
    const auto waves = static_cast<std::size_t>(frequencies_);
    for (Common& one : commons) one.amplitudes.resize(waves);
    constexpr std::size_t kAtOnce = 16;
    for_each_run(waves, kAtOnce, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const Wave wave = wave_of(kFewestWaves + kWaveStep * static_cast<double>(k));
        for (Common& one : commons) one.amplitudes[k] = amplitude_of(one.mean, wave);
      }
    });
  }

  void look_for_common(const Common& one) {
    const VectorXd variance = spectrum_ / one.courses;
    const std::vector<CourseForm>& forms = forms_of_rows(m_).forms;
    forms_ = static_cast<double>(forms.size());
    for (const CourseForm& form : forms)
      judge(form, one.set, 1.0 / one.courses, one.mean, variance);
    look_for_common_wave(one, variance);
  }

  /// Of a band: there it is a kink or a rise.
  [[nodiscard]] bool reaches_an_end(const CourseForm& form) const {
    return form.kind == CourseKind::kBand &&
           (form.at < form.width || form.at + form.width > static_cast<double>(m_));
  }

  /// What stands beside a slope, of one set or of all: without the line it is where it is, with it it
  /// would be sought elsewhere.
  void look_beside_lines(const std::vector<Common>& commons, bool two) {
    const auto look = [&](const VectorXd& mean, double courses, int set) {
      const VectorXd variance = spectrum_ / courses;
      for (const CourseForm& form : forms_of_rows(m_).forms) {
        if (form.kind == CourseKind::kKink || reaches_an_end(form) ||
            (set == kHalfDifference && form.kind != CourseKind::kStep))
          continue;
        std::map<int, Surest>& surest =
            form.kind == CourseKind::kStep ? steps_beside_ : bands_beside_;
        Surest& best = surest[set];
        const double score = form.beside_line.dot(mean);
        const double square = score * score / form.square_beside_line * courses;
        if (!(square > best.square)) continue;
        best = {&form, square, score,
                std::abs(score / std::sqrt(form.powers_beside_line.dot(variance)))};
      }
    };
    for (const Common& one : commons) look(one.mean, one.courses, one.set);
    if (two) look(0.5 * (mean_[0] - mean_[1]), common(kMean).courses, kHalfDifference);
  }

  void keep_beside_lines(double tests) {
    const auto keep_at = [&](const Surest& of, int set) {
      const double p = student_two_sided(of.t, degrees_), m = static_cast<double>(m_);
      if (!is_beyond_doubt(p)) return;
      keep({.kind = of.form->kind,
            .p_value = p,
            .set = set,
            .at = of.form->at / m,
            .width = of.form->width / m,
            .square = of.square,
            .amount = of.score / of.form->square_beside_line,
            .beside_line = true},
           tests);
    };
    for (const std::map<int, Surest>* kind : {&steps_beside_, &bands_beside_})
      for (const auto& [set, of] : *kind) {
        if (of.form == nullptr) continue;
        if (set != kHalfDifference) {
          keep_at(of, set);
          continue;
        }
        // Where one set alone steps, half of it is in the difference.
        keep_at(of, 0);
        keep_at(of, 1);
      }
  }

  /// Halves that are turned against each other step up on one flank and down on the other.
  void look_for_opposite_step() {
    Common apart = common(kMean);
    apart.mean = 0.5 * (mean_[0] - mean_[1]);
    const VectorXd variance = spectrum_ / apart.courses;
    for (const CourseForm& form : forms_of_rows(m_).forms)
      if (form.kind == CourseKind::kStep)
        judge(form, kHalfDifference, 1.0 / apart.courses, apart.mean, variance);
  }

  /// `scale`: variance of the mean over that of one course.
  void judge(const CourseForm& form, int set, double scale, const VectorXd& mean,
             const VectorXd& variance) {
    Best& best = form.kind == CourseKind::kStep   ? step_
                 : form.kind == CourseKind::kKink ? kink_
                                                  : band_;
    const double score = form.values.dot(mean);
    const double t = std::abs(score / std::sqrt(form.powers.dot(variance)));
    const double square = score * score / form.square / scale;
    // The p-value falls with t: most forms are told from the best one without it.
    const auto is_worth_asking = [&](const CourseFinding& than, double than_t) {
      return is_beyond_doubt(than.p_value) ? square > than.square : t >= than_t * (1.0 - 1e-9);
    };
    const bool ask_all = is_worth_asking(best.of_all, best.t),
               ask_common = set < 0 && is_worth_asking(best.in_common, best.t_in_common);
    if (!ask_all && !ask_common) return;
    const double p = student_two_sided(t, degrees_);
    const auto take = [&](CourseFinding& than, double& than_t) {
      if (!is_better(p, square, than.p_value, than.square)) return;
      than = finding_of(form, set, p, square, score, mean);
      than_t = t;
    };
    if (ask_all) take(best.of_all, best.t);
    if (ask_common) take(best.in_common, best.t_in_common);
  }
  [[nodiscard]] CourseFinding finding_of(const CourseForm& form, int set, double p, double square,
                                         double score, const VectorXd& mean) const {
    const double m = static_cast<double>(m_);
    CourseFinding found{.kind = form.kind,
                        .p_value = p,
                        .set = set,
                        .at = form.at / m,
                        .width = form.width / m,
                        .square = square,
                        .amount = score / form.square};
    if (form.kind != CourseKind::kKink) return found;
    // The form is beside the straight line: of that the mean has a slope of its own.
    const VectorXd line = VectorXd::LinSpaced(m_, -1.0, 1.0);
    const double bend = found.amount / (1.0 - found.at);
    const VectorXd straight = mean - found.amount * form.values;
    const double common = 2.0 * line.dot(straight) / line.squaredNorm() * m / (m - 1.0);
    found.before = common - bend * form.line_slope;
    found.beyond = found.before + bend;
    return found;
  }

  void look_for_common_wave(const Common& one, const VectorXd& variance) {
    constexpr double kFinest = 0.01;
    const double scale = 1.0 / one.courses;
    double best = 0.0;
    const auto judge_wave = [&](double f, double amplitude) {
      const double half = 0.5 * static_cast<double>(m_);
      const auto k = std::min<Index>(m_ - 1, std::lround(2.0 * f));
      const double p = f_tail(0.5 * half * amplitude * amplitude / variance[k], 2.0, degrees_);
      const double square = half * amplitude * amplitude / scale;
      if (!is_better(p, square, wave_.p_value, wave_.square)) return;
      wave_ = {.kind = CourseKind::kWave,
               .p_value = p,
               .set = one.set,
               .width = 1.0 / f,
               .square = square,
               .amount = amplitude};
      best = f;
    };
    for (std::size_t k = 0; k < one.amplitudes.size(); ++k)
      judge_wave(kFewestWaves + kWaveStep * static_cast<double>(k), one.amplitudes[k]);
    for (double step = 0.5 * kWaveStep; best > 0.0 && step > kFinest; step *= 0.5) {
      const double middle = best;
      for (const double f : {middle - step, middle + step})
        judge_wave(f, amplitude_of(one.mean, wave_of(f)));
    }
  }

  struct Wave {
    VectorXd cosine, sine;
  };
  [[nodiscard]] Wave wave_of(double waves) const {
    Wave wave{VectorXd(m_), VectorXd(m_)};
    for (Index i = 0; i < m_; ++i) {
      const double angle =
          kTwoPi * waves * (static_cast<double>(i) + 0.5) / static_cast<double>(m_);
      wave.cosine[i] = std::cos(angle);
      wave.sine[i] = std::sin(angle);
    }
    return wave;
  }
  [[nodiscard]] double amplitude_of(const VectorXd& mean, const Wave& wave) const {
    double cosine = 0.0, sine = 0.0;
    for (Index i = 0; i < m_; ++i) {
      cosine += mean[i] * wave.cosine[i];
      sine += mean[i] * wave.sine[i];
    }
    return std::hypot(cosine, sine) / (0.5 * static_cast<double>(m_));
  }

  void look_for_own_waves() {
    std::vector<VectorXd> loud;
    for (const Louder& of_set : louds_) loud.push_back(of_set.by);
    double tests = 0.0;
    const CourseFinding waves = own_waves(sets_, loud, tests);
    keep(waves, tests);
    // The other sets may have them too.
    constexpr double kSure = 1e-4, kAlike = 0.1;
    if (waves.set < 0 || tests * waves.p_value > kSure) return;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (static_cast<int>(s) == waves.set) continue;
      double own_tests = 0.0;
      CourseFinding own = own_waves({sets_[s]}, {loud[s]}, own_tests);
      own.set = static_cast<int>(s);
      if (own_tests * own.p_value <= kSure &&
          std::abs(own.width - waves.width) < kAlike * waves.width)
        keep(own, own_tests);
    }
  }

  /// How much louder than the usual course each course of a set is; a quiet one may be so by chance.
  struct Louder {
    VectorXd by;
    double degrees = 0.0;
    std::vector<double> scatters;
  };
  [[nodiscard]] Louder loudness(const MatrixXd& set) const {
    std::vector<double> scatters;
    for (Index c = 0; c < set.cols(); ++c) scatters.push_back(short_wave_scatter(set.col(c)));
    const Loudness loud =
        loudness_of(scatters, std::vector(scatters.size(), static_cast<double>(m_)));
    return {Eigen::Map<const VectorXd>(loud.factors.data(), set.cols()).cwiseMax(1.0), loud.degrees,
            std::move(scatters)};
  }

  /// Of few courses, those of all sets together tell which are louder.
  void tell_louder_of_few() {
    constexpr Index kFew = 5;
    std::vector<double> scatters;
    for (std::size_t s = 0; s < sets_.size(); ++s)
      for (const double scatter : louds_[s].scatters) scatters.push_back(scatter / noise_[s]);
    const Loudness loud =
        loudness_of_few(scatters, std::vector(scatters.size(), static_cast<double>(m_)));
    Index first = 0;
    for (std::size_t s = 0; s < sets_.size(); first += sets_[s].cols(), ++s) {
      if (sets_[s].cols() >= kFew) continue;
      louds_[s].by =
          Eigen::Map<const VectorXd>(loud.factors.data() + first, sets_[s].cols()).cwiseMax(1.0);
      louds_[s].degrees = loud.degrees;
    }
  }

  /// Takes off every course what it has where all courses are as loud as usual, if some places are
  /// louder: there their means would be errors of the others.
  void take_quiet_mean_off(MatrixXd& apart) const {
    if (loud_places_.maxCoeff() == 1.0) return;
    const VectorXd known = loud_places_.cwiseAbs2().cwiseInverse();
    apart.rowwise() -= (known.transpose() * apart / known.sum()).eval();
  }

  /// By how much louder than usual windows of so many rows are.
  [[nodiscard]] VectorXd loudness_of_windows(Index width) const {
    VectorXd loud(m_ - width + 1);
    for (Index i = 0; i < loud.size(); ++i)
      loud[i] = std::sqrt(loud_places_.segment(i, width).cwiseAbs2().mean());
    return loud;
  }

  /// Courses less what is usual in each of them and at each place in all: where every one of few
  /// has a deep spot, a mean would be moved by these.
  [[nodiscard]] static MatrixXd apart_from_usual(const MatrixXd& set) {
    MatrixXd apart = set;
    const auto middle_of = [](const auto& values) {
      std::vector<double> sorted(values.begin(), values.end());
      std::sort(sorted.begin(), sorted.end());
      return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
    };
    if (apart.cols() > 2) {
      VectorXd usual(apart.rows());
      for (Index i = 0; i < apart.rows(); ++i) usual[i] = middle_of(apart.row(i));
      apart.colwise() -= usual;
    }
    for (Index c = 0; c < apart.cols(); ++c) apart.col(c).array() -= middle_of(apart.col(c));
    return apart;
  }

  /// True of a set in which courses have waves of their own: their crests are no spots.
  [[nodiscard]] bool has_own_waves(int set) const {
    constexpr double kSure = 1e-3;
    return std::any_of(found_.begin(), found_.end(), [&](const CourseFinding& one) {
      return one.kind == CourseKind::kOwnWaves && one.set == set && one.p_value < kSure;
    });
  }

  /// Windows in which a course stands apart: with wild points clipped; or as it is, where it runs
  /// there as smoothly as elsewhere.
  void look_for_spots() {
    // Slow errors, louder courses and single teeth far out have longer tails than windows of
    // clipped values.
    constexpr double kTailOfSlow = 12.0, kTailOfQuick = 50.0, kSlow = 0.4;
    std::vector<MatrixXd> clipped, whole;
    std::vector<Roughness> roughness_of_whole;
    std::vector<double> alike;  // neighbours of each set
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      // (a deep spot on one of few courses would stand in the plain mean)
      MatrixXd apart = clipped_[s];
      if (apart.cols() > 2) {
        VectorXd common = apart.rowwise().mean();
        common.array() -= common.mean();
        apart.colwise() -= common;
      }
      take_quiet_mean_off(apart);
      clipped.push_back(std::move(apart));
      whole.push_back(apart_from_usual(sets_[s]));
      alike.push_back(likeness_of_neighbours(whole.back()));
      roughness_of_whole.push_back(roughness_of(whole.back()));
    }
    CourseFinding best{CourseKind::kSpot};
    double tests = 0.0;
    for (Index width = 4; width <= m_ / 3; width = width * 8 / 5)
      for (const bool clip : {true, false}) {
        std::vector<double> all;
        std::vector<MatrixXd> windows;
        std::vector<double> spreads;  // of each set: one may be noisier
        constexpr double kEnough = 40.0;
        const double apart_each = static_cast<double>(m_) / static_cast<double>(width);
        const VectorXd loud_windows = loudness_of_windows(width);
        for (std::size_t s = 0; s < sets_.size(); ++s) {
          const MatrixXd& apart = clip ? clipped[s] : whole[s];
          MatrixXd sums(m_ - width + 1, apart.cols());
          for (Index i = 0; i + width <= m_; ++i)
            sums.row(i) = apart.middleRows(i, width).colwise().mean();
          sums.array().rowwise() /= noise_[s] * louds_[s].by.transpose().array();
          MatrixXd rough = loud_windows.replicate(1, sums.cols());
          if (!clip && sums.size() > 0)
            rough = rough.cwiseMax(roughness_in_windows(roughness_of_whole[s], width));
          sums.array() /= rough.array();
          all.insert(all.end(), sums.data(), sums.data() + sums.size());
          spreads.push_back(
              static_cast<double>(sums.cols()) * apart_each < kEnough
                  ? 0.0
                  : robust_sigma(std::vector(sums.data(), sums.data() + sums.size())));
          windows.push_back(std::move(sums));
        }
        // Too few windows apart from each other tell no spread.
        if (courses_ * apart_each < kEnough) break;
        tests += static_cast<double>(all.size());
        const double of_all = robust_sigma(std::move(all));
        for (int s = 0; s < static_cast<int>(windows.size()) && of_all > 0.0; ++s) {
          const double own = spreads[static_cast<std::size_t>(s)],
                       spread = own > 0.0 ? own : of_all;
          Index row = 0, column = 0;
          if (windows[s].size() == 0) continue;
          const double most = windows[s].cwiseAbs().maxCoeff(&row, &column);
          const double normal =
              normal_two_sided(most / spread, excess_ / static_cast<double>(width));
          double p = std::max(
              normal,
              least_chance(most / spread, louds_[static_cast<std::size_t>(s)].degrees, normal));
          const auto set = static_cast<std::size_t>(s);
          const bool as_usual =
              alike[set] < kSlow && louds_[set].by[column] == 1.0 && !has_own_waves(s);
          if (!clip)
            p = std::max(p,
                         student_two_sided(most / spread, as_usual ? kTailOfQuick : kTailOfSlow));
          if (!(p < best.p_value)) continue;
          best.p_value = p;
          best.set = s;
          best.course = static_cast<int>(column);
          best.at = (static_cast<double>(row) + 0.5 * static_cast<double>(width)) /
                    static_cast<double>(m_);
          best.width = static_cast<double>(width) / static_cast<double>(m_);
          best.amount = sets_[s].col(column).segment(row, width).mean();
          best.square = static_cast<double>(width) * best.amount * best.amount;
        }
      }
    keep(best, tests);
    for (std::size_t s = 0; s < whole.size(); ++s)
      whole[s] = (whole[s].array().rowwise() / louds_[s].by.transpose().array()).colwise() /
                 loud_places_.array();
    if (const auto nick = nick_of(whole, alike)) keep(*nick, 1.0);
  }

  const std::vector<MatrixXd>& sets_;
  Index m_;
  std::vector<MatrixXd> clipped_;
  std::vector<VectorXd> mean_;
  std::vector<Louder> louds_;
  std::vector<double> noise_;  ///< of each set, over that of all
  VectorXd loud_places_;       ///< 1, or by how much louder a row is in all courses
  VectorXd spectrum_;
  double excess_ = 0.0;  ///< kurtosis of single values
  double degrees_ = 0.0, courses_ = 0.0, count_ = 0.0, forms_ = 0.0, frequencies_ = 0.0;
  Best step_{{CourseKind::kStep}, {CourseKind::kStep}}, kink_{{CourseKind::kKink}, {CourseKind::kKink}},
      band_{{CourseKind::kBand}, {CourseKind::kBand}};
  CourseFinding wave_{CourseKind::kWave};
  std::map<int, Surest> steps_beside_, bands_beside_;  ///< of every set, the mean and the difference
  std::vector<CourseFinding> found_;
};

}  // namespace

double CourseFinding::side_of_kink() const {
  constexpr double kAlike = 0.3;
  const double slopes = std::abs(before) + std::abs(beyond);
  if (std::abs(before + beyond) < kAlike * slopes) return 0.0;
  return std::abs(before) > std::abs(beyond) ? -1.0 : 1.0;
}

bool is_better(double p_value, double square, double than_p_value, double than_square) {
  const bool sure = is_beyond_doubt(p_value), than_sure = is_beyond_doubt(than_p_value);
  return sure && than_sure ? square > than_square : p_value < than_p_value;
}

std::vector<CourseFinding> scan_courses(const std::vector<MatrixXd>& sets) {
  constexpr Index kFewest = 12;
  if (sets.empty() || sets.front().rows() < kFewest) return {};
  return CourseScan(sets).run();
}

}  // namespace trueflank::loop
