// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/reading.h"

#include <algorithm>

namespace trueflank::io {
namespace {

// An ordinary 3MF needs 5 bytes a facet, packed; a print plate repeats a part some dozen times.
constexpr std::size_t kFacetsPerByte = 20, kFacetsOfAnyFile = 4'000'000;
// XML of meshes packs 5 : 1 to 20 : 1; deflate reaches 1032 : 1 on blanks alone.
constexpr std::size_t kUnpackedPerByte = 100, kUnpackedOfAnyFile = 64U << 20;
constexpr std::size_t kMostUnpacked = 0xfffffffe;  // sizes in an archive have 32 bits
constexpr std::size_t kMostPieces = 100'000;
constexpr int kDeepest = 32;

/// factor * bytes, but between the two.
std::size_t allowance(std::size_t bytes, std::size_t factor, std::size_t least, std::size_t most) {
  return bytes >= most / factor ? most : std::max(least, factor * bytes);
}

}  // namespace

Reading::Reading(std::size_t file_bytes, Damage damage)
    : damage_(damage),
      facets_left_(allowance(file_bytes, kFacetsPerByte, kFacetsOfAnyFile, kMostFacets)),
      vertices_left_(facets_left_),
      bytes_left_(allowance(file_bytes, kUnpackedPerByte, kUnpackedOfAnyFile, kMostUnpacked)),
      pieces_left_(kMostPieces) {}

Status Reading::too_many(const char* what) {
  return fail(Error{.code = ErrorCode::kUnsupported,
                    .message = std::string("the file expands to too many ") + what + " for its size",
                    .remedy = "a file that holds its parts once, with at most " +
                              std::to_string(kMostFacets / 1'000'000) + " million facets"});
}

Status Reading::take(std::size_t& left, std::size_t wanted, const char* what) {
  if (wanted > left) return too_many(what);
  left -= wanted;
  return {};
}

Status Reading::take_unpacked_bytes(std::size_t bytes) {
  return take(bytes_left_, bytes, "bytes");
}

Status Reading::take_piece(int depth) {
  if (depth > kDeepest)
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "the file nests its parts more than " + std::to_string(kDeepest) +
                                 " levels deep"});
  return take(pieces_left_, 1, "parts");
}

}  // namespace trueflank::io
