// SPDX-License-Identifier: GPL-3.0-or-later
//
// One tooth passes the whole mesh: every point of its counter-clockwise half, at every position,
// against the mate. First on a grid, then the lowest places of every kind are refined on the exact
// curves.
#include "trueflank/check/clearance/tooth_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/scalar_minimum.h"

namespace trueflank {
namespace {

constexpr double kGridStep = 0.05;    // of the module, along the path and along the profile
constexpr double kSagOfGrid = 2e-4;   // of the module: finer where the profile bends
constexpr double kReachMargin = 0.3;  // of the module, beyond the mate's tip circle
constexpr double kFlankStep = 0.1;    // of the module, along the involute
// A valley with a radius of curvature of 0.1 module lies at most 0.003 module below its grid.
constexpr double kRefineBand = 0.01;  // of the module above the lowest grid value
constexpr std::size_t kMostRefined = 24;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();
/// Clearances and angles this near are equal, far above rounding and below what anybody reads.
constexpr double kSame_mm = 1e-9, kSame_rad = 1e-7;

double norm_of(double x, double y) { return std::sqrt(x * x + y * y); }

using Sample = SweepSample;

Sample corner_sample(const Curve& curve, std::size_t piece, double at) {
  return {point_at(curve, at), static_cast<int>(piece), at, at, at};
}

/// The places of one piece, ends included.
void add_samples(const ToothProfile& profile, std::size_t k, std::vector<Sample>& samples) {
  const double m = profile.gear().normal_module_mm;
  const Curve& curve = profile.pieces()[k].curve;
  double length = 0.0;
  Point2 last = curve.start_point();
  constexpr int kRough = 16;
  for (int i = 1; i <= kRough; ++i) {
    const Point2 next = point_at(curve, curve.begin + (curve.end - curve.begin) * i / kRough);
    length += (next - last).norm();
    last = next;
  }
  const double wanted = profile.pieces()[k].kind == PieceKind::kInvolute ? kFlankStep : kGridStep;
  const double sag = chord_error_mm(curve, curve.begin, curve.end);
  const double pieces = std::max(length / (wanted * m), std::sqrt(sag / (kSagOfGrid * m)));
  const int n = std::clamp(static_cast<int>(std::ceil(pieces)), 2, 400);
  const double step = (curve.end - curve.begin) / n;
  for (int i = 0; i <= n; ++i) {
    const double u = i == n ? curve.end : curve.begin + step * i;
    const double low = i == 0 ? curve.begin : u - step, high = i == n ? curve.end : u + step;
    samples.push_back({point_at(curve, u), static_cast<int>(k), u, low, high});
  }
}

}  // namespace

std::vector<SweepSample> sweep_samples(const ToothProfile& profile) {
  std::vector<Sample> samples;
  const auto& pieces = profile.pieces();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    samples.push_back(corner_sample(pieces[k].curve, k, pieces[k].curve.begin));
    add_samples(profile, k, samples);
  }
  samples.push_back(corner_sample(pieces.back().curve, pieces.size() - 1, pieces.back().curve.end));
  return samples;
}

std::vector<SweepSample> tip_samples(const ToothProfile& profile) {
  std::vector<Sample> samples;
  const auto& pieces = profile.pieces();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Sample begin = corner_sample(pieces[k].curve, k, pieces[k].curve.begin);
    if (std::abs(begin.point.norm() - profile.tip_radius_mm()) < tolerance::kTouch_mm)
      samples.push_back(begin);
    if (pieces[k].kind == PieceKind::kTipRounding || pieces[k].kind == PieceKind::kTrim)
      add_samples(profile, k, samples);
  }
  return samples;
}

namespace {

/// Sweep of one gear's half tooth (the mover) against the other gear (the mate).
class Sweep {
 public:
  /// `mate_turn_rad`: how far the mate is turned out of the centred position.
  Sweep(const GearPair& pair, const GearDistance& mate, bool gear1_moves, double mate_turn_rad)
      : mover_(gear1_moves ? *pair.profile1 : *pair.profile2),
        mate_profile_(gear1_moves ? *pair.profile2 : *pair.profile1),
        mate_(mate),
        internal_(pair.internal()),
        gear1_moves_(gear1_moves),
        mate_turn_(mate_turn_rad),
        distance_(pair.centre_distance_mm) {
    const double z = mover_.gear().teeth, z_mate = mate_profile_.gear().teeth;
    ratio_ = (internal_ ? z : -z) / z_mate;
    positions_ = sweep_grid(mover_, mate_profile_, distance_);
    half_pitch_mate_ = kPi / z_mate;
    // axis of the mate as the mover sees it, and the direction from the mate's axis to the mesh
    axis_ = internal_ && gear1_moves_ ? -distance_ : distance_;
    mate_faces_ = internal_ ? 0.0 : kPi;
  }

