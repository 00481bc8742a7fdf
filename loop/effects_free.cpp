// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "trueflank/loop/effect.h"

// The free form: Legendre over roll x Legendre over height x order around the gear x sum or difference
// of the flanks. It describes what no named effect explains, and is given no cause.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;

/// Orthogonal on -1 ... 1.
double legendre(int degree, double x) {
  double before = 1.0, now = x;
  if (degree == 0) return 1.0;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0);
    before = now;
    now = next;
  }
  return now;
}

constexpr int kMostProfileDegree = 4, kMostFaceDegree = 4;

std::vector<Shape> free_shapes(const FlankGeometry& g) {
  std::vector<Shape> shapes;
  const int half = (g.teeth() - 1) / 2;
  for (int i = 0; i <= kMostProfileDegree; ++i)
    for (int j = 0; j <= kMostFaceDegree; ++j) {
      if (i + j > 4) continue;
      const int most = std::min(half, i + j == 0 ? 60 : i + j <= 2 ? 6 : 3);
      for (int n = 0; n <= most; ++n)
        for (const int flanks : {0, 1}) {
          if (i + j == 0 && n == 0 && flanks == 1) continue;  // a turn: no effect
          shapes.push_back({double(i), double(j), double(n), double(flanks)});
        }
    }
  return shapes;
}

EffectFamily free_form() {
  EffectFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.parameters = {"cos_um", "sin_um"};
  f.shape_names = {"profile_degree", "face_degree", "order", "opposite_flanks"};
  f.named = false;
  f.preference = 3;
  f.columns = [](const Shape& shape) { return shape[2] == 0.0 ? 1 : 2; };
  f.shapes = free_shapes;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const Shape& shape, double* c) {
    const bool wave = shape[2] != 0.0;
    c[0] = 0.0;
    if (wave) c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double value = legendre(static_cast<int>(shape[0]), g.profile_coordinate(p.roll_mm)) *
                         legendre(static_cast<int>(shape[1]), g.face_coordinate(p.z_mm)) *
                         (shape[3] != 0.0 ? p.side : 1);
    if (!wave) {
      c[0] = value;
      return;
    }
    c[0] = value * std::cos(shape[2] * p.centre_rad);
    c[1] = value * std::sin(shape[2] * p.centre_rad);
  };
  return f;
}

EffectFamily free_flank() {
  EffectFamily f;
  f.id = "unnamed_flank";
  f.description = "one flank of one tooth stands out";
  f.parameters = {"amount_um"};
  f.shape_names = {"tooth"};
  f.named = false;
  f.flank_only = true;
  f.local = true;
  f.preference = 4;
  f.correctable = Correctable::kNoCause;
  f.shapes = [](const FlankGeometry& g) {
    std::vector<Shape> shapes;
    for (int k = 1; k <= g.teeth(); ++k) shapes.push_back({static_cast<double>(k)});
    return shapes;
  };
  f.evaluate = [](const FlankGeometry&, const Place& p, const Shape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank && p.tooth == static_cast<int>(shape[0]) ? 1.0 : 0.0;
  };
  return f;
}

}  // namespace

std::vector<EffectFamily> free_effects() { return {free_form(), free_flank()}; }

}  // namespace trueflank::loop
