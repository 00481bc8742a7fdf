// SPDX-License-Identifier: GPL-3.0-or-later
//
// make --correct with amounts that no gear can have: refused by the geometry, or made within the
// tolerance.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "pair_design.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/survey_size.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/session/make.h"
#include "trueflank/solid/measure/solid_fault.h"

namespace trueflank {
namespace {

namespace fs = std::filesystem;

/// An effect of a loop.json, every parameter and every value of its shape the same number.
std::string effect_json(const loop::EffectFamily& family, double amount, double shape) {
  const auto number = [](double value) {
    std::ostringstream text;
    text << std::setprecision(17) << value;
    return text.str();
  };
  if (!family.named && !family.term_keys.empty()) {
    std::string term;
    for (const loop::TermKey& key : family.term_keys)
      term +=
          "\"" + key.name + "\": " +
          (key.kind == loop::TermKey::Kind::kWord ? "\"" + key.words[1] + "\"" : number(shape)) +
          ", ";
    for (const std::string& name : family.parameters)
      term += "\"" + name + "\": " + number(amount) + ", ";
    return "{\"id\": \"" + family.id + "\", \"terms\": [{" + term + "\"x\": 0}]}";
  }
  std::string parameters;
  for (const std::string& name : family.parameters)
    parameters +=
        "\"" + name + "\": {\"value\": " + number(name == "phase_deg" ? 30.0 : amount) + "}, ";
  for (const std::string& name : family.shape_names)
    parameters += "\"" + name + "\": {\"value\": " + number(shape) + "}, ";
  return "{\"id\": \"" + family.id + "\", \"parameters\": {" + parameters +
         "\"x\": {\"value\": 0}}}";
}

class CorrectedMake : public testing::Test {
 protected:
  ResultAll<MakeResult> make(const std::string& effects, double tolerance_um = 20.0) {
    const std::string file = (folder_ / "loop.json").string();
    std::ofstream(file)
        << R"({"format": "trueflank-loop", "version": 1, "gear": "pinion", "effects": [)" << effects
        << "]}";
    fs::remove_all(folder_ / "out");
    return make_parts(gearbox_, {.folder = folder_ / "out",
                                 .formats = {"stl"},
                                 .tolerance_um = tolerance_um,
                                 .part = "pinion",
                                 .correct = file});
  }
  [[nodiscard]] bool written() const { return fs::exists(folder_ / "out" / "pinion.stl"); }

  void expect_refused(const loop::EffectFamily& family, double amount, double shape) {
    const auto made = make(effect_json(family, amount, shape));
    ASSERT_FALSE(made) << family.id << " " << amount;
    const Error& error = made.error().front();
    EXPECT_EQ(exit_code(error.code), 2) << error.message;
    EXPECT_NE((error.message + error.key).find(family.id), std::string::npos)
        << error.message << error.key;
    EXPECT_FALSE(error.file.empty());
    EXPECT_FALSE(written()) << family.id << " " << amount;
  }

