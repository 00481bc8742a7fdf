// SPDX-License-Identifier: GPL-3.0-or-later
//
// The share of sets that jam, against sets drawn here: their backlash is what the textbook's linear
// formulas leave of it, by the errors of two teeth and of their axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/check/check_designs.h"
#include "trueflank/check/tolerance_analysis.h"

namespace trueflank::test {
namespace {

/// Three standard deviations, cut off there.
class Drawn {
 public:
  double within(double limit) {
    double z = normal_(engine_);
    while (std::abs(z) > 3.0) z = normal_(engine_);
    return limit * z / 3.0;
  }

 private:
  std::mt19937_64 engine_{20261128};
  std::normal_distribution<double> normal_;
};

struct Errors {
  double thickness_um, eccentricity_um;
};

Errors drawn(const ToleranceOptions& o, Drawn& draw) {
  return {draw.within(o.tooth_thickness_um) + std::abs(draw.within(o.pitch_um.value_or(0.0))),
          std::abs(draw.within(0.5 * o.runout_um.value_or(0.0)))};
}

/// Unshifted teeth of 20 degrees with so much backlash: what two errors and an axis that stands
/// `off_um` too far leave of it. Outside, axes that stand nearer take from it, in a ring those that
/// stand farther.
bool jams(double backlash_um, bool ring, const Errors& a, const Errors& b, double off_um) {
  const double slack = ring ? -off_um : off_um, wobble = a.eccentricity_um + b.eccentricity_um;
  return backlash_um + 2.0 * std::tan(kPi / 9.0) * (slack - wobble) - a.thickness_um -
             b.thickness_um <
         0.0;
}

struct Shares {
  double sun = 0.0, ring = 0.0, any = 0.0;
};

/// Of a sun, planets and a ring: sun and ring are the same for all planets of a set, planets and
/// pins are not.
Shares shares_drawn(double backlash_um, int planets, const ToleranceOptions& o) {
  constexpr int kSets = 40000;
  Drawn draw;
  Shares shares;
  for (int set = 0; set < kSets; ++set) {
    bool sun_jams = false, ring_jams = false;
    const Errors sun = drawn(o, draw), ring = drawn(o, draw);
    for (int i = 0; i < planets; ++i) {
      const Errors planet = drawn(o, draw);
      const double off_um = draw.within(o.centre_distance_um);
      sun_jams = sun_jams || jams(backlash_um, false, sun, planet, off_um);
      ring_jams = ring_jams || jams(backlash_um, true, planet, ring, off_um);
    }
    shares.sun += sun_jams / static_cast<double>(kSets);
    shares.ring += ring_jams / static_cast<double>(kSets);
    shares.any += (sun_jams || ring_jams) / static_cast<double>(kSets);
  }
  return shares;
}

/// The findings tell the figures of the result; those of meshes and of the whole train.
void expect_in_words(const GearTrain& train, const ToleranceResult& result) {
  const Findings findings = check_tolerance(train, result);
  ASSERT_EQ(findings.size(), result.meshes.size() + 1);
  for (std::size_t i = 0; i < result.meshes.size(); ++i) {
    const MeshTolerance& mesh = result.meshes[i];
    const std::string& text = findings[i].message;
    EXPECT_NEAR(told(text, "backlash falls from "), 1e3 * mesh.nominal_backlash_mm, 0.01) << text;
    EXPECT_NEAR(told(text, " to "), 1e3 * mesh.smallest_backlash_mm, 0.01) << text;
    EXPECT_NEAR(told(text, "clearance to "), 1e3 * mesh.smallest_clearance_mm, 0.01) << text;
    EXPECT_NEAR(told(text, "; "), 100.0 * mesh.jam_share, 0.0051) << text;
    EXPECT_NEAR(findings[i].value, 1e3 * mesh.smallest_clearance_mm, 1e-9);
    EXPECT_EQ(findings[i].margin, findings[i].value);
  }
  const Finding& whole = findings.back();
  EXPECT_NEAR(told(whole.message, ""), 100.0 - 100.0 * result.jam_share, 0.0051) << whole.message;
  EXPECT_NEAR(told(whole.message, " assemble and run, "), 100.0 * result.jam_share, 0.0051)
      << whole.message;
  EXPECT_NEAR(told(whole.message, " % of "), result.sets, 0.0) << whole.message;
  EXPECT_NEAR(whole.value, 100.0 * result.jam_share, 1e-9);
  EXPECT_NEAR(whole.margin, 0.27 - whole.value, 1e-9);
  EXPECT_NEAR(whole.limit, 0.27, 1e-9);
}

TEST(DrawnTolerances, SharesAreThoseOfSetsWhosePlanetsAndPinsDiffer) {
  const ToleranceOptions kinds[] = {
      {.tooth_thickness_um = 36.0},
      {.centre_distance_um = 80.0},
      {.runout_um = 70.0},
      {.pitch_um = 40.0},
      {.centre_distance_um = 20.0, .tooth_thickness_um = 20.0, .runout_um = 20.0, .pitch_um = 8.0}};
  int between = 0;
  for (const int planets : {1, 4})
    for (ToleranceOptions options : kinds) {
      SCOPED_TRACE(std::to_string(planets) + " planets");
      GearboxDesign design = simple_design(20, 32, 84, planets);
      design.backlash_mm = 0.02;
      design.rack.addendum = 0.7;  // flanks alone decide
      for (GearDesign& g : design.gears) g.shift = 0.0;
      options.sets = 10000;
      const GearTrain train = laid_out(design);
      const auto told = analyse_tolerances(train, options);
      ASSERT_TRUE(told);
      expect_in_words(train, *told);
      const Shares drawn = shares_drawn(20.0, planets, options);
      // five standard errors of both, and what is not linear
      const auto near = [](double share) {
        return 5.0 * std::sqrt(share * (1.0 - share) * 1.25e-4) + 0.003;
      };
      EXPECT_NEAR(told->meshes[0].jam_share, drawn.sun, near(drawn.sun));
      EXPECT_NEAR(told->meshes[1].jam_share, drawn.ring, near(drawn.ring));
      EXPECT_NEAR(told->jam_share, drawn.any, near(drawn.any));
      between += drawn.any > 0.05 && drawn.any < 0.95 ? 1 : 0;
    }
  EXPECT_GE(between, 8);
}

TEST(DrawnTolerances, AllOrNoneAreWholeShares) {
  GearboxDesign design = simple_design(20, 32, 84, 3);
  for (GearDesign& g : design.gears) g.shift = 0.0;
  for (const auto& [backlash_mm, share] : {std::pair(-0.05, 1.0), {0.2, 0.0}}) {
    design.backlash_mm = backlash_mm;
    const auto told = analyse_tolerances(laid_out(design), {.tooth_thickness_um = 5.0, .sets = 50});
    ASSERT_TRUE(told);
    EXPECT_EQ(told->jam_share, share);
    for (const MeshTolerance& mesh : told->meshes) EXPECT_EQ(mesh.jam_share, share);
  }
}

TEST(DrawnTolerances, WithinWhichTeethNoLongerMeshAreAnErrorOfTheirMesh) {
  const GearTrain train = laid_out(simple_design(20, 32, 84, 3));
  const auto told = analyse_tolerances(train, {.centre_distance_um = 3000.0, .sets = 10});
  ASSERT_FALSE(told);
  const std::string start =
      train.meshes[0].name + " at the limits of its tolerances: at centre distance ";
  EXPECT_EQ(told.error().message.find(start), 0u) << told.error().message;
}

}  // namespace
}  // namespace trueflank::test
