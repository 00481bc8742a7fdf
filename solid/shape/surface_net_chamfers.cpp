// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fillets of edge chamfers: strips one above the other, as many as each stretch asks for.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "trueflank/solid/shape/surface_net.h"

namespace trueflank {
namespace {

/// Saddles bent by more than this share of the room a strip have facets only where the vertices of
/// one row stand between those of the other.
constexpr double kAnyPhase = 1.0;
/// Domes bent by more than this share of the room a strip need more strips.
constexpr double kDomeOfStrip = 0.75;
/// More strips a chamfer is not cut into: rows have bits in one number.
constexpr int kMostStrips = 24;
/// Rounds after which the numbers of strips are chosen anew.
constexpr int kRoundsOfAChoice = 6;
/// A stretch may end so many cells farther on, where its rows have as many vertices.
constexpr double kFartherOn = 0.4;
constexpr int kSteps = 3;
/// Changes of stretches that are tried one after the other.
constexpr int kMostChanges = 12;
constexpr double kNoWay = 1e300;

template <class Strips>
std::size_t end_of_stretch(const Strips& strips, std::size_t cell) {
  std::size_t end = cell + 1;
  while (end < strips.size() && strips[end] == strips[cell]) ++end;
  return end;
}

/// The cheapest number of strips of each cell. A column between two numbers has the vertices of
/// both, and each stretch is rounded to whole steps.
template <class Costs, class Strips>
void choose_cheapest(const Costs& costs, Strips& strips) {
  const auto ways = costs.front().size();
  const auto change = [](std::size_t a, std::size_t b) {
    const auto sum = static_cast<double>(a + b);
    return a == b ? 0.0 : sum - 2.0 * static_cast<double>(std::gcd(a, b)) + 0.25 * sum + 0.5;
  };
  std::vector<double> sums(ways, kNoWay);
  std::vector<std::vector<std::size_t>> before(costs.size(), std::vector<std::size_t>(ways));
  for (std::size_t w = 1; w < ways; ++w) sums[w] = costs[0][w] + static_cast<double>(w) - 1.0;
  for (std::size_t cell = 1; cell < costs.size(); ++cell) {
    std::vector<double> next(ways, kNoWay);
    for (std::size_t w = 1; w < ways; ++w)
      for (std::size_t v = 1; v < ways; ++v) {
        const double sum = sums[v] + change(v, w) + costs[cell][w];
        if (sum < next[w]) next[w] = sum, before[cell][w] = v;
      }
    sums = next;
  }
  for (std::size_t w = 1; w < ways; ++w) sums[w] += static_cast<double>(w) - 1.0;
  auto way = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  for (std::size_t cell = costs.size(); cell-- > 0;) {
    strips[cell] = static_cast<int>(way);
    way = before[cell][way];
  }
}

}  // namespace

/// The lower or upper end of the grid, if that is an edge chamfer's.
bool ToothingGrid::SurfaceNet::is_chamfer(std::size_t patch) const {
  const std::size_t last = patch_count() - 1;
  if (chamfers_ == Chamfers::kPosts || last == 0 || (patch != 0 && patch != last)) return false;
  const double z = height_of(patch, 0.5),
               from_end = std::min(z, g_.toothing_.twist.face_width_mm - z);
  return from_end < g_.toothing_.edge_chamfer_mm;
}

/// Vertices of a cell on the chamfer's break and on a row within it, with so many strips. On the
/// break whole numbers of them stand between two posts of the patch beside it.
std::pair<double, double> ToothingGrid::SurfaceNet::rows_with(const Panel& panel, std::size_t patch,
                                                              std::size_t cell, int strips) const {
  const std::size_t beside = patch == 0 ? 1 : patch - 1;
  const double room = room_of(panel, patch, cell);
  const double inside = chords_of(panel.patches[patch], cell, room, strips);
  double on_break =
      std::max(inside, chords_of(panel.patches[beside], cell, room_of(panel, beside, cell)));
  const double middle = cell_edge(panel, static_cast<double>(cell) + 0.5);
  const double sense = panel.to > panel.from ? 1.0 : -1.0;
  double low = panel.from, high = panel.to;
  for (const double post : panel.posts[beside])
    if (sense * post <= sense * middle)
      low = post;
    else if (high == panel.to)
      high = post;
  const double cells = kCells * (high - low) / (panel.to - panel.from);
  if (!panel.posts[beside].empty()) on_break = whole_parts(on_break * cells) / cells;
  double saddle = 0.0;
  for (const SurfaceForm& form : panel.patches[patch].forms[cell])
    saddle = std::max(saddle, -form.left_up(room));
  return {on_break, saddle > kAnyPhase * strips * strips ? on_break : inside};
}

ToothingGrid::SurfaceNet::CellCosts ToothingGrid::SurfaceNet::costs_of_strips(
    const Panel& panel, std::size_t patch) const {
  CellCosts costs;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double room = room_of(panel, patch, cell);
    double along = 0.0, dome = 0.0;
    for (const SurfaceForm& form : panel.patches[patch].forms[cell]) {
      along = std::max(along, std::abs(form.along) / room);
      dome = std::max(dome, form.left_up(room));
    }
    const int least =
        std::min(kMostStrips, whole_parts(std::sqrt(std::max(along, dome / kDomeOfStrip))));
    costs[cell].assign(static_cast<std::size_t>(kMostStrips) + 1, kNoWay);
    for (int strips = least; strips <= kMostStrips; ++strips) {
      const auto [on_break, inside] = rows_with(panel, patch, cell, strips);
      costs[cell][static_cast<std::size_t>(strips)] = 2.0 * (on_break + strips * inside);
    }
  }
  return costs;
}

