// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counted from the pitch point, where a tooth pair stands does not depend on where the path begins
// and ends: with s0 the place of the lowest pair in contact,
//   pb L = int_{e2 - n pb}^{pb - e1} h_n(s0) ds0 + int_{-e1}^{e2 - n pb} h_{n+1}(s0) ds0,
//   h_k(s0) = sum |s_j| / sum (r + f_j rho_j),  s_j = s0 + j pb,  j < k,
// e1, e2: path before and after the pitch point, n = floor((e1 + e2)/pb), r and rho: base radius
// and roll length of the driven gear. The slopes by e1 and e2 are differences of two h.
#include "trueflank/search/search_mesh_loss.h"

#include <array>

namespace trueflank {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1], 8 points.
constexpr std::array<double, 4> kNode{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363};
constexpr std::array<double, 4> kWeight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                        0.1012285362903763};
/// More than rounding and the rule's remainder: the integrands are analytic within a circle of at
/// least the driven gear's radius over the friction coefficient around pieces of a base pitch.
constexpr double kRemainder = 1e-11;

/// The driven gear's lever arms.
class Arms {
 public:
  Arms(const LossMesh& mesh, const Interval& tangent) : mesh_(mesh), tangent_(tangent) {}

  [[nodiscard]] double radius() const {
    return mesh_.gear1_drives ? mesh_.base_radius2 : mesh_.base_radius1;
  }
  /// r + f rho of a pair: friction changes its sense at the pitch point.
  template <class T>
  [[nodiscard]] T arm(const T& s) const {
    // f s is of one sign: with it the roll length beyond the pitch point's takes part
    const double beyond = mesh_.gear1_drives ? (mesh_.internal ? 1.0 : -1.0) : -1.0;
    const double mu = mesh_.friction;
    return T(radius()) + sense(s) * T(radius()) * T(tangent_of<T>()) + T(beyond * mu) * absolute(s);
  }
  /// f rho's part that goes with the tangent.
  [[nodiscard]] const LossMesh& mesh() const { return mesh_; }

 private:
  static double absolute(double s) { return std::abs(s); }
  static Interval absolute(const Interval& s) { return abs(s); }
  template <class T>
  [[nodiscard]] T tangent_of() const {
    if constexpr (std::is_same_v<T, double>)
      return tangent_.middle();
    else
      return tangent_;
  }
  [[nodiscard]] double sense(double s) const {
    const double mu = mesh_.gear1_drives ? mesh_.friction : -mesh_.friction;
    return s < 0.0 ? -mu : mu;
  }
  [[nodiscard]] Interval sense(const Interval& s) const {
    if (s.lo >= 0.0 || s.hi <= 0.0) return sense(s.lo >= 0.0 ? 1.0 : -1.0);
    return {-mesh_.friction, mesh_.friction};
  }

  const LossMesh& mesh_;
  Interval tangent_;
};

double absolute(double s) { return std::abs(s); }
Interval absolute(const Interval& s) { return abs(s); }

/// h of k pairs.
template <class T>
T share(const Arms& arms, const T& lowest, int pairs) {
  T over(0.0), under(0.0);
  for (int j = 0; j < pairs; ++j) {
    const T s = lowest + T(j * arms.mesh().base_pitch);
    over = over + absolute(s);
    under = under + arms.arm(s);
  }
  return over / under;
}

/// Integral of h between two places of the lowest pair, in pieces between the places where a pair
/// passes the pitch point; backwards it counts negative.
double integral(const Arms& arms, double from, double to, int pairs) {
  if (to < from) return -integral(arms, to, from, pairs);
  double sum = 0.0, at = from;
  while (at < to) {
    double end = to;
    for (int j = 0; j < pairs; ++j) {
      const double kink = -j * arms.mesh().base_pitch;
      if (kink > at && kink < end) end = kink;
    }
    const double half = 0.5 * (end - at), middle = 0.5 * (end + at);
    for (std::size_t g = 0; g < kNode.size(); ++g)
      sum += half * kWeight[g] *
             (share(arms, middle - half * kNode[g], pairs) +
              share(arms, middle + half * kNode[g], pairs));
    at = end;
  }
  return sum;
}

