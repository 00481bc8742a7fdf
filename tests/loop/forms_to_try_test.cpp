// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/forms_to_try.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/effects/along_flank.h"

// What every list of forms to start from must hold, whatever its numbers are: places on the flank,
// no width beyond it, both ends alike, no gap between neighbours that is left out.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::EffectShape;
using loop::FlankChoice;
using loop::FlankGeometry;

const std::vector<MadeGear>& gears_of_all_kinds() {
  static const std::vector<MadeGear> gears{spur(12), spur(31), spur(90), ring(48),
                                           helical(23, 20.0)};
  return gears;
}
double range_mm(const FlankGeometry& geometry, double face) {
  return face != 0.0 ? geometry.face_width_mm()
                     : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
}
std::vector<Effect> of(const std::vector<Effect>& forms, const std::string& family) {
  std::vector<Effect> these;
  std::copy_if(forms.begin(), forms.end(), std::back_inserter(these),
               [&](const Effect& form) { return form.family == loop::find_family(family); });
  return these;
}
void expect_all_differ(const std::vector<Effect>& forms) {
  std::set<std::string> seen;
  for (const Effect& form : forms) {
    std::string key = form.family->id + std::to_string(static_cast<int>(form.flank));
    for (const double value : form.shape) key += " " + std::to_string(value);
    EXPECT_TRUE(seen.insert(key).second) << key;
  }
}

TEST(FormsToTry, AlongTheFlankLieWithinItAndAreAlikeAtBothEnds) {
  for (const MadeGear& gear : gears_of_all_kinds()) {
    const FlankGeometry geometry = geometry_of(gear);
    for (const double face : {0.0, 1.0}) {
      const double range = range_mm(geometry, face);
      std::vector<Effect> forms = loop::forms_along(geometry, face, FlankChoice::kLeft, true);
      for (Effect& step : loop::steps_along(geometry, face, FlankChoice::kLeft))
        forms.push_back(step);
      for (Effect& sag : loop::sags_along(geometry, face, FlankChoice::kLeft)) forms.push_back(sag);
      expect_all_differ(forms);
      std::map<std::string, std::set<int>> places;  // hundredths of the range
      for (const Effect& form : forms) {
        EXPECT_EQ(form.flank, FlankChoice::kLeft);
        EXPECT_EQ(form.shape[0], face);
        if (form.family == loop::find_family("unnamed_rise")) {
          EXPECT_GT(form.shape[1], 0.0);
          EXPECT_LT(form.shape[1], 0.5 * range);
          continue;
        }
        const double share = loop::gear_effects::share_at(geometry, face, form.shape[1]);
        EXPECT_GT(share, 0.03) << form.family->id;
        EXPECT_LT(share, 0.97) << form.family->id;
        places[form.family->id].insert(static_cast<int>(std::lround(100.0 * share)));
        if (form.family == loop::find_family("unnamed_strip")) {
          EXPECT_GT(loop::gear_effects::share_at(geometry, face, form.shape[2]), share);
          EXPECT_LT(loop::gear_effects::share_at(geometry, face, form.shape[2]), 0.97);
          EXPECT_LT(form.shape[3], 0.1 * range);
        }
        if (form.family == loop::find_family("unnamed_band")) {
          EXPECT_LT(form.shape[2], 0.5 * range);
        }
      }
      for (const char* family : {"unnamed_kink", "unnamed_band", "unnamed_sag", "unnamed_step"}) {
        const std::set<int>& own = places[family];
        for (const int share : own)
          EXPECT_TRUE(own.contains(100 - share) || own.contains(99 - share) ||
                      own.contains(101 - share))
              << family << " at " << share;
        int last = *own.begin();
        for (const int share : own) {
          EXPECT_LE(share - last, 13) << family << " before " << share;
          last = share;
        }
      }
      // what is flat and leaves that: towards either end, at equal places
      for (const char* family : {"unnamed_kink", "unnamed_bend", "unnamed_rise"}) {
        std::array<std::set<double>, 2> ends;
        for (const Effect& form : of(forms, family)) {
          const double end = form.shape[2];
          if (end != 0.0) ends[end > 0.0 ? 1 : 0].insert(form.shape[1]);
        }
        EXPECT_EQ(ends[0], ends[1]) << family;
        EXPECT_FALSE(ends[0].empty()) << family;
      }
    }
  }
}

