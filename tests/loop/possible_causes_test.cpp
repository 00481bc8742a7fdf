// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/result/describe.h"

// What a cause may be depends on how the part was made; what no gear can have is not told.
namespace trueflank::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Process foot(double um, double height_mm) {
  return grown([=](auto&, auto&, const Vec3& p) { return um * std::exp(-p[2] / height_mm); });
}

loop::LoopResult close_made_by(const std::vector<std::string>& processes, const Process& hidden) {
  loop::MeasuredData data;
  data.scans.push_back(scan_of(spur(24), {hidden}, {}));
  data.processes = processes;
  return loop::close_loop(geometry_of(spur(24)), "gear", data, {.aligned = true})->result;
}

TEST(PossibleCauses, AGroundGearHasNoElephantFoot) {
  const auto ground = close_made_by({"grinding"}, foot(40, 0.5));
  ASSERT_EQ(ground.effects.size(), 1U) << list(ground);
  const auto& form = ground.effects[0];
  EXPECT_FALSE(form.named);
  EXPECT_EQ(form.id, "unnamed");
  EXPECT_TRUE(form.cause.empty());
  EXPECT_THAT(form.description, HasSubstr("lower face"));
  ASSERT_EQ(form.terms.size(), 1U);
  EXPECT_NEAR(form.terms[0].cos, 40.0, 3.0);
  EXPECT_EQ(ground.process, "grinding");
  EXPECT_THAT(ground.not_observable, Not(Contains("elephant_foot")));
}

TEST(PossibleCauses, APrintedOneHas) {
  const auto printed = close_made_by({"fdm-0.4"}, foot(40, 0.5));
  ASSERT_EQ(printed.effects.size(), 1U) << list(printed);
  EXPECT_EQ(printed.effects[0].id, "elephant_foot");
  EXPECT_THAT(printed.effects[0].cause, HasSubstr("first layers"));
  EXPECT_TRUE(printed.effects[0].by_process.empty());
}

TEST(PossibleCauses, WithoutAProcessTheFormIsNamedAndEveryCauseListed) {
  const auto open = close_made_by({}, twisted(-10));
  ASSERT_EQ(open.effects.size(), 1U) << list(open);
  EXPECT_EQ(open.effects[0].id, "helix_error");
  EXPECT_GE(open.effects[0].by_process.size(), 3U);
  EXPECT_THAT(open.effects[0].cause, HasSubstr("printing: twist of the print"));
  EXPECT_THAT(open.measure_next, Contains(HasSubstr("# process = ")));
  const auto ground = close_made_by({"grinding"}, twisted(-10));
  EXPECT_THAT(ground.effects[0].cause, Not(HasSubstr("print")));
  EXPECT_THAT(ground.measure_next, Not(Contains(HasSubstr("# process = "))));
}

TEST(PossibleCauses, AGroundGearHasNoLayerShiftAndItsStepIsNotCorrected) {
  const auto ground = close_made_by({"grinding"}, shifted_above(6.3, 15, -8));
  ASSERT_FALSE(ground.effects.empty());
  for (const auto& effect : ground.effects) EXPECT_NE(effect.id, "layer_shift") << list(ground);
  const auto correction = loop::Correction::make(loop_json(ground), geometry_of(spur(24)));
  ASSERT_TRUE(correction) << correction.error().message;
}

TEST(PossibleCauses, AFormWithoutCauseIsCorrectedAsTheNamedOneIs) {
  const auto geometry = geometry_of(spur(24));
  loop::LoopResult named = close_made_by({"fdm-0.4"}, foot(40, 0.5));
  loop::LoopResult form = close_made_by({"grinding"}, foot(40, 0.5));
  const auto a = loop::Correction::make(loop_json(named), geometry);
  const auto b = loop::Correction::make(loop_json(form), geometry);
  ASSERT_TRUE(a && b);
  const std::array<double, 3> point{12.0, 0.9, 0.2};
  const auto at_a = a->displacement_mm(point), at_b = b->displacement_mm(point);
  const auto size = std::hypot(at_a[0], at_a[1]);
  EXPECT_GT(size, 0.01);
  EXPECT_NEAR(std::hypot(at_a[0] - at_b[0], at_a[1] - at_b[1]), 0.0, 0.01 * size);
}

