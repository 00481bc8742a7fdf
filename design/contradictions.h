// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/design/reading.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// Reports values of a design file that contradict each other. Only keys that are right of
/// themselves are compared, so that one slip is reported once. `kind_known`: design.kind is the file's.
void report_contradictions(const GearboxDesign& design, bool kind_known, Reading& reading);

}  // namespace trueflank
