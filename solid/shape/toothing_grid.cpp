// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/toothing_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/solid/shape/bend_survey.h"

namespace trueflank {
namespace {

using Point3 = Eigen::Vector3d;

/// Parts that an edge is cut into at once: few, as it may bend in one of them alone.
constexpr int kFewParts = 8;
/// Facets are cut for this share of the tolerance: their error is taken from the middles of edges,
/// right to a percent.
constexpr double kAim = 0.985;
/// Rounds of adding columns and rows. Each brings an error to its goal in one step where it is
/// smooth.
constexpr int kRounds = 8;
/// Teeth looked at while columns and rows are found, where all differ; facets are cut on all.
constexpr int kSomeTeeth = 6;
/// An edge whose parameter runs so unevenly that its middle is this share of it away from the
/// chord's.
constexpr double kUneven = 0.02;
/// A break nearer to a vertex than this share of the tolerance is that vertex.
constexpr double kSameVertex = 0.25;

Point3 vector_of(const std::array<double, 3>& p) { return Point3(p.data()); }

/// Distance of a surface point from a chord's middle, square to the chord.
double off_chord(const Point3& from, const Point3& to, const Point3& on_surface, double share) {
  const Point3 along = to - from, away = on_surface - (from + share * along);
  const double length2 = along.squaredNorm();
  if (!(length2 > 0.0)) return away.norm();
  return (away - along * (away.dot(along) / length2)).norm();
}

/// Parameter at which a curve passes the middle of its chord; the middle of the parameters where that is
/// near. It is far from it where an involute starts on its base circle: its way grows with the square of
/// the roll angle.
double middle_of_chord(const Curve& curve, double from, double to) {
  const Point2 a = point_at(curve, from), chord = point_at(curve, to) - a;
  const double half = 0.5 * chord.squaredNorm(), middle = 0.5 * (from + to);
  const auto before = [&](double place) { return (point_at(curve, place) - a).dot(chord) < half; };
  // (nearly all edges are even, and the search asks for thirty points)
  const double surely_near = 0.98 * kUneven * (to - from);
  if (before(middle - surely_near) && !before(middle + surely_near)) return middle;
  const auto [low, high] = sides_of_change(before, from, to, 30);
  const double there = 0.5 * (low + high);
  return std::abs(there - middle) > kUneven * std::abs(to - from) ? there : middle;
}

std::vector<double> sorted_heights(std::vector<double> heights) {
  std::sort(heights.begin(), heights.end());
  heights.erase(
      std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 1e-9; }),
      heights.end());
  return heights;
}

int parts_for(double error_mm, double tolerance_mm, int most = kFewParts) {
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(error_mm / tolerance_mm) - 1e-3)), 2,
                    most);
}

}  // namespace

ToothingGrid::ToothingGrid(const ToothedOutline& outline, std::vector<double> levels_mm,
                           double tolerance_mm, GridKind kind)
    : outline_(&outline), toothing_(outline.toothing()), levels_mm_(std::move(levels_mm)) {
  TRUEFLANK_EXPECTS(tolerance_mm > 0.0 && !levels_mm_.empty());
  teeth_ = toothing_.profile->gear().teeth;
  const bool deviates = toothing_.has_deviation(), moved = toothing_.displacement != nullptr;
  plain_ = !deviates && !moved && toothing_.edge_chamfer_mm == 0.0 && toothing_.bed == nullptr;
  teeth_alike_ = !moved && !(deviates && toothing_.deviation->varies_by_tooth);
  layers_alike_ = !moved && toothing_.edge_chamfer_mm == 0.0 && toothing_.bed == nullptr &&
                  !(deviates && toothing_.deviation->varies_along_face);
  const double aim = kAim * tolerance_mm;
  const bool may_be_net =
      kind != GridKind::kRows && levels_mm_.size() >= 2 && toothing_.bed == nullptr;
  if (plain_)
    lay_plain(aim);
  else if (may_be_net && !teeth_alike_)
    lay_different_teeth(tolerance_mm, aim);
  else if (!may_be_net || !try_surface_net(aim, std::numeric_limits<double>::infinity())) {
    edges_.clear();
    lay_modified(tolerance_mm, aim);
  }
  section_error_mm_ = std::min(section_error_mm_, tolerance_mm);
}