  Gearbox gearbox_ = Gearbox::read_text(pair_design(), "pair.toml").value();
  test::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

const loop::EffectFamily& family(const std::string& id) { return *loop::find_family(id); }

TEST_F(CorrectedMake, RefusesWhatTheTeethCannotHoldAndNamesIt) {
  const struct {
    const char* id;
    double amount, shape;
  } cases[] = {{"scale", 100.0, 0.0},
               {"scale", 200.0, 0.0},
               {"scale", -99.0, 0.0},
               {"scale", 1e12, 0.0},
               {"contour_offset", 1e5, 0.0},
               {"contour_offset", 1e308, 0.0},
               {"contour_offset", -800, 0.0},
               {"lobing", 1e12, 3.0},
               {"lobing", 1.0, 1e6},
               {"tooth_thickness", 1600.0, 0.0},
               {"tooth_thickness", -1600, 0},
               {"eccentricity", 20000.0, 0.0},
               {"elephant_foot", 3000.0, .3},
               {"elephant_foot", 1e12, 0.3},
               {"elephant_foot", 100, 1e-9},
               {"tip_relief", 2000.0, 21.0},
               {"pressure_angle_error", 1e5, 0.0},
               {"helix_error", 1e6, 0.0},
               {"axis_tilt", 1e5, 0.0},
               {"pitch_wave", 1e4, 2.0}};
  for (const auto& [id, amount, shape] : cases) expect_refused(family(id), amount, shape);
}

TEST_F(CorrectedMake, WritesWhatProcessesRepeat) {
  const struct {
    const char* id;
    double amount, shape;
  } cases[] = {
      {"scale", 2.0, 0.0},          {"scale", -20.0, 0.0},        {"contour_offset", 80.0, 0.0},
      {"lobing", 50.0, 3.0},        {"tooth_thickness", 200, 0},  {"tooth_thickness", -200, 0},
      {"eccentricity", 300.0, 0.0}, {"elephant_foot", 150.0, .3}, {"tip_relief", 40.0, 21.0},
      {"pitch_wave", 60.0, 2.0},    {"axis_tilt", 20.0, 0.0}};
  for (const auto& [id, amount, shape] : cases) {
    const auto made = make(effect_json(family(id), amount, shape));
    ASSERT_TRUE(made) << id << ": " << made.error().front().message;
    EXPECT_FALSE(made->failed) << id;
    const auto mesh = io::read_mesh(folder_ / "out" / "pinion.stl");
    ASSERT_TRUE(mesh) << id;
    EXPECT_EQ(solid_fault(*mesh), SolidFault::kNone) << id;
    EXPECT_LE(made->report.files.front().accuracy_um, 20.0) << id;
  }
}

TEST_F(CorrectedMake, AFootOfAnEighthOfTheModuleKeepsAFineTolerance) {
  // Between two flanks that move towards each other a displacement changes so fast that the way back from the mesh
  // to the design takes many steps.
  const auto made = make(effect_json(family("elephant_foot"), 120.0, 0.3), 5.0);
  ASSERT_TRUE(made) << made.error().front().message;
  EXPECT_FALSE(made->failed) << made->report.files.front().accuracy_um;
  EXPECT_LE(made->report.files.front().accuracy_um, 5.0);
}

#ifdef __SANITIZE_ADDRESS__
constexpr double kLongest_s = 100.0;  // a program with sanitizers takes some five times as long
#else
constexpr double kLongest_s = 20.0;
#endif

TEST_F(CorrectedMake, OfEveryEffectWithEverySizeNothingWrongIsWritten) {
  int made_it = 0, refused = 0;
  unsigned number = 0;  // (the gate tries every third, of every amount another shape)
  for (const loop::EffectFamily& family : loop::effect_library())
    for (const double amount : {-30.0, 700.0, -1e308}) {
      ++number;
      for (const double shape : {2.0, -3.0, 1e9}) {
        if (!test::is_surveyed(number++ % 3 == 0)) continue;
        const auto begin = std::chrono::steady_clock::now();
        const auto made = make(effect_json(family, amount, shape));
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        EXPECT_LT(took.count(), kLongest_s) << family.id << " " << amount << " " << shape;
        if (!made) {
          ++refused;
          EXPECT_EQ(exit_code(made.error().front().code), 2) << made.error().front().message;
          EXPECT_FALSE(written()) << family.id << " " << amount << " " << shape;
          continue;
        }
        EXPECT_EQ(written(), !made->failed);
        if (made->failed) continue;
        ++made_it;
        const auto mesh = io::read_mesh(folder_ / "out" / "pinion.stl");
        ASSERT_TRUE(mesh);
        EXPECT_TRUE(solid_fault(*mesh) == SolidFault::kNone)
            << family.id << " " << amount << " " << shape;
        if (family.shape_names.empty()) break;
      }
    }
  EXPECT_GT(made_it * test::survey_size(3, 1), 10);
  EXPECT_GT(refused * test::survey_size(3, 1), 40);
}

TEST_F(CorrectedMake, SeveralEffectsAreBoundedTogether) {
  const std::string one = effect_json(family("tooth_thickness"), 300.0, 0.0);
  const auto alone = make(one);
  ASSERT_TRUE(alone) << alone.error().front().message;
  const auto both = make(one + ", " + effect_json(family("contour_offset"), 150.0, 0.0));
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().front().message.find("with the other effects"), std::string::npos);
}

TEST_F(CorrectedMake, TeethThatWouldCutIntoTheBoreAreRefused) {
  const std::string design = pair_design();
  const auto at = design.find("[wheel]");
  gearbox_ =
      Gearbox::read_text(design.substr(0, at) + "bore_mm = 16.9\n" + design.substr(at), "pair.toml")
          .value();
  EXPECT_TRUE(make(effect_json(family("eccentricity"), 100.0, 0.0)));
  const auto made = make(effect_json(family("eccentricity"), 600.0, 0.0));
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().front().message.find("cut into a bore"), std::string::npos)
      << made.error().front().message;
}

TEST_F(CorrectedMake, AWaveThatDoesNotCloseAroundTheGearIsRefused) {
  for (const char* id : {"lobing", "pitch_wave", "ghost_order"}) {
    expect_refused(family(id), 5.0, 2.5);
    EXPECT_TRUE(make(effect_json(family(id), 1.0, 3.0))) << id;
  }
  for (const char* form : {"wave_of_radius", "wave_of_pitch"}) {
    const auto term = [&](const char* order) {
      return R"({"id": "unnamed", "terms": [{"form": ")" + std::string(form) + R"(", "order": )" + order +
             R"(, "cos_um": 5, "sin_um": 0}]})";
    };
    EXPECT_FALSE(make(term("2.5"))) << form;
    EXPECT_TRUE(make(term("3"))) << form;
  }
}

TEST_F(CorrectedMake, AFormWithoutANameIsCalledAsItsTermCallsIt) {
  const auto refused =
      make(R"({"id": "unnamed", "terms": [{"form": "bow_over_face", "cos_um": 5000}]})");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().front().message.find("unnamed (bow_over_face)"), std::string::npos)
      << refused.error().front().message;
  const auto left = make(
      R"({"id": "unnamed", "terms": [{"form": "sideways_step_over_height", "height_mm": 3, "cos_um": 5, "sin_um": 0}]},
         {"id": "unnamed", "description": "a form", "terms": []})");
  ASSERT_TRUE(left) << left.error().front().message;
  EXPECT_EQ(left->notes.find("corrected on"), std::string::npos) << left->notes;
  EXPECT_NE(left->notes.find("a form"), std::string::npos) << left->notes;
}

