// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/export/workmanship.h"

// Sizes of a gearbox in which, or on which, something sits: bearings, shafts, pins.
namespace trueflank::io {

struct FittedSize {
  double made_mm = 0.0;   ///< in the shapes: with the clearance of the design
  double drawn_mm = 0.0;  ///< nominal size of a drawing
  bool hole = true;
  std::string grade;  ///< class of ISO 286: "H7", "g6"
};

/// Seats of a housing's bearings, motor and pins with their journals; seats, pins and their holes
/// of a carrier.
class FittedSizes {
 public:
  explicit FittedSizes(const GearTrain& train);

  /// Of a circle with this diameter; nullptr: nothing sits there.
  [[nodiscard]] const FittedSize* find(double diameter_mm, bool hole) const;
  /// Limits of a seat: its class where parts are not printed, else what the process holds between
  /// two walls.
  [[nodiscard]] SizeLimits limits(const std::string& grade, double size_mm) const;
  [[nodiscard]] SizeLimits limits(const FittedSize& size) const {
    return limits(size.grade, size.drawn_mm);
  }
  [[nodiscard]] const Workmanship& made() const { return made_; }

 private:
  void add_machine(const GearTrain& train);
  void add_carrier(const GearTrain& train);

  Workmanship made_;
  std::vector<FittedSize> sizes_;
};

}  // namespace trueflank::io
