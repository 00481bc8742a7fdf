// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/parts/moved_wave.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// A wave over the angle of the input that lies otherwise in one of several files: an encoder that
// was zeroed anew, a coupling that was put on otherwise.
namespace trueflank::loop::drive_effects {

namespace {

double is_in_turned_file(const DriveContext&, const BenchPoint& p, const DriveShape& s) {
  return p.file == static_cast<int>(s[kMovedWhat]) ? 1.0 : 0.0;
}

std::vector<DriveShape> turned_at_order(const DriveContext& context, double order,
                                        double direction) {
  constexpr double kStep = 1.0 / 12.0, kLeast = 1.0 / 24.0;
  constexpr std::size_t kFewestOfAFile = 12;
  std::vector<DriveShape> shapes;
  for (const int file : files_to_ask(context.table, kFewestOfAFile, kFewestOfAFile)) {
    // (of two files the second says it)
    if (file == 0 && context.table.points.back().file == 1) continue;
    for (const double how : {double(kWaveEven), double(kWaveWithLoad)})
      for (double turned = kStep; turned < 1.0 - kLeast; turned += kStep)
        shapes.push_back({order, how, direction, 0.0, double(file), turned});
  }
  return shapes;
}

/// The phase of the other files, and that of the file.
MovedWave::Move move_files(const DriveContext&, const DriveShape&) {
  return [](DriveShape& shape, double phase, double by) {
    shape[kWavePhase] += phase;
    shape[kMovedBy] += by - phase;
  };
}

std::string turned_places(const DriveContext& context, const DriveShape& s, double amount,
                          const Parameter& turned) {
  return printed("%.3g degrees of the input in ", moved_most_at_deg(s, amount, 1.0)) +
         name_of_file(context.table, s[kMovedWhat]) +
         printed(" and at %.3g degrees in the other", moved_most_at_deg(s, amount, 0.0)) +
         (context.table.points.back().file > 1 ? " files, " : " file, ") +
         with_interval(turned, " degrees apart");
}

}  // namespace

DriveFamily unnamed_turned_wave() {
  return moved_by(
      {.what = "file",
       .by = "turned",
       .share = is_in_turned_file,
       .at_order = turned_at_order,
       .move = move_files,
       .most_by = 0.2,
       .figure =
           [](const DriveContext&, const DriveShape& s) {
             const double periods = s[kMovedBy] - std::round(s[kMovedBy]);
             return figure_of("turned_deg", 360.0 / s[kWaveOrder] * periods);
           },
       .words = [](const DriveShape&) { return std::string(", that lies otherwise in one file"); },
       .places = turned_places,
       .cause =
           [](const DriveShape&) {
             return std::string(
                 " (an encoder that was zeroed anew, a coupling that was put on otherwise?)");
           }});
}

}  // namespace trueflank::loop::drive_effects
