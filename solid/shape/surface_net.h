// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/solid/shape/column_demand.h"
#include "trueflank/solid/shape/strip_rows.h"
#include "trueflank/solid/shape/surface_form.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {

/// Modified teeth as a net: what bends the surface is found on the surface itself. Each patch
/// (between two breaks of the face) has posts of its own: columns with vertices inside it; each
/// break has the vertices that the patches beside it ask for. One attempt; the grid's columns and
/// patches are laid while it lasts. Source: docs/theory/helical-facets.md.
class ToothingGrid::SurfaceNet {
 public:
  /// How the fillets and flanks of edge chamfers are laid.
  enum class Chamfers { kStrips, kPosts };
  SurfaceNet(ToothingGrid& grid, double tolerance_mm, Chamfers chamfers = Chamfers::kStrips);
  /// False where the tolerance is not kept by so many facets a tooth.
  bool lay(double most_facets);

 private:
  using Space3 = Eigen::Vector3d;
  /// Cells of a panel, and heights of a patch (shares), at which it is looked at for how it bends.
  static constexpr std::size_t kCells = 16;
  static constexpr std::array<double, 3> kHeights = {0.12, 0.5, 0.88};
  /// Heights on either side of such a one, as a share of the patch.
  static constexpr double kReachUp = 0.0625;
  /// By tooth, side and height.
  using CellForms = std::vector<SurfaceForm>;
  using PanelForms = std::array<CellForms, kCells>;

  /// Part of a chamfer's fillet between two posts [cells]: strips one above the other, between rows
  /// of vertices at even heights.
  struct Stretch {
    double from = 0.0, to = kCells;
    int strips = 1;
    StripRows rows = {};          ///< from the break outwards
    std::size_t first_level = 0;  ///< number of the lowest row within the patch, whichever stretch
  };
  /// How a patch crosses a panel.
  struct Crossing {
    PanelForms forms;  ///< over a cell and the patch
    bool dome = false;
    bool saddle = false;  ///< of a flank: as many rows on all columns, shifted from one to the next
    bool bare = false;     ///< of a flank: a strip without posts, nearly developable
    bool across = false;   ///< no vertices inside: facets reach from one break to the other
    bool between = false;  ///< the vertices of one break stand between those of the other
    int rows = 1;          ///< of a dome or a saddle's flank
    std::vector<Stretch> stretches = {};  ///< of a chamfer's fillet
  };
  /// What lies between two joints or breaks of the profile.
  struct Panel {
    std::size_t piece = 0;
    double from = 0.0, to = 0.0;
    bool land = false, flank = false;
    double wider = 1.0;  ///< a land's chords are off by so many times those of the profile
    std::vector<Crossing> patches = {};
    std::vector<std::vector<double>> posts = {};  ///< by patch, without the ends
  };

  static bool is_land(PieceKind kind) {
    return kind == PieceKind::kTip || kind == PieceKind::kRoot;
  }
  [[nodiscard]] std::size_t patch_count() const { return g_.breaks_mm_.size() - 1; }
  [[nodiscard]] double height_of(std::size_t patch, double share) const {
    return std::lerp(g_.breaks_mm_[patch], g_.breaks_mm_[patch + 1], share);
  }
  [[nodiscard]] Space3 on(int tooth, const Place& place, double z) const {
    const Point p = g_.at(place, tooth, z);
    return Space3(p.data());
  }
  /// Of a patch and piece.
  [[nodiscard]] std::size_t aims_of(std::size_t patch, std::size_t piece) const {
    return patch * pieces_ + piece;
  }
  [[nodiscard]] std::pair<std::size_t, std::size_t> samples(std::size_t piece, double a,
                                                            double b) const;
  [[nodiscard]] double aim_between(std::size_t patch, std::size_t piece, double a, double b) const;

  // surface_net_panels.cpp: what the surface asks for
  void find_panels();
  void measure_land(Panel& panel) const;
  void look_at(Panel& panel) const;
  [[nodiscard]] SurfaceForm form(int tooth, int side, std::size_t piece, double from, double to,
                                 std::size_t patch, double share) const;
  [[nodiscard]] double cell_edge(const Panel& panel, double cell) const {
    return std::lerp(panel.from, panel.to, cell / kCells);
  }
  [[nodiscard]] double room_of(const Panel& panel, std::size_t patch, std::size_t cell) const;
  [[nodiscard]] ColumnDemand columns(const Panel& panel, std::size_t patch, int rows) const;
  [[nodiscard]] ColumnDemand chords(const Panel& panel, std::size_t row) const;
  [[nodiscard]] static double chords_of(const Crossing& crossing, std::size_t cell, double room,
                                        int strips = 1);
  [[nodiscard]] static std::size_t cell_of(const Panel& panel, double parameter) {
    const double share = (parameter - panel.from) / (panel.to - panel.from);
    return static_cast<std::size_t>(std::clamp(share * kCells, 0.0, kCells - 1.0));
  }
  /// Of a stretch of a panel, in cells; and at its middle, halfway up.
  [[nodiscard]] static double cells_of(const Panel& panel, double from, double to) {
    return kCells * (to - from) / (panel.to - panel.from);
  }
  [[nodiscard]] const SurfaceForm& form_between(const Panel& panel, double from, double to,
                                                bool down) const {
    const std::size_t cell = cell_of(panel, 0.5 * (from + to));
    return panel.patches[patch_].forms[cell][(down ? kHeights.size() : 0) + 1];
  }
  [[nodiscard]] double straight_way(const Panel& panel, std::size_t patch, double parameter) const;
  void choose_crossing(Panel& panel, std::size_t patch) const;
  void choose_rows(const Panel& panel, std::size_t patch, int fewest, int most,
                   Crossing& crossing) const;

