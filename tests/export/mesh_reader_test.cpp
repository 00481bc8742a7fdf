// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files as other programs write them, and files that are none.
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/glb_writer.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/obj_writer.h"
#include "trueflank/export/ply_writer.h"
#include "trueflank/export/stl_writer.h"
#include "trueflank/export/threemf_writer.h"
#include "trueflank/export/packed/zip_archive.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/export/sample_scene.h"

namespace trueflank::io {
namespace {

using test::SampleScene;
using test::ScratchFolder;

std::string tetrahedron_stl(const std::string& name) {
  const char* corners[4] = {"0 0 0", "1.0e+00 0 0", "0 +2 0", "0 0 3"};
  std::string text = "solid " + name + "\r\n";
  for (const auto& t : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    text += "  facet normal 0 0 0\r\n    outer loop\r\n";
    for (const int i : t) text += std::string("      vertex ") + corners[i] + "\r\n";
    text += "    endloop\r\n  endfacet\r\n";
  }
  return text + "endsolid " + name + "\r\n";
}

TEST(MeshReader, ReadsATextStlAndWeldsIt) {
  const auto bodies = parse_bodies(tetrahedron_stl("one solid") + tetrahedron_stl("two"), ".stl");
  ASSERT_TRUE(bodies) << bodies.error().message;
  ASSERT_EQ(bodies->size(), 2U);
  EXPECT_EQ(bodies->front().name, "one solid");
  EXPECT_EQ(bodies->back().mesh.vertices.size(), 4U);
  EXPECT_TRUE(test::is_closed(bodies->back().mesh));
  EXPECT_NEAR(test::summed_volume_mm3(bodies->back().mesh), 1.0, 1e-12);
}

TEST(MeshReader, TellsABinaryStlThatBeginsWithSolidFromText) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_stl(folder / "a.stl", sample.part()));
  std::string content = read_file(folder / "a.stl").value();
  std::memcpy(content.data(), "solid facet", 11);
  const auto bodies = parse_bodies(content, ".stl");
  ASSERT_TRUE(bodies) << bodies.error().message;
  EXPECT_EQ(bodies->front().mesh.triangles.size(), sample.sun.triangles.size());
}

TEST(MeshReader, ReadsObjPolygonsWithTextureNormalsAndNegativeNumbers) {
  const auto bodies = parse_bodies(
      "# a cube from elsewhere\r\nmtllib a.mtl\no cube\ns off\n"
      "v 0 0 0 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nvt 0 0\n"
      "vn 0 0 1\nf 4/1/1 3/1/1 2/1/1 1/1/1\nf 5//1 6//1 7//1 8//1\nf 1/1 2/1 6/1 5/1\nf 2 3 7 6\n"
      "f 3 4 8 7 # side\nf -5 -8 -4 -1\n",
      ".obj");
  ASSERT_TRUE(bodies) << bodies.error().message;
  EXPECT_EQ(bodies->front().name, "cube");
  EXPECT_EQ(bodies->front().mesh.triangles.size(), 12U);
  EXPECT_TRUE(test::is_closed(bodies->front().mesh));
  EXPECT_NEAR(test::summed_volume_mm3(bodies->front().mesh), 8.0, 1e-12);
}

TEST(MeshReader, ReadsATextPlyWithMoreThanItNeeds) {
  const auto bodies = parse_bodies(
      "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float z\n"
      "property float x\nproperty float y\nproperty uchar red\nelement face 4\n"
      "property list uchar int vertex_index\nelement edge 1\nproperty int vertex1\n"
      "property int vertex2\nend_header\n0 0 0 1\n0 1 0 2\n0 0 2 3\n3 0 0 4\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n0 1\n",
      ".ply");
  ASSERT_TRUE(bodies) << bodies.error().message;
  EXPECT_NEAR(test::summed_volume_mm3(bodies->front().mesh), 1.0, 1e-12);
}

TEST(MeshReader, ReadsABigEndianPly) {
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](auto value) {
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    std::reverse(bytes, bytes + 4);
    content.append(bytes, 4);
  };
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.5F, 0.F}) put(value);
  content += '\3';
  for (const int value : {0, 1, 2}) put(value);
  const auto bodies = parse_bodies(content, ".ply");
  ASSERT_TRUE(bodies) << bodies.error().message;
  EXPECT_EQ(bodies->front().mesh.vertices[2][1], 2.5);
  EXPECT_EQ(bodies->front().mesh.triangles.size(), 1U);
}

TEST(MeshReader, GivesThePointsOfACloudButNoMesh) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_file(folder / "cloud.ply",
                         "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\n"
                         "property double y\nproperty double z\nend_header\n1 2 3\n4 5 6\n"));
  EXPECT_EQ(read_points(folder / "cloud.ply").value().at(1)[2], 6.0);
  const auto mesh = read_mesh(folder / "cloud.ply");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kSyntax);
  EXPECT_EQ(mesh.error().file, (folder / "cloud.ply").string());
}

