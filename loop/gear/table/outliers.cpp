// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/outliers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/table/bore_wall.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewInPatch = 5;
/// Kind and source, tooth, side, parts of profile and face; the numbers of its rows, in order.
using PatchKey = std::array<int, 5>;
using RowNumbers = std::vector<std::uint32_t>;
using PatchRows = std::map<PatchKey, RowNumbers>;

PatchKey patch_key(const FlankGeometry& geometry, const Observation& row, const Place& place) {
  constexpr int kMostSources = 1 << 24;  // more files than anybody gives, so that kinds stay apart
  const auto part = [](double c, int parts) {
    return std::clamp(static_cast<int>(0.5 * (c + 1.0) * parts), 0, parts - 1);
  };
  const bool flank = place.surface == Surface::kFlank;
  const bool trace = row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
  const int u = flank ? part(geometry.profile_coordinate(place.roll_mm), trace ? 6 : 4) : 0;
  const int v = part(geometry.face_coordinate(place.z_mm), trace ? 6 : 4);
  const int tooth = place.surface == Surface::kBore
                        ? static_cast<int>(wrapped_rad(place.polar_rad) / kTwoPi * 16)
                        : place.tooth;
  return {static_cast<int>(row.kind) * kMostSources + row.source, tooth, place.side, u, v};
}

/// Patches of some rows, in the order they are met.
std::vector<std::pair<PatchKey, RowNumbers>> patches_of_rows(const FlankGeometry& geometry,
                                                             const Observations& table,
                                                             std::size_t from, std::size_t to) {
  std::vector<std::pair<PatchKey, RowNumbers>> gathered;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  // Counted first, so that each list is made once: threads that ask for memory wait for each other.
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> patch_of_row(to - from, kNone), counts;
  for (std::size_t i = from; i < to; ++i) {
    const Observation& row = table.rows[i];
    if (row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial ||
        row.kind == ObservationKind::kSize)
      continue;
    const PatchKey key = patch_key(geometry, row, table.place(row));
    // side, u and v have less than eight values each
    const std::uint64_t packed =
        (static_cast<std::uint64_t>(key[0]) << 32U) + static_cast<std::uint64_t>(key[1]) * 512U +
        static_cast<std::uint64_t>((key[2] + 1) * 64 + key[3] * 8 + key[4]);
    const auto [number, is_new] =
        numbers.try_emplace(packed, static_cast<std::uint32_t>(counts.size()));
    if (is_new) {
      gathered.push_back({key, {}});
      counts.push_back(0);
    }
    patch_of_row[i - from] = number->second;
    ++counts[number->second];
  }
  for (std::size_t k = 0; k < gathered.size(); ++k) gathered[k].second.reserve(counts[k]);
  for (std::size_t i = from; i < to; ++i)
    if (const std::uint32_t patch = patch_of_row[i - from]; patch != kNone)
      gathered[patch].second.push_back(static_cast<std::uint32_t>(i));
  return gathered;
}

/// Patches of all rows: some rows at a time on all processors, put together in their order.
PatchRows patches_of(const FlankGeometry& geometry, const Observations& table) {
  constexpr std::size_t kRowsOfWork = 65536;
  std::vector<std::vector<std::pair<PatchKey, RowNumbers>>> pieces(
      (table.rows.size() + kRowsOfWork - 1) / kRowsOfWork);
  for_each_piece(pieces.size(), [&](std::size_t piece) {
    const std::size_t from = piece * kRowsOfWork;
    pieces[piece] =
        patches_of_rows(geometry, table, from, std::min(table.rows.size(), from + kRowsOfWork));
  });
  PatchRows patches;
  for (auto& piece : pieces) {
    for (auto& [key, rows] : piece) {
      RowNumbers& all = patches[key];
      all.insert(all.end(), rows.begin(), rows.end());
    }
    piece = {};
  }
  return patches;
}

/// Patches of a flank with too few values to judge by are judged together.
void gather_small_patches(PatchRows& patches) {
  PatchRows gathered;
  for (auto patch = patches.begin(); patch != patches.end();) {
    if (patch->second.size() >= kFewInPatch) {
      ++patch;
      continue;
    }
    PatchKey key = patch->first;
    key[3] = key[4] = -1;
    RowNumbers& rows = gathered[key];
    rows.insert(rows.end(), patch->second.begin(), patch->second.end());
    patch = patches.erase(patch);
  }
  patches.merge(gathered);
}

