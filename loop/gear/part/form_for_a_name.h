// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

// Names of straight and bowed courses that a form with a place follows far better.
namespace trueflank::loop {

/// Ends rounded by a brush are a crowning, plating that grows at an edge is a pressure angle error,
/// as near as one value tells. Where one form along the same direction leaves clearly less than
/// such a name, it is told in its place. True where one was.
bool tell_as_form_for_a_name(PartModel& model);

}  // namespace trueflank::loop
