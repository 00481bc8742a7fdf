// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/pits/pits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/places/pits_of_flanks.h"
#include "trueflank/loop/gear/local/pits/pit_fit.h"

namespace trueflank::loop {
namespace {

using namespace gear_effects;

constexpr std::size_t kFewestPits = 8, kMostPits = 400, kFewestFlanks = 4;
constexpr double kWild = 4.0;    // spreads: no point counts for more
constexpr double kBeyond = 6.5;  // standard errors of a place beyond doubt
constexpr double kFewestInPit = 3.0;
constexpr double kOnIt = 0.05;  // of its depth: less is beside a pit

/// Side of a cell: most of the spacing of points.
double cell_of(const LevelledFlanks& flanks) {
  constexpr double kShareOfSpacing = 0.9;
  return kShareOfSpacing * std::sqrt(flanks.area_mm2 / std::max(1.0, flanks.number));
}

class PitSearch {
 public:
  PitSearch(const FlankGeometry& geometry, LevelledFlanks flanks)
      : geometry_(geometry),
        of_(std::move(flanks)),
        cell_mm_(cell_of(of_)),
        cells_{cells_in(of_.length_mm), cells_in(of_.face_mm)},
        fit_(of_, 0.5 * cell_mm_) {}

  [[nodiscard]] std::optional<Pits> run() {
    constexpr double kFine = 0.3;  // of the widest pit
    if (!(of_.sigma_um > 0.0) || !(cell_mm_ < kFine * kWidestPit_mm)) return {};
    std::vector<FoundPit> found = look();
    const auto lower = static_cast<std::size_t>(std::count_if(
        found.begin(), found.end(), [](const FoundPit& p) { return p.depth_um < 0.0; }));
    const bool pits = 2 * lower >= found.size();
    const std::size_t of_kind = pits ? lower : found.size() - lower;
    constexpr double kMostOfOthers = 0.1;
    if (of_kind < kFewestPits || of_kind > kMostPits ||
        static_cast<double>(found.size() - of_kind) > kMostOfOthers * static_cast<double>(of_kind))
      return {};
    std::erase_if(found, [&](const FoundPit& p) { return (p.depth_um < 0.0) != pits; });
    if (!lie_at_random(found)) return {};
    const int hollow = fit_.all_alike(found);
    if (!fit_.are_round(found, hollow)) return {};
    // Beside what was found others are seen, of which the form is known now.
    fit_.take_away(found, hollow);
    const std::vector<FoundPit> more = look_for(found, hollow, pits ? -1.0 : 1.0);
    found.insert(found.end(), more.begin(), more.end());
    return told(found, hollow);
  }

 private:
  [[nodiscard]] int cells_in(double length_mm) const {
    return cell_mm_ > 0.0 ? std::max(1, static_cast<int>(std::ceil(length_mm / cell_mm_))) : 1;
  }

  struct Field {
    std::vector<double> sum, count;
  };
  [[nodiscard]] std::size_t corner(int u, int v) const {
    return static_cast<std::size_t>(u) * static_cast<std::size_t>(cells_[1] + 1) +
           static_cast<std::size_t>(v);
  }
  [[nodiscard]] double within(const std::vector<double>& values, int u, int v, int size) const {
    return values[corner(u + size, v + size)] - values[corner(u, v + size)] -
           values[corner(u + size, v)] + values[corner(u, v)];
  }

  /// Places beyond doubt on all flanks, the surest of those that lie together.
  [[nodiscard]] std::vector<FoundPit> look() const {
    std::vector<std::vector<FoundPit>> of_flank(of_.points.size());
    for_each_piece(of_.points.size(), [&](std::size_t flank) { of_flank[flank] = look_at(flank); });
    std::vector<FoundPit> found;
    for (const auto& some : of_flank) found.insert(found.end(), some.begin(), some.end());
    return found;
  }

