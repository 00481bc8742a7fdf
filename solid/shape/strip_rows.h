// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "trueflank/solid/shape/column_demand.h"
#include "trueflank/solid/shape/surface_form.h"

// Rows of vertices on a surface that lies between two breaks of the face, cut into strips one above
// the other; every facet reaches from one row to the next. Source: docs/theory/helical-facets.md.
namespace trueflank {

/// How edges bend away from a surface of which the form is known, cell by cell of a panel, at
/// heights that are shares of the patch. Places along the panel are counted in cells.
class BentEdges {
 public:
  using Heights = std::array<double, 3>;
  /// Requires: forms of at least two cells, each at all heights, for any number of surfaces one
  /// behind the other; the room (eight tolerances) of each cell.
  BentEdges(std::vector<std::vector<SurfaceForm>> forms, const Heights& heights,
            std::vector<double> rooms_mm);
  [[nodiscard]] double cells() const { return static_cast<double>(forms_.size()); }
  /// In tolerances: of an edge of a row, which ends the surface in its own plane.
  [[nodiscard]] double along_row(double from, double to, double height) const;
  /// In tolerances: of an edge from one row to another.
  [[nodiscard]] double over_strip(double from, double low, double to, double high) const;

 private:
  template <class Use>
  void each_form(double place, double height, const Use& use) const;

  std::vector<std::vector<SurfaceForm>> forms_;
  Heights heights_;
  std::vector<double> rooms_mm_;
};

/// Where the patch beside a break has vertices on it, and how many chords it asks for.
struct RowBeside {
  std::vector<double> fixed = {};  ///< places, ascending
  ColumnDemand chords;             ///< by cells
};

/// The places of the vertices of each row, the break's first; all rows have the stretch's two ends.
using StripRows = std::vector<std::vector<double>>;

/// How a patch is cut over a stretch of the panel.
struct Strips {
  const BentEdges& edges;
  const RowBeside& beside;
  int count = 1;      ///< one above the other
  bool down = false;  ///< the break is the patch's upper end
};
/// The rows of a stretch, from the break outwards. Each vertex stands as far along as the tolerance
/// lets the edges to those before it, on its own row and on the rows beside it.
[[nodiscard]] StripRows strip_rows(const Strips& strips, double from, double to);
/// As many rows and no more vertices, with what they leave of the tolerance shared out.
[[nodiscard]] StripRows even_strip_rows(const Strips& strips, double from, double to);

[[nodiscard]] std::size_t vertex_count(const StripRows& rows);

}  // namespace trueflank
