// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is written is read back by assimp, an independent reader, and by our own.
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <nlohmann/json.hpp>

#include <complex>
#include <cstring>
#include <functional>

#include "tests/export/sample_scene.h"
#include "trueflank/export/glb_writer.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/number_text.h"
#include "trueflank/export/obj_writer.h"
#include "trueflank/export/ply_writer.h"
#include "trueflank/export/stl_writer.h"
#include "trueflank/export/threemf_writer.h"
#include "trueflank/export/packed/zip_archive.h"

namespace trueflank::io {
namespace {

using test::SampleScene;
using test::ScratchFolder;

struct Format {
  const char* name;
  Status (*write)(const std::filesystem::path&, const Scene&);
  double accuracy_mm;  ///< of a coordinate up to 40 mm
};
std::ostream& operator<<(std::ostream& out, const Format& format) { return out << format.name; }

class EveryMeshWriter : public testing::TestWithParam<Format> {};
INSTANTIATE_TEST_SUITE_P(As, EveryMeshWriter,
                         testing::Values(Format{"stl", write_stl, 2e-6}, Format{"ply", write_ply, 1e-12},
                                         Format{"obj", write_obj, 0.9e-6},
                                         Format{"3mf", write_3mf, 0.9e-6},
                                         Format{"glb", write_glb, 4e-6}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

std::filesystem::path file_of(const ScratchFolder& folder, const Format& format) {
  return folder / (std::string("file.") + format.name);
}

TEST_P(EveryMeshWriter, KeepsEveryCornerOfAPart) {
  const ScratchFolder folder;
  const SampleScene sample;
  const auto path = file_of(folder, GetParam());
  ASSERT_TRUE(GetParam().write(path, sample.part()));
  const auto mesh = read_mesh(path);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertices.size(), sample.sun.vertices.size());
  EXPECT_LE(test::farthest_corner_mm(*mesh, sample.sun), GetParam().accuracy_mm);
  EXPECT_TRUE(test::is_closed(*mesh));
  EXPECT_NEAR(test::summed_volume_mm3(*mesh), sample.sun_volume_mm3, 1e-3);
}

TEST_P(EveryMeshWriter, PlacesEveryBodyOfAnAssembly) {
  const ScratchFolder folder;
  const SampleScene sample;
  const auto path = file_of(folder, GetParam());
  ASSERT_TRUE(GetParam().write(path, sample.assembly()));
  const auto mesh = read_mesh(path);
  ASSERT_TRUE(mesh) << mesh.error().message;
  TriangleMesh expected;
  for (const Placement& body : sample.assembly().bodies) {
    const auto first = static_cast<std::uint32_t>(expected.vertices.size());
    const TriangleMesh& shape = body.part == 0 ? sample.sun : sample.planet;
    for (const auto& v : shape.vertices) {
      // turned by a complex product, not by the code under test
      const auto p = std::polar(1.0, body.rotation_rad) * std::complex<double>(v[0], v[1]);
      expected.vertices.push_back({p.real() + body.translation_mm[0],
                                   p.imag() + body.translation_mm[1],
                                   v[2] + body.translation_mm[2]});
    }
    for (const auto& t : shape.triangles)
      expected.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  EXPECT_LE(test::farthest_corner_mm(*mesh, expected), GetParam().accuracy_mm);
}

TEST_P(EveryMeshWriter, GivesTheSameBytesTwice) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(GetParam().write(folder / "a", sample.assembly()));
  ASSERT_TRUE(GetParam().write(folder / "b", sample.assembly()));
  EXPECT_EQ(read_file(folder / "a").value(), read_file(folder / "b").value());
}

TEST_P(EveryMeshWriter, ReportsAFullDisk) {
  const SampleScene sample;
  const auto status = GetParam().write("/dev/full", sample.assembly());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kDisk);
}

/// Volume of everything in an assimp scene, node transforms applied, and the bodies' names.
struct Imported {
  double volume = 0.0;
  unsigned triangles = 0;
  std::set<std::string> names;
};
Imported import(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  Imported result;
  if (scene == nullptr) {
    ADD_FAILURE() << importer.GetErrorString();
    return result;
  }
  std::function<void(const aiNode*, aiMatrix4x4)> visit = [&](const aiNode* node, aiMatrix4x4 outer) {
    const aiMatrix4x4 global = outer * node->mTransformation;
    if (node->mNumMeshes > 0) result.names.insert(node->mName.C_Str());
    for (unsigned m = 0; m < node->mNumMeshes; ++m) {
      const aiMesh* mesh = scene->mMeshes[node->mMeshes[m]];
      for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
        double v[3][3];
        for (int k = 0; k < 3; ++k) {
          const aiVector3D p = global * mesh->mVertices[mesh->mFaces[f].mIndices[k]];
          v[k][0] = p.x, v[k][1] = p.y, v[k][2] = p.z;
        }
        result.volume += (v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                          v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                          v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0])) / 6.0;
        ++result.triangles;
      }
    }
    for (unsigned c = 0; c < node->mNumChildren; ++c) visit(node->mChildren[c], global);
  };
  visit(scene->mRootNode, aiMatrix4x4());
  return result;
}

