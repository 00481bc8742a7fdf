// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tolerances that several folders share: named, dimensioned, justified.
namespace trueflank::tolerance {

/// Agreement asked of curve points with an independent derivation; doubles at 100 mm carry 1e-14.
inline constexpr double kCurve_mm = 1e-9;
/// Shorter than this a piece of a profile is left out: far below any use, far above rounding.
inline constexpr double kShortestPiece_mm = 1e-7;
/// Flanks at zero backlash touch; less penetration than this is rounding (1 nm).
inline constexpr double kTouch_mm = 1e-6;
/// Angles of positions and phases that are equal by integer arithmetic up to rounding.
inline constexpr double kAngle_rad = 1e-10;
/// Two ways of giving one centre distance agree when closer than this (0.01 um).
inline constexpr double kCentreDistance_mm = 1e-5;
/// Sizes of one part that are equal but for rounding (1 nm).
inline constexpr double kSameSize_mm = 1e-6;

}  // namespace trueflank::tolerance
