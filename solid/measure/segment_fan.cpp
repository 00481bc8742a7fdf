// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/segment_fan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

double distance_to(const Segment& s, const Point2& p) {
  const Point2 along = s.b - s.a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - s.a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (s.a + t * along - p).norm();
}

}  // namespace

SegmentFan::SegmentFan(std::vector<Segment> segments, const Point2& centre)
    : segments_(std::move(segments)), centre_(centre) {
  bins_ = std::max<std::size_t>(1, segments_.size() / 4);
  std::vector<std::pair<std::size_t, std::size_t>> ranges;  // first bin, count
  begin_.assign(bins_ + 1, 0);
  for (const Segment& s : segments_) {
    std::size_t first = bin_of(diamond_angle(s.a - centre_));
    std::size_t last = bin_of(diamond_angle(s.b - centre_));
    if (cross(s.a - centre_, s.b - centre_) < 0.0) std::swap(first, last);
    const std::size_t count = std::min(bins_, (last + bins_ - first) % bins_ + 1);
    ranges.emplace_back(first, count);
    for (std::size_t k = 0; k < count; ++k) ++begin_[(first + k) % bins_ + 1];
  }
  for (std::size_t i = 0; i < bins_; ++i) begin_[i + 1] += begin_[i];
  members_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t s = 0; s < segments_.size(); ++s)
    for (std::size_t k = 0; k < ranges[s].second; ++k)
      members_[next[(ranges[s].first + k) % bins_]++] = s;
}

double SegmentFan::distance_mm(const Point2& p) const {
  double best = std::numeric_limits<double>::infinity();
  const double angle = diamond_angle(p - centre_), radius = (p - centre_).norm();
  const double width = kDiamondTurn / static_cast<double>(bins_);
  const std::size_t home = bin_of(angle);
  const double into = angle - static_cast<double>(home) * width;
  for (std::size_t away = 0; 2 * away <= bins_; ++away) {
    visit((home + away) % bins_, p, best);
    if (away > 0) visit((home + bins_ - away) % bins_, p, best);
    // nothing beyond the bins visited is nearer than their bounding rays, which are at least so far
    // away as an angle
    const double clear = static_cast<double>(away) * width + std::min(into, width - into);
    if (best <= radius * std::sin(std::min(clear, 0.5 * kPi))) break;
  }
  return best;
}

std::size_t SegmentFan::bin_of(double angle) const {
  const auto bin = static_cast<std::size_t>(angle / kDiamondTurn * static_cast<double>(bins_));
  return std::min(bin, bins_ - 1);
}

void SegmentFan::visit(std::size_t bin, const Point2& p, double& best) const {
  for (std::size_t i = begin_[bin]; i < begin_[bin + 1]; ++i)
    best = std::min(best, distance_to(segments_[members_[i]], p));
}

}  // namespace trueflank
