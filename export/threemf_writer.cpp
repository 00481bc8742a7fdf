// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/threemf_writer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "trueflank/base/contract.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/export/packed/zip_archive.h"

namespace trueflank::io {
namespace {

constexpr std::string_view kContentTypes =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr std::string_view kRelationships =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

constexpr int kMaterialsId = 1;
constexpr int kFirstShapeId = 2;

void append_attribute(std::string& text, std::string_view name, std::int64_t value) {
  text += ' ';
  text += name;
  text += "=\"";
  append_integer(text, value);
  text += '"';
}

void append_materials(std::string& text, const Scene& scene) {
  text += "<basematerials";
  append_attribute(text, "id", kMaterialsId);
  text += ">";
  for (const SceneShape& shape : scene.shapes)
    text += "<base name=\"" + xml_escaped(shape.name) + "\" displaycolor=\"" +
            hex_text(shape.colour) + "\"/>";
  text += "</basematerials>\n";
}

/// Vertices in the order in which triangles first use them: those of a wall's lower and upper edge
/// come in turns, and the second repeats the first one's digits, which halves the packed file.
struct OrderOfUse {
  std::vector<std::uint32_t> vertices;  ///< old numbers in the new order
  std::vector<std::uint32_t> number;    ///< new numbers by the old ones

  explicit OrderOfUse(const TriangleMesh& mesh) {
    constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
    number.assign(mesh.vertices.size(), kUnused);
    vertices.reserve(mesh.vertices.size());
    const auto use = [&](std::uint32_t vertex) {
      if (number[vertex] != kUnused) return;
      number[vertex] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(vertex);
    };
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t vertex : t) use(vertex);
  }
};

/// An empty element with three numbers.
template <class Number, class Put>
void append_line(std::string& text, const std::array<std::string_view, 3>& before,
                 const std::array<Number, 3>& numbers, Put put) {
  std::array<char, 3 * (16 + kNumberRoom) + 4> line;
  char* at = line.data();
  for (std::size_t i = 0; i < 3; ++i) {
    at = std::copy(before[i].begin(), before[i].end(), at);
    at = put(at, numbers[i]);
  }
  constexpr std::string_view kEnd = "\"/>\n";
  at = std::copy(kEnd.begin(), kEnd.end(), at);
  text.append(line.data(), at);
}

void append_shape(PackedText& packed, const SceneShape& shape, const PackedText& mesh, int index) {
  std::string& text = packed.open_text();
  text += "<object";
  append_attribute(text, "id", kFirstShapeId + index);
  text += " type=\"model\" name=\"" + xml_escaped(shape.name) + "\"";
  append_attribute(text, "pid", kMaterialsId);
  append_attribute(text, "pindex", index);
  text += ">";
  packed.append(mesh);
  packed.append("</object>\n");
}

/// Points are row vectors here: the rows are the images of x, y, z and the origin.
void append_transform(std::string& text, const Placement& body) {
  const PlacementTransform place(body);
  if (place.is_identity()) return;
  const auto& move = body.translation_mm;
  const double matrix[12] = {place.cos(), place.sin(), 0, -place.sin(), place.cos(), 0,
                             0,           0,           1, move[0],      move[1],     move[2]};
  text += " transform=\"";
  for (int i = 0; i < 12; ++i) {
    if (i > 0) text += ' ';
    append_shortest(text, matrix[i]);
  }
  text += '"';
}

/// Objects of the bodies and of the whole; returns the id of the object to build.
int append_assembly(std::string& text, const Scene& scene) {
  int next_id = kFirstShapeId + static_cast<int>(scene.shapes.size());
  std::string components;
  for (const Placement& body : scene.bodies) {
    int id = kFirstShapeId + body.part;
    if (body.name != scene.shapes[body.part].name) {
      text += "<object";
      append_attribute(text, "id", next_id);
      text += " type=\"model\" name=\"" + xml_escaped(body.name) + "\"><components><component";
      append_attribute(text, "objectid", id);
      text += "/></components></object>\n";
      id = next_id++;
    }
    components += "<component";
    append_attribute(components, "objectid", id);
    append_transform(components, body);
    components += "/>";
  }
  text += "<object";
  append_attribute(text, "id", next_id);
  text += " type=\"model\" name=\"assembly\"><components>" + components +
          "</components></object>\n";
  return next_id;
}

/// What is built, at its place.
void append_item(std::string& text, int object, const Placement* body) {
  text += "<item";
  append_attribute(text, "objectid", object);
  if (body) append_transform(text, *body);
  text += "/>";
}

PackedText model_text(const Scene& scene, const std::vector<const PackedText*>& meshes) {
  PackedText packed;
  std::string& text = packed.open_text();
  text +=
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n";
  text += "<metadata name=\"Title\">" + xml_escaped(scene.name) + "</metadata>";
  text += "<metadata name=\"Application\">Trueflank</metadata>\n<resources>\n";
  append_materials(text, scene);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    append_shape(packed, scene.shapes[i], *meshes[i], static_cast<int>(i));
  const bool alone = scene.loose || scene.bodies.size() == 1;
  const int assembly = alone ? 0 : append_assembly(text, scene);
  text += "</resources>\n<build>";
  if (alone)
    for (const Placement& body : scene.bodies) append_item(text, kFirstShapeId + body.part, &body);
  else
    append_item(text, assembly, nullptr);
  text += "</build>\n</model>\n";
  packed.close();
  return packed;
}

PackedText closed(std::string_view text) {
  PackedText packed(text);
  packed.close();
  return packed;
}

}  // namespace

PackedText packed_3mf_mesh(const TriangleMesh& mesh) {
  PackedText packed;
  packed.append("<mesh><vertices>\n");
  const OrderOfUse order(mesh);
  for (const std::uint32_t old : order.vertices) {
    append_line(packed.open_text(), {"<vertex x=\"", "\" y=\"", "\" z=\""}, mesh.vertices[old],
                put_decimal);
    packed.pack_when_full();
  }
  packed.append("</vertices><triangles>\n");
  for (const auto& t : mesh.triangles) {
    append_line(packed.open_text(), {"<triangle v1=\"", "\" v2=\"", "\" v3=\""},
                std::array{order.number[t[0]], order.number[t[1]], order.number[t[2]]},
                put_integer);
    packed.pack_when_full();
  }
  packed.append("</triangles></mesh>");
  packed.close();
  return packed;
}

Status write_3mf(const std::filesystem::path& path, const Scene& scene) {
  std::vector<PackedText> packed;
  for (const SceneShape& shape : scene.shapes) packed.push_back(packed_3mf_mesh(*shape.mesh));
  std::vector<const PackedText*> meshes;
  for (const PackedText& mesh : packed) meshes.push_back(&mesh);
  return write_3mf(path, scene, meshes);
}

Status write_3mf(const std::filesystem::path& path, const Scene& scene,
                 const std::vector<const PackedText*>& meshes) {
  TRUEFLANK_EXPECTS(meshes.size() == scene.shapes.size());
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  const auto archive = zip_archive({{"[Content_Types].xml", closed(kContentTypes)},
                                    {"_rels/.rels", closed(kRelationships)},
                                    {"3D/3dmodel.model", model_text(scene, meshes)}});
  if (!archive) return fail(archive.error());
  file->write(*archive);
  return file->commit();
}

}  // namespace trueflank::io
