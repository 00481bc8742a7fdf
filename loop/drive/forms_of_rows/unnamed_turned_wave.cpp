// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A wave over the angle of the input that lies otherwise in one of several files: an encoder that
// was zeroed anew, a coupling that was put on otherwise.
namespace trueflank::loop::drive_effects {

namespace {

/// After the values of a wave of sizes up to its phase, which is that of the other files.
enum TurnedValue : std::size_t {
  kTurnedFile = kWavePhase + 1,
  kTurnedBy,  ///< periods that it is later in that file
};

bool turned_reads(const DriveShape& s) { return s[kWaveDirection] == kAsItReads; }

/// Degrees of the input, 0 ... one period, at which it is most.
double turned_most_at_deg(const DriveShape& s, double amount, bool in_the_file) {
  const double periods =
      s[kWavePhase] + (in_the_file ? s[kTurnedBy] : 0.0) + (amount < 0.0 ? 0.5 : 0.0);
  return 360.0 / s[kWaveOrder] * (periods - std::floor(periods));
}

/// Files of which each has rows enough and leaves the others enough.
std::vector<int> turned_files(const BenchTable& table) {
  constexpr int kMostFilesAsked = 5;
  constexpr std::size_t kFewestOfAFile = 12;
  const int files = 1 + table.points.back().file;
  std::vector<int> asked;
  // (of two files the second says it)
  for (int file = files == 2 ? 1 : 0; file < files && files <= kMostFilesAsked; ++file) {
    const auto rows = static_cast<std::size_t>(
        std::count_if(table.points.begin(), table.points.end(),
                      [&](const BenchPoint& p) { return p.file == file; }));
    if (rows >= kFewestOfAFile && table.points.size() - rows >= kFewestOfAFile)
      asked.push_back(file);
  }
  return asked;
}

std::string turned_told(const DriveContext& context, const DriveShape& s, double amount,
                        const std::vector<Parameter>& figures) {
  const BenchTable& table = context.table;
  const auto file = static_cast<std::size_t>(s[kTurnedFile]);
  const std::string name = file < table.files.size() ? table.files[file] : std::to_string(file + 1);
  const bool with_load = s[kWaveHow] == double(kWaveWithLoad), reads = turned_reads(s);
  const std::string size = reads ? with_interval(figures[3], " N m more and less of it")
                                 : with_interval(figures[0], " N m to either side");
  return (reads ? "a reading of the output's torque " : "a loss at the input ") +
         wave_in_words(context.model, s[kWaveOrder]) +
         (with_load ? ", in proportion to the load" : "") +
         ", that lies otherwise in one file: " + size + (with_load ? " at the largest load" : "") +
         ", most at " +
         printed("%.3g degrees of the input in ", turned_most_at_deg(s, amount, true)) + name +
         printed(" and at %.3g degrees in the other", turned_most_at_deg(s, amount, false)) +
         (table.points.back().file > 1 ? " files, " : " file, ") +
         with_interval(figures[2], " degrees apart") + (reads ? kNoLoss : "") +
         " (an encoder that was zeroed anew, a coupling that was put on otherwise?)";
}

std::vector<DriveShape> turned_near(const DriveContext& context, const DriveShape& about) {
  constexpr double kApart = 0.5;  // cycles over the run
  std::vector<DriveShape> shapes;
  for (const double phase : growing_steps(context, 0.003, 0.12)) {
    for (const double by : growing_steps(context, 0.01, 1.0)) {
      DriveShape shape = about;
      shape[kWaveOrder] += by * kApart / std::max(1.0, context.table.turns);
      if (!(shape[kWaveOrder] > 0.0)) continue;
      shape[kWavePhase] += phase + 0.5 * by * kApart;
      shapes.push_back(shape);
    }
    for (const double turned : growing_steps(context, 0.004, 0.2)) {
      DriveShape shape = about;
      shape[kWavePhase] += phase;
      shape[kTurnedBy] += turned - phase;
      shapes.push_back(shape);
    }
  }
  return shapes;
}

}  // namespace

DriveFamily unnamed_turned_wave() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "how", "direction", "phase", "file", "turned"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {},
                    {}, {.continuous = true, .is_place = true},
                    {}, {.continuous = true, .is_place = true, .reach = 0.1}};
  f.shapes = no_shapes;
  f.turned_waves_at_order = [](const DriveContext& context, double order, double direction) {
    constexpr double kStep = 1.0 / 12.0, kLeast = 1.0 / 24.0;
    std::vector<DriveShape> shapes;
    for (const int file : turned_files(context.table))
      for (const double how : {double(kWaveEven), double(kWaveWithLoad)})
        for (double turned = kStep; turned < 1.0 - kLeast; turned += kStep)
          shapes.push_back({order, how, direction, 0.0, double(file), turned});
    return shapes;
  };
  f.order = [](const DriveShape& s) { return s[kWaveOrder]; };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : turned_near(context, *about);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double periods = s[kWaveOrder] * p.angle_rad / kTwoPi - s[kWavePhase] -
                           (p.file == static_cast<int>(s[kTurnedFile]) ? s[kTurnedBy] : 0.0);
    c[0] = size_of_wave(context, p, s[kWaveHow]) * std::cos(kTwoPi * periods) *
           in_direction(context, p, s[kWaveDirection]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double periods = s[kTurnedBy] - std::round(s[kTurnedBy]);
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("order", s[kWaveOrder]),
                                   figure_of("turned_deg", 360.0 / s[kWaveOrder] * periods)};
    if (turned_reads(s))
      figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
    return figures;
  };
  f.told = turned_told;
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return wave_in_words(model, s[kWaveOrder]) + ", that lies otherwise in one file";
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{{s[kWaveHow] == double(kWaveWithLoad) ? 1.0 : 0.0, 0.0, 0.0, 0.0,
                                    turned_reads(s) ? 1.0 : 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
