// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/moved_sector.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/ring_scan.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/effects/columns.h"

namespace trueflank::loop {
namespace {

constexpr Eigen::Index kFewestInRing = 8;
/// Fewer teeth are no view, no half of a mould and no clamping.
constexpr Eigen::Index kFewestInSector = 3;
constexpr Eigen::Index kOfGear = 4;  // both flanks' heights, and the whole gear aside
constexpr Eigen::Index kOfSector = 2;

using Index = Eigen::Index;
using Matrix2 = Eigen::Matrix<double, kOfSector, kOfSector>;
using Vector2 = Eigen::Matrix<double, kOfSector, 1>;

/// Heights of both flanks of the teeth, a tooth's right flank before its left one.
class SectorSearch {
 public:
  SectorSearch(const FlankGeometry& geometry, const std::vector<ToothMoments>& of_teeth)
      : geometry_(geometry) {
    for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
      if (of_teeth[ToothMoments::at(0, tooth)].square[0] > 0.0 &&
          of_teeth[ToothMoments::at(1, tooth)].square[0] > 0.0)
        teeth_.push_back(tooth);
    n_ = static_cast<Index>(teeth_.size());
    height_um_.resize(2 * n_);
    gear_.setZero(2 * n_, kOfGear);
    aside_.resize(2 * n_, kOfSector);
    const double roll_mm = 0.5 * (geometry.root_form_roll_mm() + geometry.tip_form_roll_mm());
    for (Index i = 0; i < 2 * n_; ++i) {
      const int tooth = tooth_of(i / 2), side = static_cast<int>(i % 2);
      const ToothMoments& own = of_teeth[ToothMoments::at(side, tooth)];
      const Place place = geometry.on_flank(tooth, side == 1 ? 1 : -1, roll_mm,
                                            0.5 * geometry.face_width_mm());
      height_um_[i] = own.sum[0] / own.square[0];
      aside_.row(i) << normal_part(geometry, place, 1.0, 0.0), normal_part(geometry, place, 0.0, 1.0);
      gear_(i, side) = 1.0;
    }
    gear_.rightCols(kOfSector) = aside_;
  }

  std::optional<MovedSector> run() {
    if (n_ < kFewestInRing) return {};
    const Eigen::MatrixXd normal = gear_.transpose() * gear_;
    whole_um_ = symmetric_solution(normal, gear_.transpose() * height_um_);
    height_um_ -= gear_ * whole_um_;
    // Of every sector's columns the whole gear takes its part.
    const Eigen::MatrixXd of_gear = SymmetricSolver(normal).solve_columns(gear_.transpose());
    Best best;
    for (Index first = 0; first < n_; ++first) {
      Matrix2 own = Matrix2::Zero();
      Vector2 right = Vector2::Zero();
      Eigen::Matrix<double, kOfGear, kOfSector> cross, taken;
      cross.setZero();
      taken.setZero();
      for (Index count = 1; 2 * count <= n_; ++count) {
        const Index at = 2 * ((first + count - 1) % n_);
        for (const Index i : {at, at + 1}) {
          own += aside_.row(i).transpose() * aside_.row(i);
          right += height_um_[i] * aside_.row(i).transpose();
          cross += gear_.row(i).transpose() * aside_.row(i);
          taken += of_gear.col(i) * aside_.row(i);
        }
        if (count < kFewestInSector) continue;
        const Matrix2 left = own - cross.transpose() * taken;
        const double size = left(0, 0) * left(1, 1) - left(1, 0) * left(0, 1);
        if (!(size > 1e-6 * left.trace() * left.trace())) continue;
        const Vector2 aside = Vector2(left(1, 1) * right[0] - left(0, 1) * right[1],
                                      left(0, 0) * right[1] - left(1, 0) * right[0]) /
                              size;
        if (aside.dot(right) > best.square)
          best = {aside.dot(right), first, count, aside};
      }
    }
    return judged(best);
  }

 private:
  struct Best {
    double square = 0.0;
    Index first = 0, count = 0;
    Vector2 aside = Vector2::Zero();
  };

  [[nodiscard]] int tooth_of(Index place) const {
    return teeth_[static_cast<std::size_t>(place % n_)];
  }