/// A net is then measured on all teeth, so it is to have fewer facets than rows and columns, if these keep
/// the tolerance. It sees no waves shorter than its patches.
void ToothingGrid::lay_different_teeth(double tolerance_mm, double aim_mm) {
  ToothingGrid rows(*outline_, levels_mm_, tolerance_mm, GridKind::kRows);
  const double most = rows.chord_error_mm() > tolerance_mm
                          ? std::numeric_limits<double>::infinity()
                          : 2.0 * static_cast<double>(rows.heights_mm_.size() - 1) *
                                rows.points_per_tooth();
  if (rows.hid_waves_ || !try_surface_net(aim_mm, most)) *this = std::move(rows);
}

void ToothingGrid::lay_plain(double aim_mm) {
  start_columns(aim_mm);
  start_layers(aim_mm);
  if (heights_mm_.size() > breaks_mm_.size()) try_net(aim_mm);
  if (patches_.empty()) cut_in_rounds(aim_mm);
}

std::vector<bool> ToothingGrid::cut_in_rounds(double aim_mm) {
  std::vector<bool> crowded(toothing_.profile->pieces().size(), false);
  for (int round = 0; cut(aim_mm) > aim_mm && round < kRounds; ++round) {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (column_error_mm_[i] > aim_mm) crowded[edges_[i].piece] = true;
    add_where_charged(aim_mm);
  }
  return crowded;
}

ToothPlace ToothingGrid::place_at(const Place& place, int tooth, double z_mm) const {
  return breaks_.drawn(toothing_, {tooth, place.side, place.piece, place.parameter}, z_mm);
}

ToothingGrid::Point ToothingGrid::at(const Place& place, int tooth, double z_mm) const {
  return surface_point(toothing_, place_at(place, tooth, z_mm), z_mm);
}

std::vector<int> ToothingGrid::some_teeth() const {
  std::vector<int> teeth;
  const int count = teeth_alike_ ? 1 : std::min(teeth_, kSomeTeeth);
  for (int i = 0; i < count; ++i) teeth.push_back(i * teeth_ / count);
  return teeth;
}

// -------------------------------------------------------------- columns

void ToothingGrid::start_columns(double tolerance_mm) {
  const HalfToothPolyline half = tessellate(*toothing_.profile, tolerance_mm);
  for (const HalfToothPolyline::Edge& e : half.edges)
    edges_.push_back({static_cast<std::size_t>(e.piece), e.from, e.to});
  vertex_at_tooth_middle_ = half.vertex_at_tooth_middle;
  vertex_at_gap_middle_ = half.vertex_at_gap_middle;
  section_error_mm_ = half.chord_error_mm;
  add_roll_breaks(tolerance_mm);
  find_ends();
  place_columns();
}

void ToothingGrid::find_ends() {
  const auto& pieces = toothing_.profile->pieces();
  // the end of a piece too short for an edge of its own is the half tooth's end all the same
  first_ = {1, edges_.front().piece, edges_.front().from};
  last_ = {1, edges_.back().piece, edges_.back().to};
  if (vertex_at_tooth_middle_) first_ = {1, 0, pieces.front().curve.begin};
  if (vertex_at_gap_middle_) last_ = {1, pieces.size() - 1, pieces.back().curve.end};
}

void ToothingGrid::add_roll_breaks(double tolerance_mm) {
  const double low = levels_mm_.front(), high = levels_mm_.back(),
               same_mm = kSameVertex * tolerance_mm;
  breaks_ = FlankBreaks(
      toothing_, some_teeth(),
      {low, std::lerp(low, high, 0.25), 0.5 * (low + high), std::lerp(low, high, 0.75), high},
      same_mm, breaks_in_chamfers_);
  const std::size_t flank = involute_piece(*toothing_.profile);
  const double r_b = base_radius_mm(toothing_.profile->gear());
  for (std::size_t k = 0; k < breaks_.parameters().size(); ++k) {
    const double angle = breaks_.parameters()[k];
    const auto e = std::find_if(edges_.begin(), edges_.end(), [&](const HalfEdge& edge) {
      return edge.piece == flank && (angle - edge.from) * (angle - edge.to) <= 0.0;
    });
    if (e == edges_.end()) continue;
    const double nearest = std::abs(angle - e->from) < std::abs(angle - e->to) ? e->from : e->to;
    if (std::abs(angle - nearest) * r_b * angle < same_mm) {
      breaks_.move_column(k, nearest);
      continue;
    }
    const HalfEdge rest{e->piece, angle, e->to};
    e->to = angle;
    edges_.insert(e + 1, rest);
  }
}

