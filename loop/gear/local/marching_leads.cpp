// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/marching_leads.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

using Amplitude = std::complex<double>;

/// A trace less its mean and lean.
struct LeadTrace {
  int tooth = 0;
  std::vector<double> v, um;  ///< where, of the face from 0 to 1; what
  double square = 0.0;        ///< mean
};
using LeadTraces = std::vector<LeadTrace>;

void take_line_off(LeadTrace& trace) {
  const auto n = static_cast<Eigen::Index>(trace.um.size());
  Eigen::MatrixXd line(n, 2);
  const Eigen::Map<Eigen::VectorXd> v(trace.v.data(), n);
  Eigen::Map<Eigen::VectorXd> um(trace.um.data(), n);
  line << Eigen::VectorXd::Ones(n), v;
  um -= line * line.colPivHouseholderQr().solve(um);
  trace.square = um.squaredNorm() / static_cast<double>(n);
}

/// Of the sides; 1 is the one that lies counter-clockwise.
std::array<LeadTraces, 2> lead_traces(const FlankGeometry& geometry, const Observations& table,
                                      const std::vector<float>& row_um,
                                      const std::vector<bool>& used) {
  constexpr std::size_t kFewestOfTrace = 20;
  std::map<std::pair<int, int>, LeadTrace> all;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] || table.rows[i].kind != ObservationKind::kHelix) continue;
    const Place& place = table.place(table.rows[i]);
    LeadTrace& trace = all[{place.side > 0 ? 1 : 0, place.tooth}];
    trace.tooth = place.tooth;
    trace.v.push_back(0.5 * (geometry.face_coordinate(place.z_mm) + 1.0));
    trace.um.push_back(static_cast<double>(row_um[i]));
  }
  std::array<LeadTraces, 2> of_side;
  for (auto& [flank, trace] : all) {
    if (trace.um.size() < kFewestOfTrace) continue;
    take_line_off(trace);
    of_side[static_cast<std::size_t>(flank.first)].push_back(std::move(trace));
  }
  return of_side;
}

std::vector<Amplitude> amplitudes_of(const LeadTraces& traces, double waves) {
  std::vector<Amplitude> amplitudes;
  for (const LeadTrace& trace : traces) {
    Amplitude sum = 0.0;
    for (std::size_t i = 0; i < trace.v.size(); ++i)
      sum += trace.um[i] * std::polar(1.0, -kTwoPi * waves * trace.v[i]);
    amplitudes.push_back(2.0 * sum / static_cast<double>(trace.v.size()));
  }
  return amplitudes;
}

/// What one amplitude says together with the others of its order, and what is then left of them.
struct OfOrder {
  double amplitude = 0.0, left = 0.0;
};
OfOrder of_order(const LeadTraces& traces, const std::vector<Amplitude>& amplitudes, int order,
                 int teeth) {
  Amplitude sum = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    sum += amplitudes[k] * std::polar(1.0, -kTwoPi * order * (traces[k].tooth - 1) / teeth);
    squares += std::norm(amplitudes[k]);
  }
  const double count = std::max<double>(1.0, static_cast<double>(traces.size()));
  return {std::abs(sum) / count, squares - std::norm(sum) / count};
}

/// Sides that are asked together, each with a phase of its own.
struct Marching {
  double waves = 0.0;
  int order = 0;
  double p_value = 1.0;
  double left = 1e300;
};

