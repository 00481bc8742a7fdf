// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/random_error.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

/// Medians of chi-square with one degree of freedom, and of large ones near their mean.
constexpr double kMedianOfSquare = 0.4549;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
};

/// Of one trace, or of one flank of a scan.
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
Eigen::VectorXd spectrum(const Whole& whole) {
  const auto n = static_cast<Eigen::Index>(whole.size());
  Eigen::VectorXd result(n);
  const double step = kPi / static_cast<double>(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      sum += whole[static_cast<std::size_t>(i)].um *
             std::cos(step * static_cast<double>(k) * (static_cast<double>(i) + 0.5));
    result[k] = sum * sum * (k == 0 ? 1.0 : 2.0) / static_cast<double>(n);
  }
  return result;
}

/// Sum of a spectrum in which a line counts as what stands beside it: waves of one length that every
/// trace has in a phase of its own are no random error, whose spectrum is smooth.
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

/// Variance of traces over the same wavelengths.
double variance_of_traces(std::vector<Whole>& wholes, double lost) {
  constexpr int kBeside = 2;
  constexpr std::size_t kLongest =
      256;  // longer ones are cut: what varies slower is no neighbourhood
  std::vector<Eigen::VectorXd> spectra;
  std::size_t shortest = kLongest;
  for (Whole& whole : wholes) {
    std::sort(whole.begin(), whole.end(),
              [](const auto& a, const auto& b) { return a.u + a.v < b.u + b.v; });
    for (std::size_t from = 0; from < whole.size(); from += kLongest) {
      const std::size_t to = std::min(whole.size(), from + kLongest);
      if (to - from < 12) continue;
      spectra.push_back(spectrum(Whole(whole.begin() + static_cast<std::ptrdiff_t>(from),
                                       whole.begin() + static_cast<std::ptrdiff_t>(to))));
      shortest = std::min(shortest, to - from);
    }
  }
  if (spectra.empty()) return 0.0;
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
  return lost * sum_without_lines(level) / (n - 1);
}

double variance_of_flank(const Whole& whole, bool with_form) {
  const auto n = static_cast<Eigen::Index>(whole.size());
  const Eigen::Index columns = with_form ? 6 : 1;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns);
  double squares = 0.0;
  for (const Sample& s : whole) {
    Eigen::VectorXd form(columns);
    form[0] = 1.0;
    if (with_form) form.tail(5) << s.u, s.v, s.u * s.u, s.u * s.v, s.v * s.v;
    gram += form * form.transpose();
    right += s.um * form;
    squares += s.um * s.um;
  }
  gram.diagonal().array() += 1e-9 * static_cast<double>(n);
  const double left = squares - right.dot(gram.ldlt().solve(right));
  return std::max(0.0, left) / static_cast<double>(std::max<Eigen::Index>(1, n - columns));
}

double variance_of_scan(std::vector<Whole>& wholes, double lost) {
  std::vector<double> variances;
  double values = 0.0;
  for (const Whole& whole : wholes) {
    if (whole.size() < 12) continue;
    variances.push_back(variance_of_flank(whole, true));
    values += static_cast<double>(whole.size());
  }
  if (variances.empty()) return 0.0;
  const double degrees = values / static_cast<double>(variances.size()) - 6.0;
  return lost * median(variances) * mean_over_median(degrees);
}

