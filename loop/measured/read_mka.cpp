// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/loop/measured/read_measurement.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

constexpr double kUndefined = -2147483.0;  // the machine's mark for a missing point, rounded down

constexpr int kMostMkaTeeth = 1'000'000;
constexpr std::size_t kMostMkaValues = 5'000'000;  // machines write some thousand a tooth

/// A numbered header line: label before the first colon after the code, numbers behind it.
struct Header {
  double profile_start = kNaN, profile_end = kNaN;  // diameters da, de
  double helix_start = kNaN, helix_end = kNaN;      // ba, be
  int teeth = 0;
};

/// First number behind the label of a header line.
double first_value(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t colon = line.rfind(':'); colon != std::string_view::npos;) {
    split_blanks(line.substr(colon + 1), fields);
    return fields.empty() ? kNaN : number_in(fields[0]);
  }
  return kNaN;
}

bool mentions(std::string_view line, std::string_view mark) {
  // "....da  [mm]..:" - the mark stands alone between dots, blanks and brackets.
  const auto separates = [](char c) { return c == '.' || c == ' ' || c == '[' || c == ':'; };
  for (std::size_t at = line.find(mark); at != std::string_view::npos; at = line.find(mark, at + 1)) {
    const std::size_t after = at + mark.size();
    if (at > 0 && separates(line[at - 1]) && after < line.size() && separates(line[after])) return true;
  }
  return false;
}

void read_header_line(std::string_view line, Header& header) {
  const std::string low = lowered(line);
  if (low.find("hnezahl") != std::string::npos || low.find("number of teeth") != std::string::npos) {
    const double teeth = first_value(line);
    if (teeth >= 3.0 && teeth <= 10000.0) header.teeth = static_cast<int>(std::abs(teeth));
  }
  const bool range = low.find("messbereich") != std::string::npos ||
                     low.find("meas") != std::string::npos;
  if (!range) return;
  if (mentions(line, "da")) header.profile_start = first_value(line);
  if (mentions(line, "de")) header.profile_end = first_value(line);
  if (mentions(line, "ba")) header.helix_start = first_value(line);
  if (mentions(line, "be")) header.helix_end = first_value(line);
}

struct Block {
  RecordKind record = RecordKind::kProfile;
  int tooth = 0, line = 0;
  Flank flank = Flank::kLeft;
  double across = kNaN;  // z of a profile, diameter of a helix trace
  std::vector<double> values;
};

/// "Profil:  Zahn-Nr.: 12a rechts / 480 Werte  / z= 17.5"
bool read_block_head(std::string_view line, Block& block) {
  const std::string low = lowered(line);
  const bool profile = low.starts_with("profil");
  if (!profile && !low.starts_with("flankenlinie") && !low.starts_with("lead")) return false;
  const std::size_t number = low.find_first_of("0123456789");
  if (number == std::string::npos) return false;
  block = {};
  block.record = profile ? RecordKind::kProfile : RecordKind::kHelix;
  // a number too large for a tooth makes its rows useless, not the file: add_rows() says so
  const auto parsed = std::from_chars(low.data() + number, low.data() + low.size(), block.tooth);
  if (parsed.ec != std::errc() || block.tooth > kMostMkaTeeth) block.tooth = 0;
  block.flank = low.find("rechts") != std::string::npos || low.find("right") != std::string::npos
                    ? Flank::kRight
                    : Flank::kLeft;
  const std::size_t equals = low.rfind('=');
  if (equals != std::string::npos) block.across = number_in(trimmed(std::string_view(low).substr(equals + 1)));
  return true;
}

/// Values equidistant over the measured range: profiles over roll length, which for lack of the base
/// circle here is taken by the reader of the rows; the diameter is interpolated in its square.
void add_rows(const Block& block, const Header& header, InspectionData& data, BadLines& bad) {
  const bool profile = block.record == RecordKind::kProfile;
  const double from = profile ? header.profile_start : header.helix_start;
  const double to = profile ? header.profile_end : header.helix_end;
  if (std::isnan(from + to) || block.values.size() < 2) {
    bad.add(block.line, std::isnan(from + to) ? "the header names no measured range (da de, ba be)"
                                              : "a trace without values");
    return;
  }
  if (block.tooth < 1) {
    bad.add(block.line, "a trace without a tooth number that can be");
    return;
  }
  const double last = static_cast<double>(block.values.size() - 1);
  for (std::size_t i = 0; i < block.values.size(); ++i) {
    if (block.values[i] < kUndefined || std::isnan(block.values[i])) continue;
    const double f = static_cast<double>(i) / last;
    InspectionRow row;
    row.record = block.record;
    row.tooth = block.tooth;
    row.flank = block.flank;
    row.line = block.line;
    row.deviation_um = block.values[i];
    if (profile) {
      row.diameter_mm = from;
      row.diameter_to_mm = to;
      row.fraction = f;
      row.z_mm = block.across;
    } else {
      row.z_mm = from + f * (to - from);
      row.diameter_mm = block.across;
    }
    data.rows.push_back(row);
  }
}

