// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A wave whose size is not the same all over: in proportion to the load or the speed, with the
// temperature, or growing over the run as what works loose does; one of a direction alone, or of a
// part of the loads, speeds, temperatures or the run; one that turns over at a place; one that is
// largest at a speed; and a wave by the clock, which the angle only imitates.
namespace trueflank::loop::drive_effects {

double size_of_wave(const DriveContext& context, const BenchPoint& p, double how) {
  if (how == double(kWaveWithLoad)) return p.load_nm / context.table.most_load_nm;
  if (how == double(kWaveWithSpeed)) return p.speed_rpm / context.table.most_speed_rpm;
  if (how == double(kWaveWithSpeedSquare))
    return std::pow(p.speed_rpm / context.table.most_speed_rpm, 2);
  if (how == double(kWaveWithWarmth)) return context.share_of_range(p, 2.0);
  if (how == double(kWaveWithCold)) return 1.0 - context.share_of_range(p, 2.0);
  return how == double(kWaveGrows) ? p.taken : 1.0;
}

double share_for_wave(const DriveContext& context, const BenchPoint& p, double over) {
  if (over == 0.0) return p.load_nm / context.table.most_load_nm;
  if (over == 1.0) return p.speed_rpm / context.table.most_speed_rpm;
  return over == kOverRun ? p.taken : context.share_of_range(p, over);
}

namespace {

bool reads(const DriveShape& s) { return s[kWaveDirection] == kAsItReads; }
bool is_of_part(const DriveShape& s) { return s.size() > kWaveSide; }
/// Of one that is largest at a speed, after its phase: the speed [rpm], and by how much its
/// logarithm is another where half is left.
enum ResonantValue : std::size_t { kResonantSpeed = kWavePhase + 1, kResonantHalf };
bool is_resonant(const DriveShape& s) { return s.size() == kResonantHalf + 1; }

double at_resonance(const BenchPoint& p, const DriveShape& s) {
  const double x = std::log(p.speed_rpm / s[kResonantSpeed]) / s[kResonantHalf];
  return 1.0 / (1.0 + x * x);
}

/// 1 where a wave of a part is, 0 where it is not, -1 where it is turned over.
double on_side_of_place(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const bool above = share_for_wave(context, p, s[kWaveOver]) > s[kWavePlace];
  if (s[kWaveSide] == double(kWaveTurnsOver)) return above ? 1.0 : -1.0;
  return above == (s[kWaveSide] == double(kWaveAbove)) ? 1.0 : 0.0;
}

double rows_of_run(const DriveContext& context) {
  return std::max(1.0, static_cast<double>(context.table.points.size()) - 1.0);
}

/// The first line of the run at which it is most.
std::string most_at_line(const DriveContext& context, double cycles, double phase) {
  const auto& points = context.table.points;
  const double taken = (phase - std::floor(phase)) / cycles;
  for (const BenchPoint& p : points)
    if (p.taken >= taken - 0.5 / rows_of_run(context)) return std::to_string(p.line);
  return std::to_string(points.back().line);
}

/// A place as the bench has it, and its key.
Parameter figure_of_place(const DriveContext& context, const DriveShape& s) {
  const BenchTable& t = context.table;
  const double over = s[kWaveOver], place = s[kWavePlace];
  const std::string key = s[kWaveSide] == double(kWaveAbove)   ? "above_"
                          : s[kWaveSide] == double(kWaveBelow) ? "below_"
                                                               : "turns_over_at_";
  if (over == 0.0) return figure_of(key + "load_nm", place * t.most_load_nm);
  if (over == 1.0) return figure_of(key + "rpm", place * t.most_speed_rpm);
  if (over != kOverRun) return figure_of(key + "c", context.quantity_at_share(over, place));
  for (const BenchPoint& p : t.points)
    if (p.taken > place) return figure_of(key + "line", p.line);
  return figure_of(key + "line", t.points.back().line);
}

std::vector<Parameter> wave_figures(const DriveContext& context, const DriveShape& s,
                                    double amount) {
  std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount))};
  if (s[kWaveHow] == double(kWaveByRows))
    figures.push_back(figure_of("period_rows", rows_of_run(context) / s[kWaveOrder]));
  else
    figures.push_back(figure_of("order", s[kWaveOrder]));
  if (reads(s))
    figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
  if (is_of_part(s)) figures.push_back(figure_of_place(context, s));
  if (s[kWaveHow] == double(kWaveWithSpeedSquare))
    figures.push_back(figure_of("speed_exponent", 2.0));
  if (is_resonant(s))
    for (const auto& [key, by] : {std::pair("at_rpm", 0.0), std::pair("half_below_rpm", -1.0),
                                  std::pair("half_above_rpm", 1.0)})
      figures.push_back(figure_of(key, s[kResonantSpeed] * std::exp(by * s[kResonantHalf])));
  return figures;
}

