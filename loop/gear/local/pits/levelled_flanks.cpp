// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/pits/levelled_flanks.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

constexpr Eigen::Index kPoly = 6;
using Polynomial = Eigen::Matrix<double, kPoly, 1>;

/// What a flank has smoothly by itself: a polynomial of the second degree.
Polynomial terms_at(double u, double v) {
  Polynomial t;
  t << 1.0, u, v, u * u, u * v, v * v;
  return t;
}

class Leveller {
 public:
  Leveller(const FlankGeometry& geometry, LevelledFlanks& of) : geometry_(geometry), of_(of) {}

  /// Takes away what the flanks of a side have in common, place by place, and what each has
  /// smoothly by itself, as most of its points say.
  void run() {
    const std::size_t flanks = of_.points.size();
    for_each_piece(flanks, [&](std::size_t flank) { level(of_.points[flank]); });
    constexpr int kParts = 40;
    constexpr double kSome = 16'000.0;
    constexpr std::size_t kFewestOfLine = 9;
    const auto stride = static_cast<std::size_t>(1.0 + of_.number / kSome);
    std::array<std::array<double, kParts>, 4> common{};
    for_each_piece(common.size(), [&](std::size_t piece) {
      // (lines over the profile and over the face: what a few flanks have there hardly moves them)
      const std::size_t side = piece % 2;
      const bool over_face = piece >= 2;
      std::array<std::vector<float>, kParts> lines;
      for (std::size_t flank = side; flank < flanks; flank += 2)
        for (std::size_t i = 0; i < of_.points[flank].size(); i += stride) {
          const PointOfFlank& p = of_.points[flank][i];
          lines[part(over_face ? v_of(p) : u_of(p), kParts)].push_back(static_cast<float>(p.um));
        }
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (lines[k].size() >= kFewestOfLine)
          common[piece][k] = static_cast<double>(median(std::move(lines[k])));
    });
    for_each_piece(flanks, [&](std::size_t flank) {
      for (PointOfFlank& p : of_.points[flank])
        p.um -=
            common[flank % 2][part(u_of(p), kParts)] + common[2 + flank % 2][part(v_of(p), kParts)];
    });
    std::vector<float> sizes;
    for (const auto& points : of_.points)
      for (std::size_t i = 0; i < points.size(); i += stride)
        sizes.push_back(static_cast<float>(points[i].um));
    of_.sigma_um = robust_sigma(std::move(sizes));
  }

 private:
  [[nodiscard]] double u_of(const PointOfFlank& p) const {
    return 2.0 * (p.along_mm - of_.low_mm) / of_.length_mm - 1.0;
  }
  [[nodiscard]] double v_of(const PointOfFlank& p) const {
    return geometry_.face_coordinate(p.up_mm);
  }
  [[nodiscard]] static std::size_t part(double coordinate, int parts) {
    return static_cast<std::size_t>(part_of(coordinate, parts));
  }

  /// Least squares of some of the points, then without what lies far from them.
  void level(std::vector<PointOfFlank>& points) const {
    if (points.size() < LevelledFlanks::kFewestPoints) return;
    constexpr std::size_t kSome = 1500;
    const std::size_t stride = 1 + points.size() / kSome;
    double limit = 1e300;
    Polynomial found = Polynomial::Zero();
    for (int turn = 0; turn < 3; ++turn) {
      Eigen::Matrix<double, kPoly, kPoly> normal =
          1e-9 * Eigen::Matrix<double, kPoly, kPoly>::Identity();
      Polynomial right = Polynomial::Zero();
      std::vector<float> left;
      for (std::size_t i = 0; i < points.size(); i += stride) {
        const Polynomial t = terms_at(u_of(points[i]), v_of(points[i]));
        const double um = points[i].um - found.dot(t);
        if (turn == 1) left.push_back(static_cast<float>(um));
        if (std::abs(um) > limit) continue;
        normal += t * t.transpose();
        right += points[i].um * t;
      }
      found = normal.ldlt().solve(right);
      if (turn == 1) limit = 3.0 * robust_sigma(std::move(left));
    }
    for (PointOfFlank& p : points) p.um -= found.dot(terms_at(u_of(p), v_of(p)));
  }

  const FlankGeometry& geometry_;
  LevelledFlanks& of_;
};

}  // namespace

LevelledFlanks levelled_flanks(const FlankGeometry& geometry, const Observations& table,
                               std::size_t fewest) {
  LevelledFlanks of;
  const double root = geometry.arc_at_roll_mm(geometry.root_form_roll_mm()),
               tip = geometry.arc_at_roll_mm(geometry.tip_form_roll_mm());
  of.low_mm = std::min(root, tip);
  of.length_mm = std::abs(tip - root);
  of.face_mm = geometry.face_width_mm();
  of.points.resize(2 * static_cast<std::size_t>(geometry.teeth()));
  const RowsByClass rows(table.points_mm.size(), of.points.size(), [&](std::size_t i) {
    const Observation& row = table.rows[i];
    const Place& place = table.place(row);
    return row.kind == ObservationKind::kScanFlank && place.surface == Surface::kFlank
               ? 2 * (place.tooth - 1) + (place.side > 0 ? 1 : 0)
               : -1;
  });
  for_each_piece(of.points.size(), [&](std::size_t flank) {
    std::vector<PointOfFlank>& points = of.points[flank];
    points.reserve(rows.count(flank));
    rows.for_each(flank, table, [&](std::size_t i) {
      const Place& place = table.place(table.rows[i]);
      points.push_back(
          {geometry.arc_at_roll_mm(place.roll_mm), place.z_mm, table.rows[i].deviation_um});
    });
  });
  std::size_t seen = 0;
  for (std::size_t flank = 0; flank < of.points.size(); ++flank) {
    if (!of.has_enough(flank)) continue;
    ++seen;
    of.number += static_cast<double>(of.points[flank].size());
  }
  if (seen < fewest) return of;
  of.area_mm2 = static_cast<double>(seen) * of.length_mm * of.face_mm;
  Leveller(geometry, of).run();
  return of;
}

}  // namespace trueflank::loop
