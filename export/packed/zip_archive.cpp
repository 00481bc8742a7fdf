// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/packed/zip_archive.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "trueflank/export/known_meshes.h"

namespace trueflank::io {
namespace {

// APPNOTE.TXT 6.3: signatures and sizes of the fixed parts.
constexpr std::uint32_t kLocalHeader = 0x04034b50, kDirectoryHeader = 0x02014b50,
                        kEndOfDirectory = 0x06054b50, kEnd64 = 0x06064b50,
                        kEnd64Locator = 0x07064b50;
constexpr std::size_t kLocalHeaderBytes = 30, kDirectoryHeaderBytes = 46, kEndBytes = 22,
                      kEnd64Bytes = 56, kLocatorBytes = 20;
constexpr std::uint32_t kSizes64 = 0x0001;  // extra field with what did not fit into 32 bits
constexpr std::uint16_t kStored = 0, kDeflated = 8;
constexpr std::uint16_t kVersionNeeded = 20, kUtf8Names = 0x0800, kEncrypted = 0x0001;
constexpr std::uint16_t kFirstDay = 0x0021;  // 1980-01-01, the first date the format knows
constexpr std::size_t kMostEntries = 10'000;  // a model part, its textures and thumbnails: a few
constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();

void put16(std::string& out, std::uint32_t value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>(value >> 8 & 0xff);
}
void put32(std::string& out, std::uint32_t value) {
  put16(out, value & 0xffff);
  put16(out, value >> 16);
}
std::uint32_t get16(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]) |
         static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + 1])) << 8;
}
std::uint32_t get32(std::string_view bytes, std::size_t at) {
  return get16(bytes, at) | get16(bytes, at + 2) << 16;
}

std::uint64_t get64(std::string_view bytes, std::size_t at) {
  return get32(bytes, at) | static_cast<std::uint64_t>(get32(bytes, at + 4)) << 32;
}

Error broken(const char* what) {
  return {.code = ErrorCode::kSyntax, .message = std::string("the zip archive ") + what};
}

std::size_t packed_bytes(const ZipEntry& entry) {
  return entry.content.bytes().size() + PackedText::kLastBlock.size();
}

/// The fields that local and directory header share, from "version needed" to the sizes of names.
void put_common_fields(std::string& out, const ZipEntry& entry) {
  put16(out, kVersionNeeded);
  put16(out, kUtf8Names);
  put16(out, kDeflated);
  put16(out, 0);  // time
  put16(out, kFirstDay);
  put32(out, entry.content.checksum());
  put32(out, static_cast<std::uint32_t>(packed_bytes(entry)));
  put32(out, static_cast<std::uint32_t>(entry.content.text_bytes()));
  put16(out, static_cast<std::uint32_t>(entry.name.size()));
  put16(out, 0);  // extra field
}

struct DirectoryEntry {
  std::string_view name;
  std::uint32_t flags = 0, method = 0, checksum = 0;
  std::size_t packed_bytes = 0, content_bytes = 0, local_header = 0;
};

/// Where the directory lies and how many entries it has.
struct DirectoryPlace {
  std::size_t begin = 0, end = 0, count = 0;
};

Result<DirectoryPlace> find_directory(std::string_view archive) {
  if (archive.size() < kEndBytes) return fail(broken("is cut off"));
  std::optional<std::size_t> end;  // searched backwards: a comment may follow it
  const std::size_t lowest = archive.size() - std::min(archive.size(), kEndBytes + 65535);
  for (std::size_t at = archive.size() - kEndBytes + 1; at-- > lowest && !end;)
    if (get32(archive, at) == kEndOfDirectory) end = at;
  if (!end) return fail(broken("has no directory: cut off, or no archive"));
  const DirectoryPlace place{get32(archive, *end + 16), *end, get16(archive, *end + 10)};
  // ZIP64: some programs write it for small files too
  if (*end < kLocatorBytes || get32(archive, *end - kLocatorBytes) != kEnd64Locator) return place;
  const std::uint64_t end64 = get64(archive, *end - kLocatorBytes + 8);
  if (end64 > *end || *end - end64 < kEnd64Bytes || get32(archive, end64) != kEnd64)
    return fail(broken("has a damaged directory"));
  return DirectoryPlace{get64(archive, end64 + 48), end64, get64(archive, end64 + 32)};
}

