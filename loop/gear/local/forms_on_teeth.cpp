// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/forms_on_teeth.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {
namespace {

constexpr int kCellsAlong = 60;
using CellsAlong = Eigen::Array<double, kCellsAlong, 1>;

/// Sums of residuals, and how many values, in cells along a flank.
struct OnFlank {
  CellsAlong sum = CellsAlong::Zero(), count = CellsAlong::Zero();
};

double centre_of(int cell) { return (2.0 * cell + 1.0) / kCellsAlong - 1.0; }

/// Takes level, slope and bow out of a course.
void take_out_slow(CellsAlong& sum, const CellsAlong& count) {
  constexpr double kFewest = 8.0;  // cells
  constexpr double kRidge = 1e-9;
  if ((count > 0.0).cast<double>().sum() < kFewest) {
    sum.setZero();
    return;
  }
  Eigen::Matrix<double, kCellsAlong, 3> slow;
  for (int c = 0; c < kCellsAlong; ++c)
    slow.row(c) << 1.0, centre_of(c), centre_of(c) * centre_of(c);
  const Eigen::Matrix<double, kCellsAlong, 3> weighted = count.matrix().asDiagonal() * slow;
  Eigen::Matrix3d normal = slow.transpose() * weighted;
  normal.diagonal().array() += kRidge * normal.trace();
  sum -= (weighted * symmetric_solution(normal, slow.transpose() * sum.matrix())).array();
}

/// Squares that a mean course takes out.
double square_of(const OnFlank& cells) {
  return (cells.count > 0.0)
      .select(cells.sum.square() / cells.count.max(1e-300), CellsAlong::Zero())
      .sum();
}

constexpr double kMostOfAll = 0.55;  // of the teeth: the rest has none of it

struct Run {
  int first = 0, count = 0;
  double square = 0.0;
};

/// The run of teeth whose mean course takes out most.
Run best_run(const std::vector<OnFlank>& teeth) {
  constexpr int kFewest = 2;
  const auto z = static_cast<int>(teeth.size());
  Run best;
  for (int first = 0; first < z; ++first) {
    OnFlank run;
    for (int count = 1; count <= kMostOfAll * z; ++count) {
      const OnFlank& tooth = teeth[static_cast<std::size_t>((first + count - 1) % z)];
      run.sum += tooth.sum;
      run.count += tooth.count;
      if (count < kFewest) continue;
      const double square = square_of(run);
      if (square > best.square) best = {first, count, square};
    }
  }
  return best;
}

/// Squares that one course of all teeth takes out together with one that comes some times per turn:
/// the most of one to three times, less what their more values take out by chance.
double square_around(const std::vector<OnFlank>& teeth, double of_value) {
  constexpr int kMostOrder = 3;
  const auto z = static_cast<int>(teeth.size());
  OnFlank all;
  for (const OnFlank& tooth : teeth) {
    all.sum += tooth.sum;
    all.count += tooth.count;
  }
  double most = 0.0;
  for (int order = 1; order <= kMostOrder; ++order) {
    OnFlank cosine, sine;
    for (int k = 0; k < z; ++k) {
      const OnFlank& tooth = teeth[static_cast<std::size_t>(k)];
      const double c = std::cos(kTwoPi * order * k / z), s = std::sin(kTwoPi * order * k / z);
      cosine.sum += c * tooth.sum;
      cosine.count += c * c * tooth.count;
      sine.sum += s * tooth.sum;
      sine.count += s * s * tooth.count;
    }
    most = std::max(most, square_of(cosine) + square_of(sine) - 2.0 * kCellsAlong * of_value);
  }
  return most + square_of(all) - kCellsAlong * of_value;
}

/// A form along the flank and what it takes out of a course beside level, slope and bow.
struct Tried {
  EffectShape shape;
  double square = 0.0;
};

/// A column of a form, from where along the flank a cell is, 0 to 1.
template <class FormAt>
Eigen::VectorXd column_of(const FormAt& form_at) {
  Eigen::VectorXd column(kCellsAlong);
  for (int c = 0; c < kCellsAlong; ++c) column(c) = form_at(0.5 * (centre_of(c) + 1.0));
  return column;
}

/// Squares that level, slope, bow and a form's columns take out of a course together.
double square_beside_slow(const OnFlank& cells, const std::vector<Eigen::VectorXd>& form) {
  constexpr double kRidge = 1e-9;
  Eigen::MatrixXd columns(kCellsAlong, 3 + static_cast<int>(form.size()));
  for (int c = 0; c < kCellsAlong; ++c)
    columns.row(c).head<3>() << 1.0, centre_of(c), centre_of(c) * centre_of(c);
  for (std::size_t k = 0; k < form.size(); ++k) columns.col(3 + static_cast<int>(k)) = form[k];
  Eigen::MatrixXd normal = columns.transpose() * cells.count.matrix().asDiagonal() * columns;
  normal.diagonal().array() += kRidge * normal.trace();
  const Eigen::VectorXd right = columns.transpose() * cells.sum.matrix();
  return right.dot(symmetric_solution(normal, right));
}

/// What the course of a run looks like: waves, a groove or ridge, a step, a rise towards an end.
std::vector<Effect> forms_like(const FlankGeometry& geometry, const OnFlank& course, int face,
                               FlankChoice flank, bool opposite) {
  constexpr double kMuch = 0.5;  // of what the course has
  constexpr double kFewestWaves = 1.5, kMostWaves = kCellsAlong / 4.0, kStep = 0.1;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const double range_mm = face != 0 ? geometry.face_width_mm() : std::abs(high - low);
  const double least = kMuch * square_of(course);
  const auto place = [&](double share) {
    return face != 0 ? share * range_mm
                     : 2.0 * geometry.on_flank(1, 1, low + share * (high - low), 0.0).radius_mm;
  };
  std::vector<Effect> forms;
  const auto add_best = [&](const char* family, std::vector<Tried> tried, bool has_flanks) {
    const auto best =
        std::max_element(tried.begin(), tried.end(),
                         [](const auto& a, const auto& b) { return a.square < b.square; });
    if (best == tried.end() || !(best->square > least) || (opposite && !has_flanks)) return;
    Effect form{find_family(family), flank, best->shape};
    if (opposite && form.shape.size() < form.family->shape_names.size()) form.shape.push_back(1.0);
    forms.push_back(std::move(form));
  };
  std::vector<Tried> waves, bands, steps, rises;
  for (double n = kFewestWaves; n <= kMostWaves; n += kStep)
    waves.push_back(
        {{double(face), range_mm / n},
         square_beside_slow(course,
                            {column_of([&](double at) { return std::cos(kTwoPi * n * at); }),
                             column_of([&](double at) { return std::sin(kTwoPi * n * at); })})});
  for (const double half : {0.03, 0.05, 0.08, 0.13, 0.2})
    for (double at = 0.05; at < 0.98; at += 0.5 * half)
      bands.push_back({{double(face), place(at), half * range_mm},
                       square_beside_slow(course, {column_of([&](double x) {
                                            return std::exp(-std::pow((x - at) / half, 2));
                                          })})});
  for (double at = 0.1; at < 0.95; at += 0.05)
    steps.push_back(
        {{double(face), place(at), opposite ? 1.0 : 0.0, 0.0},
         square_beside_slow(course, {column_of([&](double x) { return x > at ? 1.0 : 0.0; })})});
  for (const double end : {-1.0, 1.0})
    for (const double within : {0.04, 0.08, 0.15})
      rises.push_back({{double(face), within * range_mm, end},
                       square_beside_slow(course, {column_of([&](double x) {
                                            return std::exp(-(end < 0.0 ? x : 1.0 - x) / within);
                                          })})});
  add_best("unnamed_waviness", std::move(waves), false);
  add_best("unnamed_band", std::move(bands), true);
  add_best("unnamed_step", std::move(steps), true);
  add_best("unnamed_rise", std::move(rises), true);
  return forms;
}

}  // namespace

