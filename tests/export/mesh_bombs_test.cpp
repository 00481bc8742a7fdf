// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small files that ask for much: each once cost minutes or gigabytes. And ordinary large ones, which must
// still be read.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <thread>

#include "tests/export/sample_scene.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/packed/zip_archive.h"

namespace trueflank::io {
namespace {

/// Far more than any of these takes, even under a sanitizer, and far less than each once took.
constexpr double kAtOnce_s = 5.0;

/// Of the processor: other work on the machine does not count.
double seconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void expect_refused(const std::string& content, const char* extension, ErrorCode code) {
  const double taken_s = seconds_of([&] {
    const auto bodies = parse_bodies(content, extension);
    ASSERT_FALSE(bodies);
    EXPECT_EQ(bodies.error().code, code) << bodies.error().message;
    const auto scan = parse_scan(content, extension);
    if (code == ErrorCode::kUnsupported) {
      EXPECT_FALSE(scan);
    }
  });
  EXPECT_LT(taken_s, kAtOnce_s);
}

std::string packed_model(const std::string& model) {
  PackedText packed(model);
  packed.close();
  return zip_archive({{"3D/a.model", packed}}).value();
}

/// An object of a grid of facets, each with `more` attributes.
std::string grid_object(int facets, const std::string& more) {
  std::string text = "<object id=\"1\"><mesh><vertices>\n";
  for (int i = 0; i < facets + 2; ++i)
    text += "<vertex x=\"" + std::to_string(i / 2) + "\" y=\"" + std::to_string(i % 2) +
            "\" z=\"0\" />\n";
  text += "</vertices><triangles>\n";
  for (int i = 0; i < facets; ++i)
    text += "<triangle v1=\"" + std::to_string(i) + "\" v2=\"" + std::to_string(i + 1) +
            "\" v3=\"" + std::to_string(i + 2) + "\"" + more + "/>\n";
  return text + "</triangles></mesh></object>\n";
}

TEST(MeshBombs, ColouredFacetsOf3mfAreReadAtOnce) {
  constexpr int kFacets = 100'000;
  for (const std::string more : {" pid=\"2\" p1=\"0\"", " pid='2'", " note=\"a > b\""}) {
    const std::string content = packed_model("<model><resources>" + grid_object(kFacets, more) +
                                        "</resources><build><item objectid=\"1\"/></build></model>");
    const double taken_s = seconds_of([&] {
      const auto bodies = parse_bodies(content, ".3mf");
      ASSERT_TRUE(bodies) << bodies.error().message;
      EXPECT_EQ(bodies->front().mesh.triangles.size(), std::size_t{kFacets});
      EXPECT_EQ(bodies->front().mesh.triangles.back()[2], std::uint32_t{kFacets + 1});
    });
    EXPECT_LT(taken_s, kAtOnce_s) << more;
  }
}

TEST(MeshBombs, ListsThatNeverEndAreSearchedOnce) {
  std::string model = "<model><resources><object id=\"1\"><mesh>";
  for (int i = 0; i < 100'000; ++i) model += "<vertices>\n<vertex x=\"0\" y=\"0\" z=\"0\"  />";
  EXPECT_LT(seconds_of([&] { static_cast<void>(parse_bodies(packed_model(model), ".3mf")); }), kAtOnce_s);
}

TEST(MeshBombs, ComponentsOfComponentsAreRefused) {
  std::string model = "<model><resources>" + grid_object(40'000, "");
  for (int id = 2; id <= 6; ++id) {
    model += "<object id=\"" + std::to_string(id) + "\"><components>";
    for (int i = 0; i < 10; ++i) model += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    model += "</components></object>";
  }
  expect_refused(packed_model(model + "</resources><build><item objectid=\"6\"/></build></model>"), ".3mf",
                 ErrorCode::kUnsupported);
}

TEST(MeshBombs, APlateOfManyCopiesIsRead) {
  std::string model = "<model><resources>" + grid_object(10'000, "") + "</resources><build>";
  for (int i = 0; i < 60; ++i)
    model += "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 " + std::to_string(20 * i) + " 0 0\"/>";
  const auto bodies = parse_bodies(packed_model(model + "</build></model>"), ".3mf");
  ASSERT_TRUE(bodies) << bodies.error().message;
  EXPECT_EQ(bodies->size(), 60U);
}

TEST(MeshBombs, BlanksInAnArchiveAreRefused) {
  expect_refused(packed_model("<model>" + std::string(100U << 20, ' ') + "</model>"), ".3mf",
                 ErrorCode::kUnsupported);
}

TEST(MeshBombs, AnArchiveOfCountlessEntriesIsRefused) {
  std::vector<ZipEntry> entries;
  PackedText nothing("");
  nothing.close();
  for (int i = 0; i < 20'000; ++i) entries.push_back({"a" + std::to_string(i), nothing});
  expect_refused(zip_archive(entries).value(), ".3mf", ErrorCode::kUnsupported);
}

/// Of a description and binary content.
std::string glb(std::string json, std::string bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  std::string file = "glTF";
  const auto put = [&](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    file.append(reinterpret_cast<const char*>(&word), 4);
  };
  put(2);
  put(12 + 8 + json.size() + 8 + bin.size());
  put(json.size());
  file += "JSON" + json;
  put(bin.size());
  file += std::string("BIN\0", 4) + bin;
  return file;
}

/// `vertices` places, each group of three a facet, in accessor 0.
std::string described(std::size_t vertices, const std::string& count, const std::string& meshes_and_nodes) {
  return R"({"asset":{"version":"2.0"},"scene":0,"bufferViews":[{"buffer":0,"byteLength":)" +
         std::to_string(12 * vertices) +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + count + "}]," +
         meshes_and_nodes + "}";
}

const std::string kOneMesh =
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])";

TEST(MeshBombs, NodesOfNodesInAGlbAreRefused) {
  constexpr std::size_t kVertices = 30'000;
  std::string nodes = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"scenes":[{"nodes":[5]}],)"
                      R"("nodes":[{"mesh":0})";
  for (int level = 1; level <= 5; ++level) {
    nodes += R"(,{"children":[)";
    for (int i = 0; i < 10; ++i) nodes += (i == 0 ? "" : ",") + std::to_string(level - 1);
    nodes += "]}";
  }
  const std::string bin(12 * kVertices, '\0');
  expect_refused(glb(described(kVertices, std::to_string(kVertices), nodes + "]"), bin), ".glb",
                 ErrorCode::kUnsupported);
}

TEST(MeshBombs, APrimitiveRepeatedInAGlbIsRefused) {
  constexpr std::size_t kVertices = 3'000;
  std::string meshes = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)";
  for (int i = 0; i < 20'000; ++i)
    meshes += std::string(i == 0 ? "" : ",") + R"({"attributes":{"POSITION":0}})";
  const std::string bin(12 * kVertices, '\0');
  expect_refused(glb(described(kVertices, std::to_string(kVertices), meshes + "]}]"), bin), ".glb",
                 ErrorCode::kUnsupported);
}

TEST(MeshBombs, ImpossibleNumbersInAGlbAreRefused) {
  const std::string bin(36, '\0');
  ASSERT_TRUE(parse_bodies(glb(described(3, "3", kOneMesh), bin), ".glb"));
  for (const char* count : {"1e30", "-1", "3.5", "99999999999999999999", "18446744073709551615", "true"})
    expect_refused(glb(described(3, count, kOneMesh), bin), ".glb", ErrorCode::kSyntax);
}

TEST(MeshBombs, ManySolidsInATextStlCostNoMoreThanTheirText) {
  const std::string facet =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n";
  std::string many = facet, too_many = facet;
  for (int i = 0; i < 50'000; ++i) many += "solid\nendsolid\n";
  for (int i = 0; i < 400'000; ++i) too_many += "solid\nendsolid\n";
  EXPECT_LT(seconds_of([&] { EXPECT_TRUE(parse_bodies(many, ".stl")); }), kAtOnce_s);
  expect_refused(too_many, ".stl", ErrorCode::kUnsupported);
}

TEST(MeshBombs, HeadersOfPlyThatPromiseWithoutEndAreRefused) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string place = "property float x\nproperty float y\nproperty float z\n";
  for (const std::string& header :
       {"element vertex 99999999999\n" + place, "element foo 999999999999999\nproperty int a\n" +
        ("element vertex 1\n" + place), "element vertex 1e11\n" + place, "element vertex -1\n" + place,
        "element vertex 1\n" + place + "element face 1\nproperty list foo int vertex_indices\n"})
    expect_refused(head + header + "end_header\n1 2 3\n", ".ply", ErrorCode::kSyntax);
  // without properties a vertex has no place: nothing to read, however many there are
  const auto nothing = parse_bodies(head + "element vertex 99999999999\nend_header\n", ".ply");
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->front().mesh.vertices.empty());
}

std::string three_points_ply(const std::string& indices) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 " + indices + "\n";
}

TEST(MeshBombs, ImpossibleVertexNumbersOfPlyAreRefusedInMeshesAndLeftOutOfScans) {
  for (const char* indices : {"-1 1 2", "0 1 1e300", "0 1 3", "0 1.5 2", "0 1 4294967295"}) {
    EXPECT_FALSE(parse_bodies(three_points_ply(indices), ".ply")) << indices;
    const auto scan = parse_scan(three_points_ply(indices), ".ply");
    ASSERT_TRUE(scan) << indices;
    EXPECT_EQ(scan->mesh.triangles.size(), 1U) << indices;
    ASSERT_EQ(scan->notes.size(), 1U) << indices;
    EXPECT_NE(scan->notes[0].find("1 facets left out"), std::string::npos) << scan->notes[0];
  }
}

TEST(MeshBombs, NumbersOfManyDigitsAreReadAsTheStandardLibraryReadsThem) {
  for (const char* number : {"1.0000000000000000000000000001", "1234567890123456789012345.5",
                             "0.12345678901234567", "123456789012345.1", "9007199254740993"}) {
    const auto bodies = parse_bodies(std::string("v ") + number + " 0 0\n", ".obj");
    ASSERT_TRUE(bodies) << number;
    EXPECT_EQ(bodies->front().mesh.vertices[0][0], std::strtod(number, nullptr)) << number;
  }
  EXPECT_FALSE(parse_bodies("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", ".obj"));
}

TEST(MeshBombs, WhatNeverEndsIsReadToABound) {
  const double taken_s = seconds_of([] {
    for (const auto most : {std::size_t{1} << 20, std::size_t{64} << 20}) {
      const auto content = read_file("/dev/zero", most);
      ASSERT_FALSE(content);
      EXPECT_EQ(content.error().code, ErrorCode::kUnsupported);
      EXPECT_EQ(content.error().file, "/dev/zero");
      // a device is a terminal at best: its bound is that of the smaller
      EXPECT_NE(content.error().message.find("larger than the 1 MB"), std::string::npos);
    }
  });
  EXPECT_LT(taken_s, kAtOnce_s);
}

TEST(MeshBombs, AFileThatOnlyReservedItsSizeIsRefusedBeforeItIsRead) {
  const test::ScratchFolder folder;
  const auto path = folder.path() / "reserved.stl";
  ASSERT_TRUE(write_file(path, "solid part\n"));
  std::filesystem::resize_file(path, std::uintmax_t{256} << 20);  // of which one block is on the disk
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  const off_t hole = ::lseek(descriptor, 0, SEEK_HOLE);
  ::close(descriptor);
  if (hole < 0 || hole > 1 << 20) GTEST_SKIP() << "the file system does not tell what has been written";
  const double taken_s = seconds_of([&] {
    const auto content = read_file(path);
    ASSERT_FALSE(content);
    EXPECT_EQ(content.error().code, ErrorCode::kSyntax);
    EXPECT_EQ(content.error().file, path.string());
    EXPECT_FALSE(visit_facets(path, [](const Facet&) {}));
  });
  EXPECT_LT(taken_s, kAtOnce_s);
  const std::string zeros(std::size_t{17} << 20, '\0');  // written: as good as any
  ASSERT_TRUE(write_file(path, zeros));
  const auto content = read_file(path);
  ASSERT_TRUE(content);
  EXPECT_TRUE(*content == zeros);  // not printed
}

TEST(MeshBombs, WhatComesOutOfAPipeInManyPiecesIsReadWhole) {
  std::string sent;
  for (int i = 0; sent.size() < (std::size_t{7} << 19); ++i) sent += std::to_string(i) + "\n";
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1} << 20, std::size_t{1} << 21, sent.size()}) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread writer([&, end = ends[1]] {
      for (std::size_t at = 0; at < size;)
        at += static_cast<std::size_t>(::write(end, sent.data() + at, size - at));
      ::close(end);
    });
    const auto content = read_file("/dev/fd/" + std::to_string(ends[0]));
    writer.join();
    ::close(ends[0]);
    ASSERT_TRUE(content);
    EXPECT_TRUE(*content == sent.substr(0, size));
  }
}

