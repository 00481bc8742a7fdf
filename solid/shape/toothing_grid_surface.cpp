// SPDX-License-Identifier: GPL-3.0-or-later
//
// Modified teeth as nets: what bends the surface is found on the surface itself. Source:
// docs/theory/helical-facets.md.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/shape/column_demand.h"
#include "trueflank/solid/shape/surface_form.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

using Space3 = Eigen::Vector3d;

/// Rounds of finer columns and steps where facets do not keep the tolerance.
constexpr int kSurfaceRounds = 14;
/// More facets than so many times the first round's: something bends that columns do not mend.
constexpr double kWorthWhile = 1.6;
/// From this round on the neighbours of what is too coarse are laid finer, too.
constexpr int kAlone = 4;
/// A net is measured, not bounded: what its error is taken for.
constexpr double kMeasured = 0.99;
/// Cells of a panel, and heights of a patch (shares), at which it is looked at for how it bends.
constexpr std::size_t kCells = 16;
constexpr std::array<double, 3> kHeights = {0.12, 0.5, 0.88};
/// Heights on either side of such a one, as a share of the patch.
constexpr double kReachUp = 0.0625;
/// Strips whose generators wander up by more than this share of a step have them in sight.
constexpr double kUpright = 0.5;
/// Of an edge, where its normals are found.
constexpr double kNear = 1e-3;
/// Where a chord's middle lies farther from the surface's own, it is looked for.
constexpr double kOffMiddle = 0.02;

bool is_land(PieceKind kind) { return kind == PieceKind::kTip || kind == PieceKind::kRoot; }

}  // namespace

/// One attempt; the grid's columns and patches are laid while it lasts.
class ToothingGrid::SurfaceNet {
 public:
  SurfaceNet(ToothingGrid& grid, double tolerance_mm) : g_(grid), tolerance_(tolerance_mm) {
    find_panels();
  }

  /// False where the tolerance is not kept.
  bool lay() {
    Aims aims(g_.toothing_.profile->pieces().size());
    for (auto& piece : aims) piece.fill(tolerance_);
    double first_facets = 0.0;
    for (int round = 0; round < kSurfaceRounds; ++round) {
      spread(aims);
      net_ = g_.net_edges();
      find_regions();
      Aims errors(aims.size(), std::array<double, kSamples>{});
      g_.patches_.clear();
      for (patch_ = 0; patch_ + 1 < g_.breaks_mm_.size(); ++patch_) {
        find_edge_forms(aims);
        std::vector<std::vector<double>> inner = inner_rows(aims);
        const NetSurface surface = [this](int edge, bool at_end, double height) {
          return net_point(static_cast<std::size_t>(edge), at_end, height);
        };
        g_.patches_.push_back(
            net_patch(net_, std::move(inner), g_.patch_turn_rad(patch_), surface));
        measure(g_.patches_.back(), errors);
      }
      if (round >= kAlone) spread_to_neighbours(errors);
      if (!tighten(aims, errors, tolerance_)) return true;
      std::size_t facets = 0;
      for (const NetPatch& net : g_.patches_) facets += net.facets.size();
      if (round == 0) first_facets = static_cast<double>(facets);
      if (static_cast<double>(facets) > kWorthWhile * first_facets) return false;
    }
    return false;
  }

 private:
  struct Panel {
    std::size_t piece = 0;
    double from = 0.0, to = 0.0;
    bool land = false, flank = false, dome = false;
    double wider = 1.0;  ///< a land's chords are off by so many times those of the profile
    std::vector<std::vector<SurfaceForm>> cells;  ///< of a cell: by patch, side and height
    std::vector<int> rows;                        ///< of a dome, by patch
  };

  [[nodiscard]] double low(std::size_t patch) const { return g_.breaks_mm_[patch]; }
  [[nodiscard]] double height_of(std::size_t patch, double share) const {
    return std::lerp(g_.breaks_mm_[patch], g_.breaks_mm_[patch + 1], share);
  }
  [[nodiscard]] Space3 on(int side, std::size_t piece, double parameter, double z) const {
    const Point p = g_.at({side, piece, parameter}, 0, z);
    return Space3(p.data());
  }