  /// How much of the lowest place is asked for.
  struct Wanted {
    double enough_mm = -kUnlimited;  // below it any value will do
    double ample_mm = kUnlimited;    // above it any value will do
  };
  struct Place {
    double clearance = std::numeric_limits<double>::infinity();
    Sample sample{};
    double angle = 0.0;
  };

  /// Of all places of the mover's half tooth.
  [[nodiscard]] Place lowest() const { return lowest(sweep_samples(mover_), {}); }
  [[nodiscard]] bool clears(double least_mm) const {
    const Wanted wanted{.enough_mm = least_mm - kSame_mm, .ample_mm = least_mm + kSame_mm};
    return lowest(sweep_samples(mover_), wanted).clearance >= least_mm;
  }
  /// The clearance of its tips; any value below `enough_mm` where it is below that.
  [[nodiscard]] double lowest_of_tips_mm(double enough_mm) const {
    return lowest(tip_samples(mover_), {.enough_mm = enough_mm}).clearance;
  }
  [[nodiscard]] static bool comes_first(const Place& a, const Place& b);
  [[nodiscard]] static bool same_place(const Place& a, const Place& b);
  [[nodiscard]] MeshPlace describe(const Place& place) const;

 private:
  /// The mover's tooth turned by an angle from the mesh, and the mate with it.
  struct Position {
    Point2 mover, mate;  ///< cosine and sine of their turns
  };
  [[nodiscard]] Position position_at(double angle) const {
    return {unit_vector(angle),
            unit_vector(half_pitch_mate_ - mate_faces_ - ratio_ * angle - mate_turn_)};
  }
  /// The point in the mate's frame.
  [[nodiscard]] Point2 in_mate(const Point2& p, const Position& at) const {
    const double c = at.mover.x(), s = at.mover.y(), c2 = at.mate.x(), s2 = at.mate.y();
    const double x = c * p.x() - s * p.y() - axis_, y = s * p.x() + c * p.y();
    return {c2 * x - s2 * y, s2 * x + c2 * y};
  }
  [[nodiscard]] double clearance(const Point2& p, const Position& at, GearDistance::Before& before) const {
    return mate_.nearest(in_mate(p, at), before).distance_mm;
  }
  class Valleys;
  [[nodiscard]] Place lowest(const std::vector<Sample>& samples, const Wanted& wanted) const;
  [[nodiscard]] Place lowest_of(const std::vector<Place>& starts, double step,
                                const Wanted& wanted) const;
  [[nodiscard]] Place refined(const Place& start, double step, double lost_mm) const;
  [[nodiscard]] double fastest_mm_per_rad(const Place& start, double step) const;

  const ToothProfile& mover_;
  const ToothProfile& mate_profile_;
  const GearDistance& mate_;
  bool internal_, gear1_moves_;
  double mate_turn_, distance_;
  SweepGrid positions_;
  double ratio_ = 0.0, half_pitch_mate_ = 0.0, axis_ = 0.0, mate_faces_ = 0.0;
};

}  // namespace

SweepGrid sweep_grid(const ToothProfile& mover, const ToothProfile& mate, double distance_mm) {
  const double m = mover.gear().normal_module_mm;
  const double r = mover.tip_radius_mm(), a = distance_mm;
  const bool mate_is_ring = mate.gear().kind == GearKind::kInternal;
  const bool internal = mate_is_ring || mover.gear().kind == GearKind::kInternal;
  const double r_mate = mate.tip_radius_mm() + (mate_is_ring ? -kReachMargin : kReachMargin) * m;
  double cosine = (a * a + r * r - r_mate * r_mate) / (2.0 * a * r);
  if (mate_is_ring) cosine = -cosine;  // near where the distance from the ring's axis is large
  const double reach = std::min(std::acos(std::clamp(cosine, -1.0, 1.0)) + kPi / mover.gear().teeth, kPi);
  // relative speed = relative turning times the distance from the pitch point
  const double z = mover.gear().teeth, z_mate = mate.gear().teeth;
  const double pitch_radius = a * z / (internal ? std::abs(z_mate - z) : z + z_mate);
  const double lever = (r * unit_vector(reach) - Point2(pitch_radius, 0.0)).norm() + m;
  const double turning = std::abs(1.0 - (internal ? z : -z) / z_mate);
  const int steps = static_cast<int>(
      std::clamp(std::ceil(2.0 * reach * turning * lever / (kGridStep * m)), 48.0, 4000.0));
  return {reach, pitch_radius, turning, steps};
}

