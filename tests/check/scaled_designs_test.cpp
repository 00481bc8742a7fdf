// SPDX-License-Identifier: GPL-3.0-or-later
//
// Teeth do not know how large they are: a design with everything four times as large is judged the
// same, and whatever is told of it in mm or um is four times as much. Four is a power of two: most
// of what is computed differs in no digit.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/cure/joint_cure.h"
#include "trueflank/design/design_edit.h"

namespace trueflank::test {
namespace {

constexpr double kLarger = 4.0;

void enlarge(std::optional<double>& value) {
  if (value) *value *= kLarger;
}

GearboxDesign enlarged(GearboxDesign d) {
  d.module_mm *= kLarger;
  d.backlash_mm *= kLarger;
  d.layer_gap_mm *= kLarger;
  enlarge(d.centre_distance_mm);
  enlarge(d.corner_contact_limit_mm);
  enlarge(d.made.clearance_mm);
  enlarge(d.made.axis_tolerance_mm);
  enlarge(d.made.thickness_tolerance_mm);
  for (GearDesign& g : d.gears) {
    g.face_width_mm *= kLarger;
    enlarge(g.tip_diameter_mm);
    enlarge(g.thinning_mm);
    ModificationsDesign& m = g.modifications;
    for (double* length :
         {&m.tip_relief_um, &m.tip_relief_start_diameter_mm, &m.root_relief_um,
          &m.root_relief_start_diameter_mm, &m.profile_crowning_um, &m.profile_slope_um,
          &m.crowning_um, &m.end_relief_um, &m.end_relief_length_mm, &m.helix_slope_um,
          &m.edge_chamfer_mm, &m.tip_rounding_mm})
      *length *= kLarger;
  }
  return d;
}

const std::regex kNumber("[-+]?[0-9]+(\\.[0-9]+)?");

std::string words_of(const std::string& text) { return std::regex_replace(text, kNumber, "#"); }

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it)
    numbers.push_back(std::stod(it->str()));
  return numbers;
}

/// The same words, and numbers that are the same or so much larger, but for how they are rounded
/// and sought.
void expect_enlarged(const std::string& small, const std::string& large) {
  ASSERT_EQ(words_of(small), words_of(large));
  const std::vector<double> before = numbers_of(small), after = numbers_of(large);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double off =
        std::min(std::abs(after[i] - before[i]), std::abs(after[i] - kLarger * before[i]));
    EXPECT_LE(off, 0.02 + 1e-3 * std::abs(before[i])) << small << '\n' << large;
  }
}

/// How far value and limit are apart, and on the good side where the finding passes.
void expect_margin_is_that_of_the_status(const Finding& f) {
  const double rounding =
      f.unit == "um" ? 2e-3 : 1e-6;  // flanks that touch by less do not penetrate
  if (!std::isnan(f.value) && !std::isnan(f.limit)) {
    EXPECT_NEAR(std::abs(f.margin), std::abs(f.value - f.limit), rounding);
  }
  // of these the profiles say more than the criterion
  if (f.id == "fillet_interference" || f.id == "involute_interference" ||
      f.id == "trimming_interference")
    return;
  EXPECT_FALSE(f.status == CheckStatus::kPass && f.margin < -rounding);
  EXPECT_FALSE(f.status == CheckStatus::kFail && f.margin > rounding);
}

void expect_judged_alike(const GearboxDesign& design) {
  const auto small = lay_out(design), large = lay_out(enlarged(design));
  ASSERT_EQ(small.has_value(), large.has_value());
  if (!small) return;
  const Findings before = check_gearbox(*small), after = check_gearbox(*large);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Finding &a = before[i], &b = after[i];
    SCOPED_TRACE(a.id + ' ' + a.where + ": " + a.message);
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.status, b.status) << b.message;
    EXPECT_EQ(a.unit, b.unit);
    expect_margin_is_that_of_the_status(a);
    const double factor = a.unit == "mm" || a.unit == "um" ? kLarger : 1.0,
                 near = a.unit == "%"    ? 0.2
                        : a.unit == "um" ? 2e-2
                                         : 1e-4;
    const auto expect_near = [&](double x, double y) {
      EXPECT_EQ(std::isnan(x), std::isnan(y));
      EXPECT_FALSE(std::abs(factor * x - y) > near) << x << ' ' << y;
    };
    expect_near(a.value, b.value);
    expect_near(a.limit, b.limit);
    expect_near(a.margin, b.margin);
    // places of equal clearance are many, and sets are drawn from a field that is plane within 10
    // nm
    if (a.id != "overlap" && a.id != "tolerance") expect_enlarged(a.message, b.message);
    expect_enlarged(a.cure, b.cure);
  }
}

TEST(ScaledDesigns, OfRandomTeethAreJudgedAlike) {
  for (std::uint64_t seed = 41; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    GearboxDesign design = random_design(seed);
    if (seed % 3 == 1) design.made.clearance_mm = 0.03;
    if (seed % 4 == 1) design.made.thickness_tolerance_mm = 0.02;
    expect_judged_alike(design);
  }
}

TEST(ScaledDesigns, OfModifiedTeethAreJudgedAlike) {
  GearboxDesign slopes = pair_design(21, 38, false, 0.02),
                reliefs = pair_design(17, 52, true, 0.03),
                helical = pair_design(12, 60, false, 0.05);
  gear(slopes, "pinion").modifications = {.profile_slope_um = 12.0, .helix_slope_um = 25.0};
  gear(slopes, "wheel").modifications.crowning_um = 15.0;
  gear(reliefs, "pinion").modifications = {.tip_relief_um = 18.0,
                                           .tip_relief_start_diameter_mm = 18.2};
  gear(reliefs, "wheel").modifications = {
      .end_relief_um = 20.0, .end_relief_length_mm = 2.0, .tip_rounding_mm = 0.1};
  gear(helical, "pinion").modifications = {.profile_crowning_um = 14.0, .edge_chamfer_mm = 0.4};
  helical.helix_angle_rad = 0.25;
  for (const GearboxDesign& design : {slopes, reliefs, helical}) expect_judged_alike(design);
}

TEST(ScaledDesigns, AreCuredAlike) {
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 7; ++seed) {
    GearboxDesign design = random_design(seed);
    if (seed % 3 == 1) design.made.clearance_mm = 0.02;
    const GearboxDesign larger = enlarged(design);
    const auto small = lay_out(design), large = lay_out(larger);
    if (!small || !large) continue;
    SCOPED_TRACE(std::to_string(seed) + ' ' + describe(design));
    const JointCureOptions soon{
        .most_designs = 40, .most_turned = 10, .most_judged = 8, .farther = false};
    const JointCure before = joint_cure(*small, soon), after = joint_cure(*large, soon);
    EXPECT_EQ(before.conflict, after.conflict);
    const auto keys = design_changes(design, before.design),
               keys_of_larger = design_changes(larger, after.design);
    ASSERT_EQ(keys.size(), keys_of_larger.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      ASSERT_EQ(keys[i].dotted(), keys_of_larger[i].dotted());
      expect_enlarged(keys[i].after, keys_of_larger[i].after);
    }
    changed += before.changed ? 1 : 0;
  }
  EXPECT_GT(changed, 3);
}

}  // namespace
}  // namespace trueflank::test