/// A loop.json with the one effect, five micrometres or hundredths of a percent of it.
std::string written_as_loop_json(const loop::EffectFamily& family, const std::string& flank,
                                 const loop::EffectShape& shape, const std::vector<double>& amounts) {
  loop::LoopResult result;
  result.gear = "gear";
  loop::FoundEffect found;
  found.id = family.named ? family.id : "unnamed";
  found.named = family.named;
  found.flank = flank;
  found.correctable = family.correctable == loop::Correctable::kGeometry;
  if (family.named) {
    for (std::size_t k = 0; k < shape.size(); ++k)
      found.parameters.push_back({family.shape_names[k], shape[k], kNaN, kNaN});
    const bool wave = family.form == loop::ParameterForm::kWave;
    const std::vector<double> told =
        wave ? std::vector{std::hypot(amounts[0], amounts[1]),
                           deg_from_rad(std::atan2(amounts[1], amounts[0])) / family.phase_divisor}
             : amounts;
    for (std::size_t k = 0; k < family.parameters.size(); ++k)
      found.parameters.push_back({family.parameters[k], told[k], kNaN, kNaN});
  } else {
    found.terms.push_back(loop::term_of(family, shape));
    found.terms.back().cos = amounts[0];
    if (family.columns(shape) == 2) found.terms.back().sin = amounts[1];
  }
  result.effects.push_back(std::move(found));
  return loop_json(result);
}

TEST(PossibleCauses, EveryFormIsCorrectedOnTheFlanksOfItsNameAlone) {
  const auto geometry = geometry_of(spur(24));
  for (const loop::EffectFamily& named : loop::effect_library()) {
    const loop::EffectFamily* form = loop::find_form(named.form_word);
    if (form == nullptr || named.correctable != loop::Correctable::kGeometry) continue;
    const std::vector<loop::EffectShape> shapes =
        named.shapes ? named.shapes(geometry) : std::vector<loop::EffectShape>{{}};
    const auto& shape = shapes[shapes.size() / 2];
    std::vector<std::string> flanks{"both"};
    if (named.one_flank_too) flanks.insert(flanks.end(), {"left", "right"});
    for (const std::string& flank : flanks) {
      const std::vector<double> amounts{0.05, 0.02, 0.01};
      const auto a =
          loop::Correction::make(written_as_loop_json(named, flank, shape, amounts), geometry);
      const auto b =
          loop::Correction::make(written_as_loop_json(*form, flank, shape, amounts), geometry);
      ASSERT_TRUE(a && b) << named.id << " " << flank;
      ASSERT_EQ(b->corrected().size(), 1U) << named.id << " " << flank;
      double moved_um = 0.0;
      for (const int side : {1, -1})
        for (const double height : {0.1, 0.8}) {
          const auto place = geometry.on_flank(
              3, side, 0.3 * geometry.root_form_roll_mm() + 0.7 * geometry.tip_form_roll_mm(),
              height * geometry.face_width_mm());
          const std::array<double, 3> point{place.radius_mm * std::cos(place.polar_rad),
                                            place.radius_mm * std::sin(place.polar_rad), place.z_mm};
          const auto by_name = a->displacement_mm(point), by_form = b->displacement_mm(point);
          for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(by_name[k], by_form[k], 1e-9) << named.id << " " << flank << " " << side;
          moved_um += um_from_mm(std::hypot(by_name[0], by_name[1]));
        }
      EXPECT_GT(moved_um, 1e-3) << named.id << " " << flank;
    }
  }
}

TEST(PossibleCauses, TheDataAreBelievedAndAnUnknownProcessIsSaid) {
  loop::MeasuredData data;
  data.scans.push_back(scan_of(spur(24), {foot(40, 0.5)}, {}));
  data.processes = {"grinding"};
  const auto fdm = *ProcessTable().find("fdm-0.4");
  const auto told =
      loop::close_loop(geometry_of(spur(24)), "gear", data, {.aligned = true, .process = fdm})->result;
  EXPECT_EQ(find(told, "elephant_foot"), nullptr) << list(told);
  EXPECT_THAT(told.notes, Contains(HasSubstr("the data are believed")));
  data.processes = {"magic"};
  const auto magic = loop::close_loop(geometry_of(spur(24)), "gear", data, {.aligned = true})->result;
  EXPECT_NE(find(magic, "elephant_foot"), nullptr) << list(magic);
  EXPECT_THAT(magic.notes, Contains(HasSubstr("\"magic\"")));
}

