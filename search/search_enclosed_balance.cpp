// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_enclosed_balance.h"

#include "trueflank/base/contract.h"

namespace trueflank {

EnclosedBalance::EnclosedBalance(const SearchModel& model, DriveDirection direction)
    : meshes_(model.balance().size()),
      forward_(direction == DriveDirection::kForward),
      ratio_(model.ratio()) {
  TRUEFLANK_EXPECTS(meshes_ <= kMost);
  const Topology& t = model.train().topology;
  std::vector<int> members;
  for (int member = 0; member < static_cast<int>(t.members.size()); ++member)
    if (member != t.output && std::find(t.fixed.begin(), t.fixed.end(), member) == t.fixed.end())
      members.push_back(member);
  TRUEFLANK_EXPECTS(members.size() == meshes_);
  members.push_back(t.output);
  for (std::size_t k = 0; k < meshes_; ++k) {
    const SearchModel::BalanceMesh& mesh = model.balance()[k];
    teeth_ratio_[k] = mesh.teeth_ratio;
    gear1_drives_[k] = mesh.gear1_drives_forward == forward_;
    outside_[k] = members[k] == t.input ? -1.0 : 0.0;
    for (std::size_t row = 0; row < members.size(); ++row) {
      const auto acts = [&](int other) {
        if (t.is_carrier(members[row])) return t.is_planet(other) ? 0.0 : -1.0;
        return other == members[row] ? 1.0 : 0.0;
      };
      const std::size_t at = row == meshes_ ? kMost : row;
      acts1_[at][k] = acts(mesh.member1);
      acts2_[at][k] = acts(mesh.member2);
    }
  }
}

Interval EnclosedBalance::share(std::size_t row, std::size_t k, const Interval& ratio) const {
  return Interval(acts1_[row][k]) + Interval(acts2_[row][k]) * ratio;
}

Interval EnclosedBalance::determinant(const std::array<Row, kMost>& m) const {
  if (meshes_ == 1) return m[0][0];
  const auto minor = [&](std::size_t row, std::size_t i, std::size_t j) {
    return m[row][i] * m[row + 1][j] - m[row][j] * m[row + 1][i];
  };
  if (meshes_ == 2) return minor(0, 0, 1);
  return m[0][0] * minor(1, 1, 2) - m[0][1] * minor(1, 0, 2) + m[0][2] * minor(1, 0, 1);
}

EnclosedBalance::Quotient EnclosedBalance::at(const std::array<Interval, kMost>& ratios) const {
  std::array<Row, kMost> rows{};
  for (std::size_t i = 0; i < meshes_; ++i)
    for (std::size_t k = 0; k < meshes_; ++k) rows[i][k] = share(i, k, ratios[k]);
  Interval over = 0.0;
  for (std::size_t k = 0; k < meshes_; ++k) {
    auto with = rows;
    for (std::size_t i = 0; i < meshes_; ++i) with[i][k] = outside_[i];
    over = over + share(kMost, k, ratios[k]) * determinant(with);
  }
  // the torque on the output is -over / under; the efficiency is that over the lossless train's
  const Interval under = determinant(rows) * Interval(ratio_);
  return forward_ ? Quotient{over, under} : Quotient{under, over};
}

double EnclosedBalance::most(const std::vector<Interval>& meshes) const {
  double most = -1.0;
  bool positive = false, negative = false;
  for (unsigned corner = 0; corner < (1U << meshes_); ++corner) {
    std::array<Interval, kMost> ratios{};
    for (std::size_t k = 0; k < meshes_; ++k) {
      const Interval mesh((corner >> k) & 1U ? meshes[k].hi : std::max(meshes[k].lo, 0.0));
      ratios[k] = Interval(teeth_ratio_[k]) * (gear1_drives_[k] ? mesh : Interval(1.0) / mesh);
    }
    const auto [over, under] = at(ratios);
    positive = positive || !(under.hi < 0.0);
    negative = negative || !(under.lo > 0.0);
    if (positive && negative) return 1.0;
    most = std::max(most, (over / under).hi);
  }
  return std::min(1.0, most);
}

}  // namespace trueflank
