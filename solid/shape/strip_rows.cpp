// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/strip_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

/// Of the tolerance: what an edge is laid for. Facets are measured, and what is off here is off
/// there by a few hundredths.
constexpr double kAimOfEdges = 0.97;
/// Shares of it that are tried for as many vertices as with all of it.
constexpr double kLeastLimit = 0.4;
constexpr int kLimits = 5;
/// Cells over which a chord's bend is looked at.
constexpr double kLittle = 1e-3;
/// Of a chord where a vertex stands: none is farther from the next.
constexpr double kWidestStep = 1.5;
/// No vertex stands closer to the one before than this share of a chord, or of a cell.
constexpr double kLeastChord = 0.02;
/// Places nearer than this [cells] are one.
constexpr double kSamePlace = 1e-6;
constexpr int kHalvings = 9;

/// Rows that grow together: the one that is most behind goes on, so that its edges to the rows
/// beside it lean no more than they did.
class GrowingRows {
 public:
  /// `first`: of two rows beside each other that are equally far, the even or the odd one goes on.
  GrowingRows(const BentEdges& edges, double from, double to, const std::vector<double>& heights,
              const RowBeside& beside, double limit, std::size_t first)
      : edges_(edges), to_(to), limit_(limit), heights_(heights), beside_(beside) {
    rows_.assign(heights.size(), {from});
    while (true) {
      std::size_t last = 0;
      for (std::size_t row = 1; row < rows_.size(); ++row)
        if (is_behind(row, last, first)) last = row;
      if (rows_[last].back() >= to_) break;
      add_to(last);
    }
  }
  [[nodiscard]] StripRows take() { return std::move(rows_); }

 private:
  [[nodiscard]] bool is_behind(std::size_t row, std::size_t other, std::size_t first) const {
    const double here = rows_[row].back(), there = rows_[other].back();
    return here < there || (here == there && row % 2 == first && other % 2 != first);
  }
  void add_to(std::size_t row) {
    const double before = rows_[row].back();
    double target = to_;
    if (row == 0) {
      const auto next =
          std::upper_bound(beside_.fixed.begin(), beside_.fixed.end(), before + kSamePlace);
      if (next != beside_.fixed.end()) target = std::min(target, *next);
    }
    const double farthest = reach(row, target);
    // even steps up to a vertex of the patch beside the break
    const double steps = std::ceil((target - before) / (farthest - before) - 1e-9);
    rows_[row].push_back(target < to_ && steps > 1.0 ? before + (target - before) / steps
                                                     : farthest);
  }
  [[nodiscard]] bool fits(std::size_t row, double place) const {
    const double before = rows_[row].back();
    if (row == 0 && beside_.chords.at(place) - beside_.chords.at(before) > 1.0 + 1e-9) return false;
    if (edges_.along_row(before, place, heights_[row]) > limit_) return false;
    for (const std::size_t other : {row - 1, row + 1})
      if (other < rows_.size() &&
          edges_.over_strip(rows_[other].back(), heights_[other], place, heights_[row]) > limit_)
        return false;
    return true;
  }
  [[nodiscard]] double reach(std::size_t row, double target) const {
    if (fits(row, target)) return target;
    const double before = rows_[row].back();
    const double bent = edges_.along_row(before, before + kLittle, heights_[row]);
    const double chord = kLittle / std::sqrt(std::max(bent, 1e-12));
    double low = before, high = std::min(target, before + kWidestStep * chord);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (fits(row, middle) ? low : high) = middle;
    }
    return std::min(target, std::max(low, before + kLeastChord * std::min(chord, 1.0)));
  }

  const BentEdges& edges_;
  double to_, limit_;
  const std::vector<double>& heights_;
  const RowBeside& beside_;
  StripRows rows_;
};

}  // namespace

BentEdges::BentEdges(std::vector<std::vector<SurfaceForm>> forms, const Heights& heights,
                     std::vector<double> rooms_mm)
    : forms_(std::move(forms)), heights_(heights), rooms_mm_(std::move(rooms_mm)) {
  TRUEFLANK_EXPECTS(forms_.size() > 1 && rooms_mm_.size() == forms_.size());
}

/// In between, forms are interpolated.
template <class Use>
void BentEdges::each_form(double place, double height, const Use& use) const {
  const auto cell = static_cast<std::size_t>(std::clamp(place - 0.5, 0.0, cells() - 2.0));
  const double across = place - 0.5 - static_cast<double>(cell);
  const std::size_t low = height < heights_[1] ? 0 : 1;
  const double up = (height - heights_[low]) / (heights_[low + 1] - heights_[low]);
  const double room = rooms_mm_[static_cast<std::size_t>(std::clamp(place, 0.0, cells() - 1.0))];
  const auto &left = forms_[cell], &right = forms_[cell + 1];
  for (std::size_t k = low; k + 1 < left.size(); k += heights_.size()) {
    const auto mean = [&](double SurfaceForm::*part) {
      return std::lerp(std::lerp(left[k].*part, left[k + 1].*part, up),
                       std::lerp(right[k].*part, right[k + 1].*part, up), across);
    };
    use(SurfaceForm{mean(&SurfaceForm::across), mean(&SurfaceForm::mixed),
                    mean(&SurfaceForm::along), mean(&SurfaceForm::level)},
        room);
  }
}

double BentEdges::along_row(double from, double to, double height) const {
  double most = 0.0;
  each_form(0.5 * (from + to), height, [&](const SurfaceForm& form, double room) {
    most = std::max(most, form.level * (to - from) * (to - from) / room);
  });
  return most;
}

double BentEdges::over_strip(double from, double low, double to, double high) const {
  double most = 0.0;
  const double u = to - from, v = high - low;
  each_form(0.5 * (from + to), 0.5 * (low + high), [&](const SurfaceForm& form, double room) {
    const double bent = form.across * u * u + 2.0 * form.mixed * u * v + form.along * v * v;
    most = std::max(most, std::abs(bent) / room);
  });
  return most;
}

std::size_t vertex_count(const StripRows& rows) {
  std::size_t sum = 0;
  for (const auto& row : rows) sum += row.size();
  return sum;
}

namespace {

StripRows laid(const Strips& strips, double from, double to, double limit, std::size_t first) {
  std::vector<double> heights;
  for (int k = 0; k <= strips.count; ++k)
    heights.push_back(static_cast<double>(strips.down ? strips.count - k : k) / strips.count);
  return GrowingRows(strips.edges, from, to, heights, strips.beside, limit, first).take();
}

}  // namespace

StripRows strip_rows(const Strips& strips, double from, double to) {
  TRUEFLANK_EXPECTS(strips.count > 0 && to > from);
  return laid(strips, from, to, kAimOfEdges, 1);
}

StripRows even_strip_rows(const Strips& strips, double from, double to) {
  StripRows best = strip_rows(strips, from, to);
  std::size_t first = 1;
  if (StripRows other = laid(strips, from, to, kAimOfEdges, 0);
      vertex_count(other) < vertex_count(best))
    best = std::move(other), first = 0;
  double low = kLeastLimit * kAimOfEdges, high = kAimOfEdges;
  for (int i = 0; i < kLimits; ++i) {
    const double limit = 0.5 * (low + high);
    StripRows tried = laid(strips, from, to, limit, first);
    if (vertex_count(tried) > vertex_count(best))
      low = limit;
    else
      high = limit, best = std::move(tried);
  }
  return best;
}

}  // namespace trueflank
