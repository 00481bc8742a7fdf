// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/random_error.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/discovery/own_relief.h"
#include "trueflank/loop/gear/local/reading_steps.h"
#include "trueflank/loop/gear/scanned_flanks.h"

namespace trueflank::loop {
namespace {

struct Class {
  int source = 0;
  ObservationKind kind = ObservationKind::kProfile;
  auto operator<=>(const Class&) const = default;
};

struct Sample {
  double u = 0.0, v = 0.0, um = 0.0;
  bool held_out = false;
};

/// Of one trace.
using Whole = std::vector<Sample>;

/// Takes off what all wholes of a flank have in common, place by place; how much variance that
/// cost.
double take_common_off(std::vector<Whole*>& wholes, int parts_u, int parts_v) {
  struct Mean {
    double sum = 0.0, count = 0.0;
  };
  std::vector<Mean> means(static_cast<std::size_t>(parts_u * parts_v));
  const auto part = [](double c, int parts) {
    return std::clamp(static_cast<int>(0.5 * (c + 1.0) * parts), 0, parts - 1);
  };
  const auto at = [&](const Sample& s) -> Mean& {
    return means[static_cast<std::size_t>(part(s.u, parts_u) * parts_v + part(s.v, parts_v))];
  };
  double values = 0.0, used = 0.0;
  for (Whole* whole : wholes)
    for (const Sample& s : *whole) {
      at(s).sum += s.um;
      at(s).count += 1.0;
      values += 1.0;
    }
  for (const Mean& mean : means) used += mean.count > 0.0 ? 1.0 : 0.0;
  if (used > 0.5 * values) return 1.0;
  for (Whole* whole : wholes)
    for (Sample& s : *whole) s.um -= at(s).sum / at(s).count;
  return values / (values - used);
}

/// What stands beside a line in a spectrum, the larger of both sides; the line itself where it is
/// near an end: it stands above both sides, the rise to long waves above one.
double beside_line(const std::vector<double>& level, int line) {
  constexpr int kNear = 4, kFar = 10;
  const auto n = static_cast<int>(level.size());
  std::vector<double> before, after;
  for (int off = kNear; off <= kFar; ++off) {
    if (line - off >= 0) before.push_back(level[static_cast<std::size_t>(line - off)]);
    if (line + off < n) after.push_back(level[static_cast<std::size_t>(line + off)]);
  }
  return before.size() > 2 && after.size() > 2 ? std::max(median(before), median(after))
                                               : level[static_cast<std::size_t>(line)];
}

/// Sum of a spectrum in which a line counts as what stands beside it: waves of one length that
/// every trace has in a phase of its own are no random error, whose spectrum is smooth.
double sum_without_lines(const std::vector<double>& level) {
  constexpr double kLine = 3.0;
  double sum = 0.0;
  for (int k = 0; k < static_cast<int>(level.size()); ++k) {
    const double own = level[static_cast<std::size_t>(k)], beside = beside_line(level, k);
    sum += own > kLine * beside ? beside : own;
  }
  return sum;
}

/// Traces in pieces, what stands in them side by side.
struct Pieces {
  std::vector<Eigen::VectorXd> courses;
  std::vector<double> values, held_out;  ///< how many
};
Pieces pieces_of(std::vector<Whole>& wholes) {
  constexpr std::size_t kFewest = 12;
  constexpr std::size_t kLongest =
      256;  // longer ones are cut: what varies slower is no neighbourhood
  Pieces pieces;
  for (Whole& whole : wholes) {
    std::sort(whole.begin(), whole.end(),
              [](const auto& a, const auto& b) { return a.u + a.v < b.u + b.v; });
    for (std::size_t from = 0; from < whole.size(); from += kLongest) {
      const std::size_t to = std::min(whole.size(), from + kLongest);
      if (to - from < kFewest) continue;
      Eigen::VectorXd& piece = pieces.courses.emplace_back(static_cast<Eigen::Index>(to - from));
      pieces.values.push_back(static_cast<double>(to - from));
      pieces.held_out.push_back(0.0);
      for (std::size_t i = from; i < to; ++i) {
        piece[static_cast<Eigen::Index>(i - from)] = whole[i].um;
        pieces.held_out.back() += whole[i].held_out ? 1.0 : 0.0;
      }
    }
  }
  return pieces;
}

/// Takes a line and a bow off a course.
void take_trend_off(Eigen::VectorXd& course) {
  const Eigen::Index n = course.size();
  Eigen::MatrixXd forms(n, 3);
  forms.col(0).setOnes();
  forms.col(1).setLinSpaced(-1.0, 1.0);
  forms.col(2) = forms.col(1).cwiseAbs2();
  forms.col(2).array() -= forms.col(2).mean();
  for (Eigen::Index k = 0; k < 3; ++k)
    course -= forms.col(k).dot(course) / forms.col(k).squaredNorm() * forms.col(k);
}

/// Long waves that every trace has for itself count as the short ones do.
void take_smooth_forms_off(std::vector<double>& level) {
  const std::size_t from = level.size() / 3;
  const double error =
      median(std::vector<double>(level.begin() + static_cast<std::ptrdiff_t>(from), level.end()));
  for (std::size_t k = 0; k < from; ++k) level[k] = std::min(level[k], error);
}

/// Of a wave of so many periods over a course: what it takes out of all, each in a phase of its
/// own; it is taken off where that is asked for.
double take_waves(std::vector<Eigen::VectorXd>& courses, double periods, bool off) {
  double square = 0.0;
  for (Eigen::VectorXd& course : courses) {
    const Eigen::Index n = course.size();
    const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(n, 0.5, static_cast<double>(n) - 0.5) *
                                 (kTwoPi * periods / static_cast<double>(n));
    Eigen::MatrixXd wave(n, 2);
    wave.col(0) = angle.cos();
    wave.col(1) = angle.sin();
    const Eigen::Vector2d right = wave.transpose() * course,
                          size = (wave.transpose() * wave).ldlt().solve(right);
    square += right.dot(size);
    if (off) course -= wave * size;
  }
  return square;
}

/// Where a wave of one length stands far above all beside it in the spectrum, of whole and half
/// periods from one half on: how many periods there are. Its foot would be taken for the error's
/// long and short waves.
std::optional<double> periods_of_tall_line(const std::vector<double>& level,
                                           std::vector<Eigen::VectorXd>& courses) {
  constexpr double kTall = 12.0, kShare = 0.3;
  if (level.empty()) return {};
  int line = 0;
  double tallest = kTall;
  for (int k = 0; k < static_cast<int>(level.size()); ++k)
    if (const double tall = level[static_cast<std::size_t>(k)] / beside_line(level, k);
        tall > tallest) {
      tallest = tall;
      line = k;
    }
  if (line == 0) return {};
  const double near = 0.5 * (line + 1);
  double best = near, square = 0.0, all = 0.0;
  for (double periods = near - 1.5; periods <= near + 1.5; periods += 0.05)
    if (const double here = take_waves(courses, periods, false); here > square) {
      square = here;
      best = periods;
    }
  for (const Eigen::VectorXd& course : courses)
    all += (course.array() - course.mean()).matrix().squaredNorm();
  if (square < kShare * all) return {};
  return best;
}

/// What every trace has for itself.
struct OwnCourses {
  bool trends = false, smooth = false;
};

/// Squares at every length of waves, from n / 1 on: the median over the courses and the lengths
/// beside.
std::vector<double> levels_of(const std::vector<Eigen::VectorXd>& courses, int n) {
  constexpr int kBeside = 2;
  std::vector<Eigen::VectorXd> spectra;
  for (const Eigen::VectorXd& course : courses) spectra.push_back(cosine_spectrum(course));
  std::vector<double> level;
  for (int k = 1; k < n; ++k) {
    std::vector<double> squares;
    for (const Eigen::VectorXd& s : spectra)
      for (int off = -kBeside; off <= kBeside; ++off) {
        const auto at =
            static_cast<Eigen::Index>(std::lround((k + off) * static_cast<double>(s.size()) / n));
        if (k + off >= 1 && at >= 1 && at < s.size()) squares.push_back(s[at]);
      }
    level.push_back(median(squares) / kMedianOfSquare);
  }
  return level;
}

/// Variance of traces over the same wavelengths; some may be measured worse than others. Where
/// they have trends or smooth forms of their own, what errors have of these is taken from the
/// wavelengths beside.
Variance variance_of_traces(std::vector<Whole>& wholes, double lost, const OwnCourses& own) {
  // (what a trend taken off smooth forms leaves would show at every length)
  const bool own_trends = own.trends && !own.smooth;
  constexpr std::size_t kOfTrends = 2;
  Pieces pieces = pieces_of(wholes);
  if (own_trends)
    for (Eigen::VectorXd& piece : pieces.courses) take_trend_off(piece);
  if (pieces.courses.empty()) return {};
  std::vector<double> scatters;
  Eigen::Index shortest = pieces.courses.front().size();
  for (const Eigen::VectorXd& piece : pieces.courses) {
    scatters.push_back(short_wave_scatter(piece));
    shortest = std::min(shortest, piece.size());
  }
  const std::vector<double> loud = loudness_of_few(scatters, pieces.values).factors;
  for (std::size_t i = 0; i < loud.size(); ++i) pieces.courses[i] /= loud[i];
  // Wavelengths in shares of the shortest course; k = 0 is the trace's zero.
  const auto n = static_cast<int>(shortest);
  std::vector<double> level = levels_of(pieces.courses, n);
  constexpr int kMostLines = 3;
  for (int line = 0; line < kMostLines; ++line) {
    const std::optional<double> periods = periods_of_tall_line(level, pieces.courses);
    if (!periods) break;
    take_waves(pieces.courses, *periods, true);
    lost *= static_cast<double>(n) / (n - 2);
    level = levels_of(pieces.courses, n);
  }
  if (own_trends && level.size() > 2 * kOfTrends)
    std::fill_n(
        level.begin(), kOfTrends,
        median(std::vector<double>(level.begin() + kOfTrends, level.begin() + 2 * kOfTrends + 1)));
  if (own.smooth) take_smooth_forms_off(level);
  return of_louder(lost * sum_without_lines(level) / (n - 1), loud, pieces.values, pieces.held_out);
}

/// One value a tooth: second differences around the gear, each flank apart.
double variance_around(const std::map<int, double>& by_tooth) {
  std::vector<double> squares;
  for (const auto& [tooth, um] : by_tooth) {
    const auto before = by_tooth.find(tooth - 1), after = by_tooth.find(tooth + 1);
    if (before == by_tooth.end() || after == by_tooth.end()) continue;
    const double d = before->second - 2.0 * um + after->second;
    squares.push_back(d * d / 6.0);
  }
  if (squares.empty()) return 0.0;
  return median(squares) / kMedianOfSquare;
}

/// One value a tooth, where the two flanks of each tooth or gap stand out alike or opposite: the
/// half of what else they differ by.
double variance_beside(const std::array<std::map<int, double>, 2>& sides, const OwnPlaces& places,
                       int teeth) {
  std::vector<double> rest;
  for (const auto& [tooth, last] : sides[1]) {
    const int number = places.of_gaps ? tooth % teeth + 1 : tooth;
    if (const auto first = sides[0].find(number); first != sides[0].end())
      rest.push_back(first->second + (places.opposite ? last : -last));
  }
  if (rest.size() < 3) return 0.0;
  const auto n = static_cast<double>(rest.size());
  double mean = 0.0, square = 0.0;
  for (const double um : rest) mean += um / n;
  for (const double um : rest) square += (um - mean) * (um - mean);
  return 0.5 * square / (n - 1.0);
}

struct Gathered {
  std::map<std::array<int, 3>, Whole> wholes;  ///< traces, of side, trace or tooth, line
  std::array<std::map<int, double>, 2> around;
  double squares = 0.0, count = 0.0, held_out = 0.0;
  int teeth = 0;  ///< of the gear