std::size_t columns_without(double above_mm, double first_mm, double growth_mm) {
  if (!(above_mm > 0.0)) return 0;
  // k columns: k first + k^2 growth / 2
  const double k =
      (std::sqrt(first_mm * first_mm + 2.0 * growth_mm * above_mm) - first_mm) / growth_mm;
  return static_cast<std::size_t>(std::clamp(std::floor(k * (1.0 - 1e-9)), 0.0, 1e6));
}

namespace {

/// Which samples are looked at in which column: most columns are of use to few of them.
class DueSamples {
 public:
  /// All in the first column.
  DueSamples(std::size_t samples, std::size_t columns)
      : first_(columns, kNone), after_(samples, kNone) {
    for (std::size_t i = samples; i-- > 0;) put_off(i, 0);
  }
  /// Beyond the last column: not again.
  void put_off(std::size_t sample, std::size_t column) {
    if (column >= first_.size()) return;
    after_[sample] = first_[column];
    first_[column] = sample;
  }
  /// In the order of the samples; until the next call.
  [[nodiscard]] const std::vector<std::size_t>& in(std::size_t column) {
    due_.clear();
    for (std::size_t i = first_[column]; i != kNone; i = after_[i]) due_.push_back(i);
    std::sort(due_.begin(), due_.end());
    return due_;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> first_, after_;  // of each column; of each sample within its column
  std::vector<std::size_t> due_;
};

/// The order of places: by clearance, and among equals by how near the line of centres they are, by
/// the mover's piece and place on it: not by a last bit that other compilers and processors round
/// otherwise.
bool Sweep::comes_first(const Place& a, const Place& b) {
  if (!std::isfinite(b.clearance)) return std::isfinite(a.clearance);
  const auto rank = [](const Place& p) {
    return std::tuple(std::round(p.clearance / kSame_mm), std::round(std::abs(p.angle) / kSame_rad),
                      p.angle, p.sample.piece, p.sample.parameter);
  };
  return rank(a) < rank(b);
}

/// Where the search from one ends, the other's does.
bool Sweep::same_place(const Place& a, const Place& b) {
  return a.sample.piece == b.sample.piece && a.sample.parameter == b.sample.parameter &&
         a.sample.low == b.sample.low && a.sample.high == b.sample.high && a.angle == b.angle;
}

/// The lowest place of every piece of the mover against every piece of the mate, and along the path
/// of every corner all values.
class Sweep::Valleys {
 public:
  Valleys(const Sweep& sweep, const std::vector<Sample>& samples, std::size_t columns)
      : row_of_(samples.size(), kNoRow), of_piece_(sweep.mover_.pieces().size()) {
    std::size_t rows = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (samples[i].low == samples[i].high) row_of_[i] = rows++;
    along_.assign(rows, std::vector<double>(columns, kUnlimited));
    for (auto& against : of_piece_)
      against.resize(sweep.mate_profile_.pieces().size() +
                     sweep.mate_profile_.clockwise_pieces().size());
  }

  void keep(std::size_t sample, std::size_t column, double value) {
    if (row_of_[sample] != kNoRow) along_[row_of_[sample]][column] = value;
  }
  void take_in(const GearDistance::Nearest& near, const Sample& sample, double angle) {
    OfPiece& against =
        of_piece_[static_cast<std::size_t>(sample.piece)][static_cast<std::size_t>(near.piece)];
    Place& best = against[near.corner][near.clockwise_half];
    if (near.distance_mm < best.clearance - kSame_mm) best = {near.distance_mm, sample, angle};
  }
  /// Those not above `highest`, in the order in which they are refined; columns lie at angle_of(j).
  template <typename AngleOf>
  [[nodiscard]] std::vector<Place> up_to(double highest, const std::vector<Sample>& samples,
                                         const AngleOf& angle_of) const {
    std::vector<Place> starts;
    for (const auto& against : of_piece_)
      for (const OfPiece& piece : against)
        for (const auto& halves : piece)
          for (const Place& place : halves)
            if (place.clearance <= highest) starts.push_back(place);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (row_of_[i] == kNoRow) continue;
      const std::vector<double>& row = along_[row_of_[i]];
      for (std::size_t j = 1; j + 1 < row.size(); ++j) {
        const double* f = &row[j];
        if (f[0] <= f[-1] && f[0] < f[1] && f[0] <= highest)
          starts.push_back({f[0], samples[i], angle_of(j)});
      }
    }
    std::sort(starts.begin(), starts.end(), comes_first);
    return starts;
  }

