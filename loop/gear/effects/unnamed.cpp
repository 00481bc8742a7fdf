// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/legendre.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

// The free form: Legendre over profile and face, times an order around the gear, alike or opposite
// on the two flanks. It describes and is given no cause.
namespace trueflank::loop::gear_effects {
namespace {

constexpr int kMostProfileDegree = 4, kMostFaceDegree = 4, kMostOrder = 60;

std::vector<EffectShape> free_shapes(const FlankGeometry& g) {
  std::vector<EffectShape> shapes;
  const int half = (g.teeth() - 1) / 2;
  for (int i = 0; i <= kMostProfileDegree; ++i)
    for (int j = 0; j <= kMostFaceDegree; ++j) {
      if (i + j > 4) continue;
      const int most = std::min(half, i + j == 0 ? kMostOrder : i + j <= 2 ? 6 : 3);
      for (int n = 0; n <= most; ++n)
        for (const int flanks : {0, 1}) {
          if (i + j == 0 && n == 0 && flanks == 1) continue;  // a turn: no effect
          shapes.push_back({double(i), double(j), double(n), double(flanks)});
        }
    }
  return shapes;
}

/// Polynomials and waves of a place are shared by all terms.
void evaluate_terms(const FlankGeometry& g, const Place& p, std::span<const Effect> effects,
                    double* c) {
  const double on_flank = p.surface == Surface::kFlank ? 1.0 : 0.0;
  std::array<double, kMostProfileDegree + 1> over_profile;
  std::array<double, kMostFaceDegree + 1> over_face;
  for (int i = 0; i <= kMostProfileDegree; ++i)
    over_profile[static_cast<std::size_t>(i)] =
        on_flank * legendre(i, g.profile_coordinate(p.roll_mm));
  for (int j = 0; j <= kMostFaceDegree; ++j)
    over_face[static_cast<std::size_t>(j)] = legendre(j, g.face_coordinate(p.z_mm));
  std::array<std::array<double, 2>, kMostOrder + 1> waves;
  WavesOf wave(g.centre_rad(p.tooth));
  std::size_t known = 0;
  const auto wave_at = [&](double order) {  // terms of what is left may be of higher orders
    if (order > kMostOrder) return WavesOf(g.centre_rad(p.tooth)).of(order);
    for (; known <= static_cast<std::size_t>(order); ++known)
      waves[known] = wave.of(static_cast<double>(known));
    return waves[static_cast<std::size_t>(order)];
  };
  for (const Effect& effect : effects) {
    const EffectShape& shape = effect.shape;
    const double value = over_profile[static_cast<std::size_t>(shape[0])] *
                         over_face[static_cast<std::size_t>(shape[1])] *
                         (shape[3] != 0.0 ? p.side : 1);
    const auto [cosine, sine] = wave_at(shape[2]);
    *c++ = value * cosine;
    if (shape[2] != 0.0) *c++ = value * sine;
  }
}

std::string course(int degree, const std::string& over) {
  switch (degree) {
    case 0:
      return "";
    case 1:
      return ", sloping over the " + over;
    case 2:
      return ", crowned over the " + over;
    case 3:
      return ", S-shaped over the " + over;
    default:
      return ", in a wave of degree " + std::to_string(degree) + " over the " + over;
  }
}

std::string in_words(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const double order = shape[2], direction_rad = told.direction_rad();
  const bool opposite = shape[3] != 0.0;
  std::string text = order == 0.0 ? "the same on every tooth" : times_per_turn(order);
  text += course(static_cast<int>(shape[0]), "profile");
  text += course(static_cast<int>(shape[1]), "face");
  if (told.flank == FlankChoice::kBoth)
    text += opposite ? ", opposite on the two flanks" : ", equal on both flanks";
  // (a wave has it where it is largest)
  const int sign = order == 0.0 ? told.sign() : std::isnan(direction_rad) ? 0 : 1;
  double square = 0.0;
  for (const double amount : told.amounts) square += amount * amount;
  constexpr double kLegendresBow = 1.5;
  const CourseOfTeeth form{shape[0],     shape[1], opposite,
                           told.flank,   sign,     square > 0.0 ? std::sqrt(square) : kNaN,
                           kLegendresBow};
  const std::string material = form.material();
  if (material.empty()) return text;
  return text + ": " + material +
         (order == 0.0 ? "" : ", most" + first_at(direction_rad, order).substr(1)) + form.in_all();
}

}  // namespace

EffectFamily unnamed() {
  EffectFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.parameters = {"cos_um", "sin_um"};
  f.shape_names = {"profile_degree", "face_degree", "order", "opposite_flanks"};
  f.term_keys = {{"profile_degree"},
                 {"face_degree"},
                 {"order"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.named = false;
  f.preference = 3;
  f.columns = [](const EffectShape& shape) { return shape[2] == 0.0 ? 1 : 2; };
  f.shapes = free_shapes;
  set_columns(
      f, {
             .tooth =
                 [](const FlankGeometry& g, int tooth, const EffectShape& shape, double* c) {
                   c[0] = 1.0;
                   if (shape[2] == 0.0) return;
                   const double angle = shape[2] * g.centre_rad(tooth);
                   c[0] = std::cos(angle);  // one argument: one call for both
                   c[1] = std::sin(angle);
                 },
             .form =
                 [](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
                   return legendre(static_cast<int>(shape[0]), g.profile_coordinate(p.roll_mm)) *
                          legendre(static_cast<int>(shape[1]), g.face_coordinate(p.z_mm)) *
                          (shape[3] != 0.0 ? p.side : 1);
                 },
         });
  f.evaluate_together = evaluate_terms;
  f.same_on_every_tooth = [](const EffectShape& shape) { return shape[2] == 0.0; };
  f.order = [](const EffectShape& shape) { return shape[2]; };
  f.needs = [](const EffectShape& shape) {
    return NeedsToBeSeen{.along_profile = shape[0] > 0.0,
                         .along_face = shape[1] > 0.0,
                         .crossed = shape[0] > 0.0 && shape[1] > 0.0};
  };
  // Low degrees first, low orders among them.
  f.complexity = [](const EffectShape& shape) { return shape[0] + shape[1] + 0.01 * shape[2]; };
  f.words = in_words;
  f.bends_over_the_face = [](const EffectShape& shape) { return shape[1] > 1.0; };
  return f;
}

}  // namespace trueflank::loop::gear_effects
