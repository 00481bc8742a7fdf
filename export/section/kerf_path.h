// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/section/section_contour.h"

// The way of a wire or beam of some width around an outline.
namespace trueflank::io {

/// A corner that the wire is too thick for; material stays there.
struct UnreachedCorner {
  Point2 place = Point2::Zero();  ///< middle of the wire where it comes nearest
  double left_mm = 0.0;           ///< how deep the material that stays is
};

struct KerfPath {
  Contour path;     ///< of the wire's middle, closed, counter-clockwise; arcs within the tolerance
  Contour as_cut;   ///< the edge that comes out; differs from the outline at unreached corners only
  /// Largest distance of the path from the true offset curve, both ways.
  double deviation_mm = 0.0;
  std::vector<UnreachedCorner> corners;  ///< all of them, round the outline
};

/// The curve at half the kerf from the outline, on the side that is cut away: outside of a part's
/// outer outline, inside of its holes. Where that curve crosses itself it is cut off: every point of
/// the path is at least half the kerf from the whole outline. Convex corners are rounded about
/// the corner, as the wire goes.
/// Requires: kerf_mm > 0, tolerance_mm > 0.
/// Teeth with modifications of the profile: of their modified section.
/// Errors, key made.kerf_mm: kInfeasible where the wire does not fit into the hole; kUnsupported for
/// helical teeth and those that change along the face, which no straight wire cuts, and for teeth
/// that differ.
/// Accuracy: deviation_mm <= tolerance_mm, measured against OutlineDistance, tested against an offset
/// of the dense polygon in tests/export/kerf_path_test.cpp.
[[nodiscard]] Result<KerfPath> kerf_path(const Outline& outline, bool hole, double kerf_mm,
                                         double tolerance_mm);

/// Sections of a part with paths instead of outlines: bodies `<name>_KERF_<um>UM`, and frozen ones
/// `<name>_AS_CUT` where corners are not reached. Errors: as kerf_path.
struct KerfSections {
  std::vector<Section> sections;
  double deviation_mm = 0.0;
  std::size_t unreached = 0;    ///< corners
  double left_mm = 0.0;         ///< deepest material that stays in them
};
[[nodiscard]] Result<KerfSections> kerf_sections(const PartShape& part, double kerf_mm,
                                                 double tolerance_mm);

}  // namespace trueflank::io
