// SPDX-License-Identifier: GPL-3.0-or-later
//
// Modified teeth as nets, patch by patch. Source: docs/theory/helical-facets.md.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/units.h"
#include "trueflank/solid/shape/surface_net.h"

namespace trueflank {
namespace {

/// Rounds of finer columns and steps where facets do not keep the tolerance.
constexpr int kSurfaceRounds = 24;
/// The same where teeth differ: what took more of them did not get there, or took longer than rows and columns.
constexpr int kRoundsOfTeethThatDiffer = 16;
/// More facets than so many times the first round's: something bends that columns do not mend.
constexpr double kWorthWhile = 4.0;
/// From this round on the neighbours of what is too coarse are laid finer, too.
constexpr int kAlone = 4;
/// A net is measured, not bounded: what its error is taken for.
constexpr double kMeasured = 0.99;
/// Strips whose generators wander up by more than this share of a step have them in sight.
constexpr double kUpright = 0.5;
/// Strips no wider than so many chords are joined column to column.
constexpr double kOneChord = 1.02;
/// Steps up the face and about the axis at which a displacement is looked at, and what upright
/// lines of a patch may have of the tolerance.
constexpr int kBendSteps = 48, kBendAngles = 16;
constexpr double kShareOfBend = 0.3;
/// Rows that are nearer, as a share of the patch, are one.
constexpr double kSameHeightOfRows = 1e-9;
/// A column's vertices stand no nearer to a break than this share of a step.
constexpr double kNearBreak = 0.03;
/// Of an edge, where its normals are found.
constexpr double kNear = 1e-3;

/// Of a column where rows of so many strips on either side end, and that needs so many parts.
std::vector<double> heights_between(int strips, int other, int parts) {
  std::vector<double> heights;
  const auto add = [&](int of) {
    for (int k = 1; k < of; ++k) heights.push_back(static_cast<double>(k) / of);
  };
  if (parts > std::max(strips, other)) {
    const int both = std::lcm(strips, other);
    add((parts + both - 1) / both * both);
    return heights;
  }
  add(strips), add(other);
  std::sort(heights.begin(), heights.end());
  const auto same = [](double a, double b) { return b - a < kSameHeightOfRows; };
  heights.erase(std::unique(heights.begin(), heights.end(), same), heights.end());
  return heights;
}

/// Neighbours of what is too coarse.
template <class Aims>
void spread_to_neighbours(Aims& errors) {
  for (auto& piece : errors) {
    const auto before = piece;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const std::size_t other : {k > 0 ? k - 1 : k, std::min(k + 1, piece.size() - 1)})
        piece[k] = std::max(piece[k], before[other]);
  }
}

}  // namespace

ToothingGrid::SurfaceNet::SurfaceNet(ToothingGrid& grid, double tolerance_mm, Chamfers chamfers)
    : g_(grid),
      tolerance_(tolerance_mm),
      chamfers_(chamfers),
      teeth_(grid.some_teeth()),
      unmoved_(grid.toothing_),
      pieces_(grid.toothing_.profile->pieces().size()) {
  unmoved_.displacement = nullptr;
  aims_.resize(patch_count() * pieces_);
  for (auto& piece : aims_) piece.fill(tolerance_);
  find_panels();
}

