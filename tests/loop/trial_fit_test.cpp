// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/trial_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/shape_refinement.h"
#include "trueflank/loop/gear/table/alike_rows.h"

// Trial fits against the fit that sums everything anew.
namespace trueflank::test {
namespace {

using loop::Effect;

const loop::EffectFamily* family(const std::string& id) {
  for (const auto& known : loop::effect_library())
    if (known.id == id) return &known;
  return nullptr;
}

class TrialFits : public ::testing::Test {
 protected:
  TrialFits() {
    const auto wavy = grown([](const MadeGear& gear, const FlankSpot& s, const Vec3&) {
      return 5.0 * std::cos(2.0 * M_PI * s.v * 0.5 * gear.face_mm / 3.1);
    });
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear_, {wavy}, {.points = 6000, .noise_um = 2.0}));
    table_ = *make_observations(geometry_, data, {.aligned = true});
    patches_ = make_patches(geometry_, table_);
  }
  static Effect wave(double length_mm) {
    return {family("unnamed_waviness"), loop::FlankChoice::kBoth, {1.0, length_mm}};
  }
  double square(const std::vector<Effect>& effects) const {
    return loop::PointFit(geometry_, table_, patches_, effects).residual_square();
  }

  MadeGear gear_ = spur(24);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  loop::Observations table_;
  loop::Patches patches_;
};

TEST_F(TrialFits, SquaresAndCoefficientsAreThoseOfTheWholeFit) {
  const std::vector<Effect> effects{{family("eccentricity"), loop::FlankChoice::kBoth, {}},
                                    wave(3.3), wave(1.7)};
  loop::TrialFit trial(geometry_, table_, patches_, effects);
  const loop::PointFit whole(geometry_, table_, patches_, effects);
  EXPECT_NEAR(trial.residual_square() / whole.residual_square(), 1.0, 1e-9);
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (int k = 0; k < effects[e].columns(); ++k) {
      const int column = whole.first_column(static_cast<int>(e)) + k;
      EXPECT_NEAR(trial.coefficients(e)[k], whole.coefficients()[column], 1e-8);
      EXPECT_LE(trial.as_is(e).retained, whole.retained(column) * (1.0 + 1e-6));
    }
  std::vector<Effect> other = effects;
  other[1].shape[1] = 3.1;
  EXPECT_NEAR(trial.with_shapes(1, {other[1].shape}, 0.0).front().square / square(other), 1.0, 1e-9);
  trial.set_shapes(other);
  EXPECT_NEAR(trial.residual_square() / square(other), 1.0, 1e-9);
}

TEST(PointFits, ErrorsAreAsLargeAsTheyAreWhereTracesAreCutIntoPieces) {
  // The zeros of few traces are known from the same values as slopes along them.
  const MadeGear gear = spur(24);
  const loop::FlankGeometry geometry = geometry_of(gear);
  for (const std::vector<int>& teeth : {std::vector{1, 9, 17}, std::vector{1, 5, 9, 13, 17, 21}}) {
    InspectionOptions options;
    options.teeth = teeth;
    options.points = 60;
    options.index = false;
    double square = 0.0, told = 0.0;
    constexpr int kDraws = 300;
    for (options.seed = 1; options.seed <= kDraws; ++options.seed) {
      loop::MeasuredData data;
      data.inspections.push_back(inspection_of(gear, {}, options));
      const loop::Observations table = *make_observations(geometry, data, {});
      const loop::Patches patches = make_patches(geometry, table);
      const loop::PointFit fit(geometry, table, patches,
                               {{family("taper"), loop::FlankChoice::kBoth, {}}});
      const int column = fit.first_column(0);
      square += fit.coefficients()[column] * fit.coefficients()[column] / kDraws;
      told += fit.covariance()(column, column) / kDraws;
    }
    EXPECT_NEAR(std::sqrt(told / square), 1.0, 0.1) << teeth.size();
  }
}

