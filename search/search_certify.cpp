// SPDX-License-Identifier: GPL-3.0-or-later
//
// At a fixed centre distance the layers do not know of each other. So a stretch of centre distances
// has two lists of cells, stretches of a layer's shift, and its bound is the train's efficiency
// with the meshes of the best cells. The stretch with the highest bound goes on: its best cells are
// looked at, or halved, or the stretch is.
#include "trueflank/search/search_certify.h"

#include <algorithm>
#include <cstdint>
#include <queue>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/search/search_enclosed_balance.h"
#include "trueflank/search/search_enclosure.h"

namespace trueflank {
namespace {

/// Halvings of a range after which a stretch is a point.
constexpr int kFinestHalving = 28;
/// A stretch of centre distances is halved before its cells where it is wider than this share of
/// one: shift sums change about twice as fast as the distance.
constexpr double kDistanceShare = 0.5;

/// A part of a range by halving: 1 is the whole, 2 n and 2 n + 1 are the halves of n.
using Part = std::uint32_t;

Interval part_of(const Interval& whole, Part part) {
  int halvings = 0;
  while ((part >> halvings) > 1) ++halvings;
  const double step = (whole.hi - whole.lo) / std::ldexp(1.0, halvings);
  const double from = static_cast<double>(part - (Part{1} << halvings));
  // neighbours share their end, to the last bit
  return {whole.lo + step * from, whole.lo + step * (from + 1.0)};
}

/// A stretch of a layer's shift.
struct Cell {
  Part shift = 1;
  Part distance = 0;  ///< where it was looked at: the stretch itself or one around it; 0: not yet
  std::array<Interval, 2> meshes{Interval(0.0, 1.0),
                                 Interval(0.0, 1.0)};  ///< efficiencies, in the balance's order
  double bound = 1.0;         ///< of the train, with the best of the other layer
  double weighed_with = 2.0;  ///< efficiency of that
  bool weighed = false;       ///< since it was looked at
};

struct Stretch {
  Part distance = 1;
  std::array<std::vector<Cell>, 2> cells;  ///< of each layer
  std::array<std::size_t, 2> best{};       ///< of them
  double bound = 1.0;
};

class Certificate {
 public:
  Certificate(const SearchRequirements& r, const ToothSet& set, DriveDirection direction)
      : r_(r),
        model_(r, set),
        balance_(model_, direction),
        forward_(direction == DriveDirection::kForward) {
    // the optimiser stays inside of its ranges: a hair is room enough for their rounding
    constexpr double kHair = 1e-9;
    distances_ = {set.centre_distance_min - kHair, set.centre_distance_max + kHair};
    shifts_ = {r.shift_min - kHair, r.shift_max + kHair};
    set_up_layers();
  }

  CertifiedBound run(const CertifyOptions& options) {
    const auto less = [](const Stretch& p, const Stretch& q) {
      return p.bound != q.bound ? p.bound < q.bound : p.distance > q.distance;
    };
    std::vector<Stretch> open;
    open.emplace_back();
    for (std::size_t l = 0; l < layers_.size(); ++l) open.back().cells[l].emplace_back();
    const double enough = options.known + options.close;
    double highest = 1.0;
    while (!open.empty()) {
      highest = open.front().bound;
      if (highest <= enough || boxes_ >= options.most_boxes) break;
      std::pop_heap(open.begin(), open.end(), less);
      Stretch top = std::move(open.back());
      open.pop_back();
      const auto keep = [&](Stretch&& stretch) {
        if (stretch.bound < 0.0) return;
        open.push_back(std::move(stretch));
        std::push_heap(open.begin(), open.end(), less);
      };
      if (look_closer(top)) {
        keep(std::move(top));
      } else if (top.distance >> kFinestHalving) {
        break;
      } else {
        for (const Part half : {2 * top.distance, 2 * top.distance + 1}) {
          Stretch part = top;
          part.distance = half;
          keep(std::move(part));
        }
      }
    }
    return {.efficiency = open.empty() ? options.known : std::max(options.known, highest),
            .boxes = boxes_};
  }

 private:
  void set_up_layers() {
    const SearchTrain& train = model_.train();
    const auto& meshes = model_.balance();
    for (std::size_t l = 0; l < train.layers.size(); ++l) {
      const SearchLayer& gears = train.layers[l];
      const auto teeth = [&](int gear) {
        return gear < 0 ? 0 : model_.set().teeth_at(train.place_of(gear));
      };
      const double module = l == 0 ? 1.0 : model_.set().layer2_module_ratio;
      const auto drives = [&](int mesh) {
        return mesh < 0 || meshes[static_cast<std::size_t>(mesh)].gear1_drives_forward == forward_;
      };
      layers_.push_back({.sun = teeth(gears.sun),
                         .planet = teeth(gears.planet),
                         .ring = teeth(gears.ring),
                         .planets = model_.set().planets,
                         .module = module,
                         .least_module_mm = model_.least_module_mm() * module,
                         .sun_drives = drives(gears.sun_planet),
                         .planet_drives_ring = drives(gears.planet_ring)});
      std::vector<std::size_t> own;
      for (std::size_t k = 0; k < meshes.size(); ++k)
        if (meshes[k].layer == static_cast<int>(l)) own.push_back(k);
      TRUEFLANK_EXPECTS(!own.empty() && own.size() <= 2);
      meshes_of_.push_back(own);
    }
    TRUEFLANK_EXPECTS(layers_.size() == 1 || meshes_of_[1].size() == 1);
  }

