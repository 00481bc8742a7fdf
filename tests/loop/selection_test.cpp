// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/loop/discovery_problems.h"
#include "trueflank/loop/discovery/discovery.h"

// How the engine chooses among candidates, on problems whose answer is known by hand: groups of one
// column, A and B independent, others made of them. W is the chi-square of a column of unit
// variance over the folds; losses of up to a half are nothing to the engine whatever they are made
// of.
namespace trueflank::loop {
namespace {

constexpr int kA = 0, kB = 3, kC = 6, kD = 9;

/// Values a A + b B, nearly without noise.
class Problem {
 public:
  explicit Problem(double a, double b, double chi_square_of_column, unsigned seed = 21)
      : problem(test::made_problem(seed, false)) {
    std::mt19937 random(seed + 100);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < 120; ++i) {
      problem.unit[i] = static_cast<int>(i) / 3;
      problem.fold[i] = 1 + static_cast<int>(i) % 4;
    }
    // at right angles to each other and alike in every fold
    std::vector<Eigen::VectorXd> basis;
    for (const int g : {kA, kB, kC, kD}) {
      Eigen::VectorXd own = column(g).cast<double>();
      for (int fold = 1; fold <= 4; ++fold) {
        std::vector<int> rows;
        for (int i = 0; i < 120; ++i)
          if (problem.fold[static_cast<std::size_t>(i)] == fold) rows.push_back(i);
        Eigen::VectorXd part = own(rows);
        for (const Eigen::VectorXd& other : basis)
          part -= part.dot(other(rows)) / other(rows).squaredNorm() * Eigen::VectorXd(other(rows));
        own(rows) = part * std::sqrt(30.0 / part.squaredNorm());
      }
      basis.push_back(own);
      column(g) = own.cast<float>();
    }
    problem.nuisance.setOnes(120, 1);
    problem.weight.setConstant(120, chi_square_of_column / 120.0);
    problem.value = Eigen::VectorXd::NullaryExpr(120, [&] { return 1e-3 * normal(random); });
    problem.value += a * basis[0] + b * basis[1];
  }
  [[nodiscard]] Eigen::Block<CandidateMatrix, Eigen::Dynamic, 1> column(int group) {
    return problem.candidates.col(problem.groups[static_cast<std::size_t>(group)].first_column);
  }
  [[nodiscard]] CandidateGroup& group(int g) { return problem.groups[static_cast<std::size_t>(g)]; }
  [[nodiscard]] std::vector<int> chosen(int most = 12) const {
    std::vector<int> groups;
    for (const ChosenGroup& c : discover(problem, {.flips = 199, .most_effects = most}).chosen)
      groups.push_back(c.group);
    std::sort(groups.begin(), groups.end());
    return groups;
  }

