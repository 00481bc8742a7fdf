// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part is a stack of slabs. Its walls are rows of loop points; its plane faces lie where the sections
// below and above an interface differ, and their boundaries are rows of the same points.
#include "trueflank/solid/mesh/gear_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/mesh/bed_rows.h"
#include "trueflank/solid/mesh/cap_triangulation.h"
#include "trueflank/solid/shape/flank_strips.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

constexpr int kNone = -1;

/// Coarser than this part of the module, teeth lose their shape.
constexpr double kCoarsestOfModule = 0.05;
/// Chords may take this share of the thinnest wall.
constexpr double kCoarsestOfWall = 0.1;

class StackMesher {
 public:
  StackMesher(const PartShape& shape, const MeshOptions& options) : shape_(shape) {
    TRUEFLANK_EXPECTS(!shape.slabs.empty() && options.tolerance_mm > 0.0);
    for (const Slab& slab : shape.slabs) {
      Section section;
      section.outer = loop_index(slab.outer);
      for (const Outline& hole : slab.holes) section.holes.push_back(loop_index(hole));
      sections_.push_back(std::move(section));
    }
    const double tolerance = meshing_tolerance_mm(shape, options.tolerance_mm);
    for (int loop = 0; loop < static_cast<int>(outlines_.size()); ++loop) add_loop(loop, tolerance);
    rows_.assign(loops_.size() * (sections_.size() + 1), kNone);
  }

  PartMesh build() {
    for (int loop = 0; loop < static_cast<int>(loops_.size()); ++loop) add_walls(loop);
    for (std::size_t level = 0; level <= sections_.size(); ++level) add_faces(level);
    return std::move(result_);
  }

 private:
  /// Loops bounding a slab.
  struct Section {
    int outer = kNone;
    std::vector<int> holes;
    [[nodiscard]] bool has_hole(int loop) const {
      return std::find(holes.begin(), holes.end(), loop) != holes.end();
    }
    [[nodiscard]] bool has(int loop) const { return outer == loop || has_hole(loop); }
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  int loop_index(const Outline& outline) {
    for (std::size_t i = 0; i < outlines_.size(); ++i)
      if (same_outline(*outlines_[i], outline)) return static_cast<int>(i);
    outlines_.push_back(&outline);
    return static_cast<int>(outlines_.size()) - 1;
  }

  /// A prism's loop is the same at every height; any other toothing has a grid, and its loop at the
  /// height where it is met first stands for it where only its size is asked for.
  void add_loop(int loop, double tolerance_mm) {
    grids_.emplace_back();
    beds_.emplace_back();
    const auto* toothed = std::get_if<ToothedOutline>(outlines_[at(loop)]);
    if (toothed == nullptr && bed_height_mm(*outlines_[at(loop)]) > 0.0) {
      beds_.back() = bed_rows(*outlines_[at(loop)], tolerance_mm);
      loops_.push_back(loop_at_height(loop, 0.0));
      loops_.back().chord_error_mm = beds_.back()->chord_error_mm;
    } else if (toothed == nullptr || is_plain_prism(*toothed)) {
      loops_.push_back(outline_loop(*outlines_[at(loop)], tolerance_mm));
    } else {
      std::vector<double> levels;
      for (std::size_t s = 0; s < sections_.size(); ++s)
        if (sections_[s].has(loop))
          for (const double z : {z_of(s), z_of(s + 1)})
            if (levels.empty() || z != levels.back() + toothed->z_lower_mm)
              levels.push_back(z - toothed->z_lower_mm);
      grids_.back().emplace(*toothed, levels, tolerance_mm);
      loops_.push_back(loop_at_height(loop, levels.front() + toothed->z_lower_mm));
      loops_.back().chord_error_mm = grids_.back()->chord_error_mm();
    }
    result_.chord_error_mm = std::max(result_.chord_error_mm, loops_.back().chord_error_mm);
  }

  [[nodiscard]] bool is_prism(int loop) const { return !grids_[at(loop)] && !beds_[at(loop)]; }