  [[nodiscard]] std::vector<FoundPit> look_at(std::size_t flank) const {
    const std::vector<PointOfFlank>& points = of_.points[flank];
    if (!of_.has_enough(flank)) return {};
    Field field;
    field.sum.assign(corner(cells_[0], cells_[1]) + 1, 0.0);
    field.count = field.sum;
    for (const PointOfFlank& p : points) {
      const int u = static_cast<int>((p.along_mm - of_.low_mm) / cell_mm_),
                v = static_cast<int>(p.up_mm / cell_mm_);
      const std::size_t at =
          corner(std::clamp(u, 0, cells_[0] - 1) + 1, std::clamp(v, 0, cells_[1] - 1) + 1);
      field.sum[at] += std::clamp(p.um / of_.sigma_um, -kWild, kWild);
      field.count[at] += 1.0;
    }
    for (std::vector<double>* values : {&field.sum, &field.count})
      for (int u = 1; u <= cells_[0]; ++u)
        for (int v = 1; v <= cells_[1]; ++v)
          (*values)[corner(u, v)] += (*values)[corner(u - 1, v)] + (*values)[corner(u, v - 1)] -
                                     (*values)[corner(u - 1, v - 1)];
    std::vector<FoundPit> found;
    const int most = std::min(
        {cells_[0] / 2, cells_[1] / 2, static_cast<int>(std::ceil(kWidestPit_mm / cell_mm_))});
    for (int size = 2; size <= most; size = std::max(size + 1, size * 4 / 3))
      for (int u = 0; u + size <= cells_[0]; ++u)
        for (int v = 0; v + size <= cells_[1]; ++v) {
          const double count = within(field.count, u, v, size);
          if (count < kFewestInPit) continue;
          const double sum = within(field.sum, u, v, size);
          if (sum * sum < kBeyond * kBeyond * count) continue;
          // (a square that just holds a round pit is a little wider than its half depth)
          found.push_back({flank, of_.low_mm + (u + 0.5 * size) * cell_mm_,
                           (v + 0.5 * size) * cell_mm_, 0.55 * size * cell_mm_,
                           of_.sigma_um * sum / count, std::abs(sum) / std::sqrt(count)});
        }
    std::stable_sort(found.begin(), found.end(),
                     [](const FoundPit& a, const FoundPit& b) { return a.score > b.score; });
    std::vector<FoundPit> apart;
    for (const FoundPit& p : found) {
      const bool near = std::any_of(apart.begin(), apart.end(), [&](const FoundPit& other) {
        return std::hypot(other.along_mm - p.along_mm, other.up_mm - p.up_mm) <
               1.2 * (other.half_mm + p.half_mm);
      });
      if (!near) apart.push_back(p);
      if (apart.size() > kMostPits) break;
    }
    return apart;
  }

  /// Not at the same height, nor at the same place of the profile, more often than chance has it;
  /// on several flanks; and not all over them.
  [[nodiscard]] bool lie_at_random(const std::vector<FoundPit>& found) const {
    constexpr double kMostOfArea = 0.2, kMostPairs = 1.6, kErrors = 4.0;
    std::set<std::size_t> flanks;
    double covered = 0.0;
    for (const FoundPit& p : found) {
      flanks.insert(p.flank);
      covered += 4.0 * p.half_mm * p.half_mm;
    }
    if (flanks.size() < kFewestFlanks || covered > kMostOfArea * of_.area_mm2 ||
        run_on_to_the_next_tooth(found) || lie_in_pieces(found))
      return false;
    for (const bool up : {false, true}) {
      const double range = up ? of_.face_mm : of_.length_mm;
      double pairs = 0.0, alike = 0.0, expected = 0.0;
      for (std::size_t a = 0; a < found.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          if (found[a].flank == found[b].flank) continue;
          const double near = 0.5 * (found[a].half_mm + found[b].half_mm);
          pairs += 1.0;
          expected += std::min(1.0, 2.0 * near / range);
          alike += std::abs(up ? found[a].up_mm - found[b].up_mm
                               : found[a].along_mm - found[b].along_mm) < near
                       ? 1.0
                       : 0.0;
        }
      if (alike > kMostPairs * expected + kErrors * std::sqrt(expected) + 0.02 * pairs)
        return false;
    }
    return true;
  }

  /// Pieces of fewer and larger places: most lie next to another.
  [[nodiscard]] static bool lie_in_pieces(const std::vector<FoundPit>& found) {
    constexpr double kNear = 2.0, kShare = 0.35;
    std::size_t by_another = 0;
    for (std::size_t a = 1; a < found.size(); ++a)
      by_another += std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(a),
                                [&](const FoundPit& b) {
                                  return b.flank == found[a].flank &&
                                         std::hypot(b.up_mm - found[a].up_mm,
                                                    b.along_mm - found[a].along_mm) <
                                             kNear * (b.half_mm + found[a].half_mm);
                                })
                        ? 1U
                        : 0U;
    return found.size() - by_another < kFewestPits ||
           static_cast<double>(by_another) > kShare * static_cast<double>(found.size());
  }

