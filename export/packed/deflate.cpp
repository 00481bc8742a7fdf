// SPDX-License-Identifier: GPL-3.0-or-later
//
// Greedy LZ77 with a table of the last two places of each four bytes, then one Huffman code a block.
// Integers only, nothing read that was not written: the bytes depend on the text alone.
#include "trueflank/export/packed/deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <numeric>
#include <vector>

namespace trueflank::io {
namespace {

constexpr std::size_t kBlockBytes = 128 * 1024;  // that share a code, at least
constexpr int kHashBits = 13;                    // 64 kB of places: they stay in the processor's cache
constexpr std::uint32_t kLeastMatch = 4, kMostMatch = 258, kWindow = 32768;
constexpr int kLongestCode = 15;
constexpr std::size_t kLiterals = 286, kDistances = 30, kLengthCodes = 19;
constexpr std::uint32_t kEndOfBlock = 256;
constexpr std::size_t kStoredMost = 65535;  // bytes of a block that is not packed

// RFC 1951, 3.2.7: the order in which the lengths of the codes for code lengths are written
constexpr std::array<std::uint8_t, kLengthCodes> kLengthOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                              11, 4,  12, 3, 13, 2, 14, 1, 15};

/// A match's length or distance as RFC 1951 writes it: a symbol and further bits.
struct Symbol {
  std::uint32_t code = 0, extra_bits = 0, extra = 0;
};

/// Values in steps of `kShare` symbols for each power of two.
template <std::uint32_t kShare>
constexpr Symbol symbol_of(std::uint32_t value) {
  constexpr std::uint32_t kShareBits = std::bit_width(kShare) - 1;
  if (value < 2 * kShare) return {value, 0, 0};
  const std::uint32_t bits = std::bit_width(value) - 1 - kShareBits;
  return {kShare * bits + (value >> bits), bits, value & ((1U << bits) - 1)};
}
constexpr Symbol length_symbol(std::uint32_t length) {
  if (length == kMostMatch) return {28, 0, 0};
  return symbol_of<4>(length - 3);
}
constexpr Symbol distance_symbol(std::uint32_t distance) { return symbol_of<2>(distance - 1); }

/// The code of every length that a match can have.
constexpr auto kLengthCodeOf = [] {
  std::array<std::uint8_t, kMostMatch + 1> codes{};
  for (std::uint32_t length = 3; length <= kMostMatch; ++length)
    codes[length] = static_cast<std::uint8_t>(length_symbol(length).code);
  return codes;
}();

/// A literal byte (distance 0) or a match.
struct Token {
  std::uint16_t value;  ///< byte, or length
  std::uint16_t distance;
};

std::uint32_t four_bytes(const unsigned char* p) {
  return p[0] | static_cast<std::uint32_t>(p[1]) << 8 | static_cast<std::uint32_t>(p[2]) << 16 |
         static_cast<std::uint32_t>(p[3]) << 24;
}
std::uint64_t eight_bytes(const unsigned char* p) {
  return four_bytes(p) | static_cast<std::uint64_t>(four_bytes(p + 4)) << 32;
}

std::uint32_t match_length(const unsigned char* a, const unsigned char* b, std::uint32_t most) {
  std::uint32_t n = 0;
  for (; n + 8 <= most; n += 8)
    if (const std::uint64_t differ = eight_bytes(a + n) ^ eight_bytes(b + n))
      return n + static_cast<std::uint32_t>(std::countr_zero(differ)) / 8;
  while (n < most && a[n] == b[n]) ++n;
  return n;
}

/// Lengths of a prefix code (0: symbol not used), none above `longest`.
template <std::size_t kCount>
std::array<std::uint8_t, kCount> code_lengths(const std::array<std::uint32_t, kCount>& counts, int longest) {
  std::array<std::uint8_t, kCount> lengths{};
  std::vector<std::uint32_t> used;
  for (std::uint32_t s = 0; s < kCount; ++s)
    if (counts[s] > 0) used.push_back(s);
  if (used.size() < 2) {  // a code of one symbol still takes one bit
    for (const std::uint32_t s : used) lengths[s] = 1;
    return lengths;
  }
  std::stable_sort(used.begin(), used.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return counts[a] < counts[b]; });
  // Huffman's tree by two queues: leaves in order, and inner nodes, which are born in order
  const std::size_t n = used.size();
  std::vector<std::uint64_t> weight(n);
  std::vector<std::size_t> parent(2 * n - 1, 0);
  std::size_t leaf = 0, inner = 0;
  for (std::size_t made = 0; made + 1 < n; ++made)
    for (int side = 0; side < 2; ++side) {
      const bool take_leaf = leaf < n && (inner >= made || counts[used[leaf]] <= weight[inner]);
      weight[made] += take_leaf ? counts[used[leaf]] : weight[inner];
      parent[take_leaf ? leaf++ : n + inner++] = n + made;
    }
  std::vector<int> depth(2 * n - 1, 0);
  std::vector<std::uint32_t> of_length(longest + 1, 0);
  for (std::size_t node = 2 * n - 2; node-- > 0;) {
    depth[node] = depth[parent[node]] + 1;
    if (node < n) ++of_length[std::min(depth[node], longest)];
  }
  // codes cut down to `longest` claim too much: lengthen the longest of the shorter ones
  std::uint64_t claimed = 0;
  for (int l = 1; l <= longest; ++l) claimed += static_cast<std::uint64_t>(of_length[l]) << (longest - l);
  for (; claimed > 1ULL << longest; --claimed) {
    int l = longest - 1;
    while (of_length[l] == 0) --l;
    --of_length[l], of_length[l + 1] += 2, --of_length[longest];
  }
  std::size_t next = 0;  // the rarest get the longest
  for (int l = longest; l > 0; --l)
    for (std::uint32_t i = 0; i < of_length[l]; ++i) lengths[used[next++]] = static_cast<std::uint8_t>(l);
  return lengths;
}

