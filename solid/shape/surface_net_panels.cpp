// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the surface of modified teeth asks for: columns, rows and chords, by second differences.
#include <algorithm>
#include <cmath>

#include "trueflank/solid/shape/surface_net.h"

namespace trueflank {
namespace {

/// Domes bent by less than this share of the room have facets from break to break as wide as their
/// chords.
constexpr double kAlmostWhole = 0.75;

/// Flanks that are saddles have shifted rows where so much of their bend is their twist, and where
/// so many columns stand that what is lost at the joints does not count.
constexpr double kTwistOfSaddle = 0.5, kFewestOnSaddle = 6.0;

/// Vertices that one step asks for of either break where facets reach from one to the other.
double vertices_across(SurfaceForm form, double room_mm, int strips) {
  form.mixed /= strips, form.along /= strips * strips;
  const double bent = std::max(std::abs(form.across), 1e-6 * room_mm), q = form.left_up(room_mm);
  const double chords = std::sqrt(bent / room_mm);
  return -q <= kSlackOfSaddles ? chords : chords / (std::sqrt(1.0 - q) - std::sqrt(-q - 1.0));
}

/// How far vertices of one row of a strip stand from the middles of the other's: halfway between
/// the steepest and the flattest edge that keep the tolerance.
double way_between(const SurfaceForm& form, double room_mm) {
  const double bent = std::max(std::abs(form.across), 1e-6 * room_mm), m = -form.left_up(room_mm);
  const double chord = std::sqrt(room_mm / bent);
  const double lean = form.mixed / (form.across < 0.0 ? -bent : bent);
  const double centre = m > kSlackOfSaddles ? 0.5 * (std::sqrt(m + 1.0) + std::sqrt(m - 1.0))
                                            : std::min(std::sqrt(std::max(m, 0.0)),
                                                       std::sqrt(std::max(m + 1.0, 0.25)) - 0.5);
  return std::copysign(chord * centre, lean) - lean;
}

}  // namespace

SurfaceForm ToothingGrid::SurfaceNet::form(int tooth, int side, std::size_t piece, double from,
                                           double to, std::size_t patch, double share) const {
  const double middle = 0.5 * (from + to);
  const double z0 = height_of(patch, share - kReachUp), z = height_of(patch, share),
               z1 = height_of(patch, share + kReachUp);
  const auto x = [&](double parameter, double height) {
    return on(tooth, {side, piece, parameter}, height);
  };
  return surface_form(
      {x(from, z0), x(from, z), x(middle, z0), x(middle, z), x(middle, z1), x(to, z), x(to, z1)},
      2.0, 1.0 / kReachUp);
}

void ToothingGrid::SurfaceNet::find_panels() {
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
void ToothingGrid::SurfaceNet::measure_land(Panel& panel) const {
  const Curve& curve = g_.toothing_.profile->pieces()[panel.piece].curve;
  const auto spread_of = [](const Point2& a, const Point2& b) {
    const double angle = std::atan2(cross(a, b), a.dot(b));
    return angle * angle * a.norm();
  };
  const double plain = spread_of(point_at(curve, curve.begin), point_at(curve, curve.end));
  for (const int tooth : teeth_)
    for (const double z : g_.breaks_mm_)
      for (const int side : {-1, 1}) {
        const Space3 a = on(tooth, {side, panel.piece, curve.begin}, z),
                     b = on(tooth, {side, panel.piece, curve.end}, z);
        if (plain > 0.0)
          panel.wider = std::max(panel.wider, spread_of(a.head<2>(), b.head<2>()) / plain);
      }
}

void ToothingGrid::SurfaceNet::look_at(Panel& panel) const {
  const double room = 8.0 * tolerance_;
  panel.patches.resize(patch_count());
  for (std::size_t patch = 0; patch < patch_count(); ++patch) {
    Crossing& crossing = panel.patches[patch];
    for (std::size_t c = 0; c < kCells; ++c) {
      const auto cell = static_cast<double>(c);
      for (const int tooth : teeth_)
        for (const int side : {-1, 1})
          for (const double share : kHeights) {
            crossing.forms[c].push_back(form(tooth, side, panel.piece, cell_edge(panel, cell),
                                             cell_edge(panel, cell + 1.0), patch, share));
            crossing.dome = crossing.dome || crossing.forms[c].back().is_dome(room);
          }
    }
  }
}

double ToothingGrid::SurfaceNet::room_of(const Panel& panel, std::size_t patch,
                                         std::size_t cell) const {
  const auto c = static_cast<double>(cell);
  return 8.0 * aim_between(patch, panel.piece, cell_edge(panel, c), cell_edge(panel, c + 1.0));
}

/// Posts that a patch asks for with so many rows.
ColumnDemand ToothingGrid::SurfaceNet::columns(const Panel& panel, std::size_t patch,
                                               int rows) const {
  ColumnDemand demand(panel.from, panel.to);
  for (std::size_t c = 0; c < kCells; ++c) {
    const double room = room_of(panel, patch, c);
    double most = 1e-9;
    for (const SurfaceForm& form : panel.patches[patch].forms[c]) {
      if (panel.patches[patch].saddle) {
        most = std::max(most, form.columns_of_rows(rows, room));
        continue;
      }
      // where one step up would do, columns stand as chords: steps keep the diagonals right
      const bool low = !form.is_dome(room) && std::abs(form.along) <= room;
      most =
          std::max(most, low ? std::sqrt(std::abs(form.across) / room) : form.columns(rows, room));
    }
    demand.add(most);
  }
  return demand;
}

/// Vertices that a row within or beside a patch asks for.
double ToothingGrid::SurfaceNet::chords_of(const Crossing& crossing, std::size_t cell, double room,
                                           int strips) {
  double most = 1e-9;
  for (const SurfaceForm& form : crossing.forms[cell]) {
    most = std::max(most, std::sqrt(form.level / room));
    if (crossing.across) most = std::max(most, vertices_across(form, room, strips));
  }
  return most;
}

/// Vertices that the patches beside a break ask for on it.
ColumnDemand ToothingGrid::SurfaceNet::chords(const Panel& panel, std::size_t row) const {
  ColumnDemand demand(panel.from, panel.to);
  for (std::size_t c = 0; c < kCells; ++c) {
    double most = 1e-9;
    for (std::size_t patch = row > 0 ? row - 1 : 0; patch < std::min(row + 1, patch_count());
         ++patch)
      most = std::max(most, chords_of(panel.patches[patch], c, room_of(panel, patch, c)));
    demand.add(most);
  }
  return demand;
}

/// How far a straight line of the surface wanders along the panel from the lower break to the upper
/// one; of two the one that is nearly upright.
double ToothingGrid::SurfaceNet::straight_way(const Panel& panel, std::size_t patch,
                                              double parameter) const {
  const std::size_t cell = cell_of(panel, parameter);
  double cells = 0.0;
  for (const std::size_t k :
       {std::size_t{1}, kHeights.size() + 1}) {  // of both sides, at half height
    const SurfaceForm& f = panel.patches[patch].forms[cell][k];
    const double under = f.mixed * f.mixed - f.across * f.along;
    if (is_chamfer(patch))
      cells += 0.5 * way_between(f, room_of(panel, patch, cell));
    else if (under > 0.0)
      cells -= 0.5 * f.along / (f.mixed + std::copysign(std::sqrt(under), f.mixed));
  }
  return cells * (panel.to - panel.from) / kCells;
}

/// Facets from break to break where no column needs vertices inside; of a dome as many rows as make
/// the fewest facets with the columns they leave.
void ToothingGrid::SurfaceNet::choose_crossing(Panel& panel, std::size_t patch) const {
  Crossing& crossing = panel.patches[patch];
  double along = 0.0, dome = 0.0, saddle = 0.0, left = 0.0, widest = 1e300;
  double gauss = 0.0, twists = 0.0;
  bool all_saddle = true;
  for (std::size_t c = 0; c < kCells; ++c) {
    const double room = room_of(panel, patch, c);
    for (const SurfaceForm& form : crossing.forms[c]) {
      along = std::max(along, std::abs(form.along) / room);
      dome = std::max(dome, form.left_up(room));
      saddle = std::max(saddle, -form.left_up(room));
      left = std::max(left, std::abs(form.left_up(8.0 * tolerance_)));
      all_saddle = all_saddle && form.is_saddle();
      gauss += form.mixed * form.mixed - form.across * form.along;
      twists += form.mixed * form.mixed;
      widest = std::min(widest, form.columns_of_rows(1, room) / std::sqrt(form.level / room));
    }
  }
  crossing.across = along <= 1.0 && dome <= kAlmostWhole;
  crossing.between = crossing.across && saddle > kSlackOfSaddles;
  crossing.rows = 1;
  crossing.bare = false;
  if (is_chamfer(patch)) {
    crossing.bare = panel.flank && !crossing.across && left <= kAlmostWhole;
    crossing.across = crossing.across || !panel.flank;
  }
  const int fewest = whole_parts(std::sqrt(along));
  crossing.saddle = all_saddle && twists > kTwistOfSaddle * gauss && panel.flank &&
                    !crossing.across && !crossing.bare;
  if (crossing.saddle) {
    // columns as far apart as their chords at most
    choose_rows(panel, patch, fewest, std::max(fewest, static_cast<int>(widest)), crossing);
    crossing.saddle = columns(panel, patch, crossing.rows).whole() >= kFewestOnSaddle;
  }
  if (!crossing.saddle && !crossing.dome) crossing.rows = 1;
  if (crossing.saddle) return;
  if (crossing.dome && !crossing.across)
    choose_rows(panel, patch, fewest, 2 * fewest + 1, crossing);
}

/// Of all numbers of rows the one with the fewest facets.
void ToothingGrid::SurfaceNet::choose_rows(const Panel& panel, std::size_t patch, int fewest,
                                           int most, Crossing& crossing) const {
  double least_facets = 1e300;
  for (int rows = fewest; rows <= most; ++rows) {
    const double facets =
        static_cast<double>(whole_parts(columns(panel, patch, rows).whole())) * rows;
    if (facets < least_facets) least_facets = facets, crossing.rows = rows;
  }
}

}  // namespace trueflank
