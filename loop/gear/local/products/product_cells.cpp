// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/products/product_cells.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank::loop::product_cells {

std::vector<CourseInCells> in_cells(const FlankGeometry& g, double face) {
  const double low = face != 0.0 ? 0.0 : g.root_form_roll_mm(),
               high = face != 0.0 ? g.face_width_mm() : g.tip_form_roll_mm();
  std::vector<CourseInCells> courses;
  for (const FlankCourse& course : gear_effects::courses_over(g, face)) {
    CourseInCells one{course};
    for (int i = 0; i < kProductCells; ++i)
      one.values[static_cast<std::size_t>(i)] =
          course.value(g, face, low + (i + 0.5) / kProductCells * (high - low));
    courses.push_back(one);
  }
  return courses;
}

std::array<FlankWay, 4> flank_ways(const FlankGeometry& g) {
  const bool left_first = flank_side(Flank::kLeft, g.gear().kind) < 0;
  const double first = left_first ? 1.0 : 0.0;
  return {{{FlankChoice::kBoth, false, {1.0, 1.0}},
           {FlankChoice::kBoth, true, {-1.0, 1.0}},
           {FlankChoice::kLeft, false, {first, 1.0 - first}},
           {FlankChoice::kRight, false, {1.0 - first, first}}}};
}

namespace {

void add_combs(const FlankGeometry& g, std::vector<AroundCourse>& courses) {
  constexpr int kMostOfComb = 12, kFewestTeeth = 3;
  for (int every = 2; every <= std::min(kMostOfComb, g.teeth() / kFewestTeeth); ++every)
    for (int first = 1; first <= every; ++first)
      courses.push_back(AroundCourse::comb(g, every, first));
}

void set_values(const FlankGeometry& g, Arounds& all) {
  all.on_teeth.resize(std::ssize(all.courses), g.teeth());
  for (Eigen::Index i = 0; i < all.on_teeth.rows(); ++i)
    for (int tooth = 1; tooth <= g.teeth(); ++tooth)
      all.on_teeth(i, tooth - 1) = all.courses[static_cast<std::size_t>(i)].value(g, tooth);
  all.squares = all.on_teeth.cwiseAbs2();
  all.beside_free_form = all.beside_motions = Eigen::ArrayXd::Ones(all.on_teeth.rows());
}

}  // namespace

Arounds combs_around(const FlankGeometry& g) {
  Arounds all;
  add_combs(g, all.courses);
  set_values(g, all);
  return all;
}

Arounds arounds_of(const FlankGeometry& g) {
  constexpr int kFewest = 24, kMost = 96;
  const int directions = std::clamp(g.teeth(), kFewest, kMost);
  Arounds all;
  for (AroundCourse course : gear_effects::courses_around(g)) {
    const double period_deg = course.kind == AroundCourse::kWave ? course.half_deg : 360.0;
    for (int d = 0; d < directions && d * 360.0 / directions < period_deg; ++d) {
      course.towards_deg = d * 360.0 / directions;
      all.courses.push_back(course);
    }
  }
  add_combs(g, all.courses);
  set_values(g, all);
  for (Eigen::Index i = 0; i < all.on_teeth.rows(); ++i) {
    const AroundCourse& course = all.courses[static_cast<std::size_t>(i)];
    // (one tooth in so many that leans or is bowed: unnamed_comb)
    if (course.is_of_free_form() || course.kind == AroundCourse::kComb)
      all.beside_free_form[i] = 0.0;
    if (course.kind == AroundCourse::kWave && course.half_deg == 180.0) all.beside_motions[i] = 0.0;
  }
  return all;
}

OfTeeth sums_of(const FlankGeometry& g, const Observations& table, const Patches& patches,
                const std::vector<float>& row_um) {
  OfTeeth teeth(static_cast<std::size_t>(g.teeth()));
  const auto cell = [](double coordinate) {
    return static_cast<std::size_t>(part_of(coordinate, kProductCells));
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const bool scan = row.kind == ObservationKind::kScanFlank;
    if ((!scan && row.kind != ObservationKind::kProfile && row.kind != ObservationKind::kHelix) ||
        row.places != 1 || patches.patch_of_row[i] < 0 || !std::isfinite(row_um[i]))
      continue;
    const Place& place = table.place(row);
    if (place.surface != Surface::kFlank) continue;
    OfFlank& flank = teeth[static_cast<std::size_t>(place.tooth - 1)][place.side > 0 ? 1 : 0];
    const std::size_t u = cell(g.profile_coordinate(place.roll_mm)),
                      v = cell(g.face_coordinate(place.z_mm));
    const Sum one{1.0, row_um[i]};
    flank.square += one.value * one.value;
    if (row.kind != ObservationKind::kHelix) flank.profile[u] += one;
    if (row.kind != ObservationKind::kProfile) flank.face[v] += one;
    if (scan) flank.both[u][v] += one;
  }
  return teeth;
}

}  // namespace trueflank::loop::product_cells
