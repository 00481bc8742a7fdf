// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/packed/packed_text.h"
#include "trueflank/export/reading.h"

// The container of 3MF files: PKZIP with deflated or stored entries; written below 4 GB, ZIP64 is read.
namespace trueflank::io {

struct ZipEntry {
  std::string name;
  PackedText content;
};

/// An archive of the entries in their order, all deflated and dated 1980-01-01: the same entries, the same
/// bytes.
/// Errors: kUnsupported at 4 GB.
[[nodiscard]] Result<std::string> zip_archive(const std::vector<ZipEntry>& entries);

/// Names in the archive's directory. Errors: kSyntax for what is no archive or is cut off.
[[nodiscard]] Result<std::vector<std::string>> zip_names(std::string_view archive);

/// One entry's content, its checksum verified. Errors: kSyntax, kMissingKey (no such entry),
/// kUnsupported (encrypted, another method; more bytes than the reading allows).
[[nodiscard]] Result<std::string> zip_content(std::string_view archive, std::string_view name,
                                              Reading& reading);

/// A piece of an entry's content: text, or a mesh that was read before and is not unpacked again.
struct ContentPiece {
  std::string text;
  KnownMesh* mesh = nullptr;  ///< that the piece is
};
/// One entry's content, cut where the meshes stand that the reading expects, its checksum verified.
/// Nothing where one of them does not stand there, and where zip_content() would find an error.
[[nodiscard]] std::optional<std::vector<ContentPiece>> zip_pieces(std::string_view archive,
                                                                  std::string_view name,
                                                                  Reading& reading);

}  // namespace trueflank::io