  /// The loop at a height of the part.
  [[nodiscard]] OutlineLoop loop_at_height(int loop, double z_mm) const {
    if (beds_[at(loop)])
      return loop_through(bed_row(loop, z_mm), extent(*outlines_[at(loop)]).centre);
    if (!grids_[at(loop)]) return loops_[at(loop)];
    const ToothingGrid& grid = *grids_[at(loop)];
    std::vector<Point2> points;
    for (const auto& p : grid.row(height_in_gear(loop, z_mm))) points.push_back({p[0], p[1]});
    OutlineLoop result = loop_through(std::move(points));
    result.teeth = grid.teeth();
    result.points_per_tooth = grid.points_per_tooth();
    result.teeth_alike = grid.teeth_alike();
    return result;
  }
  /// At the bed, or above the chamfer.
  [[nodiscard]] const std::vector<Point2>& bed_row(int loop, double z_mm) const {
    const BedRows& bed = *beds_[at(loop)];
    return z_mm > 0.0 ? bed.rows.back() : bed.rows.front();
  }
  [[nodiscard]] double height_in_gear(int loop, double z_mm) const {
    return z_mm - std::get<ToothedOutline>(*outlines_[at(loop)]).z_lower_mm;
  }

  [[nodiscard]] double z_of(std::size_t level) const {
    return level == 0 ? shape_.slabs.front().z_lower_mm : shape_.slabs[level - 1].z_upper_mm;
  }

  /// First vertex of a loop's points at an interface; made when first asked for.
  std::uint32_t row(int loop, std::size_t level) {
    int& first = rows_[at(loop) * (sections_.size() + 1) + level];
    if (first == kNone) {
      first = static_cast<int>(result_.mesh.vertices.size());
      if (grids_[at(loop)])
        add_row(*grids_[at(loop)], height_in_gear(loop, z_of(level)), {});
      else
        add_row(beds_[at(loop)] ? bed_row(loop, z_of(level)) : loops_[at(loop)].points, z_of(level));
    }
    return static_cast<std::uint32_t>(first);
  }
  /// All columns of a row, or where some are left out, those that are not.
  std::uint32_t add_row(const ToothingGrid& grid, double z_mm, const std::vector<int>& kept) {
    auto& vertices = result_.mesh.vertices;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const auto row = grid.row(z_mm);
    if (kept.empty()) {
      vertices.insert(vertices.end(), row.begin(), row.end());
      return first;
    }
    for (std::size_t v = 0; v < row.size(); ++v)
      if (kept[v % kept.size()] != kNone) vertices.push_back(row[v]);
    return first;
  }
  std::uint32_t add_row(const std::vector<Point2>& points, double z_mm) {
    const auto first = static_cast<std::uint32_t>(result_.mesh.vertices.size());
    for (const Point2& p : points) add_vertex(p, z_mm);
    return first;
  }
  void add_vertex(const Point2& p, double z_mm) {
    result_.mesh.vertices.push_back({p.x(), p.y(), z_mm});
  }

  /// Walls of a loop, one over each run of slabs it bounds without a break.
  void add_walls(int loop) {
    for (std::size_t s = 0; s < sections_.size();) {
      if (!sections_[s].has(loop)) {
        ++s;
        continue;
      }
      const bool hole = sections_[s].has_hole(loop);
      const std::size_t begin = s;
      while (s < sections_.size() && sections_[s].has(loop) && sections_[s].has_hole(loop) == hole)
        ++s;
      if (grids_[at(loop)])
        add_grid(loop, begin, s, hole);
      else if (beds_[at(loop)] && begin == 0)
        add_bed(loop, s, hole);
      else {
        // one after the other: each may add vertices, and arguments are evaluated in any order
        const std::uint32_t upper = row(loop, s), lower = row(loop, begin);
        add_strip(loops_[at(loop)].points.size(), lower, upper, hole);
      }
    }
  }

