// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/brep/tooth_columns.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/bezier_fit.h"
#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

/// A strip of the flank between two breaks is at least this wide; a break nearer to an end is none.
constexpr double kNarrowestStrip_mm = 1e-4;

bool is_land(const ProfilePiece& piece) {
  return piece.kind == PieceKind::kTip || piece.kind == PieceKind::kRoot;
}

double distance_mm(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

ToothColumns::ToothColumns(const Toothing& toothing, double shortest_mm)
    : toothing_(toothing), shortest_mm_(shortest_mm) {
  TRUEFLANK_EXPECTS(toothing.profile != nullptr);
  add_columns();
}

bool ToothColumns::teeth_alike() const {
  return toothing_.displacement == nullptr &&
         !(toothing_.has_deviation() && toothing_.deviation->varies_by_tooth);
}

void ToothColumns::add_columns() {
  const auto& pieces = toothing_.profile->pieces();
  const auto length = [](const ProfilePiece& p) {
    return (p.curve.end_point() - p.curve.start_point()).norm();
  };
  std::vector<ToothColumn> left, right;  // from the tip down
  bool tip = false, root = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].kind == PieceKind::kInvolute) flank_ = i;
    if (length(pieces[i]) < shortest_mm_) continue;
    if (pieces[i].kind == PieceKind::kTip) tip = true;
    if (pieces[i].kind == PieceKind::kRoot) root = true;
    if (is_land(pieces[i])) continue;
    for (const int side : {1, -1}) {
      const std::vector<int> breaks =
          i == flank_ && pieces[i].kind == PieceKind::kInvolute ? breaks_within(side)
                                                                : std::vector<int>{};
      auto& half = side > 0 ? left : right;
      int upper = -1;
      for (const int next : breaks) {
        half.push_back({.side = side, .piece = i, .upper_break = upper, .lower_break = next});
        upper = next;
      }
      half.push_back({.side = side, .piece = i, .upper_break = upper, .lower_break = -1});
    }
  }
  columns_.assign(right.rbegin(), right.rend());
  if (tip) columns_.push_back({.kind = ToothColumn::Kind::kTipLand, .piece = 0});
  columns_.insert(columns_.end(), left.begin(), left.end());
  if (root) columns_.push_back({.kind = ToothColumn::Kind::kRootLand, .piece = pieces.size() - 1});
}

/// Breaks of the deviation that lie on the flank, from the tip down.
std::vector<int> ToothColumns::breaks_within(int side) const {
  if (!toothing_.has_deviation()) return {};
  const Curve& curve = toothing_.profile->pieces()[flank_].curve;
  const double r_b = base_radius_mm(toothing_.profile->gear());
  const double z_middle = 0.5 * toothing_.twist.face_width_mm;
  const double narrowest = std::max(shortest_mm_, kNarrowestStrip_mm);
  std::vector<std::pair<double, int>> found;  // way from the tip [mm]
  const auto way = [&](double roll) {
    return 0.5 * r_b * std::abs(roll * roll - curve.begin * curve.begin);
  };
  const double whole = way(curve.end);
  for (std::size_t i = 0; i < toothing_.deviation->roll_breaks_mm.size(); ++i) {
    const double roll = break_at(0, side, static_cast<int>(i), z_middle);
    if ((roll - curve.begin) * (roll - curve.end) >= 0.0) continue;
    const double here = way(roll);
    if (here > narrowest && here < whole - narrowest) found.emplace_back(here, static_cast<int>(i));
  }
  std::sort(found.begin(), found.end());
  std::vector<int> breaks;
  double last = 0.0;
  for (const auto& [here, index] : found) {
    if (here - last <= narrowest) continue;
    breaks.push_back(index);
    last = here;
  }
  return breaks;
}

double ToothColumns::break_at(int tooth, int side, int index, double z_mm) const {
  return break_parameter(toothing_, tooth, side,
                         toothing_.deviation->roll_breaks_mm[static_cast<std::size_t>(index)],
                         z_mm);
}

ToothPlace ToothColumns::place(int tooth, const ToothColumn& column, double u, double z_mm) const {
  Curve run = toothing_.profile->pieces()[column.piece].curve;
  if (column.upper_break >= 0) run.begin = break_at(tooth, column.side, column.upper_break, z_mm);
  if (column.lower_break >= 0) run.end = break_at(tooth, column.side, column.lower_break, z_mm);
  return {.tooth = tooth, .side = column.side, .piece = column.piece,
          .parameter = fit_parameter_at(run, column.side > 0 ? u : 1.0 - u)};
}

