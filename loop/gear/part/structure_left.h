// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/random_error.h"

namespace trueflank::loop {

/// True where the test of structure that is left answers yes, how sure, and what it looks like.
[[nodiscard]] bool structure_is_left(const PartModel& model);
[[nodiscard]] WhatIsLeft what_is_left(const PartModel& model);
[[nodiscard]] double structure_left_p_value(const PartModel& model);
[[nodiscard]] std::string structure_left(const PartModel& model);

}  // namespace trueflank::loop