TEST_P(EveryMeshWriter, IsReadByAssimpWithTheSameVolume) {
  const ScratchFolder folder;
  const SampleScene sample;
  const auto path = file_of(folder, GetParam());
  ASSERT_TRUE(GetParam().write(path, sample.part()));
  const Imported imported = import(path);
  EXPECT_EQ(imported.triangles, sample.sun.triangles.size());
  const double unit_mm = GetParam().name == std::string("glb") ? 1000.0 : 1.0;
  EXPECT_NEAR(imported.volume * std::pow(unit_mm, 3), sample.sun_volume_mm3,
              2e-5 * sample.sun_volume_mm3);  // assimp computes in float
}

// assimp's 3MF reader does not know components, so that one is left to our own and other programs.
TEST(MeshWriters, AssembliesAreReadByAssimpWithTheSameVolume) {
  const ScratchFolder folder;
  const SampleScene sample;
  const double volume = sample.sun_volume_mm3 + 2 * sample.planet_volume_mm3;
  ASSERT_TRUE(write_stl(folder / "a.stl", sample.assembly()));
  EXPECT_NEAR(import(folder / "a.stl").volume, volume, 2e-5 * volume);
  ASSERT_TRUE(write_ply(folder / "a.ply", sample.assembly()));
  EXPECT_NEAR(import(folder / "a.ply").volume, volume, 2e-5 * volume);
  ASSERT_TRUE(write_obj(folder / "a.obj", sample.assembly()));
  EXPECT_NEAR(import(folder / "a.obj").volume, volume, 2e-5 * volume);
  ASSERT_TRUE(write_glb(folder / "a.glb", sample.assembly()));
  const Imported glb = import(folder / "a.glb");
  EXPECT_NEAR(glb.volume * 1e9, volume, 2e-5 * volume);
  EXPECT_EQ(glb.names, (std::set<std::string>{"sun", "planet 1", "planet 2"}));
}

TEST(MeshWriters, NameEveryBodyWhereTheFormatCan) {
  const ScratchFolder folder;
  const SampleScene sample;
  const auto names = [](const std::filesystem::path& path) {
    std::vector<std::string> result;
    const std::vector<MeshBody> bodies = read_bodies(path).value();
    for (const MeshBody& body : bodies) result.push_back(body.name);
    return result;
  };
  ASSERT_TRUE(write_3mf(folder / "a.3mf", sample.assembly()));
  EXPECT_EQ(names(folder / "a.3mf"), (std::vector<std::string>{"sun", "planet 1", "planet 2"}));
  ASSERT_TRUE(write_glb(folder / "a.glb", sample.assembly()));
  EXPECT_EQ(names(folder / "a.glb"), (std::vector<std::string>{"sun", "planet 1", "planet 2"}));
  ASSERT_TRUE(write_obj(folder / "a.obj", sample.assembly()));
  EXPECT_EQ(names(folder / "a.obj"), (std::vector<std::string>{"sun", "planet_1", "planet_2"}));
}

TEST(StlWriter, DoesNotBeginLikeATextFileAndTellsNoTime) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_stl(folder / "solid.stl", sample.part()));
  const std::string content = read_file(folder / "solid.stl").value();
  EXPECT_EQ(content.substr(0, 80), "Trueflank binary STL, millimetres: sun" + std::string(42, '\0'));
  EXPECT_EQ(content.size(), 84 + 50 * sample.sun.triangles.size());
}