 private:
  /// Its corners and its halves apart.
  using OfPiece = std::array<std::array<Place, 2>, 2>;
  std::vector<std::size_t> row_of_;
  std::vector<std::vector<double>> along_;
  std::vector<std::vector<OfPiece>> of_piece_;
};

Sweep::Place Sweep::lowest(const std::vector<Sample>& samples, const Wanted& wanted) const {
  const double m = mover_.gear().normal_module_mm;
  const double reach = positions_.reach_rad, turning = positions_.turning;
  const int n = positions_.steps;
  const double step = 2.0 * reach / n;
  const auto columns = static_cast<std::size_t>(n) + 1;
  const auto angle_of = [&](std::size_t j) { return -reach + step * static_cast<double>(j); };

  Valleys valleys(*this, samples, columns);
  // A low value from the start saves columns that others would have to show to be no use.
  double lowest = kUnlimited;
  const Position at_centres = position_at(angle_of(columns / 2));
  GearDistance::Before along_profile;
  for (const Sample& sample : samples)
    lowest = std::min(lowest, clearance(sample.point, at_centres, along_profile));
  const double mate_tip = mate_profile_.tip_radius_mm();
  const bool mate_is_ring = mate_profile_.gear().kind == GearKind::kInternal;
  // A distance falls by no more than its point moves: columns within which it cannot come down to
  // what is looked for are passed over, with a value that is surely too high.
  DueSamples due_samples(samples.size(), columns);
  std::vector<double> growth_mm;  // of what a point moves by, a column
  for (const Sample& sample : samples) growth_mm.push_back(step * step * turning * sample.point.norm());
  std::vector<GearDistance::Before> before(samples.size());
  for (std::size_t j = 0; j < columns; ++j) {
    const std::vector<std::size_t>& due = due_samples.in(j);
    if (due.empty()) continue;
    const double angle = angle_of(j);
    const Position at = position_at(angle);
    const double c = at.mover.x(), s = at.mover.y(), c2 = at.mate.x(), s2 = at.mate.y();
    for (const std::size_t i : due) {
      const Point2& p = samples[i].point;
      const double along = c * p.x() - s * p.y(), x = along - axis_, y = s * p.x() + c * p.y();
      const double from_pitch_point = norm_of(along - positions_.pitch_radius_mm, y);
      const auto pass_over = [&](double distance_mm) {
        valleys.keep(i, j, distance_mm);
        const std::size_t passed =
            columns_without(distance_mm - (lowest + kRefineBand * m),
                            step * turning * from_pitch_point, growth_mm[i]);
        due_samples.put_off(i, j + 1 + passed);
      };
      // farther beyond the mate's tip circle than the lowest place so far: cannot matter
      const double radius = norm_of(x, y);
      const double beyond = mate_is_ring ? mate_tip - radius : radius - mate_tip;
      if (beyond > lowest + kRefineBand * m) {
        pass_over(beyond);
        continue;
      }
      const auto near = mate_.nearest({c2 * x - s2 * y, s2 * x + c2 * y}, before[i]);
      lowest = std::min(lowest, near.distance_mm);
      if (lowest < wanted.enough_mm) return {.clearance = lowest};
      pass_over(near.distance_mm);
      valleys.take_in(near, samples[i], angle);
    }
  }
  return lowest_of(valleys.up_to(lowest + kRefineBand * m, samples, angle_of), step, wanted);
}

/// The lowest after refinement, of places in the order in which they come.
Sweep::Place Sweep::lowest_of(const std::vector<Place>& starts, double step,
                              const Wanted& wanted) const {
  Place best;
  double least_mm = kUnlimited;
  for (std::size_t k = 0; k < std::min(starts.size(), kMostRefined); ++k) {
    if (k > 0 && same_place(starts[k], starts[k - 1])) continue;
    Place place = refined(starts[k], step, std::min(best.clearance + 2.0 * kSame_mm, wanted.ample_mm));
    least_mm = std::min(least_mm, place.clearance);
    if (least_mm < wanted.enough_mm) break;
    // along a path of contact all clearances are equal: there the search went where rounding led it
    if (place.clearance > starts[k].clearance - kSame_mm) place = starts[k];
    if (comes_first(place, best)) best = place;
  }
  best.clearance = std::min(best.clearance, least_mm);
  return best;
}

/// Points of a curve at parameters that a search asks for again and again: find_minimum() begins with the
/// same four wherever it is given the same ends.
class PointsOfSearch {
 public:
  explicit PointsOfSearch(const Curve& curve) : curve_(curve) {}
  void begin() { asked_ = 0; }
  [[nodiscard]] Point2 at(double parameter) {
    const std::size_t k = asked_++;
    if (k >= first_.size()) return point_at(curve_, parameter);
    if (first_[k].parameter != parameter) first_[k] = {parameter, point_at(curve_, parameter)};
    return first_[k].point;
  }

