// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/check/random_pairs.h"

#include <algorithm>
#include <random>
#include <sstream>

#include "tests/check/check_designs.h"

namespace trueflank::test {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  // own distributions: those of the library differ between implementations
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double p) { return real(0.0, 1.0) < p; }

 private:
  std::mt19937_64 engine_;
};

void vary_rack(GearboxDesign& d, Dice& dice) {
  if (dice.chance(0.3)) {
    const double angles[] = {14.5, 17.5, 22.5, 25.0};
    d.rack.pressure_angle_rad = rad_from_deg(angles[dice.integer(0, 3)]);
  }
  const double radii[] = {0.0, 0.1, 0.25, 0.38, 0.38, 0.6};
  d.rack.root_radius = radii[dice.integer(0, 5)];
  if (dice.chance(0.3)) d.rack.dedendum = dice.real(1.0, 1.35);
  if (dice.chance(0.3)) d.rack.addendum = dice.real(0.8, 1.1);
}

void vary_ring(GearDesign& ring, int largest_cutter, Dice& dice) {
  if (!dice.chance(0.5)) return;
  ring.root = RingRoot::kShaper;
  ring.cutter = ShaperCutter{dice.integer(std::min(14, largest_cutter), std::max(15, largest_cutter)),
                             dice.real(-0.1, 0.2), dice.chance(0.5) ? 0.0 : dice.real(0.05, 0.3)};
}

void vary_backlash(GearboxDesign& d, Dice& dice) {
  const int kind = dice.integer(0, 3);
  if (kind == 0) d.backlash_mm = 0.0;
  if (kind == 1) d.backlash_mm = dice.real(0.005, 0.05);
  if (kind >= 2) d.backlash_mm = dice.real(0.05, 0.2);
}

/// Tip circles a little too long, as when a designer tries his luck.
void vary_tips(GearboxDesign& d, Dice& dice) {
  const auto train = lay_out(d);
  if (!train) return;
  for (std::size_t i = 0; i < d.gears.size(); ++i) {
    if (!dice.chance(0.3)) continue;
    const double sign = d.gears[i].kind == GearKind::kExternal ? 1.0 : -1.0;
    d.gears[i].tip_diameter_mm =
        2.0 * (train->gears[i].profile.tip_radius_mm() + sign * dice.real(-0.25, 0.3));
  }
}

GearboxDesign random_pair(Dice& dice, bool internal) {
  const int pinion = dice.integer(6, 45);
  const int wheel = internal ? pinion + dice.integer(4, 50) : dice.integer(8, 90);
  GearboxDesign d = pair_design(pinion, wheel, internal);
  vary_rack(d, dice);
  vary_backlash(d, dice);
  GearDesign &p = d.gears[0], &w = d.gears[1];
  p.shift = dice.real(-0.4, 0.8);
  const double sum = dice.real(-0.4, 0.9);
  w.shift = internal ? *p.shift + sum : sum - *p.shift;
  if (dice.chance(0.2)) {  // a centre distance that does not quite fit
    if (const auto train = lay_out(d))
      d.centre_distance_mm = train->centre_distance_mm + dice.real(-0.03, 0.03);
  }
  if (internal) vary_ring(w, wheel - 15, dice);
  vary_tips(d, dice);
  return d;
}

GearboxDesign random_3k(Dice& dice) {
  GearboxDesign d = paper_design(0.0);
  d.centre_distance_mm.reset();
  vary_backlash(d, dice);
  d.rack.root_radius = dice.chance(0.5) ? 0.38 : 0.2;
  const int sun = dice.integer(9, 24), planet = dice.integer(15, 45);
  const int ring = sun + 2 * planet, less = dice.integer(1, 9);
  const int teeth[] = {sun, planet, ring, planet - less, ring - less - dice.integer(-1, 2)};
  for (std::size_t i = 0; i < 5; ++i) d.gears[i].teeth = teeth[i];
  d.gears[2].shift = dice.real(-0.1, 0.8);
  d.gears[4].shift = dice.real(0.0, 1.5);
  d.centre_distance_mm = 0.5 * (sun + planet) + dice.real(0.0, 0.4);
  vary_ring(d.gears[2], ring - 20, dice);
  vary_ring(d.gears[4], ring - 25, dice);
  vary_tips(d, dice);
  return d;
}

}  // namespace

GearboxDesign random_design(std::uint64_t seed) {
  Dice dice(0x9E3779B97F4A7C15ull * (seed + 1));
  const int kind = dice.integer(0, 9);
  GearboxDesign design = kind < 8 ? random_pair(dice, kind >= 3) : random_3k(dice);
  design.tips = TipCircles::kStandard;  // tips too long belong to what is tried
  return design;
}

std::string describe(const GearboxDesign& d) {
  std::ostringstream s;
  s.precision(12);
  s << d.topology.kind << " a=" << d.centre_distance_mm.value_or(0.0) << " j=" << d.backlash_mm
    << " alpha=" << deg_from_rad(d.rack.pressure_angle_rad) << " ha=" << d.rack.addendum
    << " hf=" << d.rack.dedendum << " rho=" << d.rack.root_radius;
  for (const GearDesign& g : d.gears) {
    s << " [" << g.name << " z=" << g.teeth << " x=" << g.shift.value_or(kNaN)
      << " da=" << g.tip_diameter_mm.value_or(0.0);
    if (g.cutter)
      s << " cutter " << g.cutter->teeth << ' ' << g.cutter->shift << ' ' << g.cutter->tip_radius;
    s << ']';
  }
  return s.str();
}

}  // namespace trueflank::test