  /// Of a step from one parameter to the other and over the whole height of a patch.
  [[nodiscard]] SurfaceForm form(int side, std::size_t piece, double from, double to,
                                 std::size_t patch, double share) const {
    const double middle = 0.5 * (from + to);
    const double z0 = height_of(patch, share - kReachUp), z = height_of(patch, share),
                 z1 = height_of(patch, share + kReachUp);
    const auto x = [&](double parameter, double height) {
      return on(side, piece, parameter, height);
    };
    return surface_form(
        {x(from, z0), x(from, z), x(middle, z0), x(middle, z), x(middle, z1), x(to, z), x(to, z1)},
        2.0, 1.0 / kReachUp);
  }

  static void spread_to_neighbours(Aims& errors) {
    for (auto& piece : errors) {
      const auto before = piece;
      for (std::size_t k = 0; k < kSamples; ++k)
        for (const std::size_t other : {k > 0 ? k - 1 : k, std::min(k + 1, kSamples - 1)})
          piece[k] = std::max(piece[k], before[other]);
    }
  }

  void find_panels() {
    const auto& pieces = g_.toothing_.profile->pieces();
    const std::vector<double>& breaks = g_.breaks_.parameters();
    for (const HalfEdge& e : g_.edges_) {
      const bool at_break = std::find(breaks.begin(), breaks.end(), e.from) != breaks.end();
      if (panels_.empty() || panels_.back().piece != e.piece || at_break)
        panels_.push_back({.piece = e.piece,
                           .from = e.from,
                           .land = is_land(pieces[e.piece].kind),
                           .flank = pieces[e.piece].kind == PieceKind::kInvolute});
      panels_.back().to = e.to;
    }
    for (Panel& panel : panels_)
      if (panel.land)
        measure_land(panel);
      else
        look_at(panel);
  }

  /// Lands are wider where flanks have more material or chamfers lower tips.
  void measure_land(Panel& panel) const {
    const Curve& curve = g_.toothing_.profile->pieces()[panel.piece].curve;
    const auto spread_of = [](const Point2& a, const Point2& b) {
      const double angle = std::atan2(cross(a, b), a.dot(b));
      return angle * angle * a.norm();
    };
    const double plain = spread_of(point_at(curve, curve.begin), point_at(curve, curve.end));
    for (const double z : g_.breaks_mm_)
      for (const int side : {-1, 1}) {
        const Space3 a = on(side, panel.piece, curve.begin, z),
                     b = on(side, panel.piece, curve.end, z);
        if (plain > 0.0)
          panel.wider = std::max(panel.wider, spread_of(a.head<2>(), b.head<2>()) / plain);
      }
  }

  void look_at(Panel& panel) {
    const double room = 8.0 * tolerance_;
    panel.rows.assign(g_.breaks_mm_.size() - 1, 1);
    for (std::size_t c = 0; c < kCells; ++c) {
      const auto parameter = [&](double k) { return std::lerp(panel.from, panel.to, k / kCells); };
      panel.cells.emplace_back();
      const auto cell = static_cast<double>(c);
      for (std::size_t patch = 0; patch + 1 < g_.breaks_mm_.size(); ++patch)
        for (const int side : {-1, 1})
          for (const double share : kHeights) {
            panel.cells.back().push_back(
                form(side, panel.piece, parameter(cell), parameter(cell + 1.0), patch, share));
            panel.dome = panel.dome || panel.cells.back().back().is_dome(room);
          }
    }
  }

  [[nodiscard]] std::size_t patch_of(std::size_t form) const {
    return form / (2 * kHeights.size());
  }