/// What its size follows, and where it is that size.
struct WaveWords {
  std::string follows, at;
};
WaveWords words_of_size(const DriveShape& s) {
  if (s[kWaveHow] == double(kWaveWithLoad))
    return {", in proportion to the load", " at the largest load"};
  if (s[kWaveHow] == double(kWaveWithSpeed))
    return {", in proportion to the speed", " at the highest speed"};
  if (s[kWaveHow] == double(kWaveWithSpeedSquare))
    return {", that grows with the square of the speed", " at the highest speed"};
  if (s[kWaveHow] == double(kWaveWithWarmth))
    return {", that grows with the temperature from nothing at the lowest", " at the highest"};
  if (s[kWaveHow] == double(kWaveWithCold))
    return {", that dies away with the temperature to nothing at the highest", " at the lowest"};
  if (s[kWaveHow] == double(kWaveGrows))
    return {", that grows over the run from nothing", " at its end"};
  return {};
}

/// " of 400 rpm", " of 1.2 N m at the input": the place of a wave of a part.
std::string place_of_wave(const DriveShape& s, const Parameter& place) {
  if (s[kWaveOver] == kOverRun) return "line " + with_interval(place, "");
  return std::string("a ") + name_of_quantity(s[kWaveOver]) + " of " +
         with_interval(place, unit_of_quantity(s[kWaveOver]));
}

std::string part_in_words(const DriveShape& s, const Parameter& place) {
  const std::string at = place_of_wave(s, place);
  if (s[kWaveSide] == double(kWaveTurnsOver)) return ", that turns over at " + at;
  return std::string(", only ") + (s[kWaveSide] == double(kWaveAbove) ? "above " : "up to ") + at;
}

std::string resonance_in_words(const std::vector<Parameter>& figures) {
  const std::size_t at = figures.size() - 3;
  return ", largest at a speed of " + with_interval(figures[at], " rpm") + " and half of that at " +
         with_interval(figures[at + 1], "") + " and " + with_interval(figures[at + 2], " rpm") +
         " (a resonance?)";
}

std::string wave_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const std::string size = reads(s) ? with_interval(figures[2], " N m more and less of it")
                                    : with_interval(figures[0], " N m to either side");
  const std::string what = reads(s) ? "a reading of the output's torque" : "a loss at the input";
  const double phase = s[kWavePhase] + (amount < 0.0 ? 0.5 : 0.0);
  if (s[kWaveHow] == double(kWaveByRows))
    return what + " that comes and goes with the time, with a period of " +
           with_interval(figures[1], " rows") + ": " + size + ", most at line " +
           most_at_line(context, s[kWaveOrder], phase) +
           (reads(s) ? " (a room's temperature, a supply that swings?)" : "") +
           (reads(s) ? kNoLoss : "");
  const double every = 360.0 / s[kWaveOrder], most = every * (phase - std::floor(phase));
  const std::string where =
      every > 361.0 ? printed(", most %.3g turns of the input", most / 360.0) +
                          printed(" after its angle is 0 and every %.4g turns on", every / 360.0)
                    : printed(", most at %.3g degrees of the input", most) +
                          (every < 359.0 ? printed(" and every %.4g degrees on", every) : "");
  const bool one_direction = s[kWaveDirection] == 1.0 || s[kWaveDirection] == 2.0,
             turns_over = is_of_part(s) && s[kWaveSide] == double(kWaveTurnsOver);
  return what + " " + wave_in_words(context.model, s[kWaveOrder]) +
         (one_direction ? direction_in_words(s[kWaveDirection]) : "") + words_of_size(s).follows +
         (is_of_part(s) ? part_in_words(s, figures.back()) : "") +
         (is_resonant(s) ? resonance_in_words(figures) : "") + where +
         (turns_over ? " above it, least there below" : "") + ": " + size +
         (is_resonant(s) ? " at that speed" : words_of_size(s).at) +
         (one_direction ? ", and nothing" + direction_in_words(s[kWaveDirection] == 1.0 ? 2.0 : 1.0)
                        : "") +
         (reads(s) ? kNoLoss : "");
}

/// Orders and phases near by.
std::vector<DriveShape> waves_near(const DriveContext& context, const DriveShape& about) {
  constexpr double kApart = 0.5;  // cycles over the run
  const bool rows = about[kWaveHow] == double(kWaveByRows);
  const double apart = rows ? kApart : kApart / std::max(1.0, context.table.turns);
  std::vector<DriveShape> shapes;
  for (const double by : growing_steps(context, 0.01, 1.0)) {
    DriveShape shape = about;
    shape[kWaveOrder] += by * apart;
    if (!(shape[kWaveOrder] > 0.0)) continue;
    // (about the middle of the run, where the order does not move it)
    const double moved = 0.5 * by * kApart;
    for (const double phase : growing_steps(context, 0.003, 0.12)) {
      shape[kWavePhase] = about[kWavePhase] + moved + phase;
      shapes.push_back(shape);
    }
  }
  return shapes;
}

