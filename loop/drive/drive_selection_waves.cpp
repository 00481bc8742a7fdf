// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"
#include "trueflank/loop/drive/wave_scan.h"

// What the size of a wave follows, and whether it comes by the angle or by the clock.
namespace trueflank::loop {
namespace {

/// A wave of two columns, of one size all over or in proportion to the load.
bool is_plain_wave(const DriveEffect& effect) {
  return effect.order() > 0.0 && effect.columns() == 2;
}

const DriveFamily& wave_family() {
  const auto& library = drive_library();
  const auto at = std::find_if(library.begin(), library.end(),
                               [](const DriveFamily& f) { return f.is_wave_of_sizes; });
  return *at;
}

/// Waves of these orders per turn, or of so many to the run, of any phase.
std::vector<DriveShape> waves_about(const BenchTable& table, double order) {
  constexpr int kPhases = 16, kApart = 8;
  constexpr double kOfTheClock = 0.15, kFewestRows = 3.0, kFewestTimes = 2.0, kWarmer = 3.0;
  std::vector<DriveShape> shapes;
  const auto add = [&](double at, double how) {
    for (const double direction : {0.0, drive_effects::kAsItReads})
      for (int phase = 0; phase < kPhases; ++phase)
        if (direction == 0.0 || (table.has(true) && table.has(false)))
          shapes.push_back({at, how, direction, static_cast<double>(phase) / kPhases});
  };
  std::vector<double> sizes{double(drive_effects::kWaveWithLoad), double(drive_effects::kWaveGrows),
                            double(drive_effects::kWaveWithSpeed)};
  if (table.has_temperature && table.temperature_span_c > kWarmer)
    sizes.insert(sizes.end(),
                 {double(drive_effects::kWaveWithWarmth), double(drive_effects::kWaveWithCold)});
  for (int k = -kApart; k <= kApart; ++k)
    if (const double at = order + 0.125 * k / std::max(1.0, table.turns); at > 0.0)
      for (const double how : sizes) add(at, how);
  const double times = order * table.turns, rows = static_cast<double>(table.points.size());
  if (times < kFewestTimes || times * kFewestRows > rows) return shapes;
  const double step = std::max(0.125, kOfTheClock * times / 40.0);
  for (double at = (1.0 - kOfTheClock) * times; at <= (1.0 + kOfTheClock) * times; at += step)
    add(at, double(drive_effects::kWaveByRows));
  return shapes;
}

}  // namespace

void DriveSelection::tell_waves(DriveOutcome& outcome) {
  constexpr double kSurely = 9.0;    // chi-square
  constexpr double kBesideIt = 3.0;  // lines of the spectrum
  if (!table_.has_angle || table_.turns <= 1.01) return;
  std::vector<double> orders;
  for (const DriveEffect& e : outcome.effects)
    if (is_plain_wave(e)) orders.push_back(e.order());
  const bool one_course = std::all_of(table_.points.begin(), table_.points.end(),
                                      [&](const BenchPoint& p) { return p.file == 0; });
  for (const double order : orders) {
    const auto is_of_it = [&](const DriveEffect& e) {
      return is_plain_wave(e) && std::abs(e.order() - order) < kBesideIt / table_.turns;
    };
    OneForm now{.effects = outcome.effects, .from = {}, .size = size_of(outcome.effects)}, base;
    for (std::size_t e = 0; e < outcome.effects.size(); ++e) {
      if (is_of_it(outcome.effects[e])) continue;
      base.effects.push_back(outcome.effects[e]);
      base.from.push_back(static_cast<int>(e));
    }
    if (base.effects.size() == outcome.effects.size()) continue;  // told with another
    const DriveContext here = context();
    now.square = DriveFit(here, value_, now.effects, FitRows::kTraining).residual_square();
    const BesideEffects beside(here, value_, base.effects, FitRows::kTraining);
    // Of every kind the likeliest.
    std::map<std::pair<double, double>, std::pair<double, DriveShape>> likeliest;
    for (DriveShape& shape : waves_about(table_, order)) {
      if (!one_course && (shape[1] == double(drive_effects::kWaveGrows) ||
                          shape[1] == double(drive_effects::kWaveByRows)))
        continue;
      const double gain = beside.with({&wave_family(), shape}).gain;
      auto& [most, best] = likeliest[{shape[1], shape[2]}];
      if (gain <= most) continue;
      most = gain;
      best = std::move(shape);
    }
    OneForm best = now;
    double noise = now.square / std::max(1.0, outcome.rows - now.size);
    for (const auto& [kind, likely] : likeliest) {
      OneForm set = base;
      set.effects.push_back({&wave_family(), likely.second});
      set.from.push_back(-1);
      refine_drive_shapes(context(), value_, FitRows::kTraining, set.effects);
      const PlaceProfile finer = profile_of_place(here, value_, set.effects, set.effects.size() - 1,
                                                  FitRows::kTraining, 0.0);
      set.effects.back().shape = finer.shape;
      if (!fits(set)) continue;
      noise = std::min(noise, set.square / std::max(1.0, outcome.rows - set.size));
      if (set.figure(noise) < best.figure(noise)) best = std::move(set);
    }
    if (best.from.empty() || best.from.back() >= 0 ||
        best.figure(noise) > now.figure(noise) - kSurely)
      continue;
    exchange_effects(outcome, best, false);
  }
}

void DriveSelection::add_waves_of_parts(const std::vector<DriveEffect>& base,
                                        std::vector<WholeForm>& forms) const {
  if (!table_.has_angle) return;
  const auto family_of = [](bool DriveFamily::*which) {
    return &*std::find_if(drive_library().begin(), drive_library().end(),
                          [&](const DriveFamily& f) { return f.*which; });
  };
  const DriveFamily *sized = family_of(&DriveFamily::is_wave_of_sizes),
                    *of_part = family_of(&DriveFamily::is_wave_of_part);
  if (!may_be_there(*sized)) return;
  const DriveContext here = context();
  const DriveFit fit(here, value_, base, FitRows::kTraining);
  const BesideEffects beside(here, value_, base, FitRows::kTraining);
  for (const PartWave& wave : waves_of_parts(here, value_ - fit.explained_nm())) {
    const DriveFamily* family = wave.is_of_part ? of_part : sized;
    DriveEffect effect{family, wave.shape};
    // (what is plain may have taken some of it)
    for (int round = 0; round < 2; ++round) {
      std::vector<DriveEffect> effects = base;
      effects.push_back(effect);
      const DriveFit together(here, value_, effects, FitRows::kTraining);
      effect.shape = finer_part_wave(
          here,
          value_ - together.explained_nm() + together.explained_nm(static_cast<int>(base.size())),
          effect.shape);
    }
    forms.push_back({effect, beside.with(effect).gain, cost_of_looks(wave.looks) + family->dearer});
  }
}

void DriveSelection::add_waves_over_the_angle(const std::vector<DriveEffect>& base,
                                              std::vector<WholeForm>& forms) const {
  constexpr double kSure = 1e-4, kNear = 0.5;
  if (!table_.has_angle) return;
  add_waves_of_parts(base, forms);
  const DriveContext here = context();
  const DriveFit fit(here, value_, base, FitRows::kTraining);
  WaveSpectra spectra;
  const LikeliestOrder line = spectra.likeliest_order(table_, value_ - fit.explained_nm());
  if (!(line.p_value < kSure)) return;
  const auto add = [&](const DriveEffect& wave) {
    std::vector<DriveEffect> effects = base;
    effects.push_back(wave);
    const double gain = fit.residual_square() -
                        DriveFit(here, value_, effects, FitRows::kTraining).residual_square();
    forms.push_back({wave, gain, cost_of_looks(table_.points.size())});
  };
  for (const DriveFamily& family : drive_library())
    if (family.shape_of_wave && may_be_there(family))
      add({&family, family.shape_of_wave(line.order, line.opposite)});
  for (const DriveFamily& family : drive_library())
    if (family.shapes_at_order && may_be_there(family))
      for (DriveShape& shape : family.shapes_at_order(here, line.order)) add({&family, shape});
  for (std::size_t g = 0; g < candidates_.size(); ++g)
    if (const double order = candidates_[g].order();
        order > 0.0 && candidates_[g].family->named && !banned_[g] &&
        may_be_there(*candidates_[g].family) &&
        std::abs(order - line.order) < kNear / std::max(1.0, table_.turns))
      add(candidates_[g]);
}

}  // namespace trueflank::loop