TEST(FormsToTry, WavesAreFromAThirdOfTheFlankToAnSOverMore) {
  for (const MadeGear& gear : gears_of_all_kinds()) {
    const FlankGeometry geometry = geometry_of(gear);
    for (const double face : {0.0, 1.0}) {
      const auto waves = loop::long_waves(geometry, face, FlankChoice::kBoth);
      EXPECT_NEAR(waves.front().shape[1], range_mm(geometry, face) / 3.0,
                  0.05 * range_mm(geometry, face));
      EXPECT_GT(waves.back().shape[1], 1.2 * range_mm(geometry, face));
      for (std::size_t i = 1; i < waves.size(); ++i) {
        EXPECT_GT(waves[i].shape[1], waves[i - 1].shape[1]);
        EXPECT_LE(waves[i].shape[1], 1.25 * waves[i - 1].shape[1]);
      }
    }
    for (const double order : {17.0, 40.0}) {
      const auto waves = loop::waves_of_order(geometry, order, FlankChoice::kRight);
      const double whole_mm = 2.0 * M_PI * geometry.base_radius_mm() / order;
      EXPECT_LT(waves.front().shape[1], 0.7 * whole_mm);
      EXPECT_GT(waves.back().shape[1], 1.5 * whole_mm);
      EXPECT_TRUE(std::any_of(waves.begin(), waves.end(), [&](const Effect& wave) {
        return std::abs(wave.shape[1] - whole_mm) < 1e-6 * whole_mm;
      }));
    }
  }
}

TEST(FormsToTry, CornersAndHollowsAreOfAnyPartOfTheFlankUpToTheWhole) {
  for (const MadeGear& gear : gears_of_all_kinds()) {
    const FlankGeometry geometry = geometry_of(gear);
    const auto corners = loop::corners(geometry, FlankChoice::kLeft);
    expect_all_differ(corners);
    std::map<std::pair<double, double>, std::set<std::vector<double>>>
        at;  // corner -> widths and power
    double over_profile = 0.0, over_face = 0.0;
    for (const Effect& corner : corners) {
      EXPECT_EQ(corner.flank, FlankChoice::kLeft);
      at[{corner.shape[0], corner.shape[1]}].insert(
          {corner.shape[2], corner.shape[3], corner.shape[4]});
      over_profile = std::max(over_profile, corner.shape[2]);
      over_face = std::max(over_face, corner.shape[3]);
    }
    EXPECT_EQ(at.size(), 4U);
    for (const auto& [corner, widths] : at) EXPECT_EQ(widths, at.begin()->second);
    EXPECT_DOUBLE_EQ(over_profile, range_mm(geometry, 0.0));
    EXPECT_DOUBLE_EQ(over_face, range_mm(geometry, 1.0));
    const auto dishes = loop::dishes(geometry, FlankChoice::kBoth, "unnamed_dish");
    expect_all_differ(dishes);
    const auto [least, most] = std::minmax({loop::gear_effects::place_at(geometry, 0.0, 0.0),
                                            loop::gear_effects::place_at(geometry, 0.0, 1.0)});
    for (const Effect& dish : dishes) {
      EXPECT_GT(dish.shape[0], least);
      EXPECT_LT(dish.shape[0], most);
      EXPECT_GT(dish.shape[1], 0.0);
      EXPECT_LT(dish.shape[1], geometry.face_width_mm());
      EXPECT_LE(dish.shape[2], 0.5 * range_mm(geometry, 0.0));
      EXPECT_LE(dish.shape[3], 0.5 * range_mm(geometry, 1.0));
    }
    for (const Effect& kink : loop::kinks_of_the_axis(geometry)) {
      EXPECT_GT(kink.shape[0], 0.1 * geometry.face_width_mm());
      EXPECT_LT(kink.shape[0], 0.9 * geometry.face_width_mm());
    }
  }
}