TEST(Scans, ATextStlCutShortIsUsedForWhatItHolds) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const auto scan = parse_scan("solid a\n" + facet + facet + "facet normal 0 0 1\nouter loop\nvertex 0", ".stl");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->mesh.triangles.size(), 2U);
  ASSERT_EQ(scan->notes.size(), 1U);
}

TEST(Scans, VerticesOfABinaryPlyAreReadInPiecesWithOtherNumbersBetween) {
  constexpr int kVertices = 70'001;  // more than one piece, the last cut short
  std::string content = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kVertices) +
                        "\nproperty double x\nproperty uchar red\nproperty float y\nproperty short z\nend_header\n";
  const auto add = [&](auto value) {
    content.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int i = 0; i < kVertices; ++i) {
    add(0.1 * i);
    add(std::uint8_t{200});
    add(0.5f * static_cast<float>(i));
    add(static_cast<std::int16_t>(i % 1000 - 500));
  }
  content.pop_back();
  const auto scan = parse_scan(content, ".ply");
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->mesh.vertices.size(), std::size_t{kVertices - 1});
  for (int i = 0; i < kVertices - 1; ++i)
    ASSERT_EQ(scan->mesh.vertices[static_cast<std::size_t>(i)],
              (std::array<double, 3>{0.1 * i, 0.5 * i, static_cast<double>(i % 1000 - 500)}));
  ASSERT_EQ(scan->notes.size(), 1u);
  EXPECT_NE(scan->notes.front().find("70001 of 70001"), std::string::npos) << scan->notes.front();
}

TEST(Scans, APlyCutShortIsUsedForWhatItHolds) {
  std::string content = three_points_ply("0 1 2");
  content.resize(content.size() - 5);
  EXPECT_FALSE(parse_bodies(content, ".ply"));
  const auto scan = parse_scan(content, ".ply");
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->mesh.triangles.size(), 1U);
  ASSERT_EQ(scan->notes.size(), 1U);
  EXPECT_NE(scan->notes[0].find("face 2 of 2"), std::string::npos);
}

TEST(Scans, APointWithoutAPlaceStaysAPointWithoutFacets) {
  const auto scan = parse_scan(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\nnan nan nan\n0 1 0\n3 0 1 2\n", ".ply");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->mesh.vertices.size(), 3U);
  EXPECT_TRUE(scan->mesh.triangles.empty());
}

}  // namespace
}  // namespace trueflank::io
