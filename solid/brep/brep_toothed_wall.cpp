// SPDX-License-Identifier: GPL-3.0-or-later
//
// A toothing that changes along the face is a grid: columns round the section, bands between the
// heights where it bends. Faces share the edges of the grid. All columns of a band have one basis
// along the face and all bands of a column one across, so that a spline face ends in the very
// curves of its edges.
#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/contract.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/brep/brep_wall.h"
#include "trueflank/solid/brep/spline_patch.h"
#include "trueflank/solid/brep/tooth_columns.h"

namespace trueflank {
namespace {

/// A band lower than this is no band; the heights that bound it are taken for one.
constexpr double kLowestBand_mm = 1e-4;
/// How far a displacement may move the ends out of their planes.
constexpr double kFlat_mm = 1e-9;
/// Fits that miss what they were asked by more than this are asked for a quarter.
constexpr double kWorseThanAsked = 3.0;
constexpr int kTightenings = 3;

class ToothedWallBuilder {
 public:
  ToothedWallBuilder(Brep& brep, Wall& wall, const ToothColumns& columns,
                     const PathTolerance& tolerance)
      : brep_(brep), wall_(wall), outline_(std::get<ToothedOutline>(*wall.outline)),
        columns_(columns), tolerance_(tolerance), across_(columns.columns().size()) {
    teeth_fitted_ = columns.teeth_alike() ? 1 : columns.teeth();
    count_ = columns.columns().size();
  }

  Status build(double z_lower_mm, double z_upper_mm) {
    find_levels(z_lower_mm, z_upper_mm);
    find_cylinders();
    double error_mm = 0.0, share = 1.0;
    for (int i = 0; i <= kTightenings; ++i, share *= 0.25) {
      const double bases_mm = choose_bases(share);
      if (!(bases_mm <= kSurfaceContract_mm)) return fail(too_rough(bases_mm));
      fit_patches();
      error_mm = patches_error_mm();
      if (error_mm <= kWorseThanAsked * coarsest_mm()) break;
    }
    if (!(error_mm <= kSurfaceContract_mm)) return fail(too_rough(error_mm));
    brep_.fit_error_mm = std::max(brep_.fit_error_mm, error_mm);
    add_vertices();
    add_risers();
    for (std::size_t r = 0; r < levels_mm_.size(); ++r) add_level(r);
    for (std::size_t r = 0; r + 1 < levels_mm_.size(); ++r)
      for (std::size_t g = 0; g < all(); ++g) add_face(r, g);
    wall_.lower = level_edges_.front();
    wall_.upper = level_edges_.back();
    return {};
  }

 private:
  using Column = ToothColumn;
  [[nodiscard]] std::size_t all() const { return count_ * static_cast<std::size_t>(columns_.teeth()); }
  [[nodiscard]] std::size_t next(std::size_t g) const { return (g + 1) % all(); }
  [[nodiscard]] std::size_t bands() const { return levels_mm_.size() - 1; }
  [[nodiscard]] const Toothing& toothing() const { return columns_.toothing(); }
  [[nodiscard]] bool displaced() const { return toothing().displacement != nullptr; }
  [[nodiscard]] bool is_land(std::size_t c) const {
    return columns_.columns()[c].kind != Column::Kind::kHalf;
  }
  [[nodiscard]] double coarsest_mm() const {
    return std::max({tolerance_.flank_mm, tolerance_.fillet_mm, tolerance_.lead_mm});
  }

  // ---------------------------------------------------------------- frames