/// Mean square of the usual flank, whatever its form.
double usual_square(const std::vector<Whole*>& flank) {
  std::vector<double> squares;
  double values = 0.0;
  for (const Whole* whole : flank) {
    if (whole->size() < 12) continue;
    double sum = 0.0;
    for (const Sample& s : *whole) sum += s.um * s.um;
    squares.push_back(sum / static_cast<double>(whole->size()));
    values += static_cast<double>(whole->size());
  }
  if (squares.empty()) return 0.0;
  const double degrees = values / static_cast<double>(squares.size());
  return median(squares) * mean_over_median(degrees);
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

struct Gathered {
  std::map<std::pair<int, int>, Whole> wholes;  ///< of side and trace or tooth
  std::array<std::map<int, double>, 2> around;
  double squares = 0.0, count = 0.0;
};

double variance_of(ObservationKind kind, Gathered& data, bool nothing_left) {
  const double plain = data.squares / data.count;
  if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial) {
    const double around = 0.5 * (variance_around(data.around[0]) + variance_around(data.around[1]));
    return nothing_left || !(around > 0.0) ? plain : std::min(plain, around);
  }
  const bool scan = kind == ObservationKind::kScanFlank;
  std::array<std::vector<Whole*>, 2> of_flank;
  for (auto& [key, whole] : data.wholes)
    of_flank[static_cast<std::size_t>(key.first)].push_back(&whole);
  // Either flank by itself: a probe may be noisier on one.
  double sum = 0.0, values = 0.0, usual = 0.0;
  for (std::size_t side = 0; side < of_flank.size(); ++side) {
    std::vector<Whole*>& flank = of_flank[side];
    if (flank.empty()) continue;
    std::size_t longest = 0;
    double count = 0.0;
    for (const Whole* whole : flank) {
      longest = std::max(longest, whole->size());
      count += static_cast<double>(whole->size());
    }
    const int places = static_cast<int>(std::min<std::size_t>(longest, 256));
    if (scan) usual += count * usual_square(flank);
    const double lost = scan                                ? take_common_off(flank, 12, 12)
                        : kind == ObservationKind::kProfile ? take_common_off(flank, places, 1)
                                                            : take_common_off(flank, 1, places);
    std::vector<Whole> wholes;
    for (Whole* whole : flank) wholes.push_back(std::move(*whole));
    const double variance = scan ? variance_of_scan(wholes, lost) : variance_of_traces(wholes, lost);
    if (!(variance > 0.0)) return plain;
    sum += count * variance;
    values += count;
  }
  if (!(values > 0.0)) return plain;
  // What stands on a few flanks is in their mean square and not in the usual flank.
  constexpr double kUsual = 1.21;
  return scan && nothing_left && plain < kUsual * usual / values ? plain : sum / values;
}

}  // namespace

std::map<ObservationKind, KindError> errors_of_kinds(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const Patches& patches,
                                                     const std::vector<float>& row_um,
                                                     bool nothing_left) {
  std::map<Class, Gathered> classes;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const bool single = row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial;
    const bool whole = row.kind == ObservationKind::kScanFlank ||
                       row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
    if (patches.patch_of_row[i] < 0 || !(single || whole)) continue;
    const Place& place = table.place(row);
    const double um = row_um[i];
    const int side = place.side > 0 ? 1 : 0;
    Gathered& data = classes[{row.source, row.kind}];
    data.squares += um * um;
    data.count += 1.0;
    if (single) {
      data.around[static_cast<std::size_t>(side)][place.tooth] = um;
      continue;
    }
    // A trace runs along one direction; the other stands still.
    const bool profile = row.kind == ObservationKind::kProfile,
               helix = row.kind == ObservationKind::kHelix;
    const int key = !profile && !helix ? place.tooth : row.trace >= 0 ? row.trace : place.tooth;
    data.wholes[{side, key}].push_back({helix ? 0.0 : geometry.profile_coordinate(place.roll_mm),
                                        profile ? 0.0 : geometry.face_coordinate(place.z_mm), um});
  }
  std::map<ObservationKind, KindError> errors;
  for (auto& [key, data] : classes) {
    KindError& error = errors[key.kind];
    error.count += data.count;
    error.square += data.squares;
    error.random_square += data.count * variance_of(key.kind, data, nothing_left);
  }
  return errors;
}

double random_error_um(const FlankGeometry& geometry, const Observations& table,
                       const Patches& patches, const std::vector<float>& row_um,
                       bool nothing_left) {
  double sum = 0.0, count = 0.0;
  for (const auto& [kind, error] : errors_of_kinds(geometry, table, patches, row_um, nothing_left)) {
    sum += error.random_square;
    count += error.count;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace trueflank::loop
