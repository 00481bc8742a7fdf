// SPDX-License-Identifier: GPL-3.0-or-later
// What scans of many points rest on: read in pieces, kept in little memory, worked on by all
// processors with the digits of one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/fit/plain_rms.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/scans/some_points.h"
#include "trueflank/loop/gear/table/rows_by_class.h"
#include "trueflank/loop/gear/table/shared_table.h"
#include "trueflank/loop/measured/read_measurement.h"

namespace trueflank::test {
namespace {

/// A scan of a gear 30 um off its axis, on the table.
class OffAxis : public ::testing::Test {
 protected:
  OffAxis() {
    loop::MeasuredData data;
    data.scans.push_back(
        scan_of(gear_, {off_centre(30.0, 40.0)}, {.points = 6000, .noise_um = 2.0, .bore = true}));
    table_ = *make_observations(geometry_, std::move(data), {.aligned = true});
    patches_ = make_patches(geometry_, table_);
  }
  [[nodiscard]] loop::PointFit fit_of_eccentricity() const {
    return {geometry_,
            table_,
            patches_,
            {{loop::find_family("eccentricity"), loop::FlankChoice::kBoth, {}}}};
  }

  MadeGear gear_ = spur(24);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  loop::Observations table_;
  loop::Patches patches_;
};

bool is_same(const loop::Place& a, const loop::Place& b) {
  return a.surface == b.surface && a.side == b.side && a.tooth == b.tooth &&
         a.roll_mm == b.roll_mm && a.z_mm == b.z_mm && a.radius_mm == b.radius_mm &&
         a.polar_rad == b.polar_rad && a.polar_direction == b.polar_direction &&
         a.normal_direction == b.normal_direction;
}

TEST_F(OffAxis, ADisplacementTakenBackLeavesTheTableAsItWasMeasured) {
  const loop::Observations before = table_;
  EXPECT_GT(linearise_at(geometry_, fit_of_eccentricity(), table_), 0.1);
  EXPECT_TRUE(table_.is_displaced);
  undo_displacement(geometry_, table_);
  EXPECT_FALSE(table_.is_displaced);
  ASSERT_EQ(table_.rows.size(), before.rows.size());
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    ASSERT_EQ(table_.rows[i].deviation_um, before.rows[i].deviation_um) << i;
    ASSERT_TRUE(is_same(table_.place(table_.rows[i]), before.place(before.rows[i]))) << i;
  }
}

TEST_F(OffAxis, TheFitToTheDesignIsTheSameHoweverTheTableWasDisplaced) {
  const std::vector<loop::Effect> none;
  const loop::PointFit before(geometry_, table_, patches_, none);
  linearise_at(geometry_, fit_of_eccentricity(), table_);
  const loop::PointFit after(geometry_, table_, patches_, none, 1, loop::DeviationsOf::kDesign);
  EXPECT_EQ(after.errors({}).rms_um, before.errors({}).rms_um);
  const loop::PointFit displaced(geometry_, table_, patches_, none);
  EXPECT_NE(displaced.errors({}).rms_um, before.errors({}).rms_um);
}

TEST_F(OffAxis, ASampleTellsWhetherPointsWouldBeMovedAgain) {
  const double first = change_of_sample_um(geometry_, fit_of_eccentricity(), table_);
  EXPECT_FALSE(table_.is_displaced);
  EXPECT_NEAR(first, linearise_at(geometry_, fit_of_eccentricity(), table_), 1e-3);
  const double again = change_of_sample_um(geometry_, fit_of_eccentricity(), table_);
  EXPECT_GT(first, 0.1);
  EXPECT_LT(again, 0.01 * first);
}

TEST_F(OffAxis, WhatStandsOutIsMovedBackBeforeAnythingIsChosen) {
  const double first = change_of_sample_um(geometry_, fit_of_eccentricity(), table_);
  loop::PartModel model(geometry_, table_, {});
  divide_into_patches(model);
  move_back_what_is_off_centre(model);
  ASSERT_TRUE(model.table->is_displaced);
  const loop::Effect eccentricity{loop::find_family("eccentricity")};
  const double again = change_of_sample_um(geometry_, *fit_of(model, {eccentricity}), model.table);
  EXPECT_LT(again, 0.05 * first);  // as from one choice to the next
}

TEST_F(OffAxis, PointsStayWhereNoEccentricityIsLookedFor) {
  loop::PartOptions options;
  options.given = {{loop::find_family("scale")}};
  loop::PartModel given(geometry_, table_, options);
  loop::PartModel banned(geometry_, table_, {});
  banned.banned.assign(banned.candidates.size(), true);
  for (loop::PartModel* model : {&given, &banned}) {
    divide_into_patches(*model);
    move_back_what_is_off_centre(*model);
    EXPECT_FALSE(model->table->is_displaced);
  }
}

TEST_F(OffAxis, PointsOnTheirAxisStayWhereTheyAre) {
  for (const std::vector<Process>& process : {std::vector<Process>{}, {scaled(0.2)}}) {
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear_, process, {.points = 6000, .noise_um = 2.0, .bore = true}));
    loop::PartModel model(geometry_,
                          *make_observations(geometry_, std::move(data), {.aligned = true}), {});
    divide_into_patches(model);
    move_back_what_is_off_centre(model);
    EXPECT_FALSE(model.table->is_displaced);
  }
}