  /// Height in the gear's own frame, of a share of a band.
  [[nodiscard]] double own_z(std::size_t band, double v) const {
    const double z = levels_mm_[band] + v * (levels_mm_[band + 1] - levels_mm_[band]);
    return std::clamp(z - outline_.z_lower_mm, 0.0, toothing().twist.face_width_mm);
  }
  static Point3 vector_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
  [[nodiscard]] Point3 point(int tooth, std::size_t c, std::size_t band, double u, double v) const {
    return vector_of(columns_.point(tooth, c, u, own_z(band, v)));
  }
  [[nodiscard]] Point3 joint(int tooth, std::size_t c, std::size_t band, double v) const {
    return vector_of(columns_.joint(tooth, c, own_z(band, v)));
  }
  /// The tooth that was fitted for a tooth, and how far that one is turned on.
  [[nodiscard]] int fitted(std::size_t g) const {
    return teeth_fitted_ == 1 ? 0 : static_cast<int>(g / count_);
  }
  [[nodiscard]] double turn_rad(std::size_t g) const {
    if (teeth_fitted_ > 1) return outline_.rotation_rad;
    return outline_.rotation_rad +
           kTwoPi * static_cast<double>(g / count_) / static_cast<double>(columns_.teeth());
  }
  /// From the gear's frame to the part's.
  [[nodiscard]] Point3 placed(const Point3& p, std::size_t g) const {
    const Point2 turned = rotated(Point2(p.x(), p.y()), turn_rad(g));
    return {turned.x(), turned.y(), p.z() + outline_.z_lower_mm};
  }
  [[nodiscard]] std::vector<Point3> placed(std::vector<Point3> points, std::size_t g) const {
    for (Point3& p : points) p = placed(p, g);
    return points;
  }

  // ---------------------------------------------------------------- grid

  void find_levels(double z_lower_mm, double z_upper_mm) {
    std::vector<double> inner;
    const double width = toothing().twist.face_width_mm, chamfer = toothing().edge_chamfer_mm;
    if (toothing().twist.herringbone) inner.push_back(0.5 * width);
    if (chamfer > 0.0) inner.insert(inner.end(), {chamfer, width - chamfer});
    if (toothing().has_deviation())
      for (const double z : toothing().deviation->z_breaks_mm) inner.push_back(z);
    std::sort(inner.begin(), inner.end());
    levels_mm_ = {z_lower_mm};
    for (const double own : inner) {
      const double z = own + outline_.z_lower_mm;
      if (z > levels_mm_.back() + kLowestBand_mm && z < z_upper_mm - kLowestBand_mm)
        levels_mm_.push_back(z);
    }
    levels_mm_.push_back(z_upper_mm);
  }

  /// Lands of one radius through a band are true cylinders.
  void find_cylinders() {
    cylinder_.assign(bands(), std::vector<bool>(count_, false));
    for (std::size_t r = 0; r < bands(); ++r)
      for (std::size_t c = 0; c < count_; ++c) {
        if (!is_land(c) || displaced()) continue;
        const double radius = columns_.land_radius_mm(c, own_z(r, 0.0));
        cylinder_[r][c] = std::abs(columns_.land_radius_mm(c, own_z(r, 0.5)) - radius) < 1e-9 &&
                          std::abs(columns_.land_radius_mm(c, own_z(r, 1.0)) - radius) < 1e-9;
      }
  }
  [[nodiscard]] bool ever_spline(std::size_t c) const {
    return std::any_of(cylinder_.begin(), cylinder_.end(), [&](const auto& b) { return !b[c]; });
  }

  // ---------------------------------------------------------------- fit

  /// Returns the worst distance of the lines that the bases were chosen for.
  double choose_bases(double share) {
    double worst = 0.0;
    const auto best = [&](const LineBundle& lines, double tolerance_mm) {
      BasisFit fit = fit_basis(lines, tolerance_mm);
      worst = std::max(worst, fit.error_mm);
      return std::move(fit.basis);
    };
    for (std::size_t c = 0; c < count_; ++c) {
      if (!ever_spline(c)) continue;
      const Column& column = columns_.columns()[c];
      const bool flank = column.kind == Column::Kind::kHalf &&
                         toothing().profile->pieces()[column.piece].kind == PieceKind::kInvolute;
      across_[c].emplace(best([&](double u) { return lines_across(c, u); },
                              share * (flank ? tolerance_.flank_mm : tolerance_.fillet_mm)));
    }
    along_.clear();
    for (std::size_t r = 0; r < bands(); ++r)
      along_.emplace_back(
          best([&](double v) { return lines_along(r, v); }, share * tolerance_.lead_mm));
    return worst;
  }

