// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/geometry/gear.h"

namespace trueflank {

/// Base tangent length W_k over k teeth of an external gear [mm], thinning included; NaN for rings.
/// Source: ISO 21771 relations as in docs/theory/tooth-profile.md.
[[nodiscard]] double base_tangent_length_mm(const Gear& gear, int teeth_spanned);
/// Number of teeth to span so that the measuring planes touch near half tooth height; at least 1.
[[nodiscard]] int recommended_span_teeth(const Gear& gear);

/// Face width that a base tangent over k teeth needs, W_k sin(beta_b): on less the measuring planes
/// find no two flanks (DIN 3960: a little more, for the planes to rest on). 0 for spur, NaN for rings.
[[nodiscard]] double span_face_width_mm(const Gear& gear, int teeth_spanned);

/// Distance over (ring: between) two pins or balls of a diameter [mm], thinning included; NaN where
/// the pin touches no involute.
[[nodiscard]] double over_pins_mm(const Gear& gear, double pin_diameter_mm);
/// A pin diameter that touches near the middle of the flank, rounded to 0.05 module (0.001 mm below
/// module 0.1).
[[nodiscard]] double recommended_pin_diameter_mm(const Gear& gear);

}  // namespace trueflank