// Facets one after the other are those of the mesh, in every format.
TEST(MeshReader, ShowsTheFacetsOfTheMesh) {
  const ScratchFolder folder;
  const SampleScene sample;
  const Scene scene = sample.assembly();
  ASSERT_TRUE(write_stl(folder / "a.stl", scene));
  ASSERT_TRUE(write_obj(folder / "a.obj", scene));
  ASSERT_TRUE(write_ply(folder / "a.ply", scene));
  ASSERT_TRUE(write_3mf(folder / "a.3mf", scene));
  ASSERT_TRUE(write_glb(folder / "a.glb", scene));
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.3mf", "a.glb"}) {
    const TriangleMesh mesh = read_mesh(folder / name).value();
    std::size_t next = 0, different = 0;
    ASSERT_TRUE(visit_facets(folder / name, [&](const Facet& facet) {
      const auto& t = mesh.triangles.at(next++);
      for (std::size_t k = 0; k < 3; ++k) different += facet[k] == mesh.vertices[t[k]] ? 0 : 1;
    })) << name;
    EXPECT_EQ(next, mesh.triangles.size()) << name;
    EXPECT_EQ(different, 0U) << name;
  }
}

TEST(MeshReader, FacetsOfWhatIsNoMeshAreAnError) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_stl(folder / "a.stl", sample.part()));
  const std::string good = read_file(folder / "a.stl").value();
  std::string none = good.substr(0, 84), infinite = good;
  none.replace(80, 4, 4, '\0');
  const float far = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 84 + 12, &far, sizeof far);
  const auto ignore = [](const Facet&) {};
  for (const std::string& content : {good.substr(0, good.size() - 7), none, infinite, std::string(),
                                     std::string("no mesh at all")}) {
    ASSERT_TRUE(write_file(folder / "b.stl", content));
    const auto status = visit_facets(folder / "b.stl", ignore);
    ASSERT_FALSE(status) << content.size();
    EXPECT_EQ(status.error().code, ErrorCode::kSyntax) << content.size();
    EXPECT_EQ(status.error().file, (folder / "b.stl").string());
  }
  EXPECT_EQ(visit_facets(folder / "missing.stl", ignore).error().code, ErrorCode::kFileNotFound);
  EXPECT_EQ(visit_facets(folder.path(), ignore).error().code, ErrorCode::kDisk);
}

std::string package(const std::string& model, const std::string& more = {}) {
  const auto packed = [](std::string_view text) {
    PackedText all(text);
    all.close();
    return all;
  };
  std::vector<ZipEntry> entries = {
      {"_rels/.rels",
       packed("<?xml version='1.0'?><Relationships><Relationship Target='/3D/a.model' Id='r' "
       "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>")},
      {"3D/a.model", packed(model)}};
  if (!more.empty()) entries.push_back({"3D/Objects/b.model", packed(more)});
  return zip_archive(entries).value();
}

const std::string kTetrahedron =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='2' "
    "z='0'/><vertex x='0' y='0' z='3'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/>"
    "<triangle v1='0' v2='1' v3='3'/><triangle v1='1' v2='2' v3='3'/><triangle v1='0' v2='3' "
    "v3='2'/></triangles></mesh>";

TEST(MeshReader, ReadsUnitsTransformsAndModelPartsOf3mf) {
  const auto bodies = parse_bodies(
      package("<model unit='inch' xmlns:p='x'><!-- <object id='9'/> --><resources>"
              "<object id='1' name='far &#x41;&amp;B'><components><component p:path="
              "'/3D/Objects/b.model' objectid='1' transform='1 0 0 0 1 0 0 0 1 1 0 0'/>"
              "</components></object></resources><build>"
              "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 2'/></build></model>",
              "<model><resources><object id='1'>" + kTetrahedron + "</object></resources>"
              "<build/></model>"),
      ".3mf");
  ASSERT_TRUE(bodies) << bodies.error().message;
  ASSERT_EQ(bodies->size(), 1U);
  const MeshBody& body = bodies->front();
  EXPECT_EQ(body.name, "far A&B");
  EXPECT_NEAR(test::summed_volume_mm3(body.mesh), 25.4 * 25.4 * 25.4, 1e-9);  // mirrored, and mended
  EXPECT_NEAR(body.mesh.vertices[1][0], -2 * 25.4, 1e-12);
  EXPECT_NEAR(body.mesh.vertices[1][2], 2 * 25.4, 1e-12);
}

/// Written as most programs do, with one corner of a facet as given.
Result<std::vector<MeshBody>> plain_3mf_with_corner(const std::string& corner) {
  return parse_bodies(
      package("<model><resources><object id='1'><mesh><vertices>\n<vertex x=\"0\" y=\"0\" z=\"0\"/>\n"
              "<vertex x=\"1\" y=\"0\" z=\"0\"/>\n<vertex x=\"0\" y=\"2\" z=\"0\"/>\n</vertices><triangles>\n"
              "<triangle v1=\"0\" v2=\"1\" v3=\"" +
              corner + "\"/>\n</triangles></mesh></object></resources><build><item objectid='1'/></build></model>"),
      ".3mf");
}

