// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/pits.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/effects/pits_of_flanks.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

using namespace gear_effects;

constexpr std::size_t kFewestPits = 8, kMostPits = 400, kFewestOfFlank = 60, kFewestFlanks = 4;
constexpr double kWild = 4.0;    // spreads: no point counts for more
constexpr double kBeyond = 6.5;  // standard errors of a place beyond doubt
constexpr double kWidest_mm = 1.0, kFewestInPit = 3.0;
constexpr double kOnIt = 0.05;  // of its depth: less is beside a pit
constexpr std::size_t kPoly = 6;

/// A point of a flank: where it is on it [mm], and how far it lies off [um].
struct PointOfFlank {
  double along_mm = 0.0, up_mm = 0.0;
  double um = 0.0;
};

struct FoundPit {
  std::size_t flank = 0;
  double along_mm = 0.0, up_mm = 0.0, half_mm = 0.0, depth_um = 0.0;  ///< + = material
  double score = 0.0;                                                 ///< standard errors
};

/// What a flank has smoothly by itself: a polynomial of the second degree.
Eigen::Matrix<double, kPoly, 1> terms_at(double u, double v) {
  Eigen::Matrix<double, kPoly, 1> t;
  t << 1.0, u, v, u * u, u * v, v * v;
  return t;
}

class PitSearch {
 public:
  PitSearch(const FlankGeometry& geometry, const Observations& table)
      : geometry_(geometry), flanks_(2 * static_cast<std::size_t>(geometry.teeth())) {
    const double root = arc(geometry.root_form_roll_mm()), tip = arc(geometry.tip_form_roll_mm());
    low_mm_ = std::min(root, tip);
    length_mm_ = std::abs(tip - root);
    const RowsByClass rows(table.points_mm.size(), flanks_, [&](std::size_t i) {
      const Observation& row = table.rows[i];
      const Place& place = table.place(row);
      return row.kind == ObservationKind::kScanFlank && place.surface == Surface::kFlank
                 ? 2 * (place.tooth - 1) + (place.side > 0 ? 1 : 0)
                 : -1;
    });
    points_.resize(flanks_);
    for_each_piece(flanks_, [&](std::size_t flank) {
      std::vector<PointOfFlank>& points = points_[flank];
      points.reserve(rows.count(flank));
      rows.for_each(flank, table, [&](std::size_t i) {
        const Place& place = table.place(table.rows[i]);
        points.push_back({arc(place.roll_mm), place.z_mm, table.rows[i].deviation_um});
      });
    });
    std::size_t seen = 0;
    for (const auto& points : points_) {
      if (points.size() < kFewestOfFlank) continue;
      ++seen;
      all_ += static_cast<double>(points.size());
    }
    if (seen < kFewestFlanks) return;
    area_mm2_ = static_cast<double>(seen) * length_mm_ * geometry.face_width_mm();
    flatten();
    constexpr double kShareOfSpacing = 0.9;
    cell_mm_ = kShareOfSpacing * std::sqrt(area_mm2_ / all_);
    cells_[0] = std::max(1, static_cast<int>(std::ceil(length_mm_ / cell_mm_)));
    cells_[1] = std::max(1, static_cast<int>(std::ceil(geometry.face_width_mm() / cell_mm_)));
    can_see_ = sigma_um_ > 0.0 && cell_mm_ < 0.3 * kWidest_mm;
  }

  [[nodiscard]] std::optional<Pits> run() {
    if (!can_see_) return {};
    std::vector<FoundPit> found = look();
    const auto lower = static_cast<std::size_t>(std::count_if(
        found.begin(), found.end(), [](const FoundPit& p) { return p.depth_um < 0.0; }));
    const bool pits = 2 * lower >= found.size();
    const std::size_t of_kind = pits ? lower : found.size() - lower;
    constexpr double kMostOfOthers = 0.1;
    if (of_kind < kFewestPits || of_kind > kMostPits ||
        static_cast<double>(found.size() - of_kind) > kMostOfOthers * static_cast<double>(of_kind))
      return {};
    std::erase_if(found, [&](const FoundPit& p) { return (p.depth_um < 0.0) != pits; });
    if (!lie_at_random(found)) return {};
    const int hollow = fit_all(found);
    if (!are_round(found, hollow)) return {};
    // Beside what was found others are seen, of which the form is known now.
    take_away(found, hollow);
    const std::vector<FoundPit> more = look_for(found, hollow, pits ? -1.0 : 1.0);
    found.insert(found.end(), more.begin(), more.end());
    return told(found, hollow);
  }

