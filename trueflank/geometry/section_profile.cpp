// SPDX-License-Identifier: GPL-3.0-or-later
//
// What turns as a whole keeps its analytic form (arcs, lines, trimmed corners, a flank whose deviation
// is the same from root to tip); the rest is a curve of points.
#include "trueflank/geometry/section_profile.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr double kNothing_mm = 1e-13;

/// A curve that is asked beyond its ends, where the field may bend: there it goes on as a parabola.
Curve point_curve(std::function<Point2(double)> inside, double begin, double end) {
  const double low = std::min(begin, end), high = std::max(begin, end);
  auto point = [inside = std::move(inside), low, high](double t) -> Point2 {
    const double edge = std::clamp(t, low, high), beyond = t - edge;
    if (beyond == 0.0) return inside(t);
    return 3.0 * inside(edge) - 3.0 * inside(edge - beyond) + inside(edge - 2.0 * beyond);
  };
  return {PointCurve{std::make_shared<const std::function<Point2(double)>>(std::move(point))}, begin,
          end};
}

Curve turned(const Curve& curve, double turn) {
  Curve result = curve;
  if (auto* arc = std::get_if<CircularArc>(&result.shape)) {
    arc->centre = rotated(arc->centre, turn);
    result.begin += turn;
    result.end += turn;
  } else if (auto* line = std::get_if<StraightLine>(&result.shape)) {
    line->start = rotated(line->start, turn);
    line->direction = rotated(line->direction, turn);
  } else if (auto* involute = std::get_if<Involute>(&result.shape)) {
    involute->base_half_angle_rad += turn;
  } else if (auto* trochoid = std::get_if<CutterTrochoid>(&result.shape)) {
    trochoid->gap_angle_rad += turn;
  }
  return result;
}

class SectionBuilder {
 public:
  SectionBuilder(const Toothing& toothing, double z_mm)
      : profile_(*toothing.profile), z_mm_(z_mm) {
    const FlankDeviation field = *toothing.deviation;
    const GearKind kind = profile_.gear().kind;
    const Flank up = flank_side(Flank::kLeft, kind) > 0 ? Flank::kLeft : Flank::kRight;
    const Flank down = up == Flank::kLeft ? Flank::kRight : Flank::kLeft;
    const double mid =
        0.5 * (profile_.root_form_roll_length_mm() + profile_.tip_form_roll_length_mm());
    const double leaning =
        0.5 * (field.deviation_mm(0, up, mid, z_mm) - field.deviation_mm(0, down, mid, z_mm));
    turn_ = leaning / (base_radius_mm(profile_.gear()) *
                       std::cos(base_helix_angle_rad(profile_.gear())));
    alike_ = std::make_shared<const FlankDeviation>(
        FlankDeviation{.deviation_mm =
                           [field, up, leaning](int, Flank, double roll, double z) {
                             return field.deviation_mm(0, up, roll, z) - leaning;
                           },
                       .roll_breaks_mm = field.roll_breaks_mm});
    toothing_ = {.profile = &profile_, .twist = toothing.twist, .deviation = alike_.get()};
  }

  ToothSection build() {
    const auto& pieces = profile_.pieces();
    const double r_b = base_radius_mm(profile_.gear());
    const auto flank = std::find_if(pieces.begin(), pieces.end(), [](const ProfilePiece& p) {
      return p.kind == PieceKind::kInvolute;
    });
    TRUEFLANK_EXPECTS(flank != pieces.end());
    flank_ = static_cast<std::size_t>(flank - pieces.begin());
    const double tip_turn = turn_of(flank_, flank->curve.begin);
    const double root_turn = turn_of(flank_, flank->curve.end);
    const bool alike_all_over = is_constant(flank->curve, tip_turn);
    if (alike_all_over && std::abs(tip_turn) * r_b < kNothing_mm)
      return {profile_, turn_, std::abs(turn_) * r_b < kNothing_mm};
    std::vector<ProfilePiece> section;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const ProfilePiece& piece = pieces[i];
      if (piece.kind == PieceKind::kTip) {
        Curve land = piece.curve;
        land.end += tip_turn;
        section.push_back({piece.kind, land});
      } else if (i < flank_) {
        section.push_back({piece.kind, turned(piece.curve, tip_turn)});
      } else if (i == flank_ && alike_all_over) {
        section.push_back({piece.kind, turned(piece.curve, tip_turn)});
      } else if (i == flank_) {
        add_flank(piece.curve, section);
      } else if (piece.kind == PieceKind::kFillet && root_turn != 0.0) {
        section.push_back({piece.kind, deviated(i, piece.curve.begin, piece.curve.end)});
      } else {
        section.push_back(piece);
      }
    }
    return {profile_.with_pieces(std::move(section)), turn_, false};
  }

 private:
  [[nodiscard]] double turn_of(std::size_t piece, double parameter) const {
    return deviation_turn_rad(toothing_, {0, 1, piece, parameter}, z_mm_);
  }

  [[nodiscard]] bool is_constant(const Curve& flank, double turn) const {
    constexpr int kPlaces = 32;
    const double r_b = base_radius_mm(profile_.gear());
    for (int i = 0; i <= kPlaces; ++i) {
      const double at = flank.begin + (flank.end - flank.begin) * i / kPlaces;
      if (std::abs(turn_of(flank_, at) - turn) * r_b > kNothing_mm) return false;
    }
    return true;
  }

  /// Holds what it needs: the section outlives the toothing it was made of.
  [[nodiscard]] Curve deviated(std::size_t piece, double begin, double end) const {
    auto profile = std::make_shared<const ToothProfile>(profile_);
    return point_curve(
        [profile, field = alike_, twist = toothing_.twist, piece, z = z_mm_](double t) {
          return section_point({.profile = profile.get(), .twist = twist, .deviation = field.get()},
                               {0, 1, piece, t}, z);
        },
        begin, end);
  }

  /// The flank in smooth pieces. A break of the field shows on the circle to which the deviation
  /// takes its point.
  void add_flank(const Curve& flank, std::vector<ProfilePiece>& section) const {
    const double r_b = base_radius_mm(profile_.gear());
    const double sense = profile_.gear().kind == GearKind::kExternal ? 1.0 : -1.0;
    const double to_transverse = 1.0 / std::cos(base_helix_angle_rad(profile_.gear()));
    std::vector<double> ends{flank.begin, flank.end};
    for (double roll : alike_->roll_breaks_mm) {
      const double moved =
          (roll + sense * to_transverse * alike_->deviation_mm(0, Flank::kLeft, roll, z_mm_)) / r_b;
      if ((moved - flank.begin) * (moved - flank.end) < 0.0) ends.push_back(moved);
    }
    std::sort(ends.begin(), ends.end());
    if (flank.begin > flank.end) std::reverse(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      section.push_back({PieceKind::kInvolute, deviated(flank_, ends[i], ends[i + 1])});
  }

  const ToothProfile& profile_;
  double z_mm_;
  double turn_ = 0.0;
  std::shared_ptr<const FlankDeviation> alike_;
  Toothing toothing_;
  std::size_t flank_ = 0;
};

}  // namespace

ToothSection section_profile(const Toothing& toothing, double z_mm) {
  TRUEFLANK_EXPECTS(toothing.profile != nullptr);
  if (!toothing.has_deviation()) return {*toothing.profile, 0.0, true};
  TRUEFLANK_EXPECTS(!toothing.deviation->varies_by_tooth);
  return SectionBuilder(toothing, z_mm).build();
}

}  // namespace trueflank
