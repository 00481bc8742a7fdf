// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/pose/pose_search.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/base/widest_registers.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

using Point = std::array<double, 3>;
using Points = ScanPoints;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Principal directions of the points, the far ones left out step by step.
Eigen::Matrix3d principal_directions(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    std::vector<double> c;
    for (const auto& p : points) c.push_back(p[k]);
    mean[k] = quantile(c, 0.5);
  }
  double reach = 1e300;
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
  for (int round = 0; round < 4; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    std::vector<double> distances;
    double count = 0.0;
    for (const auto& p : points) {
      const Eigen::Vector3d d = Eigen::Vector3d(p[0], p[1], p[2]) - mean;
      distances.push_back(d.norm());
      if (d.norm() > reach) continue;
      sum += d;
      moment += d * d.transpose();
      count += 1.0;
    }
    sum /= count;
    directions =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment / count - sum * sum.transpose())
            .eigenvectors();
    mean += sum;
    reach = 1.5 * quantile(distances, 0.9);
  }
  return directions;
}

/// Eigen::Quaterniond::FromTwoVectors without its case of opposite directions, which takes a
/// singular value decomposition that compiles for seconds.
Eigen::Matrix3d turn_onto_z(Eigen::Vector3d axis) {
  if (axis.z() < 0.0) axis = -axis;
  const Eigen::Vector3d from = axis.normalized();
  const double s = std::sqrt((1.0 + from.z()) * 2.0), inverse = 1.0 / s;
  return Eigen::Quaterniond(s * 0.5, from.y() * inverse, -from.x() * inverse, 0.0)
      .toRotationMatrix();
}

constexpr std::size_t kPointsAtOnce = 64;

/// `visit(first, moved)` for some points at a time, moved by a pose; as long as it says so.
template <class Visit>
void for_moved(const Pose& pose, const Points& points, std::size_t from, std::size_t to,
               const Visit& visit) {
  std::array<Point, kPointsAtOnce> moved;
  for (std::size_t first = from; first < to; first += kPointsAtOnce) {
    const std::size_t count = std::min(kPointsAtOnce, to - first);
    for (std::size_t k = 0; k < count; ++k) moved[k] = pose(points[first + k]);
    if (!visit(first, std::span<const Point>(moved.data(), count))) return;
  }
}

/// Distance of a point from its flank, NaN where it is far from any; what moves it.
struct Row {
  double distance = kNaN;
  Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
};

Row row_of(const FlankGeometry& geometry, const Point& q, const PlacedPoint& placed, double width) {
  if (placed.place.surface != Surface::kFlank || std::abs(placed.distance_mm) > width) return {};
  const double cos_helix = geometry.cos_base_helix();
  const double nx = cos_helix * placed.place.normal_direction[0];
  const double ny = cos_helix * placed.place.normal_direction[1];
  const double nz = geometry.normal_z(placed.place);
  Row row{placed.distance_mm, {}};
  row.gradient << nx, ny, q[1] * nz - q[2] * ny, q[2] * nx - q[0] * nz, q[0] * ny - q[1] * nx;
  return row;
}

}  // namespace

Points thinned(const Points& points, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / most);
  Points result;
  for (std::size_t i = 0; i < points.size(); i += step) result.push_back(points[i]);
  return result;
}

std::array<Eigen::Matrix3d, 3> principal_rotations(const ScanPoints& points) {
  const Eigen::Matrix3d directions = principal_directions(points);
  std::array<Eigen::Matrix3d, 3> rotations;
  for (std::size_t k = 0; k < rotations.size(); ++k)
    rotations[k] = turn_onto_z(directions.col(static_cast<Eigen::Index>(k)));
  return rotations;
}

Pose PoseSearch::best() const {
  const std::array<Eigen::Matrix3d, 3> rotations = principal_rotations(fine_);
  std::array<Pose, 3> poses;
  std::array<double, 3> costs{};
  for_each_piece(poses.size(), [&](std::size_t k) { poses[k] = start(rotations[k]); });
  for (std::size_t k = 0; k < poses.size(); ++k) costs[k] = search_phase(poses[k]);
  const auto least = std::min_element(costs.begin(), costs.end()) - costs.begin();
  return refined(poses[static_cast<std::size_t>(least)], fine_, {.rounds = 12, .still = 1e-5});
}

Pose PoseSearch::best_of_all_axes() const {
  constexpr std::size_t kMost = 4;
  const std::vector<Eigen::Vector3d> axes = likeliest_axes(kMost);
  std::vector<Pose> poses(axes.size());
  for_each_piece(poses.size(), [&](std::size_t k) { poses[k] = start(turn_onto_z(axes[k])); });
  std::vector<double> costs;
  for (Pose& pose : poses) costs.push_back(search_phase(pose));
  const auto least = std::min_element(costs.begin(), costs.end()) - costs.begin();
  return refined(poses[static_cast<std::size_t>(least)], fine_, {.rounds = 12, .still = 1e-5});
}