  [[nodiscard]] std::optional<MovedSector> judged(const Best& best) const {
    const double degrees = static_cast<double>(2 * n_ - kOfGear - kOfSector);
    const double left = height_um_.squaredNorm() - best.square;
    if (best.count == 0 || !(left > 0.0)) return {};
    const double asked = static_cast<double>(n_ * (n_ / 2 - 1));
    const double p = asked * f_tail(best.square / kOfSector / (left / degrees),
                                    static_cast<double>(kOfSector), degrees);
    const double noise = left / degrees;
    if (p > kSure || largest_of_simpler() > best.square - kClearly * noise ||
        (is_more_left(best) && !says_nearly_all(best, left)))
      return {};
    // The rest standing aside is the same but for the whole gear's place: what moves that less is
    // told. Nearly all teeth aside are the gear off its bore.
    Vector2 gear_aside = whole_um_.tail(kOfSector);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(2 * n_);
    for_rows_of(best, [&](Index i) { moved[i] = aside_.row(i) * best.aside; });
    gear_aside -= symmetric_solution(gear_.transpose() * gear_, gear_.transpose() * moved).tail(kOfSector);
    const bool others = static_cast<double>(best.count) >= kLeastShare * static_cast<double>(n_) &&
                        (gear_aside + best.aside).norm() < gear_aside.norm();
    const Index begin = others ? best.first + best.count : best.first,
                count = others ? n_ - best.count : best.count;
    const int first = tooth_of(begin), last = tooth_of(begin + count - 1), z = geometry_.teeth();
    return MovedSector{first, ((last - first) % z + z) % z + 1, p, best.aside.norm()};
  }

  template <class Work>
  void for_rows_of(const Best& sector, const Work& work) const {
    for (Index k = 0; k < sector.count; ++k)
      for (const Index side : {0, 1}) work(2 * ((sector.first + k) % n_) + side);
  }

  /// What a sector of another height, or a drift once around, takes out: with a column less.
  [[nodiscard]] double largest_of_simpler() const {
    const Eigen::MatrixXd normal = gear_.transpose() * gear_;
    const Eigen::MatrixXd of_gear = SymmetricSolver(normal).solve_columns(gear_.transpose());
    double largest = 0.0;
    const auto ask = [&](const Eigen::VectorXd& form) {
      const double size = form.squaredNorm() - (gear_.transpose() * form).dot(of_gear * form);
      const double product = form.dot(height_um_);
      if (size > 1e-6 * form.squaredNorm()) largest = std::max(largest, product * product / size);
    };
    for (const double left : {1.0, -1.0})
      for (Index first = 0; first < n_; ++first) {
        Eigen::VectorXd sector = Eigen::VectorXd::Zero(2 * n_), drift(2 * n_);
        for (Index count = 1; count <= n_; ++count) {
          const Index at = 2 * ((first + count - 1) % n_);
          sector.segment(at, 2) << 1.0, left;
          drift.segment(at, 2) = static_cast<double>(count) * sector.segment(at, 2);
          if (2 * count <= n_) ask(sector);
        }
        ask(drift);
      }
    return largest;
  }

  /// True where what the sector leaves is little beside what it says, and waves on each flank, of any
  /// one order and with twice its columns, say less.
  [[nodiscard]] bool says_nearly_all(const Best& best, double left_square) const {
    constexpr double kLittle = 0.35;
    if (left_square > kLittle * best.square) return false;
    const SymmetricSolver whole(gear_.transpose() * gear_);
    const auto beside_gear = [&](Eigen::MatrixXd form) {
      form -= gear_ * whole.solve_columns(gear_.transpose() * form);
      return form;
    };
    for (Index order = 1; 2 * order <= n_; ++order) {
      Eigen::MatrixXd waves = Eigen::MatrixXd::Zero(2 * n_, 4);
      for (Index i = 0; i < 2 * n_; ++i) {
        const double angle =
            kTwoPi * static_cast<double>(order * (tooth_of(i / 2) - 1)) / geometry_.teeth();
        waves(i, 2 * (i % 2)) = std::cos(angle);
        waves(i, 2 * (i % 2) + 1) = std::sin(angle);
      }
      waves = beside_gear(std::move(waves));
      // Of half the teeth, and of once around, there is little beside the whole gear.
      Eigen::MatrixXd normal = waves.transpose() * waves;
      normal.diagonal().array() += 1e-6 * static_cast<double>(n_);
      const Eigen::VectorXd right = waves.transpose() * height_um_;
      if (right.dot(symmetric_solution(normal, right)) >= best.square) return false;
    }
    return true;
  }

  /// True where the ring of teeth has structure beside the sector.
  [[nodiscard]] bool is_more_left(const Best& best) const {
    constexpr double kNone = 0.02;
    Eigen::VectorXd rest = height_um_;
    for_rows_of(best, [&](Index i) { rest[i] -= aside_.row(i) * best.aside; });
    rest -= gear_ * symmetric_solution(gear_.transpose() * gear_, gear_.transpose() * rest);
    Eigen::MatrixXd series(n_, 2);
    std::vector<int> place;
    for (Index i = 0; i < n_; ++i) {
      series.row(i) << rest[2 * i + 1] + rest[2 * i], rest[2 * i + 1] - rest[2 * i];
      place.push_back(tooth_of(i) - 1);
    }
    return scan_ring(series, place, geometry_.teeth(), kNone).p_value <= kNone;
  }

  /// Of the teeth, that are left where they were while all others stand aside.
  static constexpr double kLeastShare = 0.25;
  /// So sure that the other tests' levels need not be shared with it.
  static constexpr double kSure = 1e-4;
  /// Chi-square by which it must beat what is simpler.
  static constexpr double kClearly = 9.0;