  /// Columns that a panel asks for with so many rows, and chords of its sections.
  [[nodiscard]] ColumnDemand columns(const Panel& panel, const std::vector<int>& rows,
                                     const Aims& aims) const {
    ColumnDemand demand(panel.from, panel.to);
    for (std::size_t c = 0; c < kCells; ++c) {
      const double room = 8.0 * aim_at(aims, panel, c);
      double most = 1e-9;
      for (std::size_t k = 0; k < panel.cells[c].size(); ++k) {
        const SurfaceForm& form = panel.cells[c][k];
        most = std::max(most, form.columns(rows[patch_of(k)], room));
        if (!panel.flank) most = std::max(most, std::sqrt(form.level / room));
      }
      demand.add(most);
    }
    return demand;
  }
  [[nodiscard]] ColumnDemand chords(const Panel& panel, const Aims& aims) const {
    ColumnDemand demand(panel.from, panel.to);
    for (std::size_t c = 0; c < kCells; ++c) {
      double most = 1e-9;
      for (const SurfaceForm& form : panel.cells[c]) most = std::max(most, form.level);
      demand.add(std::sqrt(most / (8.0 * aim_at(aims, panel, c))));
    }
    return demand;
  }
  [[nodiscard]] double aim_at(const Aims& aims, const Panel& panel, std::size_t cell) const {
    const auto parameter = [&](double k) { return std::lerp(panel.from, panel.to, k / kCells); };
    const auto c = static_cast<double>(cell);
    const auto [from, to] = samples(panel.piece, parameter(c), parameter(c + 1.0));
    return least(aims[panel.piece], from, to);
  }
  static double least(const std::array<double, kSamples>& aims, std::size_t from, std::size_t to) {
    return *std::min_element(aims.begin() + static_cast<std::ptrdiff_t>(from),
                             aims.begin() + static_cast<std::ptrdiff_t>(to));
  }
  [[nodiscard]] std::pair<std::size_t, std::size_t> samples(std::size_t piece, double a,
                                                            double b) const {
    const Curve& curve = g_.toothing_.profile->pieces()[piece].curve;
    const auto sample = [&](double parameter) {
      return kSamples * std::clamp((parameter - curve.begin) / (curve.end - curve.begin), 0.0, 1.0);
    };
    const double low = std::min(sample(a), sample(b)), high = std::max(sample(a), sample(b));
    const auto from = std::min(static_cast<std::size_t>(low + 1e-6), kSamples - 1);
    const auto to = static_cast<std::size_t>(std::max(0.0, std::ceil(high - 1e-6)));
    return {from, std::clamp(to, from + 1, kSamples)};
  }

  /// Of a dome: as many rows as make the fewest facets with the columns they leave.
  void choose_rows(Panel& panel, const Aims& aims) const {
    if (!panel.dome) return;
    double along = 0.0, tallest = 0.0;
    for (std::size_t patch = 0; patch < panel.rows.size(); ++patch)
      tallest = std::max(tallest, g_.breaks_mm_[patch + 1] - g_.breaks_mm_[patch]);
    for (std::size_t c = 0; c < kCells; ++c)
      for (const SurfaceForm& form : panel.cells[c])
        along = std::max(along, std::abs(form.along) / (8.0 * aim_at(aims, panel, c)));
    const int fewest = whole_parts(std::sqrt(along));
    double least_facets = 1e300;
    std::vector<int> best;
    for (int rows = fewest; rows <= 2 * fewest + 1; ++rows) {
      std::vector<int> by_patch;
      double sum = 0.0;
      for (std::size_t patch = 0; patch < panel.rows.size(); ++patch) {
        by_patch.push_back(whole_parts(rows * (g_.breaks_mm_[patch + 1] - low(patch)) / tallest));
        sum += by_patch.back();
      }
      const double facets = whole_parts(columns(panel, by_patch, aims).whole()) * sum;
      if (facets < least_facets) least_facets = facets, best = by_patch;
    }
    panel.rows = best;
  }

  void spread(const Aims& aims) {
    g_.edges_.clear();
    for (Panel& panel : panels_) {
      const std::size_t first = g_.edges_.size();
      if (panel.land) {
        add_land(panel, aims);
      } else {
        choose_rows(panel, aims);
        const ColumnDemand wanted = columns(panel, panel.rows, aims), across = chords(panel, aims);
        const int count = whole_parts(wanted.whole());
        double at = panel.from;
        for (int k = 1; k <= count; ++k) {
          const double next =
              k == count ? panel.to : wanted.parameter_of(wanted.whole() * k / count);
          const int parts = panel.flank ? whole_parts(across.at(next) - across.at(at)) : 1;
          for (int i = 0; i < parts; ++i) {
            g_.edges_.push_back({panel.piece, across.between(at, next, i, parts),
                                 across.between(at, next, i + 1, parts), panel.flank && i == 0});
          }
          at = next;
        }
      }
      g_.edges_[first].starts_strip = true;
    }
    g_.find_ends();
    g_.place_columns();
  }

  void add_land(const Panel& panel, const Aims& aims) {
    const auto& piece = aims[panel.piece];
    const HalfToothPolyline half = tessellate(
        *g_.toothing_.profile, *std::min_element(piece.begin(), piece.end()) / panel.wider);
    for (const HalfToothPolyline::Edge& e : half.edges)
      if (static_cast<std::size_t>(e.piece) == panel.piece)
        g_.edges_.push_back({panel.piece, e.from, e.to});
    if (panel.piece == panels_.front().piece)
      g_.vertex_at_tooth_middle_ = half.vertex_at_tooth_middle;
    if (panel.piece == panels_.back().piece) g_.vertex_at_gap_middle_ = half.vertex_at_gap_middle;
  }

