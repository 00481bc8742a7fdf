// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "trueflank/solid/mesh/triangle_mesh.h"
#include "trueflank/solid/shape/part_shape.h"

// What one mesh file shows: shapes, and bodies that are placed copies of them.
namespace trueflank::io {

/// sRGB.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// Colour of a part: every file and drawing shows it in the same one.
[[nodiscard]] Colour part_colour(PartRole role);
/// "#rrggbb"
[[nodiscard]] std::string hex_text(Colour colour);

struct SceneShape {
  std::string name;
  const TriangleMesh* mesh = nullptr;  ///< not owned
  Colour colour;
};

struct Scene {
  std::string name;                ///< the design's; may be empty
  std::vector<SceneShape> shapes;
  std::vector<Placement> bodies;   ///< Placement::part: index into shapes
  bool loose = false;              ///< bodies that have nothing to do with each other: no assembly
};

/// A part alone in its own frame.
[[nodiscard]] Scene part_scene(std::string design_name, const std::string& part_name,
                               const TriangleMesh& mesh, PartRole role = PartRole::kOther);

/// Turns and moves points of a part to their place in the assembly.
class PlacementTransform {
 public:
  explicit PlacementTransform(const Placement& placement);
  [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& p) const {
    return {cos_ * p[0] - sin_ * p[1] + move_[0], sin_ * p[0] + cos_ * p[1] + move_[1],
            p[2] + move_[2]};
  }
  [[nodiscard]] double cos() const { return cos_; }
  [[nodiscard]] double sin() const { return sin_; }
  [[nodiscard]] bool is_identity() const {
    return cos_ == 1.0 && sin_ == 0.0 && move_ == std::array<double, 3>{};
  }

 private:
  double cos_, sin_;
  std::array<double, 3> move_;
};

/// The body's mesh where the body stands.
[[nodiscard]] TriangleMesh placed_mesh(const TriangleMesh& mesh, const Placement& placement);

/// Triangles and vertices over all bodies.
[[nodiscard]] std::uint64_t triangle_count(const Scene& scene);
[[nodiscard]] std::uint64_t vertex_count(const Scene& scene);

}  // namespace trueflank::io