/// Takes from the ZIP64 extra field what the entry's 32 bits could not hold.
void widen(DirectoryEntry& entry, std::string_view extra) {
  while (extra.size() >= 4) {
    const std::size_t length = std::min<std::size_t>(get16(extra, 2), extra.size() - 4);
    if (get16(extra, 0) == kSizes64) {
      std::size_t at = 4;
      for (std::size_t* value : {&entry.content_bytes, &entry.packed_bytes, &entry.local_header})
        if (*value == kLargest && at + 8 <= 4 + length) {
          *value = get64(extra, at);
          at += 8;
        }
    }
    extra.remove_prefix(4 + length);
  }
}

Result<std::vector<DirectoryEntry>> directory(std::string_view archive) {
  const auto place = find_directory(archive);
  if (!place) return fail(place.error());
  std::size_t at = place->begin;
  const auto room = [&] { return at <= place->end ? place->end - at : 0; };
  std::vector<DirectoryEntry> entries;
  if (place->count > kMostEntries)
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "the archive holds more than " + std::to_string(kMostEntries) +
                                 " entries"});
  for (std::size_t i = 0; i < place->count; ++i) {
    if (room() < kDirectoryHeaderBytes || get32(archive, at) != kDirectoryHeader)
      return fail(broken("has a damaged directory"));
    const std::size_t name_bytes = get16(archive, at + 28), extra_bytes = get16(archive, at + 30);
    const std::size_t all_bytes =
        kDirectoryHeaderBytes + name_bytes + extra_bytes + get16(archive, at + 32);
    if (room() < all_bytes) return fail(broken("has a damaged directory"));
    entries.push_back({.name = archive.substr(at + kDirectoryHeaderBytes, name_bytes),
                       .flags = get16(archive, at + 8),
                       .method = get16(archive, at + 10),
                       .checksum = get32(archive, at + 16),
                       .packed_bytes = get32(archive, at + 20),
                       .content_bytes = get32(archive, at + 24),
                       .local_header = get32(archive, at + 42)});
    widen(entries.back(), archive.substr(at + kDirectoryHeaderBytes + name_bytes, extra_bytes));
    at += all_bytes;
  }
  return entries;
}

/// The entry's bytes as they stand in the archive.
Result<std::string_view> packed_content(std::string_view archive, const DirectoryEntry& entry) {
  if ((entry.flags & kEncrypted) || (entry.method != kStored && entry.method != kDeflated))
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "entry '" + std::string(entry.name) +
                                 "' of the archive is encrypted or packed in an unknown way"});
  const std::size_t header = entry.local_header;
  if (archive.size() < kLocalHeaderBytes || header > archive.size() - kLocalHeaderBytes ||
      get32(archive, header) != kLocalHeader)
    return fail(broken("is damaged"));
  const std::size_t begin =
      header + kLocalHeaderBytes + get16(archive, header + 26) + get16(archive, header + 28);
  if (begin > archive.size() || entry.packed_bytes > archive.size() - begin)
    return fail(broken("is cut off"));
  // Deflate cannot pack more than 1032 : 1; a larger claim is a trap for our memory.
  if (entry.content_bytes / 1040 > entry.packed_bytes) return fail(broken("is damaged"));
  return archive.substr(begin, entry.packed_bytes);
}

Result<std::string> unpacked(std::string_view archive, const DirectoryEntry& entry,
                             Reading& reading) {
  const auto packed = packed_content(archive, entry);
  if (!packed) return fail(packed.error());
  const std::string_view body = *packed;
  if (auto status = reading.take_unpacked_bytes(entry.content_bytes); !status)
    return fail(status.error());
  std::string content(entry.content_bytes, '\0');
  if (entry.method == kStored) {
    if (entry.packed_bytes != entry.content_bytes) return fail(broken("is damaged"));
    content = std::string(body);
  } else if (!inflate(body, content)) {
    return fail(broken("is damaged"));
  }
  if (checksum(content) != entry.checksum)
    return fail(broken("is damaged: a checksum is wrong"));
  return content;
}

/// Cuts a row of deflated blocks where known meshes stand and unpacks each piece by itself. A piece
/// that would need bytes of the one before it, or did not end on a whole byte, cannot be unpacked
/// so.
class PieceCutter {
 public:
  explicit PieceCutter(const DirectoryEntry& entry)
      : checksum_wanted_(entry.checksum), left_(entry.content_bytes) {}

  [[nodiscard]] bool cut(std::string_view body, const std::vector<KnownMesh*>& known) {
    if (!body.ends_with(PackedText::kLastBlock)) return false;
    body.remove_suffix(PackedText::kLastBlock.size());
    for (KnownMesh* mesh : known) {
      const std::size_t at = body.find(mesh->packed);
      if (at == body.npos || !add(body.substr(0, at), nullptr) || !add(mesh->packed, mesh))
        return false;
      body.remove_prefix(at + mesh->packed.size());
    }
    return add(body, nullptr) && left_ == 0 && checksum_ == checksum_wanted_;
  }
  [[nodiscard]] std::vector<ContentPiece> take() { return std::move(pieces_); }

