// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/efficiency_sliding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trueflank {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1], 8 points.
constexpr std::array<double, 8> kNode{-0.9602898564975363, -0.7966664774136267,
                                      -0.5255324099163290, -0.1834346424956498,
                                      0.1834346424956498,  0.5255324099163290,
                                      0.7966664774136267,  0.9602898564975363};
constexpr std::array<double, 8> kWeight{0.1012285362903763, 0.2223810344533745, 0.3137066458778873,
                                        0.3626837833783620, 0.3626837833783620, 0.3137066458778873,
                                        0.2223810344533745, 0.1012285362903763};
/// Stiffness of a tooth pair along its path, relative to mid contact: a parabola that falls to 0.7
/// at the ends; the fall of single stiffness usual in mesh stiffness models (docs/efficiency.md).
constexpr double kStiffnessAtEnds = 0.7;

double share(LoadSharing sharing, const ContactPath& path, double roll_mm) {
  if (sharing == LoadSharing::kEqual) return 1.0;
  const double half = 0.5 * (path.end_mm - path.start_mm);
  const double u = (roll_mm - path.start_mm - half) / half;
  return 1.0 - (1.0 - kStiffnessAtEnds) * u * u;
}

/// Torques on both gears for a unit of load, at one moment of the mesh cycle.
struct Torques {
  double torque1 = 0.0, torque2 = 0.0;
  double load = 0.0;  ///< normal forces, so summed up
};

/// Torques with friction as it is where gear 1 drives, and where gear 2 does.
struct TorquesBothWays {
  Torques gear1_drives, gear2_drives;
};

/// Calls `add(load, roll length on gear 1, on gear 2, beyond the pitch point)` for every tooth pair in
/// contact whose first possible place is `offset` (in base pitches) after the start of the path.
template <class Add>
void for_each_pair(const ContactPath& path, LoadSharing sharing, double offset, const Add& add) {
  const double pitch_point2 = path.pitch_point_mm * path.base_radius2_mm / path.base_radius1_mm;
  for (double roll = path.start_mm + offset * path.base_pitch_mm; roll <= path.end_mm;
       roll += path.base_pitch_mm) {
    const double s = roll - path.pitch_point_mm;
    add(share(sharing, path, roll), roll, pitch_point2 + (path.internal ? s : -s), !(s < 0.0));
  }
}

/// `friction` > 0: gear 1 drives; < 0: gear 2 drives.
void add_pair(const ContactPath& path, double friction, double load, double roll, double roll2,
              bool beyond, Torques& sum) {
  const double f = beyond ? friction : -friction;
  sum.load += load;
  sum.torque1 += load * (path.base_radius1_mm + f * roll);
  sum.torque2 += load * (path.base_radius2_mm + f * roll2);
}

/// Of all tooth pairs in contact.
void add_pairs(const ContactPath& path, double friction, LoadSharing sharing, double offset,
               Torques& sum) {
  for_each_pair(path, sharing, offset, [&](double load, double roll, double roll2, bool beyond) {
    add_pair(path, friction, load, roll, roll2, beyond, sum);
  });
}
TorquesBothWays both_ways(const ContactPath& path, double friction, LoadSharing sharing,
                          double offset) {
  TorquesBothWays sum;
  for_each_pair(path, sharing, offset, [&](double load, double roll, double roll2, bool beyond) {
    add_pair(path, friction, load, roll, roll2, beyond, sum.gear1_drives);
    add_pair(path, -friction, load, roll, roll2, beyond, sum.gear2_drives);
  });
  return sum;
}

