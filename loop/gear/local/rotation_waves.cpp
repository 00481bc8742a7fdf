// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/rotation_waves.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <span>

#include "trueflank/base/many_sines.h"
#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {
namespace {

constexpr int kMostRotationOrder = 1000;
/// Of a scan's many values so many tell as much as is asked.
constexpr std::size_t kMostScanned = 30000;
/// Scans of fewer teeth are not asked: waves of other orders look the same. On few traced teeth an
/// order must be so much likelier than every other.
constexpr double kFewestScannedTeeth = 8.0, kLeastShareOfTeeth = 0.6, kFewestTracedTeeth = 5.0,
                 kMuchLikelier = 0.01;

/// Its values stand at these rotations: that of the tooth at a height, and what the profile adds to it.
struct ProfileTrace {
  int side = 1;
  std::vector<double> middle_rad, along_rad, um;
};

struct ProfileTraces {
  std::map<std::array<int, 3>, ProfileTrace> of;  ///< by trace or flank, and line
  std::set<int> teeth;
  bool scanned = false;  ///< the values of a scanned flank as one trace
};

ProfileTraces gathered(const FlankGeometry& geometry, const Observations& table,
                       const std::vector<float>& row_um, const std::vector<bool>& used) {
  ProfileTraces traces;
  std::size_t profiles = 0, scanned = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!used[i]) continue;
    profiles += table.rows[i].kind == ObservationKind::kProfile ? 1 : 0;
    scanned += table.rows[i].kind == ObservationKind::kScanFlank ? 1 : 0;
  }
  traces.scanned = profiles == 0;
  const ObservationKind kind = traces.scanned ? ObservationKind::kScanFlank : ObservationKind::kProfile;
  const ThinnedRows some(scanned,
                         traces.scanned ? kMostScanned : std::max<std::size_t>(1, scanned));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!some.has(i) || !used[i] || table.rows[i].kind != kind) continue;
    const Observation& row = table.rows[i];
    const Place& place = table.place(row);
    const auto flank = static_cast<std::size_t>(2 * place.tooth + (place.side > 0 ? 1 : 0));
    ProfileTrace& trace =
        traces.of[{row.trace, row.trace >= 0 ? 0 : static_cast<int>(flank), row.line}];
    trace.side = place.side;
    trace.middle_rad.push_back(geometry.centre_rad(place.tooth) + geometry.twist_rad(place.z_mm));
    trace.along_rad.push_back(-geometry.sense() * place.side * place.roll_mm /
                              geometry.base_radius_mm());
    trace.um.push_back(row_um[i]);
    traces.teeth.insert(place.tooth);
  }
  return traces;
}

/// Takes level, slope and bow from a trace: lower orders show as these.
void take_slow_part(ProfileTrace& trace) {
  const auto n = static_cast<Eigen::Index>(trace.um.size());
  if (n < 4) return;
  const Eigen::Map<const Eigen::ArrayXd> at(trace.along_rad.data(), n);
  Eigen::Map<Eigen::VectorXd> um(trace.um.data(), n);
  const Eigen::ArrayXd x = (at - at.mean()) / std::max(1e-12, at.maxCoeff() - at.minCoeff());
  Eigen::MatrixXd powers(n, 3);
  powers << Eigen::VectorXd::Ones(n), x.matrix(), x.square().matrix();
  um -= powers * symmetric_solution(powers.transpose() * powers, powers.transpose() * um);
}

