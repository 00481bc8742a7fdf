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

/// What the halves of a section are made of; shared, as a section outlives the toothing it is of.
struct SectionSource {
  ToothProfile profile;
  FlankDeviation deviation;
  FaceTwist twist;
  double z_mm = 0.0;

  [[nodiscard]] Toothing toothing() const {
    return {.profile = &profile, .twist = twist, .deviation = &deviation};
  }
};

/// One half of the tooth, the clockwise one mirrored.
class HalfBuilder {
 public:
  HalfBuilder(std::shared_ptr<const SectionSource> source, int side)
      : source_(std::move(source)), toothing_(source_->toothing()), side_(side) {
    const auto& pieces = source_->profile.pieces();
    const auto flank = std::find_if(pieces.begin(), pieces.end(), [](const ProfilePiece& p) {
      return p.kind == PieceKind::kInvolute;
    });
    TRUEFLANK_EXPECTS(flank != pieces.end());
    flank_ = static_cast<std::size_t>(flank - pieces.begin());
    tip_turn_ = turn_of(flank->curve.begin);
    root_turn_ = turn_of(flank->curve.end);
    turned_as_a_whole_ = is_constant(flank->curve);
  }

  [[nodiscard]] bool as_designed() const {
    return turned_as_a_whole_ && std::abs(tip_turn_) * base_radius_mm(gear()) < kNothing_mm;
  }

  [[nodiscard]] std::vector<ProfilePiece> build() const {
    const auto& pieces = source_->profile.pieces();
    if (as_designed()) return pieces;
    std::vector<ProfilePiece> section;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const ProfilePiece& piece = pieces[i];
      if (piece.kind == PieceKind::kTip) {
        Curve land = piece.curve;
        land.end += tip_turn_;
        section.push_back({piece.kind, land});
      } else if (i < flank_ || (i == flank_ && turned_as_a_whole_)) {
        section.push_back({piece.kind, turned(piece.curve, tip_turn_)});
      } else if (i == flank_) {
        add_flank(piece.curve, section);
      } else if (piece.kind == PieceKind::kFillet && root_turn_ != 0.0) {
        section.push_back({piece.kind, deviated(i, piece.curve.begin, piece.curve.end)});
      } else {
        section.push_back(piece);
      }
    }
    return section;
  }

 private:
  [[nodiscard]] const Gear& gear() const { return source_->profile.gear(); }

  [[nodiscard]] double turn_of(double parameter) const {
    return deviation_turn_rad(toothing_, {0, side_, flank_, parameter}, source_->z_mm);
  }

  [[nodiscard]] bool is_constant(const Curve& flank) const {
    constexpr int kPlaces = 32;
    const double r_b = base_radius_mm(gear());
    for (int i = 0; i <= kPlaces; ++i) {
      const double at = flank.begin + (flank.end - flank.begin) * i / kPlaces;
      if (std::abs(turn_of(at) - tip_turn_) * r_b > kNothing_mm) return false;
    }
    return true;
  }

  [[nodiscard]] Curve deviated(std::size_t piece, double begin, double end) const {
    return point_curve(
        [source = source_, side = side_, piece](double t) {
          const Point2 point = section_point(source->toothing(), {0, side, piece, t}, source->z_mm);
          return side > 0 ? point : mirrored(point);
        },
        begin, end);
  }

  /// The flank in smooth pieces. A break of the field shows on the circle to which the deviation
  /// takes its point.
  void add_flank(const Curve& flank, std::vector<ProfilePiece>& section) const {
    const double r_b = base_radius_mm(gear());
    const double sense = gear().kind == GearKind::kExternal ? 1.0 : -1.0;
    const double to_transverse = 1.0 / std::cos(base_helix_angle_rad(gear()));
    const Flank which = flank_side(Flank::kLeft, gear().kind) == side_ ? Flank::kLeft : Flank::kRight;
    std::vector<double> ends{flank.begin, flank.end};
    for (double roll : source_->deviation.roll_breaks_mm) {
      const double deviation = source_->deviation.deviation_mm(0, which, roll, source_->z_mm);
      const double moved = (roll + sense * to_transverse * deviation) / r_b;
      if ((moved - flank.begin) * (moved - flank.end) < 0.0) ends.push_back(moved);
    }
    std::sort(ends.begin(), ends.end());
    if (flank.begin > flank.end) std::reverse(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      section.push_back({PieceKind::kInvolute, deviated(flank_, ends[i], ends[i + 1])});
  }

  std::shared_ptr<const SectionSource> source_;
  Toothing toothing_;
  int side_;
  std::size_t flank_ = 0;
  double tip_turn_ = 0.0, root_turn_ = 0.0;
  bool turned_as_a_whole_ = false;
};

/// Whether both flanks deviate alike at a height.
bool flanks_alike(const SectionSource& source) {
  constexpr int kPlaces = 32;
  const double root = source.profile.root_form_roll_length_mm();
  const double tip = source.profile.tip_form_roll_length_mm();
  for (int i = 0; i <= kPlaces; ++i) {
    const double roll = root + (tip - root) * i / kPlaces;
    const auto of = [&](Flank flank) {
      return source.deviation.deviation_mm(0, flank, roll, source.z_mm);
    };
    if (std::abs(of(Flank::kLeft) - of(Flank::kRight)) > kNothing_mm) return false;
  }
  return true;
}

}  // namespace

ToothSection section_profile(const Toothing& toothing, double z_mm) {
  TRUEFLANK_EXPECTS(toothing.profile != nullptr);
  if (!toothing.has_deviation()) return {*toothing.profile, true};
  TRUEFLANK_EXPECTS(!toothing.deviation->varies_by_tooth);
  const auto source = std::make_shared<const SectionSource>(
      SectionSource{*toothing.profile, *toothing.deviation, toothing.twist, z_mm});
  const HalfBuilder half(source, 1);
  if (flanks_alike(*source))
    return {half.as_designed() ? source->profile : source->profile.with_pieces(half.build()),
            half.as_designed()};
  return {source->profile.with_pieces(half.build(), HalfBuilder(source, -1).build()), false};
}

}  // namespace trueflank