/// Moments of the cycle (fractions of a base pitch) at which a pair enters or leaves or passes the
/// pitch point, with 0 and 1.
std::array<double, 4> cycle_breaks(const ContactPath& path) {
  const auto fraction = [&](double length_mm) {
    const double f = length_mm / path.base_pitch_mm;
    return f - std::floor(f);
  };
  std::array<double, 4> breaks{0.0, fraction(path.end_mm - path.start_mm),
                               fraction(path.pitch_point_mm - path.start_mm), 1.0};
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/// Torques summed up over the face of a helical mesh: along it the teeth stand at every moment of a
/// stretch of the cycle. Between two breaks the torques are polynomials of third degree, so their
/// integrals are exact.
class FaceTorques {
 public:
  FaceTorques(const ContactPath& path, double friction, LoadSharing sharing)
      : breaks_(cycle_breaks(path)) {
    for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
      Piece piece{.begin = breaks_[i], .width = breaks_[i + 1] - breaks_[i], .before = whole_};
      std::array<Torques, 4> at;
      for (std::size_t k = 0; piece.width > 0.0 && k < at.size(); ++k)
        add_pairs(path, friction, sharing, piece.begin + piece.width * kPlaces[k], at[k]);
      for (std::size_t k = 0; k < at.size(); ++k)
        piece.values[k] = {at[k].torque1, at[k].torque2, at[k].load};
      pieces_.push_back(piece);
      whole_ = integral(piece, 1.0);
    }
  }

  /// Over a face that begins at a moment of the cycle and reaches `overlap` base pitches on.
  [[nodiscard]] Torques over(double begin, double overlap) const {
    const double turns = std::floor(overlap), end = begin + overlap - turns;
    Sums sums = end < 1.0 ? up_to(end) : up_to(end - 1.0);
    const Sums at_begin = up_to(begin);
    for (std::size_t q = 0; q < sums.size(); ++q)
      sums[q] += (turns + (end < 1.0 ? 0.0 : 1.0)) * whole_[q] - at_begin[q];
    // what rounding leaves where no teeth touch is no load
    const bool touches = sums[2] > kNothing * whole_[2];
    return touches ? Torques{sums[0], sums[1], sums[2]} : Torques{};
  }

  /// Where the torques over a face change their polynomials, with 0 and 1.
  [[nodiscard]] std::vector<double> breaks(double overlap) const {
    std::vector<double> all(breaks_.begin(), breaks_.end());
    for (const double at : breaks_) {
      const double shifted = at - overlap;
      all.push_back(shifted - std::floor(shifted));
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  using Sums = std::array<double, 3>;  ///< of torque 1, torque 2, load
  struct Piece {
    double begin = 0.0, width = 0.0;
    Sums before{};                  ///< integrals from the cycle's beginning
    std::array<Sums, 4> values{};   ///< at kPlaces
  };
  /// Of a piece, from 0 to 1: inside, as a pair enters or leaves at its ends.
  static constexpr std::array<double, 4> kPlaces{0.125, 0.375, 0.625, 0.875};
  static constexpr double kNothing = 1e-12;

  /// To a share of a piece: the integral of the polynomial through its four values.
  static Sums integral(const Piece& piece, double share) {
    Sums sums = piece.before;
    const double t = share;
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
      // product of (t - p_j), j other than k, as a polynomial
      std::array<double, 4> c{1.0, 0.0, 0.0, 0.0};
      double scale = 1.0;
      for (std::size_t j = 0; j < kPlaces.size(); ++j) {
        if (j == k) continue;
        for (std::size_t d = 3; d > 0; --d) c[d] = c[d - 1] - kPlaces[j] * c[d];
        c[0] *= -kPlaces[j];
        scale *= kPlaces[k] - kPlaces[j];
      }
      const double area =
          t * (c[0] + t * (c[1] / 2.0 + t * (c[2] / 3.0 + t * c[3] / 4.0))) / scale * piece.width;
      for (std::size_t q = 0; q < sums.size(); ++q) sums[q] += area * piece.values[k][q];
    }
    return sums;
  }

  [[nodiscard]] Sums up_to(double moment) const {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && pieces_[i + 1].begin <= moment) ++i;
    const Piece& piece = pieces_[i];
    return piece.width > 0.0 ? integral(piece, (moment - piece.begin) / piece.width) : piece.before;
  }

  std::array<double, 4> breaks_;
  std::vector<Piece> pieces_;
  Sums whole_{};
};