TEST_F(CorrectedMake, WhatIsLeftIsToldInTheWordsOfTheLoopWithoutControlCodes) {
  const auto made = make(
      R"({"id": "unnamed", "correctable": false, "description": "a rise\u001b[8m of\nboth ends"},
         {"id": "mine\u001b[31m", "form": {"a_um": "u"}, "parameters": {"a_um": {"value": 1}}})");
  ASSERT_TRUE(made) << made.error().front().message;
  EXPECT_NE(made->notes.find("a rise [8m of both ends: described only"), std::string::npos)
      << made->notes;
  EXPECT_EQ(made->notes.find('\033'), std::string::npos);
}

TEST_F(CorrectedMake, AFormulaWithAPoleBetweenThePlacesLookedAtIsRefused) {
  for (const char* formula : {"tan(pi * (u + 0.123) / 2)", "1 / (u - 0.33)", "1 / (u - 0.33)^2", "tan(pi * (v + 0.123) / 2)",
                              "u / (v - 0.4)^2"}) {
    const auto made = make(std::string(R"({"id": "mine", "form": {"a_um": ")") + formula +
                           R"("}, "parameters": {"a_um": {"value": 0.3}}})");
    ASSERT_FALSE(made) << formula;
    EXPECT_EQ(exit_code(made.error().front().code), 2) << formula << made.error().front().message;
    EXPECT_FALSE(written());
  }
  for (const char* formula : {"u * v", "step(v - 0.31)", "sin(3 * theta) * (1 - u^2)"})
    EXPECT_TRUE(make(std::string(R"({"id": "mine", "form": {"a_um": ")") + formula +
                     R"("}, "parameters": {"a_um": {"value": 3}}})"))
        << formula;
}

/// An effect of a user with one formula.
std::string declared_json(const std::string& id, const std::string& formula, double amount) {
  return "{\"id\": \"" + id + "\", \"form\": {\"a_um\": \"" + formula +
         "\"}, \"parameters\": {\"a_um\": {\"value\": " + std::to_string(amount) + "}}}";
}

TEST_F(CorrectedMake, ShortWavesAreMadeWithinTheTolerance) {
  const auto made = make(declared_json("ripple", "sin(50 * v)", 3.0), 2.0);
  ASSERT_TRUE(made) << made.error().front().message;
  EXPECT_FALSE(made->failed);
  EXPECT_TRUE(written());
}

