// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/local/remainder_courses.h"

// Errors that hang together far, have long tails or differ from side to side, and nothing else.
namespace trueflank::test {
namespace {

int alarms_of_thin_scans(int teeth, double correlation, unsigned count) {
  const MadeGear gear = spur(teeth);
  int alarms = 0;
  for (unsigned seed = 1; seed <= count; ++seed) {
    ScanOptions options{.points = 4000, .noise_um = 4.0, .correlation = correlation};
    options.seed = seed;
    alarms += close(gear, scan_of(gear, {}, options), true).verdict != loop::Verdict::kNoEffect;
  }
  return alarms;
}

TEST(NothingHidden, ErrorsThatHangTogetherAlongThinFlanksAreNoHeightsOfTheFlanks) {
  EXPECT_LE(alarms_of_thin_scans(67, 0.9, 6), 1);
}

TEST(NothingHidden, LongTailsOfAnIndexBesideTracesAreNoStructure) {
  const MadeGear gear = spur(19);
  unsigned alarms = 0;
  const unsigned all = survey_size(4U, 12U);
  for (unsigned seed = 1; seed <= all; ++seed) {
    InspectionOptions options{.points = 40, .noise_um = 0.8};
    options.seed = seed;
    loop::InspectionData data = inspection_of(gear, {}, options);
    std::mt19937_64 random(seed);
    std::student_t_distribution<double> tails(4.0);
    for (loop::InspectionRow& row : data.rows)
      if (row.record == loop::RecordKind::kIndex)
        row.deviation_um = options.noise_um * tails(random) / std::sqrt(2.0);
    const auto result = close(gear, data);
    alarms += result.verdict == loop::Verdict::kPartlyExplained && result.effects.empty();
  }
  EXPECT_LE(12 * alarms, 1 * all);
}

// Some flanks get three points and some seven: what scatters more is no sector.
TEST(NothingHidden, FlanksOfFewPointsMakeNoSectors) {
  const unsigned all = survey_size(60U, 240U);
  unsigned alarms = 0;
  for (unsigned seed = 1; seed <= all; ++seed) {
    const MadeGear gear = spur(24 + static_cast<int>(seed * 7 % 40));
    const int per_flank = 3 + static_cast<int>(seed % 5);
    constexpr int kOf = 6;  // of so many points one is kept
    loop::ScanData scan = scan_of(gear, {}, scanned(2 * gear.teeth * per_flank * kOf, 3.0, seed));
    std::mt19937_64 random(seed);
    std::erase_if(scan.points_mm, [&](const Vec3&) { return random() % kOf != 0; });
    alarms += close(gear, scan, true).verdict != loop::Verdict::kNoEffect;
  }
  EXPECT_LE(20 * alarms, all);
}

/// Patches of a scan whose errors on the left are so many times as large.
loop::Patches patches_of_louder_left(double times) {
  const MadeGear gear = spur(29);
  ScanOptions options{.points = 6000, .noise_um = 2.0};
  loop::MeasuredData data;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 2.0 * std::sqrt(times * times - 1.0));
  const auto louder =
      grown([&](auto&, const FlankSpot& s, auto&) { return s.side > 0 ? normal(random) : 0.0; });
  data.scans.push_back(scan_of(gear, {louder}, options));
  const loop::FlankGeometry geometry = geometry_of(gear);
  return make_patches(geometry, *make_observations(geometry, std::move(data), {.aligned = true}));
}

/// Mean weight of the patches of the left over those of the right.
double weight_of_left(const loop::Patches& patches) {
  std::array<double, 2> sum{}, count{};
  for (const auto& patch : patches.patches) {
    if (patch.kind != loop::ObservationKind::kScanFlank) continue;
    const std::size_t side = patch.places.front().place.side > 0 ? 1 : 0;
    sum[side] += patch.weight;
    count[side] += 1.0;
  }
  return sum[1] / count[1] / (sum[0] / count[0]);
}

TEST(NothingHidden, ASideThatIsMeasuredWorseWeighsLess) {
  EXPECT_NEAR(weight_of_left(patches_of_louder_left(2.0)), 0.25, 0.06);
}

TEST(NothingHidden, SidesThatDifferByChanceWeighAlike) {
  EXPECT_NEAR(weight_of_left(patches_of_louder_left(1.0)), 1.0, 0.02);
}

TEST(NothingHidden, PlacesOfAScanRunOverWhereValuesStand) {
  loop::Courses courses;
  courses.low = 0.0;
  courses.high = 10.0;
  courses.open(0, 1);
  for (int i = 0; i < 4000; ++i) {
    const double at = 1.0 + 8.0 * (i + 0.5) / 4000.0;  // none in the first and the last millimetre
    loop::Courses::add_to_cell(courses.of_flank[0].at(1), at / 10.0, at);
  }
  courses.count_cells();
  std::vector<int> members;
  const int places = courses.places(true);
  const Eigen::MatrixXd means = courses.matrix(0, places, members);
  ASSERT_EQ(members.size(), 1u);
  // Each place has values of its own, and says where it is.
  for (int i = 0; i < places; ++i)
    EXPECT_NEAR(means(i, 0) + 5.0, courses.place((i + 0.5) / places, places), 0.1) << i;
  for (int i = 1; i < places; ++i)
    EXPECT_NEAR(means(i, 0) - means(i - 1, 0), 8.0 / places, 0.02) << i;
}

}  // namespace
}  // namespace trueflank::test
