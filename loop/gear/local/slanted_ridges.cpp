// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/slanted_ridges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
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

/// Sums over values of a form's height times the value, of its height, and of its square.
struct RidgeProducts {
  double product = 0.0, first = 0.0, square = 0.0;
};

struct RidgeGain {
  double gain = 0.0, amount_um = 0.0;
};
/// What a ridge takes out beside a mean.
RidgeGain gain_of_ridge(const RidgeProducts& sums, const RidgesIn& all) {
  constexpr double kAnything = 1e-6;
  const double product = sums.product - sums.first * all.sum / all.count,
               square = sums.square - sums.first * sums.first / all.count;
  if (!(square > kAnything * all.count)) return {};
  return {product * product / square, product / square};
}

/// In face widths.
constexpr std::array kRidgeWidths = {0.03, 0.05, 0.08, 0.13, 0.2};

/// Products of ridges of all widths about every place across and height.
class RidgeSums {
 public:
  /// Heights in cells, from below the face to above it; and a place where nothing stands.
  static constexpr int kCells = static_cast<int>(kRidgeHeights), kBeyond = kCells / 4,
                       kPlaces = kCells + 2 * kBeyond, kNowhere = kPlaces;
  /// Three products and nothing, as a wide register holds them.
  using At = std::array<double, 4>;
  static RidgeProducts products(const At& sums) { return {sums[0], sums[1], sums[2]}; }

  explicit RidgeSums(const RidgeCells& cells) : at_(kRidgeWidths.size()) {
    for (std::size_t w = 0; w < kRidgeWidths.size(); ++w) {
      const int reach = static_cast<int>(std::ceil(2.5 * kRidgeWidths[w] * kCells));
      std::vector<At> bells;
      for (int off = 0; off <= reach; ++off) {
        const double b = std::exp(-std::pow(off / (kRidgeWidths[w] * kCells), 2));
        bells.push_back({b, b, b * b, 0.0});
      }
      for (std::size_t x = 0; x < kRidgeAcross; ++x) add_bells(cells.of[x], bells, at_[w][x]);
    }
  }

  /// Of a share of the face, from the lowest place on.
  TRUEFLANK_ALWAYS_INLINE static double cells(double height) { return height * kCells + kBeyond; }
  /// The place of it; nothing far off the face.
  TRUEFLANK_ALWAYS_INLINE static int place_of(double height) {
    const double place = cells(height);
    return place >= 0.0 && place < kPlaces ? static_cast<int>(place) : kNowhere;
  }
  /// Four numbers of each place.
  [[nodiscard]] const double* column(std::size_t width, std::size_t x) const {
    return at_[width][x].front().data();
  }

 private:
  static void add_bells(const std::array<RidgeCell, kRidgeHeights>& cells,
                        const std::vector<At>& bells, std::array<At, kPlaces + 1>& column) {
    const int reach = static_cast<int>(bells.size()) - 1;
    std::array<At, kRidgeHeights> values;
    for (std::size_t v = 0; v < kRidgeHeights; ++v)
      values[v] = {cells[v].sum, cells[v].count, cells[v].count, 0.0};
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      const double *const value = values.front().data(), *const bell = bells.front().data();
      double* const of_column = column.front().data();
      const int most = reach;
      for (int place = 0; place < kPlaces; ++place) {
        const int at = place - kBeyond, last = std::min(kCells - 1, at + most);
        FourDoubles sum = {};
        for (int v = std::max(0, at - most); v <= last; ++v) {
          FourDoubles one, b;
          load(one, value + 4 * v);
          load(b, bell + 4 * (v < at ? at - v : v - at));
          sum += b * one;
        }
        store(sum, of_column + 4 * place);
      }
    });
  }

  std::vector<std::array<std::array<At, kPlaces + 1>, kRidgeAcross>> at_;  ///< by width
};

/// What is asked about one side's flanks, or both sides'.
struct RidgesOfWay {
  int way = 0;
  RidgesIn in;
  RidgeSums sums;
};

struct RidgeLine {
  RidgeGain gain;
  double height = 0.0, slope = 0.0, width = 0.0;  ///< in face widths; over the way across

  void become_better(const RidgeLine& other) {
    if (other.gain.gain > gain.gain) *this = other;
  }
};

double share_across(std::size_t x) { return (static_cast<double>(x) + 0.5) / kRidgeAcross; }

