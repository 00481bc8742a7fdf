// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/loop/result/describe.h"

// What people read of an effect: one sentence, shares that add up, how sure it is.
namespace trueflank::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

double sum_of_shares(const loop::LoopResult& result) {
  double sum = 0.0;
  for (const auto& effect : result.effects) sum += effect.explained_fraction;
  return sum;
}

double explained(const loop::LoopResult& result) {
  return 1.0 - std::pow(result.after.rms / result.before.rms, 2);
}

TEST(ToldEffects, ASentenceSaysWhatIsWrongWhatFollowsAndWhatToDo) {
  const auto off = close(spur(24), scan_of(spur(24), {off_centre(18, 108)}, {}), true);
  ASSERT_EQ(off.effects.size(), 1U) << list(off);
  EXPECT_THAT(off.effects[0].sentence,
              MatchesRegex("The teeth stand 1[78][.0-9]* um off the bore towards 10[789] deg: runout 3[567][.0-9]* um; "
                           "true the part on its pitch circle or re-bore"));
  const auto thick = close(spur(24), scan_of(spur(24), {scaled(0.3)}, {}), true);
  ASSERT_EQ(thick.effects.size(), 1U);
  EXPECT_THAT(thick.effects[0].sentence, MatchesRegex("The whole part is 0.[23][.0-9]* % too big: its tip diameter is off by 7[78].*"));
  // Text and page begin with it.
  EXPECT_THAT(loop_text(off), HasSubstr("\n  The teeth stand"));
  EXPECT_THAT(loop_text(off), HasSubstr("amplitude 1"));
  EXPECT_THAT(loop_json(off), HasSubstr("\"sentence\": \"The teeth stand"));
}

TEST(ToldEffects, AGainThatIsNothingIsNotPrinted) {
  loop::LoopResult result;
  result.after.held_out_rms = 0.64;
  result.effects.push_back({.id = "single_tooth", .explained_fraction = 0.05});
  const auto text_with = [&](double gain) {
    result.effects[0].held_out_gain = gain;
    return loop_text(result);
  };
  for (const double nothing : {0.0, -0.0146, 0.001})
    EXPECT_THAT(text_with(nothing), Not(HasSubstr("held-out error is"))) << nothing;
  EXPECT_THAT(text_with(0.3), HasSubstr("without it the held-out error is 0.3 um larger"));
  EXPECT_THAT(text_with(-0.3), HasSubstr("without it the held-out error is 0.3 um smaller"));
}

// The words of what is left and its probability are one answer.
TEST(ToldEffects, SizesThatAgreeWithinTheirErrorsLeaveNothingByTheirProbabilityToo) {
  const auto geometry = geometry_of(spur(24));
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> error_mm(0.0, 0.002);
    const double thinner_mm = std::uniform_real_distribution<double>(0.03, 0.08)(random);
    loop::SizeData sizes;
    for (const int teeth : {3, 4})
      sizes.rows.push_back({loop::SizeQuantity::kSpan,
                            trueflank::base_tangent_length_mm(geometry.gear(), teeth) -
                                thinner_mm * std::cos(geometry.pressure_angle_rad()) +
                                error_mm(random),
                            double(teeth), 2.0});
    for (const auto& [size, mm] :
         {std::pair{loop::SizeQuantity::kTipDiameter, 2.0 * geometry.tip_radius_mm()},
          std::pair{loop::SizeQuantity::kRootDiameter, 2.0 * geometry.root_radius_mm()}})
      sizes.rows.push_back({size, mm + error_mm(random), kNaN, 2.0});
    loop::MeasuredData data;
    data.sizes.push_back(sizes);
    const auto result = loop::close_loop(geometry, "gear", data, {})->result;
    if (result.structure_left.find("nothing beyond") == std::string::npos) continue;
    EXPECT_GT(result.structure_left_p_value, 0.01) << seed << ": " << list(result);
  }
}

