// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/loop/drive/close_drive_loop.h"

namespace trueflank::loop {

/// One offline page: the verdict in words, efficiency maps over load and speed (measured, model before,
/// model after, residual) of both directions, and the residual over load, speed, temperature and angle.
[[nodiscard]] std::string drive_html(const DriveLoop& closed);

}  // namespace trueflank::loop