/// The best line over the profile; `level`: of those that are not aslant.
RidgeLine best_ridge_over_profile(const RidgesOfWay& of, bool level) {
  constexpr double kStep = 0.05, kMost = 2.5, kFewest = 2.0, kHeightStep = 0.02, kMostlyOn = 0.35;
  std::array<RidgeLine, kRidgeWidths.size()> best{};
  const int most = level ? 0 : static_cast<int>(kMost / kStep);
  for (int k = -most; k <= most; ++k) {
    if (!level && std::abs(k) < kFewest) continue;
    const double slope = k * kStep;
    for (double height = -0.1; height <= 1.1; height += kHeightStep) {
      std::array<RidgeSums::At, kRidgeWidths.size()> sums;
      int on_flank = 0;
      in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
        FourDoubles line[kRidgeWidths.size()] = {};
        const RidgeSums& in = of.sums;
        const double from = height, rise = slope;
        int on = 0;
        for (std::size_t x = 0; x < kRidgeAcross; ++x) {
          const double at = from + rise * (share_across(x) - 0.5);
          const auto place = static_cast<std::ptrdiff_t>(RidgeSums::place_of(at));
          on += at >= 0.0 && at <= 1.0 ? 1 : 0;
          for (std::size_t w = 0; w < kRidgeWidths.size(); ++w) {
            FourDoubles here;
            load(here, in.column(w, x) + 4 * place);
            line[w] += here;
          }
        }
        for (std::size_t w = 0; w < kRidgeWidths.size(); ++w) store(line[w], sums[w].data());
        on_flank = on;
      });
      // (what stands at a corner alone is no line)
      if (on_flank < kMostlyOn * kRidgeAcross) continue;
      for (std::size_t w = 0; w < kRidgeWidths.size(); ++w)
        best[w].become_better(
            {gain_of_ridge(RidgeSums::products(sums[w]), of.in), height, slope, kRidgeWidths[w]});
    }
  }
  RidgeLine of_all;
  for (const RidgeLine& one : best) of_all.become_better(one);
  return of_all;
}

/// Lines around the gear that rise alike, of a width.
struct RisingLines {
  std::size_t width = 0;
  double rise = 0.0, sign = 0.0;
  std::size_t count = 0;
  std::vector<double> heights;  ///< of so many, and as many more as fill a register
};

/// Sums of lines of so many ways, which stand beside each other: a line crosses the face at the
/// same places for each.
using FourWhole [[gnu::vector_size(4 * sizeof(std::int32_t))]] = std::int32_t;
template <std::size_t count>
void add_lines(const std::vector<RidgesOfWay>& ways, const RisingLines& lines,
               std::vector<double>& first, double* sums) {
  constexpr double kFirst = -0.2, kLast = 1.2;  // what stands farther off the face says nothing
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    const double rise = lines.rise, signed_rise = lines.sign * lines.rise;
    const double* const height = lines.heights.data();
    const std::size_t heights = lines.count, width = lines.width;
    double* const from = first.data();
    double* const of_lines = sums;
    const RidgesOfWay* const of_ways = ways.data();
    for (std::size_t x = 0; x < kRidgeAcross; ++x) {
      const double higher = signed_rise * share_across(x);
      for (std::size_t h = 0; h < heights; h += 4) {
        FourDoubles at;
        load(at, height + h);
        at += higher;
        const FourDoubles turns = (at - kFirst) / rise;
        FourDoubles whole =
            __builtin_convertvector(__builtin_convertvector(turns, FourWhole), FourDoubles);
        whole = turns > whole ? whole + 1.0 : whole;
        store(at - whole * rise, from + h);
      }
      const double* of[count];
      for (std::size_t way = 0; way < count; ++way) of[way] = of_ways[way].sums.column(width, x);
      for (std::size_t h = 0; h < heights; ++h) {
        double at = from[h];
        if (RidgeSums::cells(at) < 0.0) at += rise;
        if (!(at < kLast)) continue;
        double* const of_line = of_lines + 4 * count * h;
        FourDoubles sum[count];
        for (std::size_t way = 0; way < count; ++way) load(sum[way], of_line + 4 * way);
        // (all lines that cross the face there)
        for (; at < kLast; at += rise) {
          const auto place = static_cast<std::ptrdiff_t>(RidgeSums::cells(at));
          for (std::size_t way = 0; way < count; ++way) {
            FourDoubles here;
            load(here, of[way] + 4 * place);
            sum[way] += here;
          }
        }
        for (std::size_t way = 0; way < count; ++way) store(sum[way], of_line + 4 * way);
      }
    }
  });
}

