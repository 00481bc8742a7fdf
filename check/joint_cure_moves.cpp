// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/joint_cure_moves.h"

#include <algorithm>

namespace trueflank {
namespace {

constexpr int kMostTeeth = 3;  // more or less, of each gear

void sort_by_cost(std::vector<DesignChange>& moves) {
  std::stable_sort(moves.begin(), moves.end(),
                   [](const DesignChange& a, const DesignChange& b) { return a.cost() < b.cost(); });
}

/// All counts within the range whose sum of steps is small.
void add_teeth(const GearTrain& train, std::vector<int>& steps, std::size_t gear, int left, int planets,
               std::vector<DesignChange>& moves) {
  if (gear == steps.size()) {
    DesignChange move;
    const bool any = std::any_of(steps.begin(), steps.end(), [](int s) { return s != 0; });
    if (any) move.teeth = steps;
    move.planets = planets;
    if (any || planets != 0) moves.push_back(move);
    return;
  }
  for (int step = -std::min(left, kMostTeeth); step <= std::min(left, kMostTeeth); ++step) {
    if (train.design.gears[gear].teeth + step < 5) continue;
    steps[gear] = step;
    add_teeth(train, steps, gear + 1, left - std::abs(step), planets, moves);
  }
  steps[gear] = 0;
}

}  // namespace

std::vector<DesignChange> common_moves() {
  std::vector<DesignChange> moves;
  for (const double distance : {0.0, 0.05, -0.05, 0.1, -0.1, 0.2, -0.2, 0.35, -0.35, 0.5, -0.5})
    for (const double backlash : {0.0, 0.03, 0.08})
      for (const double root : {0.0, -0.1, -0.18, -0.28})
        for (const double addendum : {0.0, -0.1, -0.2, -0.3}) {
          DesignChange move;
          move.centre_distance = distance;
          move.backlash = backlash;
          move.root_radius = root;
          move.addendum = addendum;
          moves.push_back(move);
        }
  sort_by_cost(moves);
  return moves;
}

const std::vector<double>& shift_moves() {
  static const std::vector<double> moves{0.0, 0.05, -0.05, 0.1, -0.1, 0.15, -0.15, 0.2,  -0.2, 0.3,
                                         -0.3, 0.4, -0.4,  0.5, -0.5, 0.7,  -0.7,  1.0, -1.0};
  return moves;
}

std::vector<DesignChange> teeth_moves(const GearTrain& train) {
  std::vector<DesignChange> moves;
  for (const int planets : {0, -1, 1}) {
    if (planets != 0 && (train.design.planets < 2 || train.design.planets + planets < 2)) continue;
    std::vector<int> steps(train.design.gears.size(), 0);
    add_teeth(train, steps, 0, steps.size() > 3 ? 4 : 6, planets, moves);
  }
  sort_by_cost(moves);
  return moves;
}

}  // namespace trueflank