 private:
  [[nodiscard]] double arc(double roll_mm) const {
    return 0.5 * roll_mm * roll_mm / geometry_.base_radius_mm();
  }
  [[nodiscard]] double u_of(const PointOfFlank& p) const {
    return 2.0 * (p.along_mm - low_mm_) / length_mm_ - 1.0;
  }
  [[nodiscard]] double v_of(const PointOfFlank& p) const {
    return geometry_.face_coordinate(p.up_mm);
  }

  /// Takes away what the flanks of a side have in common, place by place, and what each has
  /// smoothly by itself, as most of its points say.
  void flatten() {
    for_each_piece(flanks_, [&](std::size_t flank) { level(points_[flank]); });
    constexpr std::size_t kParts = 40;
    constexpr double kSome = 16'000.0;
    const auto stride = static_cast<std::size_t>(1.0 + all_ / kSome);
    const auto part = [](double c) {
      return std::clamp<std::size_t>(static_cast<std::size_t>(0.5 * (c + 1.0) * kParts), 0,
                                     kParts - 1);
    };
    for_each_piece(4, [&](std::size_t piece) {
      // (lines over the profile and over the face: what a few flanks have there hardly moves them)
      const std::size_t side = piece % 2;
      const bool over_face = piece >= 2;
      std::vector<std::vector<float>> lines(kParts);
      for (std::size_t flank = side; flank < flanks_; flank += 2)
        for (std::size_t i = 0; i < points_[flank].size(); i += stride) {
          const PointOfFlank& p = points_[flank][i];
          lines[part(over_face ? v_of(p) : u_of(p))].push_back(static_cast<float>(p.um));
        }
      for (std::size_t k = 0; k < kParts; ++k)
        common_[piece][k] =
            lines[k].size() > 8 ? static_cast<double>(median(std::move(lines[k]))) : 0.0;
    });
    for_each_piece(flanks_, [&](std::size_t flank) {
      for (PointOfFlank& p : points_[flank])
        p.um -= common_[flank % 2][part(u_of(p))] + common_[2 + flank % 2][part(v_of(p))];
    });
    std::vector<float> sizes;
    for (const auto& points : points_)
      for (std::size_t i = 0; i < points.size(); i += stride)
        sizes.push_back(static_cast<float>(points[i].um));
    sigma_um_ = robust_sigma(std::move(sizes));
  }

  /// Least squares of some of the points, then without what lies far from them.
  void level(std::vector<PointOfFlank>& points) const {
    if (points.size() < kFewestOfFlank) return;
    constexpr std::size_t kSome = 1500;
    const std::size_t stride = 1 + points.size() / kSome;
    double limit = 1e300;
    Eigen::Matrix<double, kPoly, 1> found = Eigen::Matrix<double, kPoly, 1>::Zero();
    for (int turn = 0; turn < 3; ++turn) {
      Eigen::Matrix<double, kPoly, kPoly> normal =
          1e-9 * Eigen::Matrix<double, kPoly, kPoly>::Identity();
      Eigen::Matrix<double, kPoly, 1> right = Eigen::Matrix<double, kPoly, 1>::Zero();
      std::vector<float> left;
      for (std::size_t i = 0; i < points.size(); i += stride) {
        const auto t = terms_at(u_of(points[i]), v_of(points[i]));
        const double um = points[i].um - found.dot(t);
        if (turn == 1) left.push_back(static_cast<float>(um));
        if (std::abs(um) > limit) continue;
        normal += t * t.transpose();
        right += points[i].um * t;
      }
      found = normal.ldlt().solve(right);
      if (turn == 1) limit = 3.0 * robust_sigma(std::move(left));
    }
    for (PointOfFlank& p : points) p.um -= found.dot(terms_at(u_of(p), v_of(p)));
  }