 private:
  [[nodiscard]] bool add(std::string_view packed, KnownMesh* mesh) {
    ContentPiece piece{.text = {}, .mesh = mesh};
    std::size_t bytes = 0;
    std::uint32_t sum = 0;
    if (mesh != nullptr && mesh->read) {
      bytes = mesh->text_bytes, sum = mesh->checksum;
    } else {
      auto text = inflated_row(packed, left_);
      if (!text) return false;
      bytes = text->size(), sum = checksum(*text);
      piece.text = std::move(*text);
      if (mesh != nullptr) mesh->text_bytes = bytes, mesh->checksum = sum;
    }
    if (bytes > left_) return false;
    left_ -= bytes;
    checksum_ = joined_checksum(checksum_, sum, bytes);
    pieces_.push_back(std::move(piece));
    return true;
  }

  std::uint32_t checksum_wanted_, checksum_ = 0;
  std::size_t left_;  ///< bytes of the content that are not yet unpacked
  std::vector<ContentPiece> pieces_;
};

}  // namespace

Result<std::string> zip_archive(const std::vector<ZipEntry>& entries) {
  std::string archive, directory_bytes;
  std::size_t room = 1024;
  for (const ZipEntry& entry : entries) room += packed_bytes(entry) + 2 * entry.name.size() + 128;
  archive.reserve(room);
  for (const ZipEntry& entry : entries) {
    const std::size_t offset = archive.size();
    if (entry.content.text_bytes() >= kLargest || offset + packed_bytes(entry) + 65536 >= kLargest)
      return fail(Error{.code = ErrorCode::kUnsupported,
                        .message = "the file would be larger than the 4 GB a zip archive holds"});
    put32(archive, kLocalHeader);
    put_common_fields(archive, entry);
    archive += entry.name;
    archive += entry.content.bytes();
    archive += PackedText::kLastBlock;

    put32(directory_bytes, kDirectoryHeader);
    put16(directory_bytes, kVersionNeeded);  // made by: MS-DOS, no attributes to tell
    put_common_fields(directory_bytes, entry);
    put16(directory_bytes, 0);  // comment
    put16(directory_bytes, 0);  // disk
    put16(directory_bytes, 0);  // internal attributes
    put32(directory_bytes, 0);  // external attributes
    put32(directory_bytes, static_cast<std::uint32_t>(offset));
    directory_bytes += entry.name;
  }
  const std::size_t directory_offset = archive.size();
  archive += directory_bytes;
  put32(archive, kEndOfDirectory);
  put16(archive, 0);  // this disk
  put16(archive, 0);  // disk of the directory
  put16(archive, static_cast<std::uint32_t>(entries.size()));
  put16(archive, static_cast<std::uint32_t>(entries.size()));
  put32(archive, static_cast<std::uint32_t>(directory_bytes.size()));
  put32(archive, static_cast<std::uint32_t>(directory_offset));
  put16(archive, 0);  // comment
  return archive;
}

Result<std::vector<std::string>> zip_names(std::string_view archive) {
  const auto entries = directory(archive);
  if (!entries) return fail(entries.error());
  std::vector<std::string> names;
  for (const DirectoryEntry& entry : *entries) names.emplace_back(entry.name);
  return names;
}

Result<std::string> zip_content(std::string_view archive, std::string_view name, Reading& reading) {
  const auto entries = directory(archive);
  if (!entries) return fail(entries.error());
  for (const DirectoryEntry& entry : *entries)
    if (entry.name == name) return unpacked(archive, entry, reading);
  return fail(Error{.code = ErrorCode::kMissingKey,
                    .message = "the archive holds no '" + std::string(name) + "'"});
}

std::optional<std::vector<ContentPiece>> zip_pieces(std::string_view archive, std::string_view name,
                                                    Reading& reading) {
  const auto entries = directory(archive);
  if (!entries || reading.expected().empty()) return std::nullopt;
  for (const DirectoryEntry& entry : *entries) {
    if (entry.name != name) continue;
    const auto body = packed_content(archive, entry);
    PieceCutter cutter(entry);
    if (!body || entry.method != kDeflated || !cutter.cut(*body, reading.expected()))
      return std::nullopt;
    if (!reading.take_unpacked_bytes(entry.content_bytes)) return std::nullopt;
    return cutter.take();
  }
  return std::nullopt;
}

}  // namespace trueflank::io
