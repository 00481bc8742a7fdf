// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/ground_shade.h"

#include <algorithm>
#include <cmath>

#include "trueflank/export/parallel_jobs.h"

namespace trueflank::io {
namespace {

constexpr double kFar = 4.0;  // radii of the ball; beyond, there is no shadow
/// Shares of the light.
constexpr double kAlways = 0.30, kSky = 0.45, kLamp = 0.25;
constexpr int kSmoothings = 2;

double shade_at(const SkyLight& sky, const View& view, const ViewedBall& ball, double ground_mm,
                double x, double y) {
  const ViewedPlane p = view.plane(Eigen::Vector3d::UnitZ(), ground_mm);
  const double nearness = -(p.a * x + p.b * y + p.c) / p.e;
  if (!(nearness > 0.0)) return 1.0;  // above the horizon
  const Eigen::Vector3d point = view.unproject(x, y, nearness);
  if ((point - ball.centre).norm() > kFar * ball.radius_mm) return 1.0;
  const Light light = sky.at(point, Eigen::Vector3d::UnitZ());
  return kAlways + kSky * light.sky + kLamp * std::min(1.0, light.lamp / sky.lamp().z());
}

/// One half its own value, one half its neighbours', along rows or columns.
void smooth(std::vector<double>& values, int count, std::size_t step, int lines,
            std::size_t line_step) {
  for (int line = 0; line < lines; ++line) {
    double* row = values.data() + line_step * static_cast<std::size_t>(line);
    double before = row[0];
    for (int i = 0; i < count; ++i) {
      double& here = row[step * static_cast<std::size_t>(i)];
      const double after = i + 1 < count ? row[step * static_cast<std::size_t>(i + 1)] : here;
      const double old = here;
      here = 0.25 * (before + after) + 0.5 * here;
      before = old;
    }
  }
}

}  // namespace

GroundShade::GroundShade(const SkyLight& sky, const View& view, const ViewedBall& ball,
                         double ground_mm, int step, int width, int height)
    : step_(step), columns_(width / step + 2), rows_(height / step + 2) {
  const auto columns = static_cast<std::size_t>(columns_);
  shades_.resize(columns * static_cast<std::size_t>(rows_));
  std::vector<QueuedJob> jobs;
  for (int j = 0; j < rows_; ++j)
    jobs.push_back(
        {[&, j] {
           for (int i = 0; i < columns_; ++i)
             shades_[static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i)] =
                 shade_at(sky, view, ball, ground_mm, i * step_, j * step_);
           return true;
         },
         {}});
  run_jobs(jobs);
  for (int i = 0; i < kSmoothings; ++i) {
    smooth(shades_, columns_, 1, rows_, columns);
    smooth(shades_, rows_, columns, columns_, 1);
  }
}

double GroundShade::at(double x, double y) const {
  const double u = std::clamp(x / step_, 0.0, columns_ - 1.001),
               v = std::clamp(y / step_, 0.0, rows_ - 1.001);
  const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
  const double p = u - static_cast<double>(i), q = v - static_cast<double>(j);
  const double* here = shades_.data() + j * static_cast<std::size_t>(columns_) + i;
  return (1.0 - q) * ((1.0 - p) * here[0] + p * here[1]) +
         q * ((1.0 - p) * here[columns_] + p * here[columns_ + 1]);
}

}  // namespace trueflank::io