TEST(FormsToTry, SwellingsAreOfEveryNumberAndLeaveNoPlaceOut) {
  for (const int z : {12, 31, 90}) {
    std::map<int, std::map<double, std::set<double>>> first_teeth;  // number -> half width -> teeth
    for (const Effect& form : loop::swellings_around(z, FlankChoice::kRight)) {
      EXPECT_EQ(form.flank, FlankChoice::kRight);
      first_teeth[static_cast<int>(form.shape[0])][form.shape[2]].insert(form.shape[1]);
    }
    for (int number = 2; number <= loop::kMostSwellings; ++number) {
      const double apart = static_cast<double>(z) / number;
      EXPECT_EQ(first_teeth.contains(number), 0.4 * apart > 0.7) << z << " " << number;
      for (const auto& [half, teeth] : first_teeth[number]) {
        EXPECT_GE(half, 0.7);
        EXPECT_LT(half, 0.4 * apart);
        // around the circle of what repeats after so many teeth
        EXPECT_EQ(*teeth.begin(), 1.0);
        EXPECT_GE(*teeth.rbegin() + half, 1.0 + apart - 1e-9);
        EXPECT_LT(*teeth.rbegin(), 1.0 + apart);
        double last = 1.0;
        for (const double tooth : teeth) {
          EXPECT_LE(tooth - last, half);
          last = tooth;
        }
      }
      first_teeth.erase(number);
    }
    EXPECT_TRUE(first_teeth.empty());
  }
  const FlankGeometry geometry = geometry_of(spur(31));
  for (const int number : {1, 3}) {
    const double apart_deg = 360.0 / number;
    for (const Effect& form : loop::swellings_at_ends(geometry, number)) {
      EXPECT_EQ(form.shape[0], number);
      EXPECT_GE(form.shape[1], 0.0);
      EXPECT_LT(form.shape[1], apart_deg);
      EXPECT_GE(form.shape[2], 0.1 * apart_deg);
      EXPECT_LT(form.shape[2], 0.35 * apart_deg);
      EXPECT_EQ(std::abs(form.shape[3]), 1.0);
      EXPECT_LT(form.shape[4], 0.25 * geometry.face_width_mm());
    }
  }
}

/// From the fewest to the most, each at most a fifth or one more than the one before.
void expect_counts_between(const std::set<int>& counts, int fewest, int most,
                           const std::string& of_what) {
  if (fewest > most) {
    EXPECT_TRUE(counts.empty()) << of_what;
    return;
  }
  ASSERT_FALSE(counts.empty()) << of_what;
  EXPECT_EQ(*counts.begin(), fewest) << of_what;
  EXPECT_LE(*counts.rbegin(), most) << of_what;
  int last = fewest;
  for (const int count : counts) {
    EXPECT_LE(count, std::max(last + 1.0, 1.2 * last)) << of_what;
    last = count;
  }
  EXPECT_GT(std::max(last + 1.0, 1.2 * last), most) << of_what;
}

