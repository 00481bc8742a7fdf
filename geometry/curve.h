// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <variant>

#include "trueflank/geometry/point2.h"

// The analytic curves a transverse section is made of. Each is a value with its own natural
// parameter; Curve adds the interval. Frame: gear axis at the origin, x towards tooth 1.
namespace trueflank {

/// Circle; parameter = angle at its centre [rad].
struct CircularArc {
  Point2 centre = Point2::Zero();
  double radius_mm = 1.0;
};

/// Straight line start + t * direction; parameter = length [mm] for a unit direction.
struct StraightLine {
  Point2 start = Point2::Zero();
  Point2 direction = Point2::UnitX();
};

/// Involute of the base circle on the counter-clockwise side of a tooth; parameter = roll angle
/// xi >= 0 (roll length / base radius). With tau = base_half_angle + sense * xi the point is
/// r_b e(tau) - sense r_b xi e(tau + pi/2). sense = -1 external (narrows outwards), +1 ring.
struct Involute {
  double base_radius_mm = 1.0;
  double base_half_angle_rad = 0.0;
  int sense = -1;
};

/// Root fillet of an external gear: envelope of the rounded tip corner of the generating rack, on
/// the counter-clockwise side of tooth 1. Parameter = angle t of the corner arc's normal in the
/// rack's normal section, from the rack's pressure angle (joint with its flank) to pi/2 (tip line).
/// Source: the contact normal passes through the pitch point; docs/theory/tooth-profile.md.
struct RackTrochoid {
  double pitch_radius_mm = 1.0;    ///< generating pitch radius = reference radius
  double corner_depth_mm = 0.0;    ///< centre of the corner arc below the pitch line (may be < 0)
  double corner_offset_mm = 0.0;   ///< transverse distance of that centre from the rack tooth's middle
  double corner_radius_mm = 0.0;   ///< in the normal section; 0: sharp
  double stretch = 1.0;            ///< 1 / cos(helix angle): normal to transverse along the pitch line
  double gap_angle_rad = 0.0;      ///< angle of the gap's middle, pi / z
};

/// Which of the two contacts a corner arc has with a given normal direction.
enum class CutterContact { kFillet, kTrimming };

/// Envelope of the rounded tip corner of a pinion cutter in the ring it shapes, on the
/// counter-clockwise side of tooth 1. Parameter = angle eta of the corner arc's normal from the
/// middle of the cutter's tooth: from the corner centre's own angle (tip circle) to the flank normal.
struct CutterTrochoid {
  double centre_distance_mm = 1.0;
  double cutter_pitch_radius_mm = 1.0;
  double corner_centre_radius_mm = 1.0;  ///< of the corner arc's centre, from the cutter's axis
  double corner_centre_angle_rad = 0.0;  ///< of that centre, from the middle of the cutter's tooth
  double corner_radius_mm = 0.0;
  double ratio = 0.0;                    ///< cutter teeth / ring teeth
  double gap_angle_rad = 0.0;
  CutterContact contact = CutterContact::kFillet;
};

/// A curve given by its points alone: a deviated flank. Smooth over its interval, and asked for a
/// little beyond either end.
struct PointCurve {
  std::shared_ptr<const std::function<Point2(double)>> point;
};

/// One smooth piece: a curve over a parameter interval, run from begin to end.
struct Curve {
  std::variant<CircularArc, StraightLine, Involute, RackTrochoid, CutterTrochoid, PointCurve>
      shape;
  double begin = 0.0;
  double end = 1.0;

  [[nodiscard]] Point2 start_point() const;
  [[nodiscard]] Point2 end_point() const;
};

/// Accuracy: a few ulp of the coordinates, tested against numerical generation to 1e-9 mm.
[[nodiscard]] Point2 point_at(const Curve& curve, double parameter);

/// Unit tangent in the direction of travel from begin to end.
[[nodiscard]] Point2 tangent_at(const Curve& curve, double parameter);

/// Largest distance between the piece of the curve between two parameters and its chord.
/// Accuracy: relative 1e-6 for the short, slowly turning spans of a tessellation (turning < 1 rad).
[[nodiscard]] double chord_error_mm(const Curve& curve, double from, double to);

}  // namespace trueflank
