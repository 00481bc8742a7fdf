// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/drive/drive_selection.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"
#include "trueflank/loop/drive/one_form.h"
#include "trueflank/loop/drive/place_profile.h"
#include "trueflank/loop/drive/scans/wave_scan.h"

// What the size of a wave follows, and whether it comes by the angle or by the clock.
namespace trueflank::loop {
namespace {

/// A wave of two columns, of one size all over or in proportion to the load.
bool is_plain_wave(const DriveEffect& effect) {
  return effect.order() > 0.0 && effect.columns() == 2;
}

const DriveFamily& wave_family() { return *family_with(&DriveFamily::is_wave_of_sizes); }

/// Orders that the spectra of single files show: what lies otherwise in each may be nothing in all.
std::vector<double> orders_of_files(const DriveContext& context, const Eigen::VectorXd& left) {
  constexpr double kSure = 1e-4;
  constexpr std::size_t kFewestRows = 24;
  std::vector<double> orders;
  for (const int file : drive_effects::files_to_ask(context.table, kFewestRows, 0)) {
    BenchTable own = without_rows(context.table);
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < context.table.points.size(); ++i) {
      if (context.table.points[i].file != file) continue;
      own.points.push_back(context.table.points[i]);
      rows.push_back(static_cast<Eigen::Index>(i));
    }
    const LikeliestOrder line = WaveSpectra().likeliest_order(own, left(rows));
    if (line.p_value < kSure) orders.push_back(line.order);
  }
  return orders;
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
    std::vector<DriveEffect> waves = waves_by_speed_or_load(base.effects, order);
    for (const auto& [kind, likely] : likeliest) waves.push_back({&wave_family(), likely.second});
    OneForm best = now;
    double noise = now.square / std::max(1.0, outcome.rows - now.size);
    for (const DriveEffect& wave : waves) {
      OneForm set = base;
      set.effects.push_back(wave);
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

std::vector<DriveEffect> DriveSelection::waves_by_speed_or_load(
    const std::vector<DriveEffect>& base, double order) const {
  constexpr int kSpeeds = 12;
  constexpr double kFewestSpeeds = 6.0;
  const bool many_speeds = table_.levels[1] >= kFewestSpeeds && table_.least_speed_rpm > 0.0;
  const DriveContext here = context();
  const DriveFamily& resonant = *family_with(&DriveFamily::is_resonant_wave);
  if (!may_be_there(resonant)) return {};
  const Eigen::VectorXd left =
      value_ - DriveFit(here, value_, base, FitRows::kTraining).explained_nm();
  double square = 0.0, rows = 0.0;  // in the noise's units
  for (std::size_t i = 0; i < table_.points.size(); ++i) {
    if (table_.points[i].fold == 0) continue;
    square += std::pow(left[static_cast<Eigen::Index>(i)] / table_.points[i].sigma_nm, 2);
    rows += 1.0;
  }
  // Two columns of every size over the speed, each row in its noise's units.
  struct Waves {
    DriveEffect effect;
    double gain = 0.0;
  };
  const auto likeliest_of = [&](const DriveFamily& family, const std::vector<DriveShape>& shapes) {
    Waves most{{&family, {}}, 0.0};
    for (const DriveShape& shape : shapes) {
      WaveProducts products;
      DriveShape sine = shape;
      sine[drive_effects::kWavePhase] = 0.25;
      for (std::size_t i = 0; i < table_.points.size(); ++i) {
        const BenchPoint& p = table_.points[i];
        if (p.fold == 0) continue;
        double at_zero = 0.0, at_quarter = 0.0;
        family.evaluate(here, p, shape, &at_zero);
        family.evaluate(here, p, sine, &at_quarter);
        products.add(at_zero / p.sigma_nm, at_quarter / p.sigma_nm,
                     left[static_cast<Eigen::Index>(i)] / p.sigma_nm);
      }
      const WaveAmounts wave = products.solved(1e-9 * products.cos_cos * products.sin_sin);
      if (wave.gain <= most.gain) continue;
      most = {{&family, shape}, wave.gain};
      most.effect.shape[drive_effects::kWavePhase] = wave.phase() - std::floor(wave.phase());
    }
    return most;
  };
  std::vector<Waves> best;
  const double by =
      many_speeds ? std::log(table_.most_speed_rpm / table_.least_speed_rpm) / (kSpeeds + 1) : 0.0;
  for (const double direction : {0.0, drive_effects::kAsItReads}) {
    if (direction != 0.0 && !(table_.has(true) && table_.has(false))) continue;
    std::vector<DriveShape> even, squares, resonances;
    for (const double apart : {-0.25, 0.0, 0.25}) {
      if (!many_speeds && apart != 0.0) continue;
      const double at = order + apart / std::max(1.0, table_.turns);
      if (!(at > 0.0)) continue;
      even.push_back({at, double(drive_effects::kWaveEven), direction, 0.0});
      squares.push_back({at, double(drive_effects::kWaveWithSpeedSquare), direction, 0.0});
      for (int speed = 1; speed <= kSpeeds; ++speed)
        for (const double half : {0.12, 0.3, 0.7})
          resonances.push_back({at, double(drive_effects::kWaveEven), direction, 0.0,
                                table_.least_speed_rpm * std::exp(by * speed), half});
    }
    // What goes with the speed leaves clearly less than the same at all speeds; a phase that moves
    // a little, surely less.
    constexpr double kClearlyMore = 1.3, kSurelyMore = 25.0;
    const double of_even = likeliest_of(wave_family(), even).gain;
    if (!many_speeds) squares = resonances = {};
    for (const Waves& waves :
         {likeliest_of(wave_family(), squares), likeliest_of(resonant, resonances)})
      if (waves.gain > kClearlyMore * of_even) best.push_back(waves);
    for (const DriveFamily& family : drive_library()) {
      if (!family.moved_waves_at_order) continue;
      const Waves moved = likeliest_of(family, family.moved_waves_at_order(here, order, direction));
      if (moved.gain > of_even + kSurelyMore * (square - moved.gain) / rows) best.push_back(moved);
    }
  }
  std::vector<DriveEffect> waves;
  for (const Waves& wave : best) {
    std::vector<DriveEffect> effects = base;
    effects.push_back(wave.effect);
    for (int round = 0; round < 2; ++round) {
      refine_drive_shapes(here, value_, FitRows::kTraining, effects);
      effects.back().shape =
          profile_of_place(here, value_, effects, effects.size() - 1, FitRows::kTraining, 0.0)
              .shape;
    }
    waves.push_back(effects.back());
  }
  return waves;
}

void DriveSelection::add_waves_of_parts(const std::vector<DriveEffect>& base,
                                        std::vector<WholeForm>& forms) const {
  if (!table_.has_angle) return;
  const DriveFamily *sized = &wave_family(), *of_part = family_with(&DriveFamily::is_wave_of_part);
  if (!may_be_there(*sized)) return;
  const DriveContext here = context();
  const DriveFit fit(here, value_, base, FitRows::kTraining);
  const BesideEffects beside(here, value_, base, FitRows::kTraining);
  std::vector<double> orders;
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
    if (std::none_of(orders.begin(), orders.end(), [&](double order) {
          return std::abs(order - effect.order()) < 0.5 / std::max(1.0, table_.turns);
        }))
      orders.push_back(effect.order());
  }
  // Of these orders also those whose size goes with the speed otherwise.
  constexpr std::size_t kMostOrders = 3;
  if (orders.size() > kMostOrders) orders.resize(kMostOrders);
  for (const double order : orders_of_files(here, value_ - fit.explained_nm()))
    if (std::none_of(orders.begin(), orders.end(), [&](double known) {
          return std::abs(known - order) < 0.5 / std::max(1.0, table_.turns);
        }))
      orders.push_back(order);
  for (const double order : orders)
    for (const DriveEffect& wave : waves_by_speed_or_load(base, order))
      forms.push_back({wave, beside.with(wave).gain,
                       cost_of_looks(10 * table_.points.size()) + wave.family->dearer});
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
