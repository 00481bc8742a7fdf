// SPDX-License-Identifier: GPL-3.0-or-later
//
// lib3mf, the 3MF Consortium's own library, reads our 3MF without a warning, and we read its files.
#include <gtest/gtest.h>

#include <Model/COM/NMR_DLLInterfaces.h>

#include <memory>

#include "tests/export/sample_scene.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/threemf_writer.h"

namespace trueflank::io {
namespace {

using test::SampleScene;
using test::ScratchFolder;

/// Owns a COM object of lib3mf 1.8.
template <class T>
class Com {
 public:
  Com() = default;
  ~Com() {
    if (pointer_) NMR::lib3mf_release(pointer_);
  }
  Com(const Com&) = delete;
  Com& operator=(const Com&) = delete;
  T** operator&() { return &pointer_; }
  T* get() const { return pointer_; }

 private:
  T* pointer_ = nullptr;
};

struct ReadByLib3mf {
  Com<NMR::PLib3MFModel> model;
  int warnings = -1;
  bool read = false;
};

std::unique_ptr<ReadByLib3mf> read(const std::filesystem::path& path) {
  auto result = std::make_unique<ReadByLib3mf>();
  Com<NMR::PLib3MFModelReader> reader;
  EXPECT_EQ(NMR::lib3mf_createmodel(&result->model), 0);
  EXPECT_EQ(NMR::lib3mf_model_queryreader(result->model.get(), "3mf", &reader), 0);
  result->read = NMR::lib3mf_reader_readfromfileutf8(reader.get(), path.c_str()) == 0;
  DWORD count = 0;
  NMR::lib3mf_reader_getwarningcount(reader.get(), &count);
  result->warnings = static_cast<int>(count);
  return result;
}

/// Number of mesh objects; every one must be closed and oriented.
int closed_meshes(const ReadByLib3mf& file) {
  Com<NMR::PLib3MFModelResourceIterator> meshes;
  EXPECT_EQ(NMR::lib3mf_model_getmeshobjects(file.model.get(), &meshes), 0);
  int count = 0;
  BOOL more = 0;
  while (NMR::lib3mf_resourceiterator_movenext(meshes.get(), &more) == 0 && more) {
    Com<NMR::PLib3MFModelResource> mesh;
    NMR::lib3mf_resourceiterator_getcurrent(meshes.get(), &mesh);
    BOOL manifold = 0;
    NMR::lib3mf_meshobject_ismanifoldandoriented(
        mesh.get(), &manifold);
    EXPECT_TRUE(manifold);
    ++count;
  }
  return count;
}

TEST(ThreemfInLib3mf, APartIsReadWithoutAWarning) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_3mf(folder / "a.3mf", sample.part()));
  const auto file = read(folder / "a.3mf");
  EXPECT_TRUE(file->read);
  EXPECT_EQ(file->warnings, 0);
  EXPECT_EQ(closed_meshes(*file), 1);
}

TEST(ThreemfInLib3mf, AnAssemblySharesItsShapesWithoutAWarning) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_3mf(folder / "a.3mf", sample.assembly()));
  const auto file = read(folder / "a.3mf");
  EXPECT_TRUE(file->read);
  EXPECT_EQ(file->warnings, 0);
  EXPECT_EQ(closed_meshes(*file), 2);  // three bodies
}

TEST(ThreemfInLib3mf, AFileOfItsOwnIsReadHere) {
  const ScratchFolder folder;
  const SampleScene sample;
  ASSERT_TRUE(write_3mf(folder / "ours.3mf", sample.assembly()));
  const auto file = read(folder / "ours.3mf");
  Com<NMR::PLib3MFModelWriter> writer;
  ASSERT_EQ(NMR::lib3mf_model_querywriter(file->model.get(), "3mf", &writer), 0);
  ASSERT_EQ(NMR::lib3mf_writer_writetofileutf8(writer.get(), (folder / "theirs.3mf").c_str()), 0);
  const auto ours = read_bodies(folder / "ours.3mf"), theirs = read_bodies(folder / "theirs.3mf");
  ASSERT_TRUE(theirs) << theirs.error().message;
  ASSERT_EQ(theirs->size(), ours->size());
  for (std::size_t i = 0; i < ours->size(); ++i) {
    EXPECT_EQ(theirs->at(i).name, ours->at(i).name);
    EXPECT_LT(test::farthest_corner_mm(theirs->at(i).mesh, ours->at(i).mesh), 1e-5);
  }
}

}  // namespace
}  // namespace trueflank::io
