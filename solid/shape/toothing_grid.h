// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trueflank/solid/shape/flank_breaks.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/solid/shape/screw_net.h"

namespace trueflank {

/// What a grid may be: whatever has the fewest facets, or rows and columns in any case.
enum class GridKind { kFewest, kRows };

/// The vertices of a toothing's mesh: columns (the same places of the profile in every row) and
/// rows at heights, chosen so that every facet between them keeps a tolerance. Every vertex is a
/// surface_point().
/// Nets: columns with vertices of their own, see patches(); one for all teeth, also where they differ.
/// Bed chamfers, and where a net fails: the section's own chords give the columns, the curvature of the screw the rows; where a
/// deviation or displacement bends the surface more, columns and rows are added until the triangles
/// keep the tolerance. Each quadrilateral is cut along the diagonal that lies nearer to the
/// surface: on an involute flank along the straight generator of the helicoid. Joints of profile
/// pieces, the deviation's breaks (which wander along the flank), a herringbone's middle and
/// chamfers are columns and rows. Source: docs/theory/helical-facets.md.
class ToothingGrid {
 public:
  /// `levels_mm`: heights in the gear's frame, ascending; each becomes a row. One level alone makes
  /// a section without facets.
  /// Requires: tolerance_mm > 0, a level.
  ToothingGrid(const ToothedOutline& outline, std::vector<double> levels_mm, double tolerance_mm,
               GridKind kind = GridKind::kFewest);

  [[nodiscard]] int teeth() const { return teeth_; }
  [[nodiscard]] int points_per_tooth() const { return static_cast<int>(points_.size()); }
  /// Of the rows, in the gear's frame.
  [[nodiscard]] const std::vector<double>& heights_mm() const { return heights_mm_; }
  /// All teeth at a height (gear's frame): points of the part's frame, tooth by tooth as in
  /// SectionPolygon.
  [[nodiscard]] std::vector<std::array<double, 3>> row(double z_mm) const;
  /// The place of each column in a tooth's part of row(heights_mm()[row]), and how many there are.
  /// Of a column that has no vertex on this row: of the next one.
  struct RowPlaces {
    std::vector<int> place;
    int count = 0;
  };
  [[nodiscard]] RowPlaces row_places(std::size_t row) const;
  /// Whether the quadrilateral above row `layer` that follows a point of a tooth is cut from its
  /// lower left to its upper right corner (seen from the axis' outside, the axis upwards).
  [[nodiscard]] bool rises(std::size_t layer, int tooth, int point) const;
  /// Most teeth are nets instead: patches between heights_mm(), inner vertices on each column
  /// where its own curvature asks for them. Empty where rows and columns are what there is.
  [[nodiscard]] const std::vector<NetPatch>& patches() const { return patches_; }
  /// The inner vertices of a patch, tooth by tooth, column by column, upwards; the part's frame.
  [[nodiscard]] std::vector<std::array<double, 3>> inner_points(std::size_t patch) const;
  /// False where teeth differ by deviation or displacement.
  [[nodiscard]] bool teeth_alike() const { return teeth_alike_; }
  /// Bound on the distance of facets to the surface and of the surface to the facets.
  [[nodiscard]] double chord_error_mm() const {
    return section_error_mm_ > facet_error_mm_ ? section_error_mm_ : facet_error_mm_;
  }

 private:
  using Point = std::array<double, 3>;
  /// An edge of the half tooth along one piece of its profile.
  struct HalfEdge {
    std::size_t piece = 0;
    double from = 0.0, to = 0.0;
    // of a modified net, of its first column, by bits:
    std::uint64_t rows = ~std::uint64_t{0};  ///< breaks on which it has a vertex
    std::uint64_t posts = 0;                 ///< patches in which it may have vertices, too
    std::uint64_t levels = 0;                ///< rows within patches on which it has a vertex
  };
  /// A place on a tooth, whichever tooth.
  struct Place {
    int side = 1;
    std::size_t piece = 0;
    double parameter = 0.0;
  };
  /// Breaks and patches of nets are named by the bits of a number.
  static constexpr std::size_t kMostBreaks = 64;
  /// Places at which a piece is looked at for how it bends.
  static constexpr std::size_t kSamples = 32;
  /// What the facets aim at, by piece and sample.
  using Aims = std::vector<std::array<double, kSamples>>;
  /// Points of one tooth at a height, the next tooth's first one last, and the middles of its
  /// edges.
  struct ToothRow {
    std::vector<Point> points, middles, chord_middles;
  };