Pose PoseSearch::best_as_it_stands() const {
  Pose pose;
  place_height(pose, coarse_);
  (void)search_phase(pose);
  return refined(pose, fine_, {.rounds = 12, .still = 1e-5});
}

Pose PoseSearch::about(const Eigen::Matrix3d& rotation) const {
  Pose pose = start(rotation);
  (void)search_phase(pose);
  return pose;
}

Pose PoseSearch::refined(Pose pose, const Points& points, const Rounds& limits) const {
  constexpr double kHardly = 0.02;
  double width = 0.3 * geometry_.gear().normal_module_mm;
  for (int round = 0; round < limits.rounds; ++round) {
    const double width_before = width;
    const Vector5 step = newton_step(pose, points, width);
    const Eigen::Vector3d turn(step[2], step[3], step[4]);
    const double angle = turn.norm();
    const Eigen::Matrix3d rotation = angle > 0.0
                                         ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                                         : Eigen::Matrix3d::Identity();
    pose.rotation = rotation * pose.rotation;
    pose.translation_mm = rotation * pose.translation_mm + Eigen::Vector3d(step[0], step[1], 0.0);
    if (geometry_.is_herringbone())
      pose.translation_mm.z() += height_step_mm(pose, points, width);
    else
      place_height(pose, points);
    if (step.norm() < limits.still && width > (1.0 - kHardly) * width_before) break;
  }
  return pose;
}

double PoseSearch::unlike_a_cylinder(const Eigen::Vector3d& axis, const Points& points) const {
  Pose pose;
  pose.rotation = turn_onto_z(axis);
  place_height(pose, points);
  const Eigen::Vector2d centre = circle_centre(pose, points);
  const double half = 0.5 * geometry_.face_width_mm();
  double sum = 0.0, squares = 0.0, beyond = 0.0;
  for (const Point& p : points) {
    const Point q = pose(p);
    const double radius = std::hypot(q[0] - centre.x(), q[1] - centre.y());
    sum += radius;
    squares += radius * radius;
    beyond += std::pow(std::max(0.0, std::abs(q[2] - half) - half), 2);
  }
  const auto count = static_cast<double>(points.size());
  return squares / count - std::pow(sum / count, 2) + beyond / count;
}

std::vector<Eigen::Vector3d> PoseSearch::likeliest_axes(std::size_t most) const {
  constexpr int kOfGrid = 600;  // 6 degrees apart
  constexpr double kFirstStep_rad = 0.06, kLastStep_rad = 0.002, kSame_rad = 0.05;
  std::vector<std::pair<double, Eigen::Vector3d>> tried(kOfGrid);
  for_each_piece(tried.size(), [&](std::size_t k) {
    // Vogel's spiral over a hemisphere.
    const double z = 1.0 - (static_cast<double>(k) + 0.5) / kOfGrid;
    const double angle = kPi * (3.0 - std::sqrt(5.0)) * static_cast<double>(k);
    const double r = std::sqrt(1.0 - z * z);
    tried[k].second = {r * std::cos(angle), r * std::sin(angle), z};
    tried[k].first = unlike_a_cylinder(tried[k].second, few_);
  });
  const auto cheaper = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(tried.begin(), tried.end(), cheaper);
  tried.resize(4 * most);
  for_each_piece(tried.size(), [&](std::size_t k) {
    auto& [unlike, axis] = tried[k];
    unlike = unlike_a_cylinder(axis, coarse_);
    for (double step = kFirstStep_rad; step > kLastStep_rad; step *= 0.5)
      for (bool moved = true; moved;) {
        moved = false;
        const Eigen::Vector3d one = axis.unitOrthogonal(), other = axis.cross(one);
        for (const auto& [a, b] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
          const Eigen::Vector3d beside = (axis + step * (a * one + b * other)).normalized();
          const double there = unlike_a_cylinder(beside, coarse_);
          if (!(there < unlike)) continue;
          unlike = there;
          axis = beside;
          moved = true;
          break;
        }
      }
  });
  std::stable_sort(tried.begin(), tried.end(), cheaper);
  std::vector<Eigen::Vector3d> axes;
  for (const auto& found : tried) {
    const Eigen::Vector3d& axis = found.second;
    const bool is_new = std::none_of(axes.begin(), axes.end(), [&](const Eigen::Vector3d& known) {
      return known.cross(axis).norm() < kSame_rad;
    });
    if (is_new && axes.size() < most) axes.push_back(axis);
  }
  return axes;
}