  /// Regions of the net are lands, fillets, and of the flanks what lies between two columns that
  /// have vertices inside the patch.
  void find_regions() {
    const std::size_t n = g_.points_.size(), m = g_.edges_.size();
    std::vector<int> regions(n, 0);
    for (std::size_t i = 1; i < n; ++i) {
      // of the column between edges i - 1 and i, the half edge that begins there
      const std::size_t half = std::max(g_.edge_of_[i - 1], g_.edge_of_[i]);
      const bool inside = g_.edge_of_[i - 1] != g_.edge_of_[i] && half < m;
      const bool starts =
          net_[i].region != net_[i - 1].region || (inside && g_.edges_[half].starts_strip);
      regions[i] = regions[i - 1] + (starts ? 1 : 0);
    }
    const int last = regions.back();
    if (last > 0 && net_.front().region == net_.back().region)
      std::replace(regions.begin(), regions.end(), last, 0);
    for (std::size_t i = 0; i < n; ++i) net_[i].region = regions[i];
  }

  [[nodiscard]] bool is_flank(std::size_t edge) const {
    return g_.toothing_.profile->pieces()[g_.middles_[edge].piece].kind == PieceKind::kInvolute;
  }
  [[nodiscard]] bool on_land(std::size_t edge) const {
    return is_land(g_.toothing_.profile->pieces()[g_.middles_[edge].piece].kind);
  }

  /// How the surface bends over an edge and the patch, at its heights; which flanks are strips.
  void find_edge_forms(const Aims& aims) {
    const std::size_t n = net_.size();
    forms_.assign(n, {});
    for (std::size_t i = 0; i < n; ++i) {
      if (on_land(i)) continue;
      const HalfEdge& e = g_.edges_[g_.edge_of_[i]];
      for (std::size_t k = 0; k < kHeights.size(); ++k)
        forms_[i][k] = form(g_.middles_[i].side, e.piece, e.from, e.to, patch_, kHeights[k]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_flank(i)) continue;
      const bool alone = net_[i].region != net_[(i + n - 1) % n].region &&
                         net_[i].region != net_[(i + 1) % n].region;
      const double room = 8.0 * g_.aim_of(aims, i);
      const SurfaceForm& bent = forms_[i][1];
      const bool upright =
          std::abs(bent.mixed) <= kUpright * std::sqrt(std::abs(bent.along) * room);
      net_[i].developable = !(alone && upright);
    }
  }

  [[nodiscard]] Panel& panel_of(std::size_t edge) {
    const Place& p = g_.middles_[edge];
    const auto found = std::find_if(panels_.begin(), panels_.end(), [&](const Panel& panel) {
      return panel.piece == p.piece && (p.parameter - panel.from) * (p.parameter - panel.to) <= 0.0;
    });
    return found == panels_.end() ? panels_.front() : *found;
  }

  /// Heights of the vertices on each column of the patch, as shares.
  std::vector<std::vector<double>> inner_rows(const Aims& aims) {
    const std::size_t n = net_.size();
    std::vector<int> parts(n, 1);
    const auto ask = [&](std::size_t column, double demand) {
      int& asked = parts[column % n];
      asked = std::max(asked, whole_parts(demand));
    };
    for (std::size_t i = 0; i < n; ++i) {
      const bool first = net_[i].region != net_[(i + n - 1) % n].region,
                 last = net_[i].region != net_[(i + 1) % n].region;
      if (on_land(i)) {
        if (first) ask(i, ridge(i, aims));
        if (last) ask(i + 1, ridge(i + 1, aims));
        continue;
      }
      const double room = 8.0 * g_.aim_of(aims, i);
      Panel& panel = panel_of(i);
      double steps = 1.0;
      for (const SurfaceForm& f : forms_[i]) {
        const double own = f.steps(room);
        steps = std::max(steps, f.is_dome(room) ? panel.rows[patch_] : own);
        // the diagonal that leans the wrong way
        if (!net_[i].developable && f.across * f.along < 0.0) {
          const double whole = room + std::abs(f.across), mixed = std::abs(f.mixed);
          steps = std::max(steps,
                           (mixed + std::sqrt(mixed * mixed + std::abs(f.along) * whole)) / whole);
        }
      }
      if (!net_[i].developable || first) ask(i, steps);
      if (!net_[i].developable || last) ask(i + 1, steps);
    }
    const std::vector<bool> between = columns_between();
    std::vector<std::vector<double>> inner(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (net_[(i + n - 1) % n].region == net_[i].region && net_[i].developable) continue;
      const bool shifted = between[i] && parts[i] > 1;
      for (int k = shifted ? 0 : 1; k < parts[i]; ++k)
        inner[i].push_back((k + (shifted ? 0.5 : 0.0)) / parts[i]);
    }
    return inner;
  }