// Of waves on some teeth only those that were traced are known.
TEST(ToldEffects, OfTeethThatWereNotTracedNothingIsSaid) {
  unsigned said = 0;
  const unsigned all = survey_size(2U, 4U);
  for (unsigned seed = 1; seed <= all; ++seed) {
    std::mt19937_64 random(seed);
    const int first = 2 * std::uniform_int_distribution<int>(5, 7)(random);
    const double per_face = std::uniform_real_distribution<double>(4.0, 6.0)(random);
    const auto waves = grown([=](auto&, const FlankSpot& s, auto&) {
      return s.tooth >= first && s.tooth < first + 10 ? 6.0 * std::cos(M_PI * per_face * s.v) : 0.0;
    });
    std::vector<int> every_other;
    std::string theirs;
    for (int tooth = 2; tooth <= 30; tooth += 2) {
      every_other.push_back(tooth);
      if (tooth >= first && tooth < first + 10)
        theirs += (tooth == first           ? ""
                   : tooth + 2 < first + 10 ? ", "
                                            : " and ") +
                  std::to_string(tooth);
    }
    const auto result =
        close(spur(30), inspection_of(spur(30), {waves}, traced(every_other, 0.5, seed)));
    for (const auto& effect : result.effects)
      if (effect.sentence.find(" teeth from tooth ") != std::string::npos) {
        ++said;
        EXPECT_NE(effect.sentence.find("; of these teeth " + theirs + " were traced"),
                  std::string::npos)
            << effect.sentence;
      }
    EXPECT_FALSE(result.effects.empty()) << list(result);
  }
  EXPECT_GE(4 * said, 2 * all);
}

TEST(ToldEffects, EveryNamedEffectHasASentenceOfItsOwn) {
  const auto geometry = geometry_of(spur(24));
  for (const auto& family : loop::effect_library()) {
    if (!family.named) continue;
    ASSERT_TRUE(family.sentence) << family.id;
    loop::FoundEffect found{.id = family.id};
    for (const auto& name : family.shape_names) found.parameters.push_back({name, 3.0, 3.0, 3.0});
    for (const auto& name : family.parameters) found.parameters.push_back({name, 12.5, 12.0, 13.0});
    const std::string sentence = family.sentence(geometry, found);
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(sentence.front())) ||
                std::isdigit(static_cast<unsigned char>(sentence.front()))) << sentence;
    EXPECT_THAT(sentence, HasSubstr(":")) << family.id << ": no consequence";
    EXPECT_EQ(sentence.find("nan"), std::string::npos) << family.id << ": " << sentence;
    EXPECT_FALSE(loop::first_action(family.correction).empty()) << family.id;
  }
}

TEST(ToldEffects, AWaveOfAsManyPeriodsAsTeethMayBeTheTools) {
  const auto geometry = geometry_of(spur(24));
  const auto sentence = [&](double order) {
    return loop::find_family("ghost_order")
        ->sentence(geometry,
                   {.id = "ghost_order",
                    .parameters = {{"amplitude_um", 2.0}, {"phase_deg", 10.0}, {"order", order}}});
  };
  for (const double order : {24.0, 48.0})
    EXPECT_THAT(sentence(order), HasSubstr("the same on every tooth")) << order;
  for (const double order : {12.0, 25.0, 36.0})
    EXPECT_THAT(sentence(order), HasSubstr("the gear whines at that order")) << order;
}

TEST(ToldEffects, SharesAddUpToWhatTheWholeFitExplains) {
  const auto relief = grown([](auto&, const FlankSpot& s, auto&) {
    return s.u > 0.3 ? -20.0 * std::pow((s.u - 0.3) / 0.7, 2) : 0.0;
  });
  const std::vector<std::vector<Process>> sets{
      {off_centre(20, 30), relief},
      {scaled(0.2), out_of_round(3, 15, 50), twisted(9)},
      {indexed(3, 10, 40), off_centre(12, -80), relief, twisted(-8)}};
  for (const auto& set : sets) {
    if (!is_surveyed(&set != &sets.back())) continue;
    const auto result = close(spur(24), scan_of(spur(24), set, {}), true);
    ASSERT_GE(result.effects.size(), 2U) << list(result);
    EXPECT_NEAR(sum_of_shares(result), explained(result), 1e-9) << list(result);
    for (const auto& effect : result.effects) EXPECT_GT(effect.explained_fraction, 0.005) << effect.id;
  }
}

