// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/parts/moved_wave.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/units.h"

namespace trueflank::loop::drive_effects {

namespace {

bool moved_reads(const DriveShape& s) { return s[kWaveDirection] == kAsItReads; }

/// Orders, phases and how far they are moved near by.
std::vector<DriveShape> moved_near(const DriveContext& context, const MovedWave& wave,
                                   const DriveShape& about) {
  constexpr double kApart = 0.5;  // cycles over the run
  const MovedWave::Move move = wave.move(context, about);
  std::vector<DriveShape> shapes;
  for (const double phase : growing_steps(context, 0.003, 0.12)) {
    for (const double by : growing_steps(context, 0.01, 1.0)) {
      DriveShape shape = about;
      shape[kWaveOrder] += by * kApart / std::max(1.0, context.table.turns);
      if (!(shape[kWaveOrder] > 0.0)) continue;
      shape[kWavePhase] += phase + 0.5 * by * kApart;
      shapes.push_back(shape);
    }
    for (const double by : growing_steps(context, 0.004, wave.most_by)) {
      DriveShape shape = about;
      move(shape, phase, by);
      shapes.push_back(shape);
    }
  }
  return shapes;
}

std::vector<Parameter> moved_figures(const DriveContext& context, const MovedWave& wave,
                                     const DriveShape& s, double amount) {
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                 figure_of("order", s[kWaveOrder]), wave.figure(context, s)};
  if (moved_reads(s))
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  return figures;
}

std::string moved_told(const DriveContext& context, const MovedWave& wave, const DriveShape& s,
                       double amount, const std::vector<Parameter>& figures) {
  const bool with_load = s[kWaveHow] == double(kWaveWithLoad), reads = moved_reads(s);
  const std::string size = reads ? with_interval(figures[3], " N m more and less of it")
                                 : with_interval(figures[0], " N m to either side");
  return (reads ? "a reading of the output's torque " : "a loss at the input ") +
         wave_in_words(context.model, s[kWaveOrder]) +
         (with_load ? ", in proportion to the load" : "") + wave.words(s) + ": " + size +
         (with_load ? " at the largest load" : "") + ", most at " +
         wave.places(context, s, amount, figures[2]) + (reads ? kNoLoss : "") + wave.cause(s);
}

}  // namespace

double moved_most_at_deg(const DriveShape& s, double amount, double share) {
  const double periods = s[kWavePhase] + s[kMovedBy] * share + (amount < 0.0 ? 0.5 : 0.0);
  return 360.0 / s[kWaveOrder] * (periods - std::floor(periods));
}

DriveFamily moved_by(const MovedWave& wave) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "how", "direction", "phase", wave.what, wave.by};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.shape_values = {{}, {},
                    {}, {.continuous = true, .is_place = true},
                    {}, {.continuous = true, .is_place = true, .reach = 0.1}};
  f.shapes = no_shapes;
  f.moved_waves_at_order = wave.at_order;
  f.order = [](const DriveShape& s) { return s[kWaveOrder]; };
  f.all_shapes = [wave](const DriveContext& context, const DriveShape* about) {
    return about == nullptr ? std::vector<DriveShape>{} : moved_near(context, wave, *about);
  };
  f.evaluate = [share = wave.share](const DriveContext& context, const BenchPoint& p,
                                    const DriveShape& s, double* c) {
    const double periods =
        s[kWaveOrder] * p.angle_rad / kTwoPi - s[kWavePhase] - s[kMovedBy] * share(context, p, s);
    c[0] = size_of_wave(context, p, s[kWaveHow]) * std::cos(kTwoPi * periods) *
           in_direction(context, p, s[kWaveDirection]);
  };
  f.figures = [wave](const DriveContext& context, const DriveShape& s, double amount) {
    return moved_figures(context, wave, s, amount);
  };
  f.told = [wave](const DriveContext& context, const DriveShape& s, double amount,
                  const std::vector<Parameter>& figures) {
    return moved_told(context, wave, s, amount, figures);
  };
  f.words = [words = wave.words](const DriveModel& model, const DriveShape& s,
                                 const DriveContext*) {
    return wave_in_words(model, s[kWaveOrder]) + words(s);
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{{s[kWaveHow] == double(kWaveWithLoad) ? 1.0 : 0.0, 0.0, 0.0, 0.0,
                                    moved_reads(s) ? 1.0 : 0.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