  /// The wall of a circle or bore from its bed chamfer to an interface.
  void add_bed(int loop, std::size_t last_level, bool hole) {
    const BedRows& bed = *beds_[at(loop)];
    std::uint32_t lower = row(loop, 0);
    for (std::size_t k = 1; k < bed.rows.size(); ++k) {
      const std::uint32_t upper = add_row(bed.rows[k], bed.heights_mm[k]);
      add_strip(bed.rows[k].size(), lower, upper, hole);
      lower = upper;
    }
    add_strip(bed.rows.back().size(), lower, row(loop, last_level), hole);
  }

  /// A row of a grid in the mesh. Between whole rows the columns within flank strips have no vertex.
  struct GridRow {
    std::uint32_t first = 0;
    bool whole = true;
  };
  /// The grid's columns that every row has, numbered; kNone within flank strips.
  struct KeptColumns {
    std::vector<int> numbers;
    std::uint32_t count = 0;
  };
  static KeptColumns kept_columns(const ToothingGrid& grid) {
    KeptColumns kept{std::vector<int>(at(grid.points_per_tooth()), 0), 0};
    for (const ToothingGrid::Strip& strip : grid.flank_strips())
      for (int i = strip.first + 1; i < strip.last; ++i) kept.numbers[at(i)] = kNone;
    for (int& i : kept.numbers)
      if (i != kNone) i = static_cast<int>(kept.count++);
    return kept;
  }

  /// The wall of a toothing that is no prism, from one interface to another.
  void add_grid(int loop, std::size_t first_level, std::size_t last_level, bool hole) {
    const ToothingGrid& grid = *grids_[at(loop)];
    const auto& heights = grid.heights_mm();
    const KeptColumns kept = kept_columns(grid);
    std::size_t level = first_level;
    const auto row_at = [&](std::size_t j) {
      // interfaces are rows of the grid: their vertices are those of the faces
      if (std::abs(heights[j] - height_in_gear(loop, z_of(level))) < 1e-9)
        return GridRow{row(loop, level++), true};
      const bool whole = grid.is_whole(j);
      return GridRow{add_row(grid, heights[j], whole ? std::vector<int>{} : kept.numbers), whole};
    };
    const auto from_start = [&](std::size_t j) {
      return heights[j] - height_in_gear(loop, z_of(first_level));
    };
    std::size_t j = 0;
    while (from_start(j) < -1e-9) ++j;
    std::vector<GridRow> patch{row_at(j)};
    while (level <= last_level) {
      patch.push_back(row_at(j + 1));
      add_layer(grid, kept, j, patch[patch.size() - 2], patch.back(), hole);
      ++j;
      if (!patch.back().whole) continue;
      add_flank_strips(grid, kept, j + 1 - patch.size(), patch, hole);
      patch = {patch.back()};
    }
  }

  /// Number of a grid's vertex in a row.
  static std::uint32_t vertex_of(const ToothingGrid& grid, const KeptColumns& kept,
                                 const GridRow& row, std::uint32_t tooth, int column) {
    if (column == grid.points_per_tooth()) {
      column = 0;
      tooth = (tooth + 1) % static_cast<std::uint32_t>(grid.teeth());
    }
    if (row.whole)
      return row.first + tooth * static_cast<std::uint32_t>(grid.points_per_tooth()) +
             static_cast<std::uint32_t>(column);
    return row.first + tooth * kept.count + static_cast<std::uint32_t>(kept.numbers[at(column)]);
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool hole) {
    if (hole) std::swap(b, c);
    result_.mesh.triangles.push_back({a, b, c});
  }

  /// The flanks between two whole rows, `first_layer` above the lower one.
  void add_flank_strips(const ToothingGrid& grid, const KeptColumns& kept,
                        std::size_t first_layer, const std::vector<GridRow>& rows, bool hole) {
    for (const ToothingGrid::Strip& strip : grid.flank_strips()) {
      const auto facets = strips(strip.last - strip.first, static_cast<int>(rows.size()) - 1,
                                 grid.falls(strip, first_layer), grid.column_turn_rad(),
                                 grid.row_turn_rad(first_layer));
      for (std::uint32_t tooth = 0; tooth < static_cast<std::uint32_t>(grid.teeth()); ++tooth) {
        const auto vertex = [&](const PatchNode& node) {
          return vertex_of(grid, kept, rows[at(node[1])], tooth, strip.first + node[0]);
        };
        for (const auto& t : facets) add_triangle(vertex(t[0]), vertex(t[1]), vertex(t[2]), hole);
      }
    }
  }