TEST(MeshReader, TakesCornersOf3mfWithZerosInFrontAndNoneBeyondAnyList) {
  for (const char* corner : {"2", "000000002", "0000000002", "00000000000000000002"}) {
    const auto bodies = plain_3mf_with_corner(corner);
    ASSERT_TRUE(bodies) << corner << ": " << bodies.error().message;
    EXPECT_EQ(bodies->front().mesh.triangles.front()[2], 2U) << corner;
  }
  // the second and third are 2 in 32 bits
  for (const char* corner : {"3", "4294967298", "18446744073709551618", "999999999", "", "-2", "x"})
    EXPECT_FALSE(plain_3mf_with_corner(corner)) << corner;
}

TEST(MeshReader, RefusesA3mfThatMultipliesItself) {
  std::string model = "<model><resources><object id='1'>" + kTetrahedron + "</object>";
  for (int id = 2; id < 25; ++id) {
    const std::string below = std::to_string(id - 1);
    model += "<object id='" + std::to_string(id) + "'><components><component objectid='" + below +
             "'/><component objectid='" + below + "'/></components></object>";
  }
  const auto deep = parse_bodies(
      package(model + "</resources><build><item objectid='24'/></build></model>"), ".3mf");
  ASSERT_FALSE(deep);
  EXPECT_EQ(deep.error().code, ErrorCode::kUnsupported);
  const auto endless = parse_bodies(
      package("<model><resources><object id='1'><components><component objectid='1'/></components>"
              "</object></resources><build><item objectid='1'/></build></model>"),
      ".3mf");
  EXPECT_FALSE(endless);
}

TEST(MeshReader, RefusesWhatIsNoMesh) {
  const ScratchFolder folder;
  const auto code_of = [](const std::string& content, const char* extension) {
    const auto bodies = parse_bodies(content, extension);
    return bodies ? ErrorCode::kUsage : bodies.error().code;  // kUsage: none of the codes expected
  };
  for (const char* extension : {".stl", ".obj", ".ply", ".3mf", ".glb", ".toml", ""}) {
    EXPECT_EQ(code_of("", extension), ErrorCode::kSyntax) << extension;
    EXPECT_EQ(code_of("format = 1\nname = 'no mesh'\n", extension), ErrorCode::kSyntax) << extension;
    EXPECT_EQ(code_of(std::string(1000, '\0'), extension), ErrorCode::kSyntax) << extension;
    EXPECT_EQ(code_of("\x89PNG\r\n\x1a\n rubbish", extension), ErrorCode::kSyntax) << extension;
  }
  EXPECT_EQ(code_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ".obj"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of("v 0 0 0\nv 1 nan 0\n", ".obj"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of("v 0 0 0\nv 1 inf 0\n", ".obj"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of("v 0 0 0\nf 1\n", ".obj"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
                    "property float y\nproperty float z\nend_header\n1 2 3\n", ".ply"),
            ErrorCode::kSyntax);
  EXPECT_EQ(code_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
                    ".ply"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", ".stl"),
            ErrorCode::kSyntax);
}

TEST(MeshReader, SaysWhichLineIsWrong) {
  const auto bodies = parse_bodies("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", ".obj");
  ASSERT_FALSE(bodies);
  EXPECT_EQ(bodies.error().line, 4);
}

TEST(MeshReader, TellsMissingFilesAndFolders) {
  const ScratchFolder folder;
  EXPECT_EQ(read_mesh(folder / "none.stl").error().code, ErrorCode::kFileNotFound);
  EXPECT_EQ(read_mesh(folder.path()).error().code, ErrorCode::kDisk);
  EXPECT_EQ(exit_code(read_mesh(folder / "none.stl").error().code), 3);
}

// Every file cut off anywhere, and with any byte spoilt, is an error or another mesh, never a crash
// (run under the sanitizers as well). Cut off, only an OBJ may still be whole.
TEST(MeshReader, SurvivesCutAndSpoiltFiles) {
  const ScratchFolder folder;
  const TriangleMesh small = test::star_prism(3, 2.0, 1.5, 0.5, 1.0);
  const Scene scene = part_scene("x", "small", small);
  const std::vector<std::pair<const char*, Status (*)(const std::filesystem::path&, const Scene&)>>
      writers = {{".stl", write_stl}, {".ply", write_ply}, {".obj", write_obj},
                 {".3mf", write_3mf}, {".glb", write_glb}};
  for (const auto& [extension, write] : writers) {
    ASSERT_TRUE(write(folder / "file", scene));
    const std::string whole = read_file(folder / "file").value();
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const auto cut = parse_bodies(std::string_view(whole).substr(0, length), extension);
      if (std::string(extension) != ".obj") {
        EXPECT_FALSE(cut) << extension << " cut at " << length;
      }
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string spoilt = whole;
      for (const int change : {0x01, 0x80, 0xFF}) {
        spoilt[at] = static_cast<char>(whole[at] ^ change);
        static_cast<void>(parse_bodies(spoilt, extension));
      }
    }
  }
}

}  // namespace
}  // namespace trueflank::io
