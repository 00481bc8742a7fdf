// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/scanned_flanks.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {

double mean_over_median(double degrees) {
  return std::pow(1.0 - 2.0 / (9.0 * std::max(1.0, degrees)), -3.0);
}

Variance of_louder(double variance, const std::vector<double>& loud,
                   const std::vector<double>& values, const std::vector<double>& held_out) {
  double sum = 0.0, count = 0.0, held_out_sum = 0.0, held_out_count = 0.0, by_chance = 0.0;
  for (std::size_t i = 0; i < loud.size(); ++i) {
    sum += values[i] * loud[i] * loud[i];
    count += values[i];
    held_out_sum += held_out[i] * loud[i] * loud[i];
    held_out_count += held_out[i];
    const double square = held_out[i] * loud[i] * loud[i];
    if (!(square > 0.0)) continue;
    const double of_loudness = loud[i] == 1.0 ? 0.0 : 4.0 * kVarianceOfLogScatter / values[i];
    by_chance += square * square * (2.0 / held_out[i] + of_loudness);
  }
  Variance result{.all = count > 0.0 ? variance * sum / count : variance,
                  .held_out_count = held_out_count,
                  .of_held_out_sum = variance * variance * by_chance};
  result.held_out = held_out_count > 0.0 ? variance * held_out_sum / held_out_count : result.all;
  return result;
}

namespace {

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