bool ToothingGrid::SurfaceNet::lay(double most_facets) {
  double first_facets = 0.0;
  std::vector<int> measured = teeth_,
                   all(static_cast<std::size_t>(g_.teeth_alike_ ? 1 : g_.teeth_));
  std::iota(all.begin(), all.end(), 0);
  const int rounds = g_.teeth_alike_ ? kSurfaceRounds : kRoundsOfTeethThatDiffer;
  for (int round = 0; round < rounds; ++round) {
    round_ = round;
    spread();
    net_ = g_.net_edges();
    Aims errors(aims_.size(), std::array<double, kSamples>{});
    g_.patches_.clear();
    double facets = 0.0;
    for (patch_ = 0; patch_ < patch_count(); ++patch_) {
      find_regions();
      join_regions();
      const NetSurface surface = [this](int edge, bool at_end, double height) {
        return net_point(static_cast<std::size_t>(edge), at_end, height);
      };
      g_.patches_.push_back(net_patch(net_, inner_rows(), g_.patch_turn_rad(patch_), surface,
                                      {row_columns(patch_), row_columns(patch_ + 1), tolerance_}));
      for (const int tooth : measured) measure(g_.patches_.back(), tooth, errors);
      facets += static_cast<double>(g_.patches_.back().facets.size());
    }
    if (facets > most_facets) return false;
    if (round >= kAlone) spread_to_neighbours(errors);
    if (!tighten(aims_, errors, tolerance_)) {
      if (measured.size() == all.size()) return true;
      measured = all;  // some did for the rounds before
    }
    if (round == 0) first_facets = facets;
    if (facets > kWorthWhile * first_facets) return false;
  }
  return false;
}