 private:
  struct Known {
    double parameter = std::numeric_limits<double>::quiet_NaN();
    Point2 point = Point2::Zero();
  };
  const Curve& curve_;
  std::array<Known, 4> first_;
  std::size_t asked_ = 0;
};

/// How fast a place within a start's range moves in the mate, at most: the relative turning about the pitch point.
double Sweep::fastest_mm_per_rad(const Place& start, double step) const {
  const Point2& p = start.sample.point;
  const Curve& curve = mover_.pieces()[static_cast<std::size_t>(start.sample.piece)].curve;
  // an arc is less than twice as long as its chord
  const double along = 2.0 * std::max((point_at(curve, start.sample.low) - p).norm(),
                                      (point_at(curve, start.sample.high) - p).norm());
  const double from_pitch_point = (rotated(p, start.angle) - Point2(positions_.pitch_radius_mm, 0.0)).norm();
  return positions_.turning * (from_pitch_point + along + step * p.norm());
}

/// `lost_mm`: where no value can come below that, any above it will do.
Sweep::Place Sweep::refined(const Place& start, double step, double lost_mm) const {
  const Curve& curve = mover_.pieces()[static_cast<std::size_t>(start.sample.piece)].curve;
  PointsOfSearch points(curve);
  Place best = start;
  GearDistance::Before before;
  const auto at_angle = [&](double angle) {
    const Position at = position_at(angle);
    if (start.sample.low == start.sample.high) return clearance(start.sample.point, at, before);
    const double low = std::min(start.sample.low, start.sample.high);
    const double high = std::max(start.sample.low, start.sample.high);
    points.begin();
    const ScalarMinimum inner = find_minimum(
        [&](double u) { return clearance(points.at(u), at, before); }, low, high, 1e-6 * (high - low));
    if (inner.value < best.clearance) {
      best.clearance = inner.value;
      best.angle = angle;
      best.sample.parameter = inner.at;
      best.sample.point = point_at(curve, inner.at);
    }
    return inner.value;
  };
  const double fastest = fastest_mm_per_rad(start, step);
  const auto lost = [&](double value, double low, double high, double reach) {
    return value - fastest * reach > lost_mm && low > lost_mm && high > lost_mm;
  };
  const auto aside = [&](double angle) {
    const Place kept = best;
    const double value = at_angle(angle);
    best = kept;
    return value;
  };
  const ScalarMinimum outer =
      find_minimum(at_angle, start.angle - step, start.angle + step, 1e-6 * step, lost, aside);
  if (outer.value < best.clearance) {
    best.clearance = outer.value;
    best.angle = outer.at;
  }
  return best;
}

MeshPlace Sweep::describe(const Place& place) const {
  const auto near = mate_.nearest(in_mate(place.sample.point, position_at(place.angle)));
  const double mover_angle = gear1_moves_ ? place.angle : place.angle + mate_faces_;
  // the mate's tooth 1 stands half a pitch from the gap that faces the mover
  double mate_angle = ratio_ * place.angle + mate_turn_ - half_pitch_mate_;
  if (gear1_moves_) mate_angle += mate_faces_;
  MeshPlace result;
  result.rotation1_rad = gear1_moves_ ? mover_angle : mate_angle;
  result.rotation2_rad = gear1_moves_ ? mate_angle : mover_angle;
  const Point2 axis2(internal_ ? -distance_ : distance_, 0.0);
  result.point_mm = gear1_moves_ ? rotated(place.sample.point, mover_angle)
                                 : Point2(axis2 + rotated(place.sample.point, mover_angle));
  const auto& pieces = mover_.pieces();
  const Curve& curve = pieces[static_cast<std::size_t>(place.sample.piece)].curve;
  // a search that is lowest at an end says so exactly
  const bool at_end = place.sample.parameter == curve.begin || place.sample.parameter == curve.end;
  // the corner between tip circle and flank is the tip's
  const auto kind_of = [](const ProfilePiece& piece, bool corner, double from_tip_mm) {
    return corner && std::abs(from_tip_mm) < tolerance::kTouch_mm ? PieceKind::kTip : piece.kind;
  };
  const PieceKind mover_piece =
      kind_of(pieces[static_cast<std::size_t>(place.sample.piece)], at_end,
              place.sample.point.norm() - mover_.tip_radius_mm());
  const auto& mate_half =
      near.clockwise_half ? mate_profile_.clockwise_pieces() : mate_profile_.pieces();
  const PieceKind mate_piece = kind_of(mate_half[static_cast<std::size_t>(near.piece)], near.corner,
                                       near.point.norm() - mate_profile_.tip_radius_mm());
  (gear1_moves_ ? result.piece1 : result.piece2) = mover_piece;
  (gear1_moves_ ? result.piece2 : result.piece1) = mate_piece;
  (gear1_moves_ ? result.corner1 : result.corner2) = at_end;
  (gear1_moves_ ? result.corner2 : result.corner1) = near.corner;
  (gear1_moves_ ? result.radius1_mm : result.radius2_mm) = place.sample.point.norm();
  (gear1_moves_ ? result.radius2_mm : result.radius1_mm) = near.point.norm();
  const bool clockwise1 = gear1_moves_ ? false : near.clockwise_half;
  result.flank1 = clockwise1 ? Flank::kRight : Flank::kLeft;
  return result;
}

/// Seen from gear 2, gear 1 is turned back by the same motion at the pitch circle.
double turned_back_rad(const GearPair& pair, double gear2_turn_rad) {
  const double z1 = pair.gear1().teeth, z2 = pair.gear2().teeth;
  return (pair.internal() ? -gear2_turn_rad : gear2_turn_rad) * z2 / z1;
}

}  // namespace