RowBeside ToothingGrid::SurfaceNet::row_beside(const Panel& panel, std::size_t patch) const {
  const std::size_t beside = patch == 0 ? 1 : patch - 1;
  RowBeside row{.chords = ColumnDemand(0.0, kCells)};
  for (std::size_t c = 0; c < kCells; ++c)
    row.chords.add(chords_of(panel.patches[beside], c, room_of(panel, beside, c)));
  if (patch != 0 && beside == 0) {  // another chamfer, whose rows are laid
    for (const Stretch& stretch : panel.patches[beside].stretches)
      row.fixed.insert(row.fixed.end(), stretch.rows[0].begin() + 1, stretch.rows[0].end());
    return row;
  }
  for (const double post : panel.posts[beside])
    row.fixed.push_back(kCells * (post - panel.from) / (panel.to - panel.from));
  return row;
}

BentEdges ToothingGrid::SurfaceNet::bent_edges(const Panel& panel, std::size_t patch) const {
  const PanelForms& forms = panel.patches[patch].forms;
  std::vector<double> rooms;
  for (std::size_t c = 0; c < kCells; ++c) rooms.push_back(room_of(panel, patch, c));
  return BentEdges({forms.begin(), forms.end()}, kHeights, rooms);
}

/// Each stretch ends where its rows are used up.
void ToothingGrid::SurfaceNet::lay_stretches(Panel& panel, std::size_t patch,
                                             const StripsByCell& strips) const {
  std::vector<Stretch>& stretches = panel.patches[patch].stretches;
  stretches.clear();
  panel.posts[patch].clear();
  const BentEdges edges = bent_edges(panel, patch);
  const RowBeside beside = row_beside(panel, patch);
  double from = 0.0;
  for (std::size_t cell = 0; cell < kCells;) {
    const std::size_t end = end_of_stretch(strips, cell);
    const Strips cut{edges, beside, strips[cell], patch == 0};
    Stretch stretch{from, static_cast<double>(end), strips[cell]};
    if (end < kCells) {
      const std::size_t count = vertex_count(strip_rows(cut, from, stretch.to));
      double step = kFartherOn;
      for (int i = 0; i < kSteps; ++i, step *= 0.5)
        if (vertex_count(strip_rows(cut, from, stretch.to + step)) <= count) stretch.to += step;
      panel.posts[patch].push_back(cell_edge(panel, stretch.to));
    }
    stretch.rows = even_strip_rows(cut, from, stretch.to);
    from = stretch.to, cell = end;
    stretches.push_back(std::move(stretch));
  }
}

/// Of each chamfer and fillet by itself: posts end the stretches of equal numbers.
void ToothingGrid::SurfaceNet::lay_strips() {
  const bool choose = round_ % kRoundsOfAChoice == 0;
  if (choose) strips_.clear();
  std::size_t next = 0;
  for (const std::size_t patch : {std::size_t{0}, patch_count() - 1}) {
    if (!is_chamfer(patch)) continue;
    for (Panel& panel : panels_) {
      if (!is_fillet(panel)) continue;
      if (choose) strips_.push_back(choose_strips(panel, patch));
      lay_stretches(panel, patch, strips_[next++]);
    }
  }
}

