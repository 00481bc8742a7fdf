// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/report/render/sky_light.h"

namespace trueflank::io {

/// How bright the ground under the bodies is, all over a picture: 1 where nothing shades it. Looked
/// up at few places and smoothed between them, as soft shadows are.
class GroundShade {
 public:
  /// `step`: samples of a picture of `width` x `height` between two places.
  GroundShade(const SkyLight& sky, const View& view, const ViewedBall& ball, double ground_mm,
              int step, int width, int height);

  /// At a place of the picture, in samples.
  [[nodiscard]] double at(double x, double y) const;

 private:
  int step_, columns_, rows_;
  std::vector<double> shades_;
};

}  // namespace trueflank::io
