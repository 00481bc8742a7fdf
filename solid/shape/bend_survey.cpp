// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/bend_survey.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trueflank {
namespace {

/// Ways of one length that are looked at, and lines of the toothing on which each is.
constexpr std::size_t kWays = 32;
constexpr int kLines = 24;
/// More cuts than any mesh has.
constexpr double kMostCuts = 1e7;
/// Ways that are still off where no way is cut any more: so many are steps, more are waves that no mesh follows.
constexpr double kMostSteps = 32.0;
/// Of the whole: the places of steps are not told any finer.
constexpr double kShortestPart = 0x1p-40;

/// Parts between 0 and 1 that remain when every part that is off its chord is halved.
/// `off(from, to)`: whether a part is. A long part may seem right by chance, or where it holds whole waves: it
/// is halved for what is off within it, too.
template <class Off>
double parts_by_halving(double length_mm, double tolerance_mm, const Off& off) {
  std::vector<bool> halved(kWays);
  std::vector<double> ways;  // where those of one length begin that are off
  double part = 1.0 / kWays;
  for (std::size_t k = 0; k < kWays; ++k) {
    const double from = static_cast<double>(k) * part;
    halved[k] = off(from, from + part);
    if (halved[k]) ways.push_back(from);
  }
  double of_all = static_cast<double>(ways.size()), parts = 1.0 + of_all;
  for (std::size_t count = kWays / 2; count >= 1; count /= 2) {
    for (std::size_t k = 0; k < count; ++k) {
      const double from = static_cast<double>(k) / static_cast<double>(count);
      halved[k] = halved[2 * k] || halved[2 * k + 1] || off(from, from + 1.0 / static_cast<double>(count));
      parts += halved[k] ? 1.0 : 0.0;
    }
  }
  SpreadShares choice;
  const auto are_steps = [&] {
    return part * length_mm <= kShortestCut * tolerance_mm && of_all <= kMostSteps;
  };
  while (!ways.empty() && parts < kMostCuts && part > kShortestPart && !are_steps()) {
    part *= 0.5;
    std::vector<double> halves;
    for (const double from : ways)
      for (const double half : {from, from + part})
        if (off(half, half + part)) halves.push_back(half);
    of_all *= static_cast<double>(halves.size()) / static_cast<double>(ways.size());
    parts += of_all;
    ways.clear();
    for (std::size_t k = 0; k < std::min(kWays, halves.size()); ++k)
      ways.push_back(halves.size() <= kWays
                         ? halves[k]
                         : halves[static_cast<std::size_t>(choice.next() * static_cast<double>(halves.size()))]);
  }
  return parts;
}

}  // namespace

BendCuts bend_cuts(const ToothedOutline& teeth, double height_mm, double tolerance_mm) {
  if (teeth.displacement == nullptr) return {};
  Toothing unmoved = teeth.toothing();
  unmoved.displacement = nullptr;
  const std::size_t flank = involute_piece(*teeth.profile);
  const Curve& curve = teeth.profile->pieces()[flank].curve;
  const double way_mm = (point_at(curve, curve.end) - point_at(curve, curve.begin)).norm();
  SpreadShares shares, others, which;
  int side = 1;
  // `place(beside, along)`: shares along the flank and up the face
  const auto off_on_some_line = [&](double from, double to, const auto& place) {
    for (int line = 0; line < kLines; ++line) {
      const int tooth = static_cast<int>(which.next() * teeth.profile->gear().teeth);
      const double beside = others.next();
      side = -side;
      const bool off = is_off_chord(shares.next(), tolerance_mm, [&](double share) {
        const auto [along, up] = place(beside, std::lerp(from, to, share));
        const double parameter = std::lerp(curve.begin, curve.end, along);
        return (*teeth.displacement)(
            surface_point(unmoved, {tooth, side, flank, parameter}, up * height_mm));
      });
      if (off) return true;
    }
    return false;
  };
  using Shares = std::array<double, 2>;
  return {.layers = parts_by_halving(height_mm, tolerance_mm, [&](double from, double to) {
            return off_on_some_line(from, to, [](double beside, double along) { return Shares{beside, along}; });
          }),
          .chords = parts_by_halving(way_mm, tolerance_mm, [&](double from, double to) {
            return off_on_some_line(from, to, [](double beside, double along) { return Shares{along, beside}; });
          })};
}

}  // namespace trueflank