  [[nodiscard]] Eigen::RowVectorXd lines_across(std::size_t c, double u) const {
    static constexpr double kHeights[] = {0.0, 0.3, 0.7, 1.0};
    Eigen::RowVectorXd row(static_cast<Eigen::Index>(bands()) * teeth_fitted_ * 3 * 4);
    Eigen::Index at = 0;
    for (int tooth = 0; tooth < teeth_fitted_; ++tooth)
      for (std::size_t r = 0; r < bands(); ++r)
        for (const double v : kHeights) {
          row.segment<3>(at) = point(tooth, c, r, u, v).transpose();
          at += 3;
        }
    return row;
  }

  [[nodiscard]] Eigen::RowVectorXd lines_along(std::size_t band, double v) const {
    static constexpr double kPlaces[] = {0.3, 0.7};
    Eigen::RowVectorXd row(static_cast<Eigen::Index>(count_) * teeth_fitted_ * 3 * 3);
    Eigen::Index at = 0;
    const auto add = [&](const Point3& p) {
      row.segment<3>(at) = p.transpose();
      at += 3;
    };
    for (int tooth = 0; tooth < teeth_fitted_; ++tooth)
      for (std::size_t c = 0; c < count_; ++c) {
        add(joint(tooth, c, band, v));
        for (const double u : kPlaces) add(point(tooth, c, band, u, v));
      }
    return row;
  }

  [[nodiscard]] std::size_t patch_index(std::size_t band, int tooth, std::size_t c) const {
    return (band * static_cast<std::size_t>(teeth_fitted_) + static_cast<std::size_t>(tooth)) * count_ + c;
  }

  void fit_patches() {
    patches_.assign(bands() * static_cast<std::size_t>(teeth_fitted_) * count_, {});
    for (std::size_t r = 0; r < bands(); ++r)
      for (int tooth = 0; tooth < teeth_fitted_; ++tooth)
        for (std::size_t c = 0; c < count_; ++c)
          if (!cylinder_[r][c])
            patches_[patch_index(r, tooth, c)] =
                interpolated_patch(*across_[c], along_[r], [&](double u, double v) {
                  return point(tooth, c, r, u, v);
                });
  }

  [[nodiscard]] double patches_error_mm() const {
    double worst = 0.0;
    for (std::size_t r = 0; r < bands(); ++r)
      for (int tooth = 0; tooth < teeth_fitted_; ++tooth)
        for (std::size_t c = 0; c < count_; ++c)
          if (!cylinder_[r][c])
            worst = std::max(worst, patch_error_mm(across_[c]->basis(), along_[r].basis(),
                                                   patches_[patch_index(r, tooth, c)],
                                                   [&](double u, double v) {
                                                     return point(tooth, c, r, u, v);
                                                   }));
    return worst;
  }

  // ---------------------------------------------------------------- edges

  void add_vertices() {
    for (std::size_t r = 0; r < levels_mm_.size(); ++r) {
      vertices_.emplace_back();
      for (std::size_t g = 0; g < all(); ++g) {
        const bool top = r == bands();
        Point3 p = placed(joint(fitted(g), g % count_, top ? r - 1 : r, top ? 1.0 : 0.0), g);
        if (is_end(r) || !displaced()) p.z() = levels_mm_[r];
        vertices_.back().push_back(add_to(brep_.vertices, p));
      }
    }
  }
  [[nodiscard]] bool is_end(std::size_t level) const { return level == 0 || level == bands(); }
  [[nodiscard]] const Point3& vertex(std::size_t level, std::size_t g) const {
    return brep_.vertices[static_cast<std::size_t>(vertices_[level][g])];
  }