  /// The quadrilaterals between two rows, but for those of flank strips.
  void add_layer(const ToothingGrid& grid, const KeptColumns& kept, std::size_t layer,
                 const GridRow& lower, const GridRow& upper, bool hole) {
    const int n = grid.points_per_tooth();
    std::vector<int> columns;
    for (int i = 0; i < n; ++i)
      if (std::none_of(grid.flank_strips().begin(), grid.flank_strips().end(),
                       [&](const ToothingGrid::Strip& s) { return i >= s.first && i < s.last; }))
        columns.push_back(i);
    for (int tooth = 0; tooth < grid.teeth(); ++tooth)
      for (const int i : columns) {
        const auto k = static_cast<std::uint32_t>(tooth);
        const std::uint32_t a = vertex_of(grid, kept, lower, k, i), b = vertex_of(grid, kept, lower, k, i + 1);
        const std::uint32_t d = vertex_of(grid, kept, upper, k, i), c = vertex_of(grid, kept, upper, k, i + 1);
        if (grid.rises(layer, tooth, i)) {
          add_triangle(a, b, c, hole);
          add_triangle(a, c, d, hole);
        } else {
          add_triangle(a, b, d, hole);
          add_triangle(b, c, d, hole);
        }
      }
  }

  /// The wall between two rows of the same loop.
  void add_strip(std::size_t count, std::uint32_t lower, std::uint32_t upper, bool hole) {
    auto& triangles = result_.mesh.triangles;
    const auto n = static_cast<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < n; ++i) {
      std::uint32_t a = i, b = i + 1 < n ? i + 1 : 0;
      if (hole) std::swap(a, b);
      triangles.push_back({lower + a, lower + b, upper + b});
      triangles.push_back({lower + a, upper + b, upper + a});
    }
  }

  [[nodiscard]] bool contains(const OutlineLoop& a, const OutlineLoop& b) const {
    return (a.centre - b.centre).norm() + b.outer_radius_mm < a.inner_radius_mm;
  }

  /// Plane faces at an interface: where the slab below has material and that above has none, or the
  /// other way round. Crossing a loop changes that for the slabs it bounds.
  void add_faces(std::size_t level) {
    const Section* below = level > 0 ? &sections_[level - 1] : nullptr;
    const Section* above = level < sections_.size() ? &sections_[level] : nullptr;
    std::vector<int> loops;
    for (int loop = 0; loop < static_cast<int>(loops_.size()); ++loop)
      if ((below && below->has(loop)) || (above && above->has(loop))) loops.push_back(loop);
    // larger loops first, so that a loop's parent is the last one before it that contains it
    std::stable_sort(loops.begin(), loops.end(), [&](int a, int b) {
      return loops_[at(a)].outer_radius_mm > loops_[at(b)].outer_radius_mm;
    });
    std::map<int, int> parent;
    std::map<int, std::pair<bool, bool>> solid;  // below, above: just inside the loop
    for (std::size_t i = 0; i < loops.size(); ++i) {
      parent[loops[i]] = kNone;
      for (std::size_t j = 0; j < i; ++j)
        if (contains(loops_[at(loops[j])], loops_[at(loops[i])])) parent[loops[i]] = loops[j];
      auto status = parent[loops[i]] == kNone ? std::pair(false, false) : solid[parent[loops[i]]];
      if (below && below->has(loops[i])) status.first = !status.first;
      if (above && above->has(loops[i])) status.second = !status.second;
      solid[loops[i]] = status;
    }
    for (int loop : loops) {
      const auto [solid_below, solid_above] = solid[loop];
      if (solid_below == solid_above) continue;
      std::vector<int> boundary{loop};
      for (int other : loops)
        if (parent[other] == loop) boundary.push_back(other);
      add_face(boundary, level, solid_below);
    }
  }

