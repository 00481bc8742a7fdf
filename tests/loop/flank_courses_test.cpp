// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/flank_courses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/part/part_model.h"

// Courses over the flanks of a tooth by their definitions, for random ones and for the effects of a
// fit.
namespace trueflank::test {
namespace {

using Eigen::VectorXd;
using loop::Effect;
using loop::FlankChoice;
using loop::Kind;
using loop::kPlaces;

class RandomCourses {
 public:
  /// About its mean, of a random size.
  VectorXd half() {
    VectorXd values(kPlaces);
    for (double& value : values) value = normal_(random_);
    values.array() -= values.mean();
    return std::pow(10.0, 2.0 * normal_(random_)) * values;
  }
  double share() { return std::uniform_real_distribution<double>()(random_); }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};
VectorXd both(const VectorXd& left, const VectorXd& right) {
  VectorXd course(2 * kPlaces);
  course << left, right;
  return course;
}

TEST(FlankCourses, AreEqualOppositeOrNeitherAtAnySize) {
  RandomCourses courses;
  for (int trial = 0; trial < 200; ++trial) {
    const VectorXd one = courses.half(), other = courses.half();
    EXPECT_EQ(loop::kind_of(both(one, one)), Kind::kEqual) << trial;
    EXPECT_EQ(loop::kind_of(both(one, -one)), Kind::kOpposite) << trial;
    EXPECT_EQ(loop::kind_of(both(one, other)), Kind::kNeither) << trial;
    EXPECT_EQ(loop::kind_of(both(one, 1.001 * one)), Kind::kNeither) << trial;
    EXPECT_EQ(loop::kind_of(both(one, -1.001 * one)), Kind::kNeither) << trial;
  }
}

TEST(FlankCourses, AreOfOneFlankWhereTheOtherBendsLessThanAQuarterOfIt) {
  RandomCourses courses;
  for (int trial = 0; trial < 200; ++trial) {
    const VectorXd one = courses.half().normalized(), other = courses.half().normalized();
    const double share = courses.share();
    if (std::abs(share - 0.25) < 1e-6) continue;
    const VectorXd level = VectorXd::Constant(kPlaces, courses.share());
    EXPECT_EQ(loop::is_of_one_flank(both(one + level, share * other)), share < 0.25) << share;
    EXPECT_EQ(loop::is_of_one_flank(both(share * other, one - level)), share < 0.25) << share;
  }
}

TEST(FlankCourses, AreTheSumOfTheirEqualAndTheirOppositePart) {
  RandomCourses courses;
  for (int trial = 0; trial < 100; ++trial) {
    const VectorXd one = courses.half().normalized(),
                   course = both(one, courses.half().normalized());
    const VectorXd equal = loop::part_of_kind(course, Kind::kEqual),
                   opposite = loop::part_of_kind(course, Kind::kOpposite);
    EXPECT_EQ(loop::kind_of(equal), Kind::kEqual);
    EXPECT_EQ(loop::kind_of(opposite), Kind::kOpposite);
    EXPECT_LT((equal + opposite - course).norm(), 1e-12);
    EXPECT_EQ(loop::part_of_kind(course, Kind::kNeither), course);
    const VectorXd of_one = both(one, 0.1 * one);
    for (const Kind kind : {Kind::kEqual, Kind::kOpposite})
      EXPECT_EQ(loop::part_of_kind(of_one, kind), of_one);
  }
}

TEST(FlankCourses, HaveASlowPartOfPolynomialsAndARestThatNoneFollows) {
  RandomCourses courses;
  const VectorXd places = VectorXd::LinSpaced(kPlaces, -1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const VectorXd course = both(courses.half(), courses.half()), slow = loop::slow_part(course);
    const double size = course.norm();
    EXPECT_LT((loop::slow_part(slow) - slow).norm(), 1e-9 * size);
    for (const int first : {0, kPlaces}) {
      const VectorXd rest = (course - slow).segment(first, kPlaces),
                     own = slow.segment(first, kPlaces);
      for (int degree = 0; degree <= 4; ++degree)
        EXPECT_LT(std::abs(rest.dot(places.array().pow(degree).matrix())), 1e-9 * size) << degree;
      // fifth differences of a polynomial of the fourth degree
      VectorXd differences = own;
      for (int k = 0; k < 5; ++k)
        differences =
            (differences.tail(differences.size() - 1) - differences.head(differences.size() - 1))
                .eval();
      EXPECT_LT(differences.norm(), 1e-9 * size);
    }
    EXPECT_GT((course - slow).norm(), 0.1 * size);
  }
}

TEST(FlankCourses, OfAFitAreItsColumnsTimesTheirCoefficients) {
  for (const MadeGear& gear : {spur(20), ring(40), helical(23, 15.0)}) {
    const loop::FlankGeometry geometry = geometry_of(gear);
    loop::MeasuredData data;
    const auto made = [](auto&, const FlankSpot& s, auto&) {
      return 5.0 * s.v * s.side + 3.0 * s.u + 4.0 * (1.0 - s.v * s.v) + 2.0 * s.u * s.u * s.side;
    };
    data.scans.push_back(scan_of(gear, {grown(made)}, scanned(2000, 0.5, 3)));
    loop::PartModel model(geometry, *make_observations(geometry, data, {.aligned = true}), {});
    divide_into_patches(model);
    const auto term = [](double profile, double face, double opposite) {
      return Effect{
          loop::find_family("unnamed"), FlankChoice::kBoth, {profile, face, 0.0, opposite}};
    };
    const std::vector<Effect> effects{term(0.0, 2.0, 0.0),
                                      term(1.0, 0.0, 0.0),
                                      term(0.0, 1.0, 1.0),
                                      term(2.0, 0.0, 1.0),
                                      {loop::find_family("crowning"), FlankChoice::kBoth, {}},
                                      term(0.0, 2.0, 1.0)};
    const loop::PointFit fit(geometry, model.table, model.patches, effects);
    for (const bool face : {false, true}) {
      VectorXd forms = VectorXd::Zero(2 * kPlaces);
      for (std::size_t e = 0; e < effects.size(); ++e) {
        const VectorXd course = course_of(geometry, fit, e, face);
        const VectorXd values = values_along(geometry, fit, e, face);
        for (const int first : {0, kPlaces}) {
          EXPECT_NEAR(course.segment(first, kPlaces).mean(), 0.0, 1e-9);
          const VectorXd own = values.segment(first, kPlaces);
          EXPECT_LT((course.segment(first, kPlaces) - (own.array() - own.mean()).matrix()).norm(),
                    1e-5);
        }
        const bool along =
            (effects[e].family->named ? 1.0 : effects[e].shape[face ? 1 : 0]) > 0.0 &&
            (face || !effects[e].family->named);
        EXPECT_EQ(course.norm() > 0.0, along) << e << face;
        if (along) {
          const Kind kind = effects[e].family->named || effects[e].shape[3] == 0.0
                                ? Kind::kEqual
                                : Kind::kOpposite;
          EXPECT_EQ(loop::kind_of(course), kind) << e;
          for (std::size_t other = 0; other < effects.size(); ++other) {
            const VectorXd along_other = course_of(geometry, fit, other, face);
            if (!(along_other.norm() > 0.0)) continue;
            const double alike = std::abs(course.normalized().dot(along_other.normalized()));
            EXPECT_TRUE(alike < 0.1 || alike > 0.9) << alike;
            EXPECT_EQ(changes_along(geometry, fit, e, along_other, face), alike > 0.9)
                << e << " along " << other;
            if (loop::kind_of(along_other) != kind) {
              EXPECT_LT(alike, 0.1) << e << " along " << other;
            }
          }
        }
        // heights and slopes that are opposite on the two flanks are left out
        const bool is_named = effects[e].family->named;
        const bool bends = !is_named && effects[e].shape[face ? 1 : 0] > 1.0;
        if (!is_named && (effects[e].shape[3] == 0.0 || bends)) forms += values;
      }
      EXPECT_LT((mean_of_forms(geometry, fit, face) - forms).norm(), 1e-6) << face;
    }
  }
}

}  // namespace
}  // namespace trueflank::test
