// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/flank_breaks.h"

#include <algorithm>
#include <cmath>

namespace trueflank {
namespace {

/// Columns of breaks are as many least distances apart at least, and from the ends of the flank.
constexpr double kApart = 4.0;
/// No break wanders nearer to an end or to another than its least distance, or this share of the
/// flank.
constexpr double kLeastOfFlank = 0.1;

}  // namespace

/// Where chamfers are left, they take a break away within their height.
double FlankBreaks::break_at(const Toothing& toothing, int tooth, int side, double roll_mm,
                             double z_mm) const {
  Toothing whole = toothing;
  if (in_chamfers_ == InChamfers::kLeft) whole.edge_chamfer_mm = 0.0;
  whole.bed = nullptr;
  return break_parameter(whole, tooth, side, roll_mm, z_mm);
}

FlankBreaks::FlankBreaks(const Toothing& toothing, const std::vector<int>& teeth,
                         const std::vector<double>& heights_mm, double least_mm,
                         InChamfers in_chamfers)
    : flank_(involute_piece(*toothing.profile)), least_mm_(least_mm), in_chamfers_(in_chamfers) {
  const Curve& curve = toothing.profile->pieces()[flank_].curve;
  begin_ = curve.begin, end_ = curve.end;
  if (!toothing.has_deviation()) return;
  const int left = flank_side(Flank::kLeft, toothing.profile->gear().kind);
  std::vector<Break> found;
  for (const double roll_mm : toothing.deviation->roll_breaks_mm) {
    const double usual = break_at(toothing, 0, left, roll_mm, 0.5 * toothing.twist.face_width_mm);
    std::vector<double> stands{usual};
    for (const int tooth : teeth)
      for (const int side : {-1, 1})
        for (const double z : heights_mm)
          stands.push_back(break_at(toothing, tooth, side, roll_mm, z));
    wander_ =
        wander_ || std::any_of(stands.begin(), stands.end(), [&](double s) { return s != usual; });
    const double room = least_share(roll_mm);
    if (std::any_of(stands.begin(), stands.end(),
                    [&](double s) { return share_of(s) >= room && share_of(s) <= 1.0 - room; }))
      found.push_back({roll_mm, usual});
  }
  keep_apart(std::move(found));
}

double FlankBreaks::least_share(double roll_mm) const {
  return std::min(kLeastOfFlank, least_mm_ / std::abs(roll_mm * (end_ - begin_)));
}

void FlankBreaks::keep_apart(std::vector<Break> breaks) {
  std::sort(breaks.begin(), breaks.end(), [&](const Break& a, const Break& b) {
    return share_of(a.parameter) < share_of(b.parameter);
  });
  double last = 0.0;
  for (const Break& b : breaks) {
    const double least = std::min(kApart * least_share(b.roll_mm), kLeastOfFlank),
                 share = share_of(b.parameter);
    const double stands = wander_ ? std::clamp(share, least, 1.0 - least) : share;
    if (wander_ && !rolls_mm_.empty() && stands - last < least) continue;
    rolls_mm_.push_back(b.roll_mm);
    parameters_.push_back(stands == share ? b.parameter : std::lerp(begin_, end_, stands));
    last = stands;
  }
}

ToothPlace FlankBreaks::drawn(const Toothing& toothing, const ToothPlace& place,
                              double z_mm) const {
  if (!wander_ || parameters_.empty() || place.piece != flank_) return place;
  double from = 0.0, to = 1.0, drawn_from = 0.0, drawn_to = 1.0;  // shares of the flank
  const double share = share_of(place.parameter), left = static_cast<double>(parameters_.size());
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const double room = std::min(least_share(rolls_mm_[k]), kLeastOfFlank / left);
    const double low = drawn_from + room, high = 1.0 - room * (left - static_cast<double>(k));
    const double there =
        std::clamp(share_of(break_at(toothing, place.tooth, place.side, rolls_mm_[k], z_mm)),
                   std::min(low, high), high);
    if (share <= share_of(parameters_[k])) {
      to = share_of(parameters_[k]), drawn_to = there;
      break;
    }
    from = share_of(parameters_[k]), drawn_from = there;
  }
  ToothPlace result = place;
  if (share > 0.0 && share < 1.0)
    result.parameter =
        std::lerp(begin_, end_, std::lerp(drawn_from, drawn_to, (share - from) / (to - from)));
  return result;
}

}  // namespace trueflank
