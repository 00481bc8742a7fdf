// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/random_error.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/reading_steps.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

/// Medians of chi-square with one degree of freedom, and of large ones near their mean.
constexpr double kMedianOfSquare = 0.4549;

/// Mean of chi-square over its median, for so many degrees of freedom (Wilson and Hilferty).
double mean_over_median(double degrees) {
  return std::pow(1.0 - 2.0 / (9.0 * std::max(1.0, degrees)), -3.0);
}

struct Class {
  int source = 0;
  ObservationKind kind = ObservationKind::kProfile;
  auto operator<=>(const Class&) const = default;
};

struct Sample {
  double u = 0.0, v = 0.0, um = 0.0;
  bool held_out = false;
};

/// A variance, that of the held-out values and how many they are: these may be louder than the rest.
struct Variance {
  double all = 0.0, held_out = 0.0, held_out_count = 0.0;
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

/// Squares of the cosine coefficients of one course.
Eigen::VectorXd spectrum(const Eigen::VectorXd& course) {
  const Eigen::Index n = course.size();
  Eigen::VectorXd result(n);
  const double step = kPi / static_cast<double>(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      sum += course[i] * std::cos(step * static_cast<double>(k) * (static_cast<double>(i) + 0.5));
    result[k] = sum * sum * (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
  }
  return result;
}

/// Sum of a spectrum in which a line counts as what stands beside it: waves of one length that
/// every trace has in a phase of its own are no random error, whose spectrum is smooth.
double sum_without_lines(const std::vector<double>& level) {
  constexpr int kNear = 4, kFar = 10;
  constexpr double kLine = 3.0;
  const auto n = static_cast<int>(level.size());
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    std::vector<double> before, after;
    for (int off = kNear; off <= kFar; ++off) {
      if (k - off >= 0) before.push_back(level[static_cast<std::size_t>(k - off)]);
      if (k + off < n) after.push_back(level[static_cast<std::size_t>(k + off)]);
    }
    const double own = level[static_cast<std::size_t>(k)];
    // A line stands above both sides; the rise to long waves is above one.
    const bool both = before.size() > 2 && after.size() > 2;
    const double beside = both ? std::max(median(before), median(after)) : own;
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

/// What the usual member's variance becomes if some are louder.
Variance of_louder(double variance, const std::vector<double>& loud,
                   const std::vector<double>& values, const std::vector<double>& held_out) {
  double sum = 0.0, count = 0.0, held_out_sum = 0.0, held_out_count = 0.0;
  for (std::size_t i = 0; i < loud.size(); ++i) {
    sum += values[i] * loud[i] * loud[i];
    count += values[i];
    held_out_sum += held_out[i] * loud[i] * loud[i];
    held_out_count += held_out[i];
  }
  Variance result{.all = count > 0.0 ? variance * sum / count : variance,
                  .held_out_count = held_out_count};
  result.held_out = held_out_count > 0.0 ? variance * held_out_sum / held_out_count : result.all;
  return result;
}

/// Variance of traces over the same wavelengths; some may be measured worse than others.
Variance variance_of_traces(std::vector<Whole>& wholes, double lost) {
  constexpr int kBeside = 2;
  const Pieces pieces = pieces_of(wholes);
  if (pieces.courses.empty()) return {};
  std::vector<double> scatters;
  Eigen::Index shortest = pieces.courses.front().size();
  for (const Eigen::VectorXd& piece : pieces.courses) {
    scatters.push_back(short_wave_scatter(piece));
    shortest = std::min(shortest, piece.size());
  }
  const std::vector<double> loud = loudness_of(scatters, pieces.values).factors;
  std::vector<Eigen::VectorXd> spectra;
  for (std::size_t i = 0; i < loud.size(); ++i)
    spectra.push_back(spectrum(pieces.courses[i] / loud[i]));
  // Wavelengths in shares of the shortest course; k = 0 is the trace's zero.
  const auto n = static_cast<int>(shortest);
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
  return of_louder(lost * sum_without_lines(level) / (n - 1), loud, pieces.values, pieces.held_out);
}

/// The flanks of a scan, whose values are many: nothing is kept of them but where they stand.
class ScannedFlanks {
 public:
  ScannedFlanks(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                const std::vector<float>& row_um, int source, const WhatIsLeft& left)
      : geometry_(geometry),
        table_(table),
        row_um_(row_um),
        patches_(patches),
        left_(left),
        rows_(table.rows.size(), 2 * static_cast<std::size_t>(geometry.teeth()),
              [&, flank_of = flanks_of(geometry, patches, source)](std::size_t i) {
                const int patch = patches.patch_of_row[i];
                return patch < 0 ? -1 : flank_of[static_cast<std::size_t>(patch)];
              }) {
    for (std::size_t flank = 0; flank < 2 * static_cast<std::size_t>(geometry.teeth()); ++flank)
      if (rows_.count(flank) > 0)
        of_side_[flank / static_cast<std::size_t>(geometry.teeth())].push_back(flank);
  }

  /// Variance of the random error of one side, and mean square of its usual flank, whatever its
  /// form.
  struct Side {
    Variance variance;
    double usual = 0.0, count = 0.0;
  };
  [[nodiscard]] Side side(std::size_t side) const {
    Side result;
    const std::vector<std::size_t>& flanks = of_side_[side];
    double values = 0.0, wholes = 0.0;
    for (const std::size_t flank : flanks) {
      const auto count = static_cast<double>(rows_.count(flank));
      result.count += count;
      if (rows_.count(flank) < kFewest) continue;
      values += count;
      wholes += 1.0;
    }
    const Common common = common_of(flanks);
    std::vector<double> squares(flanks.size()), variances(flanks.size()), scatters(flanks.size()),
        counts(flanks.size()), held_out(flanks.size());
    for_each_piece(flanks.size(), [&](std::size_t k) {
      squares[k] = mean_square(flanks[k]);
      const OfFlank own = of_flank(flanks[k], common);
      variances[k] = own.variance;
      scatters[k] = own.scatter;
      counts[k] = static_cast<double>(rows_.count(flanks[k]));
      held_out[k] = held_out_of(flanks[k]);
    });
    const std::vector<double> loud = loudness_of(scatters, counts).factors;
    for (std::size_t k = 0; k < flanks.size(); ++k) {
      squares[k] /= loud[k] * loud[k];
      variances[k] /= loud[k] * loud[k];
    }
    const auto of_few = [&](std::vector<double>& figures) {
      for (std::size_t k = flanks.size(); k-- > 0;)
        if (rows_.count(flanks[k]) < kFewest)
          figures.erase(figures.begin() + static_cast<std::ptrdiff_t>(k));
    };
    of_few(squares);
    of_few(variances);
    if (squares.empty()) return result;
    const double each = values / wholes;
    result.variance = of_louder(common.lost * median(variances) * mean_over_median(each - kForms),
                                loud, counts, held_out);
    result.usual = of_louder(usual_of(squares, each), loud, counts, held_out).all;
    return result;
  }

 private:
  static constexpr std::size_t kFewest = 12;
  static constexpr int kForms = 6, kParts = 12;

  /// The mean of mean squares as the usual one tells it. On thin flanks errors that hang together
  /// cannot be told from a form of each flank, and make fewer degrees of freedom than values: as few
  /// as the logarithms scatter, by their median.
  static double usual_of(std::vector<double>& squares, double each) {
    constexpr double kThin = 60.0;  // five times what errors hang together over at most (flank_waves.cpp)
    const double usual = median(squares);
    if (!(usual > 0.0)) return 0.0;
    double degrees = each;
    if (each < kThin) {
      std::vector<double> off;
      for (const double square : squares)
        off.push_back(std::log(std::max(square, 1e-12 * usual) / usual));
      const double scatter = robust_sigma(std::move(off));
      degrees = 2.0 / std::max(scatter * scatter, 2.0 / each);
    }
    return usual * mean_over_median(degrees);
  }

  /// What all flanks of a side have in common, place by place; how much variance it costs to take
  /// it off.
  struct Common {
    std::vector<double> um = std::vector<double>(kParts * kParts, 0.0);
    double lost = 1.0;
  };

  static std::vector<int> flanks_of(const FlankGeometry& geometry, const Patches& patches,
                                    int source) {
    std::vector<int> flank_of(patches.patches.size(), -1);
    for (std::size_t p = 0; p < flank_of.size(); ++p) {
      const Patches::Patch& patch = patches.patches[p];
      if (patch.kind != ObservationKind::kScanFlank || patch.source != source) continue;
      const Place& place = patch.places.front().place;
      flank_of[p] = (place.side > 0 ? geometry.teeth() : 0) + place.tooth - 1;
    }
    return flank_of;
  }
  static std::size_t cell_of(double u, double v) {
    const auto part = [](double c) {
      return std::clamp(static_cast<int>(0.5 * (c + 1.0) * kParts), 0, kParts - 1);
    };
    return static_cast<std::size_t>(part(u) * kParts + part(v));
  }
  /// `visit(u, v, um)` for the values of a flank, in order.
  template <class Visit>
  void for_each(std::size_t flank, const Visit& visit) const {
    rows_.for_each(flank, table_, [&](std::size_t i) {
      const Place& place = table_.place(table_.rows[i]);
      visit(geometry_.profile_coordinate(place.roll_mm), geometry_.face_coordinate(place.z_mm),
            static_cast<double>(row_um_[i]));
    });
  }

  [[nodiscard]] Common common_of(const std::vector<std::size_t>& flanks) const {
    Common common;
    std::vector<double> sums(common.um.size(), 0.0), counts(sums);
    double values = 0.0, used = 0.0;
    for (const std::size_t flank : flanks)
      for_each(flank, [&](double u, double v, double um) {
        const std::size_t cell = cell_of(u, v);
        sums[cell] += um;
        counts[cell] += 1.0;
        values += 1.0;
      });
    for (const double count : counts) used += count > 0.0 ? 1.0 : 0.0;
    if (used > 0.5 * values) return common;
    for (std::size_t k = 0; k < sums.size(); ++k)
      if (counts[k] > 0.0) common.um[k] = sums[k] / counts[k];
    common.lost = values / (values - used);
    return common;
  }

  [[nodiscard]] double held_out_of(std::size_t flank) const {
    double count = 0.0;
    rows_.for_each(flank, [&](std::size_t i) {
      const auto patch = static_cast<std::size_t>(patches_.patch_of_row[i]);
      count += patches_.patches[patch].fold == 0 ? 1.0 : 0.0;
    });
    return count;
  }

  [[nodiscard]] double mean_square(std::size_t flank) const {
    double sum = 0.0;
    rows_.for_each(flank, [&](std::size_t i) {
      const double um = row_um_[i];
      sum += um * um;
    });
    return sum / static_cast<double>(rows_.count(flank));
  }

  struct OfFlank {
    double variance = 0.0;
    double scatter = 0.0;  ///< of values that stand close by each other
  };
  using Forms = std::array<double, kForms>;
  static Forms forms_at(double u, double v) { return {1.0, u, v, u * u, u * v, v * v}; }

  /// Of what a bent and twisted plane leaves.
  [[nodiscard]] OfFlank of_flank(std::size_t flank, const Common& common) const {
    using Matrix = Eigen::Matrix<double, kForms, kForms>;
    using Vector = Eigen::Matrix<double, kForms, 1>;
    const auto n = static_cast<double>(rows_.count(flank));
    Matrix gram = Matrix::Zero();
    Vector right = Vector::Zero();
    double squares = 0.0;
    for_each(flank, [&](double u, double v, double value) {
      const double um = value - common.um[cell_of(u, v)];
      const Forms form = forms_at(u, v);
      for (int a = 0; a < kForms; ++a) {
        const double own = form[static_cast<std::size_t>(a)];
        for (int b = 0; b <= a; ++b) gram(a, b) += own * form[static_cast<std::size_t>(b)];
        right[a] += um * own;
      }
      squares += um * um;
    });
    gram.diagonal().array() += 1e-9 * n;
    const Eigen::VectorXd score = right;
    const Eigen::VectorXd plane = symmetric_solution(gram, score);
    const Courses own = own_courses(flank, common, plane);
    const double left = squares - score.dot(plane) - own.square;
    return {std::max(0.0, left) / std::max(1.0, n - kForms - own.degrees), close_by(flank, common, plane)};
  }

  /// What the courses of its own take out of a flank beside the plane.
  struct Courses {
    double square = 0.0, degrees = 0.0;
  };
  [[nodiscard]] Courses own_courses(std::size_t flank, const Common& common,
                                    const Eigen::VectorXd& plane) const {
    constexpr double kInAPart = 12.0, kFewestParts = 4.0, kMostParts = 24.0;
    const double parts = std::min(kMostParts, std::floor(static_cast<double>(rows_.count(flank)) / kInAPart));
    Courses own;
    if (parts < kFewestParts) return own;
    for (const bool face : {false, true}) {
      if (!(face ? left_.own_leads : left_.own_profiles)) continue;
      std::vector<double> sum(static_cast<std::size_t>(parts)), count(sum);
      for_each(flank, [&](double u, double v, double value) {
        const auto at = static_cast<std::size_t>(std::clamp(0.5 * ((face ? v : u) + 1.0) * parts, 0.0, parts - 1.0));
        const Forms form = forms_at(u, v);
        double um = value - common.um[cell_of(u, v)];
        for (int k = 0; k < kForms; ++k) um -= plane[k] * form[static_cast<std::size_t>(k)];
        sum[at] += um;
        count[at] += 1.0;
      });
      for (std::size_t at = 0; at < sum.size(); ++at)
        if (count[at] > 0.0) {
          own.square += sum[at] * sum[at] / count[at];
          own.degrees += 1.0;
        }
    }
    return own;
  }

  /// Of differences between values that stand in one small part of the flank.
  [[nodiscard]] double close_by(std::size_t flank, const Common& common,
                                const Eigen::VectorXd& plane) const {
    constexpr double kInAPart = 3.0, kMostParts = 64.0;
    const double parts = std::clamp(
        std::floor(std::sqrt(static_cast<double>(rows_.count(flank)) / kInAPart)), 1.0, kMostParts);
    const auto part_of = [&](double c) {
      return static_cast<std::size_t>(std::clamp(0.5 * (c + 1.0) * parts, 0.0, parts - 1.0));
    };
    constexpr double kEmpty = std::numeric_limits<double>::infinity();
    std::vector<double> last(static_cast<std::size_t>(parts * parts), kEmpty), steps;
    for_each(flank, [&](double u, double v, double value) {
      const Forms form = forms_at(u, v);
      double um = value - common.um[cell_of(u, v)];
      for (int k = 0; k < kForms; ++k) um -= plane[k] * form[static_cast<std::size_t>(k)];
      double& before = last[part_of(u) * static_cast<std::size_t>(parts) + part_of(v)];
      if (before != kEmpty) steps.push_back(um - before);
      before = um;
    });
    return robust_sigma(std::move(steps));
  }

  const FlankGeometry& geometry_;
  const Observations& table_;
  const std::vector<float>& row_um_;
  const Patches& patches_;
  const WhatIsLeft left_;
  RowsByClass rows_;
  std::array<std::vector<std::size_t>, 2> of_side_;
};

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

struct Gathered {
  std::map<std::pair<int, int>, Whole> wholes;  ///< traces, of side and trace or tooth
  std::array<std::map<int, double>, 2> around;
  double squares = 0.0, count = 0.0, held_out = 0.0;

  /// The same variance of all values.
  [[nodiscard]] Variance even(double variance) const { return {variance, variance, held_out}; }
};

/// Sums over sides of a class.
struct SumOfSides {
  double sum = 0.0, count = 0.0, held_out_sum = 0.0, held_out = 0.0;
  void add(const Variance& of, double values) {
    sum += values * of.all;
    count += values;
    held_out_sum += of.held_out_count * of.held_out;
    held_out += of.held_out_count;
  }
  [[nodiscard]] Variance mean() const {
    const double all = sum / count;
    return {all, held_out > 0.0 ? held_out_sum / held_out : all, held_out};
  }
};

Variance variance_of_scan(const ScannedFlanks& flanks, const Gathered& data, bool nothing_left) {
  const double plain = data.squares / data.count;
  std::array<ScannedFlanks::Side, 2> sides;
  for_each_piece(2, [&](std::size_t side) { sides[side] = flanks.side(side); });
  // Either flank by itself: a probe may be noisier on one.
  SumOfSides sum;
  double usual = 0.0;
  for (const ScannedFlanks::Side& side : sides) {
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

Variance variance_of(ObservationKind kind, Gathered& data, bool nothing_left) {
  const double plain = data.squares / data.count;
  if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial) {
    const double around = 0.5 * (variance_around(data.around[0]) + variance_around(data.around[1]));
    return data.even(nothing_left || !(around > 0.0) ? plain : std::min(plain, around));
  }
  std::array<std::vector<Whole*>, 2> of_flank;
  for (auto& [key, whole] : data.wholes)
    of_flank[static_cast<std::size_t>(key.first)].push_back(&whole);
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
    const Variance variance = variance_of_traces(wholes, lost);
    if (!(variance.all > 0.0)) return data.even(plain);
    sum.add(variance, count);
  }
  return sum.count > 0.0 ? sum.mean() : data.even(plain);
}

/// The same of values that were spread over their steps: medians of what stands on a few levels say
/// little. What was added is most of the spread, so the rest is known badly: where nothing was found
/// and what is left is no more than three errors above, that is it.
Variance variance_of_readings(const Class& of, Gathered& data, const ReadingSteps& steps,
                              bool nothing_left) {
  constexpr double kErrors = 3.0, kToldByMedian = 0.37;
  const double plain = data.squares / data.count, added = steps.wide_variance(of.kind, of.source);
  if (!(added > 0.0)) return variance_of(of.kind, data, nothing_left);
  const double error = kErrors * std::sqrt(2.0 / (kToldByMedian * data.count));
  data.squares += data.count * added;
  const double spread = variance_of(of.kind, data, nothing_left).all;
  if (!(spread > added) || (nothing_left && plain < spread * (1.0 + error) - added))
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
  data.wholes[{static_cast<int>(side), row.trace >= 0 ? row.trace : place.tooth}].push_back(
      {helix ? 0.0 : geometry.profile_coordinate(place.roll_mm),
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
            ? variance_of_scan({geometry, table, patches, row_um, key.source, left}, data, left.nothing)
            : variance_of_readings(key, data, steps, left.nothing);
    error.random_square += data.count * variance.all;
    error.held_out_count += data.held_out;
    error.held_out_random_square += data.held_out * variance.held_out;
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
  }
  RandomError result{.um = all.count > 0.0 ? std::sqrt(all.random_square / all.count) : 0.0};
  result.held_out_um = all.held_out_count > 0.0
                           ? std::sqrt(all.held_out_random_square / all.held_out_count)
                           : result.um;
  return result;
}

}  // namespace trueflank::loop
