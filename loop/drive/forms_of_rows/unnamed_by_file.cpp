// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/drive/effects/parts/parts_of_ranges.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// What one of several files has more than the others: another day, another set-up.
namespace trueflank::loop::drive_effects {

std::vector<int> files_to_ask(const BenchTable& table, std::size_t fewest,
                              std::size_t fewest_of_others) {
  std::vector<int> asked;
  const int files = 1 + table.points.back().file;
  if (files < 2 || files > kMostFilesAsked) return asked;
  for (int file = 0; file < files; ++file) {
    const auto rows = static_cast<std::size_t>(
        std::count_if(table.points.begin(), table.points.end(),
                      [&](const BenchPoint& p) { return p.file == file; }));
    if (rows >= fewest && table.points.size() - rows >= fewest_of_others) asked.push_back(file);
  }
  return asked;
}

std::string name_of_file(const BenchTable& table, double number) {
  const auto file = static_cast<std::size_t>(number);
  return file < table.files.size() ? table.files[file] : std::to_string(file + 1);
}

namespace {

enum ByFile : std::size_t { kFileNumber, kFileOf };
/// A loss is told of the file that has it: "less" goes after "more in the other one".
enum class Told { kMoreLost, kLessLost, kReading };

/// What of "this row is of this file" no plain course over direction, load, speed and temperature
/// says as well, 0 ... 1.
double file_stands_out(const BenchTable& table, int file) {
  const auto n = static_cast<Eigen::Index>(table.points.size());
  const Eigen::Index columns = table.has_temperature ? 6 : 5;
  Eigen::MatrixXd x(n, columns);
  Eigen::VectorXd is_of(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BenchPoint& p = table.points[static_cast<std::size_t>(i)];
    const double load = p.load_nm / std::max(table.most_load_nm, 1e-300),
                 speed = p.speed_rpm / std::max(table.most_speed_rpm, 1e-300);
    x.row(i).head(5) << 1.0, p.forward ? 1.0 : 0.0, load, load * load, speed;
    if (columns > 5)
      x(i, 5) =
          (p.temperature_c - table.mean_temperature_c) / std::max(table.temperature_span_c, 1.0);
    is_of[i] = p.file == file ? 1.0 : 0.0;
  }
  const Eigen::VectorXd alone = is_of.array() - is_of.mean();
  // (a column without variation, as of one direction, is left out)
  std::vector<Eigen::Index> kept{0};
  for (Eigen::Index k = 1; k < columns; ++k)
    if ((x.col(k).array() - x.col(k).mean()).matrix().norm() > 1e-6 * std::sqrt(double(n)))
      kept.push_back(k);
  const Eigen::MatrixXd own = x(Eigen::all, kept);
  return (is_of - own * least_squares(own, is_of)).squaredNorm() /
         std::max(alone.squaredNorm(), 1e-300);
}

std::vector<DriveShape> file_shapes(const DriveContext& context, bool reads) {
  constexpr double kLeastOfItsOwn = 0.08, kSpeedVaries = 1.5;
  constexpr std::size_t kFewestOfAFile = 6;
  std::vector<DriveShape> shapes;
  std::vector<double> kinds = kinds_of(reads);
  if (!reads && context.table.most_speed_rpm > kSpeedVaries * context.table.least_speed_rpm)
    kinds.push_back(kBySpeed);
  for (const int file : files_to_ask(context.table, kFewestOfAFile, kFewestOfAFile)) {
    if (file_stands_out(context.table, file) < kLeastOfItsOwn) continue;
    for (const double what : kinds) shapes.push_back({static_cast<double>(file), what});
  }
  return shapes;
}

/// Where both directions were run and power is gained, forms of the whole bench are not asked: a
/// zero that one file forgot is among the first candidates.
std::vector<DriveShape> files_of_gained_power(const DriveContext& context) {
  const BenchTable& table = context.table;
  return table.impossible == Impossible::kEfficiencyAboveOne && table.has(true) && table.has(false)
             ? file_shapes(context, true)
             : std::vector<DriveShape>{};
}

/// Where the output's torque of one file is as much less or more as another unit makes it.
std::string unit_in_words(const DriveContext& context, double of, double amount) {
  constexpr double kPoundFeet = 0.737562, kNear = 0.01;
  if (of != double(kFlanks) && of != double(kOutputGain)) return "";
  const double factor =
      1.0 + (of == double(kFlanks) ? -amount : amount) / context.table.most_load_nm;
  if (std::abs(factor - kPoundFeet) < kNear)
    return "; its output torque is 0.738 of what it should be: was it written in pound-feet?";
  if (std::abs(factor * kPoundFeet - 1.0) < kNear)
    return "; its output torque is 1.356 of what it should be: was it turned from pound-feet into "
           "newton metres twice?";
  return "";
}

std::string file_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  constexpr double kMostlyItsOwn = 0.4;
  const BenchTable& table = context.table;
  const bool one_way = !(table.has(true) && table.has(false));
  return subject_of(s[kFileOf]) + " that one file has: in " + name_of_file(table, s[kFileNumber]) +
         " it is " +
         more_of(
             figures, s[kFileOf], amount,
             table.points.back().file > 1 ? " than in the other files" : " than in the other file") +
         same_sign(context, s[kFileOf]) +
         (one_way ? ", or the torque of the driven side is read so: one direction does not tell"
                  : "") +
         unit_in_words(context, s[kFileOf], amount) +
         (file_stands_out(table, static_cast<int>(s[kFileNumber])) < kMostlyItsOwn
              ? "; the files were run at other loads, speeds or directions, so it is hard to tell "
                "from what follows these: run some set points of one file in the other, too"
              : "") +
         " (what was another that day: a brake that rubs, oil, a coupling, a zero?)";
}

DriveFamily by_file(Told told) {
  constexpr double kDearerIfLess = 4.0;
  const bool reads = told == Told::kReading;
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"file", "what"};
  f.preference = 7;
  f.stands_alone = true;
  f.dearer = kDearerForms + (told == Told::kLessLost ? kDearerIfLess : 0.0);
  f.only_positive = told == Told::kMoreLost;
  if (told == Told::kLessLost)
    f.plausible = [](const DriveModel&, const DriveShape&, double amount) { return amount < 0.0; };
  f.shapes = no_shapes;
  if (reads) f.shapes = files_of_gained_power;
  f.in_place_of_losses = reads;
  f.whole_shapes = [reads](const DriveContext& context) { return file_shapes(context, reads); };
  f.kind = [](const DriveShape& s) {
    return kMostFilesAsked * static_cast<int>(s[kFileOf]) + static_cast<int>(s[kFileNumber]);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = p.file == static_cast<int>(s[kFileNumber]) ? sized_loss_nm(context, p, s[kFileOf]) : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("file", s[kFileNumber] + 1.0)};
    add_reading(context, s[kFileOf], amount, figures);
    return figures;
  };
  f.told = file_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext* context) {
    return "that one file has" +
           (context ? ", " + name_of_file(context->table, s[kFileNumber]) : std::string());
  };
  if (reads) f.term_shapes = [](const DriveShape& s) { return terms_of_reading(s[kFileOf]); };
  return f;
}

}  // namespace

DriveFamily unnamed_by_file() { return by_file(Told::kMoreLost); }
DriveFamily unnamed_less_by_file() { return by_file(Told::kLessLost); }
DriveFamily unnamed_reading_by_file() { return by_file(Told::kReading); }

}  // namespace trueflank::loop::drive_effects