TEST(ToldEffects, ASmallEffectBesideALargeOneOfItsKindHasASmallShare) {
  // Thin teeth by themselves would take up what the relief takes off on the whole.
  const auto relief = grown([](auto&, const FlankSpot& s, auto&) {
    return s.u > 0.3 ? -20.0 * std::pow((s.u - 0.3) / 0.7, 2) : 0.0;
  });
  const auto thin = grown([](auto&, const FlankSpot&, auto&) { return -2.0; });
  const auto result =
      close(spur(24), scan_of(spur(24), {relief, thin}, scanned(1500, 1.0, 5)), true);
  ASSERT_EQ(result.effects.size(), 2U) << list(result);
  const auto& small = result.effects[result.effects[0].id == "tip_relief" ? 1 : 0];
  // Both take off the same side, so that each explains a little more than it does alone.
  EXPECT_NEAR(small.explained_fraction, 4.0 / std::pow(result.before.rms, 2), 0.08)
      << small.sentence;
  EXPECT_NEAR(sum_of_shares(result), explained(result), 1e-9);
}

TEST(ToldEffects, SizesCountAndExplainWhatTheyExplain) {
  loop::MeasuredData data;
  loop::SizeData sizes;
  const auto geometry = geometry_of(spur(24));
  for (const int teeth : {3, 4})
    sizes.rows.push_back({loop::SizeQuantity::kSpan,
                          trueflank::base_tangent_length_mm(geometry.gear(), teeth) + 0.044 * std::cos(geometry.pressure_angle_rad()),
                          double(teeth), 2.0});
  sizes.rows.push_back({loop::SizeQuantity::kTipDiameter, 2.0 * geometry.tip_radius_mm(), kNaN, 2.0});
  data.sizes.push_back(sizes);
  const auto result = loop::close_loop(geometry, "gear", data, {})->result;
  EXPECT_EQ(result.observations, 3);
  ASSERT_EQ(result.effects.size(), 1U) << list(result);
  EXPECT_EQ(result.effects[0].id, "tooth_thickness");
  EXPECT_NEAR(parameter(result.effects[0], "amount_um").value, 44.0, 2.0);
  EXPECT_GT(result.effects[0].explained_fraction, 0.95);
  EXPECT_GT(result.before.rms, 30.0);
}

TEST(ToldEffects, UnnamedEffectsCarryTerms) {
  const auto one_flank = grown([](auto&, const FlankSpot& s, auto&) {
    return s.tooth == 7 && s.side > 0 ? 15.0 : 0.0;
  });
  const auto saddle = grown([](const MadeGear& g, const FlankSpot& s, auto&) {
    return 12.0 * std::cos(5.0 * 2.0 * M_PI * (s.tooth - 1) / g.teeth) * s.u * s.v;
  });
  for (const auto& hidden : {one_flank, saddle}) {
    const auto result = close(spur(24), scan_of(spur(24), {hidden}, {}), true);
    ASSERT_FALSE(result.effects.empty());
    for (const auto& effect : result.effects) {
      if (effect.named) continue;
      ASSERT_FALSE(effect.terms.empty()) << list(result);
      EXPECT_FALSE(effect.terms[0].keys.empty());
      EXPECT_THAT(effect.sentence, HasSubstr("without a known cause"));
    }
  }
}

TEST(ToldEffects, ATwoFlankToothIsOneEffectInRunoutAndIndex) {
  // A ball in the two gaps beside the tooth, and the index of both flanks, as small sets of records have them.
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const MadeGear made = spur(37);
    InspectionOptions options;
    options.profile = options.helix = false;
    options.noise_um = 0.7;
    options.seed = seed;
    const auto proud = grown([](auto&, const FlankSpot& s, auto&) { return s.tooth == 8 ? 18.0 : 0.0; });
    const auto result = close(made, inspection_of(made, {proud}, options));
    ASSERT_EQ(result.effects.size(), 1U) << list(result);
    EXPECT_EQ(result.effects[0].id, "single_tooth") << list(result);
    EXPECT_NEAR(parameter(result.effects[0], "amount_um").value, 18.0, 1.5);
    EXPECT_EQ(result.effects[0].flank, "both");
  }
}