/// The best lines around the gear, one of each way.
std::vector<RidgeLine> best_ridges_around(const std::vector<RidgesOfWay>& ways) {
  constexpr double kLeast = 0.1, kMost = 3.0, kTimes = 1.04, kHeightStep = 0.03, kApart = 3.5;
  std::vector<RidgeLine> best(ways.size());
  if (ways.empty()) return best;
  const auto add = ways.size() == 1 ? add_lines<1> : ways.size() == 2 ? add_lines<2> : add_lines<3>;
  std::vector<RidgeSums::At> sums;
  std::vector<double> first;
  for (std::size_t w = 0; w < kRidgeWidths.size(); ++w)
    for (double rise = std::max(kLeast, kApart * kRidgeWidths[w]); rise <= kMost; rise *= kTimes) {
      RisingLines lines{.width = w, .rise = rise};
      for (double height = 0.0; height < rise; height += kHeightStep)
        lines.heights.push_back(height);
      lines.count = lines.heights.size();
      lines.heights.resize((lines.count + 3) / 4 * 4);
      first.resize(lines.heights.size());
      for (const double sign : {-1.0, 1.0}) {
        lines.sign = sign;
        sums.assign(ways.size() * lines.count, {});
        add(ways, lines, first, sums.front().data());
        for (std::size_t i = 0; i < sums.size(); ++i) {
          const std::size_t way = i % ways.size();
          best[way].become_better({gain_of_ridge(RidgeSums::products(sums[i]), ways[way].in),
                                   lines.heights[i / ways.size()], sign * rise, kRidgeWidths[w]});
        }
      }
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
          RidgeProducts sums;
          for (std::size_t x = 0; x < kRidgeAcross; ++x) {
            const double u = share_across(x), from_end = (tip ? 1.0 - u : u) / over_profile;
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
  RidgeProducts sums;
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
                                                    const std::vector<std::uint32_t>& scanned) {
  constexpr double kLooks = 1e5, kMostOfIt = 0.5, kAslant = 1.3;
  // (errors that hang together over a few cells follow some line: in variances of single values)
  constexpr double kFarBeyond = 400.0, kMoreThanACorner = 1.15;
  const std::size_t rows = scanned.size();
  std::size_t taken = 0;
  if (rows < kFewestRidgeRows) return {};
  const ThinnedRows some(rows, kRidgeRows), few(rows, kRidgeRowsMoved);
  RidgeValues values;
  std::vector<RidgeCellsOfSide> sides(2);
  const auto cell = [](double share, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(share * static_cast<double>(count)), 0.0,
                                               static_cast<double>(count - 1)));
  };
  for (const std::uint32_t i : scanned) {
    if (!some.has(i)) continue;
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
  RidgeCellsOfSide both = sides[0];
  both.profile += sides[1].profile;
  both.around += sides[1].around;
  const auto cells_of = [&](int way) -> const RidgeCellsOfSide& {
    return way < 0 ? both : sides[static_cast<std::size_t>(way)];
  };
  std::array<std::vector<RidgesOfWay>, 2> asked;  // over the profile, around
  for (const int way : {-1, 0, 1})
    for (const bool around : {false, true}) {
      const RidgeCells& in = around ? cells_of(way).around : cells_of(way).profile;
      if (const RidgesIn all = ridges_in(in); all.is_clear())
        asked[around ? 1 : 0].push_back({way, all, RidgeSums(in)});
    }
  const std::vector<RidgeLine> lines_around = best_ridges_around(asked[1]);
  for (const int way : {-1, 0, 1}) {
    const FlankChoice flank =
        way < 0 ? FlankChoice::kBoth
                : flank_of(geometry, geometry.on_flank(1, way > 0 ? 1 : -1,
                                                       geometry.root_form_roll_mm(), 0.0));
    for (const bool around : {false, true}) {
      const std::vector<RidgesOfWay>& of_ways = asked[around ? 1 : 0];
      const auto of = std::find_if(of_ways.begin(), of_ways.end(),
                                   [&](const RidgesOfWay& one) { return one.way == way; });
      if (of == of_ways.end()) continue;
      const RidgesIn& all = of->in;
      const RidgeLine line = around ? lines_around[static_cast<std::size_t>(of - of_ways.begin())]
                                    : best_ridge_over_profile(*of, false);
      const double gain = line.gain.gain, level = best_ridge_over_profile(*of, true).gain.gain;
      if (gain < kMostOfIt * all.structure || gain < kAslant * level ||
          gain < kFarBeyond * all.variance)
        continue;
      if (!around && gain < kMoreThanACorner * best_at_a_corner(cells_of(way).profile, all))
        continue;
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