/// A prefix code ready to be written: lengths, and codes with their first bit lowest (RFC 1951, 3.2.2).
template <std::size_t kCount>
struct Code {
  std::array<std::uint8_t, kCount> lengths;
  std::array<std::uint16_t, kCount> codes{};

  Code(const std::array<std::uint32_t, kCount>& counts, int longest)
      : lengths(code_lengths(counts, longest)) {
    std::uint32_t code = 0;
    for (int l = 1; l <= longest; ++l, code <<= 1)
      for (std::size_t s = 0; s < kCount; ++s)
        if (lengths[s] == l) codes[s] = reversed(code++, l);
  }
  static std::uint16_t reversed(std::uint32_t code, int length) {
    std::uint32_t result = 0;
    for (int i = 0; i < length; ++i) result |= (code >> i & 1U) << (length - 1 - i);
    return static_cast<std::uint16_t>(result);
  }
};

/// Bits into bytes, lowest first. Room for all that will be put, and eight bytes, must be there.
class BitWriter {
 public:
  explicit BitWriter(char* at) : at_(at) {}
  void put(std::uint64_t bits, std::uint32_t count) {
    held_ |= bits << count_;
    count_ += count;
  }
  /// At most 7 bits stay; so 57 may be put before the next.
  void flush() {
    for (int i = 0; i < 8; ++i) at_[i] = static_cast<char>(held_ >> 8 * i);
    at_ += count_ / 8;
    held_ >>= count_ & ~7U;
    count_ &= 7;
  }
  char* end() const { return at_; }
  std::uint32_t open_bits() const { return count_; }

 private:
  char* at_;
  std::uint64_t held_ = 0;
  std::uint32_t count_ = 0;
};

/// Text as literals and matches, and how often each symbol occurs.
struct Parse {
  std::unique_ptr<Token[]> tokens;
  std::size_t count = 0;
  std::array<std::uint32_t, kLiterals> literals{};
  std::array<std::uint32_t, kDistances> distances{};

  explicit Parse(std::size_t most) : tokens(std::make_unique_for_overwrite<Token[]>(most)) {}
  void literal(unsigned char byte) {
    tokens[count++] = {byte, 0};
    ++literals[byte];
  }
  void match(std::uint32_t length, std::uint32_t distance) {
    tokens[count++] = {static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance)};
    ++literals[kEndOfBlock + 1 + kLengthCodeOf[length]];
    ++distances[distance_symbol(distance).code];
  }
};

/// The last two places of each hash of four bytes, the last one in the lower half.
class Places {
 public:
  explicit Places(const unsigned char* bytes) : bytes_(bytes), places_(1U << kHashBits, kNowhere) {}
  /// Those before a place, which is kept.
  std::uint64_t put(std::uint32_t at) {
    std::uint64_t& seen = places_[four_bytes(bytes_ + at) * 0x9E3779B1U >> (32 - kHashBits)];
    const std::uint64_t before = seen;
    seen = before << 32 | at;
    return before;
  }
  static constexpr std::uint32_t kNone = ~0U;

 private:
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
  const unsigned char* bytes_;
  std::vector<std::uint64_t> places_;
};