void PoseSearch::place_height(Pose& pose, const Points& points) const {
  std::vector<double> z;
  z.reserve(points.size());
  for (const auto& p : points) z.push_back(pose(p)[2]);
  const double low = quantile(z, 0.005), high = quantile(std::move(z), 0.995);
  pose.translation_mm.z() += 0.5 * (geometry_.face_width_mm() - low - high);
}

Pose PoseSearch::start(const Eigen::Matrix3d& rotation) const {
  Pose pose;
  pose.rotation = rotation;
  place_height(pose, coarse_);
  Eigen::Vector2d centre = circle_centre(pose, coarse_);
  for (int round = 0; round < 6; ++round) centre += tip_circle_step(pose, centre);
  pose.translation_mm.head<2>() = -centre;
  return pose;
}

Eigen::Vector2d PoseSearch::circle_centre(const Pose& pose, const Points& points) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& p : points) {
    const auto q = pose(p);
    const Eigen::Vector3d row(q[0], q[1], 1.0);
    normal += row * row.transpose();
    right += row * (q[0] * q[0] + q[1] * q[1]);
  }
  return 0.5 * normal.ldlt().solve(right).head<2>();
}

Eigen::Vector2d PoseSearch::tip_circle_step(const Pose& pose, const Eigen::Vector2d& centre) const {
  const int bins = std::clamp(geometry_.teeth(), 8, 48);
  std::vector<std::vector<double>> radii(bins);
  for (std::vector<double>& of_bin : radii) of_bin.reserve(2 * fine_.size() / radii.size());
  for (const auto& p : fine_) {
    const auto q = pose(p);
    const double x = q[0] - centre.x(), y = q[1] - centre.y();
    const int bin = static_cast<int>(wrapped_rad(std::atan2(y, x)) / kTwoPi * bins) % bins;
    radii[bin].push_back(geometry_.sense() * std::hypot(x, y));
  }
  Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() * 1e-9;
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  const double width = 2.0 * geometry_.gear().normal_module_mm;
  for (int bin = 0; bin < bins; ++bin) {
    if (radii[bin].size() < 5) continue;
    const double gap = geometry_.sense() * quantile(radii[bin], 0.96) - geometry_.tip_radius_mm();
    const double w = std::max(0.0, 1.0 - gap * gap / (width * width));
    const double angle = (bin + 0.5) * kTwoPi / bins;
    const Eigen::Vector2d row(std::cos(angle), std::sin(angle));
    normal += w * row * row.transpose();
    right += w * gap * row;
  }
  return normal.ldlt().solve(right);
}

double PoseSearch::cost(const Pose& pose, const Points& points, double most) const {
  const double reach = 0.2 * geometry_.gear().normal_module_mm;
  double sum = 0.0;
  std::array<double, kPointsAtOnce> distances;
  for_moved(pose, points, 0, points.size(), [&](std::size_t, std::span<const Point> moved) {
    geometry_.nearest_distances_mm(moved, reach, distances.data());
    for (std::size_t k = 0; k < moved.size(); ++k)
      sum += std::isnan(distances[k]) ? reach : distances[k];
    return !(sum > most);
  });
  return sum > most ? kInfinite : sum;
}

double PoseSearch::search_phase(Pose& pose) const {
  if (!geometry_.is_herringbone()) return search_phase_as_it_stands(pose);
  // Turned over, its lower half has the other hand.
  const Eigen::Matrix3d over = Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Pose turned_over{over * pose.rotation, over * pose.translation_mm +
                                             Eigen::Vector3d(0.0, 0.0, geometry_.face_width_mm())};
  const double cost = search_phase_as_it_stands(pose),
               cost_over = search_phase_as_it_stands(turned_over);
  if (cost_over < cost) pose = turned_over;
  return std::min(cost, cost_over);
}

double PoseSearch::search_phase_as_it_stands(Pose& pose) const {
  const double pitch = kTwoPi / geometry_.teeth();
  const double step = 0.25 * geometry_.gear().normal_module_mm;
  constexpr int kPhases = 24;
  std::vector<std::pair<double, Pose>> tried;
  for (int i = 0; i < kPhases; ++i) {
    Pose turned = pose;
    const Eigen::Matrix3d r =
        Eigen::AngleAxisd(pitch * i / kPhases, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    turned.rotation = r * turned.rotation;
    turned.translation_mm = r * turned.translation_mm;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        Pose moved = turned;
        moved.translation_mm += Eigen::Vector3d(dx * step, dy * step, 0.0);
        tried.emplace_back(0.0, moved);
      }
  }
  // Few points tell most trials from the good ones, more of them the good ones from each other.
  constexpr std::size_t kGood = 40, kRefined = 4;
  judge(tried, few_, kGood);
  const auto cheaper = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(tried.begin(), tried.end(), cheaper);
  if (tried.size() > kGood) tried.resize(kGood);
  judge(tried, coarse_, kRefined);
  std::stable_sort(tried.begin(), tried.end(), cheaper);
  tried.resize(std::min(kRefined, tried.size()));
  for_each_piece(tried.size(), [&](std::size_t k) {
    auto& [value, trial] = tried[k];
    trial = refined(trial, coarse_, {.rounds = 8, .still = 1e-4});
    value = cost(trial, coarse_);
  });
  const auto best = std::min_element(tried.begin(), tried.end(), cheaper);
  pose = best->second;
  return best->first;
}