std::pair<std::size_t, std::size_t> ToothingGrid::SurfaceNet::samples(std::size_t piece, double a,
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

double ToothingGrid::SurfaceNet::aim_between(std::size_t patch, std::size_t piece, double a,
                                             double b) const {
  const auto [from, to] = samples(piece, a, b);
  const auto& aims = aims_[aims_of(patch, piece)];
  return *std::min_element(aims.begin() + static_cast<std::ptrdiff_t>(from),
                           aims.begin() + static_cast<std::ptrdiff_t>(to));
}

// -------------------------------------------------------------- regions

/// Of the patch: not the columns between posts.
bool ToothingGrid::SurfaceNet::is_post(std::size_t column) const {
  const HalfEdge* half = g_.begins_at(column);
  return half != nullptr && ((half->posts >> patch_) & 1U) != 0;
}

std::vector<bool> ToothingGrid::SurfaceNet::row_columns(std::size_t row) const {
  std::vector<bool> result;
  for (std::size_t i = 0; i < g_.points_.size(); ++i) result.push_back(g_.is_on_row(i, row));
  return result;
}

/// Regions of a patch are lands and what lies between two posts.
void ToothingGrid::SurfaceNet::find_regions() {
  const std::size_t n = net_.size();
  const auto same_surface = [&](std::size_t a, std::size_t b) {
    const Place &p = g_.middles_[a], &q = g_.middles_[b];
    return p.piece == q.piece && (on_land(a) || p.side == q.side);
  };
  net_[0].region = 0;
  for (std::size_t i = 1; i < n; ++i)
    net_[i].region = net_[i - 1].region + (!same_surface(i - 1, i) || is_post(i) ? 1 : 0);
  if (same_surface(n - 1, 0) && net_.back().region > 0) {
    const int last = net_.back().region;
    for (NetEdge& e : net_)
      if (e.region == last) e.region = 0;
  }
}

bool ToothingGrid::SurfaceNet::is_flank(std::size_t edge) const {
  return g_.toothing_.profile->pieces()[g_.middles_[edge].piece].kind == PieceKind::kInvolute;
}
bool ToothingGrid::SurfaceNet::on_land(std::size_t edge) const {
  return is_land(g_.toothing_.profile->pieces()[g_.middles_[edge].piece].kind);
}

const ToothingGrid::SurfaceNet::Panel& ToothingGrid::SurfaceNet::panel_of(std::size_t edge) const {
  const Place& p = g_.middles_[edge];
  const auto found = std::find_if(panels_.begin(), panels_.end(), [&](const Panel& panel) {
    return panel.piece == p.piece && (p.parameter - panel.from) * (p.parameter - panel.to) <= 0.0;
  });
  return found == panels_.end() ? panels_.front() : *found;
}

/// The first edge behind an edge's region.
std::size_t ToothingGrid::SurfaceNet::region_end(std::size_t edge) const {
  std::size_t end = edge + 1;
  while (end < net_.size() && net_[end].region == net_[edge].region) ++end;
  return end;
}

/// The parameters between which some edges lie, those of a region of one side.
std::pair<double, double> ToothingGrid::SurfaceNet::span_of(std::size_t from,
                                                            std::size_t to) const {
  const HalfEdge &a = g_.edges_[g_.edge_of_[from]], &b = g_.edges_[g_.edge_of_[to - 1]];
  return g_.middles_[from].side > 0 ? std::pair(a.from, b.to) : std::pair(b.from, a.to);
}

/// How the facets of each region are joined.
void ToothingGrid::SurfaceNet::join_regions() {
  for (std::size_t i = 0; i < net_.size();) {
    const std::size_t end = region_end(i);
    const bool flank = is_flank(i), land = on_land(i);
    bool developable = flank || land, across = false;
    const bool in_chamfer = is_chamfer(patch_);
    int strips = 1;
    if (!land) {
      const Panel& panel = panel_of(i);
      across = panel.patches[patch_].across;
      const auto [from, to] = span_of(i, end);
      if (const Stretch* stretch = stretch_of(i, from, to)) strips = stretch->strips;
      const double room = 8.0 * aim_between(patch_, panel.piece, from, to);
      const auto share = [&](double parameter) {
        return kCells * (parameter - panel.from) / (panel.to - panel.from);
      };
      const double width = share(to) - share(from);
      const auto cell = static_cast<std::size_t>(
          std::clamp(share(0.5 * (from + to)), 0.0, static_cast<double>(kCells) - 1.0));
      const std::size_t side = g_.middles_[i].side < 0 ? 0 : kHeights.size();
      const SurfaceForm& bent = panel.patches[patch_].forms[cell][side + 1];
      const bool alone = bent.level * width * width <= kOneChord * kOneChord * room;
      const bool upright =
          std::abs(bent.mixed) * width <= kUpright * std::sqrt(std::abs(bent.along) * room);
      if (alone && upright) developable = false;
    }
    for (; i < end; ++i) {
      net_[i].developable = developable, net_[i].across = across;
      net_[i].strips = strips, net_[i].in_chamfer = in_chamfer;
    }
  }
}

// -------------------------------------------------------------- vertices of posts

/// Steps that the columns at the ends of a region ask for.
double ToothingGrid::SurfaceNet::steps_of(std::size_t from, std::size_t to) const {
  const Panel& panel = panel_of(from);
  const Crossing& crossing = panel.patches[patch_];
  const auto [begin, end] = span_of(from, to);
  const double room = 8.0 * aim_between(patch_, panel.piece, begin, end);
  const auto share = [&](double parameter) {
    return kCells * (parameter - panel.from) / (panel.to - panel.from);
  };
  if (crossing.across) return net_[from].strips;
  if (crossing.bare) return bare_steps(crossing, begin == panel.from ? 0 : kCells - 1, room);
  const double width = share(end) - share(begin);
  const auto cell_at = [](double cells) {
    return static_cast<std::size_t>(std::clamp(cells, 0.0, kCells - 1.0));
  };
  std::size_t first = cell_at(share(begin) + 1e-6), last = cell_at(share(end) - 1e-6);
  const std::size_t centre = cell_at(0.5 * (share(begin) + share(end)));
  // where posts have many steps, those of the middle do: rounding makes up for it
  if (std::abs(crossing.forms[centre][1].along) > room) {
    first = std::min(centre, cell_at(share(begin) + 0.5));
    last = std::max(centre, cell_at(share(end) - 0.5));
  }
  const std::size_t side = g_.middles_[from].side < 0 ? 0 : kHeights.size();
  double steps = 1.0;
  for (std::size_t c = first; c <= last; ++c)
    for (std::size_t k = side; k < crossing.forms[c].size(); ++k) {
      if (k % (2 * kHeights.size()) / kHeights.size() != side / kHeights.size()) continue;
      SurfaceForm f = crossing.forms[c][k];
      f.across *= width * width, f.mixed *= width;
      steps = std::max(steps, f.is_dome(room) || crossing.saddle ? crossing.rows : f.steps(room));
      // the diagonal that leans the wrong way
      if (!net_[from].developable && !crossing.saddle && f.across * f.along < 0.0) {
        const double whole = room + std::abs(f.across), mixed = std::abs(f.mixed);
        steps =
            std::max(steps, (mixed + std::sqrt(mixed * mixed + std::abs(f.along) * whole)) / whole);
      }
    }
  return steps;
}

/// By its own helix, and not more than twice what an edge across may span.
double ToothingGrid::SurfaceNet::bare_steps(const Crossing& crossing, std::size_t cell,
                                            double room) {
  double own = 0.0, mean = 0.0;
  for (std::size_t k = 0; k < crossing.forms[cell].size(); ++k) {
    own = std::max(own, std::abs(crossing.forms[cell][k].along));
    mean = std::max(
        mean, 0.5 * std::abs(crossing.forms.front()[k].along + crossing.forms.back()[k].along));
  }
  return std::sqrt(std::max(own, 0.25 * mean) / room);
}

/// Heights of the vertices on each column of the patch, as shares.
std::vector<std::vector<double>> ToothingGrid::SurfaceNet::inner_rows() const {
  const std::size_t n = net_.size();
  std::vector<int> parts(n, 1);
  const auto ask = [&](std::size_t column, double demand) {
    int& asked = parts[column % n];
    asked = std::max(asked, whole_parts(demand));
  };
  std::vector<bool> inside(n, false);  // of a region
  for (std::size_t i = 0; i < n; ++i) inside[i] = net_[(i + n - 1) % n].region == net_[i].region;
  for (std::size_t i = 0; i < n;) {
    const std::size_t end = region_end(i);
    if (on_land(i)) {
      if (!inside[i]) ask(i, ridge(i));
      if (!inside[end % n]) ask(end, ridge(end));
    } else if (net_[i].developable) {
      const std::size_t after = std::min(i + 1, end), before = std::max(i, end - 1);
      ask(i, steps_of(i, after));
      ask(end, steps_of(before, end));
    } else {
      const double steps = steps_of(i, end);
      ask(i, steps), ask(end, steps);
    }
    i = end;
  }
  const std::vector<double> shifts = shifts_of_columns();
  std::vector<std::vector<double>> inner(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int strips = net_[i].strips, before = net_[(i + n - 1) % n].strips;
    if (inside[i]) {
      for (int k = 1; k < strips; ++k)
        if (is_on_level(i, k)) inner[i].push_back(static_cast<double>(k) / strips);
      continue;
    }
    if (strips > 1 || before > 1) {
      inner[i] = heights_between(strips, before, parts[i]);
      continue;
    }
    const double shift = parts[i] > 1 ? shifts[i] : 0.0;
    for (int k = 0; k <= parts[i]; ++k) {
      const double step = k + shift;
      if (step > kNearBreak && step < parts[i] - kNearBreak) inner[i].push_back(step / parts[i]);
    }
  }
  return inner;
}

/// By column, by how many steps its vertices are shifted. On domes half a step where they stand
/// between its neighbour's, seen along the ways up that turn the normal least: isosceles triangles.
/// Counted from the tip on either side.
std::vector<double> ToothingGrid::SurfaceNet::shifts_of_columns() const {
  const std::size_t n = net_.size(), m = g_.edges_.size();
  std::vector<double> shifts(n, 0.0);
  for (const bool down : {false, true}) {
    double phase = 0.0, shift = 0.0;
    const Panel* before = nullptr;
    for (std::size_t half = 0; half < m; ++half) {
      const std::size_t edge = edge_of_half(half, down);
      const Panel* panel = on_land(edge) ? nullptr : &panel_of(edge);
      const bool begins = panel != before;
      before = panel;
      if (panel == nullptr || !panel->patches[patch_].dome) {
        phase = shift = 0.0;
        if (panel != nullptr && begins && panel->patches[patch_].saddle)
          shift_on_saddle(half, down, shifts);
        continue;
      }
      const HalfEdge& e = g_.edges_[half];
      const SurfaceForm& bent = form_between(*panel, e.from, e.to, down);
      if (bent.along != 0.0) shift -= bent.mixed * cells_of(*panel, e.from, e.to) / bent.along;
      if (half + 1 < m && ((g_.edges_[half + 1].posts >> patch_) & 1U) == 0) continue;
      phase += shift * panel->patches[patch_].rows + 0.5;
      phase -= std::floor(phase);
      shift = 0.0;
      const bool nearer = std::abs(phase - 0.5) < 0.25;
      phase = nearer ? 0.5 : 0.0;
      shifts[(down ? edge + 1 : edge) % n] = phase;
    }
  }
  return shifts;
}

/// Of a saddle: each column's vertices stand where both edges to each of the one before keep the
/// tolerance. What is missing to a whole step at the panel's end is shared out.
void ToothingGrid::SurfaceNet::shift_on_saddle(std::size_t first, bool down,
                                               std::vector<double>& shifts) const {
  const Panel& panel = panel_of(edge_of_half(first, down));
  const int rows = panel.patches[patch_].rows;
  std::vector<std::size_t> columns;
  std::vector<double> phases;
  double phase = 0.0, from = panel.from;
  for (std::size_t half = first; half < g_.edges_.size(); ++half) {
    const HalfEdge& e = g_.edges_[half];
    const bool ends = e.to == panel.to;
    if (!ends && ((g_.edges_[half + 1].posts >> patch_) & 1U) == 0) continue;
    SurfaceForm bent = form_between(panel, from, e.to, down);
    const double width = cells_of(panel, from, e.to);
    bent.across *= width * width, bent.mixed *= width;
    phase += bent.way_to_next(rows) * rows + 0.5;
    phases.push_back(phase);
    const std::size_t edge = edge_of_half(half, down);
    columns.push_back((down ? edge + 1 : edge) % net_.size());
    from = e.to;
    if (ends) break;
  }
  const double missing = std::round(phase) - phase;
  for (std::size_t k = 0; k + 1 < columns.size(); ++k) {
    const double at =
        phases[k] + missing * static_cast<double>(k + 1) / static_cast<double>(columns.size());
    shifts[columns[k]] = at - std::floor(at);
  }
}

/// Whether a column within a stretch has a vertex on the row above so many of its strips.
bool ToothingGrid::SurfaceNet::is_on_level(std::size_t column, int below) const {
  const HalfEdge* half = g_.begins_at(column);
  const Stretch* stretch = half == nullptr ? nullptr : stretch_of(column, half->from, half->to);
  if (stretch == nullptr) return false;
  const std::size_t level = stretch->first_level + static_cast<std::size_t>(below) - 1;
  return ((half->levels >> level) & 1U) != 0;
}

/// Steps of a land's border: the chords of its column.
double ToothingGrid::SurfaceNet::ridge(std::size_t column) const {
  const Place& p = g_.points_[column % g_.points_.size()];
  double most = 0.0;
  for (const int tooth : teeth_)
    for (const double share : kHeights) {
      const Space3 a = on(tooth, p, height_of(patch_, share - kReachUp)),
                   b = on(tooth, p, height_of(patch_, share)),
                   c = on(tooth, p, height_of(patch_, share + kReachUp));
      const Space3 along = (c - a).normalized(), bend = c + a - 2.0 * b;
      most = std::max(most, (bend - along * bend.dot(along)).norm());
    }
  double aim = tolerance_;
  for (const std::size_t piece : {std::size_t{0}, pieces_ - 1}) {
    const auto& aims = aims_[aims_of(patch_, piece)];
    if (piece == 0 || g_.toothing_.displacement != nullptr)
      aim = std::min(aim, *std::min_element(aims.begin(), aims.end()));
  }
  return std::sqrt(most / (kReachUp * kReachUp) / (8.0 * aim));
}

/// The place of an edge's end on its own surface.
ToothingGrid::Place ToothingGrid::SurfaceNet::end_of(std::size_t edge, bool at_end) const {
  const HalfEdge& e = g_.edges_[g_.edge_of_[edge]];
  const int side = g_.middles_[edge].side;
  return {side, e.piece, (side > 0) == at_end ? e.to : e.from};
}

NetPoint ToothingGrid::SurfaceNet::net_point(std::size_t edge, bool at_end, double share) const {
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
  result.at = on(0, here, z);
  const Space3 along = on(0, {here.side, here.piece, near}, z) - result.at;
  const Space3 upwards = on(0, here, height_of(patch_, share + up)) - result.at;
  result.normal = (along.cross(upwards) * ((up > 0.0) == at_end ? -1.0 : 1.0)).normalized();
  return result;
}

/// Where a displacement bends upright lines, patches are as low as keeps lands developable.
void ToothingGrid::add_bend_breaks(double tolerance_mm) {
  if (toothing_.displacement == nullptr) return;
  const double low = breaks_mm_.front(), high = breaks_mm_.back(), step = (high - low) / kBendSteps;
  const auto moved = [&](double radius, double angle, double z) {
    const std::array<double, 3> p{radius * std::cos(angle), radius * std::sin(angle), z};
    return Eigen::Vector3d((*toothing_.displacement)(p).data());
  };
  ColumnDemand layers(low, high);
  for (int k = 0; k < kBendSteps; ++k) {
    const double z = low + (k + 0.5) * step;
    double most = 1e-12;
    for (const double radius :
         {toothing_.profile->tip_radius_mm(), toothing_.profile->root_radius_mm()})
      for (int i = 0; i < kBendAngles; ++i) {
        const double angle = kTwoPi * i / kBendAngles;
        const Eigen::Vector3d bend = moved(radius, angle, z - 0.5 * step) +
                                     moved(radius, angle, z + 0.5 * step) -
                                     2.0 * moved(radius, angle, z);
        most = std::max(most, 4.0 * bend.head<2>().norm());
      }
    layers.add(std::sqrt(most / (8.0 * kShareOfBend * tolerance_mm)));
  }
  const int count = std::min(whole_parts(layers.whole()), static_cast<int>(kMostBreaks) / 2);
  const double shortest = 0.25 * (high - low) / kBendSteps;
  std::vector<double> breaks = breaks_mm_;
  for (int k = 1; k < count; ++k) {
    const double z = layers.between(low, high, k, count);
    if (std::all_of(breaks.begin(), breaks.end(),
                    [&](double b) { return std::abs(b - z) > shortest; }))
      breaks.push_back(z);
  }
  std::sort(breaks.begin(), breaks.end());
  breaks_mm_ = breaks;
}

bool ToothingGrid::try_surface_net(double tolerance_mm, double most_facets) {
  edges_.clear();
  breaks_in_chamfers_ = FlankBreaks::InChamfers::kFollowed;
  start_columns(tolerance_mm);
  start_layers(tolerance_mm);
  add_bend_breaks(tolerance_mm);
  const double section_error_mm = section_error_mm_;
  const bool may_be_net = breaks_mm_.size() <= kMostBreaks;
  bool laid = may_be_net && SurfaceNet(*this, tolerance_mm).lay(most_facets);
  breaks_in_chamfers_ = FlankBreaks::InChamfers::kLeft;
  if (!laid && may_be_net && toothing_.edge_chamfer_mm > 0.0) {
    edges_.clear();
    start_columns(tolerance_mm);
    laid = SurfaceNet(*this, tolerance_mm, SurfaceNet::Chamfers::kPosts).lay(most_facets);
  }
  if (!laid) {
    patches_.clear();
    return false;
  }
  section_error_mm_ = section_error_mm;
  heights_mm_ = breaks_mm_;
  facet_error_mm_ = tolerance_mm / kMeasured;
  return true;
}

}  // namespace trueflank
