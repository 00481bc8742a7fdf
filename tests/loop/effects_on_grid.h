// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "tests/loop/hidden_process.h"
#include "trueflank/loop/gear/effect.h"

// What effects do to the flanks of a whole gear.
namespace trueflank::test {

inline loop::Place place_on(const loop::FlankGeometry& geometry, const FlankSpot& s) {
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  return geometry.on_flank(s.tooth, s.side, low + 0.5 * (s.u + 1.0) * (high - low),
                           0.5 * (s.v + 1.0) * geometry.face_width_mm());
}

/// Columns of an effect on a grid over all flanks, or over those of the first teeth: so many places
/// over the profile, and over the face.
inline Eigen::MatrixXd on_grid(const loop::FlankGeometry& geometry, const loop::Effect& effect,
                               int places = 7, int first_teeth = 1000) {
  const int teeth = std::min(first_teeth, geometry.teeth());
  Eigen::MatrixXd values(2 * teeth * places * places, effect.columns());
  std::vector<double> columns(static_cast<std::size_t>(effect.columns()));
  const auto share = [&](int i) { return 0.96 * (2.0 * i / (places - 1.0) - 1.0); };
  Eigen::Index row = 0;
  for (int tooth = 1; tooth <= teeth; ++tooth)
    for (const int side : {1, -1})
      for (int i = 0; i < places; ++i)
        for (int k = 0; k < places; ++k, ++row) {
          effect.evaluate(geometry, place_on(geometry, {tooth, side, share(i), share(k)}),
                          columns.data());
          for (int c = 0; c < effect.columns(); ++c)
            values(row, c) = columns[static_cast<std::size_t>(c)];
        }
  return values;
}

}  // namespace trueflank::test