  /// As what has a place of the body does, or a cutter makes: alike on neighbouring teeth.
  [[nodiscard]] bool run_on_to_the_next_tooth(const std::vector<FoundPit>& found) const {
    constexpr double kShare = 0.2, kFewest = 3.0;
    const std::size_t teeth = of_.points.size() / 2;
    double alike = 0.0;
    for (const FoundPit& a : found)
      for (const FoundPit& b : found) {
        const double near = a.half_mm + b.half_mm;
        if (a.flank % 2 == b.flank % 2 && (a.flank / 2 + 1) % teeth == b.flank / 2 &&
            std::abs(a.up_mm - b.up_mm) < near && std::abs(a.along_mm - b.along_mm) < near)
          alike += 1.0;
      }
    return alike >= std::max(kFewest, kShare * static_cast<double>(found.size()));
  }

  /// Size of what stands for doubt where the form is known: hardly one place of all by chance.
  [[nodiscard]] double beyond_of_known(double half_mm) const {
    constexpr double kByChance = 0.03;
    const double places = 4.0 * of_.area_mm2 / (half_mm * half_mm);
    double low = 3.0, high = kBeyond;
    while (high - low > 0.01) {
      const double middle = 0.5 * (low + high);
      (places * normal_two_sided(middle) > kByChance ? low : high) = middle;
    }
    return high;
  }

  /// More of those that were found, of their width and hollow, to the side `sign`.
  [[nodiscard]] std::vector<FoundPit> look_for(const std::vector<FoundPit>& found, int hollow,
                                               double sign) const {
    const double half = usual_half_mm(found), beyond = beyond_of_known(half);
    std::vector<std::vector<FoundPit>> of_flank(of_.points.size());
    for_each_piece(of_.points.size(), [&](std::size_t flank) {
      std::vector<FoundPit> all;
      for (const FoundPit& p : places_alike(flank, half, hollow, sign))
        if (p.score > beyond) all.push_back(p);
      std::stable_sort(all.begin(), all.end(),
                       [](const FoundPit& a, const FoundPit& b) { return a.score > b.score; });
      for (const FoundPit& p : all) {
        const auto near = [&](const FoundPit& other) {
          return other.flank == flank && std::hypot(other.along_mm - p.along_mm,
                                                    other.up_mm - p.up_mm) < other.half_mm + half;
        };
        if (std::none_of(found.begin(), found.end(), near) &&
            std::none_of(of_flank[flank].begin(), of_flank[flank].end(), near))
          of_flank[flank].push_back(p);
      }
    });
    std::vector<FoundPit> more;
    for (const auto& some : of_flank) more.insert(more.end(), some.begin(), some.end());
    fit_.each(more, hollow, half);
    return more;
  }

  /// A pit of a width at places half a half width apart, and how far each lies beyond its error.
  [[nodiscard]] std::vector<FoundPit> places_alike(std::size_t flank, double half_mm, int hollow,
                                                   double sign) const {
    const std::vector<PointOfFlank>& points = of_.points[flank];
    if (!of_.has_enough(flank)) return {};
    const double step = 0.5 * half_mm, reach = end_of_pit(hollow) * half_mm;
    const int wide = static_cast<int>(of_.length_mm / step) + 1,
              high = static_cast<int>(of_.face_mm / step) + 1,
              about = static_cast<int>(reach / step) + 1;
    struct Sums {
      double with = 0.0, own = 0.0, points = 0.0;
    };
    std::vector<Sums> sums(static_cast<std::size_t>(wide + 1) * static_cast<std::size_t>(high + 1));
    for (const PointOfFlank& point : points) {
      const double um = std::clamp(point.um / of_.sigma_um, -kWild, kWild);
      const int u = static_cast<int>((point.along_mm - of_.low_mm) / step),
                v = static_cast<int>(point.up_mm / step);
      for (int i = std::max(0, u - about); i <= std::min(wide, u + about); ++i)
        for (int k = std::max(0, v - about); k <= std::min(high, v + about); ++k) {
          const double along = point.along_mm - of_.low_mm - i * step, up = point.up_mm - k * step,
                       s = depth_of_pit(hollow, (along * along + up * up) / (half_mm * half_mm));
          if (s < kOnIt) continue;
          Sums& sum = sums[static_cast<std::size_t>(i * (high + 1) + k)];
          sum.with += s * um;
          sum.own += s * s;
          sum.points += 1.0;
        }
    }
    std::vector<FoundPit> places;
    for (int i = 0; i <= wide; ++i)
      for (int k = 0; k <= high; ++k) {
        const Sums& sum = sums[static_cast<std::size_t>(i * (high + 1) + k)];
        if (sum.points < kFewestInPit || sign * sum.with <= 0.0) continue;
        places.push_back({flank, of_.low_mm + i * step, k * step, half_mm,
                          of_.sigma_um * sum.with / sum.own,
                          std::abs(sum.with) / std::sqrt(sum.own)});
      }
    return places;
  }