MeshClearance sweep_both(const GearPair& pair, const GearDistance& gear1, const GearDistance& gear2,
                         double turn_rad, double turn_for_gear2_moving_rad) {
  const Sweep first(pair, gear2, true, turn_rad);
  const Sweep second(pair, gear1, false, turned_back_rad(pair, turn_for_gear2_moving_rad));
  const auto place1 = first.lowest();
  const auto place2 = second.lowest();
  MeshClearance result;
  const bool use_first = place1.clearance <= place2.clearance + kSame_mm;
  result.clearance_mm = std::min(place1.clearance, place2.clearance);
  if (std::abs(result.clearance_mm) < kZero_mm) result.clearance_mm = 0.0;
  result.place = use_first ? first.describe(place1) : second.describe(place2);
  return result;
}

bool both_clear(const GearPair& pair, const GearDistance& gear1, const GearDistance& gear2, double turn_rad,
                double turn_for_gear2_moving_rad, double least_mm) {
  return Sweep(pair, gear2, true, turn_rad).clears(least_mm) &&
         Sweep(pair, gear1, false, turned_back_rad(pair, turn_for_gear2_moving_rad)).clears(least_mm);
}

double tips_swept_mm(const GearPair& pair, double spline_error, double turn_rad,
                     double turn_for_gear2_moving_rad, double enough_mm) {
  const auto of_gear1 = [&] {
    const GearDistance mate(*pair.profile2, spline_error);
    return Sweep(pair, mate, true, turn_rad).lowest_of_tips_mm(enough_mm);
  };
  const auto of_gear2 = [&] {
    const GearDistance mate(*pair.profile1, spline_error);
    return Sweep(pair, mate, false, turned_back_rad(pair, turn_for_gear2_moving_rad))
        .lowest_of_tips_mm(enough_mm);
  };
  // a ring's tips reach into fillets sooner than its pinion's
  const double first = pair.internal() ? of_gear2() : of_gear1();
  if (first < enough_mm) return first;
  return std::min(first, pair.internal() ? of_gear1() : of_gear2());
}

}  // namespace trueflank
