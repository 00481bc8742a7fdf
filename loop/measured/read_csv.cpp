// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/large_pages.h"
#include "trueflank/base/threads.h"
#include "trueflank/loop/measured/csv_rows.h"
#include "trueflank/loop/measured/read_measurement.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

/// Sigma of a row: NaN where the column or the field is empty. Negative, zero or no number: bad.
bool read_sigma(const CsvRows& rows, int column, double& sigma_um) {
  sigma_um = kNaN;
  if (column < 0 || rows.field(column).empty()) return true;
  sigma_um = rows.number(column);
  return sigma_um > 0.0;
}

std::optional<RecordKind> record_of(std::string_view field) {
  const std::string text = lowered(field);
  if (text == "profile") return RecordKind::kProfile;
  if (text == "helix") return RecordKind::kHelix;
  if (text == "index") return RecordKind::kIndex;
  if (text == "radial") return RecordKind::kRadial;
  return std::nullopt;
}

std::string inspection_row(const CsvRows& rows, const std::array<int, 7>& columns,
                           InspectionRow& row) {
  const auto record = record_of(rows.field(columns[0]));
  if (!record)
    return "record " + in_quotes(rows.field(columns[0])) +
           " is none of profile, helix, index, radial";
  row.record = *record;
  const double tooth = rows.number(columns[1]);
  if (!(tooth >= 1.0) || tooth != std::floor(tooth) || tooth > 1e6)
    return "tooth " + in_quotes(rows.field(columns[1])) + " is no tooth number";
  row.tooth = static_cast<int>(tooth);
  const std::string flank = lowered(rows.field(columns[2]));
  if (flank == "left" || flank == "l")
    row.flank = Flank::kLeft;
  else if (flank == "right" || flank == "r")
    row.flank = Flank::kRight;
  else if (*record != RecordKind::kRadial)
    return "flank " + in_quotes(rows.field(columns[2])) + " is neither left nor right";
  row.diameter_mm = rows.number(columns[3]);
  row.z_mm = rows.number(columns[4]);
  row.deviation_um = rows.number(columns[5]);
  if (std::isnan(row.deviation_um))
    return "deviation_um " + in_quotes(rows.field(columns[5])) + " is no number";
  if (*record == RecordKind::kProfile && !(row.diameter_mm > 0.0))
    return "a profile row needs diameter_mm, not " + in_quotes(rows.field(columns[3]));
  if (*record == RecordKind::kHelix && std::isnan(row.z_mm))
    return "a helix row needs z_mm, not " + in_quotes(rows.field(columns[4]));
  if (!read_sigma(rows, columns[6], row.sigma_um))
    return "sigma_um " + in_quotes(rows.field(columns[6])) + " is no positive number";
  return {};
}

}  // namespace

Result<ScanData> read_scan_csv(const std::string& file, std::string_view text,
                               std::vector<std::string>& notes) {
  CsvRows rows(file, text);
  if (auto error = rows.missing({"x_mm", "y_mm", "z_mm"})) return fail(*error);
  const int x = rows.column("x_mm"), y = rows.column("y_mm"), z = rows.column("z_mm");
  const int sigma_column = rows.column("sigma_um");
  ScanData scan;
  scan.file = file;
  while (rows.next()) {
    const std::array<double, 3> point{rows.number(x), rows.number(y), rows.number(z)};
    double sigma = kNaN;
    if (!is_measured_point(point)) {
      rows.bad.add(rows.line(), "x, y, z are not three numbers, of a kilometre at most");
    } else if (!read_sigma(rows, sigma_column, sigma)) {
      rows.bad.add(rows.line(), "sigma_um is no positive number");
    } else {
      scan.points_mm.push_back(point);
      if (sigma_column >= 0) scan.sigma_um.push_back(sigma);
    }
  }
  if (scan.points_mm.empty()) return fail(rows.bad.error("the scan has no usable point"));
  rows.bad.tell(notes);
  return scan;
}

