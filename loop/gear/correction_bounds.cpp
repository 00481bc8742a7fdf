// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/correction_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

using Point = std::array<double, 3>;

/// Walls move by so many modules at most.
constexpr double kFarthestOfModule = 1.0;
/// What must stay of a tooth, a gap and the height of a tooth.
constexpr double kLeastShare = 0.25;
/// Where a displacement of the body changes by more than this share of the way, the place at which
/// the process will act cannot be told.
constexpr double kSteepest = 0.5;
/// A part that shrank by more was not made of what the design says: sintered parts lose a fifth.
constexpr double kMostOfSize = 0.25;
/// Values of shapes may lie outside the limits of the search by this factor: they were rounded.
constexpr double kBeyondLimits = 10.0;
/// Teeth looked at, where there are more.
constexpr int kMostTeeth = 36;
constexpr int kRolls = 9, kHeights = 9;
/// Ways along a flank over which slopes are taken, as shares of the flank.
constexpr double kShortWay = 1e-3;
/// Steps up the hill that a formula makes between the places looked at, each half of the one before.
constexpr int kSteps = 40;

Point at(double radius_mm, double polar_rad, double z_mm) {
  return {radius_mm * std::cos(polar_rad), radius_mm * std::sin(polar_rad), z_mm};
}
double distance_mm(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
double radius_mm(const Point& p) { return std::hypot(p[0], p[1]); }

/// The length from a to b along the direction it had before, as a share of what it was.
double share_left(const Point& a, const Point& b, const Point& moved_a, const Point& moved_b) {
  const double x = b[0] - a[0], y = b[1] - a[1];
  return ((moved_b[0] - moved_a[0]) * x + (moved_b[1] - moved_a[1]) * y) / (x * x + y * y);
}

/// std::min and max that keep NaN.
void lower(double& value, double by) {
  if (!(by >= value)) value = by;
}
void raise(double& value, double by) {
  if (!(by <= value)) value = by;
}

class Survey {
 public:
  explicit Survey(const Correction& correction)
      : correction_(correction), of_body_(correction.of_body()), geometry_(correction.geometry()) {
    reach_.least_radius_mm = std::numeric_limits<double>::infinity();
    for (const Correction::Part& part : correction.parts())
      has_formulas_ = has_formulas_ || !part.effect.family->formulas.empty();
  }

  CorrectionReach run() {
    const int teeth = geometry_.teeth(), looked_at = std::min(teeth, kMostTeeth);
    const double b = geometry_.face_width_mm();
    for (int i = 0; i < looked_at; ++i) {
      const int tooth = 1 + static_cast<int>(static_cast<std::int64_t>(i) * teeth / looked_at);
      for (int k = 0; k < kHeights; ++k) look_at(tooth, b * k / (kHeights - 1));
      look_at(tooth, 1e-3 * b);  // layers on the bed differ within a hundredth of the face
      look_at(tooth, 1e-2 * b);
      if (has_formulas_) seek_poles(tooth);
    }
    return reach_;
  }

 private:
  Point moved(const Point& p) {
    const Point u = correction_.displacement_mm(p);
    const Point q{p[0] + u[0], p[1] + u[1], p[2] + u[2]};
    raise(reach_.farthest_mm, std::hypot(u[0], u[1], u[2]));
    lower(reach_.least_radius_mm, radius_mm(q));
    raise(reach_.largest_radius_mm, radius_mm(q));
    return q;
  }
  [[nodiscard]] Point flank_point(int tooth, int side, double roll_mm, double z_mm) const {
    const Place place = geometry_.on_flank(tooth, side, roll_mm, z_mm);
    return at(place.radius_mm, place.polar_rad, z_mm);
  }

  /// A user's formula may grow without bound between the places looked at.
  void seek_poles(int tooth) {
    const double from = geometry_.root_form_roll_mm(), to = geometry_.tip_form_roll_mm();
    const double b = geometry_.face_width_mm();
    const auto moves_by = [&](int side, double roll_mm, double z_mm) {
      const Point p = flank_point(tooth, side, roll_mm, z_mm);
      return distance_mm(p, moved(p));
    };
    for (const int side : {1, -1}) {
      for (int k = 0; k < kHeights; ++k)
        climb(from, to, [&](double roll) { return moves_by(side, roll, b * k / (kHeights - 1)); });
      for (int k = 0; k < kRolls; ++k)
        climb(0.0, b, [&](double z) {
          return moves_by(side, std::lerp(from, to, static_cast<double>(k) / (kRolls - 1)), z);
        });
    }
  }
  /// From the highest of some places on a line uphill, by ever shorter steps.
  template <class Height>
  static void climb(double from, double to, const Height& height) {
    double best = from, highest = height(from);
    const auto compare = [&](double at) {
      if (at < std::min(from, to) || at > std::max(from, to)) return;
      if (const double here = height(at); here > highest) best = at, highest = here;
    };
    for (int k = 1; k < kRolls; ++k) compare(std::lerp(from, to, static_cast<double>(k) / (kRolls - 1)));
    double step = (to - from) / (kRolls - 1);
    for (int i = 0; i < kSteps; ++i) {
      step *= 0.5;
      const double middle = best;
      compare(middle - step);
      compare(middle + step);
    }
  }

  void look_at(int tooth, double z_mm) {
    const double from = geometry_.root_form_roll_mm(), to = geometry_.tip_form_roll_mm();
    const int next = tooth % geometry_.teeth() + 1;
    for (int k = 0; k < kRolls; ++k) {
      const double roll = std::lerp(from, to, static_cast<double>(k) / (kRolls - 1));
      const double further = roll + kShortWay * (k == 0 ? to - from : from - to);
      const Point ahead = flank_point(tooth, 1, roll, z_mm),
                  behind = flank_point(tooth, -1, roll, z_mm);
      const Point beyond = flank_point(next, -1, roll, z_mm);
      const Point to_ahead = moved(ahead), to_behind = moved(behind), to_beyond = moved(beyond);
      lower(reach_.least_tooth, share_left(behind, ahead, to_behind, to_ahead));
      lower(reach_.least_gap, share_left(ahead, beyond, to_ahead, to_beyond));
      for (const int side : {1, -1}) {
        const Point &here = side > 0 ? ahead : behind,
                    &here_moved = side > 0 ? to_ahead : to_behind;
        const Point there = flank_point(tooth, side, further, z_mm);
        raise(reach_.steepest,
              distance_mm(of_body_.displacement_mm(here), of_body_.displacement_mm(there)) /
                  distance_mm(here, there));
        raise(reach_.most_stretched,
              std::abs(share_left(here, there, here_moved, moved(there)) - 1.0));
      }
    }
    const double middle = geometry_.centre_rad(tooth) + geometry_.twist_rad(z_mm);
    const Point tip = at(geometry_.tip_radius_mm(), middle, z_mm);
    const Point root = at(geometry_.root_radius_mm(), middle + kPi / geometry_.teeth(), z_mm);
    const double height = geometry_.sense() * (radius_mm(moved(tip)) - radius_mm(moved(root)));
    lower(reach_.least_height, height / (geometry_.sense() * (radius_mm(tip) - radius_mm(root))));
  }

  const Correction& correction_;
  const Correction of_body_;
  const FlankGeometry& geometry_;
  bool has_formulas_ = false;
  CorrectionReach reach_;
};

std::string um(double length_mm) { return printed_number(um_from_mm(length_mm), "%.4g") + " um"; }
std::string percent(double share) { return printed_number(100.0 * share, "%.3g") + " %"; }

/// What is beyond its bound; nothing where all is within.
std::optional<std::string> beyond_bounds(const Correction& correction,
                                         const CorrectionReach& reach) {
  const double most_mm = kFarthestOfModule * correction.geometry().gear().normal_module_mm;
  if (!std::isfinite(reach.farthest_mm) || std::isnan(reach.steepest))
    return "no geometry comes out as designed after it";
  if (!correction.moves_whole_part() && reach.farthest_mm > most_mm)
    return "it moves walls by " + um(reach.farthest_mm) + ", and a module, " + um(most_mm) +
           ", is the most";
  const double steepest = correction.moves_whole_part() ? kMostOfSize : kSteepest;
  if (!(reach.steepest <= steepest))
    return "it moves neighbouring places apart by " + percent(reach.steepest) +
           " of their distance, and " + percent(steepest) + " is the most";
  const auto too_little = [](double share, const std::string& what) {
    return "it leaves " + percent(std::max(share, 0.0)) + " of " + what + ", and " +
           percent(kLeastShare) + " is the least";
  };
  if (!(reach.least_tooth >= kLeastShare))
    return too_little(reach.least_tooth, "a tooth's thickness");
  if (!(reach.least_gap >= kLeastShare)) return too_little(reach.least_gap, "a gap's width");
  if (!(reach.least_height >= kLeastShare))
    return too_little(reach.least_height, "a tooth's height");
  if (!(reach.most_stretched <= 1.0 - kLeastShare))
    return "it makes flanks " + percent(reach.most_stretched) + " longer or shorter, and " +
           percent(1.0 - kLeastShare) + " is the most";
  return std::nullopt;
}

Error refusal(const std::string& effect, const std::string& what) {
  return {.code = ErrorCode::kInfeasible,
          .message = "these teeth cannot hold the correction of " + effect + ": " + what,
          .key = "effects." + effect,
          .remedy = "look at the amount and its unit; reject the part rather than correct it"};
}

/// A shape value far outside of what its name means on this gear.
std::optional<Error> wrong_shape(const Correction& correction) {
  for (const Correction::Part& part : correction.parts()) {
    const EffectFamily& family = *part.effect.family;
    if (!family.shape_limits) continue;
    for (std::size_t k = 0; k < part.effect.shape.size() && k < family.shape_names.size(); ++k) {
      const auto [low, high] = family.shape_limits(correction.geometry(), k);
      const double value = part.effect.shape[k];
      if (value >= low / kBeyondLimits && value <= high * kBeyondLimits) continue;
      Error error =
          refusal(Correction::name_of(family), "its " + family.shape_names[k] + " lies outside of this gear");
      error.value = printed_number(value, "%.6g");
      error.remedy = printed_number(low, "%.4g") + " to " + printed_number(high, "%.4g");
      return error;
    }
  }
  return std::nullopt;
}

}  // namespace

CorrectionReach reach_of(const Correction& correction) { return Survey(correction).run(); }

Status within_bounds(const Correction& correction) {
  if (auto error = wrong_shape(correction)) return fail(std::move(*error));
  std::string largest;
  double farthest_mm = -1.0;
  for (const std::string& name : correction.effects()) {
    const Correction alone = correction.of(name);
    const CorrectionReach reach = reach_of(alone);
    if (const auto beyond = beyond_bounds(alone, reach)) return fail(refusal(name, *beyond));
    if (reach.farthest_mm > farthest_mm) largest = name, farthest_mm = reach.farthest_mm;
  }
  if (correction.effects().size() < 2) return {};
  if (const auto beyond = beyond_bounds(correction, reach_of(correction)))
    return fail(refusal(largest, "with the other effects " + *beyond));
  return {};
}

}  // namespace trueflank::loop
