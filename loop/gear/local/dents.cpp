// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/dents.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::loop {
namespace {

constexpr int kFaceParts = 12;

double bell(double off) { return std::exp(-off * off); }

/// Residuals of a flank's teeth over the face.
struct FlankSums {
  std::vector<std::array<double, kFaceParts>> sum, count;
};

struct Shares {
  double product = 0.0, square = 0.0;
};

}  // namespace

std::optional<Dent> largest_dent(const FlankGeometry& geometry, const Observations& table,
                                 const std::vector<float>& row_um, const std::vector<bool>& used) {
  const int z = geometry.teeth();
  std::array<FlankSums, 2> flanks;
  for (FlankSums& flank : flanks) {
    flank.sum.assign(static_cast<std::size_t>(z), {});
    flank.count = flank.sum;
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!used[i] || table.rows[i].kind != ObservationKind::kScanFlank) continue;
    const Place& place = table.place(table.rows[i]);
    const double share = place.z_mm / geometry.face_width_mm();
    const auto part = static_cast<std::size_t>(
        std::clamp(static_cast<int>(share * kFaceParts), 0, kFaceParts - 1));
    FlankSums& flank = flanks[place.side > 0 ? 1 : 0];
    flank.sum[static_cast<std::size_t>(place.tooth - 1)][part] += row_um[i];
    flank.count[static_cast<std::size_t>(place.tooth - 1)][part] += 1.0;
  }
  Dent best;
  const auto judge = [&](double tooth, double half_teeth, double share, double half_share) {
    std::array<Shares, 2> of_flank;
    std::array<double, kFaceParts> over_face;
    for (int k = 0; k < kFaceParts; ++k)
      over_face[static_cast<std::size_t>(k)] =
          half_share > 0.0 ? bell(((k + 0.5) / kFaceParts - share) / half_share) : 1.0;
    const int reach = std::min(static_cast<int>(std::ceil(3.0 * half_teeth)), (z - 1) / 2);
    for (int off = -reach; off <= reach; ++off) {
      const int number = static_cast<int>(std::floor(tooth)) + off;
      const auto at = static_cast<std::size_t>(((number - 1) % z + z) % z);
      const double weight = bell((number - tooth) / half_teeth);
      for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t k = 0; k < kFaceParts; ++k) {
          const double form = weight * over_face[k];
          of_flank[s].product += form * flanks[s].sum[at][k];
          of_flank[s].square += form * form * flanks[s].count[at][k];
        }
    }
    const Shares both{of_flank[0].product + of_flank[1].product,
                      of_flank[0].square + of_flank[1].square};
    const auto take = [&](const Shares& shares, int side, double factor) {
      if (!(shares.square > 0.0)) return;
      const double square = shares.product * shares.product / shares.square;
      if (factor * square <= best.square) return;
      best = {side,
              tooth,
              half_teeth,
              share * geometry.face_width_mm(),
              half_share * geometry.face_width_mm(),
              square,
              shares.product / shares.square};
    };
    // One flank alone must not be told of both for a little noise.
    constexpr double kOneFlankToo = 0.9;
    take(both, 0, 1.0);
    take(of_flank[1], 1, kOneFlankToo);
    take(of_flank[0], -1, kOneFlankToo);
  };
  for (const double half_teeth : {0.7, 1.0, 1.4, 2.0, 2.8})
    for (double tooth = 1.0; tooth < z + 1.0; tooth += 0.25)
      for (const double half_share : {0.08, 0.13, 0.2, 0.32, 0.5, 0.0})
        for (double share = 0.0; share <= (half_share > 0.0 ? 1.0 : 0.0); share += 1.0 / kFaceParts)
          judge(tooth, half_teeth, share, half_share);
  if (!(best.square > 0.0)) return std::nullopt;
  return best;
}

}  // namespace trueflank::loop