  /// The place at a height: columns go with the breaks of the deviation.
  [[nodiscard]] ToothPlace place_at(const Place& place, int tooth, double z_mm) const;
  [[nodiscard]] Point at(const Place& place, int tooth, double z_mm) const;
  /// The same in the part's frame.
  [[nodiscard]] Point in_part(const Place& place, int tooth, double z_mm) const;
  [[nodiscard]] std::vector<int> some_teeth() const;
  [[nodiscard]] bool is_even(std::size_t middle) const {
    return chord_middles_[middle].parameter == middles_[middle].parameter;
  }
  /// The half edge that begins at a column of the tooth; null at the middles of tooth and gap.
  [[nodiscard]] const HalfEdge* begins_at(std::size_t column) const;
  [[nodiscard]] bool is_on_row(std::size_t column, std::size_t row) const;
  void lay_plain(double aim_mm);
  class SurfaceNet;
  void add_bend_breaks(double tolerance_mm);
  /// A net of modified teeth. False where the tolerance is not kept.
  bool try_surface_net(double tolerance_mm, double most_facets);
  /// Rows and columns instead of a net of teeth that differ, if they are better or the net fails.
  void lay_different_teeth(double tolerance_mm, double aim_mm);
  /// Finer aims where facets were off by more; false where none was.
  static bool tighten(Aims& aims_mm, const Aims& error_mm, double tolerance_mm);
  /// Where rows and columns share the tolerance, as it takes the fewest facets.
  void lay_modified(double tolerance_mm, double aim_mm);
  /// What rows may have of the tolerance, so that the longest layer is cut into whole parts and
  /// fewer facets than `fewest` (points by rows) are promised. Leaves columns that must be laid
  /// again.
  [[nodiscard]] std::vector<double> shares_of_rows(double aim_mm, const std::vector<bool>& crowded,
                                                   std::size_t fewest);
  /// Rows have an error of their own, columns of crowded pieces the rest; 0: all the whole
  /// tolerance.
  void lay_columns(double aim_mm, double rows_mm, const std::vector<bool>& crowded);
  void lay_rows(double aim_mm, double rows_mm);
  void crowd_columns(const std::vector<bool>& crowded, double tolerance_mm);
  /// Cuts, and adds where that does not keep the tolerance; returns the pieces that needed more
  /// columns.
  std::vector<bool> cut_in_rounds(double aim_mm);
  void start_columns(double tolerance_mm);
  void add_roll_breaks(double tolerance_mm);
  void find_ends();
  void place_columns();
  void start_layers(double tolerance_mm);
  /// Cuts edges that are off by more; which of all are whole as they were.
  std::vector<bool> split_columns(const std::vector<double>& error_mm, double tolerance_mm);
  void refine_columns(double tolerance_mm);
  [[nodiscard]] double edge_error_mm(const HalfEdge& edge, int side, int tooth, double z_mm) const;
  void refine_layers(double tolerance_mm, int most_parts);
  /// toothing_grid_waves.cpp
  bool cut_hidden_waves(double aim_mm);
  [[nodiscard]] Point displaced_by(const Place& place, int tooth, double z_mm) const;
  [[nodiscard]] bool hides_upright(double lower_mm, double upper_mm, double error_mm) const;
  [[nodiscard]] bool hides_across(const HalfEdge& edge, double error_mm) const;
  [[nodiscard]] double layer_error_mm(double lower_mm, double upper_mm, int samples) const;
  [[nodiscard]] ToothRow tooth_row(int tooth, double z_mm) const;
  /// Cuts all quadrilaterals along the better diagonal and returns the largest error left; what is
  /// beyond the tolerance is charged to columns or layers.
  double cut(double tolerance_mm);
  void try_net(double tolerance_mm);
  void spread_columns(const Aims& aims_mm, double widest_rad);
  [[nodiscard]] double patch_turn_rad(std::size_t patch) const;
  [[nodiscard]] std::vector<NetEdge> net_edges() const;
  [[nodiscard]] std::vector<double> column_steps(const std::vector<NetEdge>& edges,
                                                 const Aims& aims_mm) const;
  [[nodiscard]] std::vector<std::vector<double>> inner_rows(const std::vector<NetEdge>& edges,
                                                            const std::vector<double>& steps,
                                                            double turn_rad) const;
  void measure_net(const NetPatch& net, const std::vector<NetEdge>& edges, std::size_t patch,
                   Aims& error_mm) const;
  [[nodiscard]] std::pair<std::size_t, std::size_t> samples_of(std::size_t edge) const;
  [[nodiscard]] double aim_of(const Aims& aims_mm, std::size_t edge) const;
  void add_where_charged(double tolerance_mm);

  const ToothedOutline* outline_;
  Toothing toothing_;
  int teeth_ = 0;
  bool teeth_alike_ = true, layers_alike_ = true, plain_ = true;
  bool hid_waves_ = false;  ///< shorter than rows and columns first were apart
  std::vector<double> levels_mm_, breaks_mm_, heights_mm_;
  std::vector<NetPatch> patches_;
  std::vector<HalfEdge> edges_;
  FlankBreaks breaks_;
  FlankBreaks::InChamfers breaks_in_chamfers_ = FlankBreaks::InChamfers::kLeft;
  Place first_, last_;  ///< of the half tooth
  bool vertex_at_tooth_middle_ = true, vertex_at_gap_middle_ = true;
  std::vector<Place> points_, middles_;  ///< of a whole tooth; middle i follows point i
  std::vector<Place> chord_middles_;  ///< at the chord's middle where the parameter runs unevenly
  std::vector<std::size_t> edge_of_;  ///< half edge of middle i
  std::vector<std::vector<bool>> rises_;  ///< by layer; one tooth where they are alike
  std::vector<double> column_error_mm_, layer_error_mm_;  ///< charged by cut()
  double section_error_mm_ = 0.0, facet_error_mm_ = 0.0;
};

/// The toothing's section at a height in the gear's frame, its deviation included, not turned by
/// the twist.
[[nodiscard]] OutlineLoop toothed_section(const ToothedOutline& outline, double z_mm,
                                          double tolerance_mm);

}  // namespace trueflank
