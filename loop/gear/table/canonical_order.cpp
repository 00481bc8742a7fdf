// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/canonical_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace trueflank::loop {
namespace {

/// Numbers that are none come first.
double comparable(double value) {
  return std::isnan(value) ? -std::numeric_limits<double>::infinity() : value;
}

auto contents_of(const InspectionRow& row) {
  return std::array{static_cast<double>(row.record), static_cast<double>(row.tooth),
                    static_cast<double>(row.flank),  comparable(row.diameter_mm),
                    comparable(row.z_mm),            comparable(row.fraction),
                    comparable(row.deviation_um),    comparable(row.sigma_um)};
}
auto contents_of(const SizeRow& row) {
  return std::array{static_cast<double>(row.quantity), comparable(row.detail), row.value_mm,
                    comparable(row.sigma_um)};
}

/// Rows of a file in whatever order they stand.
template <class File>
auto sorted_contents(const File& file) {
  std::vector<decltype(contents_of(file.rows.front()))> contents;
  for (const auto& row : file.rows) contents.push_back(contents_of(row));
  std::sort(contents.begin(), contents.end());
  return contents;
}

template <class File>
void sort_tables(std::vector<File>& files) {
  using Contents = decltype(sorted_contents(files.front()));
  std::vector<std::tuple<std::string, Contents, std::string, File>> keyed;
  for (File& file : files)
    keyed.emplace_back(file.part, sorted_contents(file), file.file, std::move(file));
  const auto key_of = [](const auto& one) {
    return std::tie(std::get<0>(one), std::get<1>(one), std::get<2>(one));
  };
  std::stable_sort(keyed.begin(), keyed.end(),
                   [&](const auto& a, const auto& b) { return key_of(a) < key_of(b); });
  for (std::size_t i = 0; i < files.size(); ++i) files[i] = std::move(std::get<3>(keyed[i]));
}

/// What decides where a row stands within its record, and a record among others.
struct RowKey {
  ObservationKind kind = ObservationKind::kSize;
  std::array<double, 10> values{};
  auto operator<=>(const RowKey&) const = default;
};

RowKey key_of(const Observations& table, const Observation& row) {
  const Place& place = table.place(row);
  const bool helix = row.kind == ObservationKind::kHelix;
  return {row.kind,
          {static_cast<double>(place.surface), static_cast<double>(place.tooth),
           static_cast<double>(-place.side), helix ? place.z_mm : place.roll_mm,
           helix ? place.roll_mm : place.z_mm, place.radius_mm, static_cast<double>(row.places),
           row.weight, row.deviation_um, comparable(table.sigma_um(row))}};
}

/// Rows that share a zero, or of one kind of a file that has none.
using Record = std::vector<std::size_t>;

std::vector<Record> records_in_order(const Observations& table, const std::vector<RowKey>& keys,
                                     std::size_t first) {
  std::map<std::array<int, 3>, Record> by_zero;
  for (std::size_t i = first; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    by_zero[{static_cast<int>(row.kind), row.source, row.trace}].push_back(i);
  }
  const auto key = [&](std::size_t row) -> const RowKey& { return keys[row - first]; };
  std::vector<Record> records;
  for (auto& [zero, record] : by_zero) {
    std::stable_sort(record.begin(), record.end(),
                     [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    records.push_back(std::move(record));
  }
  std::stable_sort(records.begin(), records.end(), [&](const Record& a, const Record& b) {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [&](std::size_t one, std::size_t other) { return key(one) < key(other); });
  });
  return records;
}

}  // namespace

void put_files_in_order(MeasuredData& data) {
  const auto key_of = [](const ScanData& scan) {
    return std::tie(scan.part, scan.points_mm, scan.file);
  };
  std::stable_sort(data.scans.begin(), data.scans.end(), [&](const ScanData& a, const ScanData& b) {
    return key_of(a) < key_of(b);
  });
  sort_tables(data.inspections);
  sort_tables(data.sizes);
  std::sort(data.processes.begin(), data.processes.end());
}

std::vector<std::size_t> put_rows_in_order(Observations& table) {
  const std::size_t first = table.points_mm.size();
  const auto scans = static_cast<int>(table.poses.size());
  std::vector<RowKey> keys;
  for (std::size_t i = first; i < table.rows.size(); ++i)
    keys.push_back(key_of(table, table.rows[i]));
  std::vector<std::size_t> new_place(keys.size());
  std::vector<Observation> rows;
  rows.reserve(keys.size());
  std::map<int, int> traces;
  std::map<ObservationKind, std::map<int, int>> sources;
  for (const Record& record : records_in_order(table, keys, first))
    for (const std::size_t i : record) {
      new_place[i - first] = first + rows.size();
      Observation& row = rows.emplace_back(table.rows[i]);
      std::map<int, int>& of_kind = sources[row.kind];
      row.source =
          of_kind.try_emplace(row.source, scans + static_cast<int>(of_kind.size())).first->second;
      if (row.trace >= 0)
        row.trace = traces.try_emplace(row.trace, static_cast<int>(traces.size())).first->second;
    }
  std::copy(rows.begin(), rows.end(), table.rows.begin() + static_cast<std::ptrdiff_t>(first));
  return new_place;
}

}  // namespace trueflank::loop
