// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part is a stack of slabs. Its walls are rows of loop points; its plane faces lie where the sections
// below and above an interface differ, and their boundaries are rows of the same points.
#include "trueflank/solid/gear_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/cap_triangulation.h"

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
    const double tolerance = std::min(options.tolerance_mm, coarsest_mm());
    for (const Outline* outline : outlines_) {
      loops_.push_back(outline_loop(*outline, tolerance));
      result_.chord_error_mm = std::max(result_.chord_error_mm, loops_.back().chord_error_mm);
    }
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

  [[nodiscard]] double coarsest_mm() const {
    double coarsest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
      const OutlineExtent a = extent(*outlines_[i]);
      if (const auto* toothed = std::get_if<ToothedOutline>(outlines_[i]))
        coarsest = std::min(
            coarsest, kCoarsestOfModule * toothed->profile->gear().normal_module_mm);
      for (std::size_t j = i + 1; j < outlines_.size(); ++j) {
        const OutlineExtent b = extent(*outlines_[j]);
        const double apart = (a.centre - b.centre).norm();
        const double wall = std::max({apart - a.outer_radius_mm - b.outer_radius_mm,
                                      a.inner_radius_mm - apart - b.outer_radius_mm,
                                      b.inner_radius_mm - apart - a.outer_radius_mm});
        if (wall > 0.0) coarsest = std::min(coarsest, kCoarsestOfWall * wall);
      }
    }
    return coarsest;
  }

  [[nodiscard]] double z_of(std::size_t level) const {
    return level == 0 ? shape_.slabs.front().z_lower_mm : shape_.slabs[level - 1].z_upper_mm;
  }

  /// First vertex of a loop's points at an interface; made when first asked for.
  std::uint32_t row(int loop, std::size_t level) {
    int& first = rows_[at(loop) * (sections_.size() + 1) + level];
    if (first == kNone) {
      first = static_cast<int>(result_.mesh.vertices.size());
      for (const Point2& p : loops_[at(loop)].points) add_vertex(p, z_of(level));
    }
    return static_cast<std::uint32_t>(first);
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
      add_strip(loops_[at(loop)].points.size(), row(loop, begin), row(loop, s), hole);
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

  void add_face(const std::vector<int>& boundary, std::size_t level, bool up) {
    auto [entry, is_new] = caps_.try_emplace(boundary);
    if (is_new) {
      std::vector<const OutlineLoop*> holes;
      for (std::size_t i = 1; i < boundary.size(); ++i) holes.push_back(&loops_[at(boundary[i])]);
      entry->second = triangulate_cap(loops_[at(boundary[0])], holes);
    }
    const CapTriangulation& cap = entry->second;
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
  std::vector<int> rows_;
  std::map<std::vector<int>, CapTriangulation> caps_;
  PartMesh result_;
};

}  // namespace

PartMesh part_mesh(const PartShape& shape, const MeshOptions& options) {
  return StackMesher(shape, options).build();
}

}  // namespace trueflank