  // surface_net_chamfers.cpp: fillets of edge chamfers
  /// By cell: facets with so many strips.
  using CellCosts = std::array<std::vector<double>, kCells>;
  using StripsByCell = std::array<int, kCells>;
  [[nodiscard]] bool is_chamfer(std::size_t patch) const;
  [[nodiscard]] static bool is_fillet(const Panel& panel) { return !panel.land && !panel.flank; }
  void lay_strips();
  [[nodiscard]] BentEdges bent_edges(const Panel& panel, std::size_t patch) const;
  [[nodiscard]] StripsByCell choose_strips(const Panel& panel, std::size_t patch) const;
  [[nodiscard]] CellCosts costs_of_strips(const Panel& panel, std::size_t patch) const;
  [[nodiscard]] std::pair<double, double> rows_with(const Panel& panel, std::size_t patch,
                                                    std::size_t cell, int strips) const;
  [[nodiscard]] RowBeside row_beside(const Panel& panel, std::size_t patch) const;
  void lay_stretches(Panel& panel, std::size_t patch, const StripsByCell& strips) const;
  void add_strips(Panel& panel, std::size_t patch, std::vector<std::vector<double>>& rows,
                  std::vector<std::vector<double>>& levels) const;
  [[nodiscard]] const Stretch* stretch_of(std::size_t edge, double from, double to) const;

  // surface_net_columns.cpp: where vertices stand
  void spread();
  void add_land(const Panel& panel);
  void add_panel(Panel& panel);
  [[nodiscard]] std::vector<double> row_between(const Panel& panel, std::size_t patch,
                                                const std::vector<double>& other) const;
  [[nodiscard]] std::vector<std::vector<double>> level_rows(
      Panel& panel, std::vector<std::vector<double>>& rows) const;
  void add_columns(const Panel& panel, const std::vector<std::vector<double>>& rows,
                   const std::vector<std::vector<double>>& levels);
  [[nodiscard]] double rows_of(const Crossing& crossing) const;
  void find_posts(Panel& panel) const;
  [[nodiscard]] std::vector<double> row_of(const Panel& panel, std::size_t row) const;

  // toothing_grid_surface.cpp: the net of a patch
  [[nodiscard]] bool is_post(std::size_t column) const;
  [[nodiscard]] std::vector<bool> row_columns(std::size_t row) const;
  void find_regions();
  [[nodiscard]] bool is_flank(std::size_t edge) const;
  [[nodiscard]] bool on_land(std::size_t edge) const;
  [[nodiscard]] const Panel& panel_of(std::size_t edge) const;
  [[nodiscard]] std::size_t region_end(std::size_t edge) const;
  [[nodiscard]] std::pair<double, double> span_of(std::size_t from, std::size_t to) const;
  void join_regions();
  [[nodiscard]] double steps_of(std::size_t from, std::size_t to) const;
  [[nodiscard]] static double bare_steps(const Crossing& crossing, std::size_t cell, double room);
  [[nodiscard]] std::vector<std::vector<double>> inner_rows() const;
  [[nodiscard]] std::vector<double> shifts_of_columns() const;
  void shift_on_saddle(std::size_t first, bool down, std::vector<double>& shifts) const;
  /// On the side where edges go down from the tip, or on the other.
  [[nodiscard]] std::size_t edge_of_half(std::size_t half, bool down) const {
    const std::size_t m = g_.edges_.size();
    return down ? m + (g_.vertex_at_tooth_middle_ ? 0 : 1) + half : m - 1 - half;
  }
  [[nodiscard]] bool is_on_level(std::size_t column, int below) const;
  [[nodiscard]] double ridge(std::size_t column) const;
  [[nodiscard]] Place end_of(std::size_t edge, bool at_end) const;
  [[nodiscard]] NetPoint net_point(std::size_t edge, bool at_end, double share) const;

  // surface_net_measure.cpp: whether it keeps the tolerance
  struct At {
    double parameter = 0.0, z = 0.0;
    Space3 point = Space3::Zero();
    Space3 before = Space3::Zero();  ///< of lands, not displaced
  };
  void measure(const NetPatch& net, int tooth, Aims& errors) const;
  [[nodiscard]] Space3 over_edge(int tooth, const Place& surface, const At& p, const At& q,
                                 double share) const;
  [[nodiscard]] Space3 over_moved_middle(const At& p, const At& q) const;
  [[nodiscard]] static double land_error(const std::array<At, 3>& corner);

  ToothingGrid& g_;
  double tolerance_;
  Chamfers chamfers_;
  std::vector<int> teeth_;  ///< looked at
  Toothing unmoved_;        ///< without its displacement
  std::size_t pieces_ = 0;
  std::vector<Panel> panels_;
  std::vector<StripsByCell> strips_;  ///< of the chamfers' fillets, one after the other
  int round_ = 0;
  Aims aims_;
  std::vector<NetEdge> net_;  ///< of patch_
  std::size_t patch_ = 0;
};

}  // namespace trueflank
