// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/loop/drive/close_drive_loop.h"

// Of a bench's page: every measured point against the model, and what follows from it.
namespace trueflank::loop {

/// Cells of one axis: the distinct set points where these are few, equal parts of the range else.
class CellAxis {
 public:
  explicit CellAxis(std::vector<double> values);
  [[nodiscard]] int cell(double value) const;
  [[nodiscard]] int count() const { return static_cast<int>(centres.size()); }

  std::vector<double> centres;
};

/// Torque of the model over the measured one, before and after, a chart a direction.
[[nodiscard]] std::string torque_charts(const DriveLoop& closed);
/// Residual before and after over load, speed, and temperature and angle where these were measured,
/// with the mean of every set point.
[[nodiscard]] std::string residual_charts(const DriveLoop& closed);
/// A sentence for each quantity that what is left still follows: the mean of a cell is more than
/// six standard errors from zero (twelve of a log that drifts), and the means carry more than a
/// tenth of what is left.
[[nodiscard]] std::vector<std::string> residual_trends(const DriveLoop& closed);

}  // namespace trueflank::loop