TEST_F(TrialFits, AnIntervalKnowsThatThePlaceOfAFormBesideItIsFound) {
  // A wide ridge and a crowning: what the ridge's width may still be the crowning may too.
  const double middle = 0.5 * geometry_.face_width_mm();
  const std::vector<Effect> effects{
      {family("crowning"), loop::FlankChoice::kBoth, {}},
      {family("unnamed_band"), loop::FlankChoice::kBoth, {1.0, middle, 0.6 * middle}}};
  const auto ridge = grown([](const MadeGear&, const FlankSpot& s, const Vec3&) {
    return 8.0 * std::exp(-std::pow(s.v / 0.6, 2)) - 4.0 * s.v * s.v;
  });
  loop::MeasuredData data;
  data.scans.push_back(scan_of(gear_, {ridge}, {.points = 6000, .noise_um = 2.0}));
  const loop::Observations table = *make_observations(geometry_, data, {.aligned = true});
  const loop::Patches patches = make_patches(geometry_, table);
  const loop::PointFit fit(geometry_, table, patches, effects);
  const auto known = shape_uncertainty(geometry_, table, patches, fit),
             found = shape_uncertainty(geometry_, table, patches, fit, loop::FreeShapes::kAll);
  const int column = fit.first_column(0);
  EXPECT_DOUBLE_EQ(known.covariance(column, column), fit.covariance()(column, column));
  EXPECT_GT(found.covariance(column, column), 2.0 * known.covariance(column, column));
}

TEST_F(TrialFits, FormsTriedInCellsLeaveWhatTheyLeavePointByPoint) {
  const std::vector<Effect> effects{
      {family("eccentricity"), loop::FlankChoice::kBoth, {}},
      {family("unnamed_waviness"), loop::FlankChoice::kBoth, {1.0, 5.0}}};
  const loop::TrialFit exact(geometry_, table_, patches_, effects);
  // The true one takes out most of what is there.
  const std::vector<loop::EffectShape> shapes{{1.0, 3.1}, {1.0, 3.3}, {1.0, 4.0}};
  const auto slow = exact.with_shapes(1, shapes, 1e300);
  const double taken = exact.residual_square() - slow[0].square;
  const auto most_off = [&](loop::FlankCells cells) {
    const loop::TrialFit in_cells(geometry_, table_, patches_, effects, 1, cells);
    // (what stands is exact)
    EXPECT_NEAR(in_cells.residual_square() / exact.residual_square(), 1.0, 1e-12);
    const auto quick = in_cells.with_shapes(1, shapes, 1e300);
    double off = 0.0;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      off = std::max(off, std::abs(quick[i].square - slow[i].square) / taken);
    return off;
  };
  EXPECT_LT(most_off({1, 600}), 1e-3);
  EXPECT_LT(most_off({8, 32}), 0.05);
  // Cells as long as the wave follow none.
  EXPECT_GT(most_off({1, 3}), 0.5);
}