void PoseSearch::judge(std::vector<std::pair<double, Pose>>& tried, const Points& points,
                       std::size_t best) const {
  std::mutex mutex;
  std::vector<double> cheapest;  // the most expensive first
  for_each_piece(tried.size(), [&](std::size_t k) {
    double most = kInfinite;
    {
      const std::lock_guard lock(mutex);
      if (cheapest.size() == best) most = cheapest.front();
    }
    tried[k].first = cost(tried[k].second, points, most);
    const std::lock_guard lock(mutex);
    cheapest.push_back(tried[k].first);
    std::push_heap(cheapest.begin(), cheapest.end());
    if (cheapest.size() <= best) return;
    std::pop_heap(cheapest.begin(), cheapest.end());
    cheapest.pop_back();
  });
}

PoseSearch::Vector5 PoseSearch::newton_step(const Pose& pose, const Points& points,
                                            double& width) const {
  std::vector<Row> rows(points.size());
  constexpr std::size_t kAtOnce = 1536;
  for_each_run(points.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    std::array<PlacedPoint, kPointsAtOnce> placed;
    for_moved(pose, points, from, to, [&](std::size_t first, std::span<const Point> moved) {
      geometry_.nearest_flanks(moved, 0.03, placed.data());
      for (std::size_t k = 0; k < moved.size(); ++k)
        rows[first + k] = row_of(geometry_, moved[k], placed[k], width);
      return true;
    });
  });
  std::vector<double> sizes;
  sizes.reserve(rows.size());
  for (const Row& row : rows)
    if (!std::isnan(row.distance)) sizes.push_back(std::abs(row.distance));
  if (sizes.size() < 20) return Vector5::Zero();
  // The lower triangle row by row, all that is asked for, and the right side: written out, so
  // that the sums stay in registers.
  std::array<double, 20> sums{};
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    std::array<double, 20> sum{};
    for (const Row& row : rows) {
      if (std::isnan(row.distance)) continue;
      const double t = row.distance / width;
      const double w = (1.0 - t * t) * (1.0 - t * t);
      const double g[5] = {row.gradient[0], row.gradient[1], row.gradient[2], row.gradient[3],
                           row.gradient[4]};
      const double d = -(w * row.distance),
                   h[5] = {w * g[0], w * g[1], w * g[2], w * g[3], w * g[4]};
      const double left[20] = {h[0], h[1], h[1], h[2], h[2], h[2], h[3], h[3], h[3], h[3],
                               h[4], h[4], h[4], h[4], h[4], d,    d,    d,    d,    d};
      const double right[20] = {g[0], g[0], g[1], g[0], g[1], g[2], g[0], g[1], g[2], g[3],
                                g[0], g[1], g[2], g[3], g[4], g[0], g[1], g[2], g[3], g[4]};
      for (std::size_t k = 0; k < 20; ++k) sum[k] += left[k] * right[k];
    }
    sums = sum;
  });
  Matrix5 normal = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  for (int i = 0, k = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) normal(i, j) = sums[static_cast<std::size_t>(k++)];
    right[i] = sums[static_cast<std::size_t>(15 + i)];
  }
  normal.diagonal() += Vector5::Constant(1e-9 * normal.trace());
  const double scale = kSigmaOfMedianSize * quantile(sizes, 0.5);
  width = std::clamp(6.0 * scale, 2e-3, width);
  return normal.ldlt().solve(right);
}

double PoseSearch::height_step_mm(const Pose& pose, const Points& points, double width) const {
  double products = 0.0, squares = 0.0;
  std::array<PlacedPoint, kPointsAtOnce> placed;
  for_moved(pose, points, 0, points.size(), [&](std::size_t, std::span<const Point> moved) {
    geometry_.nearest_flanks(moved, 0.03, placed.data());
    for (std::size_t k = 0; k < moved.size(); ++k) {
      const double t = placed[k].distance_mm / width;
      if (placed[k].place.surface != Surface::kFlank || !(std::abs(t) < 1.0)) continue;
      const double w = (1.0 - t * t) * (1.0 - t * t), along = geometry_.normal_z(placed[k].place);
      products += w * along * placed[k].distance_mm;
      squares += w * along * along;
    }
    return true;
  });
  return squares > 0.0 ? -products / squares : 0.0;
}

}  // namespace trueflank::loop