/// First and last order: of one and a half waves on a usual trace, of four values a wave. Those of a scanned
/// flank stand in two directions.
std::pair<int, int> orders_of(const ProfileTraces& traces) {
  constexpr double kFewestWaves = 1.5, kFewestValues = 4.0, kMostWavesScanned = 8.0, kOfRow = 0.7;
  std::vector<double> first, last;
  for (const auto& [key, trace] : traces.of) {
    const auto [low, high] = std::minmax_element(trace.along_rad.begin(), trace.along_rad.end());
    if (!(*high > *low)) continue;
    const double whole = kTwoPi / (*high - *low);
    first.push_back(kFewestWaves * whole);
    const auto values = static_cast<double>(trace.um.size());
    last.push_back((traces.scanned ? std::min(kMostWavesScanned, kOfRow * std::sqrt(values)) : values / kFewestValues) * whole);
  }
  if (first.empty()) return {1, 0};
  return {static_cast<int>(std::ceil(median(first))),
          static_cast<int>(std::min<double>(kMostRotationOrder, median(last)))};
}

using OrderSums = std::vector<std::complex<double>>;

/// Waves of so many values stand beside each other, each with sums of its own: a wave's next order
/// waits for the product of the last one.
constexpr std::size_t kAtOnce = 8;
struct ManyWaves {
  std::array<double, kAtOnce> real{}, imaginary{};
};

/// Adds values at their rotations to the sums of every order from the least on: a value's wave of
/// the next order is that of the last one, turned by the rotation.
void add_values(std::span<const double> rotation, std::span<const double> um, int least,
                std::vector<ManyWaves>& sums) {
  ManyWaves step, wave;
  std::array<double, 2 * kAtOnce> angles{}, sines, cosines;
  for (std::size_t i = 0; i < um.size(); ++i) {
    angles[i] = rotation[i];
    angles[kAtOnce + i] = least * rotation[i];
  }
  sines_and_cosines(angles, sines, cosines);
  for (std::size_t i = 0; i < um.size(); ++i) {
    step.real[i] = cosines[i];
    step.imaginary[i] = sines[i];
    wave.real[i] = cosines[kAtOnce + i] * um[i];
    wave.imaginary[i] = sines[kAtOnce + i] * um[i];
  }
  // (left to itself, the compiler takes one value at a time)
  using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
  constexpr std::size_t kFours = kAtOnce / 4;
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    Four turn_real[kFours], turn_imaginary[kFours], real[kFours], imaginary[kFours];
    std::memcpy(turn_real, step.real.data(), sizeof turn_real);
    std::memcpy(turn_imaginary, step.imaginary.data(), sizeof turn_imaginary);
    std::memcpy(real, wave.real.data(), sizeof real);
    std::memcpy(imaginary, wave.imaginary.data(), sizeof imaginary);
    for (ManyWaves& sum : sums)
      for (std::size_t k = 0; k < kFours; ++k) {
        Four sum_real, sum_imaginary;
        std::memcpy(&sum_real, &sum.real[4 * k], sizeof sum_real);
        std::memcpy(&sum_imaginary, &sum.imaginary[4 * k], sizeof sum_imaginary);
        sum_real += real[k];
        sum_imaginary += imaginary[k];
        std::memcpy(&sum.real[4 * k], &sum_real, sizeof sum_real);
        std::memcpy(&sum.imaginary[4 * k], &sum_imaginary, sizeof sum_imaginary);
        const Four next = real[k] * turn_real[k] - imaginary[k] * turn_imaginary[k];
        imaginary[k] = real[k] * turn_imaginary[k] + imaginary[k] * turn_real[k];
        real[k] = next;
      }
  });
}

/// What the traces of a side, or of both, say of every order from the least on.
struct SumsOfTraces {
  int least = 1;
  OrderSums all;                   ///< of all traces together
  std::vector<OrderSums> of;       ///< of each; empty where flanks of a scan were asked
  std::vector<double> middle_rad;  ///< of each

  [[nodiscard]] const std::complex<double>& at(int order) const {
    return all[static_cast<std::size_t>(order - least)];
  }
  [[nodiscard]] int most() const { return least + static_cast<int>(all.size()) - 1; }
  void add(const SumsOfTraces& other) {
    std::transform(all.begin(), all.end(), other.all.begin(), all.begin(), std::plus<>());
    of.insert(of.end(), other.of.begin(), other.of.end());
    middle_rad.insert(middle_rad.end(), other.middle_rad.begin(), other.middle_rad.end());
  }
};