  int add_spline_edge(const SplineBasis& basis, std::vector<Point3> poles, int start, int end) {
    poles.front() = brep_.vertices[static_cast<std::size_t>(start)];
    poles.back() = brep_.vertices[static_cast<std::size_t>(end)];
    const int curve = add_to<BrepCurve>(brep_.curves, spline_curve(basis, std::move(poles)));
    return add_to(brep_.edges, BrepEdge{start, end, curve});
  }

  /// The edges that rise between columns.
  void add_risers() {
    for (std::size_t r = 0; r < bands(); ++r) {
      risers_.emplace_back();
      std::vector<std::vector<Point3>> poles;
      for (std::size_t g = 0; g < count_ * static_cast<std::size_t>(teeth_fitted_); ++g)
        poles.push_back(interpolated_curve(
            along_[r], [&](double v) { return joint(fitted(g), g % count_, r, v); }));
      for (std::size_t g = 0; g < all(); ++g)
        risers_.back().push_back(add_spline_edge(along_[r].basis(),
                                                 placed(poles[g % poles.size()], g),
                                                 vertices_[r][g], vertices_[r + 1][g]));
    }
  }

  /// The edges round the section at a level: arcs of circles about the axis, and splines.
  void add_level(std::size_t level) {
    const std::size_t band = level == bands() ? level - 1 : level;
    const double v = level == bands() ? 1.0 : 0.0;
    std::vector<int> circles(count_, -1);
    std::vector<std::vector<Point3>> poles(count_ * static_cast<std::size_t>(teeth_fitted_));
    for (std::size_t g = 0; g < poles.size(); ++g) {
      const std::size_t c = g % count_;
      if (is_land(c) && !displaced()) {
        circles[c] = add_to<BrepCurve>(brep_.curves, level_circle(c, level, own_z(band, v)));
        continue;
      }
      poles[g] = interpolated_curve(*across_[c],
                                    [&](double u) { return point(fitted(g), c, band, u, v); });
    }
    level_edges_.emplace_back();
    for (std::size_t g = 0; g < all(); ++g) {
      const int start = vertices_[level][g], end = vertices_[level][next(g)];
      const int circle = circles[g % count_];
      level_edges_.back().push_back(
          {circle >= 0 ? add_to(brep_.edges, BrepEdge{start, end, circle})
                       : add_spline_edge(across_[g % count_]->basis(),
                                         level_poles(poles[g % poles.size()], level, g), start, end),
           true});
    }
  }

  std::vector<Point3> level_poles(const std::vector<Point3>& own, std::size_t level, std::size_t g) {
    std::vector<Point3> poles = placed(own, g);
    if (is_end(level) || !displaced())
      for (Point3& p : poles) p.z() = levels_mm_[level];
    return poles;
  }

  /// Shared by all lands of a level; it begins where none of them is.
  [[nodiscard]] CircleCurve level_circle(std::size_t c, std::size_t level, double own_z_mm) const {
    const bool tip = columns_.columns()[c].kind == Column::Kind::kTipLand;
    const double free_rad = (tip ? kPi / columns_.teeth() : 0.0) + outline_.rotation_rad +
                            section_turn_rad(toothing().twist, own_z_mm);
    return {{{0.0, 0.0, levels_mm_[level]}, Point3::UnitZ(), at_height(unit_vector(free_rad), 0.0)},
            columns_.land_radius_mm(c, own_z_mm)};
  }

  // ---------------------------------------------------------------- faces

  void add_face(std::size_t r, std::size_t g) {
    BrepFace face;
    face.same_sense = wall_.outer;
    if (cylinder_[r][g % count_])
      face.surface = add_to<BrepSurface>(brep_.surfaces, cylinder(r, g));
    else
      face.surface = add_to<BrepSurface>(brep_.surfaces, patch(r, g));
    face.loops = {wall_face_loop(wall_.outer, level_edges_[r][g], {risers_[r][next(g)], true},
                                 level_edges_[r + 1][g], {risers_[r][g], true})};
    brep_.faces.push_back(std::move(face));
  }