TEST(ToldEffects, AMeasurementThatTellsIsSaidOnce) {
  std::vector<loop::FoundEffect> effects(3);
  effects[0] = {.id = "pitch_wave", .confounded_with = {"lobing", "eccentricity"}};
  effects[1] = {.id = "lobing", .confounded_with = {"pitch_wave"}};
  effects[2] = {.id = "eccentricity", .confounded_with = {"pitch_wave"}};
  loop::ToldApart told;
  for (const auto& e : effects)
    for (const auto& other : e.confounded_with) told.add(e.id, other, "both flanks");
  std::vector<std::string> sentences;
  told.say(sentences, "measure");
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences[0], "measure both flanks: it distinguishes pitch_wave from lobing, pitch_wave from eccentricity, which "
                          "these data cannot");
}

TEST(Shares, FollowTheSquaresOfWhatEffectsAdd) {
  std::vector<loop::FoundEffect> effects(3);
  loop::share_out(effects, {1.0, 4.0, 3.0}, 0.96);
  EXPECT_NEAR(effects[0].explained_fraction, 0.12, 1e-12);
  EXPECT_NEAR(effects[1].explained_fraction, 0.48, 1e-12);
  EXPECT_NEAR(effects[2].explained_fraction, 0.36, 1e-12);
}

TEST(Sureness, TheWordsHoldABoundOfTheProbability) {
  for (double p = 1e-7; p < 1.0; p *= 1.3) {
    const std::string words = loop::sure_words(p, {});
    const auto at = words.find("once in ");
    if (at == std::string::npos) {
      EXPECT_GE(p, 0.2 - 1e-9) << words;
      EXPECT_THAT(words, HasSubstr("a guess"));
      continue;
    }
    const double sets = std::stod(words.substr(at + 8));
    EXPECT_LT(p * sets, 1.0) << words;             // never more than was found
    EXPECT_GT(p * sets, sets >= 1e6 ? 0.0 : 0.009) << words;  // nor much less
    EXPECT_EQ(words.starts_with("as good as certain"), sets >= 500.0) << words;
    EXPECT_EQ(words.starts_with("sure"), sets >= 50.0 && sets < 500.0) << words;
  }
  EXPECT_THAT(loop::sure_words(0.001, {"pitch_wave"}), HasSubstr("the name is open: pitch wave"));
}

TEST(Units, AreWords) {
  EXPECT_EQ(loop::name_and_unit("centre_diameter_mm"), std::pair(std::string("centre diameter"), std::string("mm")));
  EXPECT_EQ(loop::name_and_unit("slope_um_per_mm").second, "um per mm");
  EXPECT_EQ(loop::name_and_unit("nm_per_rpm").second, "N m per rpm");
  EXPECT_EQ(loop::name_and_unit("nm_at_1000_rpm"),
            std::pair(std::string("amount"), std::string("N m at 1000 rpm")));
  EXPECT_EQ(loop::name_and_unit("percent"), std::pair(std::string("amount"), std::string("percent")));
  EXPECT_EQ(loop::name_and_unit("order"), std::pair(std::string("order"), std::string()));
}

TEST(Rows, ASingleBadRowIsLeftOutAndNamed) {
  const MadeGear made = spur(24);
  auto inspection = inspection_of(made, {}, {});
  inspection.file = "rows.csv";
  inspection.rows[20].tooth = 99;
  inspection.rows[20].line = 22;
  const auto result = close(made, inspection);
  EXPECT_THAT(result.notes, Contains("rows.csv:22: left out: tooth 99 of a gear with 24 teeth"));
}

TEST(Rows, AFileOfAnotherGearIsRefused) {
  const MadeGear made = spur(24);
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(made, {}, {}));
  data.inspections[0].file = "other.csv";
  int line = 2;
  for (auto& row : data.inspections[0].rows) {
    row.line = line++;
    if (row.tooth > 20) row.tooth += 40;
  }
  const auto refused = loop::close_loop(geometry_of(made), "gear", data, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].file, "other.csv");
  EXPECT_GT(refused.error()[0].line, 0);
  EXPECT_THAT(refused.error()[0].message, HasSubstr("rows cannot belong to this gear: tooth 61 of a gear with 24 teeth"));
  EXPECT_FALSE(refused.error()[0].remedy.empty());
  // A bigger gear's diameters.
  data.inspections[0] = inspection_of(spur(40), {}, {});
  const auto bigger = loop::close_loop(geometry_of(made), "gear", data, {});
  ASSERT_FALSE(bigger);
  EXPECT_THAT(bigger.error()[0].message, HasSubstr("cannot belong to this gear"));
}

}  // namespace
}  // namespace trueflank::test