/// Sums of the values of one side's traces against every order from the least on.
SumsOfTraces order_sums(const ProfileTraces& traces, int side, int least, int most,
                        bool backwards) {
  const auto orders = static_cast<std::size_t>(most - least + 1);
  SumsOfTraces sums{least, OrderSums(orders), {}, {}};
  std::vector<ManyWaves> of_values(orders);
  const auto take = [&](OrderSums& to) {
    for (std::size_t n = 0; n < orders; ++n)
      for (std::size_t i = 0; i < kAtOnce; ++i)
        to[n] += std::complex<double>(of_values[n].real[i], of_values[n].imaginary[i]);
    std::fill(of_values.begin(), of_values.end(), ManyWaves{});
  };
  std::vector<double> rotation;
  for (const auto& [key, trace] : traces.of) {
    if (trace.side != side) continue;
    rotation.clear();
    for (std::size_t i = 0; i < trace.um.size(); ++i)
      rotation.push_back(trace.middle_rad[i] + (backwards ? -1.0 : 1.0) * trace.along_rad[i]);
    for (std::size_t i = 0; i < rotation.size(); i += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, rotation.size() - i);
      add_values({rotation.data() + i, count}, {trace.um.data() + i, count}, least, of_values);
    }
    if (traces.scanned) continue;
    sums.of.emplace_back(orders);
    take(sums.of.back());
    std::transform(sums.all.begin(), sums.all.end(), sums.of.back().begin(), sums.all.begin(),
                   std::plus<>());
    sums.middle_rad.push_back(trace.middle_rad.front());
  }
  if (traces.scanned) take(sums.all);
  return sums;
}

/// By chance this order stands out so far among as many as the gear has teeth; 1 where too few are
/// beside it.
double p_among_orders(const SumsOfTraces& sums, int order, int teeth) {
  constexpr int kFewestBeside = 6;
  const auto power_of = [&](int n) { return std::norm(sums.at(n)); };
  const int from =
      std::clamp(order - teeth / 2, sums.least, std::max(sums.least, sums.most() - teeth + 1));
  double beside = 0.0;
  int count = 0;
  for (int other = from; other <= std::min(sums.most(), from + teeth - 1); ++other) {
    if (other == order || other % teeth == 0) continue;
    beside += power_of(other);
    ++count;
  }
  if (count < kFewestBeside || !(beside > 0.0)) return 1.0;
  return std::pow(1.0 + power_of(order) / beside, -count);
}

/// By chance the waves of traces agree so well in the phases of this order, whatever all of them
/// have in common: of independent waves of traces, and of white errors, the share of their squares
/// that a given course of phases takes is that of one value of n (a beta distribution). On a part
/// of the teeth other orders have a share of a wave, which says nothing against it.
struct Agreement {
  double shared = 0.0, all = 0.0;  ///< squares: of the order's phases, and of all
  double traces = 0.0;             ///< less the one value that all may have in common
};
Agreement agreement_of(const SumsOfTraces& sums, int order) {
  constexpr double kToldApart = 0.2;
  const std::size_t n = sums.of.size();
  // As unit vectors: the same wave on every tooth, and the order's.
  const auto at = static_cast<std::size_t>(order - sums.least);
  const double unit = 1.0 / std::sqrt(static_cast<double>(n));
  std::complex<double> same_and_order = 0.0, same_and_waves = 0.0, order_and_waves = 0.0;
  double squares = 0.0;
  for (std::size_t t = 0; t < n; ++t) {
    const std::complex<double> same = std::polar(unit, -order * sums.middle_rad[t]),
                               wave = sums.of[t][at];
    same_and_order += same * unit;
    same_and_waves += same * wave;
    order_and_waves += unit * wave;
    squares += std::norm(wave);
  }
  const double left = 1.0 - std::norm(same_and_order);
  squares -= std::norm(same_and_waves);
  if (left < kToldApart || !(squares > 0.0)) return {};
  const double shared =
      std::norm(order_and_waves - std::conj(same_and_order) * same_and_waves) / left;
  return {
      .shared = std::min(shared, squares), .all = squares, .traces = static_cast<double>(n) - 1.0};
}