TEST_F(TrialFits, ValuesThatAreKeptAreThoseOfTheirEffectAndNoOther) {
  loop::SharedTable shared(table_);
  const std::vector<Effect> effects{wave(3.3), wave(1.7)};
  loop::TrialFit knowing(geometry_, shared, patches_, effects);
  const loop::TrialFit fresh(geometry_, table_, patches_, effects);
  const std::vector<loop::EffectShape> shapes{{1.0, 3.1}, {1.0, 3.2}};
  for (int turn = 0; turn < 2; ++turn) {  // the second time they are known
    const auto trials = knowing.with_shapes(0, shapes, 0.0), anew = fresh.with_shapes(0, shapes, 0.0);
    for (std::size_t i = 0; i < shapes.size(); ++i) EXPECT_EQ(trials[i].square, anew[i].square);
  }
  std::vector<std::uint32_t> rows;
  for (std::size_t i = 0; i < table_.rows.size(); ++i)
    if (patches_.patch_of_row[i] >= 0) rows.push_back(static_cast<std::uint32_t>(i));
  const std::uint64_t all = loop::EffectValues::key_of(rows);
  const loop::EffectValues& kept = shared.values();
  ASSERT_NE(kept.find(wave(3.1), all), nullptr);
  const Eigen::MatrixXd& values = *kept.find(wave(3.1), all);
  ASSERT_EQ(values.rows(), static_cast<Eigen::Index>(rows.size()));
  std::vector<double> one(8);
  for (const std::size_t i : {std::size_t{0}, rows.size() / 2, rows.size() - 1}) {
    wave(3.1).evaluate(geometry_, table_.place(table_.rows[rows[i]]), one.data());
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      EXPECT_EQ(values(static_cast<Eigen::Index>(i), k), one[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(kept.find(wave(3.15), all), nullptr);
  Effect on_one_flank = wave(3.1);
  on_one_flank.flank = loop::FlankChoice::kLeft;
  EXPECT_EQ(kept.find(on_one_flank, all), nullptr);
  rows.pop_back();
  EXPECT_EQ(kept.find(wave(3.1), loop::EffectValues::key_of(rows)), nullptr);
  knowing.set_shapes({wave(3.2), wave(1.7)});
  EXPECT_NEAR(knowing.residual_square() / square({wave(3.2), wave(1.7)}), 1.0, 1e-9);
  // Another who has the table keeps them; of a changed one they are forgotten.
  loop::SharedTable moved = shared;
  moved.own().places.front().roll_mm += 0.1;
  EXPECT_EQ(moved.values().find(wave(3.1), all), nullptr);
  EXPECT_NE(shared.values().find(wave(3.1), all), nullptr);
}

TEST(EffectValues, AreForgottenWhenTheyAreTooMany) {
  loop::EffectValues kept;
  const Effect effect{family("eccentricity"), loop::FlankChoice::kBoth, {}};
  const auto values = std::make_shared<Eigen::MatrixXd>(Eigen::MatrixXd::Ones(40'000, 2));
  for (std::uint64_t rows = 0; rows < 75; ++rows) kept.keep(effect, rows, values);
  EXPECT_NE(kept.find(effect, 0), nullptr);
  kept.keep(effect, 75, values);  // 6.08 million
  EXPECT_EQ(kept.find(effect, 0), nullptr);
  EXPECT_NE(kept.find(effect, 75), nullptr);
  // One so large that few would have room is never kept.
  kept.keep(effect, 76, std::make_shared<Eigen::MatrixXd>(Eigen::MatrixXd::Ones(50'000, 2)));
  EXPECT_EQ(kept.find(effect, 76), nullptr);
}

TEST_F(TrialFits, OneFitKnowsTheSquareWithoutAnyOfItsEffects) {
  const std::vector<Effect> effects{{family("eccentricity"), loop::FlankChoice::kBoth, {}},
                                    wave(3.3), wave(1.7)};
  const loop::PointFit fit(geometry_, table_, patches_, effects);
  EXPECT_EQ(fit.residual_square({true, true, true}), fit.residual_square());
  EXPECT_NEAR(fit.residual_square({true, false, true}) / square({effects[0], effects[2]}), 1.0,
              1e-9);
  EXPECT_NEAR(fit.residual_square({false, false, false}) / square({}), 1.0, 1e-9);
}

TEST_F(TrialFits, AFormOfAScanPutInThePlaceOfAnotherIsAsFromTheBeginning) {
  const loop::FlankCells others{32, 32};
  for (const loop::FlankCells cells : {loop::FlankCells{}, loop::FlankCells{1, 600}}) {
    loop::TrialFit fit(geometry_, table_, patches_, {wave(3.3), wave(1.7)}, 1, cells);
    EXPECT_FALSE(fit.put_effect(1, wave(2.0), others));
    EXPECT_FALSE(fit.put_effect(0, wave(2.0), cells));  // (it is not the last)
    EXPECT_EQ(fit.effects()[1], wave(1.7));
    ASSERT_TRUE(fit.put_effect(1, wave(2.0), cells));
    const std::vector<Effect> now{wave(3.3), wave(2.0)};
    EXPECT_EQ(fit.effects(), now);
    const loop::TrialFit anew(geometry_, table_, patches_, now, 1, cells);
    EXPECT_EQ(fit.residual_square(), anew.residual_square());
    EXPECT_EQ(fit.coefficients(1), anew.coefficients(1));
    const std::vector<loop::EffectShape> shapes{{1.0, 2.2}, {1.0, 3.1}};
    for (std::size_t i = 0; i < shapes.size(); ++i)
      EXPECT_EQ(fit.with_shapes(1, shapes, 1e300)[i].square,
                anew.with_shapes(1, shapes, 1e300)[i].square);
  }
}

TEST_F(TrialFits, TwoWavesDoNotMeetAtOneLength) {
  std::vector<Effect> effects{wave(3.0), wave(3.6)};
  EXPECT_TRUE(loop::refine_nearby(geometry_, table_, patches_, effects));
  const loop::TrialFit fit(geometry_, table_, patches_, effects);
  EXPECT_NEAR(std::min(effects[0].shape[1], effects[1].shape[1]), 3.1, 0.1);
  EXPECT_GE(fit.as_is(0).retained, loop::kToldApart);
  EXPECT_LT(fit.coefficients(0).norm(), 10.0);
  // The same two at nearly one length are told apart by nothing.
  effects[0].shape[1] = 3.1;
  effects[1].shape[1] = 3.11;
  EXPECT_LT(loop::TrialFit(geometry_, table_, patches_, effects).as_is(1).retained,
            loop::kToldApart);
}

TEST_F(TrialFits, WhatStandsBeforeTheFirstStaysAsItIs) {
  std::vector<Effect> effects{{family("elephant_foot"), loop::FlankChoice::kBoth, {0.6}},
                              {family("elephant_foot"), loop::FlankChoice::kBoth, {1.5}}};
  loop::refine_shapes(geometry_, table_, patches_, effects, 1);
  EXPECT_EQ(effects[0].shape[0], 0.6);
  EXPECT_NE(effects[1].shape[0], 1.5);
}

/// Shapes of families that have none to choose from, over profile and face of a gear.
std::vector<loop::EffectShape> shapes_of(const loop::EffectFamily& family, const MadeGear& gear) {
  const double diameter = 2.0 * gear.reference(), height = 0.4 * gear.face_mm;
  if (family.id == "unnamed_step")
    return {{0.0, diameter, 0.0, 0.0}, {1.0, height, 0.0, 0.3}, {1.0, height, 1.0, 0.0}};
  if (family.id == "unnamed_kink") return {{0.0, diameter, 1.0}, {1.0, height, -1.0}, {1.0, height, 0.0}};
  if (family.id == "unnamed_band") return {{0.0, diameter, 0.5}, {1.0, height, 1.0}};
  if (family.id == "unnamed_waviness") return {{0.0, 0.8}, {1.0, 2.3}};
  return family.shapes ? family.shapes(geometry_of(gear)) : std::vector<loop::EffectShape>{{}};
}

TEST(Effects, ThatAreSaidToBeTheSameOnEveryToothAre) {
  const MadeGear gear = helical(23, 12.0);
  const loop::FlankGeometry geometry = geometry_of(gear);
  int asked = 0;
  for (const loop::EffectFamily& family : loop::effect_library())
    for (const loop::EffectShape& shape : shapes_of(family, gear)) {
      if (!family.same_on_every_tooth || !family.same_on_every_tooth(shape)) continue;
      ++asked;
      for (const int side : {1, -1})
        for (const double share : {0.1, 0.45, 0.9}) {
          const double roll = geometry.root_form_roll_mm() +
                              share * (geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
          const double z = (1.0 - 0.7 * share) * gear.face_mm;
          double first[8], other[8];
          family.evaluate(geometry, geometry.on_flank(1, side, roll, z), shape, first);
          for (const int tooth : {2, 9, 23}) {
            family.evaluate(geometry, geometry.on_flank(tooth, side, roll, z), shape, other);
            for (int k = 0; k < family.columns(shape); ++k) EXPECT_EQ(other[k], first[k]) << family.id;
          }
        }
    }
  EXPECT_GT(asked, 60);
}

/// Helix traces of all teeth, an index beside them.
class TrialFitsOfTraces : public ::testing::Test {
 protected:
  TrialFitsOfTraces() {
    const auto wavy = grown([](const MadeGear& gear, const FlankSpot& s, const Vec3&) {
      return 3.0 * std::cos(2.0 * M_PI * s.v * 0.5 * gear.face_mm / 3.1);
    });
    InspectionOptions options;
    for (int tooth = 1; tooth <= gear_.teeth; ++tooth) options.teeth.push_back(tooth);
    options.points = 40;
    options.noise_um = 0.5;
    loop::MeasuredData data;
    data.inspections.push_back(inspection_of(gear_, {wavy}, options));
    table_ = *make_observations(geometry_, data, {});
    patches_ = make_patches(geometry_, table_);
  }
  double square(const std::vector<Effect>& effects) const {
    return loop::PointFit(geometry_, table_, patches_, effects).residual_square();
  }
  static Effect of(const std::string& id, loop::EffectShape shape) {
    return {family(id), loop::FlankChoice::kBoth, std::move(shape)};
  }

  MadeGear gear_ = spur(24);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  loop::Observations table_;
  loop::Patches patches_;
};

TEST_F(TrialFitsOfTraces, FitsThatTakeColumnsFromOthersAreTheSame) {
  const Effect wave = of("unnamed_waviness", {1.0, 3.3}), tilt = of("axis_tilt", {0.0}),
               step = of("unnamed_step", {1.0, 4.0, 0.0, 0.0}),
               moved = of("unnamed_waviness", {1.0, 3.2});
  const auto fit_of = [&](const std::vector<Effect>& effects, loop::PointFit::Known known = {}) {
    return std::make_shared<const loop::PointFit>(geometry_, table_, patches_, effects, 1,
                                                  loop::DeviationsOf::kTable, known);
  };
  const std::vector others{fit_of({wave, tilt}), fit_of({step})};
  const auto own = fit_of({tilt, moved, step}), taken = fit_of({tilt, moved, step}, others);
  EXPECT_EQ(taken->coefficients(), own->coefficients());
  EXPECT_EQ(taken->covariance(), own->covariance());
  EXPECT_EQ(taken->residual_square(), own->residual_square());
  EXPECT_EQ(*taken->residuals_um(), *own->residuals_um());
}

TEST_F(TrialFitsOfTraces, RowsAreAlikeThatDifferByTheToothAlone) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i < table_.rows.size(); ++i) rows.push_back(i);
  const loop::AlikeRows alike = loop::alike_rows(table_, rows);
  EXPECT_LT(alike.first.size(), rows.size() / 10);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const loop::Observation &own = table_.rows[rows[i]], &first = table_.rows[alike.first[alike.kind[i]]];
    EXPECT_EQ(table_.place(own).z_mm, table_.place(first).z_mm);
    EXPECT_EQ(table_.place(own).roll_mm, table_.place(first).roll_mm);
    EXPECT_EQ(table_.place(own).side, table_.place(first).side);
    EXPECT_EQ(own.weight, first.weight);
  }
}

TEST_F(TrialFitsOfTraces, ShapesThatAreAlikeOnAllTeethAreTriedAsTheWholeFitDoes) {
  const double height = 0.4 * gear_.face_mm;
  const std::vector<Effect> effects{of("unnamed", {0.0, 1.0, 1.0, 0.0}), of("unnamed_waviness", {1.0, 3.3}),
                                    of("unnamed_kink", {1.0, height, 1.0})};
  loop::TrialFit trial(geometry_, table_, patches_, effects);
  EXPECT_NEAR(trial.residual_square() / square(effects), 1.0, 1e-9);
  const loop::PointFit whole(geometry_, table_, patches_, effects);
  for (std::size_t e = 0; e < effects.size(); ++e) {
    double least = 1.0;
    for (int k = 0; k < effects[e].columns(); ++k) {
      const int column = whole.first_column(static_cast<int>(e)) + k;
      EXPECT_NEAR(trial.coefficients(e)[k], whole.coefficients()[column], 1e-8);
      least = std::min(least, whole.retained(column));
    }
    EXPECT_NEAR(trial.as_is(e).retained, least, 1e-7);
  }
  const std::vector<std::vector<loop::EffectShape>> shapes{
      {}, {{1.0, 3.1}, {1.0, 2.9}}, {{1.0, 0.8 * height, 1.0}, {1.0, height, -1.0}, {1.0, height, 0.0}}};
  for (std::size_t e = 1; e < effects.size(); ++e) {
    const auto trials = trial.with_shapes(e, shapes[e], 1e300);
    for (std::size_t i = 0; i < shapes[e].size(); ++i) {
      std::vector<Effect> other = effects;
      other[e].shape = shapes[e][i];
      EXPECT_NEAR(trials[i].square / square(other), 1.0, 1e-9);
      loop::TrialFit moved(geometry_, table_, patches_, effects);
      moved.set_shapes(other);
      EXPECT_NEAR(moved.residual_square() / square(other), 1.0, 1e-9);
      EXPECT_NEAR(moved.as_is(e).retained, trials[i].retained, 1e-9);
    }
  }
}

/// Shapes of families that are a form times factors of teeth, the first one to begin with. Over the
/// profile helix traces do not differ.
struct TriedAround {
  std::string id;
  std::vector<loop::EffectShape> shapes;
  loop::FlankChoice flank = loop::FlankChoice::kBoth;
};
const std::vector<TriedAround> kTriedAround{
    {"unnamed_levelling",
     {{3, 0, 1, 0, 0, 4.0, 0},
      {9, 0, 1, 0, 1, 6.0, 1},
      {9, 0, 2, 1, 0, 2.5, 2},
      {7, 0, 0, 0, 0, 5.0, 0}}},
    {"unnamed_ramp",
     {{4, 0, 1, 0, 0}, {11, 0, 1, 1, 1}, {11, 0, 2, 0, 2}},
     loop::FlankChoice::kLeft},
    {"unnamed_sector", {{4, 6, 0, 1, 0}, {5, 6, 0, 1, 0}, {22, 5, 0, 0, 1}}},
    {"unnamed_soft_sector", {{8.0, 7.0, 2.0, 0}, {8.3, 7.5, 1.0, 1}}},
    {"unnamed_drift_of_some", {{4, 9, 0, 1, 0, 0}, {5, 9, 0, 1, 0, 1}, {5, 8, 0, 0, 1, 0}}},
    {"unnamed_broken_wave", {{1.5, 4, 0}, {1.25, 6, 1}}},
    {"unnamed_stairs", {{2, 9, 17, 0}, {3, 9, 17, 1}, {3, 10, 20, 0}}},
    {"unnamed_wave_of_some", {{3, 11, 4.0, 0}, {3, 10, 4.4, 1}}, loop::FlankChoice::kRight}};

TEST_F(TrialFitsOfTraces, FormsTimesFactorsOfTeethAreTriedAsTheWholeFitDoes) {
  InspectionOptions options;
  for (int tooth = 1; tooth <= gear_.teeth; tooth += 2) options.teeth.push_back(tooth);
  options.points = 30;
  options.radial = true;
  loop::MeasuredData data;
  data.inspections.push_back(inspection_of(gear_, {off_centre(6.0, 30.0)}, options));
  const loop::Observations with_radial = *make_observations(geometry_, data, {});
  for (const loop::Observations* table :
       std::array<const loop::Observations*, 2>{&table_, &with_radial}) {
    const loop::Patches patches = make_patches(geometry_, *table);
    for (const TriedAround& tried : kTriedAround) {
      const loop::EffectFamily* of_family = family(tried.id);
      ASSERT_TRUE(of_family->form_times_tooth) << tried.id;
      const auto effects_with = [&](const loop::EffectShape& shape) {
        return std::vector<Effect>{of("unnamed_waviness", {1.0, 3.3}),
                                   {of_family, tried.flank, shape}};
      };
      const loop::TrialFit fit(geometry_, *table, patches, effects_with(tried.shapes.front()));
      const auto trials = fit.with_shapes(1, tried.shapes, 1e300);
      for (std::size_t i = 0; i < trials.size(); ++i) {
        const std::vector<Effect> other = effects_with(tried.shapes[i]);
        const double whole = loop::PointFit(geometry_, *table, patches, other).residual_square();
        EXPECT_NEAR(trials[i].square / whole, 1.0, 1e-9) << tried.id << ' ' << i;
        EXPECT_NEAR(trials[i].retained,
                    loop::TrialFit(geometry_, *table, patches, other).as_is(1).retained, 1e-8)
            << tried.id << ' ' << i;
      }
    }
  }
}

TEST_F(TrialFitsOfTraces, ADriftThatOnlyTheirZerosKnowTakesNothing) {
  for (const int points : {30, 37, 53}) {
    InspectionOptions options;
    for (int tooth = 1; tooth <= gear_.teeth; ++tooth) options.teeth.push_back(tooth);
    options.points = points;
    options.index = false;
    loop::MeasuredData data;
    data.inspections.push_back(inspection_of(gear_, {off_centre(6.0, 30.0)}, options));
    const loop::Observations table = *make_observations(geometry_, data, {});
    const loop::Patches patches = make_patches(geometry_, table);
    const loop::TrialFit fit(geometry_, table, patches,
                             {of("unnamed_levelling", {4, 0, 1, 0, 0, 5.0, 0})});
    std::vector<loop::EffectShape> shapes{{9, 0, 1, 0, 0, 5.0, 0}};
    for (int first = 1; first <= gear_.teeth; ++first)
      for (const double opposite : {0.0, 1.0})
        shapes.push_back({double(first), 0, 0, opposite, 0, 3.0, 0});
    const auto trials = fit.with_shapes(0, shapes, 1e300);
    const double nothing = loop::PointFit(geometry_, table, patches, {}).residual_square();
    EXPECT_LT(trials[0].square, nothing);
    EXPECT_GT(trials[0].retained, 0.1);
    for (std::size_t i = 1; i < trials.size(); ++i) {
      EXPECT_NEAR(trials[i].square / nothing, 1.0, 1e-12);
      EXPECT_EQ(trials[i].retained, 0.0);
    }
  }
}

/// Places of the body: whole, along a part of profile or face, outwards; several around the gear,
/// which end.
std::vector<loop::EffectShape> places_of_the_body(const MadeGear& gear) {
  using loop::gear_effects::FlankCourse;
  const FlankCourse whole, above{FlankCourse::kStep, 0.4 * gear.face_mm, 1.0, 0.5},
      band{FlankCourse::kBand, 0.6 * gear.face_mm, 0.0, 1.5},
      tip{FlankCourse::kKink, 2.0 * gear.reference(), 1.0};
  std::vector<loop::EffectShape> shapes;
  for (const auto& [number, at_deg, half_deg] :
       {std::array{1.0, 40.0, 25.0}, std::array{1.0, 355.0, 70.0}, std::array{3.0, 100.0, 9.0}})
    for (const auto& [profile, face] :
         {std::pair(whole, whole), std::pair(whole, above), std::pair(whole, band),
          std::pair(tip, whole), std::pair(tip, band)})
      for (const double radial : {0.0, 1.0}) {
        loop::EffectShape shape{number, radial, at_deg, half_deg};
        shape.resize(4 + 2 * FlankCourse::kValues + 1);
        profile.put_in(shape, 4);
        face.put_in(shape, 4 + FlankCourse::kValues);
        shape.back() = number > 1.0 ? 1.0 : 0.0;  // (ends)
        shapes.push_back(std::move(shape));
      }
  return shapes;
}

TEST_F(TrialFitsOfTraces, FormsMadeOfTheirPartsAreTheFormsToTheLastDigit) {
  InspectionOptions options;
  for (int tooth = 1; tooth <= gear_.teeth; ++tooth) options.teeth.push_back(tooth);
  options.points = 30;
  options.radial = true;  // (a ball touches two flanks: a row of two places)
  loop::MeasuredData traces, scan;
  traces.inspections.push_back(inspection_of(gear_, {off_centre(6.0, 30.0)}, options));
  scan.scans.push_back(scan_of(gear_, {}, {.points = 3000, .noise_um = 2.0}));
  const std::vector<loop::EffectShape> shapes = places_of_the_body(gear_);
  const loop::EffectFamily* place = family("unnamed_body_place");
  // The same without parts: every row asks the form itself.
  loop::EffectFamily whole = *place;
  whole.parts = {};
  for (const bool scanned : {false, true}) {
    const loop::Observations table =
        *make_observations(geometry_, scanned ? scan : traces, {.aligned = scanned});
    const loop::Patches patches = make_patches(geometry_, table);
    for (const loop::FlankChoice flank : {loop::FlankChoice::kBoth, loop::FlankChoice::kLeft}) {
      const auto fit_of = [&](const loop::EffectFamily* one) {
        return loop::TrialFit(geometry_, table, patches,
                              {of("unnamed_waviness", {1.0, 3.3}), {one, flank, shapes.front()}});
      };
      const loop::TrialFit of_parts = fit_of(place), of_whole = fit_of(&whole);
      const auto tried = of_parts.with_shapes(1, shapes, 1e300),
                 expected = of_whole.with_shapes(1, shapes, 1e300);
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        EXPECT_EQ(tried[i].square, expected[i].square) << scanned << ' ' << i;
        EXPECT_EQ(tried[i].retained, expected[i].retained) << scanned << ' ' << i;
        EXPECT_EQ(of_parts.columns_of({place, flank, shapes[i]}),
                  of_whole.columns_of({&whole, flank, shapes[i]}))
            << scanned << ' ' << i;
      }
    }
  }
}

TEST_F(TrialFitsOfTraces, AnotherFormInTheLastPlaceIsAsIfItHadStoodThereFromTheBeginning) {
  const double height = 0.4 * gear_.face_mm;
  std::vector<Effect> effects{of("eccentricity", {}), of("unnamed_waviness", {1.0, 3.3}),
                              of("unnamed_kink", {1.0, height, 1.0})};
  loop::TrialFit kept(geometry_, table_, patches_, effects);
  const loop::EffectShape place = places_of_the_body(gear_)[2];
  for (const Effect& other :
       {of("unnamed_kink", {1.0, height, -1.0}), of("unnamed_band", {1.0, height, 1.0}),
        of("unnamed_body_place", place), of("unnamed_sector", {4, 6, 0, 1, 0}),
        of("unnamed_kink", {1.0, height, 1.0})}) {
    ASSERT_TRUE(kept.put_effect(2, other)) << other.family->id;
    effects.back() = other;
    const loop::TrialFit fresh(geometry_, table_, patches_, effects);
    EXPECT_EQ(kept.residual_square(), fresh.residual_square()) << other.family->id;
    for (std::size_t e = 0; e < effects.size(); ++e) {
      EXPECT_EQ(kept.coefficients(e), fresh.coefficients(e)) << other.family->id;
      EXPECT_EQ(kept.as_is(e).square, fresh.as_is(e).square) << other.family->id;
      EXPECT_EQ(kept.as_is(e).retained, fresh.as_is(e).retained) << other.family->id;
    }
  }
  // Not of another number of columns, nor in another's place.
  EXPECT_FALSE(kept.put_effect(2, of("unnamed_waviness", {1.0, 2.0})));
  EXPECT_FALSE(kept.put_effect(1, of("unnamed_waviness", {1.0, 2.0})));
  EXPECT_EQ(kept.effects(), effects);
}

TEST_F(TrialFitsOfTraces, FindTheLengthOfTheirWaves) {
  std::vector<Effect> effects{of("unnamed_waviness", {1.0, 3.4})};
  EXPECT_TRUE(loop::refine_nearby(geometry_, table_, patches_, effects));
  EXPECT_NEAR(effects[0].shape[1], 3.1, 0.05);
}

TEST(Patches, LeftOutForOneStepGetTheirWeightBackForAnother) {
  loop::Patches patches;
  for (const double z : {1.0, 2.0, 3.0}) {
    loop::Patches::Patch patch;
    patch.weight = 4.0;
    patch.z_low_mm = z - 0.4;
    patch.z_high_mm = z + 0.4;
    patches.patches.push_back(patch);
  }
  for (int round = 0; round < 3; ++round) patches.leave_out_across({1.1});
  EXPECT_DOUBLE_EQ(patches.patches[0].weight, 4e-6);
  patches.leave_out_across({2.1, 1.9});
  EXPECT_DOUBLE_EQ(patches.patches[0].weight, 4.0);
  EXPECT_DOUBLE_EQ(patches.patches[1].weight, 4e-6);
  EXPECT_DOUBLE_EQ(patches.patches[2].weight, 4.0);
  patches.leave_out_across({});
  EXPECT_DOUBLE_EQ(patches.patches[1].weight, 4.0);
}

}  // namespace
}  // namespace trueflank::test