  /// The same variance of all values.
  [[nodiscard]] Variance even(double variance) const { return {variance, variance, held_out}; }
};

/// Sums over sides of a class.
struct SumOfSides {
  double sum = 0.0, count = 0.0, held_out_sum = 0.0, held_out = 0.0, by_chance = 0.0;
  void add(const Variance& of, double values) {
    sum += values * of.all;
    count += values;
    held_out_sum += of.held_out_count * of.held_out;
    held_out += of.held_out_count;
    by_chance += of.of_held_out_sum;
  }
  [[nodiscard]] Variance mean() const {
    const double all = sum / count;
    return {all, held_out > 0.0 ? held_out_sum / held_out : all, held_out, by_chance};
  }
};

Variance variance_of_scan(const std::array<ScannedSide, 2>& sides, const Gathered& data, bool nothing_left) {
  const double plain = data.squares / data.count;
  // Either flank by itself: a probe may be noisier on one.
  SumOfSides sum;
  double usual = 0.0;
  for (const ScannedSide& side : sides) {
    if (!(side.count > 0.0)) continue;
    usual += side.count * side.usual;
    if (!(side.variance.all > 0.0)) return data.even(plain);
    sum.add(side.variance, side.count);
  }
  if (!(sum.count > 0.0)) return data.even(plain);
  Variance variance = sum.mean();
  // What stands on a few flanks is in their mean square and not in the usual flank.
  constexpr double kUsual = 1.21;
  if (nothing_left && plain < kUsual * usual / sum.count) {
    variance.held_out *= plain / variance.all;
    variance.all = plain;
  }
  return variance;
}

Variance variance_of(ObservationKind kind, Gathered& data, const WhatIsLeft& left) {
  const double plain = data.squares / data.count;
  if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial) {
    const double around =
        left.places.any ? variance_beside(data.around, left.places, data.teeth)
                        : 0.5 * (variance_around(data.around[0]) + variance_around(data.around[1]));
    return data.even(left.nothing || !(around > 0.0) ? plain : std::min(plain, around));
  }
  std::array<std::vector<Whole*>, 2> of_flank;
  for (auto& [key, whole] : data.wholes)
    of_flank[static_cast<std::size_t>(key[0])].push_back(&whole);
  SumOfSides sum;
  for (std::vector<Whole*>& flank : of_flank) {
    if (flank.empty()) continue;
    std::size_t longest = 0;
    double count = 0.0;
    for (const Whole* whole : flank) {
      longest = std::max(longest, whole->size());
      count += static_cast<double>(whole->size());
    }
    const int places = static_cast<int>(std::min<std::size_t>(longest, 256));
    const double lost = kind == ObservationKind::kProfile ? take_common_off(flank, places, 1)
                                                          : take_common_off(flank, 1, places);
    std::vector<Whole> wholes;
    for (Whole* whole : flank) wholes.push_back(std::move(*whole));
    const OwnCourses own = kind == ObservationKind::kProfile
                               ? OwnCourses{left.own_profiles, left.smooth_profiles}
                               : OwnCourses{left.own_leads, left.smooth_leads};
    const Variance variance = variance_of_traces(wholes, lost, own);
    if (!(variance.all > 0.0)) return data.even(plain);
    sum.add(variance, count);
  }
  return sum.count > 0.0 ? sum.mean() : data.even(plain);
}

/// The same of values that were spread over their steps: medians of what stands on a few levels say
/// little. What was added is most of the spread, so the rest is known badly: where nothing was found
/// and what is left is no more than three errors above, that is it.
Variance variance_of_readings(const Class& of, Gathered& data, const ReadingSteps& steps,
                              const WhatIsLeft& left) {
  constexpr double kErrors = 3.0, kToldByMedian = 0.37;
  const double plain = data.squares / data.count, added = steps.wide_variance(of.kind, of.source);
  if (!(added > 0.0)) return variance_of(of.kind, data, left);
  const double error = kErrors * std::sqrt(2.0 / (kToldByMedian * data.count));
  data.squares += data.count * added;
  const double spread = variance_of(of.kind, data, left).all;
  if (!(spread > added) || (left.nothing && plain < spread * (1.0 + error) - added))
    return data.even(plain);
  return data.even(spread - added);
}

/// Takes a value of a trace, or one of a tooth, to those of its kind.
void add_to(Gathered& data, const FlankGeometry& geometry, const Observation& row,
            const Place& place, double um, bool held_out) {
  const auto side = static_cast<std::size_t>(place.side > 0 ? 1 : 0);
  if (row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial) {
    data.around[side][place.tooth] = um;
    return;
  }
  // A trace runs along one direction; the other stands still.
  const bool helix = row.kind == ObservationKind::kHelix;
  data.wholes[{static_cast<int>(side), row.trace >= 0 ? row.trace : place.tooth, row.line}]
      .push_back({helix ? 0.0 : geometry.profile_coordinate(place.roll_mm),
                  helix ? geometry.face_coordinate(place.z_mm) : 0.0, um, held_out});
}

}  // namespace

