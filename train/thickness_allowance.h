// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/base/result.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Series of DIN 3967:1978 as people write them, "cd25" or "25cd": upper allowance of table 1 by its
/// letters (a, ab, b, bc, c, cd, d, e, f, g, h), tolerance of table 2 by its number (21 to 30).
/// Lower allowance = upper allowance - tolerance. Series stays as it was.
/// Errors: kOutOfRange, without a key: no such series; a reference diameter above 10 m.
/// Source: two independent public transcriptions of the standard's tables that agree in every value,
/// and its own example 27cd at 100 mm: -70, -170 um (docs/decisions/0110).
[[nodiscard]] Result<ThicknessAllowance> din3967_allowance(const std::string& series,
                                                           double reference_diameter_mm);

}  // namespace trueflank