TEST_F(OffAxis, ResidualsAskedForAgainAreTheSameWhileSomebodyHoldsThem) {
  const loop::PointFit fit = fit_of_eccentricity();
  const auto residuals_um = fit.residuals_um();
  EXPECT_EQ(fit.residuals_um(), residuals_um);
  double square = 0.0;
  int counted = 0;
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    if (!loop::counts_as_error(table_.rows[i].kind) || patches_.patch_of_row[i] < 0) continue;
    square += (*residuals_um)[i] * (*residuals_um)[i];
    ++counted;
  }
  EXPECT_NEAR(std::sqrt(square / counted), fit.errors({true}).rms_um, 1e-5);
}

TEST_F(OffAxis, ThePoseLeavesNoLessThanTheBoundSays) {
  const double bound = least_plain_rms_um(geometry_, table_, patches_);
  const loop::PointFit fit(geometry_, table_, patches_, {});
  EXPECT_GT(bound, 1.0);
  EXPECT_LE(bound, fit.errors({}).rms_um);
}

TEST_F(OffAxis, ATableIsSharedUntilOneChangesIt) {
  loop::SharedTable one(table_);
  loop::SharedTable other = one;
  EXPECT_EQ(one->rows.data(), other->rows.data());
  other.own().rows[0].deviation_um = 7.0;
  EXPECT_NE(one->rows.data(), other->rows.data());
  EXPECT_NE(one->rows[0].deviation_um, 7.0);
}

TEST(RowsByClass, EveryClassHasItsRowsInTheOrderOfTheTable) {
  constexpr std::size_t kRows = 200'001, kClasses = 7;
  const auto class_of = [](std::size_t i) {
    const auto number = static_cast<int>(i * 2654435761U >> 7U) % 8;
    return number == 7 ? -1 : number;
  };
  const loop::RowsByClass rows(kRows, kClasses, class_of);
  for (std::size_t k = 0; k < kClasses; ++k) {
    std::vector<std::size_t> expected, seen;
    for (std::size_t i = 0; i < kRows; ++i)
      if (class_of(i) == static_cast<int>(k)) expected.push_back(i);
    rows.for_each(k, [&](std::size_t i) { seen.push_back(i); });
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(rows.count(k), expected.size());
  }
}