  /// A cylinder a face: its seam is opposite the face, wherever that winds to.
  [[nodiscard]] CylinderSurface cylinder(std::size_t r, std::size_t g) const {
    const Point3 middle =
        vertex(r, g) + vertex(r, next(g)) + vertex(r + 1, g) + vertex(r + 1, next(g));
    const Point2 away = -Point2(middle.x(), middle.y()).normalized();
    return {{{0.0, 0.0, levels_mm_[r]}, Point3::UnitZ(), at_height(away, 0.0)},
            columns_.land_radius_mm(g % count_, own_z(r, 0.0))};
  }

  /// The fitted patch, its rim made of the poles of its edges.
  [[nodiscard]] SplineSurface patch(std::size_t r, std::size_t g) const {
    const SplineBasis &u = across_[g % count_]->basis(), &v = along_[r].basis();
    std::vector<Point3> poles = placed(patches_[patch_index(r, fitted(g), g % count_)], g);
    const auto nu = static_cast<std::size_t>(u.count()), nv = static_cast<std::size_t>(v.count());
    const auto edge_poles = [&](int edge) -> const std::vector<Point3>* {
      const auto* s = std::get_if<SplineCurve>(
          &brep_.curves[static_cast<std::size_t>(brep_.edges[static_cast<std::size_t>(edge)].curve)]);
      return s ? &s->poles : nullptr;
    };
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      if (const auto* level = edge_poles(level_edges_[r + end][g].edge))
        for (std::size_t i = 0; i < nu; ++i) poles[i * nv + end * (nv - 1)] = (*level)[i];
      const auto& riser = *edge_poles(risers_[r][end == 0 ? g : next(g)]);
      for (std::size_t j = 0; j < nv; ++j) poles[end * (nu - 1) * nv + j] = riser[j];
    }
    return spline_surface(u, v, std::move(poles));
  }

  Brep& brep_;
  Wall& wall_;
  const ToothedOutline& outline_;
  const ToothColumns& columns_;
  PathTolerance tolerance_;
  int teeth_fitted_ = 1;
  std::size_t count_ = 0;           ///< columns of a tooth
  std::vector<double> levels_mm_;   ///< in the part's frame
  std::vector<std::vector<bool>> cylinder_;  ///< [band][column]
  std::vector<std::optional<SplineInterpolation>> across_;
  std::vector<SplineInterpolation> along_;
  std::vector<std::vector<Point3>> patches_;
  std::vector<std::vector<int>> vertices_, risers_;  ///< [level or band][column of the gear]
  std::vector<std::vector<OrientedEdge>> level_edges_;
};

/// Whether a displacement leaves the ends where they are.
Status check_ends(const ToothColumns& columns) {
  if (columns.toothing().displacement == nullptr) return {};
  for (const double z : {0.0, columns.toothing().twist.face_width_mm})
    for (int tooth = 0; tooth < columns.teeth(); ++tooth)
      for (std::size_t c = 0; c < columns.columns().size(); ++c)
        for (const double u : {0.0, 0.37, 0.71}) {
          const double off = columns.point(tooth, c, u, z)[2] - z;
          if (std::abs(off) > kFlat_mm)
            return fail({.code = ErrorCode::kUnsupported,
                         .message = "the displacement moves the toothing's ends out of their planes (" +
                                    trimmed_number(um_from_mm(off)) + " um)",
                         .remedy = "a mesh format"});
        }
  return {};
}

}  // namespace

Status add_toothed_wall(Brep& brep, Wall& wall, double z_lower_mm, double z_upper_mm,
                        const PathTolerance& tolerance) {
  const auto& outline = std::get<ToothedOutline>(*wall.outline);
  const ToothColumns columns(outline.toothing(), tolerance.shortest_mm);
  if (auto ok = check_ends(columns); !ok) return ok;
  return ToothedWallBuilder(brep, wall, columns, tolerance).build(z_lower_mm, z_upper_mm);
}

}  // namespace trueflank