  DiscoveryProblem problem;
};

using Groups = std::vector<int>;

/// C is A + B. It explains all but 0.08 W of A + 0.6 B, A alone all but 0.36 W. Where 0.28 W is
/// nothing and 0.36 W is something, A is chosen as it is simpler, then B, and C is as good as both.
Problem of_two_that_are_one() {
  Problem p(1.0, 0.6, 1.58);
  p.column(kC) = p.column(kA) + p.column(kB);
  p.group(kC).complexity = 1.0;
  return p;
}

TEST(Selection, TwoThatOneDoesAsWellAreMergedIntoIt) {
  Problem p = of_two_that_are_one();
  EXPECT_EQ(p.chosen(1), Groups{kA});
  EXPECT_EQ(p.chosen(), Groups{kC});
}

TEST(Selection, TwoAreNotMergedIntoOneThatIsLessPreferredThanEither) {
  Problem p = of_two_that_are_one();
  p.group(kC).preference = 1;
  EXPECT_EQ(p.chosen(), (Groups{kA, kB}));
  p.group(kB).preference = 1;
  EXPECT_EQ(p.chosen(), (Groups{kA, kB}));
  // but a name may be so for another name and what has none
  p.group(kB).named = false;
  EXPECT_EQ(p.chosen(), Groups{kC});
  p.group(kC).named = false;
  EXPECT_EQ(p.chosen(), (Groups{kA, kB}));
}

TEST(Selection, TwoAreNotMergedWhereThatLosesMoreThanNothing) {
  Problem p(1.0, 0.6, 8.0);  // 0.64 is lost
  p.column(kC) = p.column(kA) + p.column(kB);
  p.group(kC).preference = 1;
  p.group(kA).preference = p.group(kB).preference = 1;
  const Groups found = p.chosen();
  EXPECT_EQ(found.size(), 2U);
}

TEST(Selection, WhatIsIdleBesideLaterOnesIsRemoved) {
  // D is chosen first, then A and B, which say all that it says
  Problem p(1.0, 1.0, 400.0);
  p.column(kD) = p.column(kA) + p.column(kB) + 1.2f * p.column(kD);
  EXPECT_EQ(p.chosen(1), Groups{kD});
  EXPECT_EQ(p.chosen(), (Groups{kA, kB}));
}

// What is on one place alone is no effect that could be idle; what stands behind it may be.
TEST(Selection, WhatIsIdleIsRemovedBehindWhatIsOnOnePlaceAlone) {
  constexpr int kLocal = 15;
  Problem p(1.0, 1.0, 400.0);
  p.column(kD) = p.column(kA) + p.column(kB) + 1.2f * p.column(kD);
  p.problem.value += 40.0 * p.column(kLocal).cast<double>();
  EXPECT_EQ(p.chosen(1), Groups{kLocal});
  EXPECT_EQ(p.chosen(2), (Groups{kD, kLocal}));
  EXPECT_EQ(p.chosen(), (Groups{kA, kB, kLocal}));
}

TEST(Selection, WhatAnotherPredictsBetterIsReplaced) {
  Problem p(1.0, 1.0, 400.0);
  p.column(kD) = p.column(kA) + p.column(kB) + 1.2f * p.column(kD);
  EXPECT_EQ(p.chosen(2), (Groups{kA, kB}));
}

TEST(Selection, AnEffectIsReplacedByItselfAtAnotherShape) {
  for (const int kin : {0, 1}) {
    Problem p(1.0, 1.0, 400.0);
    p.column(kD) = p.column(kA) + p.column(kB) + 1.2f * p.column(kD);
    p.group(kD).kin = p.group(kB).kin = kin;  // B does not enter beside D
    EXPECT_EQ(p.chosen(), (Groups{kA, kB}));
    EXPECT_EQ(p.chosen(1), Groups{kD});
  }
}

TEST(Selection, OfEquallyGoodOnesPreferenceThenColumnsThenSimplicityThenGainThenOrderDecide) {
  const auto twins = [] {
    Problem p(1.0, 0.0, 400.0);
    p.column(kC) = p.column(kA);
    return p;
  };
  EXPECT_EQ(twins().chosen(), Groups{kA});  // the first of the list
  Problem complex = twins();
  complex.group(kA).complexity = 1.0;
  EXPECT_EQ(complex.chosen(), Groups{kC});
  Problem wide = twins();  // group 4 has two columns, the first of which is enough
  wide.column(kA) = wide.column(kD);
  wide.column(4) = wide.column(kC);
  wide.group(kC).complexity = 1.0;
  EXPECT_EQ(wide.chosen(), Groups{kC});
  wide.group(4).preference = -1;
  EXPECT_EQ(wide.chosen(), Groups{4});
  Problem better(1.0, 0.0, 4.0);  // what gains more by less than nothing
  better.column(kC) = better.column(kA);
  better.column(kA) += 0.2f * better.column(kD);
  EXPECT_EQ(better.chosen(), Groups{kC});
}

TEST(Selection, WhatDoesTheSameButForATenthOfTheGainIsConfounded) {
  Problem p(1.0, 0.0, 0.9);
  p.column(kC) = p.column(kA) + 0.25f * p.column(kC);  // leaves 1 / 17
  p.column(kD) = p.column(kA) + 0.4f * p.column(kD);   // leaves 4 / 29
  const DiscoveryResult found = discover(p.problem, {.flips = 99});
  ASSERT_EQ(found.chosen.size(), 1U);
  EXPECT_EQ(found.chosen[0].group, kA);
  EXPECT_EQ(found.chosen[0].confounded, Groups{kC});
  EXPECT_NEAR(found.chosen[0].gain, 1.0, 0.05);
}

TEST(Selection, AnAnchorTellsTwoApartWhereItsErrorIsLarge) {
  // A and C are alike but for four values of known error, which are as A says
  for (const double off : {1.9, 2.1}) {
    Problem p(1.0, 0.0, 4000.0);
    p.column(kC) = p.column(kA);
    p.problem.anchor_fold = 5;
    for (const int i : {10, 60}) {
      const auto row = static_cast<std::size_t>(i);
      p.problem.fold[row] = 5;
      p.problem.weight[i] = 0.5;
      p.column(kC)[i] += static_cast<float>(off);
    }
    p.group(kC).preference = -1;
    EXPECT_EQ(p.chosen(), Groups{off < 2.0 ? kC : kA}) << off;
  }
}

}  // namespace
}  // namespace trueflank::loop
