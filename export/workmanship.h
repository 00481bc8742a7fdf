// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/train/gear_train.h"

// What the making of a part holds, as its drawing says it: general tolerances, the class of its
// teeth, surfaces (docs/drawings.md, "What is asked").
namespace trueflank::io {

/// Flank tolerance class of ISO 1328-1 that is asked for where parts are machined and the design
/// says none.
inline constexpr int kDrawingToleranceClass = 7;

/// Deviations from a nominal size; NaN: none are known for a size like this.
struct SizeLimits {
  double lower_mm = kNaN, upper_mm = kNaN;
  std::string fit = {};  ///< "H7"; may be empty
  bool stated = false;   ///< beside the size; else it is the general tolerance
};
/// ISO 2768-1 class m.
[[nodiscard]] SizeLimits general_limits(double size_mm);

/// Machined: material is removed and ISO 2768 holds. Cut: an outline in sheet, by wire or beam.
/// Formed: moulded or sintered, general tolerances are agreed with the maker.
enum class Making { kMachined, kCut, kPrinted, kFormed };

struct Workmanship {
  Making making = Making::kMachined;
  std::string process;  ///< its name; empty: the design says none
  int flank_class =
      kDrawingToleranceClass;  ///< ISO 1328-1; 0: the teeth have what is below instead
  double thickness_mm = kNaN;  ///< +-, of a size between two walls, a tooth on its reference circle
  double axis_mm = kNaN;       ///< +-, of the distance of two axes
  double runout_mm = kNaN;     ///< of teeth without a class
  double layer_mm = 0.0;       ///< of prints
};

/// The design's own tolerances ([made]) before those of its process. A class that neither gives is
/// kDrawingToleranceClass for machined parts; others have none.
[[nodiscard]] Workmanship workmanship(const GearTrain& train);

/// Along a part's axis a print has whole layers.
enum class SizeDirection { kAcross, kAlong };
/// General tolerance of a size: ISO 2768-1 m; of a print its process's tolerance of a size between
/// two walls and kPrintedShare of the size across the axis, a layer along it; NaN for formed parts.
[[nodiscard]] SizeLimits general_limits(const Workmanship& made, double size_mm,
                                        SizeDirection direction);
/// Shrinkage that is left: what services for printed plastics state for sizes (0.002 of them,
/// Xometry).
inline constexpr double kPrintedShare = 0.002;

/// For the title block: "ISO 2768-mK", "±(0.04 + 0.2 %), height ±0.2".
[[nodiscard]] std::string general_tolerance_text(const Workmanship& made);

/// The coarsest of the preferred roughnesses Ra (a factor of two apart, 0.1 to
/// kGeneralRoughness_um) whose texture is no higher than a tolerance: Rz is about six times Ra.
[[nodiscard]] double roughness_um(double tolerance_um);
inline constexpr double kGeneralRoughness_um = 3.2;
/// Seats of a class of ISO 286: 1.6 um of grade 7 and coarser, 0.8 um of finer ones (SKF, roughness
/// of bearing seats: N7 and N6).
[[nodiscard]] double seat_roughness_um(const std::string& fit);
/// Of flanks with a class, by their profile form f_falphaT; NaN: they stay as the process leaves
/// them, or are outside the scope of ISO 1328-1.
[[nodiscard]] double flank_roughness_um(const TrainGear& gear, const Workmanship& made);
/// Of surfaces that have no roughness of their own, as drawings write it: "Ra 3.2", "as printed";
/// empty: nothing.
[[nodiscard]] std::string general_surface_text(const Workmanship& made);
/// The same of flanks, without "Ra": "1.6", "as printed".
[[nodiscard]] std::string flank_surface_text(const TrainGear& gear, const Workmanship& made);

}  // namespace trueflank::io
