// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/loop/gear/close_loop.h"

namespace trueflank::loop {

/// One offline page: the verdict in words and the classical charts before and after (profile and helix
/// traces of all teeth, pitch, topography, spectrum over tooth order), with the ISO 1328-1 figures.
[[nodiscard]] std::string loop_html(const GearLoop& closed);

}  // namespace trueflank::loop
