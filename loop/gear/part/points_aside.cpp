// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/points_aside.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/finite_displacement.h"
#include "trueflank/loop/gear/local/second_place.h"
#include "trueflank/loop/gear/part/choice.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {
namespace {

/// By how much effects move all teeth alike, along x and y [um].
std::array<double, 2> moved_alike_um(const PointFit& fit) {
  std::array<double, 2> moved{};
  for (std::size_t e = 0; e < fit.effects().size(); ++e)
    if (moves_the_teeth(fit.effects()[e]))
      for (const std::size_t k : {0U, 1U})
        moved[k] += fit.coefficients()[fit.first_column(static_cast<int>(e)) + static_cast<int>(k)];
  return moved;
}

/// The points that are not where they belong: of aligned scans those further from the gear's axis,
/// of others the fewer ones.
void make_the_others_stay(SecondPlace& found, const PartModel& model, const PointFit& fit) {
  const std::vector<bool>& free = model.table->pose_is_free;
  const bool aligned = std::find(free.begin(), free.end(), true) == free.end();
  const std::array<double, 2> moved = moved_alike_um(fit);
  const auto off = [&](const std::array<double, 2>& um) {
    return std::hypot(um[0] + moved[0], um[1] + moved[1]);
  };
  if (aligned ? off(found.these_um) >= off(found.others_um) : found.share <= 0.5) return;
  std::vector<std::size_t> others;
  auto known = found.rows.begin();
  for (std::size_t i = 0; i < model.table->points_mm.size(); ++i) {
    if (known != found.rows.end() && *known == i)
      ++known;
    else if (model.table->rows[i].kind == ObservationKind::kScanFlank)
      others.push_back(i);
  }
  found.rows = std::move(others);
  found.share = 1.0 - found.share;
  std::swap(found.these_um, found.others_um);
}

}  // namespace

std::optional<RemainderFinding> explain_without_points_aside(PartModel& model) {
  if (model.options.joined || model.options.names_only || model.table->points_mm.empty() ||
      is_rounding(model))
    return {};
  const auto fit = fit_of(model, model.effects);
  std::optional<SecondPlace> found =
      second_place(model.geometry, model.table, model.patches, *fit->residuals_um());
  if (!found) return {};
  make_the_others_stay(*found, model, *fit);
  const double x_um = found->these_um[0] - found->others_um[0],
               y_um = found->these_um[1] - found->others_um[1], um = std::hypot(x_um, y_um);
  PartOptions options = model.options;
  options.given.resize(first_told_here(model));
  SharedTable measured = model.table;
  move_points(model.geometry, found->rows, {-mm_from_um(x_um), -mm_from_um(y_um), 0.0},
              measured.own());
  PartModel other(model.geometry, std::move(measured), std::move(options));
  explain_part(other);
  model.remainder = std::move(other.remainder);
  model.alone = std::move(other.alone);
  take_over(model, other);
  return RemainderFinding{
      .p_value = found->p_value,
      .text = printed("%.0f %% of the points stand %.3g um aside ", 100.0 * found->share, um) +
              gear_effects::towards(deg_from_rad(std::atan2(y_um, x_um))) +
              ", at random among the others, as where two scans that do not fit were laid over "
              "each other (they were moved back, and all else is told without that)",
      .amount_um = um};
}

}  // namespace trueflank::loop
