// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/geometry/curve.h"
#include "trueflank/geometry/gear.h"

namespace trueflank {

/// What the protuberance of a rack leaves below the finished flank of an external gear.
struct ProtuberanceCut {
  Curve fillet;               ///< trochoid of the tip corner, down to the root circle
  std::optional<Curve> side;  ///< involute of the protuberance's straight side; where it is needed
  double root_form_radius_mm = 0.0;  ///< where the finished flank ends
};

/// `corner`: the tip corner, moved out by the protuberance. `tip_radius_mm`: where the tooth ends.
/// Requires: residual_protuberance() > 0 and a protuberance angle below the pressure angle.
/// Nothing where no involute is left below the tip.
/// Accuracy: 1e-9 mm against numerical generation, tested in tests/geometry/protuberance_test.cpp.
/// Source: derivation docs/theory/tooth-profile.md.
[[nodiscard]] std::optional<ProtuberanceCut> cut_protuberance(const Gear& gear,
                                                              const RackTrochoid& corner,
                                                              double tip_radius_mm);

}  // namespace trueflank
