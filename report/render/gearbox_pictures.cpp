// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/gearbox_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/parallel_jobs.h"
#include "trueflank/report/render/png.h"
#include "trueflank/solid/mesh/gear_mesh.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank::io {
namespace {

constexpr double kPixels = 0.25;  // by which facets may miss the true surface
constexpr int kTurningPictures = 36, kTurning_ms = 5400;  // of one turn
constexpr double kShadowShare = 2e-3;  // of the size: tolerance of what throws shadows
constexpr double kElevation_rad = 0.62, kFlatElevation_rad = 0.80, kTallElevation_rad = 0.48;
constexpr double kAside_rad = 0.16;        // of the viewer from the middle of the cut
constexpr double kHalfOpening_rad = 0.80;  // of the cut: a little over a quarter
/// Turned off all symmetries: no facet lies in a plane of the cut.
constexpr double kOffSymmetry_rad = 0.0137;
constexpr double kPartAzimuth_rad = -0.9;
constexpr double kPairAzimuth_rad = -1.4;  // gears side by side
constexpr double kStepElevation_rad = 0.52, kLift = 0.12;
constexpr Colour kFaded{0xC9, 0xCE, 0xD4};  // what is there already

double reach_mm(const PartShape& part) {
  double reach = 0.0;
  for (const Slab& slab : part.slabs) {
    const OutlineExtent e = extent(slab.outer);
    reach = std::max(reach, e.centre.norm() + e.outer_radius_mm);
  }
  return reach;
}
double height_mm(const PartShape& part) { return part.slabs.back().z_upper_mm; }

/// Half the width of the assembly.
double reach_mm(const PartShapes& shapes) {
  double reach = 0.0;
  for (const Placement& body : shapes.assembly)
    reach = std::max(reach, std::hypot(body.translation_mm[0], body.translation_mm[1]) +
                                reach_mm(shapes.parts[static_cast<std::size_t>(body.part)]));
  return reach;
}

PicturedMesh mesh_of(const PartShape& part, double tolerance_mm) {
  return pictured_mesh(part_mesh(part, {.tolerance_mm = tolerance_mm}).mesh);
}

/// Flat things are seen from higher up.
double elevation_rad(double width_mm, double height_mm) {
  const double slim = height_mm / width_mm;
  return slim < 0.25 ? kFlatElevation_rad : slim < 0.8 ? kElevation_rad : kTallElevation_rad;
}

Finish finish_of(const PartShape& part, std::size_t number) {
  constexpr double kQuarter = 1.5707963;
  return {.colour = part_colour(part.role),
          .shine = 0.22,
          .metal = part.role == PartRole::kBought,
          .hatch_rad = part.bought.empty() || part.bought.starts_with("ball")
                           ? (number % 2 == 0 ? 0.5 : 1.5) * kQuarter
                           : kNaN};
}

Result<ReportedFile> write_bytes(const std::string& bytes, const std::string& part,
                                 const std::string& format, const PictureOptions& options) {
  const std::string name = part + "." + format;
  if (auto ok = write_file(options.folder / name, bytes); !ok) return fail(ok.error());
  if (options.on_written) options.on_written(name);
  return ReportedFile{.path = name, .part = part, .format = format, .bytes = bytes.size()};
}

}  // namespace

GearboxPictures::GearboxPictures(const GearTrain& train, const PartShapes& shapes, int width_px)
    : train_(train), shapes_(shapes), meshes_(shapes.parts.size()), shadows_(shapes.parts.size()) {
  const double pixel_mm = 2.0 * reach_mm(shapes) / width_px;
  std::vector<QueuedJob> jobs;
  for (std::size_t i = 0; i < meshes_.size(); ++i)
    jobs.push_back({[this, i, pixel_mm] {
                      meshes_[i] = mesh_of(shapes_.parts[i], kPixels * pixel_mm);
                      shadows_[i] = mesh_of(shapes_.parts[i], kShadowShare * reach_mm(shapes_));
                      return true;
                    },
                    {}});
  run_jobs(jobs);
}

