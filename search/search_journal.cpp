// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
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

constexpr std::string_view kEnd = "end", kStage = "stage ";

std::array<double*, 11> journaled(DesignFigures& f) {
  return {&f.mass_kg, &f.length_mm, &f.torque_density_nm_per_kg, &f.starting_torque_nm,
          &f.input_inertia_kg_m2, &f.output_inertia_kg_m2, &f.contact_ratio, &f.sliding,
          &f.backlash_arcmin, &f.acceleration_rad_s2, &f.settling_s};
}

std::string record_text(const SearchRecord& record) {
  std::string line = std::to_string(record.index);
  append(line, static_cast<long long>(record.result.failed_limit));
  append(line, static_cast<long long>(record.result.evaluations));
  append(line, static_cast<long long>(record.result.candidates.size()));
  for (SearchCandidate c : record.result.candidates) {
    for (const double value :
         {c.free.centre_distance, c.free.layer1_shift, c.free.layer2_shift, c.forward, c.backward,
          c.dimensions.face_width_mm, c.dimensions.module_mm, c.torque_nm, c.size_mm,
          c.least_margin, c.gap, c.score})
      append(line, value);
    for (const double* figure : journaled(c.figures)) append(line, *figure);
  }
  return line;
}

/// A line ends with the digest of what stands before it.
bool read_undamaged(std::string& line) {
  const std::size_t last = line.rfind(' ');
  if (last == std::string::npos ||
      line.substr(last + 1) != digest(std::string_view(line).substr(0, last)))
    return false;
  line.resize(last);
  return true;
}

bool read_end(const std::string& line, SearchPart& part) {
  if (!line.starts_with(kEnd)) return false;
  Words words(line.substr(kEnd.size()));
  return words.take(part.part) && words.take(part.parts) && words.ended() && part.part >= 1 &&
         part.part <= part.parts;
}

bool read_record(const std::string& line, std::size_t sets, SearchRecord& record) {
  Words words(line);
  std::size_t candidates = 0;
  if (!words.take(record.index) || record.index >= sets ||
      !words.take(record.result.failed_limit) || !words.take(record.result.evaluations) ||
      !words.take(candidates) || candidates > 1000)
    return false;
  for (std::size_t i = 0; i < candidates; ++i) {
    SearchCandidate c;
    if (!words.take(c.free.centre_distance) || !words.take(c.free.layer1_shift) ||
        !words.take(c.free.layer2_shift) || !words.take(c.forward) || !words.take(c.backward) ||
        !words.take(c.dimensions.face_width_mm) || !words.take(c.dimensions.module_mm) ||
        !words.take(c.torque_nm) || !words.take(c.size_mm) || !words.take(c.least_margin) ||
        !words.take(c.gap) || !words.take(c.score))
      return false;
    for (double* figure : journaled(c.figures))
      if (!words.take(*figure)) return false;
    record.result.candidates.push_back(c);
  }
  return words.ended();
}

}  // namespace

std::string journal_header(const SearchRequirements& requirements,
                           const SetEnumeration& enumeration) {
  std::string header = "trueflank-search-journal 5 " + digest(fingerprint(requirements)) + " " +
                       std::to_string(enumeration.sets.size());
  if (!enumeration.stages.empty())
    append(header, static_cast<long long>(enumeration.stages.size()));
  return header;
}

std::string journal_line(const SearchRecord& record) {
  const std::string line = record_text(record);
  return line + ' ' + digest(line);
}

std::string journal_stage_line(const SearchRecord& stage) {
  const std::string line = std::string(kStage) + record_text(stage);
  return line + ' ' + digest(line);
}
std::string journal_end(const SearchPart& part) {
  std::string line(kEnd);
  append(line, static_cast<long long>(part.part));
  append(line, static_cast<long long>(part.parts));
  return line + ' ' + digest(line);
}

bool SearchJournal::covers(std::size_t index) const {
  return std::any_of(ended.begin(), ended.end(),
                     [&](const SearchPart& part) { return part.holds(index); });
}

bool SearchJournal::covers_all(std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i)
    if (!covers(i)) return false;
  return true;
}

Result<SearchJournal> read_journal(const std::string& text, const SearchRequirements& requirements,
                                   const SetEnumeration& enumeration) {
  SearchJournal journal;
  std::size_t from = text.find('\n');
  if (from == std::string::npos ||
      text.substr(0, from) != journal_header(requirements, enumeration))
    return fail({.code = ErrorCode::kInconsistent,
                 .message = "the journal is not of a search for these requirements by this version",
                 .remedy = "the requirements it was begun with, or another output folder"});
  int line_number = 1;
  for (++from; from < text.size(); ++line_number) {
    const std::size_t end = text.find('\n', from);
    if (end == std::string::npos) break;  // cut short: that set is computed again
    std::string line = text.substr(from, end - from);
    SearchRecord record;
    SearchPart part;
    const bool whole = read_undamaged(line);
    if (whole && read_end(line, part))
      journal.ended.push_back(part);
    else if (whole && line.starts_with(kStage) &&
             read_record(line.substr(kStage.size()), enumeration.stages.size(), record))
      journal.stages.push_back(std::move(record));
    else if (whole && read_record(line, enumeration.sets.size(), record))
      journal.records.push_back(std::move(record));
    else
      return fail({.code = ErrorCode::kSyntax,
                   .message = "the journal is damaged",
                   .value = text.substr(from, std::min<std::size_t>(60, end - from)),
                   .remedy = "an undamaged copy, or a fresh start without it",
                   .line = line_number + 1});
    from = end + 1;
  }
  return journal;
}

}  // namespace trueflank