/// Places between the rows next to a place.
std::vector<DriveShape> places_near(const DriveContext& context, const DriveShape& about) {
  constexpr std::ptrdiff_t kRows = 16;
  std::vector<double> shares;
  for (const BenchPoint& p : context.table.points)
    shares.push_back(share_for_wave(context, p, about[kWaveOver]));
  std::vector<DriveShape> shapes;
  for (const double place : places_between(std::move(shares), about[kWavePlace], kRows)) {
    shapes.push_back(about);
    shapes.back()[kWavePlace] = place;
  }
  return shapes;
}

/// Speeds and widths near by.
std::vector<DriveShape> resonances_near(const DriveContext& context, const DriveShape& about) {
  std::vector<DriveShape> shapes;
  for (const double by : growing_steps(context, 0.02, 1.0))
    for (const double wider : growing_steps(context, 0.02, 0.7)) {
      shapes.push_back(about);
      shapes.back()[kResonantSpeed] *= std::exp(by * about[kResonantHalf]);
      shapes.back()[kResonantHalf] *= std::exp(wider);
    }
  return shapes;
}

enum class WaveKind { kOfSizes, kOfPart, kResonant };

DriveFamily wave_of_sizes(WaveKind kind) {
  const bool of_part = kind == WaveKind::kOfPart, resonant = kind == WaveKind::kResonant;
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "how", "direction", "phase"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {{}, {}, {}, {.continuous = true, .is_place = true}};
  // Waves of one size that were found, and the spectra of parts, say where to look.
  f.shapes = no_shapes;
  f.order = [](const DriveShape& s) {
    return s[kWaveHow] == double(kWaveByRows) ? 0.0 : s[kWaveOrder];
  };
  f.all_shapes = [of_part, resonant](const DriveContext& context, const DriveShape* about) {
    if (about == nullptr) return std::vector<DriveShape>{};
    std::vector<DriveShape> shapes = waves_near(context, *about);
    if (of_part)
      for (DriveShape& shape : places_near(context, *about)) shapes.push_back(std::move(shape));
    if (resonant)
      for (DriveShape& shape : resonances_near(context, *about)) shapes.push_back(std::move(shape));
    return shapes;
  };
  f.evaluate = [of_part, resonant](const DriveContext& context, const BenchPoint& p,
                                   const DriveShape& s, double* c) {
    const double part = of_part    ? on_side_of_place(context, p, s)
                        : resonant ? at_resonance(p, s)
                                   : 1.0;
    if (part == 0.0) {
      c[0] = 0.0;
      return;
    }
    const double cycles = s[kWaveHow] == double(kWaveByRows) ? s[kWaveOrder] * p.taken
                                                             : s[kWaveOrder] * p.angle_rad / kTwoPi;
    c[0] = part * size_of_wave(context, p, s[kWaveHow]) *
           std::cos(kTwoPi * (cycles - s[kWavePhase])) *
           in_direction(context, p, s[kWaveDirection]);
  };
  f.figures = wave_figures;
  f.told = wave_told;
  f.words = [](const DriveModel& model, const DriveShape& s, const DriveContext*) {
    return s[kWaveHow] == double(kWaveByRows)
               ? std::string("that comes and goes with the time")
               : wave_in_words(model, s[kWaveOrder]) + words_of_size(s).follows;
  };
  f.term_shapes = [](const DriveShape& s) {
    return std::vector<DriveShape>{
        {s[kWaveHow] == double(kWaveWithLoad) ? 1.0 : 0.0, 0.0, 0.0, 0.0, reads(s) ? 1.0 : 0.0}};
  };
  return f;
}

}  // namespace

DriveFamily unnamed_wave() {
  DriveFamily f = wave_of_sizes(WaveKind::kOfSizes);
  f.is_wave_of_sizes = true;
  return f;
}

DriveFamily unnamed_resonant_wave() {
  DriveFamily f = wave_of_sizes(WaveKind::kResonant);
  f.shape_names.insert(f.shape_names.end(), {"at_rpm", "half_width"});
  f.shape_values.push_back({.continuous = true, .limits = [](const DriveContext& context) {
                              return std::pair(std::max(1e-6, context.table.least_speed_rpm),
                                               context.table.most_speed_rpm);
                            }});
  f.shape_values.push_back(
      {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.04, 1.2); }});
  f.preference = 8;
  f.dearer = kDearerForms;
  f.is_resonant_wave = true;
  return f;
}

DriveFamily unnamed_part_wave() {
  DriveFamily f = wave_of_sizes(WaveKind::kOfPart);
  f.shape_names.insert(f.shape_names.end(), {"over", "place", "side"});
  f.shape_values.insert(f.shape_values.end(),
                        {{},
                         {.continuous = true,
                          .is_place = true,
                          .reach = 0.02,
                          .limits = [](const DriveContext&) { return std::pair(0.0, 1.0); }},
                         {}});
  f.preference = 8;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  f.is_wave_of_part = true;
  return f;
}

}  // namespace trueflank::loop::drive_effects
