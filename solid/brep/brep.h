// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/solid/brep/outline_path.h"
#include "trueflank/solid/shape/part_shape.h"

// A solid as CAD systems know it: exact faces, shared edges, shared vertices.
namespace trueflank {

using Point3 = Eigen::Vector3d;

/// Origin, z axis and x axis of a curve or surface; unit vectors at right angles.
struct Frame3 {
  Point3 origin = Point3::Zero();
  Point3 axis = Point3::UnitZ();
  Point3 reference = Point3::UnitX();
};

/// @name Curves
/// @{
struct LineCurve {
  Point3 origin = Point3::Zero();
  Point3 direction = Point3::UnitZ();  ///< unit
};
/// Counter-clockwise about the axis.
struct CircleCurve {
  Frame3 frame;
  double radius_mm = 1.0;
};
struct SplineCurve {
  int degree = 1;
  std::vector<Point3> poles;
  std::vector<double> knots;
  std::vector<int> multiplicities;
};
using BrepCurve = std::variant<LineCurve, CircleCurve, SplineCurve>;
/// @}

/// @name Surfaces
/// @{
struct PlaneSurface {
  Frame3 frame;  ///< normal = axis
};
/// Normal away from the axis.
struct CylinderSurface {
  Frame3 frame;
  double radius_mm = 1.0;
};
/// A curve moved along a direction; normal = curve's tangent x direction.
struct ExtrusionSurface {
  int curve = 0;  ///< index into Brep::curves
  Point3 direction = Point3::UnitZ();
};
/// poles[i * count_v + j]; normal = d/du x d/dv.
struct SplineSurface {
  int degree_u = 1, degree_v = 1;
  int count_v = 2;
  std::vector<Point3> poles;
  std::vector<double> knots_u, knots_v;
  std::vector<int> multiplicities_u, multiplicities_v;
};
using BrepSurface = std::variant<PlaneSurface, CylinderSurface, ExtrusionSurface, SplineSurface>;
/// @}

/// Runs from start to end along its curve's own direction; a closed edge has start = end.
struct BrepEdge {
  int start = 0, end = 0;  ///< indices into Brep::vertices
  int curve = 0;           ///< index into Brep::curves
};
struct OrientedEdge {
  int edge = 0;
  bool forward = true;
};
using BrepLoop = std::vector<OrientedEdge>;

/// Loops run counter-clockwise about the face's outward normal (holes clockwise); the outer one is
/// first. A cylinder closed on itself has one loop that uses its seam twice.
struct BrepFace {
  int surface = 0;        ///< index into Brep::surfaces
  bool same_sense = true;  ///< the outward normal is the surface's own
  std::vector<BrepLoop> loops;
};

/// One solid bounded by one closed shell. Curves and surfaces may serve several edges and faces.
struct Brep {
  std::vector<Point3> vertices;
  std::vector<BrepCurve> curves;
  std::vector<BrepEdge> edges;
  std::vector<BrepSurface> surfaces;
  std::vector<BrepFace> faces;
  double fit_error_mm = 0.0;  ///< largest distance of its splines from the true curves
};

/// The exact solid of a part: one face a flank and a fillet side, true cylinders for tip, root, rim,
/// bores and bolt holes, planes for the ends and for the steps between slabs of different outline.
/// Where a toothing changes along the face its flanks and fillets are spline surfaces, split where
/// twist, deviation or chamfer bend; displaced, its lands too.
/// Frame: the part's own.
/// Requires: slabs stacked without gaps, each of positive height.
/// Errors: kUnsupported where outlines of neighbouring slabs cross or touch, where a deviation parts
/// the flanks of a pointed tooth, where a displacement moves the end faces out of their planes, where
/// splines of 64 spans stay farther than 1e-5 mm from the true surface, where it has a bed chamfer.
/// Guarantees: every edge is used twice, once in each direction; vertices and edges are shared.
[[nodiscard]] Result<Brep> brep_of(const PartShape& part, const PathTolerance& tolerance = {});

/// Whether every edge is used by faces exactly once forwards and once backwards, every loop is closed
/// and the Euler characteristic is even: one closed, oriented shell.
[[nodiscard]] bool is_closed(const Brep& brep);

}  // namespace trueflank
