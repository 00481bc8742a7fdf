// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/result.h"

// How far the content of one mesh file may expand, whatever its format and whoever reads it. Archives
// unpack, and components, nodes and repeated primitives copy what stands in the file once: 60 bytes can
// ask for terabytes. Every parser counts what it makes before it makes it.
namespace trueflank::io {

/// Facets, and as many vertices, that any file may hold: 1 GB of memory.
constexpr std::size_t kMostFacets = 50'000'000;

struct KnownMesh;  // known_meshes.h

class Reading {
 public:
  /// Of a damaged file: refuse it, or use what can be read of it and note the rest, as for measured data.
  enum class Damage { kRefuse, kNote };

  explicit Reading(std::size_t file_bytes, Damage damage = Damage::kRefuse);

  /// Packed meshes that may stand in the file, in the order they would have there.
  void expect(std::vector<KnownMesh*> known) { known_ = std::move(known); }
  [[nodiscard]] const std::vector<KnownMesh*>& expected() const { return known_; }

  [[nodiscard]] bool notes_damage() const { return damage_ == Damage::kNote; }
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }
  [[nodiscard]] std::vector<std::string> take_notes() { return std::move(notes_); }

  /// To be asked before so many more are made. Errors: kUnsupported beyond what the file may expand to.
  [[nodiscard]] Status take_facets(std::size_t facets, std::size_t vertices) {
    if (facets > facets_left_) return too_many("facets");
    if (vertices > vertices_left_) return too_many("vertices");
    facets_left_ -= facets;
    vertices_left_ -= vertices;
    return {};
  }
  [[nodiscard]] Status take_unpacked_bytes(std::size_t bytes);
  /// One more solid, object, node, component or primitive, that many levels deep.
  [[nodiscard]] Status take_piece(int depth = 0);

 private:
  [[nodiscard]] static Status too_many(const char* what);
  [[nodiscard]] static Status take(std::size_t& left, std::size_t wanted, const char* what);

  Damage damage_;
  std::size_t facets_left_, vertices_left_, bytes_left_, pieces_left_;
  std::vector<std::string> notes_;
  std::vector<KnownMesh*> known_;
};

}  // namespace trueflank::io
