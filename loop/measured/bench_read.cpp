// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/number_text.h"
#include "trueflank/loop/measured/bench_data.h"
#include "trueflank/loop/measured/csv_rows.h"

namespace trueflank::loop {
namespace {

struct Column {
  const char* name;
  const char* stem;  ///< a header that begins so but ends in another unit
  const char* unit;
};
constexpr Column kColumns[] = {
    {"input_speed_rpm", "input_speed", "revolutions per minute"},
    {"input_torque_nm", "input_torque", "newton metres"},
    {"output_torque_nm", "output_torque", "newton metres"},
    {"temperature_c", "temperature_f", "degrees Celsius"},
    {"temperature_c", "temperature_k", "degrees Celsius"},
    {"input_angle_deg", "input_angle", "degrees"},
    {"reverse_starting_torque_nm", "reverse_starting_torque", "newton metres"},
};

/// Beyond these no bench measures: sizes whose squares and differences still are numbers.
struct Bound {
  const char* column;
  double BenchRow::*value;
  double most;
  const char* unit;
};
constexpr Bound kBounds[] = {
    {"input_speed_rpm", &BenchRow::speed_rpm, 1e7, "rpm"},
    {"input_torque_nm", &BenchRow::input_nm, 1e9, "N m"},
    {"output_torque_nm", &BenchRow::output_nm, 1e9, "N m"},
    {"temperature_c", &BenchRow::temperature_c, 1e4, "degrees Celsius"},
    {"input_angle_deg", &BenchRow::angle_deg, 1e13, "degrees"},
    {"sigma_nm", &BenchRow::sigma_nm, 1e9, "N m"},
};

/// Errors below this weigh so much that nothing else counts, N m.
constexpr double kLeastSigma = 1e-12;

/// A number followed by letters: somebody wrote the unit into the field.
bool carries_unit(std::string_view field) {
  const auto end = field.find_first_not_of("+-.0123456789eE ");
  return end != std::string_view::npos && end > 0 && !std::isnan(number_in(trimmed(field.substr(0, end))));
}

/// Columns whose name says another unit than ours: nothing is converted in silence.
Errors foreign_units(const CsvRows& rows, const std::string& file) {
  Errors errors;
  for (const std::string& name : rows.header())
    for (const Column& column : kColumns)
      if (name != column.name && name.starts_with(column.stem) && rows.column(column.name) < 0)
        errors.push_back({.code = ErrorCode::kUnknownKey,
                          .message = "column " + in_quotes(name) + " is in another unit, or says none",
                          .key = name,
                          .remedy = "the column " + std::string(column.name) + ", in " + column.unit,
                          .file = file,
                          .line = rows.line()});
  return errors;
}

class RowReader {
 public:
  RowReader(const std::string& file, CsvRows& rows, BenchData& data)
      : file_(file), rows_(rows), data_(data) {}

  Errors run() {
    if (auto error = rows_.missing(
            {"direction", "input_speed_rpm", "input_torque_nm", "output_torque_nm"}))
      return {*error};
    direction_ = rows_.column("direction");
    const std::size_t before = data_.rows.size();
    while (rows_.next()) {
      BenchRow row;
      row.file = static_cast<int>(data_.files.size()) - 1;
      row.line = rows_.line();
      const std::string wrong = read(row);
      if (!errors_.empty() && errors_.size() > 20) break;
      if (wrong.empty()) data_.rows.push_back(row);
      else rows_.bad.add(rows_.line(), wrong);
    }
    if (!errors_.empty()) return errors_;
    if (data_.rows.size() == before) return {rows_.bad.error("the bench file has no usable row")};
    rows_.bad.tell(data_.notes);
    return {};
  }

 private:
  /// The field's number into target; a sentence where it is none.
  std::string number(const char* name, bool needed, double& target) {
    const int column = rows_.column(name);
    const std::string_view field = rows_.field(column);
    if (!needed && (column < 0 || field.empty())) return {};
    target = rows_.number(column);
    if (!std::isnan(target)) return {};
    if (carries_unit(field))
      errors_.push_back({.code = ErrorCode::kWrongType,
                         .message = "the field carries a unit; rows of one file may not mix units",
                         .key = name,
                         .value = std::string(field),
                         .remedy = "plain numbers in the unit of the column's name",
                         .file = file_,
                         .line = rows_.line()});
    return std::string(name) + " " + in_quotes(field) + " is no number";
  }