/// What is asked besides must be so much surer than the other orders have to be that it is no look
/// more.
constexpr double kSurer = 100.0;

double p_of_agreement(const SumsOfTraces& sums, int order) {
  constexpr double kFewestTraces = 5.0;
  const Agreement of = agreement_of(sums, order);
  if (of.traces < kFewestTraces - 1.0) return 1.0;
  return std::min(1.0, kSurer * std::pow(1.0 - of.shared / of.all, of.traces - 1.0));
}

/// The same of two sides, each in a phase of its own.
double p_of_both(const SumsOfTraces& one, const SumsOfTraces& other, int order, int teeth) {
  constexpr double kFewestTraces = 8.0;
  if (order % teeth == 0 || one.of.empty() || other.of.empty()) return 1.0;
  const Agreement a = agreement_of(one, order), b = agreement_of(other, order);
  const double beside = a.traces + b.traces - 2.0;
  if (a.traces == 0.0 || b.traces == 0.0 || beside < kFewestTraces - 2.0) return 1.0;
  const double share = (a.shared + b.shared) / (a.all + b.all);
  return std::min(1.0, kSurer * std::pow(1.0 - share, beside) * (1.0 + beside * share));
}

/// Of few teeth every order has a share of a wave, so that none stands out among the others.
double p_of_order(const SumsOfTraces& sums, int order, int teeth, bool few) {
  if (order % teeth == 0) return 1.0;  // the same on every tooth: a form of the flank
  const double among = few ? 1.0 : p_among_orders(sums, order, teeth);
  return sums.of.empty() ? among : std::min(among, p_of_agreement(sums, order));
}

/// The order that stands out most; p value of one order alone.
template <class Chance>
RotationWave likeliest(const SumsOfTraces& sums, bool much, const Chance& chance) {
  RotationWave best;
  double next = 1.0;
  for (int n = sums.least; n <= sums.most(); ++n) {
    const double p = chance(n);
    if (p < best.p_value) {
      next = best.p_value;
      best = {.order = n, .p_value = p};
    } else {
      next = std::min(next, p);
    }
  }
  if (much && !(best.p_value < kMuchLikelier * next)) return {};
  return best;
}

/// True where no other order of as many as the gear has teeth is nearly as strong. Stripes in space, which
/// a scan can hold, are made of many.
bool stands_alone(const SumsOfTraces& sums, int order, int teeth) {
  constexpr double kClearly = 2.5;
  const double own = std::norm(sums.at(order));
  for (int other = std::max(sums.least, order - teeth / 2);
       other <= std::min(sums.most(), order + teeth / 2); ++other)
    if (other != order && other % teeth != 0 && own < kClearly * std::norm(sums.at(other)))
      return false;
  return true;
}

/// Orders, and either flank in both ways of counting.
double looks_at(int least, int most) {
  constexpr double kFlanksAndWays = 4.0;
  return kFlanksAndWays * (most - least + 1);
}

}  // namespace

