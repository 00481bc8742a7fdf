// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/always_inline.h"
#include "trueflank/base/result.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/export/reading.h"

// One parser per format behind mesh_reader.h, and the few things they share.
namespace trueflank::io {

using Bodies = std::vector<MeshBody>;
[[nodiscard]] Result<Bodies> parse_binary_stl(std::string_view content, Reading& reading);
constexpr std::size_t kStlHeaderBytes = 84, kStlRecordBytes = 50;
/// The facet that a record of a binary STL begins with.
[[nodiscard]] Facet stl_facet(const char* record);
[[nodiscard]] Result<Bodies> parse_text_stl(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_obj(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_ply(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_3mf(std::string_view content, Reading& reading);
[[nodiscard]] Result<Bodies> parse_glb(std::string_view content, Reading& reading);

[[nodiscard]] tl::unexpected<Error> syntax_error(std::string message, int line = 0);

/// Powers of ten that are exact doubles.
inline constexpr std::array<double, 16> kPowersOfTen = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
/// Decimal numbers as programs write them: both the digits and the power of ten are exact doubles, so
/// that their quotient is rounded as the standard library rounds it, several times as fast. Moves `from`
/// behind the number. Leaves everything else alone (false): exponents, more than 15 digits.
[[nodiscard]] TRUEFLANK_ALWAYS_INLINE inline bool take_short_decimal(const char*& from, const char* end, double& value) {
  const auto digit = [](char c) { return static_cast<unsigned>(c - '0'); };
  const char* at = from;
  const bool minus = at != end && *at == '-';
  if (minus) ++at;
  std::uint64_t digits = 0;
  const char* const first = at;
  for (; at != end && digit(*at) <= 9; ++at) digits = 10 * digits + digit(*at);
  auto count = at - first;
  std::ptrdiff_t decimals = 0;
  if (count > 0 && at != end && *at == '.') {
    const char* const point = ++at;
    for (; at != end && digit(*at) <= 9; ++at) digits = 10 * digits + digit(*at);
    decimals = at - point;
    count += decimals;
  }
  if (count == 0 || count > 15 || (at != end && (*at == 'e' || *at == 'E'))) return false;
  const double magnitude =
      static_cast<double>(static_cast<std::int64_t>(digits)) / kPowersOfTen[static_cast<std::size_t>(decimals)];
  value = minus ? -magnitude : magnitude;
  from = at;
  return true;
}

/// A number at the front of `text`, cut off with the blanks before it. Errors: false.
[[nodiscard]] bool take_number(std::string_view& text, double& value);
/// The next word at the front of `text`, cut off with the blanks before it; empty at the end.
[[nodiscard]] std::string_view take_word(std::string_view& text);
/// The next line without its end, cut off.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// Gathers triangles whose corners are given by coordinates: equal coordinates become one vertex.
class Welder {
 public:
  explicit Welder(std::size_t expected_triangles);
  [[nodiscard]] std::uint32_t vertex(const std::array<double, 3>& point);
  void add_triangle(const Facet& corners);
  [[nodiscard]] TriangleMesh take();

 private:
  void grow();
  TriangleMesh mesh_;
  std::vector<std::uint32_t> table_;  // open addressing; vertex index + 1, 0: free
};

/// Stands for a vertex number that cannot be, where damage is noted.
constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};

/// Checks indices and coordinates. Errors: kSyntax.
[[nodiscard]] Status check_mesh(const TriangleMesh& mesh);

}  // namespace trueflank::io
