// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/scene.h"

#include <cmath>

namespace trueflank::io {

Colour part_colour(PartRole role) {
  switch (role) {
    case PartRole::kSun: return {0xE6, 0xA8, 0x2E};
    case PartRole::kPlanet: return {0x4F, 0x8F, 0xC4};
    case PartRole::kRing: return {0x5B, 0x66, 0x73};
    case PartRole::kUpperRing: return {0xC2, 0x5B, 0x4A};
    case PartRole::kCarrier: return {0x7F, 0xA8, 0x6B};
    case PartRole::kCasing: return {0xB8, 0xC0, 0xC8};
    case PartRole::kOutput: return {0xD9, 0x8C, 0x5F};
    case PartRole::kBought: return {0x8A, 0x8D, 0x91};
    case PartRole::kOther: break;
  }
  return {0x9A, 0xA5, 0xB1};
}

std::string hex_text(Colour colour) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) {
    text += kDigits[channel >> 4];
    text += kDigits[channel & 15];
  }
  return text;
}

Scene part_scene(std::string design_name, const std::string& part_name, const TriangleMesh& mesh,
                 PartRole role) {
  return {.name = std::move(design_name),
          .shapes = {{part_name, &mesh, part_colour(role)}},
          .bodies = {{.part = 0, .name = part_name}}};
}

PlacementTransform::PlacementTransform(const Placement& placement)
    : cos_(std::cos(placement.rotation_rad)),
      sin_(std::sin(placement.rotation_rad)),
      move_(placement.translation_mm) {}

TriangleMesh placed_mesh(const TriangleMesh& mesh, const Placement& placement) {
  const PlacementTransform place(placement);
  TriangleMesh result;
  result.triangles = mesh.triangles;
  result.vertices.reserve(mesh.vertices.size());
  for (const auto& vertex : mesh.vertices) result.vertices.push_back(place(vertex));
  return result;
}

std::uint64_t triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Placement& body : scene.bodies) count += scene.shapes[body.part].mesh->triangles.size();
  return count;
}

std::uint64_t vertex_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Placement& body : scene.bodies) count += scene.shapes[body.part].mesh->vertices.size();
  return count;
}

}  // namespace trueflank::io