RotationWave likeliest_rotation_wave(const FlankGeometry& geometry, const Observations& table,
                                     const std::vector<float>& row_um,
                                     const std::vector<bool>& used) {
  constexpr double kTogether = 0.9;
  ProfileTraces traces = gathered(geometry, table, row_um, used);
  const auto teeth = static_cast<double>(traces.teeth.size());
  const bool few = teeth < kLeastShareOfTeeth * geometry.teeth() || teeth < kFewestScannedTeeth;
  if (traces.scanned ? few : teeth < kFewestTracedTeeth) return {};
  const std::pair<int, int> orders = orders_of(traces);
  const int least = orders.first, most = orders.second;
  if (most <= least) return {};
  std::map<int, double> values;
  for (auto& [key, trace] : traces.of) {
    take_slow_part(trace);
    values[trace.side] += static_cast<double>(trace.um.size());
  }
  RotationWave best;
  std::map<int, double> most_forwards;  // square of a side's largest order
  for (const bool backwards : {false, true}) {
    if (backwards && traces.scanned) break;  // scans have no numbers of teeth
    std::map<int, SumsOfTraces> sums;
    for (const auto& [side, count] : values) sums[side];
    for_each_piece(sums.size(), [&](std::size_t k) {
      auto& [side, of_side] = *std::next(sums.begin(), static_cast<std::ptrdiff_t>(k));
      of_side = order_sums(traces, side, least, most, backwards);
    });
    // Two sides agree in one order more surely than either by itself.
    RotationWave of_both;
    if (sums.size() == 2)
      of_both = likeliest(sums[1], few, [&](int order) {
        return p_of_both(sums[1], sums[-1], order, geometry.teeth());
      });
    for (const auto& of : sums) {
      const int side = of.first;  // (clang 14 hands no structured binding to a lambda)
      const SumsOfTraces& of_side = of.second;
      RotationWave wave = likeliest(of_side, few, [&](int order) {
        return p_of_order(of_side, order, geometry.teeth(), few);
      });
      if (of_both.p_value < wave.p_value &&
          std::norm(of_side.at(of_both.order)) >= std::norm(sums[-side].at(of_both.order)))
        wave = of_both;
      // Orders beside one whose height changes around the gear make it less sure, and one counted
      // backwards, which follows it nearly as well, perhaps surer: not while it is the smaller one.
      if (!backwards)
        for (const auto& sum : of_side.all)
          most_forwards[side] = std::max(most_forwards[side], std::norm(sum));
      else if (wave.order > 0 && std::norm(of_side.at(wave.order)) <= most_forwards[side])
        continue;
      if (!(wave.p_value < best.p_value)) continue;
      if (traces.scanned && !stands_alone(of_side, wave.order, geometry.teeth())) continue;
      wave.side = side;
      wave.backwards = backwards;
      wave.amplitude_um = 2.0 * std::abs(of_side.at(wave.order)) / values[side];
      if (sums.size() == 2) {
        const auto &left = sums[1].at(wave.order), &right = sums[-1].at(wave.order);
        const double apart = std::norm(left) / values[1] + std::norm(right) / values[-1];
        if (std::norm(left + right) / (values[1] + values[-1]) > kTogether * apart) wave.side = 0;
      }
      best = wave;
    }
  }
  best.p_value = std::min(1.0, best.p_value * looks_at(least, most));
  return best;
}

double chance_of_rotation_wave(const FlankGeometry& geometry, const Observations& table,
                               const std::vector<float>& row_um, const std::vector<bool>& used,
                               const RotationWave& wave) {
  ProfileTraces traces = gathered(geometry, table, row_um, used);
  const auto [least, most] = orders_of(traces);
  if (wave.order < least || wave.order > most) return 0.0;
  for (auto& [key, trace] : traces.of) take_slow_part(trace);
  // Of both flanks together, or as surely of one: the other's wave may stand beside it.
  SumsOfTraces both{least, OrderSums(static_cast<std::size_t>(most - least + 1)), {}, {}};
  double chance = 1.0;
  for (const int side : {1, -1}) {
    if (wave.side != 0 && wave.side != side) continue;
    const SumsOfTraces own = order_sums(traces, side, least, most, wave.backwards);
    if (!own.of.empty())
      chance = std::min(chance, p_of_order(own, wave.order, geometry.teeth(), false));
    both.add(own);
  }
  chance = std::min(chance, p_of_order(both, wave.order, geometry.teeth(), false));
  return std::min(1.0, chance * looks_at(least, most));
}

}  // namespace trueflank::loop
