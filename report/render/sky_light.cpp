// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/sky_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/export/parallel_jobs.h"

namespace trueflank::io {
namespace {

constexpr double kGoldenAngle_rad = 2.399963229728653;
constexpr double kLampWidth_rad = 0.11;  // half the angle under which the lamp is seen
constexpr double kLowest = 0.06;         // sine of the lowest direction's height
/// A surface is taken this many samples of a map in front of itself: it is not in its own shadow.
constexpr double kRayLift = 1.6;
/// Cosine below which a direction does not count: a little light comes round the edge.
constexpr float kGrazing = -0.2F;
constexpr int kMost = 128;  // directions
/// Brighter above than at the horizon.
double brightness(const Eigen::Vector3d& towards) { return 0.55 + 0.45 * towards.z(); }

ViewDirection direction_of(const Eigen::Vector3d& v) {
  return {std::atan2(v.y(), v.x()), std::asin(std::clamp(v.z(), -1.0, 1.0))};
}

std::vector<Eigen::Vector3d> sky_directions(int count) {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < count; ++i) {
    const double z = kLowest + (1.0 - kLowest) * (i + 0.5) / count, r = std::sqrt(1.0 - z * z);
    all.emplace_back(r * std::cos(kGoldenAngle_rad * i), r * std::sin(kGoldenAngle_rad * i), z);
  }
  return all;
}

std::vector<Eigen::Vector3d> lamp_directions(const Eigen::Vector3d& middle, int count) {
  const Eigen::Vector3d u = middle.unitOrthogonal(), v = middle.cross(u);
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < count; ++i) {
    const double r = kLampWidth_rad * std::sqrt((i + 0.5) / count), turn = kGoldenAngle_rad * i;
    all.push_back((middle + r * std::cos(turn) * u + r * std::sin(turn) * v).normalized());
  }
  return all;
}

}  // namespace

SkyLight::SkyLight(const std::vector<RasterBody>& bodies, const std::optional<Cutaway>& cutaway,
                   const ViewedBall& ball, const SkyOptions& options)
    : samples_(options.map_samples),
      step_mm_(2.0 * ball.radius_mm / options.map_samples),
      lamp_(options.lamp.vector()) {
  TRUEFLANK_EXPECTS(options.directions <= kMost && options.lamp_directions <= kMost);
  add(sky_, sky_directions(options.directions), bodies, cutaway, ball);
  add(lamp_maps_, lamp_directions(lamp_, options.lamp_directions), bodies, cutaway, ball);
}

void SkyLight::add(Maps& maps, const std::vector<Eigen::Vector3d>& directions,
                   const std::vector<RasterBody>& bodies, const std::optional<Cutaway>& cutaway,
                   const ViewedBall& ball) const {
  const auto n = static_cast<std::size_t>(samples_);
  maps.count = directions.size();
  maps.depths.resize(maps.count * n * n);
  std::vector<QueuedJob> jobs;
  for (std::size_t m = 0; m < maps.count; ++m) {
    const View view = View::parallel(direction_of(directions[m]), ball, samples_);
    const Eigen::Vector3d origin = view.project(Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d step =
          k < 3 ? Eigen::Vector3d(view.project(Eigen::Vector3d::Unit(static_cast<int>(k))) - origin)
                : origin;
      maps.x[k].push_back(static_cast<float>(step.x()));
      maps.y[k].push_back(static_cast<float>(step.y()));
      maps.nearness[k].push_back(static_cast<float>(step.z()));
      if (k < 3) maps.towards[k].push_back(static_cast<float>(directions[m][static_cast<int>(k)]));
    }
    maps.brightness.push_back(static_cast<float>(brightness(directions[m])));
    maps.of_level += maps.brightness.back() * maps.towards[2].back();
    jobs.push_back(
        {[&bodies, &cutaway, &maps, view, m, n] {
           const int width = static_cast<int>(n);
           const SightWindow window =
               Raster(bodies, view, cutaway, SampleGrid::kPlain).draw(0, 0, width, width);
           for (std::size_t i = 0; i < n * n; ++i)
             maps.depths[m * n * n + i] = window.sights[i].nearness;
           return true;
         },
         {}});
  }
  run_jobs(jobs);
}

template <class Take>
void SkyLight::for_each_seen(const Maps& maps, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& normal, const Take& take) const {
  const Eigen::Vector3f p = (point + kRayLift * step_mm_ * normal).cast<float>(),
                        n = normal.cast<float>();
  // the outermost samples of a map see nothing: the ball is smaller
  const auto last = static_cast<float>(samples_ - 1);
  std::array<float, kMost> near;
  std::array<float, kMost> cosine;
  std::array<std::int32_t, kMost> at;
  for (std::size_t m = 0; m < maps.count; ++m) {
    const auto along = [&](const std::array<std::vector<float>, 4>& row) {
      return row[0][m] * p.x() + row[1][m] * p.y() + row[2][m] * p.z() + row[3][m];
    };
    const float x = std::min(std::max(along(maps.x), 0.0F), last);
    const float y = std::min(std::max(along(maps.y), 0.0F), last);
    at[m] = static_cast<std::int32_t>(y) * samples_ + static_cast<std::int32_t>(x);
    near[m] = along(maps.nearness);
    cosine[m] =
        maps.towards[0][m] * n.x() + maps.towards[1][m] * n.y() + maps.towards[2][m] * n.z();
  }
  const float* depths = maps.depths.data();
  for (std::size_t m = 0; m < maps.count; ++m, depths += samples_ * samples_)
    if (cosine[m] > kGrazing && depths[at[m]] <= near[m]) take(m, cosine[m]);
}

Light SkyLight::at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  float every = 0.0F, sky = 0.0F, open = 0.0F, lamp = 0.0F;
  const Eigen::Vector3f n = normal.cast<float>();
  for (std::size_t m = 0; m < sky_.count; ++m) {
    const Eigen::Vector3f t(sky_.towards[0][m], sky_.towards[1][m], sky_.towards[2][m]);
    every += sky_.brightness[m] * std::max(0.0F, n.dot(t) - kGrazing);
  }
  for_each_seen(sky_, point, normal, [&](std::size_t m, float cosine) {
    open += sky_.brightness[m] * (cosine - kGrazing);
    sky += sky_.brightness[m] * std::max(0.0F, cosine);
  });
  for_each_seen(lamp_maps_, point, normal,
                [&](std::size_t, float cosine) { lamp += std::max(0.0F, cosine); });
  return {.sky = sky / sky_.of_level,
          .lamp = lamp / static_cast<float>(lamp_maps_.count),
          .open = every > 0.0F ? open / every : 0.0F};
}

}  // namespace trueflank::io