void ToothingGrid::place_columns() {
  points_.clear(), middles_.clear(), chord_middles_.clear(), edge_of_.clear();
  const auto& pieces = toothing_.profile->pieces();
  const std::size_t m = edges_.size();
  const auto place = [&](std::size_t i, int side) {
    Place p = i == 0 ? first_ : i == m ? last_ : Place{1, edges_[i].piece, edges_[i].from};
    p.side = side;
    return p;
  };
  const auto add = [&](const Place& point, const Place& middle, std::size_t edge) {
    points_.push_back(point);
    middles_.push_back(middle);
    edge_of_.push_back(edge);
  };
  const auto middle = [&](std::size_t edge, int side) {
    return Place{side, edges_[edge].piece, 0.5 * (edges_[edge].from + edges_[edge].to)};
  };
  for (std::size_t i = m; i > 0; --i) add(place(i, -1), middle(i - 1, -1), i - 1);
  if (!vertex_at_tooth_middle_) add(place(0, -1), {1, 0, pieces.front().curve.begin}, 0);
  for (std::size_t i = 0; i < m; ++i) add(place(i, 1), middle(i, 1), i);
  if (!vertex_at_gap_middle_)
    add(place(m, 1), {1, pieces.size() - 1, pieces.back().curve.end}, m - 1);
  std::vector<double> at_chord;
  for (const HalfEdge& e : edges_) at_chord.push_back(middle_of_chord(pieces[e.piece].curve, e.from, e.to));
  for (std::size_t i = 0; i < middles_.size(); ++i) {
    const HalfEdge& e = edges_[edge_of_[i]];
    chord_middles_.push_back(middles_[i]);
    if (middles_[i].parameter == 0.5 * (e.from + e.to))
      chord_middles_.back().parameter = at_chord[edge_of_[i]];
  }
}

std::vector<bool> ToothingGrid::split_columns(const std::vector<double>& error_mm, double tolerance_mm) {
  std::vector<HalfEdge> split;
  std::vector<bool> stay;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const HalfEdge& e = edges_[i];
    const Curve& curve = toothing_.profile->pieces()[e.piece].curve;
    const bool is_short =
        (point_at(curve, e.to) - point_at(curve, e.from)).norm() < kShortestCut * tolerance_mm;
    const int parts =
        error_mm[i] > tolerance_mm && !is_short ? parts_for(error_mm[i], tolerance_mm) : 1;
    const auto part_end = [&](int k) {
      return k == parts ? e.to : e.from + (e.to - e.from) * k / parts;
    };
    for (int k = 0; k < parts; ++k) split.push_back({e.piece, part_end(k), part_end(k + 1)});
    stay.insert(stay.end(), static_cast<std::size_t>(parts), parts == 1);
  }
  const bool added = split.size() > edges_.size();
  edges_ = std::move(split);
  if (added) place_columns();
  return stay;
}

void ToothingGrid::refine_columns(double tolerance_mm) {
  const std::vector<int> teeth = some_teeth();
  std::vector<double> heights{levels_mm_.front()};
  if (!layers_alike_ && heights_mm_.size() > 1)
    for (std::size_t j = 0; j + 1 < heights_mm_.size(); ++j)
      for (const double share : {0.0, 0.5, 1.0})
        heights.push_back(std::lerp(heights_mm_[j], heights_mm_[j + 1], share));
  std::vector<bool> stays(edges_.size(), false);  // looked at before
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> error(edges_.size(), 0.0);
    for (const int tooth : teeth)
      for (const double z : heights)
        for (const int side : {-1, 1})
          for (std::size_t i = 0; i < edges_.size(); ++i)
            if (!stays[i]) error[i] = std::max(error[i], edge_error_mm(edges_[i], side, tooth, z));
    const std::size_t before = edges_.size();
    stays = split_columns(error, tolerance_mm);
    if (edges_.size() == before) return;
  }
}

