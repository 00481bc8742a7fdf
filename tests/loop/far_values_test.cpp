// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/loop/made_gears.h"

// One or two values of a trace that lie far off by themselves: told in a note, and nothing named.
namespace trueflank::test {
namespace {

InspectionOptions all_teeth(unsigned seed) {
  InspectionOptions options;
  options.noise_um = 0.5;
  options.points = 45;
  options.seed = seed;
  return options;
}

std::string notes_of(const loop::LoopResult& result) {
  std::string text;
  for (const std::string& note : result.notes) text += note + "\n";
  return text;
}

/// Rows of a trace, in the order of the file.
std::vector<std::size_t> trace_of(const loop::InspectionData& data, loop::RecordKind kind,
                                  int tooth, Flank flank) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < data.rows.size(); ++i)
    if (data.rows[i].record == kind && data.rows[i].tooth == tooth && data.rows[i].flank == flank)
      rows.push_back(i);
  return rows;
}

TEST(FarValues, AreToldWithToothPlaceAndHeight) {
  const MadeGear gear = spur(23);
  for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed)
    for (const int count : {1, 2}) {
      loop::InspectionData data = inspection_of(gear, {}, all_teeth(seed));
      const bool profile = seed % 2 == 0;
      const auto rows = trace_of(
          data, profile ? loop::RecordKind::kProfile : loop::RecordKind::kHelix, 7, Flank::kLeft);
      const std::size_t middle = rows.size() / 2;
      for (int k = 0; k < count; ++k)
        data.rows[rows[middle + static_cast<std::size_t>(k)]].deviation_um -= 5.5;
      const auto result = close(gear, data);
      const std::string notes = notes_of(result);
      // (of two that were left out before the fit each is told)
      EXPECT_NE(
          notes.find(std::string(" of tooth 7, left flank, ") + (profile ? "profile" : "helix")),
          std::string::npos)
          << seed << " " << notes << list(result);
      EXPECT_NE(notes.find("um low"), std::string::npos) << notes;
      EXPECT_FALSE(has_name(result)) << list(result);
    }
}

// The last values of steep reliefs, which were left out before the fit, were told as dirt.
TEST(FarValues, AtTheEndOfAReliefThatIsToldAreNone) {
  for (unsigned seed = 1; seed <= survey_size(2U, 4U); ++seed) {
    const MadeGear gear = spur(20 + static_cast<int>(seed));
    const auto relieved = grown([](auto&, const FlankSpot& s, auto&) {
      const double past = std::max(0.0, 0.5 * (s.u + 1.0) - 0.62) / 0.38;
      return -10.0 * past * past;
    });
    InspectionOptions options = all_teeth(seed);
    options.noise_um = 0.8;
    options.points = 24;
    loop::InspectionData data = inspection_of(gear, {relieved}, options);
    const auto plain = close(gear, data);
    EXPECT_NE(find(plain, "tip_relief"), nullptr) << list(plain);
    EXPECT_EQ(notes_of(plain).find("lies "), std::string::npos) << notes_of(plain);
    // a true one is told beside the relief
    data.rows[trace_of(data, loop::RecordKind::kProfile, 9, Flank::kRight)[8]].deviation_um += 11.0;
    const auto wild = close(gear, data);
    EXPECT_NE(notes_of(wild).find("one value of tooth 9, right flank, profile"), std::string::npos)
        << notes_of(wild);
  }
}

TEST(FarValues, OfNoiseAreNone) {
  for (unsigned seed = 1; seed <= survey_size(3U, 10U); ++seed) {
    const auto result = close(spur(23), inspection_of(spur(23), {}, all_teeth(seed)));
    EXPECT_EQ(notes_of(result).find("too few to tell"), std::string::npos) << notes_of(result);
  }
}

}  // namespace
}  // namespace trueflank::test