namespace {

/// Some lines of a file of points.
struct PointLines {
  std::vector<std::array<double, 3>> points_mm;
  std::vector<int> bad;  ///< lines, from 1 on
  int lines = 0;
};

/// A plain number at the beginning of a text, which is taken off: an optional minus, digits, and
/// digits behind a point, so few that the whole number they make and the power of ten below it are
/// exact. Then one division rounds as std::from_chars does. False where something else stands
/// there.
bool take_plain_number(const char*& at, const char* end, double& value) {
  constexpr std::array<double, 16> kPowers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                           1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  constexpr int kMostDigits = 15;  // below 2^53
  const char* next = at;
  const bool negative = next != end && *next == '-';
  if (negative) ++next;
  std::int64_t whole = 0;
  int digits = 0;
  const auto take_digits = [&] {
    const int before = digits;
    for (; next != end && *next >= '0' && *next <= '9' && digits <= kMostDigits; ++next, ++digits)
      whole = 10 * whole + (*next - '0');
    return digits - before;
  };
  if (take_digits() == 0) return false;
  int behind = 0;
  if (next != end && *next == '.') {
    ++next;
    behind = take_digits();
    if (behind == 0) return false;
  }
  if (digits > kMostDigits) return false;
  const double size = static_cast<double>(whole) / kPowers[static_cast<std::size_t>(behind)];
  value = negative ? -size : size;
  at = next;
  return true;
}

/// A line of three plain numbers with blanks between them and nothing else; most are. False where
/// it is not.
bool read_plain_point(std::string_view line, std::array<double, 3>& point) {
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto is_blank = [&] { return at != end && (*at == ' ' || *at == '\t'); };
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0 && !is_blank()) return false;
    while (is_blank()) ++at;
    if (!take_plain_number(at, end, point[k])) return false;
  }
  while (is_blank()) ++at;
  return at == end;
}

/// `begins`: these are the first of the file, where a count of points or a header may stand.
PointLines read_point_lines(std::string_view text, bool begins) {
  PointLines read;
  read.points_mm.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
  std::vector<std::string_view> fields;
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    ++read.lines;
    if (std::array<double, 3> plain{}; read_plain_point(line, plain) && is_measured_point(plain)) {
      read.points_mm.push_back(plain);
      continue;
    }
    const std::string_view row = trimmed(line);
    if (row.empty() || row.front() == '#' || row.starts_with("//")) continue;
    split_blanks(row, fields);
    const bool none = begins && read.points_mm.empty();
    // A lone first number is the count of points some programs write.
    if (fields.size() == 1 && none && !std::isnan(number_in(fields[0]))) continue;
    std::array<double, 3> point{kNaN, kNaN, kNaN};
    for (std::size_t i = 0; i < 3 && i < fields.size(); ++i) point[i] = number_in(fields[i]);
    if (is_measured_point(point))
      read.points_mm.push_back(point);
    else if (none && read.lines == 1)
      continue;  // a header
    else
      read.bad.push_back(read.lines);
  }
  return read;
}

/// Takes some bytes, and the rest of their last line, off the text.
std::string_view next_lines(std::string_view& text, std::size_t bytes) {
  const std::size_t end = text.find('\n', std::min(bytes, text.size()));
  const std::string_view lines = text.substr(0, end == std::string_view::npos ? end : end + 1);
  text.remove_prefix(lines.size());
  return lines;
}

}  // namespace

Result<ScanData> read_xyz(const std::string& file, std::string_view text,
                          std::vector<std::string>& notes) {
  constexpr std::size_t kBytesOfWork = std::size_t{1} << 20U;
  std::vector<std::string_view> texts;
  for (std::string_view rest = text; !rest.empty();)
    texts.push_back(next_lines(rest, kBytesOfWork));
  std::vector<PointLines> pieces(texts.size());
  for_each_piece(texts.size(),
                 [&](std::size_t k) { pieces[k] = read_point_lines(texts[k], k == 0); });
  // without a point in the first megabyte the file's beginning may be longer than that
  if (!pieces.empty() && pieces.front().points_mm.empty()) pieces = {read_point_lines(text, true)};
  ScanData scan;
  scan.file = file;
  BadLines bad(file);
  std::size_t points = 0;
  for (const PointLines& piece : pieces) points += piece.points_mm.size();
  scan.points_mm.reserve(points);
  ask_for_large_pages(scan.points_mm.data(), points * sizeof scan.points_mm.front());
  constexpr std::size_t kPointsOfPages = std::size_t{1} << 17U;
  for_each_run(points, kPointsOfPages, [&](std::size_t from, std::size_t to) {
    make_pages_ready(scan.points_mm.data() + from, (to - from) * sizeof scan.points_mm.front());
  });
  int line = 0;
  for (PointLines& piece : pieces) {
    scan.points_mm.insert(scan.points_mm.end(), piece.points_mm.begin(), piece.points_mm.end());
    for (const int at : piece.bad)
      bad.add(line + at, "x, y, z are not three numbers, of a kilometre at most");
    line += piece.lines;
    piece = {};
  }
  if (scan.points_mm.empty()) return fail(bad.error("the scan has no usable point"));
  bad.tell(notes);
  return scan;
}