  /// By column, whether it has its vertices between its neighbour's, seen along the ways up that
  /// turn the normal least: isosceles triangles on domes. Counted from the tip on either side.
  std::vector<bool> columns_between() {
    const std::size_t n = net_.size(), m = g_.edges_.size();
    std::vector<bool> between(n, false);
    for (const bool down : {false, true}) {
      double phase = 0.0, shift = 0.0;
      for (std::size_t half = 0; half < m; ++half) {
        const std::size_t edge =
            down ? m + (g_.vertex_at_tooth_middle_ ? 0 : 1) + half : m - 1 - half;
        if (on_land(edge) || !panel_of(edge).dome) {
          phase = shift = 0.0;
          continue;
        }
        const SurfaceForm& bent = forms_[edge][1];
        if (bent.along != 0.0) shift -= bent.mixed / bent.along;
        if (half + 1 < m && !g_.edges_[half + 1].starts_strip && is_flank(edge)) continue;
        phase += shift * panel_of(edge).rows[patch_] + 0.5;
        phase -= std::floor(phase);
        shift = 0.0;
        const bool nearer = std::abs(phase - 0.5) < 0.25;
        phase = nearer ? 0.5 : 0.0;
        between[(down ? edge + 1 : edge) % n] = nearer;
      }
    }
    return between;
  }

  /// Steps of a land's border: the chords of its column.
  [[nodiscard]] double ridge(std::size_t column, const Aims& aims) const {
    const Place& p = g_.points_[column % g_.points_.size()];
    double most = 0.0;
    for (const double share : kHeights) {
      const Space3 a = on(p.side, p.piece, p.parameter, height_of(patch_, share - kReachUp)),
                   b = on(p.side, p.piece, p.parameter, height_of(patch_, share)),
                   c = on(p.side, p.piece, p.parameter, height_of(patch_, share + kReachUp));
      const Space3 along = (c - a).normalized(), bend = c + a - 2.0 * b;
      most = std::max(most, (bend - along * bend.dot(along)).norm());
    }
    const double aim = *std::min_element(aims.front().begin(), aims.front().end());
    return std::sqrt(most / (kReachUp * kReachUp) / (8.0 * aim));
  }

  /// The place of an edge's end on its own surface.
  [[nodiscard]] Place end_of(std::size_t edge, bool at_end) const {
    const HalfEdge& e = g_.edges_[g_.edge_of_[edge]];
    const int side = g_.middles_[edge].side;
    return {side, e.piece, (side > 0) == at_end ? e.to : e.from};
  }

  [[nodiscard]] NetPoint net_point(std::size_t edge, bool at_end, double share) const {
    const std::size_t n = net_.size(), wrapped = edge % n;
    const double z = height_of(patch_, share);
    NetPoint result;
    if (on_land(wrapped)) {
      const std::size_t column = edge + (at_end ? 1 : 0);
      const Point p = g_.at(g_.points_[column % n], static_cast<int>(column / n) % g_.teeth_, z);
      result.at = Space3(p.data());
      result.normal = Space3(p[0], p[1], 0.0).normalized();
      return result;
    }
    const Place here = end_of(wrapped, at_end), there = end_of(wrapped, !at_end);
    const double near = std::lerp(here.parameter, there.parameter, kNear);
    const double up = share > 0.5 ? -kNear : kNear;
    result.at = on(here.side, here.piece, here.parameter, z);
    const Space3 along = on(here.side, here.piece, near, z) - result.at;
    const Space3 upwards =
        on(here.side, here.piece, here.parameter, height_of(patch_, share + up)) - result.at;
    result.normal = (along.cross(upwards) * ((up > 0.0) == at_end ? -1.0 : 1.0)).normalized();
    return result;
  }

  struct At {
    double parameter = 0.0, z = 0.0;
    Space3 point = Space3::Zero();
  };

