// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "trueflank/report/render/raster.h"

// Light from the sky and from one large lamp. What stands in its way is looked up in depth maps,
// one for each direction: shadows are soft, and dark where parts touch.
namespace trueflank::io {

struct SkyOptions {
  int directions = 64;       ///< of the sky
  int lamp_directions = 16;  ///< within the lamp
  int map_samples = 512;     ///< width of a depth map
  ViewDirection lamp = {};
};

/// What reaches a point of a surface; 1 is what an open one facing the light gets.
struct Light {
  double sky = 0.0;  ///< weighted by the angle to the surface
  double lamp = 0.0;
  double open = 0.0;  ///< share of the sky that is seen at all
};

class SkyLight {
 public:
  /// Works on all processors; the same whatever their number. The ball holds all bodies.
  SkyLight(const std::vector<RasterBody>& bodies, const std::optional<Cutaway>& cutaway,
           const ViewedBall& ball, const SkyOptions& options);

  /// At a point of a surface with this normal, of length 1.
  [[nodiscard]] Light at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  /// From the lamp's middle, of length 1: towards it.
  [[nodiscard]] const Eigen::Vector3d& lamp() const { return lamp_; }

 private:
  /// Directions and their depth maps, number by number: what the maps have in common is computed
  /// for all of them at once.
  struct Maps {
    std::size_t count = 0;
    std::array<std::vector<float>, 4> x, y, nearness;  ///< of a point: its shares, and a constant
    std::array<std::vector<float>, 3> towards;
    std::vector<float> brightness;
    float of_level = 0.0F;      ///< the light that a level surface gets
    std::vector<float> depths;  ///< map by map
  };
  void add(Maps& maps, const std::vector<Eigen::Vector3d>& directions,
           const std::vector<RasterBody>& bodies, const std::optional<Cutaway>& cutaway,
           const ViewedBall& ball) const;
  /// Calls `take` with the number of every direction from which the point is seen, and its cosine.
  template <class Take>
  void for_each_seen(const Maps& maps, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                     const Take& take) const;

  int samples_ = 0;
  double step_mm_ = 0.0;  ///< of a map's samples
  Eigen::Vector3d lamp_;
  Maps sky_, lamp_maps_;
};

}  // namespace trueflank::io
