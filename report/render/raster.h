// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trueflank/report/render/pictured_mesh.h"
#include "trueflank/report/render/view.h"

// Which surface every sample of a picture sees: a z-buffer, with faces where bodies are cut open.
namespace trueflank::io {

/// A body as it is placed in a picture; nothing is owned.
struct RasterBody {
  const PicturedMesh* mesh = nullptr;
  double cos = 1.0, sin = 0.0;  ///< turned about z, then moved
  Eigen::Vector3d move_mm = Eigen::Vector3d::Zero();
  bool cut = false;          ///< opened by the cutaway
  bool turned_over = false;  ///< by half a turn about x, in its place

  [[nodiscard]] Eigen::Vector3d place(const std::array<double, 3>& p) const {
    const Eigen::Vector3d v(cos * p[0] - sin * p[1] + move_mm.x(),
                            sin * p[0] + cos * p[1] + move_mm.y(), p[2] + move_mm.z());
    return turned_over ? Eigen::Vector3d(v.x(), -v.y(), -v.z()) : v;
  }
  [[nodiscard]] Eigen::Vector3d turn(const Eigen::Vector3d& n) const {
    const Eigen::Vector3d v(cos * n.x() - sin * n.y(), sin * n.x() + cos * n.y(), n.z());
    return turned_over ? Eigen::Vector3d(v.x(), -v.y(), -v.z()) : v;
  }
};

/// What is taken away: the wedge in front of two planes, where normal . p > offset for both.
struct Cutaway {
  std::array<Eigen::Vector3d, 2> normal = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  std::array<double, 2> offset_mm = {0.0, 0.0};
};

/// What a sample sees.
struct Sight {
  float nearness = 0.0F;
  std::uint32_t surface = 0xFFFFFFFFU;
};
inline constexpr Sight kNoSight{-3e38F, 0xFFFFFFFFU};

/// Names of surfaces: a triangle, counted through all bodies, or the face of a cut.
struct SurfaceName {
  static constexpr std::uint32_t kCutFace = 0x80000000U, kSecondPlane = 0x40000000U;

  [[nodiscard]] static std::uint32_t cut_face(std::size_t body, int plane) {
    return kCutFace | (plane > 0 ? kSecondPlane : 0U) | static_cast<std::uint32_t>(body);
  }
  [[nodiscard]] static bool is_cut_face(std::uint32_t surface) { return (surface & kCutFace) != 0; }
  [[nodiscard]] static int plane(std::uint32_t face) { return (face & kSecondPlane) != 0 ? 1 : 0; }
  [[nodiscard]] static std::size_t body(std::uint32_t face) { return face & 0x3FFFFFFFU; }
};

/// Where in its cell a sample stands: shifted row by row and column by column, so that an edge of
/// any direction crosses the samples of a pixel one after the other.
enum class SampleGrid { kPlain, kShifted };
/// Of a sample from its cell's corner, in parts of the cell.
[[nodiscard]] Eigen::Vector2d sample_place(SampleGrid grid, int x, int y);

/// A rectangle of samples, with what they see.
struct SightWindow {
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<Sight> sights;

  [[nodiscard]] const Sight& at(int column, int row) const {
    return sights[static_cast<std::size_t>(row - y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column - x)];
  }
};

/// Bodies projected into one view.
class Raster {
 public:
  /// Requires: closed meshes, all in front of the viewer; less than 2^30 triangles.
  Raster(const std::vector<RasterBody>& bodies, const View& view,
         const std::optional<Cutaway>& cutaway, SampleGrid grid);

  /// Sorts the triangles into square tiles; draw() is of windows in one tile then, with as many
  /// samples around it.
  void sort_into_tiles(int tile, int around, int width, int height);
  /// What the samples of a window see. The same for any window that a sample is in.
  [[nodiscard]] SightWindow draw(int x, int y, int width, int height) const;

  /// The body of a triangle.
  [[nodiscard]] std::size_t body_of(std::uint32_t triangle) const;
  /// Number of a body's first triangle.
  [[nodiscard]] std::uint32_t first_triangle(std::size_t body) const { return first_[body]; }

 private:
  /// In parts of a sample, whole: triangles that share an edge leave no sample between them.
  struct Corner {
    std::int32_t x = 0, y = 0;
    double nearness = 0.0;
  };
  struct Drawing;
  /// Where a line of sight passes the planes of the cut.
  struct Passage {
    double in = 0.0, out = 0.0;  ///< nearness; removed between them
    int plane = 0;               ///< at which it leaves
  };

  /// Nearness at which lines of sight pass a plane of the cut.
  struct CutPlane {
    double x = 0.0, y = 0.0, constant = 0.0;
    bool enters = false;  ///< the wedge lies behind it
  };

  void draw_body(std::size_t body, const std::uint32_t* begin, const std::uint32_t* end,
                 Drawing& drawing) const;
  template <class Put>
  void scan(const std::array<Corner, 3>& corners, const SightWindow& window, const Put& put) const;
  void close_cut(std::size_t body, Drawing& drawing) const;
  [[nodiscard]] Passage passage(int x, int y) const;
  [[nodiscard]] std::array<Corner, 3> corners_of(std::size_t body, std::uint32_t triangle) const;

  std::vector<RasterBody> bodies_;
  SampleGrid grid_;
  bool has_cut_ = false;
  std::array<CutPlane, 2> planes_;
  std::vector<std::vector<Corner>> corners_;  ///< of every body's vertices
  std::vector<std::uint32_t> first_;          ///< triangle of each body, and the end
  std::vector<std::uint32_t> every_triangle_;
  int tile_ = 0, around_ = 0, columns_ = 0;
  std::vector<std::vector<std::uint32_t>> tiles_;
};

}  // namespace trueflank::io
