// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/export/parallel_jobs.h"
#include "trueflank/report/render/ground_shade.h"
#include "trueflank/report/render/sky_light.h"

namespace trueflank::io {
namespace {

constexpr int kSamples = 4;  // of a pixel, either way
constexpr int kTilePixels = 32;
constexpr int kLineSamples = 3;    // width of the line round a cut face
constexpr int kGroundPixels = 4;   // between two places at which the ground's light is looked up
constexpr double kDistance = 5.0;  // of the viewer, in radii of what is seen
constexpr double kMargin = 0.045;  // free border, of the picture's height
constexpr double kLampTurn_rad = -0.75, kLampHeight_rad = 0.95;  // against the viewer
constexpr double kSameSurface = 0.97;  // cosine between normals that one pixel takes as one
constexpr double kHatchLine = 0.55, kEdgeLine = 0.85;  // how dark
constexpr Colour kGround{0xF6, 0xF7, 0xF9};

using Rgb = Eigen::Array3d;

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}
Rgb linear(Colour colour) {
  return {linear(colour.red / 255.0), linear(colour.green / 255.0), linear(colour.blue / 255.0)};
}
/// Of light from 0 to 1.
std::uint8_t encoded(double channel) {
  constexpr int kSteps = 1 << 14;
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> values(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      const double c = static_cast<double>(i) / kSteps;
      const double srgb = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
      values[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * srgb));
    }
    return values;
  }();
  return table[static_cast<std::size_t>(kSteps * std::clamp(channel, 0.0, 1.0) + 0.5)];
}

/// x to the power of 2 to the power of n.
double squared(double x, int n) {
  for (int i = 0; i < n; ++i) x *= x;
  return x;
}

/// Bright values bend towards white and do not break off.
Rgb toned(const Rgb& light) {
  constexpr double kKnee = 0.7;
  return light.unaryExpr([](double v) {
    return v <= kKnee ? v : 1.0 - (1.0 - kKnee) * std::exp(-(v - kKnee) / (1.0 - kKnee));
  });
}

/// What one pixel sees of one surface.
struct Patch {
  std::uint32_t surface = 0;  ///< one of those that look alike
  std::size_t body = 0;
  int cut_plane = -1;  ///< of a cut face
  int count = 0;
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();  ///< sum of the samples: x, y, nearness
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double lines = 0.0;  ///< how dark the lines on a cut face are
};

struct Bounds {
  std::vector<Eigen::Vector3d>
      corners;  ///< of the bodies' boxes and more: what a picture must hold
  ViewedBall ball;
  double ground_mm = 0.0;
};

Bounds bounds_of(const std::vector<RenderedBody>& bodies) {
  Bounds bounds;
  Eigen::AlignedBox3d box;
  for (const RenderedBody& rendered : bodies)
    for (const auto& vertex : rendered.body.mesh->mesh.vertices) {
      bounds.corners.push_back(rendered.body.place(vertex));
      box.extend(bounds.corners.back());
    }
  bounds.ball.centre = box.center();
  double radius2 = 0.0;
  for (const Eigen::Vector3d& p : bounds.corners)
    radius2 = std::max(radius2, (p - bounds.ball.centre).squaredNorm());
  bounds.ball.radius_mm = 1.02 * std::sqrt(radius2);
  bounds.ground_mm = box.min().z();
  return bounds;
}

class Painter {
 public:
  Painter(const std::vector<RenderedBody>& bodies, const RenderOptions& options)
      : bodies_(bodies),
        options_(options),
        bounds_(bounds_of(bodies)),
        view_(View::perspective(options.from, bounds_.ball, kDistance)
                  .fitted(options.framed.empty() ? bounds_.corners : options.framed,
                          kSamples * options.width_px, kSamples * options.height_px,
                          kMargin * kSamples * options.height_px)),
        raster_(raster_bodies(false), view_, options.cutaway, SampleGrid::kShifted),
        sky_(raster_bodies(true), options.cutaway, bounds_.ball, sky_options()),
        ground_shade_(sky_, view_, bounds_.ball, bounds_.ground_mm, kSamples * kGroundPixels,
                      kSamples * options.width_px, kSamples * options.height_px) {
    raster_.sort_into_tiles(kTilePixels * kSamples, kLineSamples, kSamples * options.width_px,
                            kSamples * options.height_px);
    for (int j = 0; j < kSamples; ++j)
      for (int i = 0; i < kSamples; ++i)
        places_.push_back(sample_place(SampleGrid::kShifted, i, j));
    ground_ = linear(kGround);
    for (const RenderedBody& body : bodies) colours_.push_back(linear(body.finish.colour));
    const Eigen::Vector3d middle = view_.project(bounds_.ball.centre);
    const Eigen::Vector3d p = view_.unproject(middle.x(), middle.y(), middle.z()),
                          q = view_.unproject(middle.x() + kSamples, middle.y(), middle.z());
    // lines that are seen apart, whatever the size of the gearbox and of the picture
    hatch_mm_ = std::max(6.5 * (q - p).norm(), bounds_.ball.radius_mm / 55.0);
  }

