// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/slanted_ridges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/table/thinned_rows.h"

namespace trueflank::loop {
namespace {

/// Of a scan's many values so many tell as much as is asked.
constexpr std::size_t kRidgeRows = 30000, kFewestRidgeRows = 600, kRidgeRowsMoved = 10000;
/// Cells over the way that the line is followed (the profile, or a turn) and over the face.
constexpr std::size_t kRidgeAcross = 48, kRidgeHeights = 64;

struct RidgeCell {
  double sum = 0.0, count = 0.0;
  void operator+=(const RidgeCell& other) {
    sum += other.sum;
    count += other.count;
  }
};

/// Values of flanks in cells.
struct RidgeCells {
  std::array<std::array<RidgeCell, kRidgeHeights>, kRidgeAcross> of{};
  double square = 0.0;

  void operator+=(const RidgeCells& other) {
    for (std::size_t x = 0; x < kRidgeAcross; ++x)
      for (std::size_t v = 0; v < kRidgeHeights; ++v) of[x][v] += other.of[x][v];
    square += other.square;
  }
};

/// What hangs together in cells, in squares beyond their mean, and the variance of single values.
struct RidgesIn {
  double sum = 0.0, count = 0.0, structure = 0.0, variance = 0.0;
  double filled = 0.0;  ///< cells

  /// Far more than chance leaves in cells, and enough of these to follow a line in.
  [[nodiscard]] bool is_clear() const {
    constexpr double kErrors = 6.0, kFewestCells = 300.0;
    return variance > 0.0 && filled >= kFewestCells &&
           structure > kErrors * std::sqrt(2.0 * filled) * variance;
  }
};
RidgesIn ridges_in(const RidgeCells& cells) {
  RidgesIn all;
  double between = 0.0;
  for (const auto& column : cells.of)
    for (const RidgeCell& cell : column) {
      if (!(cell.count > 0.0)) continue;
      all.sum += cell.sum;
      all.count += cell.count;
      between += cell.sum * cell.sum / cell.count;
      all.filled += 1.0;
    }
  if (!(all.count > all.filled)) return {};
  all.variance = std::max(0.0, cells.square - between) / (all.count - all.filled);
  all.structure = between - all.sum * all.sum / all.count - all.filled * all.variance;
  return all;
}

/// Sums of values and weights in a ridge of a width about every place across and height.
class RidgeSums {
 public:
  /// Heights in cells, from below the face to above it.
  static constexpr int kCells = static_cast<int>(kRidgeHeights), kBeyond = kCells / 4,
                       kPlaces = kCells + 2 * kBeyond;

  RidgeSums(const RidgeCells& cells, double width) {
    const int reach = static_cast<int>(std::ceil(2.5 * width * kCells));
    std::vector<double> bells;
    for (int off = 0; off <= reach; ++off)
      bells.push_back(std::exp(-std::pow(off / (width * kCells), 2)));
    for (std::size_t x = 0; x < kRidgeAcross; ++x)
      for (int place = 0; place < kPlaces; ++place) {
        const int at = place - kBeyond;
        At& here = at_[x][static_cast<std::size_t>(place)];
        for (int v = std::max(0, at - reach); v <= std::min(kCells - 1, at + reach); ++v) {
          const RidgeCell& cell = cells.of[x][static_cast<std::size_t>(v)];
          const double b = bells[static_cast<std::size_t>(std::abs(v - at))];
          here.product += b * cell.sum;
          here.first += b * cell.count;
          here.square += b * b * cell.count;
        }
      }
  }

  struct At {
    double product = 0.0, first = 0.0, square = 0.0;
    void operator+=(const At& other) {
      product += other.product;
      first += other.first;
      square += other.square;
    }
  };
  /// At a share of the face; nothing far off it.
  [[nodiscard]] At at(std::size_t x, double height) const {
    const double place = height * kCells + kBeyond;
    if (!(place >= 0.0) || place >= kPlaces) return {};
    return at_[x][static_cast<std::size_t>(place)];
  }