  struct Field {
    std::vector<double> sum, count;
  };
  [[nodiscard]] std::size_t corner(int u, int v) const {
    return static_cast<std::size_t>(u) * static_cast<std::size_t>(cells_[1] + 1) +
           static_cast<std::size_t>(v);
  }
  [[nodiscard]] double within(const std::vector<double>& values, int u, int v, int size) const {
    return values[corner(u + size, v + size)] - values[corner(u, v + size)] -
           values[corner(u + size, v)] + values[corner(u, v)];
  }

  /// Places beyond doubt on all flanks, the surest of those that lie together.
  [[nodiscard]] std::vector<FoundPit> look() const {
    std::vector<std::vector<FoundPit>> of_flank(flanks_);
    for_each_piece(flanks_, [&](std::size_t flank) { of_flank[flank] = look_at(flank); });
    std::vector<FoundPit> found;
    for (const auto& some : of_flank) found.insert(found.end(), some.begin(), some.end());
    return found;
  }

  [[nodiscard]] std::vector<FoundPit> look_at(std::size_t flank) const {
    const std::vector<PointOfFlank>& points = points_[flank];
    if (points.size() < kFewestOfFlank) return {};
    Field field;
    field.sum.assign(corner(cells_[0], cells_[1]) + 1, 0.0);
    field.count = field.sum;
    for (const PointOfFlank& p : points) {
      const int u = static_cast<int>((p.along_mm - low_mm_) / cell_mm_),
                v = static_cast<int>(p.up_mm / cell_mm_);
      const std::size_t at =
          corner(std::clamp(u, 0, cells_[0] - 1) + 1, std::clamp(v, 0, cells_[1] - 1) + 1);
      field.sum[at] += std::clamp(p.um / sigma_um_, -kWild, kWild);
      field.count[at] += 1.0;
    }
    for (std::vector<double>* values : {&field.sum, &field.count})
      for (int u = 1; u <= cells_[0]; ++u)
        for (int v = 1; v <= cells_[1]; ++v)
          (*values)[corner(u, v)] += (*values)[corner(u - 1, v)] + (*values)[corner(u, v - 1)] -
                                     (*values)[corner(u - 1, v - 1)];
    std::vector<FoundPit> found;
    const int most = std::min(
        {cells_[0] / 2, cells_[1] / 2, static_cast<int>(std::ceil(kWidest_mm / cell_mm_))});
    for (int size = 2; size <= most; size = std::max(size + 1, size * 4 / 3))
      for (int u = 0; u + size <= cells_[0]; ++u)
        for (int v = 0; v + size <= cells_[1]; ++v) {
          const double count = within(field.count, u, v, size);
          if (count < kFewestInPit) continue;
          const double sum = within(field.sum, u, v, size);
          if (sum * sum < kBeyond * kBeyond * count) continue;
          // (a square that just holds a round pit is a little wider than its half depth)
          found.push_back({flank, low_mm_ + (u + 0.5 * size) * cell_mm_,
                           (v + 0.5 * size) * cell_mm_, 0.55 * size * cell_mm_,
                           sigma_um_ * sum / count, std::abs(sum) / std::sqrt(count)});
        }
    std::stable_sort(found.begin(), found.end(),
                     [](const FoundPit& a, const FoundPit& b) { return a.score > b.score; });
    std::vector<FoundPit> apart;
    for (const FoundPit& p : found) {
      const bool near = std::any_of(apart.begin(), apart.end(), [&](const FoundPit& other) {
        return std::hypot(other.along_mm - p.along_mm, other.up_mm - p.up_mm) <
               1.2 * (other.half_mm + p.half_mm);
      });
      if (!near) apart.push_back(p);
      if (apart.size() > kMostPits) break;
    }
    return apart;
  }