  Image paint() {
    Image image{options_.width_px, options_.height_px, {}};
    image.pixels.resize(static_cast<std::size_t>(image.width_px) *
                        static_cast<std::size_t>(image.height_px));
    std::vector<QueuedJob> jobs;
    for (int y = 0; y < image.height_px; y += kTilePixels)
      for (int x = 0; x < image.width_px; x += kTilePixels)
        jobs.push_back({[this, &image, x, y] {
                          paint_tile(image, x, y);
                          return true;
                        },
                        {}});
    run_jobs(jobs);
    return image;
  }

 private:
  [[nodiscard]] std::vector<RasterBody> raster_bodies(bool shadows) const {
    std::vector<RasterBody> all;
    for (const RenderedBody& body : bodies_) {
      all.push_back(body.body);
      if (shadows && body.shadow) all.back().mesh = body.shadow;
    }
    return all;
  }
  [[nodiscard]] SkyOptions sky_options() const {
    const ViewDirection lamp{options_.from.azimuth_rad + kLampTurn_rad, kLampHeight_rad};
    if (options_.quick)
      return {.directions = 16, .lamp_directions = 5, .map_samples = 140, .lamp = lamp};
    return {.directions = 48, .lamp_directions = 12, .map_samples = 320, .lamp = lamp};
  }