double ToothingGrid::edge_error_mm(const HalfEdge& e, int side, int tooth, double z_mm) const {
  const Point3 from = vector_of(at({side, e.piece, e.from}, tooth, z_mm));
  const Point3 to = vector_of(at({side, e.piece, e.to}, tooth, z_mm));
  double error = 0.0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Place inside{side, e.piece, std::lerp(e.from, e.to, share)};
    error = std::max(error, off_chord(from, to, vector_of(at(inside, tooth, z_mm)), share));
  }
  return error;
}

// -------------------------------------------------------------- rows

void ToothingGrid::start_layers(double tolerance_mm) {
  const FaceTwist& twist = toothing_.twist;
  std::vector<double> breaks = levels_mm_;
  const auto add = [&](double z) {
    if (z > levels_mm_.front() && z < levels_mm_.back()) breaks.push_back(z);
  };
  if (twist.herringbone) add(0.5 * twist.face_width_mm);
  if (toothing_.edge_chamfer_mm > 0.0) {
    add(toothing_.edge_chamfer_mm);
    add(twist.face_width_mm - toothing_.edge_chamfer_mm);
  }
  if (toothing_.bed != nullptr) add(toothing_.bed_height_mm);
  if (toothing_.has_deviation())
    for (const double z : toothing_.deviation->z_breaks_mm) add(z);
  breaks = sorted_heights(std::move(breaks));
  breaks_mm_ = breaks;
  // a helix of radius r departs from its chord of height h by r (1 - cos(turn h / 2))
  const double radius =
      std::max(toothing_.profile->tip_radius_mm(), toothing_.profile->root_radius_mm());
  const double widest = 2.0 * std::acos(1.0 - std::min(1.0, tolerance_mm / radius));
  heights_mm_ = {breaks.front()};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double height = breaks[i + 1] - breaks[i];
    const int layers = std::max(
        1, static_cast<int>(std::ceil(std::abs(twist.turn_rad_per_mm) * height / widest - 1e-9)));
    for (int k = 1; k < layers; ++k) heights_mm_.push_back(breaks[i] + height * k / layers);
    heights_mm_.push_back(breaks[i + 1]);
  }
}

double ToothingGrid::layer_error_mm(double lower_mm, double upper_mm, int samples) const {
  double error = 0.0;
  for (const int tooth : some_teeth())
    for (const Place& place : points_) {
      const Point3 lower = vector_of(at(place, tooth, lower_mm));
      const Point3 upper = vector_of(at(place, tooth, upper_mm));
      for (int k = 1; k < samples; ++k) {
        const double share = static_cast<double>(k) / samples;
        const Point3 inside = vector_of(at(place, tooth, std::lerp(lower_mm, upper_mm, share)));
        error = std::max(error, off_chord(lower, upper, inside, share));
      }
    }
  return error;
}

void ToothingGrid::refine_layers(double tolerance_mm, int most_parts) {
  if (layers_alike_) return;
  const double tall = 0.1 * toothing_.twist.face_width_mm;
  std::vector<bool> stays(heights_mm_.size(), false);  // the layer above each height: looked at before
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> heights{heights_mm_.front()};
    std::vector<bool> stay;
    for (std::size_t j = 0; j + 1 < heights_mm_.size(); ++j) {
      const double lower = heights_mm_[j], upper = heights_mm_[j + 1];
      const double error =
          stays[j] ? 0.0 : layer_error_mm(lower, upper, upper - lower > tall ? 16 : 4);
      const bool split = error > tolerance_mm && upper - lower > kShortestCut * tolerance_mm;
      const int parts = split ? parts_for(error, tolerance_mm, most_parts) : 1;
      for (int k = 1; k < parts; ++k) heights.push_back(lower + (upper - lower) * k / parts);
      heights.push_back(upper);
      stay.insert(stay.end(), static_cast<std::size_t>(parts), parts == 1);
    }
    const bool done = heights.size() == heights_mm_.size();
    heights_mm_ = std::move(heights);
    stays = std::move(stay);
    if (done) return;
  }
}

// -------------------------------------------------------------- facets

