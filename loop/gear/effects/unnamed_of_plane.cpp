// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of the transverse plane, the same at all heights. The error of an axis of a machine that
// comes back with every turn of its screw or belt: all that stands at one coordinate is shifted
// alike. Fringes of a projector: stripes in any direction.
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

/// Shape values: 0 along x, 1 along y; 0 by x, 1 by y; and the wavelength.
enum PlaneWave : std::size_t { kShifted, kByCoordinate, kWavelength };

std::string axis_of(double value) { return value != 0.0 ? "y" : "x"; }

/// The coordinate of a place by which it is shifted.
double coordinate_of(const Place& p, const EffectShape& shape) {
  const PlanePoint point = point_of(p);
  return shape[kByCoordinate] != 0.0 ? point.y : point.x;
}
double part_of_shift(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  return shape[kShifted] != 0.0 ? normal_part(g, p, 0.0, 1.0) : normal_part(g, p, 1.0, 0.0);
}

std::vector<EffectShape> wavelengths_beside(const FlankGeometry& g, const EffectShape& shape) {
  // Over the gear the phase turns by these shares of a wave.
  std::vector<EffectShape> shapes;
  for (const double waves : {0.2, 0.07, 0.02, 0.007, 0.002})
    for (const double sign : {-1.0, 1.0}) {
      const double frequency =
          1.0 / shape[kWavelength] + sign * waves / (2.0 * g.reference_radius_mm());
      if (!(frequency > 0.0)) continue;
      shapes.push_back(shape);
      shapes.back()[kWavelength] = 1.0 / frequency;
    }
  return shapes;
}

/// "as from the screw ..."
std::string source_of_shift(const EffectShape& shape) {
  return shape[kShifted] == shape[kByCoordinate]
             ? ", as from the screw, the belt, the scale or the pixels of that axis"
             : ", as from a guide of the other axis that is not straight";
}

}  // namespace

EffectFamily unnamed_plane_wave() {
  EffectFamily f = described("unnamed_plane_wave", {"shifted_along", "by", "wavelength_mm"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double angle = kTwoPi * coordinate_of(p, shape) / shape[kWavelength],
                 normal = part_of_shift(g, p, shape);
    c[0] = normal * std::cos(angle);
    c[1] = normal * std::sin(angle);
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = wavelengths_beside;
  f.term_keys = {{"shifted_along", TermKey::Kind::kWord, {"x", "y"}},
                 {"by", TermKey::Kind::kWord, {"x", "y"}},
                 number("wavelength_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return "places are shifted along " + axis_of(shape[kShifted]) + " in waves over " +
           axis_of(shape[kByCoordinate]) + printed(", %.4g mm long", shape[kWavelength]) +
           source_of_shift(shape);
  };
  return f;
}

EffectFamily unnamed_plane_saw() {
  constexpr std::size_t kJump = kWavelength + 1;
  EffectFamily f =
      described("unnamed_plane_saw", {"shifted_along", "by", "period_mm", "jump_at_mm"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface != Surface::kFlank
               ? 0.0
               : part_of_shift(g, p, shape) *
                     sawtooth(coordinate_of(p, shape) - shape[kJump], shape[kWavelength]);
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = wavelengths_beside(g, shape);
    for (const double share : {0.05, 0.02, 0.005})
      for (const double sign : {-1.0, 1.0}) {
        shapes.push_back(shape);
        shapes.back()[kJump] += sign * share * shape[kWavelength];
      }
    return shapes;
  };
  f.term_keys = {{"shifted_along", TermKey::Kind::kWord, {"x", "y"}},
                 {"by", TermKey::Kind::kWord, {"x", "y"}},
                 number("period_mm"),
                 number("jump_at_mm")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const std::string by = axis_of(shape[kByCoordinate]);
    // (what is rounded to steps is shifted by half of one to either side)
    constexpr double kAsLarge = 0.15;
    if (shape[kShifted] == shape[kByCoordinate] && told.amounts.size() == 1 &&
        std::abs(std::abs(told.amounts[0]) - 1e3 * shape[kWavelength]) <
            kAsLarge * 1e3 * shape[kWavelength])
      return by + printed(" of the outline is rounded to steps of %.3g mm", shape[kWavelength]) +
             ", alike at every height, as from the pixels of a light or the steps of an axis";
    return "places are shifted along " + axis_of(shape[kShifted]) + " in a sawtooth over " + by +
           printed(", period %.4g mm", shape[kWavelength]) + ", one of its jumps at " + by +
           printed(" = %.4g mm", shape[kJump]) +
           (told.sign() == 0
                ? ""
                : std::string(", where the shift jumps ") + (told.sign() > 0 ? "up" : "down")) +
           source_of_shift(shape);
  };
  return f;
}

EffectFamily unnamed_plane_stripes() {
  enum Stripes : std::size_t { kDirection, kLength };
  EffectFamily f = described("unnamed_plane_stripes", {"direction_deg", "wavelength_mm"});
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const PlanePoint point = point_of(p);
    const double direction = rad_from_deg(shape[kDirection]),
                 angle = kTwoPi * (point.x * std::cos(direction) + point.y * std::sin(direction)) /
                         shape[kLength];
    c[0] = std::cos(angle);
    c[1] = std::sin(angle);
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    // Along the stripes and across them the phase turns by these shares of a wave over the gear.
    std::vector<EffectShape> shapes;
    const double wide_mm = 2.0 * g.reference_radius_mm();
    for (const double waves : {0.2, 0.07, 0.02, 0.007, 0.002})
      for (const double sign : {-1.0, 1.0}) {
        const double off = sign * waves / wide_mm, frequency = 1.0 / shape[kLength] + off;
        shapes.push_back(shape);
        shapes.back()[kDirection] += deg_from_rad(off * shape[kLength]);
        if (!(frequency > 0.0)) continue;
        shapes.push_back(shape);
        shapes.back()[kLength] = 1.0 / frequency;
      }
    return shapes;
  };
  f.term_keys = {number("direction_deg"), number("wavelength_mm")};
  f.words = [](const ToldForm& told) {
    return printed(
               "the flanks stand out and lie back in stripes of the plane, in waves %.4g mm long",
               told.shape[kLength]) +
           printed(" in the direction %.3g deg,",
                   std::fmod(std::fmod(told.shape[kDirection], 180.0) + 180.0, 180.0)) +
           " at all heights, as from the fringes that a scanner projects";
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
