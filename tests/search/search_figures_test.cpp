// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "trueflank/search/search.h"
#include "trueflank/search/search_values.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/train/inertia.h"

namespace trueflank {
namespace {

SearchRequirements needs(const std::string& kind) {
  SearchRequirements r;
  r.kinds = {kind};
  r.ratio_min = kind == "3k" ? 90 : kind == "stepped" ? 8 : kind == "simple" ? 5 : 2;
  r.ratio_max = 1.1 * r.ratio_min;
  r.sun = {14, 15};
  r.planet1 = {24, 34};
  r.planet2 = {16, 30};
  r.ring1 = r.ring2 = {60, 90};
  r.motor = {.torque_nm = 0.5, .speed_rpm = 3000, .rotor_kg_m2 = 1e-5, .load_kg_m2 = 0.1};
  r.losses = LossesDesign{.drag_torque_nm = 0.002};
  r.results = 1;
  return r;
}

/// The first set that has shifts, with its best candidate.
struct Found {
  ToothSet set;
  SearchCandidate candidate;
};
Found first_of(const SearchRequirements& r) {
  for (const ToothSet& set : enumerate_sets(r).sets)
    if (const SetResult result = optimise_set(r, set); !result.candidates.empty())
      return {set, result.candidates.front()};
  ADD_FAILURE() << "no set has shifts";
  return {};
}

TEST(SearchFigures, MassAndInertiaAreThoseOfTheSolids) {
  for (const char* kind : {"3k", "stepped", "simple", "pair"}) {
    const SearchRequirements r = needs(kind);
    const Found found = first_of(r);
    const SearchModel model(r, found.set);
    const auto train = lay_out(model.design(found.candidate.free));
    ASSERT_TRUE(train.has_value());
    const auto parts = part_shapes(*train);
    ASSERT_TRUE(parts.has_value());
    const double density = r.strength.materials.find(r.strength.material)->density_kg_m3;
    const BodyInertias bodies = body_inertias(*train, *parts, [&](const PartShape&) { return density; });
    double mass = 0.0;
    for (std::size_t m = 0; m < bodies.size(); ++m)
      mass += train->copies_of(static_cast<int>(m)) * bodies[m].mass_kg;
    const EfficiencyResult exact = efficiency(*train);
    const ReflectedInertia felt = reflected_inertia(
        *train, exact, bodies,
        {.rotor_kg_m2 = 1e-5, .load_kg_m2 = 0.1, .drag_torque_nm = 0.002});
    const DesignFigures& f = found.candidate.figures;
    EXPECT_NEAR(f.mass_kg, mass, 1e-4 * mass) << kind;
    EXPECT_NEAR(f.input_inertia_kg_m2, felt.at_input_forward_kg_m2, 2e-4 * f.input_inertia_kg_m2) << kind;
    EXPECT_NEAR(f.output_inertia_kg_m2, felt.at_output_backward_kg_m2, 2e-4 * f.output_inertia_kg_m2) << kind;
    EXPECT_NEAR(f.starting_torque_nm, felt.starting_torque_nm, 2e-4 * f.starting_torque_nm) << kind;
  }
}

TEST(SearchFigures, BacklashOfAPairIsItsPlayOverTheRadius) {
  SearchRequirements r = needs("pair");
  r.backlash_mm = 0.05;
  const Found found = first_of(r);
  const auto train = lay_out(SearchModel(r, found.set).design(found.candidate.free));
  ASSERT_TRUE(train.has_value());
  const double radius = pitch_radius2_mm(train->pair(train->meshes[0]));
  EXPECT_NEAR(found.candidate.figures.backlash_arcmin, 60.0 * deg_from_rad(0.05 / radius), 1e-6);
}

TEST(SearchFigures, AMoveEndsWhereItsAccelerationsSay) {
  // no friction, no drag: torque both ways, the same inertia both ways
  SearchRequirements r = needs("pair");
  r.friction = 0.0;
  r.losses.reset();
  r.motor.speed_rpm = kNaN;
  r.motor.move_rad = 1.0;
  const Found found = first_of(r);
  const DesignFigures& f = found.candidate.figures;
  const double ratio = std::abs(signed_ratio(found.set));
  EXPECT_NEAR(f.acceleration_rad_s2, ratio * 0.5 / f.output_inertia_kg_m2, 1e-6 * f.acceleration_rad_s2);
  EXPECT_NEAR(f.settling_s, 2.0 * std::sqrt(1.0 / f.acceleration_rad_s2), 1e-6 * f.settling_s);
  r.motor.speed_rpm = 30.0;  // and with a plateau
  const auto train = lay_out(SearchModel(r, found.set).design(found.candidate.free));
  const double slow = design_figures(r, *train, 1.0, 1.0, 1.0).settling_s;
  const double fastest = 30.0 * kTwoPi / 60.0 / ratio;
  EXPECT_NEAR(slow, 1.0 / fastest + fastest / f.acceleration_rad_s2, 1e-6 * slow);
}

TEST(SearchFigures, EveryFigureCanBeTheObjectiveAndIsNoWorseThanThatOfTheEfficiency) {
  SearchRequirements r = needs("simple");
  const Found plain = first_of(r);
  for (const ObjectiveEntry& entry : objective_entries()) {
    r.objectives = {entry.objective};
    const SetResult result = optimise_set(r, plain.set);
    ASSERT_FALSE(result.candidates.empty()) << entry.name;
    EXPECT_GE(result.candidates[0].merit(entry.objective),
              plain.candidate.merit(entry.objective) - 1e-9) << entry.name;
    EXPECT_GE(result.candidates[0].least_margin, 0.0) << entry.name;
  }
}

TEST(SearchFigures, ALimitOfAFigureIsKeptOrNamed) {
  SearchRequirements r = needs("3k");
  const Found plain = first_of(r);
  for (const SearchObjective figure : {SearchObjective::kMass, SearchObjective::kSliding,
                                       SearchObjective::kContactRatio, SearchObjective::kSize}) {
    const double value = plain.candidate.value(figure);
    const bool larger = objective_entry(figure).larger_is_better;
    SearchRequirements held = r;
    held.figure_limits = {{figure, value * (larger ? 1.01 : 0.99)}};
    const SetResult kept = optimise_set(held, plain.set);
    ASSERT_FALSE(kept.candidates.empty()) << to_text(figure);
    EXPECT_GE(kept.candidates[0].merit(figure), merit_of_figure(figure, held.figure_limits[0].value)) << to_text(figure);
    EXPECT_LE(kept.candidates[0].forward, plain.candidate.forward + 1e-9) << to_text(figure);
    held.figure_limits = {{figure, value * (larger ? 10.0 : 0.1)}};
    const SetResult none = optimise_set(held, plain.set);
    EXPECT_TRUE(none.candidates.empty()) << to_text(figure);
    EXPECT_EQ(none.failed_limit, static_cast<int>(kLimits)) << to_text(figure);
  }
}

TEST(SearchFigures, WidthThenModuleGrowUntilTheTorqueIsCarried) {
  SearchRequirements r = needs("simple");
  const Found plain = first_of(r);
  r.output_torque_nm = 1.5 * plain.candidate.torque_nm;
  EXPECT_TRUE(optimise_set(r, plain.set).candidates.empty());
  r.face_width_max_mm = 20.0;
  const SetResult wide = optimise_set(r, plain.set);
  ASSERT_FALSE(wide.candidates.empty());
  EXPECT_NEAR(wide.candidates[0].torque_nm, *r.output_torque_nm, 1e-6 * *r.output_torque_nm);
  EXPECT_NEAR(wide.candidates[0].dimensions.face_width_mm, 15.0, 0.2);
  EXPECT_NEAR(wide.candidates[0].figures.length_mm, wide.candidates[0].dimensions.face_width_mm, 1e-9);
  r.face_width_max_mm = 11.0;
  r.module_max_mm = 2.0;
  const SetResult large = optimise_set(r, plain.set);
  ASSERT_FALSE(large.candidates.empty());
  EXPECT_NEAR(large.candidates[0].torque_nm, *r.output_torque_nm, 1e-3 * *r.output_torque_nm);
  EXPECT_EQ(large.candidates[0].dimensions.face_width_mm, 11.0);
  EXPECT_GT(large.candidates[0].dimensions.module_mm, 1.1);
}

TEST(SearchFigures, WeightsRankByTheWeightedProduct) {
  SearchRequirements r = needs("simple");
  r.weights = {{SearchObjective::kForward, 1.0}, {SearchObjective::kMass, 0.5}};
  r.objectives = {SearchObjective::kWeighted};
  const Found found = first_of(r);
  EXPECT_NEAR(found.candidate.score,
              std::log(found.candidate.forward) - 0.5 * std::log(found.candidate.figures.mass_kg), 1e-12);
  SearchRequirements plain = r;
  plain.weights.clear();
  plain.objectives = {SearchObjective::kForward};
  const SearchCandidate efficient = optimise_set(plain, found.set).candidates.at(0);
  EXPECT_GE(found.candidate.score,
            std::log(efficient.forward) - 0.5 * std::log(efficient.figures.mass_kg) - 1e-9);
}

TEST(SearchFigures, HuntingAndSequenceFollowFromTheTeethAlone) {
  SearchRequirements r = needs("simple");
  r.ratio_min = 2;
  r.ratio_max = 10;
  const std::size_t all = enumerate_sets(r).sets.size();
  r.hunting = true;
  const auto hunting = enumerate_sets(r).sets;
  for (const ToothSet& set : hunting) {
    EXPECT_EQ(std::gcd(set.sun, set.planet1), 1);
    EXPECT_EQ(std::gcd(set.planet1, set.ring1), 1);
  }
  r.hunting = false;
  r.sequential = true;
  const auto sequential = enumerate_sets(r).sets;
  // the forces of the mesh frequency, each planet a phase of i z/N turns behind, cancel
  for (const ToothSet& set : sequential) {
    double cosine = 0.0;
    for (int i = 0; i < set.planets; ++i) cosine += std::cos(kTwoPi * i * set.ring1 / set.planets);
    EXPECT_NEAR(cosine, 0.0, 1e-9);
  }
  EXPECT_GT(hunting.size(), 0u);
  EXPECT_GT(sequential.size(), 0u);
  EXPECT_LT(hunting.size(), all);
  EXPECT_LT(sequential.size(), all);
}

TEST(SearchRelax, LimitsThatBindAreNamedAndRelaxingThemHelps) {
  SearchRequirements r = needs("3k");
  r.losses.reset();
  r.shift_max = 1.0;
  const Found found = first_of(r);
  const auto binding = binding_limits(r, found.set, found.candidate);
  ASSERT_FALSE(binding.empty());
  for (const BindingLimit& b : binding) {
    if (b.key.empty()) continue;
    EXPECT_GE(b.objective, found.candidate.forward) << b.key;
    // the same, said in the requirements
    if (b.key != "shift.max") continue;
    SearchRequirements wider = r;
    wider.shift_max = b.relaxed;
    double best = 0.0;
    for (const ToothSet& set : enumerate_sets(wider).sets)
      if (set.teeth() == found.set.teeth()) best = optimise_set(wider, set).candidates.at(0).forward;
    EXPECT_EQ(b.objective, best);
    EXPECT_EQ(b.relaxed, 1.1);
  }
}

TEST(SearchRelax, ARangeOfTeethThatEndsTooEarlyIsNamed) {
  SearchRequirements r = needs("3k");
  r.losses.reset();
  r.sun = {13, 14};
  r.ring1 = {60, 75};
  const SetEnumeration sets = enumerate_sets(r);
  const SearchReport report = conclude_search(r, sets, run_search(r, sets), {});
  ASSERT_FALSE(report.designs.empty());
  EXPECT_FALSE(report.designs[0].binding.empty());
  for (const BindingLimit& b : report.binding_ranges) {
    EXPECT_GT(b.objective, report.designs[0].candidate.forward) << b.key;
    EXPECT_NE(b.value, b.relaxed) << b.key;
  }
  EXPECT_FALSE(report.binding_ranges.empty());
}

TEST(SearchRelax, RangesOfGearsThatOnlyTheirKindHasAreNamedToo) {
  SearchRequirements r = needs("pair");
  r.losses.reset();
  r.ratio_min = 2.9, r.ratio_max = 3.1;
  r.sun = {12, 40};
  r.wheel = {30, 45};  // wheels of more teeth slide less
  const SetEnumeration sets = enumerate_sets(r);
  const SearchReport report = conclude_search(r, sets, run_search(r, sets), {});
  ASSERT_FALSE(report.designs.empty());
  ASSERT_EQ(report.designs[0].set.planet1, 45);
  const auto& found = report.binding_ranges;
  const auto wheel = std::find_if(found.begin(), found.end(), [](const BindingLimit& b) {
    return b.key == "teeth.wheel_max";
  });
  ASSERT_NE(wheel, found.end());
  // the same, said in the requirements
  r.wheel = {30, static_cast<int>(wheel->relaxed)};
  const SetEnumeration wider = enumerate_sets(r);
  const SearchReport really = conclude_search(r, wider, run_search(r, wider), {});
  EXPECT_NEAR(really.designs.at(0).candidate.forward, wheel->objective, 1e-6);
}

}  // namespace
}  // namespace trueflank
