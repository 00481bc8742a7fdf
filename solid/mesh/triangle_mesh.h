// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace trueflank {

/// Indexed triangles [mm]; counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Signed volume by the divergence theorem [mm^3]; positive for a closed, outward mesh.
[[nodiscard]] double volume_mm3(const TriangleMesh& mesh);

}  // namespace trueflank