 private:
  std::array<std::array<At, kPlaces>, kRidgeAcross> at_{};
};

struct RidgeGain {
  double gain = 0.0, amount_um = 0.0;
};
/// What a ridge takes out beside a mean.
RidgeGain gain_of_ridge(const RidgeSums::At& sums, const RidgesIn& all) {
  constexpr double kAnything = 1e-6;
  const double product = sums.product - sums.first * all.sum / all.count,
               square = sums.square - sums.first * sums.first / all.count;
  if (!(square > kAnything * all.count)) return {};
  return {product * product / square, product / square};
}

struct RidgeLine {
  RidgeGain gain;
  double height = 0.0, slope = 0.0, width = 0.0;  ///< in face widths; over the way across
};

/// The best line over the profile; `level`: of those that are not aslant.
RidgeLine best_ridge_over_profile(const RidgeSums& sums, double width, const RidgesIn& all,
                                  bool level) {
  constexpr double kStep = 0.05, kMost = 2.5, kFewest = 2.0, kHeightStep = 0.02, kMostlyOn = 0.35;
  RidgeLine best{.width = width};
  const int most = level ? 0 : static_cast<int>(kMost / kStep);
  for (int k = -most; k <= most; ++k) {
    if (!level && std::abs(k) < kFewest) continue;
    const double slope = k * kStep;
    for (double height = -0.1; height <= 1.1; height += kHeightStep) {
      RidgeSums::At line;
      int on_flank = 0;
      for (std::size_t x = 0; x < kRidgeAcross; ++x) {
        const double at = height + slope * ((static_cast<double>(x) + 0.5) / kRidgeAcross - 0.5);
        line += sums.at(x, at);
        on_flank += at >= 0.0 && at <= 1.0 ? 1 : 0;
      }
      // (what stands at a corner alone is no line)
      if (on_flank < kMostlyOn * kRidgeAcross) continue;
      if (const RidgeGain gain = gain_of_ridge(line, all); gain.gain > best.gain.gain)
        best = {gain, height, slope, width};
    }
  }
  return best;
}

/// The best line around the gear.
RidgeLine best_ridge_around(const RidgeSums& sums, double width, const RidgesIn& all) {
  constexpr double kLeast = 0.1, kMost = 3.0, kTimes = 1.04, kHeightStep = 0.03, kApart = 3.5;
  RidgeLine best{.width = width};
  for (double rise = std::max(kLeast, kApart * width); rise <= kMost; rise *= kTimes)
    for (const double sign : {-1.0, 1.0})
      for (double height = 0.0; height < rise; height += kHeightStep) {
        RidgeSums::At line;
        for (std::size_t x = 0; x < kRidgeAcross; ++x) {
          // (all lines that cross the face there)
          double at = height + sign * rise * ((static_cast<double>(x) + 0.5) / kRidgeAcross);
          at -= std::ceil((at + 0.2) / rise) * rise;
          for (; at < 1.2; at += rise) line += sums.at(x, at);
        }
        if (const RidgeGain gain = gain_of_ridge(line, all); gain.gain > best.gain.gain)
          best = {gain, height, sign * rise, width};
      }
  return best;
}

/// What the best form takes out that is most at a corner of the flanks.
double best_at_a_corner(const RidgeCells& cells, const RidgesIn& all) {
  constexpr double kPower = 1.5;
  double best = 0.0;
  for (const bool tip : {false, true})
    for (const bool upper : {false, true})
      for (const double over_profile : {0.25, 0.4, 0.65, 1.0})
        for (const double over_face : {0.25, 0.4, 0.65, 1.0}) {
          RidgeSums::At sums;
          for (std::size_t x = 0; x < kRidgeAcross; ++x) {
            const double u = (static_cast<double>(x) + 0.5) / kRidgeAcross,
                         from_end = (tip ? 1.0 - u : u) / over_profile;
            if (from_end >= 1.0) continue;
            for (std::size_t v = 0; v < kRidgeHeights; ++v) {
              const double w = (static_cast<double>(v) + 0.5) / kRidgeHeights,
                           from_side = (upper ? 1.0 - w : w) / over_face;
              if (from_side >= 1.0) continue;
              const double b = std::pow((1.0 - from_end) * (1.0 - from_side), kPower);
              const RidgeCell& cell = cells.of[x][v];
              sums.product += b * cell.sum;
              sums.first += b * cell.count;
              sums.square += b * b * cell.count;
            }
          }
          best = std::max(best, gain_of_ridge(sums, all).gain);
        }
  return best;
}

/// Values at places.
struct RidgeValues {
  std::vector<const Place*> places;
  std::vector<double> um;
};

RidgeGain gain_of_form(const FlankGeometry& geometry, const Effect& form,
                       const RidgeValues& values) {
  RidgeSums::At sums;
  RidgesIn all;
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    if (!form.acts_on_flank_of(geometry, *values.places[i])) continue;
    double b = 0.0;
    form.family->evaluate(geometry, *values.places[i], form.shape, &b);
    all.sum += values.um[i];
    all.count += 1.0;
    if (b == 0.0) continue;
    sums.product += b * values.um[i];
    sums.first += b;
    sums.square += b * b;
  }
  return gain_of_ridge(sums, all);
}

/// Moved from its cells to where it takes out most: what stands beside it would hold it there.
RidgeGain move_to_best(const FlankGeometry& geometry, const RidgeValues& values, Effect& form) {
  constexpr int kMostSteps = 25;
  constexpr double kMore = 1.0005;
  RidgeGain best = gain_of_form(geometry, form, values);
  for (int step = 0; step < kMostSteps; ++step) {
    const Effect now = form;
    const double before = best.gain;
    for (const EffectShape& shape : now.family->nearby(geometry, now.shape)) {
      const Effect moved{now.family, now.flank, shape};
      if (const RidgeGain gain = gain_of_form(geometry, moved, values); gain.gain > best.gain) {
        best = gain;
        form = moved;
      }
    }
    if (best.gain < kMore * before) break;
  }
  return best;
}

/// Of one side's flanks, over the profile and around.
struct RidgeCellsOfSide {
  RidgeCells profile, around;
};

}  // namespace

