// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/table/size_scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

bool is_of_flanks(SizeQuantity quantity) {
  return quantity == SizeQuantity::kSpan || quantity == SizeQuantity::kOverPins;
}

double own_sigma_um(const Observations& table, const SizeInTable& size) {
  return table.size_sigma_um(table.rows[size.row]);
}

void set_sigma_um(Observations& table, const SizeInTable& size, double sigma_um) {
  const std::size_t at = table.rows[size.row].first_place;
  if (table.sigmas_um.size() <= at) table.sigmas_um.resize(at + 1, kNaN);
  table.sigmas_um[at] = sigma_um;
}

/// Index of both flanks of every tooth; none where some tooth has no value.
class IndexOfFlanks {
 public:
  IndexOfFlanks(const Observations& table, int teeth) {
    std::array<std::vector<double>, 2> count;
    for (std::size_t side = 0; side < 2; ++side) {
      um_[side].assign(static_cast<std::size_t>(teeth), 0.0);
      count[side].assign(static_cast<std::size_t>(teeth), 0.0);
    }
    for (const Observation& row : table.rows) {
      if (row.kind != ObservationKind::kIndex) continue;
      const Place& place = table.place(row);
      const std::size_t side = place.side > 0 ? 1 : 0,
                        tooth = static_cast<std::size_t>(place.tooth) - 1;
      um_[side][tooth] += row.deviation_um;
      count[side][tooth] += 1.0;
    }
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < um_[side].size(); ++k) {
        is_whole_ = is_whole_ && count[side][k] > 0.0;
        um_[side][k] /= std::max(1.0, count[side][k]);
      }
  }

  [[nodiscard]] bool is_whole() const { return is_whole_; }
  /// Variance around the gear of the mean of the flanks that a size rests on [um2].
  [[nodiscard]] double variance_of(const SizeInTable& size) const {
    const std::size_t z = um_[0].size();
    double sum = 0.0, square = 0.0;
    for (std::size_t k = 0; k < z; ++k) {
      const auto gap_after = [&](std::size_t tooth) {
        return um_[1][tooth % z] + um_[0][(tooth + 1) % z];
      };
      const double mean =
          size.quantity == SizeQuantity::kSpan
              ? 0.5 * (um_[0][k] + um_[1][(k + static_cast<std::size_t>(size.detail) - 1) % z])
              : 0.25 * (gap_after(k) + gap_after(k + z / 2));
      sum += mean;
      square += mean * mean;
    }
    const auto n = static_cast<double>(z);
    return std::max(0.0, square / n - sum * sum / (n * n));
  }

 private:
  std::array<std::vector<double>, 2> um_;  ///< of the clockwise flanks, of the others
  bool is_whole_ = true;
};

void add_what_teeth_differ_by(const FlankGeometry& geometry, const std::vector<SizeInTable>& sizes,
                              Observations& table) {
  const IndexOfFlanks index(table, geometry.teeth());
  if (!index.is_whole()) return;
  for (const SizeInTable& size : sizes) {
    if (!is_of_flanks(size.quantity)) continue;
    const Observation& row = table.rows[size.row];
    const double of_all = row.weight * row.places;  // um of the size, of a um on every flank
    const double variance = of_all * of_all * index.variance_of(size);
    if (variance > 0.0)
      set_sigma_um(table, size, std::hypot(own_sigma_um(table, size), std::sqrt(variance)));
  }
}

/// How far sizes that were measured several times scatter.
struct Scatter {
  double square = 0.0;  ///< of the deviations from their means over their errors
  double um2 = 0.0;     ///< the same in um2
  int degrees = 0;
};

Scatter scatter_of(const std::vector<SizeInTable>& sizes, bool of_flanks,
                   const Observations& table) {
  std::map<std::pair<SizeQuantity, double>, std::vector<const SizeInTable*>> repeated;
  for (const SizeInTable& size : sizes)
    if (is_of_flanks(size.quantity) == of_flanks)
      repeated[{size.quantity, std::isnan(size.detail) ? 0.0 : size.detail}].push_back(&size);
  Scatter scatter;
  for (const auto& [what, group] : repeated) {
    double weights = 0.0, mean = 0.0;
    for (const SizeInTable* size : group) {
      const double sigma = own_sigma_um(table, *size), weight = 1.0 / (sigma * sigma);
      weights += weight;
      mean += weight * table.rows[size->row].deviation_um;
    }
    mean /= weights;
    for (const SizeInTable* size : group) {
      const double off = table.rows[size->row].deviation_um - mean,
                   sigma = own_sigma_um(table, *size);
      scatter.square += off * off / (sigma * sigma);
      scatter.um2 += off * off;
    }
    scatter.degrees += static_cast<int>(group.size()) - 1;
  }
  return scatter;
}

}  // namespace

std::string widen_size_errors(const FlankGeometry& geometry, const std::vector<SizeInTable>& sizes,
                              Observations& table) {
  constexpr double kByChance = 0.05;
  if (sizes.empty()) return {};
  add_what_teeth_differ_by(geometry, sizes, table);
  std::string note;
  for (const bool of_flanks : {true, false}) {
    const Scatter scatter = scatter_of(sizes, of_flanks, table);
    if (scatter.degrees < 1 || !(scatter.square > scatter.degrees) ||
        std::exp(-minus_log_chi_square_tail(scatter.square, scatter.degrees)) > kByChance)
      continue;
    const double ratio = std::sqrt(scatter.square / scatter.degrees);
    for (const SizeInTable& size : sizes)
      if (is_of_flanks(size.quantity) == of_flanks)
        set_sigma_um(table, size, ratio * own_sigma_um(table, size));
    if (table.size_degrees == 0 || scatter.degrees < table.size_degrees)
      table.size_degrees = scatter.degrees;
    note = "repeated sizes scatter by " +
           printed_number(std::sqrt(scatter.um2 / scatter.degrees), "%.3g") + " um, " +
           printed_number(ratio, "%.2g") +
           " times their errors: the scatter is taken for their error";
  }
  return note;
}

}  // namespace trueflank::loop
