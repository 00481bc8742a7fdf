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
    row_sizes_.assign(rows_.size(), 0);
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
    result.points_per_tooth = static_cast<int>(result.points.size()) / grid.teeth();
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

  [[nodiscard]] std::size_t row_index(int loop, std::size_t level) const {
    return at(loop) * (sections_.size() + 1) + level;
  }
  /// First vertex of a loop's points at an interface; made when first asked for.
  std::uint32_t row(int loop, std::size_t level) {
    int& first = rows_[row_index(loop, level)];
    if (first == kNone) {
      first = static_cast<int>(result_.mesh.vertices.size());
      if (grids_[at(loop)])
        add_row(*grids_[at(loop)], height_in_gear(loop, z_of(level)));
      else
        add_row(beds_[at(loop)] ? bed_row(loop, z_of(level)) : loops_[at(loop)].points, z_of(level));
      row_sizes_[row_index(loop, level)] =
          static_cast<std::uint32_t>(result_.mesh.vertices.size()) - static_cast<std::uint32_t>(first);
    }
    return static_cast<std::uint32_t>(first);
  }
  std::uint32_t add_row(const ToothingGrid& grid, double z_mm) {
    return add_vertices(grid.row(z_mm));
  }
  std::uint32_t add_vertices(const std::vector<std::array<double, 3>>& points) {
    auto& vertices = result_.mesh.vertices;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), points.begin(), points.end());
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

  /// The wall of a toothing that is no prism, from one interface to another.
  void add_grid(int loop, std::size_t first_level, std::size_t last_level, bool hole) {
    const ToothingGrid& grid = *grids_[at(loop)];
    const auto& heights = grid.heights_mm();
    std::size_t level = first_level;
    const auto row_at = [&](std::size_t j) {
      // interfaces are rows of the grid: their vertices are those of the faces
      if (std::abs(heights[j] - height_in_gear(loop, z_of(level))) < 1e-9) return row(loop, level++);
      return add_row(grid, heights[j]);
    };
    std::size_t j = 0;
    while (heights[j] - height_in_gear(loop, z_of(first_level)) < -1e-9) ++j;
    std::uint32_t lower = row_at(j);
    while (level <= last_level) {
      const std::uint32_t upper = row_at(j + 1);
      if (grid.patches().empty())
        add_layer(grid, j, lower, upper, hole);
      else
        add_patch(grid, j, lower, upper, hole);
      lower = upper;
      ++j;
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool hole) {
    if (hole) std::swap(b, c);
    result_.mesh.triangles.push_back({a, b, c});
  }

  /// The net between two rows.
  void add_patch(const ToothingGrid& grid, std::size_t layer, std::uint32_t lower, std::uint32_t upper,
                 bool hole) {
    const NetPatch& patch = grid.patches()[layer];
    const std::uint32_t inner = add_vertices(grid.inner_points(layer));
    const auto n = static_cast<std::uint32_t>(grid.points_per_tooth());
    const auto teeth = static_cast<std::uint32_t>(grid.teeth());
    const ToothingGrid::RowPlaces at_lower = grid.row_places(layer),
                                  at_upper = grid.row_places(layer + 1);
    const auto on_row = [](const ToothingGrid::RowPlaces& row, std::uint32_t k, std::uint32_t column) {
      return k * static_cast<std::uint32_t>(row.count) + static_cast<std::uint32_t>(row.place[column]);
    };
    std::vector<std::uint32_t> before{0};  // inner vertices of a tooth before each column's
    for (const auto& column : patch.inner)
      before.push_back(before.back() + static_cast<std::uint32_t>(column.size()));
    for (std::uint32_t tooth = 0; tooth < teeth; ++tooth) {
      const auto vertex = [&](const NetNode& node) {
        const std::uint32_t column = static_cast<std::uint32_t>(node.column) % n;
        const std::uint32_t k = (tooth + static_cast<std::uint32_t>(node.column) / n) % teeth;
        const auto row = static_cast<std::uint32_t>(node.row);
        if (row == 0) return lower + on_row(at_lower, k, column);
        if (row > patch.inner[column].size()) return upper + on_row(at_upper, k, column);
        return inner + k * before.back() + before[column] + row - 1;
      };
      for (const auto& [a, b, c] : patch.facets) add_triangle(vertex(a), vertex(b), vertex(c), hole);
    }
  }

  /// The quadrilaterals between two rows.
  void add_layer(const ToothingGrid& grid, std::size_t layer, std::uint32_t lower, std::uint32_t upper,
                 bool hole) {
    const auto n = static_cast<std::uint32_t>(grid.points_per_tooth());
    const auto count = n * static_cast<std::uint32_t>(grid.teeth());
    for (std::uint32_t v = 0; v < count; ++v) {
      const std::uint32_t next = v + 1 < count ? v + 1 : 0;
      const std::uint32_t a = lower + v, b = lower + next, c = upper + next, d = upper + v;
      if (grid.rises(layer, static_cast<int>(v / n), static_cast<int>(v % n))) {
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
      for (std::uint32_t i = 0; i < row_sizes_[row_index(loop, level)]; ++i) vertex.push_back(first + i);
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
  std::vector<std::uint32_t> row_sizes_;  ///< vertices; toothings may have more on one face than on another
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