TEST_F(CorrectedMake, WavesThatNoMeshFollowsAreRefusedBeforeTheyAreBegun) {
  const std::string both = declared_json("along", "sin(3e4 * v)", 2.0) + ", " +
                           declared_json("across", "cos(300 * u) * sin(3e4 * v)", 2.0);
  for (const std::string& effects :
       test::survey_of(2, {declared_json("grain", "sin(300 * u) * cos(1e4 * v)", 3.0), both,
                           declared_json("ripple", "sin(1e6 * v)", 3.0),
                           declared_json("stairs", "step(sin(1e5 * v + theta))", 6.0)})) {
    const auto begin = std::chrono::steady_clock::now();
    const auto made = make(effects, 2.0);
    ASSERT_FALSE(made) << effects;
    const Error& error = made.error().front();
    EXPECT_EQ(exit_code(error.code), 2) << error.message;
    EXPECT_EQ(error.key, "--tolerance-um") << error.message;
    EXPECT_FALSE(written()) << effects;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << effects;
    const double would_do_um = std::stod(error.remedy);
    EXPECT_GT(would_do_um, 2.0) << error.remedy;
    EXPECT_LT(would_do_um, 12.0) << error.remedy;  // twice the height of the highest
    const auto at_named = make(effects, would_do_um);
    ASSERT_TRUE(at_named) << effects << " " << error.remedy;
    EXPECT_FALSE(at_named->failed) << effects << " " << error.remedy;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(120)) << effects;
  }
}

TEST_F(CorrectedMake, MoreComputingThanAnyMeshHasTimeForIsRefused) {
  std::string sum = "u", effects;
  for (int i = 0; i < 500; ++i) sum += " + sin(v)";
  for (int i = 0; i < 40; ++i)
    effects += (i > 0 ? ", " : "") + declared_json("e" + std::to_string(i), sum, 0.001);
  const auto made = make(effects);
  ASSERT_FALSE(made);
  EXPECT_EQ(exit_code(made.error().front().code), 2);
  EXPECT_EQ(made.error().front().key, "effects");
}

TEST_F(CorrectedMake, ALoopFileOfAnotherVersionIsRefused) {
  for (const auto& [version, code] : {std::pair{"1", 0}, {"2", 2}, {"1.5", 2}, {"\"1\"", 2}}) {
    const std::string file = (folder_ / "loop.json").string();
    std::ofstream(file) << R"({"format": "trueflank-loop", "gear": "pinion", "effects": [], "version": )" << version << "}";
    const auto made = make_parts(gearbox_, {.folder = folder_ / "out", .formats = {"stl"}, .tolerance_um = 20.0,
                                            .part = "pinion", .correct = file});
    EXPECT_EQ(made ? 0 : exit_code(made.error().front().code), code) << version;
  }
}

TEST_F(CorrectedMake, AFolderIsRefusedAndTheFileThatIsMeantNamed) {
  const auto made =
      make_parts(gearbox_, {.folder = folder_ / "out",
                            .formats = {"stl"},
                            .tolerance_um = 20.0,
                            .part = "pinion",
                            .correct = folder_.string()});
  ASSERT_FALSE(made);
  const Error& error = made.error().front();
  EXPECT_EQ(exit_code(error.code), 2);
  EXPECT_EQ(error.file, folder_.string());
  EXPECT_NE(error.message.find("folder"), std::string::npos) << error.message;
  EXPECT_NE(error.remedy.find("loop.json"), std::string::npos) << error.remedy;
}

TEST_F(CorrectedMake, ALoopFileOfWrongTypesIsAnErrorOfItsData) {
  for (const char* effects :
       {R"({"id": 3})", R"({"id": "scale", "parameters": 4})",
        R"({"id": "scale", "parameters": {"percent": {"value": "x"}}})",
        R"({"id": "scale", "repeatable": "no", "part": 7, "flank": 9, "parameters": {}})",
        R"({"id": "scale", "flank": "upper", "parameters": {"percent": {"value": 0.1}}})",
        R"({"id": "unnamed", "terms": [{"order": "x"}]})",
        R"({"id": "unnamed", "flank": "upper", "terms": [{"form": "bow_over_face", "cos_um": 1}]})",
        R"({"id": "lobing", "flank": "left", "parameters": {"order": {"value": 3},
            "amplitude_um": {"value": 1}, "phase_deg": {"value": 0}}})",
        R"({"id": "unnamed", "flank": "left", "terms": [{"form": "size_of_part", "cos_um": 1}]})",
        R"({"id": "mine", "form": {"a": 3}, "correctable": 8})", R"("scale")", R"(null)"}) {
    const auto made = make(effects);
    ASSERT_FALSE(made) << effects;
    EXPECT_EQ(exit_code(made.error().front().code), 2) << effects;
  }
  for (const char* effects : {R"({"id": "unnamed", "correctable": 8, "description": 3})",
                              R"({"id": "unnamed", "correctable": null, "description": null})"})
    EXPECT_TRUE(make(effects)) << effects;
  std::string many;
  for (int i = 0; i < 5000; ++i)
    many += (i > 0 ? "," : "") + effect_json(family("scale"), 1e-6, 0.0);
  const auto made = make(many);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().key, "effects");
}

}  // namespace
}  // namespace trueflank
