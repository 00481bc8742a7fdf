// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corner's path in the frame of the gear whose root it visits: at each radius of the root curve
// the law of cosines gives the mate's position, the ratio the gear's.
#include "trueflank/search/search_corner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank {
namespace {

constexpr int kFilletPoints = 24;
constexpr int kFlankPoints = 8;
constexpr int kGoldenSteps = 14;
/// Between samples the clearance changes by less than this, of modules as of mm.
constexpr double kClose_mm = 0.02;
/// One sample in so many is looked at first. Where all of them are this far, the others do not
/// matter: between them the clearance changes by less than half of it.
constexpr int kSkipped = 4;
constexpr double kFar_mm = 0.2;
/// Clearance where the corner never gets to.
constexpr double kNever_mm = 1e9;
constexpr int kEdgeSteps = 20;

/// Tip corner of the mate, in the frame of the visited gear.
struct CornerPath {
  double centre_distance = 0.0;
  double tip_radius = 0.0;      ///< of the mate
  double half_angle = 0.0;      ///< of the mate's tooth at its tip
  double mate_per_gear = 0.0;   ///< teeth of the mate / teeth of the visited gear
  enum class Kind { kExternalPair, kRingTipInPlanet, kPlanetTipInRing } kind = Kind::kExternalPair;

  /// Largest angle from the middle of the visited gap at which the corner crosses a radius; negative
  /// where it never gets there.
  [[nodiscard]] double widest_angle(double radius) const {
    const double a = centre_distance, t = tip_radius;
    const double sign = kind == Kind::kPlanetTipInRing ? -1.0 : 1.0;
    const double cosine = sign * (a * a + t * t - radius * radius) / (2.0 * a * t);
    if (cosine >= 1.0 || cosine <= -1.0) return -1.0;
    // before and after the line of centres: (+-beta - half_angle) mate_per_gear -+ psi
    const double beta = std::acos(cosine), across = t * std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const double turned = beta * mate_per_gear - std::atan2(across, from_axis(t * cosine));
    return std::abs(turned) + std::abs(half_angle) * mate_per_gear;
  }

 private:
  /// Of the corner from the visited gear's axis along the line of centres.
  [[nodiscard]] double from_axis(double along) const {
    switch (kind) {
      case Kind::kExternalPair: return centre_distance - along;
      case Kind::kRingTipInPlanet: return along - centre_distance;
      case Kind::kPlanetTipInRing: return centre_distance + along;
    }
    return 0.0;
  }
};

double clearance_at(const CornerPath& path, const Point2& point, int teeth) {
  const double radius = point.norm();
  const double widest = path.widest_angle(radius);
  if (widest < 0.0) return kNever_mm;
  const double gap = kPi / teeth - std::atan2(point.y(), point.x());
  return radius * (gap - widest);
}

/// A stretch of a curve, sampled.
struct SampledStretch {
  const Curve* curve;
  double from, to;
  int count;

  [[nodiscard]] Point2 at(double u) const { return point_at(*curve, from + (to - from) * u); }
};

/// Smallest clearance over a stretch: sampled, then refined between the neighbours of the smallest
/// sample where that is close enough to matter.
CornerLook least_over(const CornerPath& path, const SampledStretch& stretch, int teeth, double enough_mm,
                      int& first) {
  const int count = stretch.count;
  const auto clearance = [&](double u) { return clearance_at(path, stretch.at(u), teeth); };
  if (enough_mm > kLeastOfAll_mm && first >= 0 && first <= count)
    if (const double here = clearance(static_cast<double>(first) / count); here < enough_mm)
      return {here, false};
  std::array<double, kFilletPoints + 1> line{};
  static_assert(kFlankPoints <= kFilletPoints);
  const auto sample = [&](int i) {
    return line[static_cast<std::size_t>(i)] = clearance(static_cast<double>(i) / count);
  };
  int nearest = 0;
  double least = 1e9;
  for (int i = 0; i <= count; i += kSkipped) least = std::min(least, sample(i));
  if (least > kFar_mm) return {least};
  least = 1e9;
  for (int i = 0; i <= count; ++i) {
    const double here = i % kSkipped == 0 ? line[static_cast<std::size_t>(i)] : sample(i);
    if (here < least) least = here, nearest = i;
  }
  first = nearest;
  if (least < enough_mm) return {least, false};
  if (least > kClose_mm) return {least};
  const double at_nearest = nearest / static_cast<double>(count);
  // A corner that reaches no farther than a little beyond a sample is at its closest there: the
  // search goes as far as it reaches.
  const auto reached = [&](double end) {
    double inside = at_nearest;
    if (clearance(end) < kNever_mm) return end;
    for (int i = 0; i < kEdgeSteps; ++i) {
      const double middle = 0.5 * (inside + end);
      const double here = clearance(middle);
      least = std::min(least, here);
      (here < kNever_mm ? inside : end) = middle;
    }
    return inside;
  };
  double low = reached(std::max(0, nearest - 1) / static_cast<double>(count));
  double high = reached(std::min(count, nearest + 1) / static_cast<double>(count));
  constexpr double kGolden = 0.6180339887498949;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = clearance(left), at_right = clearance(right);
  for (int i = 0; i < kGoldenSteps; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      at_left = clearance(left = high - kGolden * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = clearance(right = low + kGolden * (high - low));
    }
  }
  return {std::min({least, at_left, at_right})};
}

/// `beyond_mm`: how far the mate's tip reaches past the tangent point of the base circle, if > 0.
template <class Beyond>
CornerLook least_clearance(const CornerPath& path, const ToothProfile& profile,
                           const Beyond& beyond_mm, double enough_mm, int& first) {
  const int teeth = profile.gear().teeth;
  double least = 1e9;
  const auto look = [&](const SampledStretch& stretch, int& at) {
    const CornerLook found = least_over(path, stretch, teeth, enough_mm, at);
    least = std::min(least, found.clearance_mm);
    return found.least;
  };
  for (const ProfilePiece& piece : profile.pieces()) {
    const Curve& curve = piece.curve;
    if (piece.kind == PieceKind::kFillet &&
        !look({&curve, curve.begin, curve.end, kFilletPoints}, first))
      return {least, false};
  }
  const double beyond = beyond_mm();
  if (!(beyond > 0.0)) return {least};
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind != PieceKind::kInvolute) continue;
    const Curve& curve = piece.curve;
    // parameter = roll angle; pieces run from the tip, so `end` is at the root form circle
    const double reach = 2.0 * beyond / base_radius_mm(profile.gear());
    const double span = std::min(reach, std::abs(curve.end - curve.begin));
    const double top = curve.end + (curve.begin > curve.end ? span : -span);
    int anywhere = -1;
    if (!look({&curve, curve.end, top, kFlankPoints}, anywhere)) return {least, false};
  }
  return {least};
}