/// The values of a thin patch of a scan and of those around it: a scratch runs through several.
RowNumbers with_patches_beside(const PatchRows& patches, const PatchRows::value_type& patch) {
  constexpr std::size_t kThin = 40;
  const PatchKey& key = patch.first;
  RowNumbers rows = patch.second;
  if (rows.size() > kThin || key[3] < 0) return rows;
  for (int du = -1; du <= 1; ++du)
    for (int dv = -1; dv <= 1; ++dv) {
      const auto beside = patches.find({key[0], key[1], key[2], key[3] + du, key[4] + dv});
      if ((du != 0 || dv != 0) && beside != patches.end() && key[3] + du >= 0 && key[4] + dv >= 0)
        rows.insert(rows.end(), beside->second.begin(), beside->second.end());
    }
  return rows;
}

/// True where the nearest values of a patch lie off as one of them does: a burr or a spot, no
/// accident.
template <class Predicate>
bool neighbours_agree(const Observations& table, const RowNumbers& patch, std::uint32_t i,
                      std::size_t asked, std::size_t needed, Predicate agrees) {
  if (patch.size() <= asked) return false;
  const Place& place = table.place(table.rows[i]);
  std::vector<std::pair<double, std::uint32_t>> near;
  near.reserve(patch.size());
  for (const std::uint32_t other : patch) {
    if (other == i) continue;
    const Place& at = table.place(table.rows[other]);
    near.emplace_back(std::hypot(at.roll_mm - place.roll_mm, at.z_mm - place.z_mm), other);
  }
  std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(asked), near.end());
  return static_cast<std::size_t>(
             std::count_if(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(asked),
                           [&](const auto& n) { return agrees(n.second); })) >= needed;
}

/// Where the values of a patch lie, and how far from there.
struct Level {
  double centre_um = 0.0, spread_um = 0.0;
};

Level level_of(const Observations& table, const RowNumbers& patch) {
  std::vector<double> values;
  values.reserve(patch.size());
  for (const std::uint32_t i : patch) values.push_back(table.rows[i].deviation_um);
  const double centre = median(values);
  for (double& value : values) value = std::abs(value - centre);
  return {centre, kSigmaOfMedianSize * median(values)};
}

bool is_of_a_trace(ObservationKind kind) {
  return kind == ObservationKind::kProfile || kind == ObservationKind::kHelix;
}

/// The step of an instrument that reads coarsely, by kind and source as patches have them; 0 of
/// scans, and where a single level and one wild value are all there is.
std::map<int, double> steps_of_readings(const Observations& table,
                                        const std::vector<const PatchRows::value_type*>& patches) {
  std::map<int, std::vector<double>> values;
  for (const auto* patch : patches) {
    const ObservationKind kind = table.rows[patch->second.front()].kind;  // of all of them
    if (!is_of_a_trace(kind)) continue;
    for (const std::uint32_t i : patch->second)
      values[patch->first[0]].push_back(table.rows[i].deviation_um);
  }
  std::map<int, double> steps;
  for (auto& [kind, list] : values) {
    const auto [least, most] = std::minmax_element(list.begin(), list.end());
    const double range = *most - *least, step = step_of_readings(std::move(list));
    steps[kind] = 2.0 * step <= range ? step : 0.0;
  }
  return steps;
}

/// The outliers of one patch; `of_kind_um` is the usual spread of its kind.
RowNumbers outliers_of(const Observations& table, const PatchRows& patches,
                       const PatchRows::value_type& of_patch, const Level& level,
                       double of_kind_um) {
  const RowNumbers& patch = of_patch.second;
  // A patch full of outliers must not set its own limit.
  const double kind = std::max(of_kind_um, 0.02);
  const double limit = 6.0 * std::clamp(level.spread_um, kind, 3.0 * kind);
  const auto above = [&](std::uint32_t i) { return table.rows[i].deviation_um - level.centre_um; };
  RowNumbers far;
  for (const std::uint32_t i : patch)
    if (std::abs(above(i)) > limit) far.push_back(i);
  // Many that agree with each other are no accident: a step runs through the patch.
  if (far.empty() || (far.size() >= 3 && 4 * far.size() > patch.size() &&
                      level_of(table, far).spread_um < 0.5 * limit))
    return {};
  const RowNumbers beside = with_patches_beside(patches, of_patch);
  std::erase_if(far, [&](std::uint32_t i) {
    const bool trace = table.rows[i].kind != ObservationKind::kScanFlank;
    return neighbours_agree(table, beside, i, trace ? 3 : 4, 2, [&](std::uint32_t other) {
      return std::abs(above(other)) > 0.5 * limit && (above(other) > 0.0) == (above(i) > 0.0);
    });
  });
  return far;
}

