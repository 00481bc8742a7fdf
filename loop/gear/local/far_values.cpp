// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/far_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Values of one trace, in the order of their place.
using Trace = std::vector<std::pair<double, std::size_t>>;  // place [mm], row

struct FarValues {
  ObservationKind kind = ObservationKind::kProfile;
  Place place;  ///< of the one that is farthest off
  double um = 0.0;
  int count = 1;
  double times = 0.0;  ///< its errors
};

std::string note_on(const FlankGeometry& geometry, const FarValues& one) {
  const bool profile = one.kind == ObservationKind::kProfile;
  const std::string where =
      profile ? printed("profile, about a diameter of %.5g mm", 2.0 * one.place.radius_mm)
              : printed("helix, about a height of %.3g mm", one.place.z_mm);
  return std::string(one.count == 1 ? "one value" : "two values") +
         printed(" of tooth %d, ", one.place.tooth) +
         (flank_of(geometry, one.place) == FlankChoice::kLeft ? "left" : "right") + " flank, " +
         where +
         printed(one.count == 1 ? ", lies %.3g um " : ", lie up to %.3g um ", std::abs(one.um)) +
         (one.um > 0.0 ? "high" : "low") + printed(", %.2g times the noise", one.times) +
         ": too few to tell dirt or a wild point from a short dent; look there, or trace it in "
         "finer steps";
}

/// True where the effects fall off towards a value from its neighbours on the trace, as it does.
bool is_told(const Observations& table, const Trace& trace, const Observations::LeftOut& value,
             double at_mm, const std::function<double(const Place&)>& told_um) {
  constexpr double kPart = 1.0 / 3.0;
  constexpr std::size_t kNeighbours = 6;
  Trace nearest = trace;
  std::sort(nearest.begin(), nearest.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.first - at_mm) < std::abs(b.first - at_mm);
  });
  if (nearest.size() > kNeighbours) nearest.resize(kNeighbours);
  if (nearest.empty()) return false;
  double beside_um = 0.0;
  for (const auto& [at, row] : nearest)
    beside_um += told_um(table.place(table.rows[row])) / static_cast<double>(nearest.size());
  const double falls_um = told_um(value.place) - beside_um;
  return falls_um * value.off_um > 0.0 && std::abs(falls_um) > kPart * std::abs(value.off_um);
}

/// Runs of values far off to one side.
void add_far_values(const Observations& table, const Trace& trace, const std::vector<float>& row_um,
                    double error_um, std::vector<FarValues>& found) {
  constexpr double kFar = 7.0, kFarOfTwo = 5.5, kBeside = 4.0;  // errors
  constexpr int kMost = 2;                                      // more are a form
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double um = row_um[trace[i].second];
    if (!(std::abs(um) > kBeside * error_um)) continue;
    std::size_t most = trace[i].second;
    int count = 1;
    std::size_t next = i + 1;
    for (; next < trace.size(); ++next) {
      const double beside = row_um[trace[next].second];
      if (!(beside * um > 0.0 && std::abs(beside) > kBeside * error_um)) break;
      ++count;
      if (std::abs(beside) > std::abs(row_um[most])) most = trace[next].second;
    }
    const double times = std::abs(row_um[most]) / error_um;
    if (count <= kMost && times > (count == 1 ? kFar : kFarOfTwo))
      found.push_back(
          {table.rows[most].kind, table.place(table.rows[most]), row_um[most], count, times});
    i = next - 1;
  }
}

}  // namespace

std::vector<std::string> notes_on_far_values(const FlankGeometry& geometry,
                                             const Observations& table,
                                             const std::vector<float>& row_um,
                                             const std::function<double(const Place&)>& told_um) {
  constexpr std::size_t kMostTold = 3;
  // Traces of one flank at one place.
  std::map<std::array<long long, 4>, Trace> traces;
  const auto key_of = [](ObservationKind kind, int source, const Place& place) {
    return std::array<long long, 4>{
        static_cast<long long>(kind), source, place.side * place.tooth,
        std::llround(1e3 * (kind == ObservationKind::kProfile ? place.z_mm : place.roll_mm))};
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const bool profile = row.kind == ObservationKind::kProfile;
    if (!(profile || row.kind == ObservationKind::kHelix) || !std::isfinite(row_um[i])) continue;
    const Place& place = table.place(row);
    traces[key_of(row.kind, row.source, place)].emplace_back(profile ? place.roll_mm : place.z_mm,
                                                             i);
  }
  std::vector<float> all;
  std::erase_if(traces, [](const auto& trace) {
    constexpr std::size_t kFewestValues = 15;
    return trace.second.size() < kFewestValues;
  });
  for (const auto& [key, trace] : traces)
    for (const auto& [at, row] : trace) all.push_back(row_um[row]);
  const double usual_um = robust_sigma(all);
  std::vector<FarValues> found;
  for (auto& [key, trace] : traces) {
    std::sort(trace.begin(), trace.end());
    std::vector<float> own;
    for (const auto& [at, row] : trace) own.push_back(row_um[row]);
    add_far_values(table, trace, row_um, std::max(usual_um, robust_sigma(own)), found);
  }
  if (usual_um > 0.0)
    for (const Observations::LeftOut& value : table.left_out) {
      const bool profile = value.kind == ObservationKind::kProfile;
      const auto told = [&](const auto& trace) {
        return std::array{trace.first[0], trace.first[2], trace.first[3]} ==
                   std::array{static_cast<long long>(value.kind),
                              static_cast<long long>(value.place.side * value.place.tooth),
                              key_of(value.kind, 0, value.place)[3]} &&
               is_told(table, trace.second, value, profile ? value.place.roll_mm : value.place.z_mm,
                       told_um);
      };
      if (std::any_of(traces.begin(), traces.end(), told)) continue;
      found.push_back(
          {value.kind, value.place, value.off_um, 1, std::abs(value.off_um) / usual_um});
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const FarValues& a, const FarValues& b) { return a.times > b.times; });
  std::vector<std::string> notes;
  for (const FarValues& one : found)
    if (notes.size() < kMostTold) notes.push_back(note_on(geometry, one));
  if (found.size() > notes.size())
    notes.push_back(
        printed("%.0f more places of traces", static_cast<double>(found.size() - notes.size())) +
        " have one or two values that lie as far off by themselves");
  return notes;
}

}  // namespace trueflank::loop
