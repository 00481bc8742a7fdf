// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/known_meshes.h"

#include <gtest/gtest.h>

#include "tests/export/sample_scene.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/packed/deflate.h"
#include "trueflank/export/input_file.h"
#include "trueflank/export/threemf_writer.h"

namespace trueflank::io {
namespace {

/// A shape of its own in a file, and beside another one, placed twice, in a second file.
class KnownMeshes : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 2; ++i) packed_[i] = packed_3mf_mesh(meshes_[i]);
    known_ = {.packed = packed_[0].bytes()};
    other_ = {.packed = packed_[1].bytes()};
    const Scene part{.name = "part",
                     .shapes = {{"one", &meshes_[0], {}}},
                     .bodies = {{.part = 0, .name = "one"}}};
    const Scene whole{.name = "whole",
                      .shapes = {{"one", &meshes_[0], {}}, {"two", &meshes_[1], {}}},
                      .bodies = {{.part = 0, .name = "one"},
                                 {.part = 0, .name = "again", .translation_mm = {40.0, 0.0, 1.0}},
                                 {.part = 1, .name = "two", .translation_mm = {0.0, 50.0, 0.0}}}};
    ASSERT_TRUE(write_3mf(part_file_, part, {&packed_[0]}));
    ASSERT_TRUE(write_3mf(whole_file_, whole, {&packed_[0], &packed_[1]}));
  }
  [[nodiscard]] static Result<std::vector<Facet>> facets(const std::filesystem::path& path,
                                                         std::vector<KnownMesh*> known = {}) {
    std::vector<Facet> all;
    const auto keep = [&](const Facet& facet) { all.push_back(facet); };
    const Status status =
        known.empty() ? visit_facets(path, keep) : visit_facets(path, std::move(known), keep);
    if (!status) return fail(status.error());
    return all;
  }
  /// Changes one byte of the file of both shapes.
  void change(std::size_t at) {
    std::string content = *read_file(whole_file_);
    content[at] = static_cast<char>(content[at] ^ 0x10);
    ASSERT_TRUE(write_file(whole_file_, content));
  }

  test::ScratchFolder folder_;
  const std::filesystem::path part_file_ = folder_.path() / "part.3mf",
                              whole_file_ = folder_.path() / "whole.3mf";
  const std::array<TriangleMesh, 2> meshes_{test::star_prism(60, 20.0, 15.0, 5.0, 8.0),
                                            test::star_prism(40, 9.0, 8.0, 2.0, 3.0)};
  std::array<PackedText, 2> packed_;
  KnownMesh known_, other_;
};

TEST_F(KnownMeshes, FacetsAreThoseOfAReaderThatKnowsNothing) {
  const auto part = facets(part_file_), whole = facets(whole_file_);
  ASSERT_TRUE(part && whole);
  EXPECT_EQ(*facets(part_file_, {&known_}), *part);
  EXPECT_TRUE(known_.read);
  EXPECT_EQ(*facets(whole_file_, {&known_, &other_}), *whole);  // one kept, one read now
  EXPECT_TRUE(other_.read);
  EXPECT_EQ(*facets(whole_file_, {&known_, &other_}), *whole);
}

TEST_F(KnownMeshes, WhatIsKeptOfOneFileIsTakenInTheNext) {
  ASSERT_TRUE(facets(part_file_, {&known_}));
  known_.mesh.vertices[0][2] += 1.0;  // nobody unpacks it again
  EXPECT_NE(*facets(whole_file_, {&known_, &other_}), *facets(whole_file_));
}

TEST_F(KnownMeshes, OtherBytesInTheirPlaceAreReadAsTheyStand) {
  KnownMesh swapped{.packed = packed_[1].bytes()};
  EXPECT_EQ(*facets(part_file_, {&swapped}), *facets(part_file_));
  EXPECT_FALSE(swapped.read);
  EXPECT_EQ(*facets(whole_file_, {&other_, &known_}), *facets(whole_file_));  // not in that order
}

TEST_F(KnownMeshes, DamageIsAnErrorWhereverItIs) {
  ASSERT_TRUE(facets(whole_file_, {&known_, &other_}));
  const std::string content = *read_file(whole_file_);
  const std::size_t mesh = content.find(packed_[0].bytes()), directory = content.rfind("PK\1\2");
  for (const std::size_t at :
       {mesh - 3, mesh + 5, mesh + known_.packed.size() / 2, directory + 16}) {
    change(at);
    EXPECT_FALSE(facets(whole_file_)) << at;
    EXPECT_FALSE(facets(whole_file_, {&known_, &other_})) << at;
    change(at);
  }
  EXPECT_TRUE(facets(whole_file_, {&known_, &other_}));
}

TEST_F(KnownMeshes, RowsOfBlocksThatAreCutOrTooLongAreNotUnpacked) {
  const std::string_view row = known_.packed;
  const auto text = inflated_row(row, packed_[0].text_bytes());
  ASSERT_TRUE(text);
  EXPECT_EQ(text->size(), packed_[0].text_bytes());
  EXPECT_EQ(checksum(*text), packed_[0].checksum());
  EXPECT_FALSE(inflated_row(row, text->size() - 1));
  EXPECT_FALSE(inflated_row(row.substr(0, row.size() - 9), text->size()));
  EXPECT_FALSE(inflated_row(row.substr(row.size() / 2), text->size()));
  EXPECT_FALSE(
      inflated_row(std::string(row) + std::string(kLastDeflatedBlock) + "more", 2 * text->size()));
}

}  // namespace
}  // namespace trueflank::io
