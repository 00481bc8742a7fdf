// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/dents.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trueflank::loop {
namespace {

constexpr int kFaceParts = 12;

double bell(double off) { return std::exp(-off * off); }

using OverFace = std::array<double, kFaceParts>;

/// Residuals of a flank's teeth over the face.
struct FlankSums {
  std::vector<OverFace> sum, count;
};

/// What a form has in common with the residuals, and with itself.
struct Shares {
  double product = 0.0, square = 0.0;
};

/// A place and a length over the face, as shares of it.
struct FaceForm {
  double share = 0.0, half_share = 0.0;  ///< half 0: over all of it
  OverFace form{}, square{};
};

std::vector<FaceForm> face_forms() {
  std::vector<FaceForm> forms;
  for (const double half_share : {0.08, 0.13, 0.2, 0.32, 0.5, 0.0})
    for (double share = 0.0; share <= (half_share > 0.0 ? 1.0 : 0.0); share += 1.0 / kFaceParts) {
      FaceForm& one = forms.emplace_back(FaceForm{.share = share, .half_share = half_share});
      for (std::size_t k = 0; k < kFaceParts; ++k) {
        const double middle = (static_cast<double>(k) + 0.5) / kFaceParts;
        one.form[k] = half_share > 0.0 ? bell((middle - share) / half_share) : 1.0;
        one.square[k] = one.form[k] * one.form[k];
      }
    }
  return forms;
}

/// A flank's residuals and counts with the form over the teeth taken in: over the face is left.
struct AcrossTeeth {
  OverFace product{}, square{};
};

Shares shares_of(const AcrossTeeth& teeth, const FaceForm& face) {
  Shares shares;
  for (std::size_t k = 0; k < kFaceParts; ++k) {
    shares.product += face.form[k] * teeth.product[k];
    shares.square += face.square[k] * teeth.square[k];
  }
  return shares;
}

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
  const std::vector<FaceForm> faces = face_forms();
  Dent best;
  const auto judge = [&](double tooth, double half_teeth) {
    std::array<AcrossTeeth, 2> of_flank;
    const int reach = std::min(static_cast<int>(std::ceil(3.0 * half_teeth)), (z - 1) / 2);
    for (int off = -reach; off <= reach; ++off) {
      const int number = static_cast<int>(std::floor(tooth)) + off;
      const auto at = static_cast<std::size_t>(((number - 1) % z + z) % z);
      const double weight = bell((number - tooth) / half_teeth);
      for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t k = 0; k < kFaceParts; ++k) {
          of_flank[s].product[k] += weight * flanks[s].sum[at][k];
          of_flank[s].square[k] += weight * weight * flanks[s].count[at][k];
        }
    }
    for (const FaceForm& face : faces) {
      const auto take = [&](const Shares& shares, int side, double factor) {
        if (!(shares.square > 0.0)) return;
        const double square = shares.product * shares.product / shares.square;
        if (factor * square <= best.square) return;
        best = {side,
                tooth,
                half_teeth,
                face.share * geometry.face_width_mm(),
                face.half_share * geometry.face_width_mm(),
                square,
                shares.product / shares.square};
      };
      const Shares right = shares_of(of_flank[0], face), left = shares_of(of_flank[1], face);
      // One flank alone must not be told of both for a little noise.
      constexpr double kOneFlankToo = 0.9;
      take({right.product + left.product, right.square + left.square}, 0, 1.0);
      take(left, 1, kOneFlankToo);
      take(right, -1, kOneFlankToo);
    }
  };
  // Form over the teeth times form over the face: the sums over the teeth serve all over the face.
  for (const double half_teeth : {0.7, 1.0, 1.4, 2.0, 2.8})
    for (double tooth = 1.0; tooth < z + 1.0; tooth += 0.25) judge(tooth, half_teeth);
  if (!(best.square > 0.0)) return std::nullopt;
  return best;
}

}  // namespace trueflank::loop
