// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/section/dxf_writer.h"

#include <algorithm>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/section/dxf_document.h"

namespace trueflank::io {
namespace {

std::string layer_name(const Section& section, const SectionBody& body) {
  std::string name = section.name + "_" + body.name;
  for (char& c : name) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!plain) c = '_';
  }
  return name;
}

int colour_index(PartRole role) {
  switch (role) {
    case PartRole::kSun: return 30;       // orange
    case PartRole::kPlanet: return 5;     // blue
    case PartRole::kUpperRing: return 1;  // red
    default: return 7;                    // black on white, white on black
  }
}

void put_contour(DxfText& dxf, const Contour& contour, const std::string& layer, int handle) {
  put_dxf_entity(dxf, contour.circle ? "CIRCLE" : "LWPOLYLINE", handle, layer);
  if (contour.circle) {
    dxf.put(100, "AcDbCircle");
    dxf.put_point(10, contour.circle->centre);
    dxf.put(30, 0.0);
    dxf.put(40, contour.circle->radius_mm);
    return;
  }
  dxf.put(100, "AcDbPolyline");
  dxf.put(90, static_cast<int>(contour.vertices.size()));
  dxf.put(70, 1);  // closed
  dxf.put(43, 0.0);
  for (const ContourVertex& vertex : contour.vertices) {
    dxf.put_point(10, vertex.point);
    if (vertex.bulge != 0.0) dxf.put(42, vertex.bulge);
  }
}

}  // namespace

Status write_dxf(const std::filesystem::path& path, const std::vector<Section>& sections) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  Box2 box;
  std::vector<DxfLayer> layers;
  int count = 0;
  for (const Section& section : sections)
    for (const SectionBody& body : section.bodies) {
      include(box, body.outer);
      layers.push_back({layer_name(section, body), colour_index(body.role), body.frozen});
      count += 1 + static_cast<int>(body.holes.size());
    }
  DxfText dxf(*file);
  begin_dxf(dxf, box, layers, count);
  int handle = kFirstDxfEntity;
  for (const Section& section : sections)
    for (const SectionBody& body : section.bodies) {
      put_contour(dxf, body.outer, layer_name(section, body), handle++);
      for (const Contour& hole : body.holes)
        put_contour(dxf, hole, layer_name(section, body), handle++);
    }
  end_dxf(dxf);
  return file->commit();
}

}  // namespace trueflank::io
