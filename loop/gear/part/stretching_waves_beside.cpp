// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/stretching_waves_beside.h"

#include <utility>

#include "trueflank/loop/gear/local/stretching_waves.h"

namespace trueflank::loop {

std::vector<Effect> stretching_waves_beside(const PartModel& model, const std::vector<Effect>& rest,
                                            const std::vector<std::vector<Effect>>& causes,
                                            bool opposite) {
  constexpr std::size_t kMostEach = 6;
  std::vector<Effect> forms;
  for (const std::vector<Effect>& names : causes) {
    std::vector<Effect> with = rest;
    with.insert(with.end(), names.begin(), names.end());
    const ValuesOfTeeth left(model.geometry, model.table, *fit_of(model, with)->residuals_um(),
                             FlankChoice::kBoth, opposite);
    for (EffectShape& shape : stretching_waves(model.geometry, left, opposite, kMostEach))
      forms.push_back(
          {find_family("unnamed_stretching_wave"), FlankChoice::kBoth, std::move(shape)});
  }
  return forms;
}

std::size_t looks_for_stretching_waves(const PartModel& model, std::size_t causes) {
  return causes * stretching_waves_looked_at(model.geometry.teeth());
}

}  // namespace trueflank::loop