std::map<ObservationKind, KindError> errors_of_kinds(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const Patches& patches,
                                                     const std::vector<float>& row_um,
                                                     const WhatIsLeft& left) {
  std::map<Class, Gathered> classes;
  // Of each patch, the values it belongs to: nullptr where these are not asked.
  std::vector<Gathered*> class_of(patches.patches.size(), nullptr);
  for (std::size_t p = 0; p < class_of.size(); ++p) {
    const Patches::Patch& patch = patches.patches[p];
    if (patch.kind != ObservationKind::kScanTip && patch.kind != ObservationKind::kScanRoot &&
        patch.kind != ObservationKind::kScanBore && patch.kind != ObservationKind::kSize)
      class_of[p] = &classes[{patch.source, patch.kind}];
  }
  for (auto& [key, data] : classes) data.teeth = geometry.teeth();
  const ReadingSteps steps(table, row_um);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const int patch = patches.patch_of_row[i];
    if (patch < 0 || class_of[static_cast<std::size_t>(patch)] == nullptr) continue;
    Gathered& data = *class_of[static_cast<std::size_t>(patch)];
    const double um = row_um[i];
    data.squares += um * um;
    data.count += 1.0;
    const bool held_out = patches.patches[static_cast<std::size_t>(patch)].fold == 0;
    data.held_out += held_out ? 1.0 : 0.0;
    if (patches.patches[static_cast<std::size_t>(patch)].kind != ObservationKind::kScanFlank)
      add_to(data, geometry, table.rows[i], table.place(table.rows[i]),
             um + steps.wide_spread_um(table, i), held_out);
  }
  std::map<ObservationKind, KindError> errors;
  for (auto& [key, data] : classes) {
    KindError& error = errors[key.kind];
    error.count += data.count;
    error.square += data.squares;
    const Variance variance =
        key.kind == ObservationKind::kScanFlank
            ? variance_of_scan(scanned_sides(geometry, table, patches, row_um, key.source, left),
                               data, left.nothing)
            : variance_of_readings(key, data, steps, left);
    error.random_square += data.count * variance.all;
    error.held_out_count += data.held_out;
    error.held_out_random_square += data.held_out * variance.held_out;
    error.of_held_out_sum += variance.of_held_out_sum;
  }
  return errors;
}

