// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/iso_1328.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;

/// Slope, form and total deviation of a trace over its evaluated length (the outermost parts left out).
struct TraceDeviations {
  double slope = kNaN, form = kNaN, total = kNaN;
};

TraceDeviations deviations_of(const std::array<double, kParts>& trace) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 1; i < kParts - 1; ++i) {
    if (std::isnan(trace[i])) continue;
    const double x = (2.0 * i + 1.0 - kParts) / (kParts - 2.0);
    n += 1;
    sx += x;
    sy += trace[i];
    sxx += x * x;
    sxy += x * trace[i];
  }
  if (n < 8) return {};
  const double b = (n * sxy - sx * sy) / (n * sxx - sx * sx), a = (sy - b * sx) / n;
  double low = 1e300, high = -1e300, least = 1e300, most = -1e300;
  for (int i = 1; i < kParts - 1; ++i) {
    if (std::isnan(trace[i])) continue;
    const double x = (2.0 * i + 1.0 - kParts) / (kParts - 2.0);
    low = std::min(low, trace[i] - a - b * x);
    high = std::max(high, trace[i] - a - b * x);
    least = std::min(least, trace[i]);
    most = std::max(most, trace[i]);
  }
  return {2.0 * b, high - low, most - least};
}

void raise(double& largest, double value) {
  if (!std::isnan(value) && !(std::abs(value) <= largest)) largest = std::abs(value);
}

struct Largest {
  double fp = kNaN, total_pitch = kNaN;
  TraceDeviations profile, helix;
};

Largest largest_of(const ResidualGrid& grid, const FlankGeometry& g) {
  Largest most;
  for (int side = 0; side < 2; ++side) {
    double low = 1e300, high = -1e300, before = kNaN;
    // Along the pitch circle, counter-clockwise positive: material on the clockwise side lies behind.
    const double along = (side == 1 ? 1.0 : -1.0) /
                         (std::cos(g.base_helix_rad()) * std::cos(g.pressure_angle_rad()));
    std::size_t measured = 0;
    for (const auto& tooth : grid.teeth) {
      const double place = along * tooth[side].index;
      if (std::isnan(place)) {
        before = kNaN;
        continue;
      }
      ++measured;
      raise(most.fp, place - before);
      before = place;
      low = std::min(low, place);
      high = std::max(high, place);
    }
    if (measured == grid.teeth.size()) {
      raise(most.fp, along * grid.teeth.front()[side].index - before);
      raise(most.total_pitch, high - low);
    }
    for (const auto& tooth : grid.teeth) {
      const TraceDeviations p = deviations_of(tooth[side].profile), h = deviations_of(tooth[side].helix);
      raise(most.profile.slope, p.slope);
      raise(most.profile.form, p.form);
      raise(most.profile.total, p.total);
      raise(most.helix.slope, h.slope);
      raise(most.helix.form, h.form);
      raise(most.helix.total, h.total);
    }
  }
  return most;
}

}  // namespace

double iso_1328_tolerance_um(double bracket_um, int accuracy_class) {
  const double value = bracket_um * std::pow(2.0, 0.5 * (accuracy_class - 5));
  const double step = value > 10.0 ? 1.0 : value >= 5.0 ? 0.5 : 0.1;
  return std::round(value / step) * step;
}

Iso1328 iso_1328(const GearLoop& closed) {
  const FlankGeometry& g = closed.geometry;
  const double d = 2.0 * g.reference_radius_mm(), m = g.gear().normal_module_mm;
  const double b = g.face_width_mm();
  const Largest most = largest_of(residual_grid(closed, false), g);
  const double slope_profile = 0.4 * m + 0.001 * d + 4.0, form_profile = 0.55 * m + 5.0;
  const double slope_helix = 0.05 * std::sqrt(d) + 0.35 * std::sqrt(b) + 4.0;
  const double form_helix = 0.07 * std::sqrt(d) + 0.45 * std::sqrt(b) + 4.0;
  Iso1328 result;
  const auto add = [&](const char* symbol, double value, double bracket) {
    Iso1328Row row{symbol, value, bracket, 0};
    if (!std::isnan(value))
      for (row.accuracy_class = 1;
           row.accuracy_class < 12 && value > iso_1328_tolerance_um(bracket, row.accuracy_class);)
        ++row.accuracy_class;
    result.rows.push_back(row);
  };
  add("fp", most.fp, 0.001 * d + 0.4 * m + 5.0);
  add("Fp", most.total_pitch, 0.002 * d + 0.55 * std::sqrt(d) + 0.7 * m + 12.0);
  add("fHa", most.profile.slope, slope_profile);
  add("ffa", most.profile.form, form_profile);
  add("Fa", most.profile.total, std::hypot(slope_profile, form_profile));
  add("fHb", most.helix.slope, slope_helix);
  add("ffb", most.helix.form, form_helix);
  add("Fb", most.helix.total, std::hypot(slope_helix, form_helix));
  result.in_scope = g.teeth() >= 5 && g.teeth() <= 1000 && d >= 5.0 && d <= 15000.0 && m >= 0.5 &&
                    m <= 70.0 && b >= 4.0 && b <= 1200.0 &&
                    std::abs(g.gear().helix_angle_rad) <= rad_from_deg(45.0);
  result.note = result.in_scope
                    ? "ISO 1328-1:2013, unfiltered traces: a second opinion"
                    : "outside the scope of ISO 1328-1:2013 (z 5-1000, d 5-15000, mn 0.5-70, b 4-1200, "
                      "helix to 45 degrees): no class";
  if (!result.in_scope)
    for (Iso1328Row& row : result.rows) row.accuracy_class = 0;
  return result;
}

}  // namespace trueflank::loop
