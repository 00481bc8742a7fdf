// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effect.h"

// What several effects' columns are made of.
namespace trueflank::loop::gear_effects {

using Point3 = std::array<double, 3>;

struct PlanePoint {
  double x, y;
};
/// The place in the transverse plane [mm].
[[nodiscard]] inline PlanePoint point_of(const Place& place) {
  return {place.radius_mm * place.polar_direction[0], place.radius_mm * place.polar_direction[1]};
}

/// Cosines and sines of whole multiples of an angle, as they are asked for one after the other: the
/// next follows from the one before by one product of complex numbers.
class WavesOf {
 public:
  explicit WavesOf(double angle_rad) : angle_(angle_rad) {}

  /// {cos, sin} of order times the angle. Accuracy: order times 2e-16 of what a call of its own
  /// tells.
  [[nodiscard]] std::array<double, 2> of(double order) {
    if (order == order_) return wave_;
    if (order == order_ + 1.0) {
      if (!has_step_) step_ = {std::cos(angle_), std::sin(angle_)};
      has_step_ = true;
      wave_ = {wave_[0] * step_[0] - wave_[1] * step_[1],
               wave_[0] * step_[1] + wave_[1] * step_[0]};
    } else {
      const double angle = order * angle_;  // one argument: one call for both
      wave_ = {std::cos(angle), std::sin(angle)};
    }
    order_ = order;
    return wave_;
  }

 private:
  double angle_;
  double order_ = kNaN;
  bool has_step_ = false;
  std::array<double, 2> wave_{}, step_{};
};

/// Columns of a displacement by (1, 0) and (0, 1) of the teeth, times a factor that may depend on
/// height.
void two_directions(const FlankGeometry& geometry, const Place& place, double factor,
                    double* columns);

/// What is left on flanks that face a direction: the cosine to it or, `power` 2, its square;
/// nothing on those that face away.
[[nodiscard]] inline double faces(const Place& place, double towards_deg, double power) {
  const double towards = rad_from_deg(towards_deg);
  const double faced = std::max(0.0, std::cos(towards) * place.normal_direction[0] +
                                         std::sin(towards) * place.normal_direction[1]);
  return power == 2.0 ? faced * faced : faced;
}
/// The same from a direction to either side, and by the other power.
[[nodiscard]] std::vector<EffectShape> facings_beside(const EffectShape& shape);

/// A family whose one column is a function of profile coordinate u (-1 root form ... +1 tip), face
/// coordinate v (-1 ... +1 from bottom to top) and side, on flanks only.
template <class Function>
[[nodiscard]] EffectFamily on_flanks(Function function) {
  EffectFamily f;
  f.evaluate = [function](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
    c[0] = p.surface == Surface::kFlank
               ? function(g, g.profile_coordinate(p.roll_mm), g.face_coordinate(p.z_mm), p.side)
               : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  return f;
}

/// Makes the family's columns of these, on flanks only.
void set_columns(EffectFamily& family, EffectFamily::FormTimesTooth columns);

/// One shape a number, from ... to.
[[nodiscard]] std::vector<EffectShape> whole_numbers(int from, int to);
/// Heights below the face width, in equal steps or equal ratios.
[[nodiscard]] std::vector<EffectShape> heights(const FlankGeometry& geometry, double from_mm,
                                               double to_mm, int count, bool in_ratios);

/// Teeth from one on, once around.
[[nodiscard]] int teeth_since(const FlankGeometry& geometry, int tooth, double from);
/// Sectors (first tooth, number of teeth, what else a shape has) that begin and end up to so many
/// teeth before or after: of two teeth and more.
[[nodiscard]] std::vector<EffectShape> sectors_beside(const FlankGeometry& geometry,
                                                      const EffectShape& shape, int most);

/// @name Where a drift around the gear is nothing (shape value): at its mean over the
/// teeth, on its first tooth or on its last
/// @{
inline constexpr double kMeanOfDrift = 0.0, kFirstOfDrift = 1.0, kLastOfDrift = 2.0;
/// The end at which it changes least: the last tooth of one that levels off.
[[nodiscard]] constexpr double flat_end_of_drift(double grows) {
  return grows != 0.0 ? kFirstOfDrift : kLastOfDrift;
}
/// @}

/// 1 on a run of teeth about a middle, 0 far from it: it begins and ends over some teeth.
[[nodiscard]] double in_soft_run(const FlankGeometry& geometry, int tooth, double middle,
                                 double teeth, double edge_teeth);
/// "with soft edges over about 3 teeth, "; empty where not asked for.
[[nodiscard]] std::string over_edges(double edge_teeth, bool asked);

/// Limits of a height over the face, and of a diameter between root form and tip.
[[nodiscard]] std::pair<double, double> height_limits(const FlankGeometry& geometry);
[[nodiscard]] std::pair<double, double> diameter_limits(const FlankGeometry& geometry);
/// Diameter at a share of the roll length from root form (0) to tip form (1).
[[nodiscard]] double diameter_at_roll_share(const FlankGeometry& geometry, double share);

/// A form that the search through the remainder, or the telling of several effects as one, finds:
/// of one column, without a name, a cause or candidates of its own.
[[nodiscard]] EffectFamily described(const std::string& id, std::vector<std::string> shape_names);

/// @name Words of sentences
/// @{
/// Value of a parameter of an effect as found; NaN where it has none of that name.
[[nodiscard]] double figure(const FoundEffect& found, const std::string& parameter);
/// "18 um", "0.35 mm", of the size alone.
[[nodiscard]] std::string um(double value);
[[nodiscard]] std::string mm(double value);
/// "towards 108 deg", 0 ... 360.
[[nodiscard]] std::string towards(double deg);
/// " on the left flanks"; empty for both.
[[nodiscard]] std::string on_which_flanks(const FoundEffect& found);
/// A form and its shape values: "a hollow across the flanks (centre diameter 10.3 mm, width 0.21 mm)",
/// "lobing, 3 times per turn".
[[nodiscard]] std::string with_shape(const std::string& form, const std::vector<std::string>& names,
                                     const EffectShape& shape);
/// "3 times per turn"
[[nodiscard]] std::string times_per_turn(double order);
/// @}

/// The first shape value is the order.
[[nodiscard]] inline double first_value(const EffectShape& shape) { return shape[0]; }

}  // namespace trueflank::loop::gear_effects