std::optional<FormOnTeeth> form_on_teeth(const FlankGeometry& geometry, const Observations& table,
                                         const Patches& patches, const std::vector<double>& row_um,
                                         int face) {
  constexpr int kFewestTeeth = 10;
  constexpr double kNearlyAll = 0.9;  // of the teeth
  constexpr double kStandsOut = 8.0;  // standard deviations of what chance takes out
  constexpr double kMostOfIt = 0.6;   // of what teeth have along their flanks
  constexpr double kAsMuch = 0.9;     // as what comes once to three times per turn
  constexpr double kLevel = 5e-4;
  const int z = geometry.teeth();
  if (z < kFewestTeeth) return {};
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  std::array<std::vector<OnFlank>, 2> flanks;  // right, left
  for (auto& of_side : flanks) of_side.resize(static_cast<std::size_t>(z));
  const ObservationKind trace = face != 0 ? ObservationKind::kHelix : ObservationKind::kProfile;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if ((row.kind != trace && row.kind != ObservationKind::kScanFlank) || row.places != 1 ||
        patches.patch_of_row[i] < 0 || !std::isfinite(row_um[i]))
      continue;
    const Place& place = table.place(row);
    if (place.surface != Surface::kFlank) continue;
    const double share =
        face != 0 ? place.z_mm / geometry.face_width_mm() : (place.roll_mm - low) / (high - low);
    const int cell = std::clamp(static_cast<int>(share * kCellsAlong), 0, kCellsAlong - 1);
    OnFlank& flank =
        flanks[place.side > 0 ? 1 : 0][static_cast<std::size_t>((place.tooth - 1 + z) % z)];
    flank.sum[cell] += row_um[i];
    flank.count[cell] += 1.0;
  }
  double all = 0.0, cells = 0.0;
  int measured = 0;
  std::vector<double> of_cell;  // of every flank
  for (auto& of_side : flanks)
    for (OnFlank& flank : of_side) {
      const double own = (flank.count > 0.0).cast<double>().sum() - 3.0;
      take_out_slow(flank.sum, flank.count);
      if (!(own > 3.0)) continue;
      ++measured;
      all += square_of(flank);
      cells += own;
      of_cell.push_back(square_of(flank) / own);
    }
  if (measured < kNearlyAll * 2.0 * z) return {};
  std::nth_element(of_cell.begin(),
                   of_cell.begin() + static_cast<std::ptrdiff_t>(of_cell.size() / 4),
                   of_cell.end());
  const double quiet = of_cell[of_cell.size() / 4];
  const std::array<FlankChoice, 4> choices{FlankChoice::kBoth, FlankChoice::kBoth,
                                           flank_choice(geometry, 1), flank_choice(geometry, 0)};
  std::optional<FormOnTeeth> found;
  double most = 0.0;
  std::vector<OnFlank> teeth_of_best;
  Run run;
  for (std::size_t choice = 0; choice < choices.size(); ++choice) {
    const double right = choice == 2   ? 0.0
                         : choice == 1 ? -1.0
                                       : 1.0,
                 left = choice == 3 ? 0.0 : 1.0;
    std::vector<OnFlank> teeth(static_cast<std::size_t>(z));
    for (std::size_t k = 0; k < teeth.size(); ++k) {
      teeth[k].sum = right * flanks[0][k].sum + left * flanks[1][k].sum;
      teeth[k].count = std::abs(right) * flanks[0][k].count + left * flanks[1][k].count;
    }
    const Run best = best_run(teeth);
    if (!(best.square > most)) continue;
    most = best.square;
    run = best;
    found = FormOnTeeth{.flank = choices[choice],
                        .opposite = choice == 1,
                        .first = best.first + 1,
                        .count = best.count};
    teeth_of_best = std::move(teeth);
  }
  if (!found) return {};
  const double of_value = std::max(quiet, (all - run.square) / std::max(1.0, cells - kCellsAlong));
  const double by_chance = kCellsAlong * of_value;
  if (run.square - by_chance < kStandsOut * of_value * std::sqrt(2.0 * kCellsAlong)) return {};
  // (one flank alone has half of the cells)
  if (run.square - kCellsAlong * quiet < kMostOfIt * (all - cells * quiet)) return {};
  if (run.square - by_chance < kAsMuch * square_around(teeth_of_best, of_value)) return {};
  // Were every flank's course its own, the mean of a run would take out as much as one of them has.
  // By how much flanks beside the run differ in that says of how many degrees of freedom it is.
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const auto& of_side : flanks)
    for (int k = run.count; k < z; ++k) {
      const double own = square_of(of_side[static_cast<std::size_t>((run.first + k) % z)]);
      sum += own;
      squares += own * own;
      count += 1.0;
    }
  const double variance = squares / count - std::pow(sum / count, 2);
  const double degrees =
      std::clamp(std::pow(sum / count, 2) / std::max(1e-300, variance), 1.0, 8.0);
  const double of_flank = (all - run.square) / (measured - 1.0);
  const double runs = static_cast<double>(choices.size()) * z * kMostOfAll * z;
  found->p_value = std::min(1.0, runs * f_tail(run.square / std::max(1e-300, of_flank), degrees,
                                               degrees * (measured - 1.0)));
  if (found->p_value > kLevel) return {};
  OnFlank course;
  for (int k = 0; k < run.count; ++k) {
    const OnFlank& tooth = teeth_of_best[static_cast<std::size_t>((run.first + k) % z)];
    course.sum += tooth.sum;
    course.count += tooth.count;
  }
  for (Effect& form : forms_like(geometry, course, face, found->flank, found->opposite)) {
    form.family = gear_effects::of_teeth(form);
    form.shape.insert(form.shape.begin(), {double(found->first), double(found->count), 0.0});
    found->forms.push_back(std::move(form));
  }
  if (found->forms.empty()) return {};
  return found;
}

}  // namespace trueflank::loop