ToothingGrid::ToothRow ToothingGrid::tooth_row(int tooth, double z_mm) const {
  ToothRow row;
  row.points.reserve(points_.size() + 1);
  for (const Place& place : points_) row.points.push_back(at(place, tooth, z_mm));
  row.points.push_back(at(points_.front(), (tooth + 1) % teeth_, z_mm));
  for (std::size_t i = 0; i < middles_.size(); ++i) {
    row.middles.push_back(at(middles_[i], tooth, z_mm));
    row.chord_middles.push_back(is_even(i) ? row.middles.back()
                                           : at(chord_middles_[i], tooth, z_mm));
  }
  return row;
}

double ToothingGrid::cut(double tolerance_mm) {
  const std::size_t layers = heights_mm_.size() - 1, n = points_.size();
  const int teeth = teeth_alike_ ? 1 : teeth_;
  rises_.assign(layers, std::vector<bool>(n * static_cast<std::size_t>(teeth), false));
  column_error_mm_.assign(edges_.size(), 0.0);
  layer_error_mm_.assign(layers, 0.0);
  double largest = 0.0;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    ToothRow lower = tooth_row(tooth, heights_mm_.front()), upper;
    for (std::size_t j = 0; j < layers; ++j) {
      const double z0 = heights_mm_[j], z1 = heights_mm_[j + 1];
      const bool same_as_below =
          j > 0 && layers_alike_ && std::abs((z1 - z0) - (z0 - heights_mm_[j - 1])) < 1e-9 &&
          (section_turn_rad(toothing_.twist, z1) > section_turn_rad(toothing_.twist, z0)) ==
              (section_turn_rad(toothing_.twist, z0) >
               section_turn_rad(toothing_.twist, heights_mm_[j - 1]));
      if (same_as_below) {  // a turned copy
        rises_[j] = rises_[j - 1];
        layer_error_mm_[j] = layer_error_mm_[j - 1];
        continue;
      }
      if (j > 0 && layers_alike_) lower = tooth_row(tooth, z0);
      upper = tooth_row(tooth, z1);
      const ToothRow middle = tooth_row(tooth, 0.5 * (z0 + z1));
      for (std::size_t i = 0; i < n; ++i) {
        const Point3 a = vector_of(lower.points[i]), b = vector_of(lower.points[i + 1]);
        const Point3 c = vector_of(upper.points[i + 1]), d = vector_of(upper.points[i]);
        const auto error_of = [&](const Point3& p, const Point3& q, const Point3& r,
                                  const Point& pq, const Point& qr, const Point& rp) {
          const Point3 normal = (q - p).cross(r - p).normalized();
          return triangle_error((vector_of(pq) - p).dot(normal), (vector_of(qr) - q).dot(normal),
                                (vector_of(rp) - r).dot(normal));
        };
        const Point &ad = middle.points[i], &bc = middle.points[i + 1];
        double rising = 0.0, falling = 0.0;
        const auto look_at = [&](const Point& ab, const Point& cd, const Point& across) {
          rising = std::max(
              {rising, error_of(a, b, c, ab, bc, across), error_of(a, c, d, across, cd, ad)});
          falling = std::max(
              {falling, error_of(a, b, d, ab, across, ad), error_of(b, c, d, bc, cd, across)});
        };
        const Point &ab = lower.middles[i], &cd = upper.middles[i];
        look_at(ab, cd, middle.middles[i]);
        if (!is_even(i))
          look_at(lower.chord_middles[i], upper.chord_middles[i], middle.chord_middles[i]);
        rises_[j][static_cast<std::size_t>(tooth) * n + i] = rising <= falling;
        const double error = std::min(rising, falling);
        largest = std::max(largest, error);
        if (error <= tolerance_mm) continue;
        // charge it to the longer of the two ways across the quadrilateral
        const double along =
            std::max(off_chord(a, b, vector_of(ab), 0.5), off_chord(d, c, vector_of(cd), 0.5));
        const double up =
            std::max(off_chord(a, d, vector_of(ad), 0.5), off_chord(b, c, vector_of(bc), 0.5));
        double& charged = along > up ? column_error_mm_[edge_of_[i]] : layer_error_mm_[j];
        charged = std::max(charged, error);
      }
      std::swap(lower, upper);
    }
  }
  facet_error_mm_ = largest / kAim;
  return largest * (1.0 - 1e-9);
}

