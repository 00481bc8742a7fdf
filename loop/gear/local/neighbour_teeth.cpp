// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/neighbour_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

constexpr int kOrders = 1999, kProfileParts = 5, kFaceParts = 8, kFewestNeighbours = 8;

/// A place on a flank, the same on every tooth: kind of record, source, profile part, face part.
using PlaceKey = std::array<int, 4>;

int part_of_range(double coordinate, int parts) {
  return std::clamp(static_cast<int>(0.5 * (coordinate + 1.0) * parts), 0, parts - 1);
}

/// Mean residual of every place and tooth of one flank, less the place's mean over the teeth.
struct FlankResidual {
  std::map<PlaceKey, Eigen::VectorXd> sum, weight;

  void add(const PlaceKey& key, int tooth, int teeth, double value, double own) {
    auto [s, is_new] = sum.emplace(key, Eigen::VectorXd::Zero(teeth));
    auto [w, unused] = weight.emplace(key, Eigen::VectorXd::Zero(teeth));
    s->second[tooth - 1] += own * value;
    w->second[tooth - 1] += own;
  }
  void centre() {
    for (auto& [key, s] : sum) {
      const Eigen::VectorXd& w = weight.at(key);
      const double mean = s.sum() / w.sum();
      for (Eigen::Index k = 0; k < s.size(); ++k) s[k] = w[k] > 0.0 ? s[k] / w[k] - mean : 0.0;
    }
  }
  /// Products of teeth, summed over the places; each weighs by what it usually knows.
  [[nodiscard]] Eigen::MatrixXd products(int teeth) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(teeth, teeth);
    for (const auto& [key, s] : sum) result += weight.at(key).mean() * s * s.transpose();
    return result;
  }
};

/// Of neighbours among the teeth that were measured; `at` says whose values stand where.
double of_neighbours(const Eigen::MatrixXd& products, const std::vector<int>& at) {
  double sum = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const int next = at[(k + 1) % at.size()];
    if (at[k] >= 0 && next >= 0) sum += products(at[k], next);
  }
  return sum;
}

}  // namespace

SharedByNeighbours shared_by_neighbours(const FlankGeometry& geometry, const Patches& patches,
                                        const std::vector<float>& row_um) {
  std::vector<double> sum(patches.patches.size(), 0.0), count(patches.patches.size(), 0.0);
  for (std::size_t i = 0; i < row_um.size(); ++i) {
    const int patch = patches.patch_of_row[i];
    if (patch < 0) continue;
    sum[static_cast<std::size_t>(patch)] += row_um[i];
    count[static_cast<std::size_t>(patch)] += 1.0;
  }
  const int teeth = geometry.teeth();
  std::array<FlankResidual, 2> flanks;
  std::vector<int> designed(static_cast<std::size_t>(teeth), -1);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Patches::Patch& patch = patches.patches[i];
    const Place& place = patch.places.front().place;
    if (patch.whole < 0 || count[i] == 0.0) continue;
    const PlaceKey key{static_cast<int>(patch.kind), patch.source,
                       part_of_range(geometry.profile_coordinate(place.roll_mm), kProfileParts),
                       part_of_range(geometry.face_coordinate(place.z_mm), kFaceParts)};
    flanks[place.side > 0 ? 1 : 0].add(key, place.tooth, teeth, sum[i] / count[i], patch.weight);
    designed[static_cast<std::size_t>(place.tooth - 1)] = place.tooth - 1;
  }
  std::vector<int> measured;
  std::copy_if(designed.begin(), designed.end(), std::back_inserter(measured),
               [](int k) { return k >= 0; });
  SharedByNeighbours result;
  if (static_cast<int>(measured.size()) < kFewestNeighbours) return result;
  std::array<Eigen::MatrixXd, 2> products;
  for (std::size_t s = 0; s < 2; ++s) {
    flanks[s].centre();
    products[s] = flanks[s].products(teeth);
  }
  const double seen = of_neighbours(products[0], designed) + of_neighbours(products[1], designed);
  std::mt19937_64 random(20260108);
  int as_much = 0;
  for (int order = 0; order < kOrders; ++order) {
    double shuffled = 0.0;
    for (const Eigen::MatrixXd& of_flank : products) {
      for (std::size_t i = measured.size(); i > 1; --i)
        std::swap(measured[i - 1], measured[random() % i]);
      std::vector<int> at = designed;
      std::size_t next = 0;
      for (int& k : at)
        if (k >= 0) k = measured[next++];
      shuffled += of_neighbours(of_flank, at);
    }
    as_much += shuffled >= seen;
  }
  result.p_value = (1.0 + as_much) / (kOrders + 1.0);
  for (const FlankResidual& flank : flanks)
    for (const auto& [key, s] : flank.sum)
      for (int k = 0; k < teeth; ++k) {
        const double mean = (s[(k + teeth - 1) % teeth] + s[k] + s[(k + 1) % teeth]) / 3.0;
        if (std::abs(mean) <= std::abs(result.amount_um)) continue;
        result.amount_um = mean;
        result.tooth = k + 1;
        result.height_mm = (key[3] + 0.5) / kFaceParts * geometry.face_width_mm();
      }
  return result;
}

std::string words_for(const SharedByNeighbours& shared) {
  return printed(
      "neighbouring teeth share what is left: most about tooth %d, at a height of %.3g mm, where "
      "%.3g um "
      "are %s; a dent, swelling or warp of a few teeth rather than a wave",
      shared.tooth, shared.height_mm, std::abs(shared.amount_um),
      shared.amount_um < 0.0 ? "missing" : "too much");
}

}  // namespace trueflank::loop