  CapTriangulation cap_of(const std::vector<int>& boundary, std::size_t level) {
    if (std::all_of(boundary.begin(), boundary.end(), [&](int loop) { return is_prism(loop); })) {  // the same at every height
      auto [entry, is_new] = caps_.try_emplace(boundary);
      if (is_new) {
        std::vector<const OutlineLoop*> holes;
        for (std::size_t i = 1; i < boundary.size(); ++i) holes.push_back(&loops_[at(boundary[i])]);
        entry->second = triangulate_cap(loops_[at(boundary[0])], holes);
      }
      return entry->second;
    }
    std::vector<OutlineLoop> loops;
    for (int loop : boundary) loops.push_back(loop_at_height(loop, z_of(level)));
    std::vector<const OutlineLoop*> holes;
    for (std::size_t i = 1; i < loops.size(); ++i) holes.push_back(&loops[i]);
    return triangulate_cap(loops[0], holes);
  }

  void add_face(const std::vector<int>& boundary, std::size_t level, bool up) {
    const CapTriangulation cap = cap_of(boundary, level);
    std::vector<std::uint32_t> vertex;  // of the cap's numbers
    for (int loop : boundary) {
      const std::uint32_t first = row(loop, level);
      for (std::uint32_t i = 0; i < loops_[at(loop)].points.size(); ++i) vertex.push_back(first + i);
    }
    for (const Point2& p : cap.added_points) {
      vertex.push_back(static_cast<std::uint32_t>(result_.mesh.vertices.size()));
      add_vertex(p, z_of(level));
    }
    for (const IndexTriangle& t : cap.triangles) {
      if (up)
        result_.mesh.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
      else
        result_.mesh.triangles.push_back({vertex[t[0]], vertex[t[2]], vertex[t[1]]});
    }
  }

  const PartShape& shape_;
  std::vector<const Outline*> outlines_;
  std::vector<Section> sections_;
  std::vector<OutlineLoop> loops_;
  std::vector<std::optional<ToothingGrid>> grids_;  ///< of toothings that are no prisms
  std::vector<std::optional<BedRows>> beds_;  ///< of outlines without teeth that have a bed chamfer
  std::vector<int> rows_;
  std::map<std::vector<int>, CapTriangulation> caps_;
  PartMesh result_;
};

/// Outlines of a part, also such as are the same in several slabs.
std::vector<const Outline*> outlines_of(const PartShape& shape) {
  std::vector<const Outline*> outlines;
  for (const Slab& slab : shape.slabs) {
    outlines.push_back(&slab.outer);
    for (const Outline& hole : slab.holes) outlines.push_back(&hole);
  }
  return outlines;
}

/// The wall between two outlines; not above 0 where they cross or are the same.
double wall_mm(const OutlineExtent& a, const OutlineExtent& b) {
  const double apart = (a.centre - b.centre).norm();
  return std::max({apart - a.outer_radius_mm - b.outer_radius_mm,
                   a.inner_radius_mm - apart - b.outer_radius_mm,
                   b.inner_radius_mm - apart - a.outer_radius_mm});
}

}  // namespace

double meshing_tolerance_mm(const PartShape& shape, double tolerance_mm) {
  std::vector<OutlineExtent> extents;
  for (const Outline* outline : outlines_of(shape)) {
    if (const auto* toothed = std::get_if<ToothedOutline>(outline))
      tolerance_mm =
          std::min(tolerance_mm, kCoarsestOfModule * toothed->profile->gear().normal_module_mm);
    const OutlineExtent size = extent(*outline);
    for (const OutlineExtent& other : extents)
      if (const double wall = wall_mm(size, other); wall > 0.0)
        tolerance_mm = std::min(tolerance_mm, kCoarsestOfWall * wall);
    extents.push_back(size);
  }
  return tolerance_mm;
}

PartMesh part_mesh(const PartShape& shape, const MeshOptions& options) {
  return StackMesher(shape, options).build();
}

}  // namespace trueflank