/// The order that leaves least at some wavelength, against phases by chance and against all others.
std::optional<Marching> likeliest_march(const std::vector<const LeadTraces*>& sides, int teeth,
                                        double most_waves) {
  constexpr double kFewestWaves = 1.5, kStep = 0.1, kLevel = 1e-4, kOtherOrder = 1e-3;
  constexpr double kShare = 1.0 / 3.0;
  double count = 0.0, mean_square = 0.0;
  for (const LeadTraces* traces : sides)
    for (const LeadTrace& trace : *traces) {
      count += 1.0;
      mean_square += trace.square;
    }
  const double free = count - static_cast<double>(sides.size());
  const auto left_at = [&](double waves) {
    std::vector<double> left(static_cast<std::size_t>(teeth), 0.0);  // of order -teeth/2, ...
    double all = 0.0;
    for (const LeadTraces* traces : sides) {
      const std::vector<Amplitude> amplitudes = amplitudes_of(*traces, waves);
      for (const Amplitude& amplitude : amplitudes) all += std::norm(amplitude);
      for (int n = 0; n < teeth; ++n)
        left[static_cast<std::size_t>(n)] +=
            of_order(*traces, amplitudes, n - teeth / 2, teeth).left;
    }
    return std::pair{all, left};
  };
  // Where most is taken out: there the amplitudes are largest and agree.
  Marching best;
  double most = 0.0;
  const auto ask = [&](double waves) {
    const auto [all, left] = left_at(waves);
    const auto least = std::min_element(left.begin(), left.end());
    if (all - *least <= most) return;
    most = all - *least;
    best = {.waves = waves,
            .order = static_cast<int>(least - left.begin()) - teeth / 2,
            .left = *least};
  };
  for (double waves = kFewestWaves; waves <= most_waves; waves += kStep) ask(waves);
  for (const double step : {0.3, 0.1})
    for (const double waves = best.waves; const int off : {-2, -1, 1, 2})
      ask(waves + off * step * kStep);
  if (!(most > 0.0) || best.order == 0 || 0.5 * most < kShare * mean_square) return {};
  const auto [all, left] = left_at(best.waves);
  const double tested = teeth * 2.0 * most_waves;
  best.p_value = std::min(1.0, tested * std::pow(best.left / all, free));
  if (best.p_value > kLevel) return {};
  // (its nearest neighbours may be this one, of no whole number)
  for (int n = 0; n < teeth; ++n) {
    const int order = n - teeth / 2;
    if (order != best.order &&
        std::pow(best.left / left[static_cast<std::size_t>(n)], free) > kOtherOrder)
      return {};
  }
  return best;
}

}  // namespace

std::vector<FlankWaves> marching_leads(const FlankGeometry& geometry, const Observations& table,
                                       const std::vector<float>& row_um,
                                       const std::vector<bool>& used) {
  constexpr std::size_t kFewest = 4;
  constexpr double kValuesOfWave = 6.0, kMostWaves = 40.0, kAlike = 2.0;
  const std::array<LeadTraces, 2> of_side = lead_traces(geometry, table, row_um, used);
  std::vector<std::vector<std::size_t>> sets{{1}, {0}};
  if (!of_side[0].empty() && !of_side[1].empty()) sets.insert(sets.begin(), {0, 1});
  std::vector<FlankWaves> found;
  for (const std::vector<std::size_t>& set : sets) {
    std::vector<const LeadTraces*> sides;
    double values = 1e300;
    for (const std::size_t side : set) {
      if (of_side[side].size() < kFewest) continue;
      sides.push_back(&of_side[side]);
      for (const LeadTrace& trace : of_side[side])
        values = std::min(values, static_cast<double>(trace.um.size()));
    }
    if (sides.size() != set.size()) continue;
    const std::optional<Marching> march =
        likeliest_march(sides, geometry.teeth(), std::min(kMostWaves, values / kValuesOfWave));
    if (!march) continue;
    std::vector<FlankWaves> waves;
    double least = 1e300, most = 0.0;
    for (const std::size_t side : set) {
      const double um = of_order(of_side[side], amplitudes_of(of_side[side], march->waves),
                                 march->order, geometry.teeth())
                            .amplitude;
      least = std::min(least, um);
      most = std::max(most, um);
      waves.push_back({.p_value = march->p_value,
                       .side = side == 1 ? 1 : -1,
                       .waves_profile = 0.0,
                       .waves_face = march->waves,
                       .order = static_cast<double>(march->order),
                       .amplitude_um = um});
    }
    if (most > kAlike * least) continue;
    found.insert(found.end(), waves.begin(), waves.end());
    if (set.size() > 1) return found;
  }
  return found;
}

}  // namespace trueflank::loop
