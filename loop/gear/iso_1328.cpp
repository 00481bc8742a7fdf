// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/iso_1328.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/trace_evaluation.h"

namespace trueflank::loop {
namespace {

constexpr int kParts = FlankResiduals::kParts;

/// Of two values the one of larger size; NaN gives way.
double larger(double a, double b) {
  return std::isnan(a) || std::abs(b) > std::abs(a) ? b : a;
}

struct Mean {
  double sum = 0.0, count = 0.0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    count += 1.0;
  }
  [[nodiscard]] double value() const { return count > 0.0 ? sum / count : kNaN; }
};

/// Largest figures of the traces of one side, and their means.
struct OfTraces {
  TraceFigures largest;
  Mean slope, crowning;
  void add(const TraceFigures& f) {
    largest.slope_um = larger(largest.slope_um, f.slope_um);
    largest.form_um = larger(largest.form_um, f.form_um);
    largest.total_um = larger(largest.total_um, f.total_um);
    slope.add(f.slope_um);
    crowning.add(f.crowning_um);
  }
};

struct OfPitch {
  double single = kNaN, total = kNaN, adjacent = kNaN, sector = kNaN;
};

struct OfSide {
  OfPitch pitch;
  OfTraces profile, helix;
};

/// Tooth, side, zero; and which of the traces that share a zero: at another height or diameter.
using TraceKey = std::array<int, 4>;
using Traces = std::map<TraceKey, std::vector<TracePoint>>;

/// Traces of one kind of record, or of the scan's mean traces where there are none.
Traces traces_of(const GearLoop& closed, const ResidualGrid& grid, bool profile) {
  const FlankGeometry& g = closed.geometry;
  const ObservationKind kind = profile ? ObservationKind::kProfile : ObservationKind::kHelix;
  Traces traces;
  std::map<std::array<int, 4>, std::vector<TracePoint>> measured;  // tooth, side, zero, line
  for (std::size_t i = 0; i < closed.table.rows.size(); ++i) {
    const Observation& row = closed.table.rows[i];
    if (row.kind != kind) continue;
    const Place& place = closed.table.place(row);
    measured[{place.tooth, place.side > 0 ? 1 : 0, row.trace, row.line}].push_back(
        {profile ? place.roll_mm : place.z_mm, closed.before_um[i]});
  }
  for (auto& [key, values] : measured) traces[key] = std::move(values);
  if (traces.empty()) {
    const double start = profile ? g.root_form_roll_mm() : 0.0;
    const double length = profile ? g.tip_form_roll_mm() - start : g.face_width_mm();
    for (std::size_t k = 0; k < grid.teeth.size(); ++k)
      for (int side = 0; side < 2; ++side) {
        const auto& parts = profile ? grid.teeth[k][side].profile : grid.teeth[k][side].helix;
        for (int i = 0; i < kParts; ++i)
          if (!std::isnan(parts[i]))
            traces[{static_cast<int>(k) + 1, side, 0, 0}].push_back({start + length * (i + 0.5) / kParts, parts[i]});
      }
  }
  for (auto& [flank, trace] : traces)
    std::sort(trace.begin(), trace.end(),
              [](const TracePoint& a, const TracePoint& b) { return a.at_mm < b.at_mm; });
  return traces;
}

/// Profiles are told from root to tip; on a ring the roll length runs the other way.
void turn_round(std::vector<TracePoint>& trace) {
  for (TracePoint& p : trace) p.at_mm = -p.at_mm;
  std::reverse(trace.begin(), trace.end());
}

EvaluationRange range_of(const FlankGeometry& g, const std::vector<TracePoint>& trace, bool profile) {
  const double first = trace.front().at_mm, last = trace.back().at_mm;
  if (profile) {
    const double sign = g.sense();
    const double from = std::max(sign * g.root_form_roll_mm(), first);
    const double to = std::min(sign * g.tip_form_roll_mm(), last);
    return {from, from + 0.95 * (to - from), to};
  }
  const double end = std::min(0.05 * g.face_width_mm(), g.gear().normal_module_mm) + g.edge_chamfer_mm();
  return {std::max(end, first), std::min(g.face_width_mm() - end, last), 0.0};
}

void add_traces(const GearLoop& closed, const ResidualGrid& grid, bool profile, std::array<OfSide, 2>& sides) {
  const FlankGeometry& g = closed.geometry;
  for (auto& [flank, trace] : traces_of(closed, grid, profile)) {
    if (profile && g.sense() < 0.0) turn_round(trace);
    const EvaluationRange range = range_of(g, trace, profile);
    const auto filtered = gaussian_filtered(trace, cut_off_mm(range.to_mm - range.from_mm));
    OfSide& side = sides[static_cast<std::size_t>(flank[1])];
    (profile ? side.profile : side.helix).add(evaluate_trace(filtered, range));
  }
}

/// Pitch of one side: places of its flanks along the pitch circle, counter-clockwise positive.
OfPitch pitch_of(const ResidualGrid& grid, int side, const FlankGeometry& g) {
  const double along =
      (side == 1 ? 1.0 : -1.0) / (std::cos(g.base_helix_rad()) * std::cos(g.pressure_angle_rad()));
  const std::size_t z = grid.teeth.size(), sector = (z + 4) / 8;
  OfPitch pitch;
  std::vector<double> place(z);
  for (std::size_t k = 0; k < z; ++k) place[k] = along * grid.teeth[k][side].index;
  const auto [low, high] = std::minmax_element(place.begin(), place.end());
  const bool whole = std::none_of(place.begin(), place.end(), [](double p) { return std::isnan(p); });
  for (std::size_t k = 0; k < z; ++k) {
    // Over tooth 1 the pitch closes only where every tooth was measured.
    if (k == 0 && !whole) continue;
    const double here = place[k] - place[(k + z - 1) % z];
    pitch.single = larger(pitch.single, std::abs(here));
    if (!whole) continue;
    pitch.adjacent = larger(pitch.adjacent, std::abs(place[(k + 1) % z] - place[k] - here));
    if (sector > 1) pitch.sector = larger(pitch.sector, std::abs(place[(k + sector) % z] - place[k]));
  }
  if (whole) pitch.total = *high - *low;
  return pitch;
}

/// The figure of one side; slopes keep their sign.
struct Quantity {
  const char *symbol, *what;
  double bracket_um;
  double (*of)(const OfSide&);
};

std::vector<Quantity> quantities(double d, double m, double b) {
  const double slope_a = 0.4 * m + 0.001 * d + 4.0, form_a = 0.55 * m + 5.0;
  const double slope_b = 0.05 * std::sqrt(d) + 0.35 * std::sqrt(b) + 4.0;
  const double form_b = 0.07 * std::sqrt(d) + 0.45 * std::sqrt(b) + 4.0;
  return {
      {"fp", "single pitch", 0.001 * d + 0.4 * m + 5.0, [](const OfSide& s) { return s.pitch.single; }},
      {"Fp", "cumulative pitch, total", 0.002 * d + 0.55 * std::sqrt(d) + 0.7 * m + 12.0,
       [](const OfSide& s) { return s.pitch.total; }},
      {"fu", "adjacent pitch difference", kNaN, [](const OfSide& s) { return s.pitch.adjacent; }},
      {"Fpz/8", "sector pitch over an eighth of the teeth", kNaN, [](const OfSide& s) { return s.pitch.sector; }},
      {"fHa", "profile slope", slope_a, [](const OfSide& s) { return s.profile.largest.slope_um; }},
      {"ffa", "profile form", form_a, [](const OfSide& s) { return s.profile.largest.form_um; }},
      {"Fa", "profile, total", std::hypot(slope_a, form_a), [](const OfSide& s) { return s.profile.largest.total_um; }},
      {"fHam", "profile slope, mean of the teeth", kNaN, [](const OfSide& s) { return s.profile.slope.value(); }},
      {"Ca", "profile crowning, mean of the teeth", kNaN, [](const OfSide& s) { return s.profile.crowning.value(); }},
      {"fHb", "helix slope", slope_b, [](const OfSide& s) { return s.helix.largest.slope_um; }},
      {"ffb", "helix form", form_b, [](const OfSide& s) { return s.helix.largest.form_um; }},
      {"Fb", "helix, total", std::hypot(slope_b, form_b), [](const OfSide& s) { return s.helix.largest.total_um; }},
      {"fHbm", "helix slope, mean of the teeth", kNaN, [](const OfSide& s) { return s.helix.slope.value(); }},
      {"Cb", "helix crowning, mean of the teeth", kNaN, [](const OfSide& s) { return s.helix.crowning.value(); }},
  };
}

int class_of(double value, double bracket) {
  if (std::isnan(value) || std::isnan(bracket)) return 0;
  int accuracy = 1;
  while (accuracy < 12 && std::abs(value) > iso_1328_tolerance_um(bracket, accuracy)) ++accuracy;
  return accuracy;
}

}  // namespace