RandomError random_error(const FlankGeometry& geometry, const Observations& table,
                         const Patches& patches, const std::vector<float>& row_um,
                         const WhatIsLeft& left) {
  KindError all;
  for (const auto& [kind, error] :
       errors_of_kinds(geometry, table, patches, row_um, left)) {
    all.random_square += error.random_square;
    all.count += error.count;
    all.held_out_random_square += error.held_out_random_square;
    all.held_out_count += error.held_out_count;
    all.of_held_out_sum += error.of_held_out_sum;
  }
  // Of sizes alone their stated errors are all that is known.
  if (all.count == 0.0)
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      if (table.rows[i].kind != ObservationKind::kSize || patches.patch_of_row[i] < 0) continue;
      all.random_square += std::pow(table.size_sigma_um(table.rows[i]), 2);
      all.count += 1.0;
    }
  RandomError result{.um = all.count > 0.0 ? std::sqrt(all.random_square / all.count) : 0.0};
  result.held_out_um = all.held_out_count > 0.0
                           ? std::sqrt(all.held_out_random_square / all.held_out_count)
                           : result.um;
  result.held_out_degrees = all.held_out_count;
  if (all.of_held_out_sum > 0.0)
    result.held_out_degrees =
        std::min(result.held_out_degrees, 2.0 * all.held_out_random_square *
                                              all.held_out_random_square / all.of_held_out_sum);
  return result;
}

}  // namespace trueflank::loop