  /// Not at the same height, nor at the same place of the profile, more often than chance has it;
  /// on several flanks; and not all over them.
  [[nodiscard]] bool lie_at_random(const std::vector<FoundPit>& found) const {
    constexpr double kMostOfArea = 0.2, kMostPairs = 1.6, kErrors = 4.0;
    std::set<std::size_t> flanks;
    double covered = 0.0;
    for (const FoundPit& p : found) {
      flanks.insert(p.flank);
      covered += 4.0 * p.half_mm * p.half_mm;
    }
    if (flanks.size() < kFewestFlanks || covered > kMostOfArea * area_mm2_ ||
        run_on_to_the_next_tooth(found) || lie_in_pieces(found))
      return false;
    for (const bool up : {false, true}) {
      const double range = up ? geometry_.face_width_mm() : length_mm_;
      double pairs = 0.0, alike = 0.0, expected = 0.0;
      for (std::size_t a = 0; a < found.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          if (found[a].flank == found[b].flank) continue;
          const double near = 0.5 * (found[a].half_mm + found[b].half_mm);
          pairs += 1.0;
          expected += std::min(1.0, 2.0 * near / range);
          alike += std::abs(up ? found[a].up_mm - found[b].up_mm
                               : found[a].along_mm - found[b].along_mm) < near
                       ? 1.0
                       : 0.0;
        }
      if (alike > kMostPairs * expected + kErrors * std::sqrt(expected) + 0.02 * pairs)
        return false;
    }
    return true;
  }