/// Of a scan's wild points those that lie together, where all are so few that none would do so by
/// accident: a burr that hardly a point met. `wild` says it of every row.
RowNumbers few_together(const Observations& table, const PatchRows& patches,
                        const PatchRows::value_type& of_patch, const Level& level,
                        const RowNumbers& far, const std::vector<bool>& wild) {
  constexpr std::size_t kNear = 6;
  RowNumbers together;
  if (far.empty() || table.rows[far.front()].kind != ObservationKind::kScanFlank) return together;
  const RowNumbers beside = with_patches_beside(patches, of_patch);
  for (const std::uint32_t i : far)
    if (neighbours_agree(table, beside, i, kNear, 1, [&](std::uint32_t other) {
          return wild[other] && (table.rows[other].deviation_um > level.centre_um) ==
                                    (table.rows[i].deviation_um > level.centre_um);
        }))
      together.push_back(i);
  return together;
}

void take_out(const std::vector<bool>& out, Observations& table) {
  std::size_t kept = 0, points = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (out[i]) continue;
    if (i < table.points_mm.size()) table.points_mm[points++] = table.points_mm[i];
    table.rows[kept++] = table.rows[i];
  }
  table.points_mm.resize(points);
  table.outliers = static_cast<int>(table.rows.size() - kept);
  table.rows.resize(kept);
}

}  // namespace

void leave_out_outliers(const FlankGeometry& geometry, Observations& table) {
  PatchRows patches = patches_of(geometry, table);
  gather_small_patches(patches);
  std::vector<const PatchRows::value_type*> judged;
  for (const auto& patch : patches)
    if (patch.second.size() >= kFewInPatch) judged.push_back(&patch);
  constexpr std::size_t kAtOnce = 16;
  const auto for_each_patch = [&](const auto& work) {
    for_each_run(judged.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) work(k);
    });
  };
  std::vector<Level> levels(judged.size());
  for_each_patch([&](std::size_t k) { levels[k] = level_of(table, judged[k]->second); });
  // One spread for each kind: the median of the patches' own.
  std::map<int, std::vector<double>> spreads;
  for (std::size_t k = 0; k < judged.size(); ++k)
    spreads[judged[k]->first[0]].push_back(levels[k].spread_um);
  std::map<int, double> spread_of;
  for (auto& [kind, list] : spreads) spread_of[kind] = median(list);
  // Where most values of a patch are one reading, the others are no outliers.
  for (const auto& [kind, step] : steps_of_readings(table, judged))
    spread_of[kind] = std::max(spread_of[kind], 0.5 * step);
  std::vector<RowNumbers> found(judged.size());
  for_each_patch([&](std::size_t k) {
    found[k] =
        outliers_of(table, patches, *judged[k], levels[k], spread_of.at(judged[k]->first[0]));
  });
  std::vector<bool> out(table.rows.size(), false);
  std::map<int, double> wild, all;  // rows of each kind and source
  for (std::size_t k = 0; k < judged.size(); ++k) {
    wild[judged[k]->first[0]] += static_cast<double>(found[k].size());
    all[judged[k]->first[0]] += static_cast<double>(judged[k]->second.size());
    for (const std::uint32_t i : found[k]) out[i] = true;
  }
  const std::vector<bool> far = out;
  constexpr double kByAccident = 0.01, kHalfOfNear = 3.0;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    const double few = wild[judged[k]->first[0]];
    if (found[k].empty() || few * few * kHalfOfNear > kByAccident * all[judged[k]->first[0]])
      continue;
    for (const std::uint32_t i :
         few_together(table, patches, *judged[k], levels[k], found[k], far))
      out[i] = false;
  }
  table.outliers = 0;
  for (std::size_t k = 0; k < judged.size(); ++k)
    for (const std::uint32_t i : found[k]) {
      const Observation& row = table.rows[i];
      if (out[i] && is_of_a_trace(row.kind))
        table.left_out.push_back(
            {row.kind, table.place(row), row.deviation_um - levels[k].centre_um});
    }
  for (const std::uint32_t i : rows_off_the_bore(geometry, table)) out[i] = true;
  if (std::find(out.begin(), out.end(), true) != out.end()) take_out(out, table);
}

}  // namespace trueflank::loop
