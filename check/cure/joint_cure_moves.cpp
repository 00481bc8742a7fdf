// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/cure/joint_cure_moves.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/cure/shortened_tips.h"
#include "trueflank/check/planet_spacing.h"

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

/// More or fewer planets: where far too many are asked for, as many as fit about.
std::vector<int> planet_steps(const GearTrain& train) {
  constexpr int kFewer = 2;
  int over = 0;
  for (std::size_t i = 0; i < train.gears.size(); ++i)
    if (train.topology().is_planet_gear(i))
      over = std::max(over, train.design.planets - most_planets(train.centre_distance_mm,
                                                                train.gears[i].profile.tip_radius_mm()));
  if (over <= kFewer) return {0, -1, 1, -kFewer};
  return {1 - over, -over, -over - 1};
}

/// How far the centre distance is from that of a mesh without shifts, in modules.
double to_reference(const GearTrain& train, const TrainMesh& mesh) {
  return (reference_centre_distance_mm(mesh_teeth(train.pair(mesh))) - train.centre_distance_mm) /
         train.design.module_mm;
}

/// Modules.
std::vector<double> distance_moves(const GearTrain& train) {
  std::vector<double> moves{0.0, 0.05, -0.05, 0.1, -0.1, 0.2, -0.2, 0.35, -0.35, kFarCentreDistance, -kFarCentreDistance};
  for (const TrainMesh& mesh : train.meshes) {
    const double there = to_reference(train, mesh);
    for (const double move : {there, 0.5 * there})
      if (std::abs(move) > kFarCentreDistance) moves.push_back(move);
  }
  return moves;
}

}  // namespace

std::vector<DesignChange> common_moves(const GearTrain& train) {
  std::vector<DesignChange> moves;
  for (const double distance : distance_moves(train))
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

const std::vector<double>& coarse_shift_moves() {
  static const std::vector<double> moves{0.0, 0.1, -0.1, 0.2, -0.2, 0.4, -0.4, 0.7, -0.7, 1.0, -1.0};
  return moves;
}

std::vector<DesignChange> teeth_moves(const GearTrain& train) {
  std::vector<DesignChange> moves;
  for (const int planets : planet_steps(train)) {
    if (planets != 0 && (train.design.planets < 2 || train.design.planets + planets < 2)) continue;
    std::vector<int> steps(train.design.gears.size(), 0);
    add_teeth(train, steps, 0, steps.size() > 3 ? 4 : 6, planets, moves);
  }
  if (train.design.planets < 2) {  // few teeth of a pair need room for shifts as well
    const std::vector<DesignChange> at_their_distance = moves;
    for (const double wider : {0.2, 0.4})
      for (DesignChange move : at_their_distance) {
        move.centre_distance = wider;
        moves.push_back(std::move(move));
      }
  }
  sort_by_cost(moves);
  const double there = to_reference(train, train.meshes.front());
  if (std::abs(there) <= kFarCentreDistance) return moves;
  // in turns: at the distance there is, and at the one the teeth ask for
  std::vector<DesignChange> both;
  for (const DesignChange& move : moves) {
    both.push_back(move);
    both.push_back(move);
    both.back().centre_distance = there;
  }
  return both;
}

bool planets_collide(const GearTrain& laid) {
  if (laid.design.planets < 2) return false;
  const double room = laid.centre_distance_mm * std::sin(kPi / laid.design.planets);
  for (std::size_t i = 0; i < laid.gears.size(); ++i)
    if (laid.topology().is_planet_gear(i) &&
        laid.gears[i].profile.tip_radius_mm() - room > kMostShortenedTip * laid.design.module_mm)
      return true;
  return false;
}

}  // namespace trueflank