  /// Pieces of fewer and larger places: most lie next to another.
  [[nodiscard]] static bool lie_in_pieces(const std::vector<FoundPit>& found) {
    constexpr double kNear = 2.0, kShare = 0.35;
    std::size_t by_another = 0;
    for (std::size_t a = 1; a < found.size(); ++a)
      by_another += std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(a),
                                [&](const FoundPit& b) {
                                  return b.flank == found[a].flank &&
                                         std::hypot(b.up_mm - found[a].up_mm,
                                                    b.along_mm - found[a].along_mm) <
                                             kNear * (b.half_mm + found[a].half_mm);
                                })
                        ? 1U
                        : 0U;
    return found.size() - by_another < kFewestPits ||
           static_cast<double>(by_another) > kShare * static_cast<double>(found.size());
  }

  /// As what has a place of the body does, or a cutter makes: alike on neighbouring teeth.
  [[nodiscard]] bool run_on_to_the_next_tooth(const std::vector<FoundPit>& found) const {
    constexpr double kShare = 0.2, kFewest = 3.0;
    const auto teeth = flanks_ / 2;
    double alike = 0.0;
    for (const FoundPit& a : found)
      for (const FoundPit& b : found) {
        const double near = a.half_mm + b.half_mm;
        if (a.flank % 2 == b.flank % 2 && (a.flank / 2 + 1) % teeth == b.flank / 2 &&
            std::abs(a.up_mm - b.up_mm) < near && std::abs(a.along_mm - b.along_mm) < near)
          alike += 1.0;
      }
    return alike >= std::max(kFewest, kShare * static_cast<double>(found.size()));
  }

  /// `take(point, square)` for the points about a pit, and how far off they are, in its half
  /// widths.
  template <class Take>
  void for_points_about(const FoundPit& p, double reach, const Take& take) const {
    const double far = reach * p.half_mm;
    for (const PointOfFlank& point : near_[p.flank].empty() ? points_[p.flank] : near_[p.flank]) {
      const double up = point.up_mm - p.up_mm, along = point.along_mm - p.along_mm;
      if (std::abs(up) > far || std::abs(along) > far) continue;
      take(point, (up * up + along * along) / (p.half_mm * p.half_mm));
    }
  }

  /// Its depth where it is, and what is left of the points about the place it was found at.
  struct Fitted {
    double depth_um = 0.0, left = 0.0;
  };
  [[nodiscard]] Fitted fitted(const std::vector<PointOfFlank>& about, const FoundPit& p,
                              int hollow) const {
    double own = 0.0, with = 0.0, all = 0.0;
    for (const PointOfFlank& point : about) {
      const double up = point.up_mm - p.up_mm, along = point.along_mm - p.along_mm;
      const double s = depth_of_pit(hollow, (up * up + along * along) / (p.half_mm * p.half_mm));
      own += s * s;
      with += s * point.um;
      all += point.um * point.um;
    }
    if (!(own > 0.5)) return {0.0, all};
    return {with / own, all - with * with / own};
  }

  /// Seeks its place, width and depth; `usual_mm`: of the others, which few points are held by.
  [[nodiscard]] double fit_one(FoundPit& p, int hollow, double usual_mm) const {
    constexpr double kReach = 3.0, kSpread = 0.35;
    std::vector<PointOfFlank> about;
    for_points_about(p, kReach, [&](const PointOfFlank& point, double) { about.push_back(point); });
    const auto cost_of = [&](const FoundPit& of) {
      const Fitted f = fitted(about, of, hollow);
      if (f.depth_um * p.depth_um <= 0.0) return 1e300;
      const double off = usual_mm > 0.0 ? std::log(of.half_mm / usual_mm) / kSpread : 0.0;
      return f.left + sigma_um_ * sigma_um_ * off * off;
    };
    FoundPit best = p;
    double least = cost_of(best);
    for (double step = 0.4; step > 0.02; step *= 0.6) {
      bool moved = true;
      for (int turn = 0; moved && turn < 6; ++turn) {
        moved = false;
        const FoundPit from = best;
        const auto try_one = [&](double along, double up, double times) {
          FoundPit other = from;
          other.along_mm += along * from.half_mm;
          other.up_mm += up * from.half_mm;
          other.half_mm = std::clamp(times * from.half_mm, 0.5 * cell_mm_, kWidest_mm);
          const double cost = cost_of(other);
          if (cost >= least - 1e-9) return;
          least = cost;
          best = other;
          moved = true;
        };
        for (const double sign : {-1.0, 1.0}) {
          try_one(sign * step, 0.0, 1.0);
          try_one(0.0, sign * step, 1.0);
          try_one(0.0, 0.0, 1.0 + sign * 0.6 * step);
        }
      }
    }
    const Fitted f = fitted(about, best, hollow);
    if (f.depth_um * p.depth_um > 0.0) {
      best.depth_um = f.depth_um;
      p = best;
    }
    return f.left;
  }

  [[nodiscard]] static double half_of(const std::vector<FoundPit>& found) {
    std::vector<double> halves;
    for (const FoundPit& p : found) halves.push_back(p.half_mm);
    return median(std::move(halves));
  }

  double fit_each(std::vector<FoundPit>& found, int hollow, double usual_mm) const {
    std::vector<double> left(found.size());
    for_each_piece(found.size(),
                   [&](std::size_t i) { left[i] = fit_one(found[i], hollow, usual_mm); });
    double sum = 0.0;
    for (const double one : left) sum += one;
    return sum;
  }

  /// All of them hollowed alike, as leaves least.
  [[nodiscard]] int fit_all(std::vector<FoundPit>& found) {
    gather_near(found);
    std::vector<FoundPit> best;
    int hollow = kBowl;
    double least = 1e300;
    for (int k = 0; k < kHollows; ++k) {
      std::vector<FoundPit> these = found;
      fit_each(these, k, 0.0);
      const double usual = half_of(these);
      for (std::size_t i = 0; i < these.size(); ++i) {
        these[i] = found[i];
        these[i].half_mm = usual;
      }
      fit_each(these, k, usual);
      const double left = left_of(these, found, k);
      if (left >= least) continue;
      least = left;
      best = std::move(these);
      hollow = k;
    }
    found = std::move(best);
    return hollow;
  }

  /// Squares left about the places at which pits were found.
  [[nodiscard]] double left_of(const std::vector<FoundPit>& these,
                               const std::vector<FoundPit>& found, int hollow) const {
    constexpr double kReach = 3.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < these.size(); ++i)
      for_points_about(found[i], kReach, [&](const PointOfFlank& point, double) {
        const double up = point.up_mm - these[i].up_mm, along = point.along_mm - these[i].along_mm,
                     square = (up * up + along * along) / (these[i].half_mm * these[i].half_mm);
        const double off = point.um - these[i].depth_um * depth_of_pit(hollow, square);
        sum += off * off;
      });
    return sum;
  }

  /// The points about pits, so that they are not sought among all of a flank.
  void gather_near(const std::vector<FoundPit>& found) {
    constexpr double kReach = 4.0;
    for (auto& near : near_) near.clear();
    near_.resize(flanks_);
    std::vector<std::vector<const FoundPit*>> of_flank(flanks_);
    for (const FoundPit& p : found) of_flank[p.flank].push_back(&p);
    for_each_piece(flanks_, [&](std::size_t flank) {
      if (of_flank[flank].empty()) return;
      for (const PointOfFlank& point : points_[flank])
        if (std::any_of(of_flank[flank].begin(), of_flank[flank].end(), [&](const FoundPit* p) {
              return std::abs(point.up_mm - p->up_mm) < kReach * p->half_mm &&
                     std::abs(point.along_mm - p->along_mm) < kReach * p->half_mm;
            }))
          near_[flank].push_back(point);
    });
  }

  /// Beyond its edge, to all sides, nothing is left of a pit: a line or a wave runs on.
  [[nodiscard]] bool are_round(const std::vector<FoundPit>& found, int hollow) const {
    constexpr double kInner = 1.4, kOuter = 2.4, kRunsOn = 0.4, kShare = 0.25;
    const double end = hollow == kBell ? 1.25 : 1.0;
    std::size_t run_on = 0;
    for (const FoundPit& p : found) {
      std::array<double, 4> sum{}, count{};  // of half circles' quarters, opposite ones together
      for_points_about(p, kOuter * end, [&](const PointOfFlank& point, double square) {
        const double off = std::sqrt(square) / end;
        if (off < kInner || off > kOuter) return;
        const double turn =
            std::atan2(point.up_mm - p.up_mm, point.along_mm - p.along_mm) / kTwoPi * 8.0 + 8.5;
        const auto k = static_cast<std::size_t>(turn) % 4;
        sum[k] += point.um / p.depth_um;
        count[k] += 1.0;
      });
      const double error = std::abs(sigma_um_ / p.depth_um);
      for (std::size_t k = 0; k < 4; ++k)
        if (count[k] >= 2.0 && sum[k] / count[k] > kRunsOn + 1.0 * error / std::sqrt(count[k])) {
          ++run_on;
          break;
        }
    }
    return static_cast<double>(run_on) <= kShare * static_cast<double>(found.size());
  }

  void take_away(const std::vector<FoundPit>& found, int hollow) {
    for (const FoundPit& p : found)
      for (PointOfFlank& point : points_[p.flank]) {
        const double up = point.up_mm - p.up_mm, along = point.along_mm - p.along_mm;
        if (std::abs(up) < kEndOfPit * p.half_mm)
          point.um -= p.depth_um *
                      depth_of_pit(hollow, (up * up + along * along) / (p.half_mm * p.half_mm));
      }
    for (auto& near : near_) near.clear();
  }

  /// Size of what stands for doubt where the form is known: hardly one place of all by chance.
  [[nodiscard]] double beyond_of_known(double half_mm) const {
    constexpr double kByChance = 0.03;
    const double places = 4.0 * area_mm2_ / (half_mm * half_mm);
    double low = 3.0, high = kBeyond;
    while (high - low > 0.01) {
      const double middle = 0.5 * (low + high);
      (places * normal_two_sided(middle) > kByChance ? low : high) = middle;
    }
    return high;
  }

  /// More of those that were found, of their width and hollow, to the side `sign`.
  [[nodiscard]] std::vector<FoundPit> look_for(const std::vector<FoundPit>& found, int hollow,
                                               double sign) const {
    const double half = half_of(found), beyond = beyond_of_known(half);
    std::vector<std::vector<FoundPit>> of_flank(flanks_);
    for_each_piece(flanks_, [&](std::size_t flank) {
      std::vector<FoundPit> all;
      for (const FoundPit& p : places_alike(flank, half, hollow, sign))
        if (p.score > beyond) all.push_back(p);
      std::stable_sort(all.begin(), all.end(),
                       [](const FoundPit& a, const FoundPit& b) { return a.score > b.score; });
      for (const FoundPit& p : all) {
        const auto near = [&](const FoundPit& other) {
          return other.flank == flank && std::hypot(other.along_mm - p.along_mm,
                                                    other.up_mm - p.up_mm) < other.half_mm + half;
        };
        if (std::none_of(found.begin(), found.end(), near) &&
            std::none_of(of_flank[flank].begin(), of_flank[flank].end(), near))
          of_flank[flank].push_back(p);
      }
    });
    std::vector<FoundPit> more;
    for (const auto& some : of_flank) more.insert(more.end(), some.begin(), some.end());
    fit_each(more, hollow, half);
    return more;
  }

  /// A pit of a width at places half a half width apart, and how far each lies beyond its error.
  [[nodiscard]] std::vector<FoundPit> places_alike(std::size_t flank, double half_mm, int hollow,
                                                   double sign) const {
    const std::vector<PointOfFlank>& points = points_[flank];
    if (points.size() < kFewestOfFlank) return {};
    const double step = 0.5 * half_mm, reach = hollow == kBell ? 1.3 * half_mm : half_mm;
    const int wide = static_cast<int>(length_mm_ / step) + 1,
              high = static_cast<int>(geometry_.face_width_mm() / step) + 1,
              about = static_cast<int>(reach / step) + 1;
    struct Sums {
      double with = 0.0, own = 0.0, points = 0.0;
    };
    std::vector<Sums> sums(static_cast<std::size_t>(wide + 1) * static_cast<std::size_t>(high + 1));
    for (const PointOfFlank& point : points) {
      const double um = std::clamp(point.um / sigma_um_, -kWild, kWild);
      const int u = static_cast<int>((point.along_mm - low_mm_) / step),
                v = static_cast<int>(point.up_mm / step);
      for (int i = std::max(0, u - about); i <= std::min(wide, u + about); ++i)
        for (int k = std::max(0, v - about); k <= std::min(high, v + about); ++k) {
          const double along = point.along_mm - low_mm_ - i * step, up = point.up_mm - k * step,
                       s = depth_of_pit(hollow, (along * along + up * up) / (half_mm * half_mm));
          if (s < kOnIt) continue;
          Sums& sum = sums[static_cast<std::size_t>(i * (high + 1) + k)];
          sum.with += s * um;
          sum.own += s * s;
          sum.points += 1.0;
        }
    }
    std::vector<FoundPit> places;
    for (int i = 0; i <= wide; ++i)
      for (int k = 0; k <= high; ++k) {
        const Sums& sum = sums[static_cast<std::size_t>(i * (high + 1) + k)];
        if (sum.points < kFewestInPit || sign * sum.with <= 0.0) continue;
        places.push_back({flank, low_mm_ + i * step, k * step, half_mm,
                          sigma_um_ * sum.with / sum.own, std::abs(sum.with) / std::sqrt(sum.own)});
      }
    return places;
  }

  /// How likely a pit as one that was found is found at a place of its own: as many points as fall
  /// on it by chance.
  [[nodiscard]] double chance_to_find(const FoundPit& pit, int hollow, double beyond) const {
    constexpr int kRings = 40, kMostPoints = 200;
    constexpr double kRarest = 0.25;  // one that was found hardly stands for more
    const double end = hollow == kBell ? 1.3 : 1.0, depth = std::abs(pit.depth_um) / sigma_um_;
    double area = 0.0, with = 0.0, own = 0.0;
    for (int k = 0; k < kRings; ++k) {
      const double off = end * (k + 0.5) / kRings, s = depth_of_pit(hollow, off * off);
      if (s < kOnIt) continue;
      area += off;
      with += off * s * std::min(kWild, depth * s);
      own += off * s * s;
    }
    const double each = with / std::sqrt(own * area),  // standard errors by one point
        points =
            std::min(all_ / area_mm2_ * kTwoPi * pit.half_mm * pit.half_mm * area * end / kRings,
                     0.5 * kMostPoints);
    double chance = 0.0, term = std::exp(-points);
    for (int k = 0; k < kMostPoints; ++k) {
      if (k >= static_cast<int>(kFewestInPit))
        chance += term * 0.5 *
                  std::erfc((beyond - each * std::sqrt(static_cast<double>(k))) / std::sqrt(2.0));
      term *= points / (k + 1);
    }
    return std::clamp(chance, kRarest, 1.0);
  }

  [[nodiscard]] Pits told(std::vector<FoundPit>& found, int hollow) const {
    std::sort(found.begin(), found.end(), [](const FoundPit& a, const FoundPit& b) {
      return std::abs(a.depth_um) > std::abs(b.depth_um);
    });
    const auto number = static_cast<double>(found.size());
    // Each stands for those like it that too few points met.
    double likely = 0.0, square = 0.0;
    const double beyond = beyond_of_known(half_of(found));
    for (const FoundPit& p : found) {
      const double chance = chance_to_find(p, hollow, beyond);
      likely += 1.0 / chance;
      square += (1.0 - chance) / (chance * chance);
    }
    // (those that the edges of the flank cut are seen in part)
    constexpr double kCutAndMissed = 0.28, kMostCut = 0.6;
    const double half = half_of(found),
                 cut = std::min(kMostCut,
                                2.0 * half * (1.0 / length_mm_ + 1.0 / geometry_.face_width_mm()));
    square += kCutAndMissed * cut * likely;
    likely *= 1.0 + kCutAndMissed * cut;
    double mean = 0.0;
    for (const FoundPit& p : found) mean += std::abs(p.depth_um) / number;
    Pits pits{{find_family("unnamed_pits"), FlankChoice::kBoth, {}}, 1.0};
    pits.effect.shape = {number, std::round(likely), std::round(likely + 2.0 * std::sqrt(square)),
                         static_cast<double>(hollow)};
    for (const FoundPit& p : found) {
      const double roll = (geometry_.tip_form_roll_mm() < 0.0 ? -1.0 : 1.0) *
                          std::sqrt(2.0 * geometry_.base_radius_mm() * std::max(0.0, p.along_mm));
      const int tooth = static_cast<int>(p.flank / 2) + 1, side = p.flank % 2 == 1 ? 1 : -1;
      for (const double value : {static_cast<double>(tooth), static_cast<double>(side),
                                 2.0 * geometry_.on_flank(tooth, side, roll, p.up_mm).radius_mm,
                                 p.up_mm, 2.0 * p.half_mm, std::abs(p.depth_um) / mean})
        pits.effect.shape.push_back(value);
    }
    // As many as are asked for, each as sure as the last of them.
    std::vector<double> scores;
    for (const FoundPit& p : found) scores.push_back(p.score);
    std::sort(scores.rbegin(), scores.rend());
    const double places = area_mm2_ / (cell_mm_ * cell_mm_) * 8.0;
    constexpr double kSurest = 1e-30;
    pits.p_value = std::clamp(places * normal_two_sided(scores[kFewestPits - 1]), kSurest, 1.0);
    return pits;
  }

  const FlankGeometry& geometry_;
  std::size_t flanks_;
  std::vector<std::vector<PointOfFlank>> points_, near_;
  std::array<std::array<double, 40>, 4> common_{};
  double low_mm_ = 0.0, length_mm_ = 0.0, area_mm2_ = 0.0, all_ = 0.0;
  double sigma_um_ = 0.0, cell_mm_ = 1.0;
  std::array<int, 2> cells_{};
  bool can_see_ = false;
};

}  // namespace

std::optional<Pits> pits_of_scans(const FlankGeometry& geometry, const Observations& table) {
  constexpr std::size_t kFewestPoints = 2000;
  if (table.points_mm.size() < kFewestPoints) return {};
  return PitSearch(geometry, table).run();
}

}  // namespace trueflank::loop