  /// Looks at the best cells of a stretch, or halves them; false: the stretch is to be halved.
  bool look_closer(Stretch& s) {
    const double width = part_of(distances_, s.distance).width();
    bool closer = false;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
      auto& cells = s.cells[l];
      const std::size_t best = s.best[l];
      if (cells[best].distance != s.distance) {
        if (!look(l, s.distance, cells[best])) drop(cells, best);
        closer = true;
      } else if (kDistanceShare * part_of(shifts_, cells[best].shift).width() > width &&
                 !(cells[best].shift >> kFinestHalving)) {
        halve(l, s.distance, cells, best);
        closer = true;
      }
      if (cells.empty()) {
        s.bound = -1.0;
        return true;
      }
    }
    if (closer) weigh(s);
    return closer;
  }

  static void drop(std::vector<Cell>& cells, std::size_t which) {
    cells[which] = cells.back();
    cells.pop_back();
  }

  void halve(std::size_t layer, Part distance, std::vector<Cell>& cells, std::size_t which) {
    const Cell whole = cells[which];
    drop(cells, which);
    for (const Part half : {2 * whole.shift, 2 * whole.shift + 1}) {
      Cell cell = whole;
      cell.shift = half;
      if (look(layer, distance, cell)) cells.push_back(cell);
    }
  }

  /// False: no point of the cell keeps every limit. What was known of a wider one holds too.
  bool look(std::size_t layer, Part distance, Cell& cell) {
    ++boxes_;
    const LayerEnclosure found = enclose(
        r_, layers_[layer], {part_of(distances_, distance), part_of(shifts_, cell.shift), 1});
    if (!found.possible) return false;
    cell.distance = distance;
    cell.weighed = false;
    for (std::size_t i = 0; i < meshes_of_[layer].size(); ++i) {
      const bool internal = model_.balance()[meshes_of_[layer][i]].internal;
      const Interval& v = internal ? found.planet_ring.v : found.sun_planet.v;
      Interval& known = cell.meshes[i];
      known = {std::max(known.lo, v.lo), std::min(known.hi, v.hi)};
    }
    return true;
  }

  /// The best cells of a stretch and its bound with them.
  void weigh(Stretch& s) {
    std::vector<Interval> meshes(model_.balance().size());
    if (layers_.size() > 1) {  // one mesh: the better it is, the better the train
      Interval all = s.cells[1].front().meshes[0];
      s.best[1] = 0;
      for (std::size_t i = 0; i < s.cells[1].size(); ++i) {
        const Interval& mesh = s.cells[1][i].meshes[0];
        if (mesh.hi > all.hi) s.best[1] = i;
        all = hull(all, mesh);
      }
      meshes[meshes_of_[1][0]] = all;
    }
    // with what the other layer was when a cell was weighed its bound holds all the more
    const double other = layers_.size() > 1 ? meshes[meshes_of_[1][0]].hi : 1.0;
    while (true) {
      const auto best =
          std::max_element(s.cells[0].begin(), s.cells[0].end(),
                           [](const Cell& p, const Cell& q) { return p.bound < q.bound; });
      if (best->weighed_with == other && best->weighed) {
        s.best[0] = static_cast<std::size_t>(best - s.cells[0].begin());
        s.bound = std::min(s.bound, best->bound);
        return;
      }
      for (std::size_t k = 0; k < meshes_of_[0].size(); ++k)
        meshes[meshes_of_[0][k]] = best->meshes[k];
      best->bound = std::min(best->bound, balance_.most(meshes));
      best->weighed_with = other;
      best->weighed = true;
    }
  }

  const SearchRequirements& r_;
  SearchModel model_;
  EnclosedBalance balance_;
  bool forward_;
  Interval distances_, shifts_;
  std::vector<EnclosedLayer> layers_;
  std::vector<std::vector<std::size_t>> meshes_of_;  ///< of each layer, in the balance
  int boxes_ = 0;
};

}  // namespace

CertifiedBound certified_bound(const SearchRequirements& requirements, const ToothSet& set,
                               DriveDirection direction, const CertifyOptions& options) {
  return Certificate(requirements, set, direction).run(options);
}

}  // namespace trueflank
