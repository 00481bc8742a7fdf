// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/train/machine/machine_design.h"

// How the seats of a gearbox are sized: by classes of ISO 286, or by one clearance.
namespace trueflank {

/// Classes of a gearbox whose fit_mm is 0: of holes for bearings, shaft, collar and ring, and of
/// journals in bearings.
inline constexpr const char *kSeatClass = "H7", *kJournalClass = "g6";

/// A hole and what goes into it.
struct SeatFit {
  std::string hole, shaft;    ///< classes; empty: none, by the clearance
  double clearance_mm = 0.1;  ///< diametral

  /// As they are made, for a nominal size: to the middle of the limits of the class; above
  /// kLargestFit_mm to size.
  [[nodiscard]] double hole_mm(double size_mm) const;
  [[nodiscard]] double shaft_mm(double size_mm) const;
};

struct SeatFits {
  SeatFit output, planet, wheel;  ///< bearings: the seat of the outer ring, the journal in the bore
  SeatFit shaft, pilot;           ///< of the motor
  SeatFit ring;  ///< in housing and lid; without a class of its own the ring has its nominal size
  SeatFit rim;   ///< of a pair: of the lid, in the housing
  SeatFit pin;   ///< the planets' pins in the plates; no class of a hole: pin_hole_clearance_mm
};
[[nodiscard]] SeatFits seat_fits(const MachineDesign& machine);

/// How much larger, on the radius, a part is than the place that it is pressed into, at most.
/// `ring_mm` is the diameter of the fixed ring, or of the lid's rim.
[[nodiscard]] double press_mm(const MachineDesign& machine, double ring_mm);

}  // namespace trueflank
