// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "trueflank/loop/measured/measurement.h"

namespace trueflank::loop {

/// By how much the zeros of traces scatter [um] that one flank has at several heights (profiles) or
/// diameters (helices): a machine may set a zero for every trace, or one for the topography of a
/// flank. Nothing where they share one, or where the data do not tell.
///
/// What the middles of the traces have beside the mean of their flank, the mean of all flanks of
/// their side at that place, and a slope from place to place of either flank is left by zeros
/// alone: forms of the gear go on from tooth to tooth or are local. It is own zeros where it is
/// more than the noise of the middles, about as large as the middles themselves scatter, and as
/// rough from tooth to tooth as by chance. Two places a flank have no slope: there waves of low
/// orders are taken out instead. Accuracy: not below 6 flanks, of two places 30; zeros smaller than
/// forms that differ from flank to flank are not told.
[[nodiscard]] std::optional<double> zeros_at_places_um(const InspectionData& data, RecordKind kind);

}  // namespace trueflank::loop