  void paint_tile(Image& image, int left, int top) const {
    const int width = std::min(kTilePixels, image.width_px - left),
              height = std::min(kTilePixels, image.height_px - top);
    const SightWindow window =
        raster_.draw(kSamples * left - kLineSamples, kSamples * top - kLineSamples,
                     kSamples * width + 2 * kLineSamples, kSamples * height + 2 * kLineSamples);
    std::vector<Patch> patches;
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) {
        const Rgb colour = pixel(window, x, y, patches);
        image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                     static_cast<std::size_t>(x)] = {encoded(colour[0]), encoded(colour[1]),
                                                     encoded(colour[2])};
      }
  }

  Rgb pixel(const SightWindow& window, int x, int y, std::vector<Patch>& patches) const {
    patches.clear();
    int empty = 0;
    for (int j = kSamples * y; j < kSamples * (y + 1); ++j)
      for (int i = kSamples * x; i < kSamples * (x + 1); ++i) {
        const Sight& sight = window.at(i, j);
        if (sight.surface == kNoSight.surface)
          ++empty;
        else
          add_to(patches, window, i, j);
      }
    Rgb sum = Rgb::Zero();
    for (const Patch& patch : patches) sum += patch.count * colour_of(patch);
    if (empty > 0)  // a level ground with the bodies' shadow
      sum += empty * ground_shade_.at(kSamples * (x + 0.5), kSamples * (y + 0.5)) * ground_;
    return sum / (kSamples * kSamples);
  }

  /// Whether a sample of a cut face lies beside another surface.
  [[nodiscard]] static bool is_at_edge(const SightWindow& window, int i, int j) {
    const std::uint32_t face = window.at(i, j).surface;
    const auto same = [&](int x, int y) {
      return ((window.at(x, y).surface ^ face) & ~SurfaceName::kSecondPlane) == 0;
    };
    return !(same(i - kLineSamples, j) && same(i + kLineSamples, j) && same(i, j - kLineSamples) &&
             same(i, j + kLineSamples));
  }

  void add_to(std::vector<Patch>& patches, const SightWindow& window, int i, int j) const {
    const Sight& sight = window.at(i, j);
    const Eigen::Vector2d& place =
        places_[static_cast<std::size_t>(kSamples * (j & (kSamples - 1)) + (i & (kSamples - 1)))];
    const Eigen::Vector3d sample(i + place.x(), j + place.y(), sight.nearness);
    const bool cut = SurfaceName::is_cut_face(sight.surface);
    const double line = !cut                                          ? 0.0
                        : is_at_edge(window, i, j)                    ? kEdgeLine
                        : is_hatched(sight.surface, point_at(sample)) ? kHatchLine
                                                                      : 0.0;
    const auto join = [&](Patch& patch) {
      ++patch.count;
      patch.seen += sample;
      patch.lines += line;
    };
    for (Patch& patch : patches)
      if (patch.surface == sight.surface) return join(patch);
    Patch seen{.surface = sight.surface};
    if (cut) {
      seen.body = SurfaceName::body(sight.surface);
      seen.cut_plane = SurfaceName::plane(sight.surface);
      seen.normal = options_.cutaway->normal[static_cast<std::size_t>(seen.cut_plane)];
    } else {
      seen.body = raster_.body_of(sight.surface);
      seen.normal = normal_at(seen.body, sight.surface, point_at(sample));
    }
    for (Patch& patch : patches) {
      if (patch.body != seen.body || patch.cut_plane != seen.cut_plane ||
          patch.normal.dot(seen.normal) < kSameSurface * patch.normal.norm())
        continue;
      patch.normal += seen.normal;
      patch.surface = seen.surface;
      return join(patch);
    }
    join(seen);
    patches.push_back(seen);
  }

  [[nodiscard]] Eigen::Vector3d point_at(const Eigen::Vector3d& sample) const {
    return view_.unproject(sample.x(), sample.y(), sample.z());
  }

  /// The corners' normals, by the point's place in the triangle.
  [[nodiscard]] Eigen::Vector3d normal_at(std::size_t body, std::uint32_t surface,
                                          const Eigen::Vector3d& point) const {
    const RasterBody& b = bodies_[body].body;
    const std::size_t t = surface - raster_.first_triangle(body);
    const auto& mesh = b.mesh->mesh;
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = b.place(mesh.vertices[mesh.triangles[t][k]]);
    const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight =
          std::max(0.0, n.dot((p[(k + 1) % 3] - point).cross(p[(k + 2) % 3] - point)));
      sum += weight * b.mesh->normals[t][k].cast<double>();
    }
    const double length = sum.norm();
    return b.turn(length > 0.0 ? Eigen::Vector3d(sum / length)
                               : Eigen::Vector3d(b.mesh->normals[t][0].cast<double>()));
  }

  [[nodiscard]] bool is_hatched(std::uint32_t face, const Eigen::Vector3d& point) const {
    const double angle = bodies_[SurfaceName::body(face)].finish.hatch_rad;
    if (std::isnan(angle)) return false;
    const Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(
        options_.cutaway->normal[static_cast<std::size_t>(SurfaceName::plane(face))]);
    const double across =
        (std::cos(angle) * point.dot(along) + std::sin(angle) * point.z()) / hatch_mm_;
    return across - std::floor(across) < 0.2;
  }

  [[nodiscard]] Rgb colour_of(const Patch& patch) const {
    const Finish& finish = bodies_[patch.body].finish;
    const Eigen::Vector3d point = point_at(patch.seen / patch.count),
                          normal = patch.normal.normalized();
    const Light light = sky_.at(point, normal);
    const Rgb base = colours_[patch.body];
    if (patch.cut_plane >= 0) {
      const Rgb paper = finish.metal ? 0.12 + 0.6 * base : 0.3 + 0.7 * base;
      const Rgb face = paper * (1.0 - patch.lines / patch.count);
      return toned(face * (0.5 + 0.38 * light.open + 0.2 * light.lamp));
    }
    const Eigen::Vector3d viewer = view_.to_viewer(point);
    const double facing = std::max(0.0, normal.dot(viewer));
    const double glance = squared(1.0 - facing, 2) * (1.0 - facing);
    const Eigen::Vector3d mirrored = 2.0 * normal.dot(viewer) * normal - viewer;
    const double sky = light.open * (0.25 + 0.75 * std::clamp(0.5 + 0.7 * mirrored.z(), 0.0, 1.0));
    const double highlight =
        light.lamp > 0.0 ? squared(std::max(0.0, normal.dot((viewer + sky_.lamp()).normalized())),
                                   finish.metal ? 6 : 5)
                         : 0.0;
    const double bounced = 0.10 * (1.0 - 0.5 * normal.z()) * (0.35 + 0.65 * light.open);
    const Rgb diffuse = base * (0.62 * light.sky + 0.72 * light.lamp + bounced);
    if (finish.metal)
      return toned(0.55 * diffuse + base * (0.75 * sky) + 0.7 * highlight * light.lamp);
    return toned(diffuse + (0.03 + 0.35 * glance) * sky + finish.shine * highlight * light.lamp);
  }

  const std::vector<RenderedBody>& bodies_;
  const RenderOptions& options_;
  const Bounds bounds_;
  const View view_;
  Raster raster_;
  const SkyLight sky_;
  const GroundShade ground_shade_;
  std::vector<Eigen::Vector2d> places_;  ///< of a pixel's samples in their cells, by rows
  Rgb ground_;
  std::vector<Rgb> colours_;
  double hatch_mm_ = 1.0;
};

}  // namespace

Image rendered(const std::vector<RenderedBody>& bodies, const RenderOptions& options) {
  TRUEFLANK_EXPECTS(!bodies.empty() && options.width_px > 0 && options.height_px > 0);
  return Painter(bodies, options).paint();
}

}  // namespace trueflank::io
