// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/solid/brep/outline_path.h"

namespace trueflank {

/// Whether a section is that of the profile, as drawn: it may turn along the face, nothing else.
[[nodiscard]] bool is_plain(const Toothing& toothing);

/// The section at mid face of a toothing that is not plain: its flanks and fillets as splines, lands
/// as arcs unless they are displaced. A displacement along the axis is left out.
[[nodiscard]] OutlinePath toothing_path(const ToothedOutline& outline,
                                        const PathTolerance& tolerance);

}  // namespace trueflank