TEST(StlWriter, GivesEveryTriangleItsOutwardNormal) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_stl(folder / "a.stl", sample.part()));
  const std::string content = read_file(folder / "a.stl").value();
  for (std::size_t i = 0; i < sample.sun.triangles.size(); ++i) {
    float v[12];
    std::memcpy(v, content.data() + 84 + 50 * i, sizeof v);
    double u[3], w[3];
    for (int k = 0; k < 3; ++k) u[k] = v[6 + k] - v[3 + k], w[k] = v[9 + k] - v[3 + k];
    const double n[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                         u[0] * w[1] - u[1] * w[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(v[k], n[k] / length, 1e-5);
  }
}

// Two vertices nearer than float can tell would make triangles of no area; without them the mesh
// still closes.
TEST(StlWriter, StaysClosedWhereVerticesRoundToOnePoint) {
  const ScratchFolder folder;
  TriangleMesh box;  // an edge of 1e-8 mm on one side of a wedge
  box.vertices = {{40, 5, 0}, {40 + 1e-8, 5 + 1e-8, 0}, {0, 35, 0}, {40, 5, 9},
                  {40 + 1e-8, 5 + 1e-8, 9}, {0, 35, 9}, {0, 5, 0}, {0, 5, 9}};
  const auto quad = [&](unsigned a, unsigned b, unsigned c, unsigned d) {
    box.triangles.push_back({a, b, c});
    box.triangles.push_back({a, c, d});
  };
  quad(0, 1, 4, 3);
  quad(1, 2, 5, 4);
  quad(2, 6, 7, 5);
  quad(6, 0, 3, 7);
  quad(6, 2, 1, 0);
  quad(7, 3, 4, 5);
  ASSERT_TRUE(test::is_closed(box));
  ASSERT_TRUE(write_stl(folder / "a.stl", part_scene("", "wedge", box)));
  const TriangleMesh read = read_mesh(folder / "a.stl").value();
  EXPECT_EQ(read.vertices.size(), 6U);
  EXPECT_EQ(read.triangles.size(), 8U);
  EXPECT_TRUE(test::is_closed(read));
  EXPECT_NEAR(test::summed_volume_mm3(read), 5400.0, 1e-3);
}

TEST(ThreemfWriter, HoldsOneObjectAShapeWithUnitNameAndColour) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_3mf(folder / "a.3mf", sample.assembly()));
  const std::string archive = read_file(folder / "a.3mf").value();
  EXPECT_EQ(zip_names(archive).value(),
            (std::vector<std::string>{"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"}));
  Reading reading(archive.size());
  const std::string model = zip_content(archive, "3D/3dmodel.model", reading).value();
  const auto count = [&](const std::string& word) {
    int found = 0;
    for (auto at = model.find(word); at != model.npos; at = model.find(word, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("unit=\"millimeter\""), 1);
  EXPECT_EQ(count("<mesh>"), 2);
  EXPECT_EQ(count("<item "), 1);
  EXPECT_EQ(count("<base name=\"sun\" displaycolor=\"#e6a82e\"/>"), 1);
  EXPECT_EQ(count("<metadata name=\"Title\">sample &lt;&amp;&quot;set&quot;&gt;</metadata>"), 1);
  EXPECT_EQ(count("<component "), 5);  // three bodies, two of them with a name of their own
}

TEST(GlbWriter, KeepsTheRulesOfTheFormat) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_glb(folder / "a.glb", sample.assembly()));
  const std::string content = read_file(folder / "a.glb").value();
  std::uint32_t words[5];
  std::memcpy(words, content.data(), sizeof words);
  EXPECT_EQ(words[2], content.size());
  EXPECT_EQ(words[3] % 4, 0U);
  const auto document = nlohmann::json::parse(content.substr(20, words[3]));
  EXPECT_EQ(document["meshes"].size(), 2U);  // shared by three bodies
  EXPECT_EQ(document["nodes"].size(), 4U);
  EXPECT_EQ(document["asset"]["version"], "2.0");
  for (const auto& view : document["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
  const auto& root = document["nodes"][document["scenes"][0]["nodes"][0].get<int>()];
  EXPECT_EQ(root["scale"], (std::vector<double>{0.001, 0.001, 0.001}));
  // sRGB 0x80 is 0.2158605 of linear light (IEC 61966-2-1)
  EXPECT_NEAR(document["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"][1], 0.2158605, 1e-6);
  // min and max are those of the floats in the buffer
  const std::size_t bin = 20 + words[3] + 8;
  const auto& accessor = document["accessors"][0];
  float low[3] = {1e9F, 1e9F, 1e9F};
  for (int i = 0; i < accessor["count"].get<int>(); ++i) {
    float p[3];
    std::memcpy(p, content.data() + bin + 12 * i, sizeof p);
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]);
  }
  for (int k = 0; k < 3; ++k) EXPECT_EQ(accessor["min"][k].get<float>(), low[k]);
}

TEST(NumberText, RoundsToTheNearestNanometre) {
  const auto text = [](double value) {
    std::string out;
    append_decimal(out, value);
    return out;
  };
  EXPECT_EQ(text(0.0), "0");
  EXPECT_EQ(text(-0.0), "0");
  EXPECT_EQ(text(-1e-9), "0");
  EXPECT_EQ(text(12.5), "12.5");
  EXPECT_EQ(text(-12.000001), "-12.000001");
  EXPECT_EQ(text(-0.1234567), "-0.123457");
  EXPECT_EQ(text(0.9999999), "1");
  EXPECT_EQ(text(1e15), "1e+15");
}

}  // namespace
}  // namespace trueflank::io