std::array<double, 2> ToothColumns::land_corners_rad(int tooth, const ToothColumn& column,
                                                     double z_mm) const {
  const bool tip = column.kind == ToothColumn::Kind::kTipLand;
  const Curve& curve = toothing_.profile->pieces()[column.piece].curve;
  Toothing plain = toothing_;
  plain.displacement = nullptr;
  const auto angle = [&](int of_tooth, int side) {
    const auto p = surface_point(plain, {.tooth = of_tooth, .side = side, .piece = column.piece,
                                         .parameter = tip ? curve.end : curve.begin}, z_mm);
    return polar_angle_rad({p[0], p[1]});
  };
  const double from = tip ? angle(tooth, -1) : angle(tooth, 1);
  const double to = tip ? angle(tooth, 1) : angle((tooth + 1) % teeth(), -1);
  return {from, from + centred_rad(to - from)};
}

double ToothColumns::land_radius_mm(std::size_t column, double z_mm) const {
  const ToothColumn& land = columns_[column];
  const Curve& curve = toothing_.profile->pieces()[land.piece].curve;
  const bool tip = land.kind == ToothColumn::Kind::kTipLand;
  const double drawn = std::get<CircularArc>(curve.shape).radius_mm;
  const double radius =
      section_point(toothing_, {.piece = land.piece, .parameter = tip ? curve.end : curve.begin},
                    z_mm).norm();
  return std::abs(radius - drawn) < 1e-11 ? drawn : radius;
}

std::array<double, 3> ToothColumns::undisplaced(int tooth, std::size_t index, double u,
                                                double z_mm) const {
  const ToothColumn& column = columns_[index];
  if (column.kind == ToothColumn::Kind::kHalf) {
    Toothing plain = toothing_;
    plain.displacement = nullptr;
    return surface_point(plain, place(tooth, column, u, z_mm), z_mm);
  }
  const auto [from, to] = land_corners_rad(tooth, column, z_mm);
  const Point2 p = land_radius_mm(index, z_mm) * unit_vector(from + u * (to - from));
  return {p.x(), p.y(), z_mm};
}

std::array<double, 3> ToothColumns::point(int tooth, std::size_t column, double u,
                                          double z_mm) const {
  std::array<double, 3> p = undisplaced(tooth, column, u, z_mm);
  if (toothing_.displacement == nullptr) return p;
  const std::array<double, 3> d = (*toothing_.displacement)(p);
  return {p[0] + d[0], p[1] + d[1], p[2] + d[2]};
}

std::array<double, 3> ToothColumns::joint(int tooth, std::size_t column, double z_mm) const {
  const std::size_t before = (column == 0 ? columns_.size() : column) - 1;
  const int tooth_before = column == 0 ? (tooth + teeth() - 1) % teeth() : tooth;
  const auto end = [&] { return point(tooth_before, before, 1.0, z_mm); };
  const auto begin = [&] { return point(tooth, column, 0.0, z_mm); };
  if (columns_[column].kind != ToothColumn::Kind::kHalf) return begin();
  if (columns_[before].kind != ToothColumn::Kind::kHalf) return end();
  const auto a = end(), b = begin();
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

Status ToothColumns::check() const {
  const auto refuse = [](std::string message, std::string remedy) {
    return fail({.code = ErrorCode::kUnsupported, .message = std::move(message),
                 .remedy = std::move(remedy)});
  };
  const int looked_at = teeth_alike() ? 1 : teeth();
  for (int tooth = 0; tooth < looked_at; ++tooth)
    for (std::size_t i = 0; i < columns_.size(); ++i)
      for (const double share : {0.0, 0.5, 1.0}) {
        const double z = share * toothing_.twist.face_width_mm;
        const std::size_t before = (i == 0 ? columns_.size() : i) - 1;
        const int tooth_before = i == 0 ? (tooth + teeth() - 1) % teeth() : tooth;
        const double gap = distance_mm(point(tooth_before, before, 1.0, z), point(tooth, i, 0.0, z));
        if (gap > 2.0 * shortest_mm_)
          return refuse("the deviation parts flanks that meet in a pointed tooth or a closed gap",
                        "a smaller tip diameter, so that the teeth have a tip land");
        if (columns_[i].kind == ToothColumn::Kind::kHalf) continue;
        const auto [from, to] = land_corners_rad(tooth, columns_[i], z);
        if ((to - from) * land_radius_mm(i, z) < shortest_mm_)
          return refuse("the deviation leaves no tip land",
                        "a smaller tip diameter, or less material on the flanks at the tip");
      }
  return {};
}

}  // namespace trueflank