CornerPath::Kind kind_of(const Gear& root, const Gear& mate) {
  if (root.kind == GearKind::kInternal) return CornerPath::Kind::kPlanetTipInRing;
  return mate.kind == GearKind::kInternal ? CornerPath::Kind::kRingTipInPlanet
                                          : CornerPath::Kind::kExternalPair;
}
CornerPath path_of(const Gear& root, const Gear& mate, double mate_tip_mm, double centre_distance) {
  return {.centre_distance = centre_distance,
          .tip_radius = mate_tip_mm,
          .half_angle = tooth_half_angle_rad(mate, mate_tip_mm),
          .mate_per_gear = static_cast<double>(mate.teeth) / root.teeth,
          .kind = kind_of(root, mate)};
}

}  // namespace

std::optional<double> corner_clearance_at_sample_mm(const CornerSample& of, int sample) {
  const Gear& mate = *of.mate;
  // a cutter may trim a ring's tip
  if (mate.cutter || mate.tip_rounding_mm != 0.0 || sample < 0 || sample > kFilletPoints)
    return std::nullopt;
  if (!(mate.tip_radius_mm > base_radius_mm(mate))) return std::nullopt;
  const CornerPath path =
      path_of(of.root->gear(), mate, mate.tip_radius_mm, of.centre_distance_mm);
  if (!(path.half_angle >= 0.0)) return std::nullopt;  // pointed
  for (const ProfilePiece& piece : of.root->pieces()) {
    if (piece.kind != PieceKind::kFillet) continue;
    const SampledStretch fillet{&piece.curve, piece.curve.begin, piece.curve.end, kFilletPoints};
    return clearance_at(path, fillet.at(static_cast<double>(sample) / kFilletPoints),
                        of.root->gear().teeth);
  }
  return std::nullopt;
}

CornerLook look_for_corner_in_gear1(const GearPair& pair, double enough_mm, int& first) {
  const CornerPath path = path_of(pair.gear1(), pair.gear2(), pair.profile2->tip_form_radius_mm(),
                                  pair.centre_distance_mm);
  return least_clearance(
      path, *pair.profile1, [&] { return -line_of_action(pair).start_mm; }, enough_mm, first);
}

CornerLook look_for_corner_in_gear2(const GearPair& pair, double enough_mm, int& first) {
  const CornerPath path = path_of(pair.gear2(), pair.gear1(), pair.profile1->tip_form_radius_mm(),
                                  pair.centre_distance_mm);
  const auto beyond = [&] {
    if (pair.internal()) return 0.0;
    const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
    return line_of_action(pair).end_mm - span;
  };
  return least_clearance(path, *pair.profile2, beyond, enough_mm, first);
}

double corner_clearance_in_gear1_mm(const GearPair& pair) {
  int anywhere = -1;
  return look_for_corner_in_gear1(pair, kLeastOfAll_mm, anywhere).clearance_mm;
}

double corner_clearance_in_gear2_mm(const GearPair& pair) {
  int anywhere = -1;
  return look_for_corner_in_gear2(pair, kLeastOfAll_mm, anywhere).clearance_mm;
}

}  // namespace trueflank
