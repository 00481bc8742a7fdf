// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/scans/spell_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "trueflank/loop/drive/effects/columns.h"

namespace trueflank::loop {
namespace {

using drive_effects::changed_nm;

constexpr int kParts = 360;        ///< of a run or a turn
constexpr double kLongest = 0.55;  ///< a longer part is the rest's difference
constexpr double kFewestTurns = 3.0, kHighestOrder = 4.0;
constexpr double kFewestUnits = 10.0;
/// Chi-square of a few wild rows is no part of anything.
constexpr double kFewestRows = 4.0;

/// Sums over the rows of one part: of the rows, of the squared column, of the column times what is
/// left.
struct Part {
  double rows = 0.0, square = 0.0, product = 0.0;
  Part& operator+=(const Part& other) {
    rows += other.rows;
    square += other.square;
    product += other.product;
    return *this;
  }
};

class Scan {
 public:
  Scan(const DriveContext& context, const Eigen::VectorXd& left) : context_(context), left_(left) {
    std::set<int> units;
    for (const BenchPoint& p : context.table.points)
      if (p.fold != 0) units.insert(p.unit);
    units_ = static_cast<double>(units.size());
  }

  void look_at(double what, double order) {
    ++looks_;
    std::vector<Part> parts(kParts);
    Part all;
    double sum = 0.0;
    const auto& points = context_.table.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const BenchPoint& p = points[i];
      if (p.fold == 0) continue;
      const double column = changed_nm(context_, p, what) / p.sigma_nm;
      const double left = left_[static_cast<Eigen::Index>(i)] / p.sigma_nm;
      const Part one{1.0, column * column, column * left};
      const double place = drive_effects::place_of_spell(p, order);
      parts[static_cast<std::size_t>(
          std::clamp(static_cast<int>(kParts * place), 0, kParts - 1))] += one;
      all += one;
      sum += left * left;
    }
    if (!(all.square > 0.0)) return;
    const double beside_constant = sum - all.product * all.product / all.square;
    if (!(beside_constant > 0.0)) return;
    for (int begin = 0; begin < kParts; ++begin) {
      Part inside;
      const int longest = order == 0.0 ? kParts - begin : static_cast<int>(kLongest * kParts);
      for (int length = 1; length <= longest; ++length) {
        inside += parts[static_cast<std::size_t>((begin + length - 1) % kParts)];
        if (inside.rows < kFewestRows || all.rows - inside.rows < kFewestRows) continue;
        ++tried_;
        // What this part explains beside the same over all.
        const double beside = inside.square - inside.square * inside.square / all.square;
        const double product = inside.product - inside.square / all.square * all.product;
        if (!(beside > 0.0)) continue;
        const double share = product * product / beside / beside_constant;
        if (share <= highest_) continue;
        highest_ = share;
        best_ = {.what = what,
                 .order = order,
                 .begin = double(begin) / kParts,
                 .length = double(length) / kParts};
      }
    }
  }

  /// Parts that overlap are nearly one: a tenth of them are counted, and no more than the units can
  /// make.
  [[nodiscard]] LikeliestSpell highest() const { return highest_of(units_); }

  /// What comes again with every turn changes inside a dwell: as many rows count as do not hang
  /// together beside it.
  [[nodiscard]] LikeliestSpell highest_in_turns() const {
    const auto& points = context_.table.points;
    double product = 0.0, square = 0.0, rows = 0.0, last = 0.0;
    std::array<double, 2> sum{}, size{}, mean{};  // outside, inside
    std::vector<std::size_t> inside(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      double after = drive_effects::place_of_spell(points[i], best_.order) - best_.begin;
      after -= std::floor(after);
      inside[i] = after <= best_.length ? 1 : 0;
      if (points[i].fold == 0) continue;
      const double column = changed_nm(context_, points[i], best_.what) / points[i].sigma_nm;
      sum[inside[i]] += column * left_[static_cast<Eigen::Index>(i)] / points[i].sigma_nm;
      size[inside[i]] += column * column;
    }
    for (const std::size_t k : {0U, 1U}) mean[k] = size[k] > 0.0 ? sum[k] / size[k] : 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].fold == 0) continue;
      const double off = (left_[static_cast<Eigen::Index>(i)] -
                          mean[inside[i]] * changed_nm(context_, points[i], best_.what)) /
                         points[i].sigma_nm;
      if (i > 0 && points[i - 1].fold != 0) product += off * last;
      square += off * off;
      rows += 1.0;
      last = off;
    }
    const double alike = square > 0.0 ? std::clamp(product / square, 0.0, 0.99) : 0.0;
    return highest_of(std::max(units_, rows * (1.0 - alike) / (1.0 + alike)));
  }

 private:
  [[nodiscard]] LikeliestSpell highest_of(double independent) const {
    LikeliestSpell best = best_;
    if (independent < kFewestUnits || !(highest_ > 0.0)) return best;
    const double tried = std::min(0.1 * tried_, looks_ * independent * independent);
    best.p_value =
        std::min(1.0, tried * std::pow(std::max(0.0, 1.0 - highest_), 0.5 * (independent - 4.0)));
    return best;
  }

  const DriveContext& context_;
  const Eigen::VectorXd& left_;
  double units_ = 0.0, highest_ = 0.0, tried_ = 0.0, looks_ = 0.0;
  LikeliestSpell best_;
};

}  // namespace

LikeliestSpell likeliest_spell_of_run(const DriveContext& context, const Eigen::VectorXd& left) {
  if (!drive_effects::has_one_course(context)) return {};
  Scan scan(context, left);
  for (const double what :
       {drive_effects::kFlanks, drive_effects::kDrag, drive_effects::kOutputReads})
    scan.look_at(what, 0.0);
  return scan.highest();
}

LikeliestSpell likeliest_spell_of_turns(const DriveContext& context, const Eigen::VectorXd& left) {
  if (!context.table.has_angle) return {};
  Scan scan(context, left);
  for (const MemberOrder& member : context.model.orders) {
    const bool whole = std::abs(member.order - std::round(member.order)) < 1e-9;
    const bool seen = context.table.turns <= 1.01
                          ? whole && member.order == 1.0
                          : member.order * context.table.turns >= kFewestTurns;
    if (seen && member.order <= kHighestOrder) scan.look_at(drive_effects::kDrag, member.order);
  }
  return scan.highest_in_turns();
}

}  // namespace trueflank::loop
