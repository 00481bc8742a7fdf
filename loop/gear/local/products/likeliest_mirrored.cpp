// SPDX-License-Identifier: GPL-3.0-or-later
// Waves over the profile that are the same on every tooth, each flank in a phase of its own, as
// residuals in cells look like most beside other effects.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop::product_cells {
namespace {

/// The flanks of all teeth together: a row for every cell over the profile of either side, the
/// clockwise one first.
class BothProfiles {
 public:
  BothProfiles(const FlankGeometry& g, const OfTeeth& teeth) : geometry_(g) {
    for (const auto& tooth : teeth)
      for (const std::size_t side : {0U, 1U})
        for (std::size_t i = 0; i < kProductCells; ++i) {
          const auto row = static_cast<Eigen::Index>(side * kProductCells + i);
          root_[row] += tooth[side].profile[i].weight;
          value_[row] += tooth[side].profile[i].value;
        }
    root_ = root_.cwiseSqrt();
  }
  /// A level of either flank, and what these effects do on a tooth, times the roots of the weights.
  [[nodiscard]] Eigen::MatrixXd columns_of(const std::vector<Effect>& effects) const {
    Eigen::Index count = 2;
    for (const Effect& effect : effects) count += effect.columns();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(kRows, count);
    std::vector<double> own;
    for (Eigen::Index row = 0; row < kRows; ++row) {
      const bool second = row >= kProductCells;
      all(row, second ? 1 : 0) = 1.0;
      const double share = (static_cast<double>(row % kProductCells) + 0.5) / kProductCells,
                   low = geometry_.root_form_roll_mm(), high = geometry_.tip_form_roll_mm();
      const Place place = geometry_.on_flank(1, second ? 1 : -1, low + share * (high - low),
                                             0.5 * geometry_.face_width_mm());
      Eigen::Index at = 2;
      for (const Effect& effect : effects) {
        own.resize(static_cast<std::size_t>(effect.columns()));
        effect.evaluate(geometry_, place, own.data());
        for (const double value : own) all(row, at++) = value;
      }
    }
    return root_.asDiagonal() * all;
  }
  /// Residuals, as columns are: by the roots of the weights.
  [[nodiscard]] Eigen::VectorXd values() const {
    return (root_.array() > 0.0).select(value_.array() / root_.array().max(1e-300), 0.0);
  }

 private:
  static constexpr Eigen::Index kRows = 2 * kProductCells;
  const FlankGeometry& geometry_;
  Eigen::Matrix<double, kRows, 1> root_ = Eigen::Matrix<double, kRows, 1>::Zero(),
                                  value_ = Eigen::Matrix<double, kRows, 1>::Zero();
};

/// What columns take out of values, and others beside them.
class Beside {
 public:
  Beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values)
      : span_(orthonormal_columns(columns)),
        left_(values - span_ * (span_.transpose() * values)),
        taken_(values.squaredNorm() - left_.squaredNorm()) {}
  [[nodiscard]] double taken_with(const Eigen::MatrixXd& others) const {
    const Eigen::MatrixXd own = others - span_ * (span_.transpose() * others);
    const Eigen::VectorXd right = own.transpose() * left_;
    Eigen::MatrixXd normal = own.transpose() * own;
    normal.diagonal().array() += 1e-6 * others.squaredNorm();
    return taken_ + right.dot(symmetric_solution(normal, right));
  }

 private:
  Eigen::MatrixXd span_;
  Eigen::VectorXd left_;
  double taken_;
};

}  // namespace

LikelyWavesBeside likeliest_profile_waves(const FlankGeometry& g, const OfTeeth& teeth,
                                          const std::vector<std::vector<Effect>>& besides) {
  constexpr double kShortest = 1.0 / 12.0, kLongest = 1.35;  // of the profile
  constexpr std::size_t kMostForms = 3;
  const double range = std::abs(gear_effects::range_mm(g, 0.0));
  // Phases of the flanks against each other turn with the length, the more the longer the roll.
  const auto next = [roll_mm = std::max(g.root_form_roll_mm(), g.tip_form_roll_mm())](double mm) {
    constexpr double kMost = 0.04, kOfATurn = 0.08;
    return mm * (1.0 + std::min(kMost, kOfATurn * mm / roll_mm));
  };
  const BothProfiles profiles(g, teeth);
  const Eigen::VectorXd values = profiles.values();
  std::vector<Beside> beside;
  for (const std::vector<Effect>& effects : besides)
    beside.emplace_back(profiles.columns_of(effects), values);
  LikelyWavesBeside best;
  for (const bool mirrored : {true, false}) {
    std::vector<std::vector<Likely>> waves(besides.size());
    for (double length = kShortest * range; length < kLongest * range; length = next(length)) {
      std::vector<Effect> form;
      if (mirrored)
        form = {{find_family("unnamed_waves_mirrored"), FlankChoice::kBoth, {length}}};
      else
        for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
          form.push_back({find_family("unnamed_waviness"), flank, {0.0, length}});
      const Eigen::MatrixXd columns = profiles.columns_of(form);
      for (std::size_t b = 0; b < besides.size(); ++b)
        waves[b].push_back(
            {beside[b].taken_with(columns.rightCols(columns.cols() - 2)), form.front()});
    }
    WavesBeside kind;
    for (std::size_t b = 0; b < besides.size(); ++b) {
      std::stable_sort(waves[b].begin(), waves[b].end(),
                       [](const Likely& a, const Likely& c) { return a.gain > c.gain; });
      if (!kind.waves.forms.empty() && !(waves[b].front().gain > kind.waves.gain)) continue;
      kind = {.waves = {waves[b].front().gain, {}}, .beside = besides[b]};
      for (std::size_t w = 0; w < std::min(kMostForms, waves[b].size()); ++w)
        kind.waves.forms.push_back(waves[b][w].form);
    }
    (mirrored ? best.mirrored : best.of_either_flank) = std::move(kind);
  }
  return best;
}

}  // namespace trueflank::loop::product_cells
