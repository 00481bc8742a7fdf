// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/export/scene.h"
#include "trueflank/report/render/image.h"
#include "trueflank/report/render/raster.h"

// Pictures of bodies without a graphics card: smooth edges, soft shadows, cut faces hatched.
namespace trueflank::io {

/// What a surface is made of, to the eye.
struct Finish {
  Colour colour;
  double shine = 0.25;       ///< of the lamp's highlight
  bool metal = false;        ///< mirrors the sky in its own colour
  double hatch_rad = 0.785;  ///< angle of the lines on its cut faces; NaN: none
};

struct RenderedBody {
  RasterBody body;
  Finish finish;
  const PicturedMesh* shadow =
      nullptr;  ///< a coarser mesh that throws the shadow; nullptr: the same
};

struct RenderOptions {
  int width_px = 1200, height_px = 900;
  ViewDirection from = {.azimuth_rad = -0.6, .elevation_rad = 0.55};
  std::optional<Cutaway> cutaway = {};
  /// Points that the picture has room for; empty: the bodies. A row of pictures with the same
  /// points and bodies about the same centre shows them in the same place.
  std::vector<Eigen::Vector3d> framed = {};
  bool quick = false;  ///< fewer directions of light: for small pictures
};

/// The bodies on a light ground. Works on all processors; the same bytes whatever their number.
/// Requires: one body at least, closed meshes.
[[nodiscard]] Image rendered(const std::vector<RenderedBody>& bodies, const RenderOptions& options);

}  // namespace trueflank::io