Parse parsed(std::string_view text) {
  Parse result(text.size());
  const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
  const auto size = static_cast<std::uint32_t>(text.size());
  Places places(bytes);
  std::uint32_t at = 0;
  while (at + kLeastMatch <= size) {
    std::uint32_t length = 0, distance = 0;
    const std::uint32_t most = std::min(kMostMatch, size - at), four = four_bytes(bytes + at);
    std::uint64_t seen = places.put(at);
    for (int i = 0; i < 2; ++i, seen >>= 32) {
      const auto place = static_cast<std::uint32_t>(seen);
      if (place == Places::kNone || at - place > kWindow) break;
      if (four_bytes(bytes + place) != four) continue;
      if (length > 0 && (length == most || bytes[place + length] != bytes[at + length])) continue;
      const std::uint32_t n = match_length(bytes + place, bytes + at, most);
      if (n > length) length = n, distance = at - place;
    }
    if (length == 0) {
      result.literal(bytes[at++]);
      continue;
    }
    result.match(length, distance);
    const std::uint32_t end = at + length, last = std::min(end, size - kLeastMatch + 1);
    for (++at; at < last; ++at) static_cast<void>(places.put(at));
    at = end;
  }
  while (at < size) result.literal(bytes[at++]);
  ++result.literals[kEndOfBlock];
  return result;
}

/// The lengths of both codes as one run-length coded list (RFC 1951, 3.2.7).
struct LengthList {
  struct Run {
    std::uint8_t symbol, extra_bits, extra;
  };
  std::vector<Run> runs;
  std::array<std::uint32_t, kLengthCodes> counts{};

  explicit LengthList(const std::vector<std::uint8_t>& lengths) {
    for (std::size_t i = 0; i < lengths.size();) {
      std::size_t n = 1;
      while (i + n < lengths.size() && lengths[i + n] == lengths[i] && n < 138) ++n;
      if (lengths[i] == 0 && n >= 11) {
        put(18, 7, n - 11);
      } else if (lengths[i] == 0 && n >= 3) {
        put(17, 3, n - 3);
      } else if (i > 0 && lengths[i] == lengths[i - 1] && n >= 3) {
        n = std::min<std::size_t>(n, 6);
        put(16, 2, n - 3);
      } else {
        n = 1;
        put(lengths[i], 0, 0);
      }
      i += n;
    }
  }
  void put(std::size_t symbol, int extra_bits, std::size_t extra) {
    runs.push_back({static_cast<std::uint8_t>(symbol), static_cast<std::uint8_t>(extra_bits),
                    static_cast<std::uint8_t>(extra)});
    ++counts[symbol];
  }
};

template <std::size_t kCount>
std::size_t used_symbols(const std::array<std::uint8_t, kCount>& lengths, std::size_t least) {
  std::size_t n = kCount;
  while (n > least && lengths[n - 1] == 0) --n;
  return n;
}

template <std::size_t kCount>
std::uint64_t bits_of(const std::array<std::uint32_t, kCount>& counts, const Code<kCount>& code) {
  return std::inner_product(counts.begin(), counts.end(), code.lengths.begin(), std::uint64_t{0});
}

void append_stored(std::string& bytes, std::string_view text) {
  for (; !text.empty(); text.remove_prefix(std::min(kStoredMost, text.size()))) {
    const std::size_t n = std::min(kStoredMost, text.size());
    for (const std::size_t byte : {std::size_t{0}, n, n >> 8, ~n, ~n >> 8}) bytes += static_cast<char>(byte);
    bytes += text.substr(0, n);
  }
}

/// Of all symbols that say a length or a distance.
std::uint64_t extra_bits_of(const Parse& parse) {
  std::uint64_t bits = 0;
  for (std::uint32_t code = 8; code < 28; ++code)  // the last one, of the longest match, has none
    bits += std::uint64_t{parse.literals[kEndOfBlock + 1 + code]} * (code / 4 - 1);
  for (std::uint32_t code = 4; code < kDistances; ++code)
    bits += std::uint64_t{parse.distances[code]} * (code / 2 - 1);
  return bits;
}

void put_tokens(BitWriter& out, const Parse& parse, const Code<kLiterals>& literals,
                const Code<kDistances>& distances) {
  struct Bits {
    std::uint32_t bits = 0, count = 0;
  };
  std::array<Bits, kMostMatch + 1> lengths;  // code and further bits of each length
  for (std::uint32_t length = 3; length <= kMostMatch; ++length) {
    const Symbol symbol = length_symbol(length);
    const std::uint32_t s = kEndOfBlock + 1 + symbol.code, bits = literals.lengths[s];
    lengths[length] = {literals.codes[s] | symbol.extra << bits, bits + symbol.extra_bits};
  }
  for (std::size_t i = 0; i < parse.count; ++i) {
    const Token token = parse.tokens[i];
    out.flush();
    if (token.distance == 0) {
      out.put(literals.codes[token.value], literals.lengths[token.value]);
      continue;
    }
    out.put(lengths[token.value].bits, lengths[token.value].count);
    const Symbol d = distance_symbol(token.distance);
    out.put(distances.codes[d.code] | std::uint64_t{d.extra} << distances.lengths[d.code],
            distances.lengths[d.code] + d.extra_bits);
  }
}