/// What lies round the train's axis hides what is in it; the sun does not.
bool GearboxPictures::is_cut(const Placement& placement) const {
  const PartShape& part = shapes_.parts[static_cast<std::size_t>(placement.part)];
  if (part.role == PartRole::kSun || part.role == PartRole::kPlanet) return false;
  if (!train_.topology().has_planets())  // a box alone, with its screws, hides what is in it
    return part.role == PartRole::kCasing ||
           (part.member == kNoMember && (part.bought.starts_with("ISO") || part.bought.starts_with("heat")));
  if (part.bought.empty()) return true;
  // pins and bearings of planets stay whole; screws and the output's bearing are cut with their
  // parts
  const double away = std::hypot(placement.translation_mm[0], placement.translation_mm[1]);
  const bool on_planet = std::abs(away - train_.centre_distance_mm) < 1e-6 &&
                         !part.bought.starts_with("ISO") && !part.bought.starts_with("heat");
  return !on_planet && !part.bought.starts_with("motor");
}

RenderedBody GearboxPictures::body(std::size_t number) const {
  const Placement& place = shapes_.assembly[number];
  const auto part = static_cast<std::size_t>(place.part);
  return {.body = {.mesh = &meshes_[part],
                   .cos = std::cos(place.rotation_rad),
                   .sin = std::sin(place.rotation_rad),
                   .move_mm = {place.translation_mm[0], place.translation_mm[1],
                               place.translation_mm[2]}},
          .finish = finish_of(shapes_.parts[part], part),
          .shadow = &shadows_[part]};
}

Image GearboxPictures::cut_open(double towards_rad, const std::vector<Eigen::Vector3d>& framed,
                                int width_px, int height_px, bool quick) const {
  std::vector<RenderedBody> bodies;
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < shapes_.assembly.size(); ++i) {
    bodies.push_back(body(i));
    bodies.back().body.cut = is_cut(shapes_.assembly[i]);
    const double z = shapes_.assembly[i].translation_mm[2];
    low = std::min(low, z);
    high = std::max(
        high, z + height_mm(shapes_.parts[static_cast<std::size_t>(shapes_.assembly[i].part)]));
  }
  RenderOptions options{
      .width_px = width_px,
      .height_px = height_px,
      .from = {towards_rad + kAside_rad, elevation_rad(2.0 * reach_mm(shapes_), high - low)},
      .framed = framed,
      .quick = quick};
  if (train_.topology().has_planets() || train_.design.machine) {
    Cutaway cutaway;
    for (std::size_t i = 0; i < 2; ++i) {
      const double turn = towards_rad + (i == 0 ? -1.0 : 1.0) * (kHalfOpening_rad - 0.5 * kPi);
      cutaway.normal[i] = {std::cos(turn), std::sin(turn), 0.0};
    }
    options.cutaway = cutaway;
  }
  return rendered(bodies, options);
}

/// Between two planets, so that the sun is seen; beside a planet that is alone.
double GearboxPictures::opening_rad() const {
  if (!train_.topology().has_planets()) return kPairAzimuth_rad;
  const auto& planets = train_.phases.positions_rad(train_.topology().first_planet());
  const double first = planets.empty() ? 0.0 : planets[0];
  const double next = planets.size() > 1 ? planets[1] : first + kTwoPi / 3.0;
  return 0.5 * (first + next) + kOffSymmetry_rad;
}

Image GearboxPictures::assembly(int width_px, int height_px) const {
  return cut_open(opening_rad(), {}, width_px, height_px, false);
}

std::vector<Image> GearboxPictures::turning(int width_px, int height_px, int count) const {
  // what every picture must hold: the cylinder about everything
  std::vector<Eigen::Vector3d> framed;
  const double reach = reach_mm(shapes_);
  for (const Placement& body : shapes_.assembly)
    for (int i = 0; i < 72; ++i) {
      const double low = body.translation_mm[2];
      const double high = low + height_mm(shapes_.parts[static_cast<std::size_t>(body.part)]);
      const double x = reach * std::cos(kTwoPi * i / 72), y = reach * std::sin(kTwoPi * i / 72);
      framed.emplace_back(x, y, low);
      framed.emplace_back(x, y, high);
    }
  std::vector<Image> images;
  for (int i = 0; i < count; ++i)
    images.push_back(
        cut_open(opening_rad() - kTwoPi * i / count, framed, width_px, height_px, true));
  return images;
}