TEST(PossibleCauses, RunoutAloneIsEccentricityFirst) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const MadeGear made = spur(40);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.8);
    loop::InspectionData runout;
    for (int tooth = 1; tooth <= made.teeth; ++tooth) {
      loop::InspectionRow row;
      row.record = loop::RecordKind::kRadial;
      row.tooth = tooth;
      // The ball sits half a pitch behind the tooth.
      const double angle = 2.0 * M_PI * (tooth - 0.5) / made.teeth;
      row.deviation_um = 18.0 * std::cos(angle - 1.9) + noise(random);
      runout.rows.push_back(row);
    }
    const auto result = close(made, runout);
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_EQ(result.effects[0].id, "eccentricity") << list(result);
    EXPECT_NEAR(parameter(result.effects[0], "amplitude_um").value, 18.0, 1.0);
    EXPECT_NEAR(parameter(result.effects[0], "phase_deg").value, 1.9 * 180.0 / M_PI, 4.0);
    EXPECT_THAT(result.effects[0].confounded_with, Contains("pitch_wave")) << list(result);
  }
}

TEST(PossibleCauses, NoEffectMovesAFlankByMoreThanHalfAModule) {
  // A groove over every flank at one height: no effect of the library has its form.
  for (unsigned seed = 1; seed <= survey_size(1U, 3U); ++seed) {
    const MadeGear made = spur(24);
    ScanOptions options;
    options.seed = seed;
    options.noise_um = 0.6;
    const Process groove = grown([](auto&, const FlankSpot& s, auto&) {
      const double t = (s.v + 0.55) / 0.06;
      return -12.0 * std::exp(-t * t);
    });
    const auto result = close(made, scan_of(made, {groove}, options), true);
    for (const auto& effect : result.effects) {
      for (const auto& p : effect.parameters) {
        if (!p.name.ends_with("_um")) continue;
        EXPECT_LT(std::abs(p.value), 100.0) << effect.id << ": " << list(result);
      }
      for (const auto& term : effect.terms) EXPECT_LT(term.amplitude(), 100.0) << list(result);
    }
  }
}

TEST(PossibleCauses, WhatToDoFollowsTheProcess) {
  const Process tapered = grown([](auto&, const FlankSpot& s, auto&) { return 20.0 * s.v; });
  const std::vector<std::pair<std::string, std::string>> first_actions{
      {"grinding", "set tailstock or axis slope"},
      {"fdm", "taper the model the other way"},
      {"moulding", "correct the draft of mould or die"},
      {"wire-edm", "set the taper compensation"}};
  for (const auto& [process, action] : first_actions) {
    const auto result = close_made_by({process}, tapered);
    ASSERT_NE(find(result, "taper"), nullptr) << list(result);
    const std::string& sentence = find(result, "taper")->sentence;
    EXPECT_THAT(sentence, HasSubstr(action)) << process;
    for (const auto& [other, foreign] : first_actions)
      if (other != process) {
        EXPECT_THAT(sentence, Not(HasSubstr(foreign))) << process;
      }
  }
}

/// No way of making is without a first action of its own where the others have one.
TEST(PossibleCauses, EveryProcessHasAnAction) {
  for (const loop::EffectFamily& family : loop::effect_library())
    for (unsigned bit = 1; !family.corrections.empty() && bit < loop::kAnyMaking; bit <<= 1U)
      if (loop::can_have(bit, family)) {
        EXPECT_EQ(std::count_if(family.corrections.begin(), family.corrections.end(),
                                [&](const auto& one) { return (one.makings & bit) != 0; }),
                  1)
            << family.id << " " << loop::making_text(bit);
      }
}

TEST(PossibleCauses, NamesOfProcessesSayHowAPartIsMade) {
  using namespace loop;
  EXPECT_EQ(making_named("fdm-0.4"), kExtrusion);
  EXPECT_EQ(making_named("cnc-hobbing"), kHobbing);
  EXPECT_EQ(making_named("Profile Grinding"), kGrinding);
  EXPECT_EQ(making_named("wire-edm"), kWireCutting);
  EXPECT_EQ(making_named("injection moulding"), kMoulding);
  EXPECT_EQ(making_named("magic"), std::nullopt);
  trueflank::Process own{.name = "my printer", .layer_mm = 0.2};
  EXPECT_EQ(making_of(own), kPrinting);
  const ProcessTable table;
  for (const auto& process : table.all()) EXPECT_TRUE(making_of(process)) << process.name;
}

}  // namespace
}  // namespace trueflank::test
