// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/toothing_path.h"

#include <algorithm>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/solid/brep/spline_patch.h"
#include "trueflank/solid/brep/tooth_columns.h"

namespace trueflank {
namespace {

class ToothingPath {
 public:
  ToothingPath(const ToothedOutline& outline, const PathTolerance& tolerance)
      : outline_(outline), columns_(outline.toothing(), tolerance.shortest_mm),
        tolerance_(tolerance), count_(columns_.columns().size()),
        z_mm_(0.5 * outline.twist.face_width_mm) {
    teeth_fitted_ = columns_.teeth_alike() ? 1 : columns_.teeth();
  }

  OutlinePath build() {
    for (std::size_t c = 0; c < count_; ++c) fit_column(c);
    for (int tooth = 0; tooth < columns_.teeth(); ++tooth)
      for (std::size_t c = 0; c < count_; ++c) place(tooth, c);
    auto& pieces = path_.pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (auto* spline = std::get_if<PathSpline>(&pieces[i].shape)) {
        spline->spline.poles.front() = pieces[i].start;
        spline->spline.poles.back() = pieces[(i + 1) % pieces.size()].start;
      }
    return std::move(path_);
  }

 private:
  /// A column as fitted: an arc of a circle, or a spline a tooth.
  struct Fitted {
    int circle = -1;
    std::vector<PlaneSpline> splines;
  };

  [[nodiscard]] Point3 point(int tooth, std::size_t c, double u) const {
    const auto p = columns_.point(tooth, c, u, z_mm_);
    return {p[0], p[1], 0.0};
  }
  [[nodiscard]] Point2 joint(int tooth, std::size_t c) const {
    const auto p = columns_.joint(tooth, c, z_mm_);
    return {p[0], p[1]};
  }

  void fit_column(std::size_t c) {
    fitted_.emplace_back();
    const ToothColumn& column = columns_.columns()[c];
    const bool half = column.kind == ToothColumn::Kind::kHalf;
    if (!half && outline_.displacement == nullptr) {
      const double free_rad =
          column.kind == ToothColumn::Kind::kTipLand ? kPi / columns_.teeth() : 0.0;
      fitted_.back().circle = static_cast<int>(path_.circles.size());
      path_.circles.push_back({Point2::Zero(), columns_.land_radius_mm(c, z_mm_),
                               free_rad + outline_.rotation_rad +
                                   section_turn_rad(outline_.twist, z_mm_)});
      return;
    }
    const bool flank = half && outline_.profile->pieces()[column.piece].kind == PieceKind::kInvolute;
    const BasisFit fit = fit_basis([&](double u) { return lines(c, u); },
                                   flank ? tolerance_.flank_mm : tolerance_.fillet_mm);
    path_.fit_error_mm = std::max(path_.fit_error_mm, fit.error_mm);
    const SplineInterpolation interpolation(fit.basis);
    for (int tooth = 0; tooth < teeth_fitted_; ++tooth) add_spline(interpolation, tooth, c);
  }

  [[nodiscard]] Eigen::RowVectorXd lines(std::size_t c, double u) const {
    Eigen::RowVectorXd row(3 * teeth_fitted_);
    for (int tooth = 0; tooth < teeth_fitted_; ++tooth)
      row.segment<3>(3 * tooth) = point(tooth, c, u).transpose();
    return row;
  }

  /// What leads a spline's ends to the joints counts as its error, too.
  void add_spline(const SplineInterpolation& interpolation, int tooth, std::size_t c) {
    const SplineBasis& basis = interpolation.basis();
    PlaneSpline spline{.degree = basis.degree(), .poles = {}, .knots = basis.knots(),
                       .multiplicities = basis.multiplicities()};
    for (const Point3& p :
         interpolated_curve(interpolation, [&](double u) { return point(tooth, c, u); }))
      spline.poles.emplace_back(p.head<2>());
    const bool last = c + 1 == count_;
    const Point2 end = last ? joint((tooth + 1) % columns_.teeth(), 0) : joint(tooth, c + 1);
    path_.fit_error_mm = std::max({path_.fit_error_mm, (spline.poles.front() - joint(tooth, c)).norm(),
                                   (spline.poles.back() - end).norm()});
    fitted_.back().splines.push_back(std::move(spline));
  }

  void place(int tooth, std::size_t c) {
    const int fitted = teeth_fitted_ == 1 ? 0 : tooth;
    const double turn =
        outline_.rotation_rad + (teeth_fitted_ == 1 ? kTwoPi * tooth / columns_.teeth() : 0.0);
    PathPiece piece;
    piece.start = rotated(joint(fitted, c), turn);
    if (fitted_[c].circle >= 0) {
      piece.shape = PathArc{fitted_[c].circle};
    } else {
      PathSpline spline{fitted_[c].splines[static_cast<std::size_t>(fitted)]};
      for (Point2& pole : spline.spline.poles) pole = rotated(pole, turn);
      piece.shape = std::move(spline);
    }
    path_.pieces.push_back(std::move(piece));
  }

  const ToothedOutline& outline_;
  ToothColumns columns_;
  PathTolerance tolerance_;
  std::size_t count_;
  double z_mm_;
  int teeth_fitted_ = 1;
  std::vector<Fitted> fitted_;  ///< one a column
  OutlinePath path_;
};

}  // namespace

bool is_plain(const Toothing& toothing) {
  return !toothing.has_deviation() && toothing.displacement == nullptr &&
         toothing.edge_chamfer_mm == 0.0;
}

OutlinePath toothing_path(const ToothedOutline& outline, const PathTolerance& tolerance) {
  return ToothingPath(outline, tolerance).build();
}

}  // namespace trueflank