std::optional<SlantedRidge> likeliest_slanted_ridge(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const std::vector<float>& row_um,
                                                    const std::vector<bool>& used) {
  constexpr double kLooks = 1e5, kMostOfIt = 0.5, kAslant = 1.3;
  // (errors that hang together over a few cells follow some line: in variances of single values)
  constexpr double kFarBeyond = 400.0, kMoreThanACorner = 1.15;
  std::size_t rows = 0, taken = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    rows += used[i] && table.rows[i].kind == ObservationKind::kScanFlank ? 1U : 0U;
  if (rows < kFewestRidgeRows) return {};
  const ThinnedRows some(rows, kRidgeRows), few(rows, kRidgeRowsMoved);
  RidgeValues values;
  std::vector<RidgeCellsOfSide> sides(2);
  const auto cell = [](double share, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(share * static_cast<double>(count)), 0.0,
                                               static_cast<double>(count - 1)));
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!used[i] || table.rows[i].kind != ObservationKind::kScanFlank || !some.has(i)) continue;
    const Place& place = table.place(table.rows[i]);
    RidgeCellsOfSide& side = sides[place.side > 0 ? 1 : 0];
    const std::size_t v = cell(place.z_mm / geometry.face_width_mm(), kRidgeHeights);
    const double turn = place.polar_rad / kTwoPi, um = row_um[i];
    const RidgeCell one{um, 1.0};
    side.profile
        .of[cell(0.5 * (geometry.profile_coordinate(place.roll_mm) + 1.0), kRidgeAcross)][v] += one;
    side.around.of[cell(turn - std::floor(turn), kRidgeAcross)][v] += one;
    side.profile.square += um * um;
    side.around.square += um * um;
    ++taken;
    if (!few.has(i)) continue;
    values.places.push_back(&place);
    values.um.push_back(um);
  }
  const double face_mm = geometry.face_width_mm();
  std::optional<SlantedRidge> best;
  for (const int way : {-1, 0, 1}) {
    RidgeCellsOfSide cells = sides[way > 0 ? 1 : 0];
    if (way < 0) {
      cells.profile += sides[1].profile;
      cells.around += sides[1].around;
    }
    const FlankChoice flank =
        way < 0 ? FlankChoice::kBoth
                : flank_of(geometry, geometry.on_flank(1, way > 0 ? 1 : -1,
                                                       geometry.root_form_roll_mm(), 0.0));
    for (const bool around : {false, true}) {
      const RidgeCells& in = around ? cells.around : cells.profile;
      const RidgesIn all = ridges_in(in);
      if (!all.is_clear()) continue;
      RidgeLine line;
      double level = 0.0;
      for (const double width : {0.03, 0.05, 0.08, 0.13, 0.2}) {
        const RidgeSums sums(in, width);
        const RidgeLine one = around ? best_ridge_around(sums, width, all)
                                     : best_ridge_over_profile(sums, width, all, false);
        if (one.gain.gain > line.gain.gain) line = one;
        level = std::max(level, best_ridge_over_profile(sums, width, all, true).gain.gain);
      }
      const double gain = line.gain.gain;
      if (gain < kMostOfIt * all.structure || gain < kAslant * level ||
          gain < kFarBeyond * all.variance)
        continue;
      if (!around && gain < kMoreThanACorner * best_at_a_corner(in, all)) continue;
      const double square = gain * static_cast<double>(rows) / static_cast<double>(taken);
      if (best && square <= best->square) continue;
      // (the line over the profile stands at its height in the middle of it)
      // (around, over the whole face)
      const std::pair<double, double> ends =
          std::minmax(-line.height / line.slope, (1.0 - line.height) / line.slope);
      best = {.form = {find_family("unnamed_slanted_ridge"),
                       flank,
                       {line.height * face_mm, around ? 0.0 : line.slope * face_mm,
                        around ? line.slope * face_mm : 0.0, line.width * face_mm,
                        around ? ends.first : 0.0, around ? ends.second : 0.0}},
              .p_value = std::min(1.0, kLooks * std::exp(-0.5 * gain / all.variance)),
              .square = square,
              .amount_um = line.gain.amount_um};
    }
  }
  if (!best) return {};
  const RidgeGain moved = move_to_best(geometry, values, best->form);
  best->amount_um = moved.amount_um;
  best->square = std::max(
      best->square, moved.gain * static_cast<double>(rows) / static_cast<double>(values.um.size()));
  return best;
}

}  // namespace trueflank::loop
