// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow ridges of scanned flanks: where values lie on their slopes is no random error.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/one_drawn_form.h"
#include "tests/loop/words_of_forms.h"
#include "trueflank/loop/gear/fit/point_fit.h"

namespace trueflank::test {
namespace {

/// Ridges of all flanks over the face, their middles and half widths in halves of it.
Process ridges_over_face(double um, const std::vector<double>& middles, double half) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    double sum = 0.0;
    for (const double middle : middles) sum += um * bell_of(s.v - middle, half);
    return sum;
  });
}
/// The same over the profile.
Process ridges_over_profile(double um, const std::vector<double>& middles, double half) {
  return grown([=](auto&, const FlankSpot& s, auto&) {
    double sum = 0.0;
    for (const double middle : middles) sum += um * bell_of(s.u - middle, half);
    return sum;
  });
}

/// How loud the loudest patch of a scan's flanks is.
double loudest(const loop::Patches& patches) {
  double most = 0.0;
  for (const auto& patch : patches.patches) most = std::max(most, patch.loud);
  return most;
}

TEST(RidgesOfScans, AreNoRandomErrorBesideTheForm) {
  const MadeGear gear = spur(24);
  const loop::FlankGeometry geometry = geometry_of(gear);
  loop::MeasuredData data;
  data.scans.push_back(
      scan_of(gear, {ridges_over_face(60.0, {-0.3}, 0.06)}, scanned(9000, 4.0, 3)));
  const loop::Observations table = *make_observations(geometry, std::move(data), {.aligned = true});
  loop::Patches patches = make_patches(geometry, table);
  ASSERT_GT(loudest(patches), 2.0);
  const double b = geometry.face_width_mm();
  const loop::PointFit fit(geometry, table, patches,
                           {effect_of("unnamed_band", {1.0, 0.35 * b, 0.03 * b})});
  const auto left_um = fit.residuals_um();
  EXPECT_TRUE(weigh_again(geometry, table, *left_um, patches));
  EXPECT_LT(loudest(patches), 1.3);
  EXPECT_FALSE(weigh_again(geometry, table, *left_um, patches));
}

/// A drawn scan with one to three ridges, and what is told of it: those, in forms of one size.
void expect_ridges_alone(unsigned seed) {
  Draw draw(seed);
  const MadeGear gear = spur(draw.whole(16, 40));
  const double um = draw.sign() * draw.between(40.0, 90.0);
  std::vector<double> middles{draw.between(-0.7, -0.45)};
  if (draw.whole(0, 2) > 0) middles.push_back(draw.between(-0.1, 0.15));
  if (draw.whole(0, 1) > 0) middles.push_back(draw.between(0.45, 0.7));
  const bool face = seed % 2 == 0;
  const double half = draw.between(0.07, 0.1);
  const auto made =
      face ? ridges_over_face(um, middles, half) : ridges_over_profile(um, middles, half);
  const auto result = close(gear, scan_of(gear, {made}, scanned(9000, 4.0, seed)), true);
  for (const char* piece : {"ridge", "groove", "step", "kink", "waves"})
    EXPECT_EQ(result.structure_left.find(piece), std::string::npos) << seed << ": " << list(result);
  std::size_t forms = 0;
  for (const auto& effect : result.effects) {
    forms += std::max<std::size_t>(1, effect.terms.size());
    const double size = effect.terms.empty() ? parameter(effect, "depth_um").value
                                             : effect.terms.front().amplitude();
    EXPECT_NEAR(std::abs(size), std::abs(um), 0.03 * std::abs(um)) << seed << ": " << list(result);
  }
  EXPECT_EQ(forms, middles.size()) << seed << ": " << list(result);
}

TEST(RidgesOfScans, HaveNothingBesideThem) {
  for (unsigned seed = 1; seed <= survey_size(4U, 12U); ++seed) expect_ridges_alone(seed);
}

}  // namespace
}  // namespace trueflank::test
