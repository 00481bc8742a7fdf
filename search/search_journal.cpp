// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <vector>

#include "trueflank/search/search.h"

namespace trueflank {
namespace {

void append(std::string& line, double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  line += ' ';
  line.append(buffer, end);
}
void append(std::string& line, long long value) { line += ' ' + std::to_string(value); }

/// Words of a line, taken one after the other.
class Words {
 public:
  explicit Words(const std::string& line) : stream_(line) {}
  template <class T>
  bool take(T& value) {
    std::string word;
    if (!(stream_ >> word)) return false;
    const auto end = word.data() + word.size();
    const auto [ptr, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && ptr == end;
  }
  [[nodiscard]] bool ended() {
    std::string rest;
    return !(stream_ >> rest);
  }

 private:
  std::istringstream stream_;
};

/// FNV-1a, 64 bit: finds slips and damage, no more.
std::string digest(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  char buffer[17];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, hash, 16).ptr;
  return {buffer, end};
}

/// A line ends with the digest of what stands before it.
bool read_record(const std::string& line, std::size_t sets, SearchRecord& record) {
  const std::size_t last = line.rfind(' ');
  if (last == std::string::npos ||
      line.substr(last + 1) != digest(std::string_view(line).substr(0, last)))
    return false;
  Words words(line.substr(0, last));
  std::size_t candidates = 0;
  if (!words.take(record.index) || record.index >= sets || !words.take(record.result.failed_limit) ||
      !words.take(record.result.evaluations) || !words.take(candidates) || candidates > 1000)
    return false;
  for (std::size_t i = 0; i < candidates; ++i) {
    SearchCandidate c;
    if (!words.take(c.free.centre_distance) || !words.take(c.free.ring1_shift) ||
        !words.take(c.free.ring2_shift) || !words.take(c.forward) || !words.take(c.backward) ||
        !words.take(c.torque_nm) || !words.take(c.size_mm) || !words.take(c.least_margin))
      return false;
    record.result.candidates.push_back(c);
  }
  return words.ended();
}

}  // namespace

std::string journal_header(const SearchRequirements& requirements,
                           const SetEnumeration& enumeration) {
  return "trueflank-search-journal 2 " + digest(fingerprint(requirements)) + " " +
         std::to_string(enumeration.sets.size());
}

std::string journal_line(const SearchRecord& record) {
  std::string line = std::to_string(record.index);
  append(line, static_cast<long long>(record.result.failed_limit));
  append(line, static_cast<long long>(record.result.evaluations));
  append(line, static_cast<long long>(record.result.candidates.size()));
  for (const SearchCandidate& c : record.result.candidates)
    for (const double value : {c.free.centre_distance, c.free.ring1_shift, c.free.ring2_shift,
                               c.forward, c.backward, c.torque_nm, c.size_mm, c.least_margin})
      append(line, value);
  return line + ' ' + digest(line);
}

Result<std::vector<SearchRecord>> read_journal(const std::string& text,
                                               const SearchRequirements& requirements,
                                               const SetEnumeration& enumeration) {
  std::vector<SearchRecord> records;
  std::size_t from = text.find('\n');
  if (from == std::string::npos || text.substr(0, from) != journal_header(requirements, enumeration))
    return fail({.code = ErrorCode::kInconsistent,
                 .message = "the journal is not of a search for these requirements by this version",
                 .remedy = "the requirements it was begun with, or another output folder"});
  int line_number = 1;
  for (++from; from < text.size(); ++line_number) {
    const std::size_t end = text.find('\n', from);
    if (end == std::string::npos) break;  // cut short: that set is computed again
    SearchRecord record;
    if (!read_record(text.substr(from, end - from), enumeration.sets.size(), record))
      return fail({.code = ErrorCode::kSyntax,
                   .message = "the journal is damaged",
                   .value = text.substr(from, std::min<std::size_t>(60, end - from)),
                   .remedy = "an undamaged copy, or a fresh start without it",
                   .line = line_number + 1});
    records.push_back(std::move(record));
    from = end + 1;
  }
  return records;
}

}  // namespace trueflank
