// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

// Looks for structure in residuals that run along something: traces of many teeth over the same
// places. Knows nothing of gears.
namespace trueflank::loop {

/// What was found along the courses. Places and lengths are shares of the course.
struct CourseFinding {
  enum class Kind {
    kStep,      ///< common to all: the courses jump at `at`
    kBand,      ///< common to all: exp(-((x - at) / width)^2)
    kWave,      ///< common to all, of wavelength `width`, in phase
    kOwnWaves,  ///< every course has the wave of length `width`, each in a phase of its own
    kSpot,      ///< one course stands out about `at` over `width`
    kKink       ///< common to all: straight to `at` and on in another direction
  };
  Kind kind = Kind::kBand;
  double p_value = 1.0;  ///< corrected for all that was looked at in the call
  int set = -1;          ///< of the sets; -1: their mean; -2: half the difference of two (steps)
  int course = -1;       ///< kSpot: of the set
  std::vector<int> holders;  ///< kOwnWaves: courses of the set, where few of them have the waves
  double at = 0.0, width = 0.0;
  double square = 0.0;  ///< squares it takes out of all courses, a spot of its own; no own waves
  double amount = 0.0;  ///< height of the step or band, of the kink at its end, amplitude of the
                        ///< wave, mean of the spot
  double before = 0.0, beyond = 0.0;  ///< kKink: slopes to either side
  bool beside_line = false;  ///< steps and bands that were sought beside a straight line

  /// Where a kink leaves the straight line: before its place -1, beyond it 1, to both sides alike
  /// 0.
  [[nodiscard]] double side_of_kink() const;
};

/// Of two findings that are both beyond doubt the one that takes out more is the better
/// description; else the more certain one.
[[nodiscard]] bool is_better(double p_value, double square, double than_p_value,
                             double than_square);

/// Looks through sets of courses (one a column, the same places in the rows, each of zero mean)
/// whose random errors are alike. The most certain finding of every kind, p values below 1 only.
/// The error's spectrum is told from how the courses of a set differ from each other, so errors
/// that hang together along a course are no finding; waves of their own are judged against the
/// spectrum beside them, spots against windows of the same width everywhere else. Scanning is paid
/// for by Bonferroni. Requires: at least 12 rows; sets with fewer than two courses are asked for
/// waves alone.
[[nodiscard]] std::vector<CourseFinding> scan_courses(const std::vector<Eigen::MatrixXd>& sets);

}  // namespace trueflank::loop
