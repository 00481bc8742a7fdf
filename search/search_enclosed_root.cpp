// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_enclosed_root.h"

#include "trueflank/geometry/tooth_profile.h"

namespace trueflank {
namespace {

constexpr int kSamples = 12;
constexpr int kRootSteps = 10;
constexpr double kGolden = 0.6180339887498949;
/// More than profiles are off (tooth_profile.h).
constexpr double kProfileError = 1e-8;

/// Root form of a gear with a shift; none where there is no such gear.
std::optional<double> form_roll_at(const BasicRack& rack, const EnclosedGear<Interval>& like,
                                   double shift) {
  Gear gear{.kind = like.ring ? GearKind::kInternal : GearKind::kExternal,
            .teeth = like.teeth,
            .normal_module_mm = 1.0,
            .rack = rack,
            .shift = shift};
  gear.tip_radius_mm = nominal_tip_radius_mm(gear);
  const auto profile = ToothProfile::make(gear);
  if (!profile) return std::nullopt;
  return profile->root_form_roll_length_mm();
}

/// Without a gear at the least shift nothing bounds it above; with none at the greatest, whose
/// teeth are the stoutest, there is none at all.
Interval undercut_form(const BasicRack& rack, const EnclosedGear<Interval>& gear,
                       const Interval& start) {
  const double most =
      std::max(form_roll_at(rack, gear, gear.shift.lo).value_or(kUnbounded), start.hi);
  const double least =
      start.hi < 0.0 ? form_roll_at(rack, gear, gear.shift.hi).value_or(kUnbounded) : 0.0;
  return {std::max(0.0, least - kProfileError), most + kProfileError};
}

/// A ring's rounding is reduced where two of a gap would overlap; the space may even close before
/// the root circle. In every case the form point moves outwards with the shift, and the root circle
/// is beyond it.
Interval reduced_form(const BasicRack& rack, const EnclosedGear<Interval>& gear) {
  const double base = gear.base_radius;
  const double least = form_roll_at(rack, gear, gear.shift.lo).value_or(0.0);
  const double most = form_roll_at(rack, gear, gear.shift.hi)
                          .value_or((tangent_at(Interval(gear.root.hi), base) * Interval(base)).hi +
                                    rack.root_radius);
  return {std::max(0.0, least - kProfileError), std::max(least, most) + kProfileError};
}

/// Whether the rounding of a ring is whole, all over a range.
bool surely_whole(const BasicRack& rack, const Interval& base_half_angle, const Interval& root,
                  double base, int teeth) {
  const double rho = rack.root_radius;
  const Interval angle = base_half_angle + Interval(rho / base) +
                         involute_of_tangent(tangent_at(root - Interval(rho), base));
  return root.lo - rho > base && angle.hi < kPi / teeth;
}

/// Of a whole rounding.
template <class T>
T fillet_form(const BasicRack& rack, const EnclosedGear<T>& gear) {
  return tangent_at(gear.root - T(rack.root_radius), gear.base_radius) * T(gear.base_radius) +
         T(rack.root_radius);
}

double clearance_at(const BasicRack& rack, const EnclosedGear<double>& own,
                    const EnclosedGear<double>& mate, double a, double at) {
  const RootPlace place{true, at};
  const RootPoint<double> point = root_point(rack, own, place);
  if (!own.ring && straight_start(rack, own) < 0.0 && point.radius > own.base_radius) {
    const double flank = kPi / own.teeth - half_angle_at(own, point.radius);
    if (point.gap < flank) return kUnbounded;  // cut away above the crossing
  }
  return corner_distance(rack, own, mate, a, place).value_or(kUnbounded);
}

/// The fillet's extent about its centre.
template <class T>
T ring_fillet_turn(const BasicRack& rack, const EnclosedGear<T>& gear) {
  return T(0.5 * kPi) - atan(tangent_at(gear.root - T(rack.root_radius), gear.base_radius));
}

}  // namespace

Interval root_form_roll(const BasicRack& rack, const EnclosedGear<Interval>& gear) {
  if (gear.ring)
    return surely_whole(rack, gear.base_half_angle, gear.root, gear.base_radius, gear.teeth)
               ? fillet_form(rack, gear)
               : reduced_form(rack, gear);
  const Interval start = straight_start(rack, gear);
  return start.lo >= 0.0 ? start : undercut_form(rack, gear, start);
}

Slope root_form_roll(const BasicRack& rack, const EnclosedGear<Slope>& gear) {
  const EnclosedGear<Interval> range{.teeth = gear.teeth,
                                     .ring = gear.ring,
                                     .shift = gear.shift.v,
                                     .base_radius = gear.base_radius,
                                     .root = gear.root.v};
  if (gear.ring)
    return surely_whole(rack, gear.base_half_angle.v, gear.root.v, gear.base_radius, gear.teeth)
               ? fillet_form(rack, gear)
               : chain(gear.shift, reduced_form(rack, range), everything());
  const Slope start = straight_start(rack, gear);
  if (start.v.lo >= 0.0) return start;
  return chain(gear.shift, undercut_form(rack, range, start.v), everything());
}

RootPlace closest_place(const BasicRack& rack, const EnclosedGear<double>& own,
                        const EnclosedGear<double>& mate, double a, double near) {
  const double low = own.ring ? 0.0 : rack.pressure_angle_rad,
               high = own.ring ? ring_fillet_turn(rack, own) : 0.5 * kPi;
  if (!(high > low)) return {};
  const double step = (high - low) / kSamples;
  double least = kUnbounded;
  int nearest = -1;
  for (int i = 0; i <= kSamples; ++i)
    if (const double here = clearance_at(rack, own, mate, a, low + i * step); here < least)
      least = here, nearest = i;
  if (nearest < 0 || least > near) return {};
  double from = low + std::max(0, nearest - 1) * step,
         to = low + std::min(kSamples, nearest + 1) * step;
  double best = low + nearest * step;
  for (int i = 0; i < kRootSteps; ++i) {
    const double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
    const double at_left = clearance_at(rack, own, mate, a, left),
                 at_right = clearance_at(rack, own, mate, a, right);
    if (std::min(at_left, at_right) < least) {
      least = std::min(at_left, at_right);
      best = at_left < at_right ? left : right;
    }
    // a curve is cut away above, and not reached below
    if (at_left < at_right || (at_right == kUnbounded && at_left < kUnbounded))
      to = right;
    else
      from = left;
    if (at_left == kUnbounded && at_right == kUnbounded) break;
  }
  return {true, best};
}

bool surely_root(const BasicRack& rack, const EnclosedGear<Slope>& whole,
                 const EnclosedGear<Interval>& middle, const std::array<Interval, 3>& way,
                 const RootPlace& place) {
  if (whole.ring) {
    const EnclosedGear<Interval> range{
        .teeth = whole.teeth, .ring = true, .base_radius = whole.base_radius, .root = whole.root.v};
    return surely_whole(rack, whole.base_half_angle.v, whole.root.v, whole.base_radius,
                        whole.teeth) &&
           place.at <= ring_fillet_turn(rack, range).lo;
  }
  if (straight_start(rack, whole).v.lo >= 0.0) return true;
  const RootPoint<Slope> point = root_point(rack, whole, place);
  // the trochoid's radius falls on the way to the root: inside the base circle it is the root
  if (rack.dedendum - rack.root_radius - whole.shift.v.hi >= 0.0 &&
      point.radius.v.hi <= whole.base_radius)
    return true;
  if (!(point.radius.v.lo > whole.base_radius)) return false;
  const auto beyond = [&](const auto& gear) {
    using T = std::decay_t<decltype(gear.shift)>;
    const RootPoint<T> p = root_point(rack, gear, place);
    return p.gap - T(kPi / gear.teeth) + half_angle_at(gear, p.radius);
  };
  const Slope over = beyond(whole);
  Interval least = beyond(middle);
  for (std::size_t i = 0; i < 3; ++i) least = least + over.d[i] * way[i];
  return std::max(over.v.lo, least.lo) > 0.0;
}

}  // namespace trueflank