  [[nodiscard]] ScannedSide side(std::size_t side) const {
    ScannedSide result;
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
      std::vector<Value> values_of_flank = values_of(flanks[k], common);
      const double of_waves = take_own_waves_off(values_of_flank, side == 1 ? 1 : -1);
      const OfFlank own = of_flank(values_of_flank, of_waves);
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

  /// A value of a flank less what all have in common there.
  struct Value {
    double u, v, um;
  };
  /// In order, and beside each other: they are asked several times.
  [[nodiscard]] std::vector<Value> values_of(std::size_t flank, const Common& common) const {
    std::vector<Value> values;
    values.reserve(rows_.count(flank));
    for_each(flank, [&](double u, double v, double um) {
      values.push_back({u, v, um - common.um[cell_of(u, v)]});
    });
    return values;
  }

  struct OfFlank {
    double variance = 0.0;
    double scatter = 0.0;  ///< of values that stand close by each other
  };
  using Forms = std::array<double, kForms>;
  static Forms forms_at(double u, double v) { return {1.0, u, v, u * u, u * v, v * v}; }

  /// Takes waves that the flank has in a phase of its own off; how many figures that took.
  double take_own_waves_off(std::vector<Value>& values, int side) const {
    double figures = 0.0;
    for (const OwnWaves& wave : left_.own_waves) {
      if (wave.side != side) continue;
      const auto phase_at = [&](const Value& value) {
        return kPi * (wave.waves_profile * (value.u + 1.0) + wave.waves_face * (value.v + 1.0));
      };
      Eigen::Matrix2d gram = Eigen::Matrix2d::Zero();
      Eigen::Vector2d right = Eigen::Vector2d::Zero();
      for (const Value& value : values) {
        const double phase = phase_at(value);
        const Eigen::Vector2d form(std::cos(phase), std::sin(phase));
        gram += form * form.transpose();
        right += value.um * form;
      }
      const double cc = gram(0, 0), ss = gram(1, 1), cs = gram(0, 1);
      const double determinant = cc * ss - cs * cs;
      if (!(determinant > 0.01 * cc * ss)) continue;
      const Eigen::Vector2d sizes((ss * right[0] - cs * right[1]) / determinant,
                                  (cc * right[1] - cs * right[0]) / determinant);
      for (Value& value : values) {
        const double phase = phase_at(value);
        value.um -= sizes[0] * std::cos(phase) + sizes[1] * std::sin(phase);
      }
      figures += 2.0;
    }
    return figures;
  }

  /// Of what a bent and twisted plane leaves; `taken`: figures that were fitted before.
  [[nodiscard]] OfFlank of_flank(const std::vector<Value>& values, double taken) const {
    using Matrix = Eigen::Matrix<double, kForms, kForms>;
    using Vector = Eigen::Matrix<double, kForms, 1>;
    const auto n = static_cast<double>(values.size());
    Matrix gram = Matrix::Zero();
    Vector right = Vector::Zero();
    double squares = 0.0;
    for (const auto& [u, v, um] : values) {
      const Forms form = forms_at(u, v);
      for (int a = 0; a < kForms; ++a) {
        const double own = form[static_cast<std::size_t>(a)];
        for (int b = 0; b <= a; ++b) gram(a, b) += own * form[static_cast<std::size_t>(b)];
        right[a] += um * own;
      }
      squares += um * um;
    }
    gram.diagonal().array() += 1e-9 * n;
    const Eigen::VectorXd score = right;
    const Eigen::VectorXd plane = symmetric_solution(gram, score);
    const Courses own = own_courses(values, plane);
    const double left = squares - score.dot(plane) - own.square;
    return {std::max(0.0, left) / std::max(1.0, n - kForms - own.degrees - taken),
            close_by(values, plane)};
  }

  /// What the courses of its own take out of a flank beside the plane.
  struct Courses {
    double square = 0.0, degrees = 0.0;
  };
  [[nodiscard]] Courses own_courses(const std::vector<Value>& values,
                                    const Eigen::VectorXd& plane) const {
    constexpr double kInAPart = 12.0, kFewestParts = 4.0, kMostParts = 24.0;
    const double parts =
        std::min(kMostParts, std::floor(static_cast<double>(values.size()) / kInAPart));
    Courses own;
    if (parts < kFewestParts) return own;
    for (const bool face : {false, true}) {
      if (!(face ? left_.own_leads : left_.own_profiles)) continue;
      std::vector<double> sum(static_cast<std::size_t>(parts)), count(sum);
      for (const auto& [u, v, value] : values) {
        const auto at = static_cast<std::size_t>(std::clamp(0.5 * ((face ? v : u) + 1.0) * parts, 0.0, parts - 1.0));
        const Forms form = forms_at(u, v);
        double um = value;
        for (int k = 0; k < kForms; ++k) um -= plane[k] * form[static_cast<std::size_t>(k)];
        sum[at] += um;
        count[at] += 1.0;
      }
      for (std::size_t at = 0; at < sum.size(); ++at)
        if (count[at] > 0.0) {
          own.square += sum[at] * sum[at] / count[at];
          own.degrees += 1.0;
        }
    }
    return own;
  }

  /// Of differences between values that stand in one small part of the flank.
  [[nodiscard]] static double close_by(const std::vector<Value>& values,
                                       const Eigen::VectorXd& plane) {
    constexpr double kInAPart = 3.0, kMostParts = 64.0;
    const double parts = std::clamp(
        std::floor(std::sqrt(static_cast<double>(values.size()) / kInAPart)), 1.0, kMostParts);
    const auto part_of = [&](double c) {
      return static_cast<std::size_t>(std::clamp(0.5 * (c + 1.0) * parts, 0.0, parts - 1.0));
    };
    constexpr double kEmpty = std::numeric_limits<double>::infinity();
    std::vector<double> last(static_cast<std::size_t>(parts * parts), kEmpty), steps;
    for (const auto& [u, v, value] : values) {
      const Forms form = forms_at(u, v);
      double um = value;
      for (int k = 0; k < kForms; ++k) um -= plane[k] * form[static_cast<std::size_t>(k)];
      double& before = last[part_of(u) * static_cast<std::size_t>(parts) + part_of(v)];
      if (before != kEmpty) steps.push_back(um - before);
      before = um;
    }
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

}  // namespace

std::array<ScannedSide, 2> scanned_sides(const FlankGeometry& geometry, const Observations& table,
                                         const Patches& patches, const std::vector<float>& row_um, int source,
                                         const WhatIsLeft& left) {
  const ScannedFlanks flanks(geometry, table, patches, row_um, source, left);
  std::array<ScannedSide, 2> sides;
  for_each_piece(2, [&](std::size_t side) { sides[side] = flanks.side(side); });
  return sides;
}

}  // namespace trueflank::loop