  const FlankGeometry& geometry_;
  std::vector<int> teeth_;
  Index n_ = 0;
  Eigen::VectorXd height_um_, whole_um_;  ///< beside the whole gear, and that
  Eigen::MatrixXd gear_, aside_;
};

constexpr int kDirections = 720;

/// Products of the part of normals along a radius, in towards so many directions: with itself and
/// with what is left, summed up to each direction from the first on, twice around.
struct RadiiAround {
  std::vector<double> squares, products;

  RadiiAround(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
              const std::vector<float>& row_um)
      : squares(2 * kDirections + 1), products(2 * kDirections + 1) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Observation& row = table.rows[i];
      if (row.kind != ObservationKind::kScanFlank || row.places != 1 ||
          patches.patch_of_row[i] < 0 || !std::isfinite(row_um[i]))
        continue;
      const Place& place = table.place(row);
      const double turns = place.polar_rad / kTwoPi;
      const auto at =
          std::min(kDirections - 1, static_cast<int>((turns - std::floor(turns)) * kDirections));
      const double radius =
          normal_part(geometry, place, place.polar_direction[0], place.polar_direction[1]);
      for (const int around : {0, kDirections}) {
        squares[static_cast<std::size_t>(at + around + 1)] += radius * radius;
        products[static_cast<std::size_t>(at + around + 1)] += radius * row_um[i];
      }
    }
    for (std::size_t k = 1; k < squares.size(); ++k) {
      squares[k] += squares[k - 1];
      products[k] += products[k - 1];
    }
  }

  struct Part {
    double square = 0.0, product = 0.0;
    [[nodiscard]] double gain() const { return square > 0.0 ? product * product / square : 0.0; }
    [[nodiscard]] double amount() const { return square > 0.0 ? product / square : 0.0; }
  };
  /// Of the directions from one on, before another.
  [[nodiscard]] Part between(int from, int to) const {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    return {squares[b] - squares[a], products[b] - products[a]};
  }
};

constexpr double kDegOfDirection = 360.0 / kDirections;

/// So many views, evenly spaced: from where they take out most.
std::optional<Effect> likeliest_views(const RadiiAround& around, int number) {
  const auto edge = [number](int from, int view) {
    return from + static_cast<int>(std::lround(double(view) * kDirections / number));
  };
  int best = 0;
  double most = 0.0;
  for (int from = 0; from < kDirections / number; ++from) {
    double gain = 0.0;
    for (int view = 0; view < number; ++view)
      gain += around.between(edge(from, view), edge(from, view + 1)).gain();
    if (gain > most) {
      most = gain;
      best = from;
    }
  }
  EffectShape shape{double(number), best * kDegOfDirection};
  double square = 0.0;
  for (int view = 0; view < number; ++view) {
    shape.push_back(around.between(edge(best, view), edge(best, view + 1)).amount());
    square += shape.back() * shape.back() / number;
  }
  if (!(square > 0.0)) return {};
  for (std::size_t k = 2; k < shape.size(); ++k) shape[k] /= std::sqrt(square);
  return Effect{find_family("unnamed_views"), FlankChoice::kBoth, std::move(shape)};
}

/// Drifts that are nothing at the mean, where they begin and where they end: each from where it
/// takes out most.
std::vector<Effect> likeliest_spirals(const RadiiAround& around) {
  std::vector<Effect> spirals;
  for (const auto& [zero_at, nothing] :
       {std::pair(gear_effects::kMeanOfDrift, 0.5), std::pair(gear_effects::kFirstOfDrift, 0.0),
        std::pair(gear_effects::kLastOfDrift, 1.0)}) {
    int best = 0;
    double most = 0.0;
    for (int from = 0; from < kDirections; from += 2) {
      RadiiAround::Part sum;
      for (int k = 0; k < kDirections; ++k) {
        const RadiiAround::Part one = around.between(from + k, from + k + 1);
        const double value = (k + 0.5) / kDirections - nothing;
        sum.square += value * value * one.square;
        sum.product += value * one.product;
      }
      if (sum.gain() > most) {
        most = sum.gain();
        best = from;
      }
    }
    spirals.push_back({find_family("unnamed_spiral"),
                       FlankChoice::kBoth,
                       {best * kDegOfDirection, zero_at, 0.0}});
  }
  return spirals;
}

}  // namespace

std::vector<Effect> views_and_spirals(const FlankGeometry& geometry, const Observations& table,
                                      const Patches& patches, const std::vector<float>& row_um) {
  constexpr int kMostViews = 8;
  const RadiiAround around(geometry, table, patches, row_um);
  std::vector<Effect> forms = likeliest_spirals(around);
  for (int number = 2; number <= kMostViews; ++number)
    if (std::optional<Effect> views = likeliest_views(around, number))
      forms.push_back(std::move(*views));
  return forms;
}

std::optional<MovedSector> moved_sector(const FlankGeometry& geometry,
                                        const std::vector<ToothMoments>& of_teeth) {
  return SectorSearch(geometry, of_teeth).run();
}

}  // namespace trueflank::loop
