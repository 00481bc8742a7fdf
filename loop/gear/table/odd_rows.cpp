// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/odd_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

/// Where a row was measured; what is not given is one place.
using PlaceOfRow = std::array<double, 6>;

PlaceOfRow place_of(const InspectionRow& row) {
  const auto given = [](double value) {
    return std::isnan(value) ? std::numeric_limits<double>::lowest() : value;
  };
  return {static_cast<double>(row.record),
          static_cast<double>(row.tooth),
          static_cast<double>(row.flank),
          given(row.diameter_mm),
          given(row.z_mm),
          given(row.fraction)};
}

std::size_t leave_out_rows_twice(InspectionData& data, RecordKind kind) {
  std::map<PlaceOfRow, double> first;
  std::size_t twice = 0;
  for (const InspectionRow& row : data.rows) {
    if (row.record != kind) continue;
    const auto [known, is_new] = first.try_emplace(place_of(row), row.deviation_um);
    if (is_new) continue;
    if (known->second != row.deviation_um) return 0;
    ++twice;
  }
  if (twice == 0) return 0;
  std::set<PlaceOfRow> seen;
  std::erase_if(data.rows, [&](const InspectionRow& row) {
    return row.record == kind && !seen.insert(place_of(row)).second;
  });
  return twice;
}

/// A trace: tooth and flank; its scatter beside its neighbours, and how far it goes.
using TraceName = std::array<int, 2>;
struct SizeOfTrace {
  double scatter_um = 0.0, range_um = 0.0;
};

std::map<TraceName, SizeOfTrace> sizes_of_traces(const InspectionData& data, RecordKind kind) {
  constexpr std::size_t kFewest = 12;
  std::map<TraceName, std::vector<double>> values;
  for (const InspectionRow& row : data.rows)
    if (row.record == kind)
      values[{row.tooth, static_cast<int>(row.flank)}].push_back(row.deviation_um);
  std::map<TraceName, SizeOfTrace> sizes;
  for (const auto& [name, trace] : values) {
    if (trace.size() < kFewest) continue;
    double square = 0.0;
    for (std::size_t i = 2; i < trace.size(); ++i)
      square += std::pow(trace[i] - 2.0 * trace[i - 1] + trace[i - 2], 2);
    const auto [least, most] = std::minmax_element(trace.begin(), trace.end());
    sizes[name] = {std::sqrt(square / (6.0 * static_cast<double>(trace.size() - 2))),
                   *most - *least};
  }
  return sizes;
}

struct Unit {
  double times = 0.0;
  const char* words = "";
};

/// Of a trace that is so many times smaller than the others; none where that is no unit.
const Unit* unit_of(double times) {
  constexpr double kNearly = 1.6;  // errors and forms differ by less from trace to trace
  static const std::array<Unit, 2> units{
      {{1000.0, "1000 times smaller than the others: in mm, not in um?"},
       {25.4, "25 times smaller than the others: in thousandths of an inch, not in um?"}}};
  for (const Unit& unit : units)
    if (times > unit.times / kNearly && times < unit.times * kNearly) return &unit;
  return nullptr;
}

void leave_out_traces_of_another_unit(InspectionData& data, RecordKind kind,
                                      std::vector<std::string>& notes) {
  constexpr std::size_t kFewest = 4;
  constexpr double kFarSmaller = 10.0, kMostOfThem = 0.4;
  const std::map<TraceName, SizeOfTrace> sizes = sizes_of_traces(data, kind);
  if (sizes.size() < kFewest) return;
  std::vector<double> scatters, ranges;
  for (const auto& [name, size] : sizes) {
    scatters.push_back(size.scatter_um);
    ranges.push_back(size.range_um);
  }
  std::map<const Unit*, std::vector<TraceName>> odd;
  std::size_t count = 0;
  // The usual one of the others, which are most.
  const std::size_t usual_one = 7 * sizes.size() / 10;
  const double usual = nth_smallest(scatters, usual_one),
               usual_range = nth_smallest(ranges, usual_one);
  for (const auto& [name, size] : sizes) {
    if (!(size.scatter_um > 0.0) || usual < kFarSmaller * size.scatter_um ||
        usual_range < kFarSmaller * size.range_um)
      continue;
    if (const Unit* unit = unit_of(usual / size.scatter_um)) {
      odd[unit].push_back(name);
      ++count;
    }
  }
  if (count == 0 || static_cast<double>(count) > kMostOfThem * static_cast<double>(sizes.size()))
    return;
  for (const auto& of_unit : odd) {
    const Unit* unit = of_unit.first;
    const std::vector<TraceName>& names = of_unit.second;
    std::set<int> teeth;
    for (const TraceName& name : names) teeth.insert(name[0]);
    std::string text;
    for (const int tooth : teeth) text += (text.empty() ? "" : ", ") + std::to_string(tooth);
    notes.push_back(data.file + ": " + std::to_string(names.size()) +
                    (kind == RecordKind::kProfile ? " profile" : " helix") +
                    " traces are left out, of tooth " + text +
                    ": they and their scatter are about " + unit->words);
    std::erase_if(data.rows, [&](const InspectionRow& row) {
      return row.record == kind &&
             std::find(names.begin(), names.end(),
                       TraceName{row.tooth, static_cast<int>(row.flank)}) != names.end();
    });
  }
}

}  // namespace

std::vector<std::string> leave_out_copies(std::vector<InspectionData>& inspections) {
  constexpr std::size_t kFewest = 8;
  const auto is_copy = [](const InspectionData& one, const InspectionData& other) {
    return one.part == other.part && one.rows.size() == other.rows.size() &&
           std::equal(one.rows.begin(), one.rows.end(), other.rows.begin(),
                      [](const InspectionRow& a, const InspectionRow& b) {
                        return place_of(a) == place_of(b) && a.deviation_um == b.deviation_um;
                      });
  };
  std::vector<std::string> notes;
  for (std::size_t k = 1; k < inspections.size();) {
    const auto end = inspections.begin() + static_cast<std::ptrdiff_t>(k);
    const auto first = std::find_if(inspections.begin(), end, [&](const InspectionData& one) {
      return is_copy(one, inspections[k]);
    });
    if (first == end || inspections[k].rows.size() < kFewest) {
      ++k;
      continue;
    }
    notes.push_back(inspections[k].file + ": has the rows of " + first->file +
                    " to the last digit: counted once");
    inspections.erase(end);
  }
  return notes;
}

std::vector<std::string> leave_out_odd_rows(InspectionData& data) {
  std::vector<std::string> notes;
  std::size_t twice = 0;
  for (const RecordKind kind :
       {RecordKind::kProfile, RecordKind::kHelix, RecordKind::kIndex, RecordKind::kRadial})
    twice += leave_out_rows_twice(data, kind);
  if (twice > 0)
    notes.push_back(data.file + ": " + std::to_string(twice) +
                    (twice == 1 ? " row stands" : " rows stand") +
                    " there twice to the last digit: counted once");
  for (const RecordKind kind : {RecordKind::kProfile, RecordKind::kHelix})
    leave_out_traces_of_another_unit(data, kind, notes);
  return notes;
}

}  // namespace trueflank::loop
