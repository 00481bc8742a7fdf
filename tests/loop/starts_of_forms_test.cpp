// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/loop/effects_on_grid.h"
#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/part/forms_to_try.h"

// A form is found from a start that it is like: whatever its place and its widths, there is one.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::EffectShape;
using loop::FlankChoice;

class StartsOfForms : public ::testing::Test {
 protected:
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double place(double face, double from, double to) {
    return loop::gear_effects::place_at(geometry_, face, any(from, to));
  }
  [[nodiscard]] double range_mm(double face) const {
    return face != 0.0 ? geometry_.face_width_mm()
                       : geometry_.tip_form_roll_mm() - geometry_.root_form_roll_mm();
  }
  /// Cosine of the angle between what two effects do, each with the amounts that bring them
  /// nearest.
  static double likeness(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    const auto centred_unit = [](const Eigen::MatrixXd& m) {
      const Eigen::VectorXd column = m.col(0).array() - m.col(0).mean();
      return Eigen::VectorXd(column / column.norm());
    };
    return std::abs(centred_unit(a).dot(centred_unit(b)));
  }
  /// Each form of a random shape is at least so like a start.
  void expect_start(const std::vector<Effect>& starts, const char* family, double least,
                    const std::function<EffectShape()>& shape, bool same_on_teeth = false) {
    const int places = same_on_teeth ? 33 : 5, teeth = same_on_teeth ? 1 : geometry_.teeth();
    const auto values_of = [&](const Effect& effect) {
      return on_grid(geometry_, effect, places, teeth);
    };
    std::vector<Eigen::MatrixXd> known;
    for (const Effect& start : starts)
      if (start.family == loop::find_family(family)) known.push_back(values_of(start));
    constexpr int kDraws = 60;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Effect effect{loop::find_family(family), FlankChoice::kBoth, shape()};
      const Eigen::MatrixXd form = values_of(effect);
      double most = 0.0;
      for (const Eigen::MatrixXd& start : known) most = std::max(most, likeness(form, start));
      EXPECT_GE(most, least) << family << " " << ::testing::PrintToString(effect.shape);
    }
  }

  MadeGear gear_ = spur(20);
  loop::FlankGeometry geometry_ = geometry_of(gear_);
  std::mt19937_64 random_{3};
};

TEST_F(StartsOfForms, AlongTheFlanksHaveAStartThatIsLikeThem) {
  for (const double face : {0.0, 1.0}) {
    const auto forms = loop::forms_along(geometry_, face, FlankChoice::kBoth, true);
    const double range = range_mm(face);
    for (const double end : {-1.0, 1.0}) {
      expect_start(
          forms, "unnamed_rise", 0.96,
          [&] {
            return EffectShape{face, any(0.06, 0.35) * range, end};
          },
          true);
      expect_start(
          forms, "unnamed_kink", 0.96,
          [&] {
            return EffectShape{face, place(face, 0.1, 0.9), end};
          },
          true);
      expect_start(
          forms, "unnamed_bend", 0.95,
          [&] {
            return EffectShape{face, place(face, 0.1, 0.9), end};
          },
          true);
    }
    expect_start(
        forms, "unnamed_rise", 0.96,
        [&] {
          return EffectShape{face, any(0.06, 0.2) * range, 0.0};
        },
        true);
    expect_start(
        forms, "unnamed_band", 0.89,
        [&] {
          return EffectShape{face, place(face, 0.1, 0.9), any(0.12, 0.4) * range};
        },
        true);
    expect_start(
        forms, "unnamed_strip", 0.88,
        [&] {
          const double from = any(0.1, 0.6);
          const double to = from + any(0.15, 0.9 - from);
          return EffectShape{face, loop::gear_effects::place_at(geometry_, face, from),
                             loop::gear_effects::place_at(geometry_, face, to), 0.03 * range};
        },
        true);
    expect_start(
        loop::sags_along(geometry_, face, FlankChoice::kBoth), "unnamed_sag", 0.97,
        [&] {
          return EffectShape{face, place(face, 0.34, 0.66)};
        },
        true);
    expect_start(
        loop::steps_along(geometry_, face, FlankChoice::kBoth), "unnamed_step", 0.87,
        [&] {
          return EffectShape{face, place(face, 0.1, 0.9), 0.0, 0.0};
        },
        true);
  }
  expect_start(
      loop::dishes(geometry_, FlankChoice::kBoth, "unnamed_dish"), "unnamed_dish", 0.88,
      [&] {
        return EffectShape{place(0.0, 0.15, 0.85), any(0.15, 0.85) * range_mm(1.0),
                           any(0.2, 0.45) * range_mm(0.0), any(0.2, 0.45) * range_mm(1.0)};
      },
      true);
  expect_start(
      loop::corners(geometry_, FlankChoice::kBoth), "unnamed_corner", 0.98,
      [&] {
        return EffectShape{double(whole(0, 1)), double(whole(0, 1)), any(0.3, 1.1) * range_mm(0.0),
                           any(0.3, 1.1) * range_mm(1.0), any(1.1, 2.0)};
      },
      true);
}

