// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/scene.h"
#include "trueflank/solid/mesh/enclosed_volume.h"

namespace trueflank::io {

constexpr double kFloatStep = 1.2e-7;  ///< from one float to the next, of the coordinate itself
constexpr double kTextStep_mm = 1e-6;  ///< append_decimal's

/// Compares the facets of a written file, one after the other as the file has them, with those of the
/// scene it was written of. Facets that collapsed in rounding may be missing from the file.
class FacetComparison {
 public:
  /// The scene must outlive the comparison.
  explicit FacetComparison(const Scene& scene) : scene_(scene) {}

  /// The file's next facet.
  void take(const Facet& facet);

  /// Farthest that a corner moved on its way through the file [mm]; nothing where the file holds other
  /// facets than the scene.
  [[nodiscard]] std::optional<double> rounding_mm();

  /// Facets taken, and the volume they enclose [mm^3], to 1e-12 of the box around them.
  [[nodiscard]] std::size_t facets() const { return facets_; }
  [[nodiscard]] double volume_mm3() const { return volume_.mm3(); }

 private:
  using Point = std::array<double, 3>;

  /// The scene's next facet; nullptr after the last.
  const std::array<std::uint32_t, 3>* expected() { return next_ != end_ ? next_ : next_body(); }
  const std::array<std::uint32_t, 3>* next_body();
  [[nodiscard]] bool may_be_missing(const std::array<std::uint32_t, 3>& triangle) const;
  [[nodiscard]] double largest_step_mm(const std::array<std::uint32_t, 3>& triangle) const;

  const Scene& scene_;
  std::size_t body_ = 0;               ///< of the scene, begun after the one compared now
  const TriangleMesh* mesh_ = nullptr;  ///< of the body compared now, and those of its facets that are left
  const std::array<std::uint32_t, 3>*next_ = nullptr, *end_ = nullptr;
  std::vector<Point> placed_;  ///< its vertices where it stands
  double farthest_mm_ = 0.0;
  bool differs_ = false;
  std::size_t facets_ = 0;
  EnclosedVolume volume_;
};

}  // namespace trueflank::io