/// One block, from a whole byte to a whole byte.
void append_block(std::string& bytes, std::string_view text) {
  const Parse parse = parsed(text);
  const Code<kLiterals> literals(parse.literals, kLongestCode);
  const Code<kDistances> distances(parse.distances, kLongestCode);
  const std::size_t literal_codes = used_symbols(literals.lengths, 257);
  const std::size_t distance_codes = used_symbols(distances.lengths, 1);
  std::vector<std::uint8_t> lengths(literals.lengths.begin(), literals.lengths.begin() + literal_codes);
  lengths.insert(lengths.end(), distances.lengths.begin(), distances.lengths.begin() + distance_codes);
  const LengthList list(lengths);
  const Code<kLengthCodes> list_code(list.counts, 7);
  std::size_t written = kLengthCodes;
  while (list_code.lengths[kLengthOrder[written - 1]] == 0) --written;

  const std::uint64_t bits = 17 + 3 * written + bits_of(list.counts, list_code) + 7 * list.runs.size() +
                             bits_of(parse.literals, literals) + bits_of(parse.distances, distances) +
                             extra_bits_of(parse);
  if (bits / 8 + 6 >= text.size() + 5 * (text.size() / kStoredMost + 1)) {
    append_stored(bytes, text);
    return;
  }
  const std::size_t before = bytes.size();
  bytes.resize(before + bits / 8 + 24);
  BitWriter out(bytes.data() + before);
  out.put(0b100, 3);  // not the last; codes of its own
  out.put(literal_codes - 257, 5);
  out.put(distance_codes - 1, 5);
  out.put(written - 4, 4);
  for (std::size_t i = 0; i < written; ++i) {
    out.flush();
    out.put(list_code.lengths[kLengthOrder[i]], 3);
  }
  for (const auto& run : list.runs) {
    out.flush();
    out.put(list_code.codes[run.symbol], list_code.lengths[run.symbol]);
    out.put(run.extra, run.extra_bits);
  }
  put_tokens(out, parse, literals, distances);
  out.flush();
  out.put(literals.codes[kEndOfBlock], literals.lengths[kEndOfBlock]);
  // an empty stored block ends on a byte, and so do we
  out.put(0, 3);
  out.put(0, -(out.open_bits()) & 7U);
  out.flush();  // with the next 32 they may be 64, more than may be shifted
  out.put(0xFFFF0000U, 32);
  out.flush();
  bytes.resize(out.end() - bytes.data());
}

}  // namespace

void append_deflated(std::string& bytes, std::string_view text) {
  // none much smaller than the others: each begins with its codes
  for (std::size_t blocks = std::max<std::size_t>(1, text.size() / kBlockBytes); !text.empty(); --blocks) {
    const std::size_t n = (text.size() + blocks - 1) / blocks;
    append_block(bytes, text.substr(0, n));
    text.remove_prefix(n);
  }
}

bool inflate(std::string_view packed, std::string& content) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  return unpacker && libdeflate_deflate_decompress(unpacker.get(), packed.data(), packed.size(), content.data(),
                                                   content.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

std::optional<std::string> inflated_row(std::string_view packed, std::size_t most_bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  std::string whole(packed);
  whole += kLastDeflatedBlock;
  const auto content = std::make_unique_for_overwrite<char[]>(most_bytes);
  std::size_t taken = 0, made = 0;
  if (!unpacker ||
      libdeflate_deflate_decompress_ex(unpacker.get(), whole.data(), whole.size(), content.get(),
                                       most_bytes, &taken, &made) != LIBDEFLATE_SUCCESS)
    return std::nullopt;
  if (taken != whole.size()) return std::nullopt;  // it had a last block of its own
  return std::string(content.get(), made);
}

std::uint32_t checksum(std::string_view text, std::uint32_t before) {
  return libdeflate_crc32(before, text.data(), text.size());
}

// A text is a polynomial over two elements, its checksum the remainder by CRC-32's polynomial, the highest
// power in the lowest bit. The first text stands 8 n powers higher for the n bytes behind it. (That both
// checksums are begun and ended with ones cancels out.)
std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second, std::size_t second_bytes) {
  constexpr std::uint32_t kPolynomial = 0xEDB88320U, kOne = 0x80000000U;
  const auto product = [](std::uint32_t a, std::uint32_t b) {
    std::uint32_t sum = 0;
    for (std::uint32_t power = kOne; power != 0; power >>= 1) {
      if (a & power) sum ^= b;
      b = b & 1U ? b >> 1 ^ kPolynomial : b >> 1;  // times x
    }
    return sum;
  };
  std::uint32_t square = kOne >> 8;  // x^8, then its squares
  for (std::size_t n = second_bytes; n > 0; n >>= 1, square = product(square, square))
    if (n & 1U) first = product(first, square);
  return first ^ second;
}

}  // namespace trueflank::io