void ToothingGrid::add_where_charged(double tolerance_mm) {
  std::vector<double> heights{heights_mm_.front()};
  for (std::size_t j = 0; j + 1 < heights_mm_.size(); ++j) {
    const double z0 = heights_mm_[j], z1 = heights_mm_[j + 1], error = layer_error_mm_[j];
    const bool split = error > tolerance_mm && z1 - z0 > kShortestCut * tolerance_mm;
    const int parts = split ? parts_for(error, tolerance_mm) : 1;
    for (int k = 1; k < parts; ++k) heights.push_back(z0 + (z1 - z0) * k / parts);
    heights.push_back(z1);
  }
  heights_mm_ = std::move(heights);
  split_columns(column_error_mm_, tolerance_mm);
}

bool ToothingGrid::rises(std::size_t layer, int tooth, int point) const {
  const std::size_t first = teeth_alike_ ? 0 : static_cast<std::size_t>(tooth) * points_.size();
  return rises_[layer][first + static_cast<std::size_t>(point)];
}

const ToothingGrid::HalfEdge* ToothingGrid::begins_at(std::size_t column) const {
  const std::size_t n = points_.size(), before = edge_of_[(column + n - 1) % n],
                    after = edge_of_[column];
  return before == after ? nullptr : &edges_[std::max(before, after)];
}

bool ToothingGrid::is_on_row(std::size_t column, std::size_t row) const {
  const HalfEdge* half = begins_at(column);
  return half == nullptr || row >= kMostBreaks || ((half->rows >> row) & 1U) != 0;
}

ToothingGrid::RowPlaces ToothingGrid::row_places(std::size_t row) const {
  RowPlaces result;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    result.place.push_back(result.count);
    if (is_on_row(i, row)) ++result.count;
  }
  return result;
}

std::vector<std::array<double, 3>> ToothingGrid::row(double z_mm) const {
  std::vector<Point> result;
  result.reserve(points_.size() * static_cast<std::size_t>(teeth_));
  const double z = z_mm + outline_->z_lower_mm;
  const auto same = [&](double height) { return std::abs(height - z_mm) < 1e-9; };
  const auto row = static_cast<std::size_t>(
      std::find_if(heights_mm_.begin(), heights_mm_.end(), same) - heights_mm_.begin());
  if (teeth_alike_) {
    std::vector<Point2> tooth;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_on_row(i, row))
        tooth.push_back(section_point(toothing_, place_at(points_[i], 0, z_mm), z_mm));
    const double turn = outline_->rotation_rad + section_turn_rad(toothing_.twist, z_mm);
    for (int k = 0; k < teeth_; ++k) {
      const Point2 direction = unit_vector(turn + kTwoPi * k / teeth_);
      for (const Point2& p : tooth)
        result.push_back({direction.x() * p.x() - direction.y() * p.y(),
                          direction.y() * p.x() + direction.x() * p.y(), z});
    }
    return result;
  }
  for (int k = 0; k < teeth_; ++k)
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_on_row(i, row)) result.push_back(in_part(points_[i], k, z_mm));
  return result;
}

ToothingGrid::Point ToothingGrid::in_part(const Place& place, int tooth, double z_mm) const {
  const Point p = at(place, tooth, z_mm);
  const Point2 turned = rotated({p[0], p[1]}, outline_->rotation_rad);
  return {turned.x(), turned.y(), p[2] + outline_->z_lower_mm};
}

OutlineLoop toothed_section(const ToothedOutline& outline, double z_mm, double tolerance_mm) {
  ToothedOutline flat = outline;
  flat.twist.turn_rad_per_mm = 0.0;
  const ToothingGrid grid(flat, {z_mm}, tolerance_mm);
  OutlineLoop loop;
  for (const auto& p : grid.row(z_mm)) loop.points.push_back({p[0], p[1]});
  loop.teeth = grid.teeth();
  loop.points_per_tooth = grid.points_per_tooth();
  loop.teeth_alike = grid.teeth_alike();
  loop.chord_error_mm = grid.chord_error_mm();
  return loop;
}

}  // namespace trueflank
