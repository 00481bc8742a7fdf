// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/measure/section_teeth.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr int kFewestTeeth = 3;
/// Fewer corners a period are those of a hexagon or of a circle's own chords.
constexpr std::size_t kFewestCorners = 6;
/// Of the pitch: how unevenly teeth may stand.
constexpr double kUnevenness = 0.1;
constexpr double kRootShare = 0.15, kTipShare = 0.95;

/// Whether the outline runs around the origin, and which way.
double turns(const std::vector<Point2>& loop) {
  double angle = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    angle += std::atan2(cross(a, b), a.dot(b));
  }
  return angle / kTwoPi;
}

std::optional<SectionTeeth> teeth_of(const std::vector<Point2>& loop) {
  const double around = turns(loop);
  if (std::abs(std::abs(around) - 1.0) > 0.01) return {};
  const auto by_radius = [](const Point2& a, const Point2& b) {
    return a.squaredNorm() < b.squaredNorm();
  };
  const auto [low, high] = std::minmax_element(loop.begin(), loop.end(), by_radius);
  SectionTeeth teeth{.internal = around < 0.0};
  const double middle = 0.5 * (low->norm() + high->norm());
  std::vector<double> rising, falling;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double at_a = a.norm() - middle, at_b = b.norm() - middle;
    if ((at_a < 0.0) == (at_b < 0.0)) continue;
    const double angle = polar_angle_rad(a + (b - a) * (at_a / (at_a - at_b)));
    (at_a < 0.0 ? rising : falling).push_back(angle);
  }
  const std::size_t n = rising.size();
  if (n < kFewestTeeth || loop.size() < kFewestCorners * n) return {};
  const double pitch = kTwoPi / static_cast<double>(n);
  // where each tooth's flanks are in its pitch: angles of one period, averaged about the first
  const auto mean_phase = [&](const std::vector<double>& angles, bool& even) {
    double sum = 0.0;
    for (double angle : angles) {
      const double off = centred_rad(angle - angles.front(), pitch);
      even = even && std::abs(off) < kUnevenness * pitch;
      sum += off;
    }
    return angles.front() + sum / static_cast<double>(angles.size());
  };
  bool even = true;
  const double up = mean_phase(rising, even), down = mean_phase(falling, even);
  if (!even) return {};
  // A gear's outline runs counter-clockwise, its tooth from the rising to the falling crossing. A
  // ring's runs clockwise, its tooth from falling to rising: counter-clockwise the same again.
  const double width = wrapped_rad(down - up, pitch);
  teeth.count = static_cast<int>(n);
  teeth.first_centre_rad = centred_rad(up + 0.5 * width, pitch);
  teeth.tip_radius_mm = teeth.internal ? low->norm() : high->norm();
  teeth.root_radius_mm = teeth.internal ? high->norm() : low->norm();
  return teeth;
}

}  // namespace

std::optional<SectionTeeth> find_teeth(const MeshSection& section) {
  std::optional<SectionTeeth> found;
  for (std::size_t i = 0; i < section.loops.size(); ++i) {
    auto teeth = teeth_of(section.loops[i]);
    if (!teeth || (found && found->count >= teeth->count)) continue;
    teeth->loop = i;
    found = teeth;
  }
  return found;
}

SectionPlace section_place(const SectionTeeth& teeth, const Point2& point) {
  const double pitch = kTwoPi / teeth.count;
  const double from_first = polar_angle_rad(point) - teeth.first_centre_rad;
  const double share =
      (point.norm() - teeth.root_radius_mm) / (teeth.tip_radius_mm - teeth.root_radius_mm);
  SectionPlace place;
  const bool root = share < kRootShare;
  const double index = from_first / pitch;
  const auto tooth = static_cast<int>(root ? std::floor(index) : std::round(index));
  place.tooth = (tooth % teeth.count + teeth.count) % teeth.count + 1;
  if (root) {
    place.region = ToothRegion::kRoot;
  } else if (share > kTipShare) {
    place.region = ToothRegion::kTip;
  } else {
    const bool ahead = centred_rad(from_first, pitch) > 0.0;  // counter-clockwise of the tooth's middle
    place.region = ahead != teeth.internal ? ToothRegion::kLeftFlank : ToothRegion::kRightFlank;
  }
  return place;
}

const char* to_text(ToothRegion region) {
  switch (region) {
    case ToothRegion::kLeftFlank: return "left flank";
    case ToothRegion::kRightFlank: return "right flank";
    case ToothRegion::kTip: return "tip";
    case ToothRegion::kRoot: return "root";
  }
  return "";
}

std::string place_text(const SectionTeeth& teeth, const SectionPlace& place) {
  if (place.region == ToothRegion::kRoot)
    return "root between teeth " + std::to_string(place.tooth) + " and " +
           std::to_string(place.tooth % teeth.count + 1);
  return std::string(to_text(place.region)) + " of tooth " + std::to_string(place.tooth);
}

}  // namespace trueflank
