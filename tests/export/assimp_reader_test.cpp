// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/assimp_reader.h"

#include <assimp/cexport.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <random>

#include "trueflank/export/mesh_reader.h"

// Formats that assimp reads for us: the same tetrahedron in each, written by hand or by assimp's own exporter, must
// come back in millimetres with z up.
namespace trueflank::io {
namespace {

using Point = std::array<double, 3>;
using Matrix = std::array<std::array<float, 3>, 3>;

// no two extents alike, so that swapped or mirrored axes show
constexpr std::array<Point, 4> kCorners{{{0, 0, 0}, {10, 0, 0}, {0, 12, 0}, {0, 0, 15.5}}};
constexpr std::array<std::array<unsigned, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

/// The corners, each multiplied by `m`.
std::array<Point, 4> turned(const Matrix& m) {
  std::array<Point, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) corners[i][r] += static_cast<double>(m[r][c]) * kCorners[i][c];
  return corners;
}
constexpr Matrix kAsItIs{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix kYUp{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};  // x, y, z -> x, z, -y

/// With all its digits.
std::string exact(double value) {
  std::array<char, 40> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string numbers(const std::array<Point, 4>& corners, double scale) {
  std::string text;
  for (const Point& p : corners)
    for (const double c : p) text += exact(scale * c) + " ";
  return text;
}

std::string off_text() {
  std::string text = "OFF\n4 4 0\n";
  for (const Point& p : kCorners) text += exact(p[0]) + " " + exact(p[1]) + " " + exact(p[2]) + "\n";
  for (const auto& f : kFaces) text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

std::string amf_text(const std::string& unit, double scale) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<amf " + unit + " version=\"1.1\"><object id=\"1\"><mesh><vertices>\n";
  for (const Point& p : kCorners)
    text += "<vertex><coordinates><x>" + exact(scale * p[0]) + "</x><y>" + exact(scale * p[1]) +
            "</y><z>" + exact(scale * p[2]) + "</z></coordinates></vertex>\n";
  text += "</vertices><volume>\n";
  for (const auto& f : kFaces)
    text += "<triangle><v1>" + std::to_string(f[0]) + "</v1><v2>" + std::to_string(f[1]) + "</v2><v3>" + std::to_string(f[2]) + "</v3></triangle>\n";
  return text + "</volume></mesh></object></amf>\n";
}

std::string dae_text(const std::string& unit, const std::string& up, const Matrix& turn, double scale) {
  std::string indices;
  for (const auto& f : kFaces)
    for (const unsigned i : f) indices += std::to_string(i) + " ";
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)"
         "<unit " + unit + "/><up_axis>" + up + "</up_axis></asset>"
         R"(<library_geometries><geometry id="tooth"><mesh>)"
         R"(<source id="p"><float_array id="a" count="12">)" + numbers(turned(turn), scale) +
         R"(</float_array><technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>)"
         R"(<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>)"
         R"(<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4">)"
         R"(<input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices + R"(</p></triangles></mesh></geometry>)"
         R"(</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">)"
         R"(<instance_geometry url="#tooth"/></node></visual_scene></library_visual_scenes>)"
         R"(<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string x3d_text() {
  std::string indices;
  for (const auto& f : kFaces) {
    for (const unsigned i : f) indices += std::to_string(i) + " ";
    indices += "-1 ";
  }
  return "<?xml version=\"1.0\"?><X3D profile='Interchange' version='3.3'><Scene><Group><Shape><IndexedFaceSet coordIndex='" +
         indices + "'><Coordinate point='" + numbers(turned(kYUp), 1e-3) + "'/></IndexedFaceSet></Shape></Group></Scene></X3D>";
}