TEST(FormsToTry, FromToothToToothAreOfEveryLengthAndBeginAtAnyTooth) {
  for (const int z : {9, 12, 31, 64})
    for (const loop::CourseOverFlanks course :
         {loop::CourseOverFlanks{0.0, 0.0}, {1.0, 0.0}, {0.0, 2.0}}) {
      const bool heights = course.profile == 0.0 && course.face == 0.0;
      std::map<std::string, std::set<int>> lengths, firsts;
      std::map<std::string, std::set<int>> flanks;
      std::vector<Effect> all;
      for (const auto& set : loop::forms_from_tooth_to_tooth(z, course)) {
        ASSERT_FALSE(set.empty());
        for (const Effect& form : set) {
          const std::string& id = form.family->id;
          EXPECT_EQ(form.family, set.front().family);
          EXPECT_EQ(form.flank, set.front().flank);
          EXPECT_EQ(form.columns(), set.front().columns());
          all.push_back(form);
          flanks[id].insert(static_cast<int>(form.flank));
          const auto value = [&](std::size_t k) { return static_cast<int>(form.shape[k]); };
          if (id == "unnamed_sector" || id == "unnamed_drift_of_some" ||
              id == "unnamed_wave_of_some") {
            lengths[id].insert(value(1));
            firsts[id].insert(value(0));
            EXPECT_LT(value(1), z);
          }
          if (id == "unnamed_ramp" || id == "unnamed_levelling") firsts[id].insert(value(0));
          if (id == "unnamed_comb" || id == "unnamed_saw") {
            lengths[id].insert(value(0));
            EXPECT_GE(value(1), 1);
            EXPECT_LE(value(1), id == "unnamed_comb" || z % value(0) == 0 ? value(0) : z);
          }
          if (id == "unnamed_wave_of_some") {
            EXPECT_GE(value(1), 8);
            EXPECT_LE(3 * value(2), z);
            EXPECT_GE(form.shape[1] * form.shape[2] / z,
                      1.5 - 2.0 * form.shape[2] / z);  // periods that stand there
          }
          if (id == "unnamed_stairs") {
            EXPECT_LT(value(0), value(1));
            EXPECT_LT(value(1), value(2));
            EXPECT_LE(value(2), z);
          }
          if (id == "unnamed_dent") {
            EXPECT_GE(form.shape[0], 1.0);
            EXPECT_LE(form.shape[0], z);
            EXPECT_LT(4.0 * form.shape[1], z);
          }
        }
      }
      expect_all_differ(all);
      const std::string of_gear = " of " + std::to_string(z);
      expect_counts_between(lengths["unnamed_sector"], 2, z / 2, "sectors" + of_gear);
      expect_counts_between(lengths["unnamed_drift_of_some"], std::max(4, z / 6), 17 * z / 20,
                            "drifts" + of_gear);
      if (heights) {
        expect_counts_between(lengths["unnamed_saw"], 4, z / 2, "saws" + of_gear);
        std::set<int> every;
        for (int n = 2; n <= std::min(loop::kMostOfComb, z / 3); ++n) every.insert(n);
        EXPECT_EQ(lengths["unnamed_comb"], every);
        EXPECT_EQ(flanks.contains("unnamed_dent"), true);
      } else {
        EXPECT_FALSE(flanks.contains("unnamed_comb"));
        EXPECT_FALSE(flanks.contains("unnamed_dent"));
        EXPECT_FALSE(flanks.contains("unnamed_stairs"));
      }
      // what begins at one tooth may begin at any
      std::set<int> teeth;
      for (int tooth = 1; tooth <= z; ++tooth) teeth.insert(tooth);
      for (const char* id :
           {"unnamed_sector", "unnamed_ramp", "unnamed_levelling", "unnamed_drift_of_some"})
        EXPECT_EQ(firsts[id], teeth) << id << of_gear;
      for (const char* id : {"unnamed_sector", "unnamed_ramp"})
        EXPECT_EQ(flanks[id].size(), 3U) << id;
    }
}

TEST(FormsToTry, ListsOfWhatIsReplacedHoldEachOnce) {
  using Sets = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(loop::with_and_without({3, 5, 8}, {5, 8}), (Sets{{3, 5, 8}, {3, 8}, {3, 5}, {3}}));
  EXPECT_EQ(loop::with_and_without({3, 5}, {5}), (Sets{{3, 5}, {3}}));
  EXPECT_EQ(loop::with_and_without({5, 8}, {5, 8}), (Sets{{5, 8}, {8}, {5}}));
  EXPECT_EQ(loop::all_pairs_and_each({2, 4, 7}),
            (Sets{{2, 4, 7}, {2, 4}, {2, 7}, {4, 7}, {2}, {4}, {7}}));
  EXPECT_EQ(loop::all_pairs_and_each({2, 4}), (Sets{{2, 4}, {2}, {4}}));
}

}  // namespace
}  // namespace trueflank::test
