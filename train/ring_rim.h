// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace trueflank {

/// Rim outside the root circle of a ring whose design gives no outer diameter: 2.5 modules, 2 mm at least.
[[nodiscard]] inline double usual_rim_mm(double module_mm) { return std::max(2.5 * module_mm, 2.0); }

}  // namespace trueflank