int pairs_of(double length, double base_pitch) {
  return std::max(1, static_cast<int>(std::floor(length / base_pitch)));
}

/// What a slope in another direction adds, over the way to the middle.
Interval deviation(const Interval& range) { return range - Interval(range.middle()); }

Slope unknown_efficiency() {
  Slope unknown(Interval(0.0, 1.0));
  unknown.d.fill(everything());
  return unknown;
}

}  // namespace

Slope enclosed_path_efficiency(const LossMesh& mesh, const LossPath& path) {
  const double pb = mesh.base_pitch;
  constexpr double kFar = 20.0;  // base pitches: nothing is known of such a path
  if (!(path.approach.v.lo > -kFar * pb && path.approach.v.hi < kFar * pb &&
        path.recess.v.lo > -kFar * pb && path.recess.v.hi < kFar * pb))
    return unknown_efficiency();
  const Interval &e1 = path.approach.v, &e2 = path.recess.v, &tangent = path.tangent.v;
  const Arms arms(mesh, tangent);
  const double m1 = e1.middle(), m2 = e2.middle();
  const int middle_pairs = pairs_of(m1 + m2, pb);
  const Arms middle_arms(mesh, Interval(tangent.middle()));
  const double middle = integral(middle_arms, m2 - middle_pairs * pb, pb - m1, middle_pairs) +
                        integral(middle_arms, -m1, m2 - middle_pairs * pb, middle_pairs + 1);
  Interval by1, by2;
  const int least = pairs_of(e1.lo + e2.lo, pb), most = pairs_of(e1.hi + e2.hi, pb);
  for (int n = least; n <= most; ++n) {
    const Interval low = -e1, high = e2 - Interval(n * pb), top = Interval(pb) - e1;
    const Interval slope1 = share(arms, low, n + 1) - share(arms, top, n),
                   slope2 = share(arms, high, n + 1) - share(arms, high, n);
    by1 = n == least ? slope1 : hull(by1, slope1);
    by2 = n == least ? slope2 : hull(by2, slope2);
  }
  // by the tangent: |d h| <= h mu r / (r (1 - mu tan) - mu |s|), h no more than |s| over that
  const double farthest = std::max(std::max(std::abs(e1.lo), std::abs(e1.hi)),
                                   std::max(std::abs(e2.lo), std::abs(e2.hi)));
  const double radius = arms.radius();
  const double arm =
      radius * (1.0 - mesh.friction * std::max(0.0, tangent.hi)) - mesh.friction * farthest;
  const double tilt =
      arm > 0.0 ? 1.01 * farthest * mesh.friction * radius / (arm * arm) : kUnbounded;
  const Interval by3 = Interval(-tilt, tilt) * Interval(pb);
  const Interval sum = Interval(middle - kRemainder * pb, middle + kRemainder * pb) +
                       by1 * deviation(e1) + by2 * deviation(e2) + by3 * deviation(tangent);
  const double radii =
      mesh.internal ? mesh.base_radius2 - mesh.base_radius1 : mesh.base_radius1 + mesh.base_radius2;
  const Interval factor = Interval(mesh.friction * radii /
                                   (mesh.gear1_drives ? mesh.base_radius1 : mesh.base_radius2)) /
                          Interval(pb);
  const Interval efficiency = Interval(1.0) / (Interval(1.0) + factor * sum);
  const Interval falls = -(square(efficiency) * factor);
  Slope result(efficiency);
  for (std::size_t i = 0; i < 3; ++i)
    result.d[i] =
        falls * (by1 * path.approach.d[i] + by2 * path.recess.d[i] + by3 * path.tangent.d[i]);
  return result;
}

}  // namespace trueflank