  /// The point of the surface over the share of a facet's edge.
  [[nodiscard]] Space3 over_edge(const Place& surface, const At& p, const At& q,
                                 double share) const {
    const Space3 chord = q.point - p.point;
    const double length2 = chord.squaredNorm();
    double at = share;
    Space3 found;
    for (int i = 0; i < 4; ++i) {
      found = on(surface.side, surface.piece, std::lerp(p.parameter, q.parameter, at),
                 std::lerp(p.z, q.z, at));
      const double off = (found - p.point).dot(chord) / length2 - share;
      if (!(std::abs(off) > kOffMiddle)) break;
      at = std::clamp(at - off, 0.0, 1.0);
    }
    return found;
  }

  void measure(const NetPatch& net, Aims& errors) const {
    const std::size_t n = net_.size();
    for (std::size_t t = 0; t < net.facets.size(); ++t) {
      const auto& facet = net.facets[t];
      const int first = std::min({facet[0].column, facet[1].column, facet[2].column});
      const std::size_t edge = static_cast<std::size_t>(first) % n;
      const Place& surface = g_.middles_[edge];
      std::array<At, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto column = static_cast<std::size_t>(facet[k].column);
        const auto& rows = net.inner[column % n];
        const auto row = static_cast<std::size_t>(facet[k].row);
        const double share = row == 0 ? 0.0 : row > rows.size() ? 1.0 : rows[row - 1];
        const bool at_end = net.region[t] != net_[column % n].region;
        const Place place = on_land(edge) ? g_.points_[column % n]
                                          : end_of((at_end ? column + n - 1 : column) % n, at_end);
        corner[k] = {place.parameter, height_of(patch_, share), Space3::Zero()};
        const std::size_t tooth = on_land(edge) ? column / n : 0;
        const Point p = g_.at(place, static_cast<int>(tooth) % g_.teeth_, corner[k].z);
        corner[k].point = Space3(p.data());
      }
      const double error =
          on_land(edge) ? land_error(corner) : facet_error(surface, corner, net_[edge].developable);
      const auto [low_sample, high_sample] = samples(
          surface.piece, std::min({corner[0].parameter, corner[1].parameter, corner[2].parameter}),
          std::max({corner[0].parameter, corner[1].parameter, corner[2].parameter}));
      for (std::size_t k = low_sample; k < high_sample; ++k)
        errors[surface.piece][k] = std::max(errors[surface.piece][k], error);
    }
  }

  [[nodiscard]] double facet_error(const Place& surface, const std::array<At, 3>& corner,
                                   bool in_strip) const {
    const Space3 normal =
        (corner[1].point - corner[0].point).cross(corner[2].point - corner[0].point).normalized();
    std::array<double, 3> middle{};
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const At &p = corner[k], &q = corner[(k + 1) % 3];
      for (const double share : {0.5, 0.25, 0.75}) {
        if (share != 0.5 && !in_strip)
          break;  // only strips have edges that may bend in one half alone
        const Space3 away = over_edge(surface, p, q, share) - p.point;
        const double off = away.dot(normal);
        // an end face's edge has the surface on one side only
        if (share == 0.5 && p.z == q.z) {
          const Space3 chord = (q.point - p.point).normalized();
          largest = std::max(largest, (away - chord * away.dot(chord)).norm());
        }
        if (share == 0.5) middle[k] = off;
        largest = std::max(largest, std::abs(off));
      }
    }
    return std::max(largest, triangle_error(middle[0], middle[1], middle[2]));
  }

  /// Lands are cylinders about the axis, cones where a chamfer lowers tips.
  static double land_error(const std::array<At, 3>& corner) {
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Space3 &p = corner[k].point, &q = corner[(k + 1) % 3].point;
      const double radius = 0.5 * (p.head<2>().norm() + q.head<2>().norm());
      largest = std::max(largest, std::abs(radius - (0.5 * (p + q)).head<2>().norm()));
    }
    return largest;
  }

  ToothingGrid& g_;
  double tolerance_;
  std::vector<Panel> panels_;
  std::vector<NetEdge> net_;
  std::vector<std::array<SurfaceForm, kHeights.size()>> forms_;  ///< by edge
  std::size_t patch_ = 0;
};

bool ToothingGrid::try_surface_net(double tolerance_mm) {
  edges_.clear();
  start_columns(tolerance_mm);
  start_layers(tolerance_mm);
  const double section_error_mm = section_error_mm_;
  if (!SurfaceNet(*this, tolerance_mm).lay()) {
    patches_.clear();
    return false;
  }
  section_error_mm_ = section_error_mm;
  heights_mm_ = breaks_mm_;
  facet_error_mm_ = tolerance_mm / kMeasured;
  return true;
}

}  // namespace trueflank
