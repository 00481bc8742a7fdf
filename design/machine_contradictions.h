// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/design/reading.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Reports what does not agree in the tables of a gearbox: [housing], [motor], [bearings] and the
/// gears' own. Requires: the design has a machine.
void report_machine_contradictions(const GearboxDesign& design, bool kind_known, Reading& reading);

}  // namespace trueflank