TEST_F(StartsOfForms, AroundTheGearHaveAStartThatIsLikeThem) {
  const int z = geometry_.teeth();
  const auto swellings = loop::swellings_around(z, FlankChoice::kBoth);
  expect_start(swellings, "unnamed_swellings", 0.92, [&] {
    const int number = whole(2, loop::kMostSwellings);
    const double apart = static_cast<double>(z) / number;
    return EffectShape{double(number), any(1.0, 1.0 + apart),
                       any(0.7, std::max(0.75, 0.38 * apart))};
  });
  for (const int number : {1, 2, 3}) {
    const double apart = 360.0 / number;
    expect_start(loop::swellings_at_ends(geometry_, number), "unnamed_swellings_at_end", 0.9, [&] {
      return EffectShape{double(number), any(0.0, apart),
                         any(std::max(10.0, 0.1 * apart), 0.35 * apart), 2.0 * whole(0, 1) - 1.0,
                         any(0.08, 0.18) * range_mm(1.0)};
    });
  }
  std::vector<Effect> all;
  for (const auto& set : loop::forms_from_tooth_to_tooth(z, {}))
    for (const Effect& form : set)
      if (form.flank == FlankChoice::kBoth) all.push_back(form);
  const auto first = [&] { return double(whole(1, z)); };
  const auto opposite = [&] { return double(whole(0, 1)); };
  expect_start(all, "unnamed_sector", 0.999, [&] {
    return EffectShape{first(), double(whole(2, z / 2)), 0.0, 0.0, opposite()};
  });
  expect_start(all, "unnamed_ramp", 0.999, [&] {
    return EffectShape{first(), 0.0, 0.0, opposite(), 0.0};
  });
  expect_start(all, "unnamed_levelling", 0.98, [&] {
    return EffectShape{first(), 0.0, 0.0, opposite(), opposite(), any(0.06, 0.5) * z, 0.0};
  });
  expect_start(all, "unnamed_broken_wave", 0.86, [&] {
    return EffectShape{any(0.5, 3.5), first(), opposite()};
  });
  expect_start(all, "unnamed_saw", 0.999, [&] {
    const int every = whole(4, z / 2);
    return EffectShape{
        double(every), double(whole(1, z % every == 0 ? every : z)), 0.0, 0.0, opposite(), 0.0};
  });
  expect_start(all, "unnamed_comb", 0.999, [&] {
    const int every = whole(2, 6);
    return EffectShape{double(every), double(whole(1, every)), 0.0, 0.0, opposite()};
  });
  expect_start(all, "unnamed_dent", 0.97, [&] {
    return EffectShape{any(1.0, z), any(1.0, 4.5), 0.0, 0.0};
  });
  expect_start(all, "unnamed_drift_of_some", 0.99, [&] {
    return EffectShape{first(), double(whole(4, 17 * z / 20)), 0.0, 0.0, opposite(), opposite()};
  });
  expect_start(all, "unnamed_stairs", 0.66, [&] {
    const int a = whole(1, z - 6), b = whole(a + 2, z - 3),
              c = whole(b + 2, std::min(z, z + a - 2));
    return EffectShape{double(a), double(b), double(c), opposite()};
  });
}

}  // namespace
}  // namespace trueflank::test