double iso_1328_tolerance_um(double bracket_um, int accuracy_class) {
  const double value = bracket_um * std::pow(2.0, 0.5 * (accuracy_class - 5));
  const double step = value > 10.0 ? 1.0 : value >= 5.0 ? 0.5 : 0.1;
  return std::round(value / step) * step;
}

Iso1328 iso_1328(const GearLoop& closed) {
  const FlankGeometry& g = closed.geometry;
  const double d = 2.0 * g.reference_radius_mm(), m = g.gear().normal_module_mm, b = g.face_width_mm();
  const ResidualGrid grid = residual_grid_before(closed);
  std::array<OfSide, 2> sides;
  add_traces(closed, grid, true, sides);
  add_traces(closed, grid, false, sides);
  for (int side = 0; side < 2; ++side) sides[static_cast<std::size_t>(side)].pitch = pitch_of(grid, side, g);
  const OfSide& left = sides[flank_side(Flank::kLeft, g.gear().kind) > 0 ? 1 : 0];
  const OfSide& right = sides[flank_side(Flank::kRight, g.gear().kind) > 0 ? 1 : 0];
  Iso1328 result;
  result.in_scope = g.teeth() >= 5 && g.teeth() <= 1000 && d >= 5.0 && d <= 15000.0 && m >= 0.5 && m <= 70.0 &&
                    b >= 4.0 && b <= 1200.0 && std::abs(g.gear().helix_angle_rad) <= rad_from_deg(45.0);
  const auto all = quantities(d, m, b);
  const auto add = [&](const char* flank, const auto& value_of) {
    for (const Quantity& q : all) {
      const double value = value_of(q);
      result.rows.push_back({q.symbol, flank, q.what, value, q.bracket_um,
                             result.in_scope ? class_of(value, q.bracket_um) : 0});
    }
  };
  add("both", [&](const Quantity& q) { return larger(q.of(left), q.of(right)); });
  add("left", [&](const Quantity& q) { return q.of(left); });
  add("right", [&](const Quantity& q) { return q.of(right); });
  result.note = "ISO 1328-1:2013: Gaussian filter with a cut-off of a thirtieth of the evaluated length, at least "
                "0.25 mm; profile over 95 % of its length from the root, helix over the face less 5 % or a module "
                "at each end; deviations from the design, slopes with + for material towards tip or top";
  if (!result.in_scope)
    result.note += "; outside the scope of the standard (z 5-1000, d 5-15000, mn 0.5-70, b 4-1200, helix to 45 "
                   "degrees): no class";
  return result;
}

std::vector<InspectionFigure> inspection_figures(const Iso1328& evaluated) {
  std::vector<InspectionFigure> figures;
  for (const Iso1328Row& row : evaluated.rows) {
    if (std::isnan(row.value_um)) continue;
    figures.push_back({row.symbol, row.flank, row.what, row.value_um, row.accuracy_class, {}});
    for (int k = 1; k <= 11 && evaluated.in_scope && !std::isnan(row.bracket_um); ++k)
      figures.back().limits_um.push_back(iso_1328_tolerance_um(row.bracket_um, k));
  }
  return figures;
}

}  // namespace trueflank::loop