/// Begins with what cells by themselves would have, and changes stretches as long as that saves
/// facets.
ToothingGrid::SurfaceNet::StripsByCell ToothingGrid::SurfaceNet::choose_strips(
    const Panel& panel, std::size_t patch) const {
  const CellCosts costs = costs_of_strips(panel, patch);
  const BentEdges edges = bent_edges(panel, patch);
  const RowBeside beside = row_beside(panel, patch);
  std::map<std::array<std::size_t, 3>, double> known;
  const auto facets = [&](const StripsByCell& strips) {
    double sum = strips.front() + strips.back() - 2.0;
    for (std::size_t cell = 0; cell < kCells;) {
      const std::size_t end = end_of_stretch(strips, cell);
      const auto count = static_cast<std::size_t>(strips[cell]);
      const auto [at, is_new] = known.insert({{cell, end, count}, 0.0});
      if (is_new)
        at->second = 2.0 * static_cast<double>(vertex_count(
                               strip_rows({edges, beside, strips[cell], patch == 0},
                                          static_cast<double>(cell), static_cast<double>(end)))) -
                     static_cast<double>(count) - 1.0;
      sum += at->second;
      if (end < kCells)
        sum += strips[cell] + strips[end] - 2.0 * std::gcd(strips[cell], strips[end]);
      cell = end;
    }
    return sum;
  };
  StripsByCell best{};
  choose_cheapest(costs, best);
  double fewest = facets(best);
  const auto try_one = [&](const StripsByCell& strips) {
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      const auto count = static_cast<std::size_t>(strips[cell]);
      if (count < 1 || count >= costs[cell].size() || costs[cell][count] >= kNoWay) return false;
    }
    const double sum = facets(strips);
    if (sum >= fewest) return false;
    fewest = sum, best = strips;
    return true;
  };
  for (int round = 0; round < kMostChanges; ++round) {
    bool changed = false;
    for (std::size_t cell = 0; cell < kCells; cell = end_of_stretch(best, cell)) {
      const std::size_t end = end_of_stretch(best, cell);
      const auto with = [&](std::size_t from, std::size_t to, int count) {
        StripsByCell strips = best;
        std::fill(strips.begin() + from, strips.begin() + to, count);
        return try_one(strips);
      };
      if (with(cell, end, best[cell] + 1) || with(cell, end, best[cell] - 1) ||
          (cell > 0 && (with(cell, end, best[cell - 1]) || with(cell, cell + 1, best[cell - 1]))) ||
          (end < kCells && (with(cell, end, best[end]) || with(end - 1, end, best[end])))) {
        changed = true;
        break;
      }
    }
    if (!changed) break;
  }
  return best;
}

/// The rows within a chamfer, that of the break and that of the end face.
void ToothingGrid::SurfaceNet::add_strips(Panel& panel, std::size_t patch,
                                          std::vector<std::vector<double>>& rows,
                                          std::vector<std::vector<double>>& levels) const {
  const bool down = patch == 0;
  std::vector<double>&on_break = rows[down ? 1 : patch], &end_row = rows[down ? 0 : patch + 1];
  on_break = end_row = {panel.from};
  const std::size_t first_level = levels.size();
  for (Stretch& stretch : panel.patches[patch].stretches) {
    stretch.first_level = first_level;
    const auto strips = static_cast<std::size_t>(stretch.strips);
    levels.resize(std::max(levels.size(), first_level + strips - 1));
    for (std::size_t k = 0; k <= strips; ++k) {
      const auto& places = stretch.rows[k];
      const bool within = k > 0 && k < strips;
      auto& row = k == 0        ? on_break
                  : k == strips ? end_row
                                : levels[first_level + (down ? strips - k : k) - 1];
      for (std::size_t p = 1; p + (within ? 1 : 0) < places.size(); ++p)
        row.push_back(places[p] < kCells ? cell_edge(panel, places[p]) : panel.to);
    }
  }
}

/// Of the strips between some parameters of a panel of the patch.
const ToothingGrid::SurfaceNet::Stretch* ToothingGrid::SurfaceNet::stretch_of(std::size_t edge,
                                                                              double from,
                                                                              double to) const {
  const Panel& panel = panel_of(edge);
  if (panel.land || panel.patches[patch_].stretches.empty()) return nullptr;
  const double place = kCells * (0.5 * (from + to) - panel.from) / (panel.to - panel.from);
  for (const Stretch& stretch : panel.patches[patch_].stretches)
    if (place < stretch.to) return &stretch;
  return &panel.patches[patch_].stretches.back();
}

}  // namespace trueflank