/// The corners, turned and scaled, as assimp itself writes them.
std::string exported(const char* format, const Matrix& turn, float scale) {
  auto* const mesh = new aiMesh;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = 4;
  mesh->mVertices = new aiVector3D[4];
  const auto corners = turned(turn);
  for (std::size_t i = 0; i < 4; ++i)
    mesh->mVertices[i] = {scale * static_cast<float>(corners[i][0]), scale * static_cast<float>(corners[i][1]),
                          scale * static_cast<float>(corners[i][2])};
  mesh->mNumFaces = 4;
  mesh->mFaces = new aiFace[4];
  for (std::size_t i = 0; i < 4; ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3]{kFaces[i][0], kFaces[i][1], kFaces[i][2]};
  }
  aiScene scene;
  scene.mMeshes = new aiMesh*[1]{mesh};
  scene.mNumMeshes = 1;
  scene.mMaterials = new aiMaterial*[1]{new aiMaterial};
  scene.mNumMaterials = 1;
  scene.mRootNode = new aiNode("root");
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
  const aiExportDataBlob* const blob = aiExportSceneToBlob(&scene, format, 0);
  if (!blob) return {};
  std::string content(static_cast<const char*>(blob->data), blob->size);
  aiReleaseExportBlob(blob);
  return content;
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, text.npos) << from;
  text.replace(at, from.size(), to);
}

std::string fbx_text(const std::string& up_axis, const std::string& cm, const Matrix& turn, float scale) {
  std::string text = exported("fbxa", turn, scale);
  replace(text, R"(P: "UpAxis", "int", "Integer", "", 1)", R"(P: "UpAxis", "int", "Integer", "", )" + up_axis);
  replace(text, R"(P: "UnitScaleFactor", "double", "Number", "", 1)", R"(P: "UnitScaleFactor", "double", "Number", "", )" + cm);
  return text;
}

/// One buffer within the file, as printers' and game programs write it.
std::string gltf_text() {
  std::string bytes;
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const Point& p : turned(kYUp))
    for (const double c : p) add(static_cast<float>(1e-3 * c));
  for (const auto& f : kFaces)
    for (const unsigned i : f) add(static_cast<std::uint16_t>(i));
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {  // 72 bytes: no padding
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])); };
    const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[group >> shift & 63U];
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"n"}],)"
         R"("meshes":[{"name":"tooth","primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-0.012],"max":[0.01,0.0155,0]},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)" + text + R"("}]})";
}

void expect_the_tetrahedron(const std::string& content, const std::string& extension) {
  const auto bodies = parse_bodies(content, extension);
  ASSERT_TRUE(bodies) << extension << ": " << bodies.error().message;
  ASSERT_EQ(bodies->size(), 1U) << extension;
  const TriangleMesh& mesh = bodies->front().mesh;
  ASSERT_EQ(mesh.triangles.size(), 4U) << extension;
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0;
    for (const std::uint32_t v : t) {
      EXPECT_TRUE(std::any_of(kCorners.begin(), kCorners.end(), [&](const Point& corner) {
        return std::hypot(corner[0] - mesh.vertices[v][0], corner[1] - mesh.vertices[v][1], corner[2] - mesh.vertices[v][2]) < 2e-6;
      })) << extension << ": " << mesh.vertices[v][0] << " " << mesh.vertices[v][1] << " " << mesh.vertices[v][2];
    }
  }
  EXPECT_NEAR(volume, 10.0 * 12.0 * 15.5 / 6.0, 1e-3) << extension;  // outward
}

TEST(AssimpReader, EveryFormatComesBackInMillimetresWithZUp) {
  expect_the_tetrahedron(off_text(), ".off");
  expect_the_tetrahedron(off_text(), ".OFF");
  expect_the_tetrahedron(amf_text("", 1.0), ".amf");
  expect_the_tetrahedron(amf_text("unit=\"inch\"", 1.0 / 25.4), ".amf");
  expect_the_tetrahedron(amf_text("unit='micron'", 1000.0), ".amf");
  expect_the_tetrahedron(dae_text(R"(name="millimeter" meter="0.001")", "Z_UP", kAsItIs, 1.0), ".dae");
  expect_the_tetrahedron(dae_text(R"(name="meter" meter="1")", "Y_UP", kYUp, 1e-3), ".dae");
  expect_the_tetrahedron(exported("3ds", kAsItIs, 1.0F), ".3ds");
  expect_the_tetrahedron(x3d_text(), ".x3d");
  expect_the_tetrahedron(gltf_text(), ".gltf");
  expect_the_tetrahedron(fbx_text("1", "1", kYUp, 0.1F), ".fbx");
  expect_the_tetrahedron(fbx_text("2", "0.1", kAsItIs, 1.0F), ".fbx");
}