Image GearboxPictures::part(std::size_t part, int width_px, int height_px) const {
  const PartShape& shape = shapes_.parts[part];
  const double reach = reach_mm(shape);
  const PicturedMesh mesh = mesh_of(shape, kPixels * 2.0 * reach / width_px);
  const PicturedMesh shadow = mesh_of(shape, kShadowShare * reach);
  return rendered({{.body = {.mesh = &mesh}, .finish = finish_of(shape, part), .shadow = &shadow}},
                  {.width_px = width_px,
                   .height_px = height_px,
                   .from = {kPartAzimuth_rad, elevation_rad(2.0 * reach, height_mm(shape))}});
}

Image GearboxPictures::step(const std::vector<std::size_t>& there,
                            const std::vector<std::size_t>& added, double from, int width_px,
                            int height_px) const {
  std::vector<RenderedBody> bodies;
  double low = 1e300, high = -1e300, added_low = 1e300, added_high = -1e300;
  const auto take = [&](std::size_t number, double& lowest, double& highest) {
    bodies.push_back(body(number));
    bodies.back().body.turned_over = from < 0.0;
    const double z = shapes_.assembly[number].translation_mm[2];
    lowest = std::min(lowest, z);
    highest = std::max(
        highest,
        z + height_mm(shapes_.parts[static_cast<std::size_t>(shapes_.assembly[number].part)]));
  };
  for (const std::size_t number : there) {
    take(number, low, high);
    bodies.back().finish.colour = kFaded;
    bodies.back().finish.metal = false;
  }
  const std::size_t first = bodies.size();
  for (const std::size_t number : added) take(number, added_low, added_high);
  // out of what is there, and a gap beside
  const double deep = from > 0.0 ? high - added_low : added_high - low;
  const double lift =
      std::max(deep, 0.0) + kLift * (std::max(high, added_high) - std::min(low, added_low));
  for (std::size_t i = first; i < bodies.size(); ++i) bodies[i].body.move_mm.z() += from * lift;
  return rendered(bodies, {.width_px = width_px,
                           .height_px = height_px,
                           .from = {kPartAzimuth_rad, kStepElevation_rad},
                           .quick = true});
}

Result<std::vector<ReportedFile>> write_pictures(const GearTrain& train, const PartShapes& shapes,
                                                 const PictureOptions& options) {
  const int height_px = 3 * options.width_px / 4;
  const GearboxPictures pictures(train, shapes, options.width_px);
  std::vector<ReportedFile> files;
  const auto write = [&](const Image& image, const std::string& part) -> Status {
    auto file = write_bytes(png_file(image), part, "png", options);
    if (!file) return fail(file.error());
    files.push_back(std::move(*file));
    return {};
  };
  for (std::size_t i = 0; i < shapes.parts.size(); ++i) {
    const PartShape& part = shapes.parts[i];
    if (!(options.part.empty() ? part.bought.empty() : options.part == part.name)) continue;
    if (auto ok = write(pictures.part(i, 2 * options.width_px / 3, 2 * height_px / 3), part.name);
        !ok)
      return fail(ok.error());
  }
  if (options.part.empty() && shapes.assembly.size() > 1)
    if (auto ok = write(pictures.assembly(options.width_px, height_px), "assembly"); !ok)
      return fail(ok.error());
  return files;
}

Result<std::vector<ReportedFile>> write_turning_picture(const GearTrain& train,
                                                        const PartShapes& shapes,
                                                        const PictureOptions& options) {
  if (!options.part.empty() || shapes.assembly.size() < 2) return std::vector<ReportedFile>{};
  const int width_px = options.width_px / 2, height_px = 3 * width_px / 4;
  const auto images =
      GearboxPictures(train, shapes, width_px).turning(width_px, height_px, kTurningPictures);
  auto file = write_bytes(animated_png_file(images, kTurning_ms / kTurningPictures), "assembly",
                          "apng", options);
  if (!file) return fail(file.error());
  return std::vector<ReportedFile>{std::move(*file)};
}

}  // namespace trueflank::io