  std::string read(BenchRow& row) {
    const std::string direction = lowered(rows_.field(direction_));
    if (direction == "forward") row.forward = true;
    else if (direction == "backward") row.forward = false;
    else return "direction " + in_quotes(rows_.field(direction_)) + " is neither forward nor backward";
    for (const auto& wrong :
         {number("input_speed_rpm", true, row.speed_rpm), number("input_torque_nm", true, row.input_nm),
          number("output_torque_nm", true, row.output_nm),
          number("temperature_c", false, row.temperature_c),
          number("input_angle_deg", false, row.angle_deg), number("sigma_nm", false, row.sigma_nm)})
      if (!wrong.empty()) return wrong;
    row.speed_rpm = std::abs(row.speed_rpm);  // the direction column says which way the power goes
    if (!std::isnan(row.sigma_nm) && !(row.sigma_nm > 0.0)) return "sigma_nm is no positive number";
    if (row.sigma_nm < kLeastSigma)
      return printed("sigma_nm of %.4g is less than any sensor's (%.0e N m)", row.sigma_nm,
                     kLeastSigma);
    if (row.temperature_c < -273.15) return "temperature_c lies below absolute zero";
    for (const Bound& bound : kBounds)
      if (std::abs(row.*bound.value) > bound.most)
        return printed("%s of %.4g is more than any bench has (%.0e %s)", bound.column,
                       row.*bound.value, bound.most, bound.unit);
    return {};
  }

  const std::string& file_;
  CsvRows& rows_;
  BenchData& data_;
  int direction_ = -1;
  Errors errors_;
};

std::string read_quantity(CsvRows& rows, BenchQuantity& q) {
  const std::string name = lowered(rows.field(rows.column("quantity")));
  if (name == "forward_efficiency") q.kind = BenchQuantityKind::kForwardEfficiency;
  else if (name == "backward_efficiency") q.kind = BenchQuantityKind::kBackwardEfficiency;
  else if (name == "reverse_starting_torque_nm") q.kind = BenchQuantityKind::kReverseStartingTorque;
  else
    return "quantity " + in_quotes(name) +
           " is none of forward_efficiency, backward_efficiency, reverse_starting_torque_nm";
  const std::string_view field = rows.field(rows.column("value"));
  q.value = number_in(field);
  if (!(q.value >= 0.0)) return "value " + in_quotes(field) + " is no number of 0 or more";
  const std::string_view load = rows.field(rows.column("load_nm"));
  q.load_nm = number_in(load);
  if (!load.empty() && !(q.load_nm > 0.0)) return "load_nm " + in_quotes(load) + " is no positive number";
  return {};
}

Errors read_quantities(const std::string& file, CsvRows& rows, BenchData& data) {
  const std::size_t before = data.quantities.size();
  while (rows.next()) {
    BenchQuantity q;
    q.file = static_cast<int>(data.files.size()) - 1;
    q.line = rows.line();
    const std::string wrong = read_quantity(rows, q);
    if (!wrong.empty()) {
      rows.bad.add(rows.line(), wrong);
      continue;
    }
    if (q.kind != BenchQuantityKind::kReverseStartingTorque && q.value > 1.5)
      return {{.code = ErrorCode::kOutOfRange,
               .message = "an efficiency this far above 1 looks like per cent",
               .key = "value",
               .value = std::string(rows.field(rows.column("value"))),
               .remedy = "efficiencies from 0 to 1: 0.89, not 89",
               .file = file,
               .line = rows.line()}};
    data.quantities.push_back(q);
  }
  if (data.quantities.size() == before) return {rows.bad.error("the bench file has no usable quantity")};
  rows.bad.tell(data.notes);
  return {};
}

}  // namespace

Errors read_bench_text(const std::string& file, std::string_view text, BenchData& data) {
  CsvRows rows(file, text);
  data.files.push_back(file);
  if (Errors errors = foreign_units(rows, file); !errors.empty()) return errors;
  if (rows.column("quantity") >= 0 && rows.column("value") >= 0)
    return read_quantities(file, rows, data);
  return RowReader(file, rows, data).run();
}

ResultAll<BenchData> read_bench_files(const std::vector<std::string>& paths) {
  BenchData data;
  Errors errors;
  for (const std::string& path : paths) {
    const auto text = read_whole_file(path);
    if (!text) {
      errors.push_back(text.error());
      continue;
    }
    for (Error& error : read_bench_text(path, *text, data)) errors.push_back(std::move(error));
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  return data;
}

}  // namespace trueflank::loop