Result<InspectionData> read_inspection_csv(const std::string& file, std::string_view text,
                                           std::vector<std::string>& notes) {
  CsvRows rows(file, text);
  if (auto error = rows.missing({"record", "tooth", "flank", "deviation_um"})) return fail(*error);
  const std::array<int, 7> columns{rows.column("record"),  rows.column("tooth"),
                                   rows.column("flank"),   rows.column("diameter_mm"),
                                   rows.column("z_mm"),    rows.column("deviation_um"),
                                   rows.column("sigma_um")};
  InspectionData data;
  data.file = file;
  while (rows.next()) {
    InspectionRow row;
    row.line = rows.line();
    const std::string wrong = inspection_row(rows, columns, row);
    if (wrong.empty())
      data.rows.push_back(row);
    else
      rows.bad.add(rows.line(), wrong);
  }
  if (data.rows.empty()) return fail(rows.bad.error("the inspection file has no usable row"));
  data.keys = rows.keys;
  if (const auto zero = rows.keys.find("zero"); zero != rows.keys.end())
    data.common_zero = lowered(zero->second) == "common";
  if (const auto reference = rows.keys.find("reference"); reference != rows.keys.end())
    data.from_design = lowered(reference->second) == "design";
  if (const auto ball = rows.keys.find("ball_diameter_mm"); ball != rows.keys.end() && !ball->second.empty()) {
    data.ball_diameter_mm = number_in(ball->second);
    if (!(data.ball_diameter_mm > 0.0))
      return fail(Error{.code = ErrorCode::kOutOfRange,
                        .message = "no diameter of a ball",
                        .key = ball->first,
                        .value = ball->second,
                        .file = file});
  }
  rows.bad.tell(notes);
  return data;
}

Result<SizeData> read_sizes_csv(const std::string& file, std::string_view text,
                                std::vector<std::string>& notes) {
  CsvRows rows(file, text);
  if (auto error = rows.missing({"quantity", "value_mm"})) return fail(*error);
  const int quantity = rows.column("quantity"), value = rows.column("value_mm");
  const int detail = rows.column("detail"), sigma = rows.column("sigma_um");
  SizeData data;
  data.file = file;
  while (rows.next()) {
    SizeRow row;
    row.line = rows.line();
    const std::string name = lowered(rows.field(quantity));
    row.value_mm = rows.number(value);
    row.detail = rows.number(detail);
    if (name == "span")
      row.quantity = SizeQuantity::kSpan;
    else if (name == "over_pins")
      row.quantity = SizeQuantity::kOverPins;
    else if (name == "tip_diameter")
      row.quantity = SizeQuantity::kTipDiameter;
    else if (name == "root_diameter")
      row.quantity = SizeQuantity::kRootDiameter;
    else if (name == "bore")
      row.quantity = SizeQuantity::kBore;
    else {
      rows.bad.add(rows.line(),
                   "quantity " + in_quotes(name) +
                       " is none of span, over_pins, tip_diameter, root_diameter, bore");
      continue;
    }
    const bool needs_detail =
        row.quantity == SizeQuantity::kSpan || row.quantity == SizeQuantity::kOverPins;
    if (!(row.value_mm > 0.0))
      rows.bad.add(rows.line(),
                   "value_mm " + in_quotes(rows.field(value)) + " is no positive number");
    else if (needs_detail && !(row.detail > 0.0))
      rows.bad.add(rows.line(), name + " needs a detail: teeth spanned, or the pin diameter");
    else if (!read_sigma(rows, sigma, row.sigma_um))
      rows.bad.add(rows.line(), "sigma_um is no positive number");
    else
      data.rows.push_back(row);
  }
  if (data.rows.empty()) return fail(rows.bad.error("the file of sizes has no usable row"));
  rows.bad.tell(notes);
  return data;
}

}  // namespace trueflank::loop