  /// How likely a pit as one that was found is found at a place of its own: as many points as fall
  /// on it by chance.
  [[nodiscard]] double chance_to_find(const FoundPit& pit, int hollow, double beyond) const {
    constexpr int kRings = 40, kMostPoints = 200;
    constexpr double kRarest = 0.25;  // one that was found hardly stands for more
    const double end = end_of_pit(hollow), depth = std::abs(pit.depth_um) / of_.sigma_um;
    double area = 0.0, with = 0.0, own = 0.0;
    for (int k = 0; k < kRings; ++k) {
      const double off = end * (k + 0.5) / kRings, s = depth_of_pit(hollow, off * off);
      if (s < kOnIt) continue;
      area += off;
      with += off * s * std::min(kWild, depth * s);
      own += off * s * s;
    }
    const double each = with / std::sqrt(own * area),  // standard errors by one point
        points = std::min(
            of_.number / of_.area_mm2 * kTwoPi * pit.half_mm * pit.half_mm * area * end / kRings,
            0.5 * kMostPoints);
    double chance = 0.0, term = std::exp(-points);
    for (int k = 0; k < kMostPoints; ++k) {
      if (k >= static_cast<int>(kFewestInPit))
        chance += term * 0.5 *
                  std::erfc((beyond - each * std::sqrt(static_cast<double>(k))) / std::sqrt(2.0));
      term *= points / (k + 1);
    }
    return std::clamp(chance, kRarest, 1.0);
  }

  [[nodiscard]] Pits told(std::vector<FoundPit>& found, int hollow) const {
    std::sort(found.begin(), found.end(), [](const FoundPit& a, const FoundPit& b) {
      return std::abs(a.depth_um) > std::abs(b.depth_um);
    });
    const auto number = static_cast<double>(found.size());
    // Each stands for those like it that too few points met.
    double likely = 0.0, square = 0.0;
    const double beyond = beyond_of_known(usual_half_mm(found));
    for (const FoundPit& p : found) {
      const double chance = chance_to_find(p, hollow, beyond);
      likely += 1.0 / chance;
      square += (1.0 - chance) / (chance * chance);
    }
    // (those that the edges of the flank cut are seen in part)
    constexpr double kCutAndMissed = 0.28, kMostCut = 0.6;
    const double half = usual_half_mm(found),
                 cut = std::min(kMostCut, 2.0 * half * (1.0 / of_.length_mm + 1.0 / of_.face_mm));
    square += kCutAndMissed * cut * likely;
    likely *= 1.0 + kCutAndMissed * cut;
    double mean = 0.0;
    for (const FoundPit& p : found) mean += std::abs(p.depth_um) / number;
    Pits pits{{find_family("unnamed_pits"), FlankChoice::kBoth, {}}, 1.0};
    pits.effect.shape = {number, std::round(likely), std::round(likely + 2.0 * std::sqrt(square)),
                         static_cast<double>(hollow)};
    for (const FoundPit& p : found) {
      const double roll = (geometry_.tip_form_roll_mm() < 0.0 ? -1.0 : 1.0) *
                          std::sqrt(2.0 * geometry_.base_radius_mm() * std::max(0.0, p.along_mm));
      const int tooth = static_cast<int>(p.flank / 2) + 1, side = p.flank % 2 == 1 ? 1 : -1;
      for (const double value : {static_cast<double>(tooth), static_cast<double>(side),
                                 2.0 * geometry_.on_flank(tooth, side, roll, p.up_mm).radius_mm,
                                 p.up_mm, 2.0 * p.half_mm, std::abs(p.depth_um) / mean})
        pits.effect.shape.push_back(value);
    }
    // As many as are asked for, each as sure as the last of them.
    std::vector<double> scores;
    for (const FoundPit& p : found) scores.push_back(p.score);
    std::sort(scores.rbegin(), scores.rend());
    const double places = of_.area_mm2 / (cell_mm_ * cell_mm_) * 8.0;
    constexpr double kSurest = 1e-30;
    pits.p_value = std::clamp(places * normal_two_sided(scores[kFewestPits - 1]), kSurest, 1.0);
    return pits;
  }

  const FlankGeometry& geometry_;
  LevelledFlanks of_;
  double cell_mm_;
  std::array<int, 2> cells_;
  PitFit fit_;
};

}  // namespace

std::optional<Pits> pits_of_scans(const FlankGeometry& geometry, const Observations& table) {
  constexpr std::size_t kFewestPoints = 2000;
  if (table.points_mm.size() < kFewestPoints) return {};
  return PitSearch(geometry, levelled_flanks(geometry, table, kFewestFlanks)).run();
}

}  // namespace trueflank::loop