TEST(ScanOfManyPoints, LinesAreCountedThroughAllPiecesOfAFile) {
  std::string text = "# a scan\n70000\n";
  for (int i = 0; i < 70'000; ++i)
    text += i == 65'000 ? "broken line\n" : std::to_string(i) + ".25 1.5000000 2.5000000\n";
  std::vector<std::string> notes;
  const auto scan = loop::read_xyz("a.xyz", text, notes);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->points_mm.size(), 69'999U);
  EXPECT_EQ(scan->points_mm[64'999][0], 64'999.25);
  EXPECT_EQ(scan->points_mm[65'000][0], 65'001.25);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(notes[0].starts_with("a.xyz:65003:")) << notes[0];
}

TEST(ScanOfManyPoints, AHeaderLongerThanAPieceIsNoData) {
  const std::string text = std::string(3'000'000, '#') + "\n2\n1 2 3\n4 5 6\n";
  std::vector<std::string> notes;
  EXPECT_EQ(loop::read_xyz("a.xyz", text, notes)->points_mm.size(), 2U);
  EXPECT_TRUE(notes.empty());
}

/// A hollow towards 70 deg, and a lean over the face [um at an end].
Process sunk_and_leaning(double lean_um) {
  return grown([lean_um](const MadeGear&, const FlankSpot& s, const Vec3& p) {
    const double off = std::remainder(std::atan2(p[1], p[0]) - 70.0 * M_PI / 180.0, 2.0 * M_PI) /
                       (20.0 * M_PI / 180.0);
    return -25.0 * std::exp(-off * off) + lean_um * s.v;
  });
}

/// A scan of a sunk gear for which a form without a name was chosen: it needs a search.
class LargeScans : public ::testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<loop::PartModel> scanned_with(double lean_um,
                                                              int points = 90000) const {
    return scanned_of({sunk_and_leaning(lean_um)}, points);
  }
  [[nodiscard]] std::unique_ptr<loop::PartModel> scanned_of(const std::vector<Process>& made,
                                                            int points) const {
    loop::MeasuredData data;
    data.scans.push_back(scan_of(gear_, made, scanned(points, 4.0, 6)));
    auto model = std::make_unique<loop::PartModel>(
        geometry_, *make_observations(geometry_, std::move(data), {.aligned = true}),
        loop::PartOptions{});
    divide_into_patches(*model);
    model->effects = chosen_;
    return model;
  }

  MadeGear gear_ = spur(24);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  std::vector<loop::Effect> chosen_{
      {loop::find_family("unnamed"), loop::FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}}};
};

TEST_F(LargeScans, AFormSoughtInSomePointsIsFittedToAll) {
  const auto model = scanned_with(0.0);
  const std::size_t rows = model->table->rows.size();
  ASSERT_TRUE(explain_by_some_points(*model));
  EXPECT_EQ(model->table->rows.size(), rows);
  ASSERT_EQ(model->effects.size(), 1U);
  const loop::Effect& form = model->effects[0];
  ASSERT_EQ(form.family, loop::find_family("unnamed_body_place"));
  EXPECT_NEAR(form.shape[2], 70.0, 0.5);
  const auto fit = fit_of(*model, model->effects);
  EXPECT_GT(fit->observations(), 0.8 * static_cast<double>(rows));
  // (the error of all points is 0.05, of some 0.11)
  EXPECT_NEAR(fit->coefficients()[fit->first_column(0)], -25.0, 0.25);
}

TEST_F(LargeScans, PointsThatMovedAreMovedInAllOfThem) {
  // (of noise one scan in a hundred seems to hold more, and is left to all points; not this one)
  const auto model = scanned_of({sunk_and_leaning(0.0), off_centre(30.0, 40.0)}, 90000);
  ASSERT_TRUE(explain_by_some_points(*model));
  EXPECT_TRUE(model->table->is_displaced);
  ASSERT_EQ(model->effects.size(), 2U);
  const auto fit = fit_of(*model, model->effects);
  for (int e = 0; e < 2; ++e) {
    const int first = fit->first_column(e);
    const Eigen::VectorXd& b = fit->coefficients();
    if (model->effects[static_cast<std::size_t>(e)].family == loop::find_family("eccentricity"))
      EXPECT_NEAR(std::hypot(b[first], b[first + 1]), 30.0, 0.2);
    else
      EXPECT_NEAR(b[first], -25.0, 0.25);
  }
}

TEST_F(LargeScans, WhatOnlyAllPointsShowIsLeftToThem) {
  // (in 20 000 points it is four errors large, in all of them eight)
  const auto model = scanned_with(0.2);
  EXPECT_FALSE(explain_by_some_points(*model));
  EXPECT_EQ(model->effects, chosen_);
}

TEST_F(LargeScans, OfFewPointsOrNamesAloneAllAreAskedAtOnce) {
  EXPECT_FALSE(explain_by_some_points(*scanned_with(0.0, 50000)));
  const auto model = scanned_with(0.0);
  model->effects = {{loop::find_family("taper"), loop::FlankChoice::kBoth, {}}};
  EXPECT_FALSE(explain_by_some_points(*model));
}

}  // namespace
}  // namespace trueflank::test