/// "linke Zahnflanke" or "rechte Zahnflanke" over a table of tooth, fp, Fp, Fr.
bool is_pitch_table_head(const std::string& low) {
  return low.find("linke zahnflanke") != std::string::npos ||
         low.find("rechte zahnflanke") != std::string::npos;
}

/// Cumulative pitch Fp of a tooth. The machine counts teeth, and pitch deviations, clockwise: the records of
/// a real gear agree with each other only so (docs/loop.md).
bool add_pitch_row(const std::vector<std::string_view>& fields, Flank flank, int line,
                   InspectionData& data) {
  if (fields.size() < 3) return false;
  const double tooth = number_in(fields[0]), total = number_in(fields[2]);
  if (!(tooth >= 1.0) || tooth != std::floor(tooth) || tooth > kMostMkaTeeth || std::isnan(total)) return false;
  if (total < kUndefined) return true;
  InspectionRow row;
  row.record = RecordKind::kIndex;
  row.tooth = static_cast<int>(tooth);
  row.flank = flank;
  row.deviation_um = -total;
  row.along_circle = true;
  row.line = line;
  data.rows.push_back(row);
  return true;
}

/// Clockwise numbers to counter-clockwise ones; tooth 1 stays.
void count_the_other_way(int teeth, InspectionData& data) {
  for (InspectionRow& row : data.rows)
    if (row.tooth >= 1 && row.tooth <= teeth) row.tooth = (teeth + 1 - row.tooth) % teeth + 1;
}

}  // namespace

Result<InspectionData> read_mka(const std::string& file, std::string_view text,
                                std::vector<std::string>& notes) {
  InspectionData data;
  data.file = file;
  BadLines bad(file);
  Header header;
  Block block;
  std::vector<Block> blocks;
  std::set<std::string> unknown;
  std::vector<std::string_view> fields;
  std::size_t value_count = 0;
  bool in_block = false;
  bool in_pitch = false;
  Flank pitch = Flank::kLeft;  ///< of the pitch table the lines are in
  int line_number = 0;
  while (!text.empty()) {
    const std::string_view line = trimmed(next_line(text));
    ++line_number;
    if (line.empty()) continue;
    if (read_block_head(line, block)) {
      block.line = line_number;
      blocks.push_back(block);
      in_block = true;
      continue;
    }
    split_blanks(line, fields);
    const bool numbers = std::all_of(fields.begin(), fields.end(),
                                     [](auto field) { return !std::isnan(number_in(field)); });
    if (in_block && numbers) {
      value_count += fields.size();
      if (value_count > kMostMkaValues)
        return fail({.code = ErrorCode::kUnsupported,
                     .message = "the MKA file holds more than " + std::to_string(kMostMkaValues) + " values",
                     .file = file,
                     .line = line_number});
      for (const auto field : fields) blocks.back().values.push_back(number_in(field));
      continue;
    }
    in_block = false;
    if (in_pitch && numbers && add_pitch_row(fields, pitch, line_number, data)) continue;
    read_header_line(line, header);
    const std::string low = lowered(line);
    if (is_pitch_table_head(low)) {
      in_pitch = true;
      pitch = low.find("linke") != std::string::npos ? Flank::kLeft : Flank::kRight;
    } else if (low.find("fp") == std::string::npos) {
      in_pitch = false;
    }
    if (low.starts_with("teilung")) unknown.insert("probed positions of the pitch measurement");
    if (low.starts_with("topografie") || low.starts_with("verschr"))
      unknown.insert("topography and twist blocks");
  }
  for (const Block& read : blocks) add_rows(read, header, data, bad);
  if (header.teeth > 0) count_the_other_way(header.teeth, data);
  else if (!data.rows.empty())
    notes.push_back(file + ": the header names no number of teeth; teeth are taken as counted "
                           "counter-clockwise");
  if (data.rows.empty())
    return fail(bad.error("the MKA file holds no profile or helix trace that could be read"));
  bad.tell(notes);
  for (const std::string& what : unknown) notes.push_back(file + ": not used: " + what);
  return data;
}

}  // namespace trueflank::loop