TEST(AssimpReader, ABodyHasItsName) {
  const auto bodies = parse_bodies(dae_text(R"(meter="0.001")", "Z_UP", kAsItIs, 1.0), ".dae");
  ASSERT_TRUE(bodies);
  EXPECT_EQ(bodies->front().name, "tooth");
}

TEST(AssimpReader, WhatCannotBeReadIsSaid) {
  for (const auto& [content, extension] : {std::pair<std::string, std::string>{"<COLLADA", ".dae"},
                                           {"OFF\n4 4", ".off"},
                                           {"no file at all", ".fbx"},
                                           {"{\"asset\":{}}", ".gltf"}}) {
    const auto bodies = parse_bodies(content, extension);
    ASSERT_FALSE(bodies) << extension;
    EXPECT_EQ(bodies.error().code, ErrorCode::kSyntax) << extension << ": " << bodies.error().message;
    EXPECT_FALSE(bodies.error().message.empty());
  }
}

TEST(AssimpReader, DamagedFilesEndInAnAnswer) {
  std::mt19937 dice(7);
  const std::array<std::pair<std::string, std::string>, 5> files{{{dae_text(R"(meter="0.001")", "Z_UP", kAsItIs, 1.0), ".dae"},
                                                                  {exported("3ds", kAsItIs, 1.0F), ".3ds"},
                                                                  {exported("fbx", kAsItIs, 1.0F), ".fbx"},
                                                                  {gltf_text(), ".gltf"},
                                                                  {off_text(), ".off"}}};
  int read = 0, refused = 0;
  for (int i = 0; i < 60; ++i) {
    auto [content, extension] = files[static_cast<std::size_t>(i) % files.size()];
    ASSERT_FALSE(content.empty()) << extension;
    for (int k = 0; k < 4; ++k) content[dice() % content.size()] = static_cast<char>(dice());
    const auto bodies = parse_bodies(content, extension);
    ++(bodies ? read : refused);
    EXPECT_TRUE(bodies || !bodies.error().message.empty());
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
  // assimp 5.2 crashes on an OFF file whose corners share a line
  EXPECT_FALSE(parse_bodies("OFF\n4 4 0\n0 0 0 10 0 0 0 12 0 0 0 15\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n", ".off"));
}

TEST(AssimpReader, AFileThatCopiesItselfIsRefused) {
  // 24 levels of two nodes each: 17 million tetrahedra in a file of 4 KB
  std::string nodes = R"(<library_nodes><node id="n0"><instance_geometry url="#tooth"/></node>)";
  for (int i = 1; i <= 24; ++i)
    nodes += "<node id=\"n" + std::to_string(i) + "\"><instance_node url=\"#n" + std::to_string(i - 1) + "\"/><instance_node url=\"#n" +
             std::to_string(i - 1) + "\"/></node>";
  std::string content = dae_text(R"(meter="0.001")", "Z_UP", kAsItIs, 1.0);
  replace(content, "<library_visual_scenes>", nodes + "</library_nodes><library_visual_scenes>");
  replace(content, R"(<instance_geometry url="#tooth"/></node></visual_scene>)", R"(<instance_node url="#n24"/></node></visual_scene>)");
  EXPECT_FALSE(parse_bodies(content, ".dae"));
}

TEST(AssimpReader, EndingsAreKnownInAnyCase) {
  for (const char* mesh : {".stl", ".STL", ".3mf", ".obj", ".ply", ".glb", ".off", ".Dae", ".amf"}) EXPECT_TRUE(is_mesh_extension(mesh)) << mesh;
  for (const char* other : {"", ".", ".step", ".csv", ".xml", ".txt", ".dxf", "stl"}) EXPECT_FALSE(is_mesh_extension(other)) << other;
}

}  // namespace
}  // namespace trueflank::io