struct TorqueRatio {
  double mean = 0.0;
  bool blocked = false;      ///< at some moment no torque comes out
  bool interrupted = false;  ///< at some moment no teeth touch
};

/// Adds a moment of the cycle, with its share of it, to the mean of (torque of the driving gear / torque
/// of the driven gear).
void add_moment(double share, double driving, double driven, double load, TorqueRatio& ratio) {
  ratio.interrupted = ratio.interrupted || load == 0.0;
  ratio.blocked = ratio.blocked || !(driven > 0.0);
  ratio.mean += share * (driving / driven);
}

/// Means over the mesh cycle.
struct TorqueRatios {
  TorqueRatio gear1_drives, gear2_drives;
};
template <class Breaks, class TorquesAt>
TorqueRatios mean_over(const Breaks& breaks, const TorquesAt& torques_at) {
  TorqueRatios ratios;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double half = 0.5 * (breaks[i + 1] - breaks[i]);
    for (std::size_t g = 0; half > 0.0 && g < kNode.size(); ++g) {
      const TorquesBothWays t = torques_at(breaks[i] + half * (1.0 + kNode[g]));
      const Torques &one = t.gear1_drives, &two = t.gear2_drives;
      add_moment(half * kWeight[g], one.torque1, one.torque2, one.load, ratios.gear1_drives);
      add_moment(half * kWeight[g], two.torque2, two.torque1, two.load, ratios.gear2_drives);
    }
  }
  return ratios;
}
TorqueRatios mean_torque_ratios(const ContactPath& path, double friction, LoadSharing sharing) {
  if (path.overlap_ratio == 0.0)
    return mean_over(cycle_breaks(path), [&](double moment) {
      return both_ways(path, friction, sharing, moment);
    });
  const FaceTorques face1(path, friction, sharing), face2(path, -friction, sharing);
  const double overlap = path.overlap_ratio;
  return mean_over(face1.breaks(overlap), [&](double moment) {
    return TorquesBothWays{face1.over(moment, overlap), face2.over(moment, overlap)};
  });
}

}  // namespace

ContactPath contact_path(const GearPair& pair, double face_width_mm) {
  const LineOfAction line = line_of_action(pair);
  ContactPath path;
  path.base_radius1_mm = base_radius_mm(pair.gear1());
  path.base_radius2_mm = base_radius_mm(pair.gear2());
  path.internal = pair.internal();
  path.pitch_point_mm = line.pitch_point_mm;
  path.start_mm = line.effective_start_mm;
  path.end_mm = line.effective_end_mm;
  path.base_pitch_mm = line.base_pitch_mm;
  path.base_helix_angle_rad = std::abs(base_helix_angle_rad(pair.gear1()));
  path.overlap_ratio = face_width_mm * std::tan(path.base_helix_angle_rad) / line.base_pitch_mm;
  return path;
}

SlidingEfficiency sliding_efficiency(const ContactPath& path, double friction,
                                     LoadSharing sharing) {
  SlidingEfficiency result;
  const double length = path.end_mm - path.start_mm;
  // helical teeth hand over along the face too
  const bool interrupted = path.overlap_ratio == 0.0 && !(length >= path.base_pitch_mm);
  if (!(length > 0.0) || interrupted) return result;
  const double ideal = path.base_radius1_mm / path.base_radius2_mm;  // torque 1 / torque 2
  // the transverse part of an inclined normal force is smaller than the force friction follows
  const double transverse = friction / std::cos(path.base_helix_angle_rad);
  const auto [ratio1, ratio2] = mean_torque_ratios(path, transverse, sharing);
  if (ratio1.interrupted || ratio2.interrupted) return result;
  result.gear1_driving = ratio1.blocked ? 0.0 : ideal / ratio1.mean;
  // -0.0 is no driving side: without friction both directions lose nothing
  result.gear2_driving = friction == 0.0 ? result.gear1_driving
                         : ratio2.blocked ? 0.0 : 1.0 / (ideal * ratio2.mean);
  return result;
}

}  // namespace trueflank
