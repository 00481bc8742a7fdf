// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/body/walls_by_direction.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {

void tell_walls_by_direction(PartModel& model) {
  constexpr double kValue = 6.0;  // chi-square: of each value spared
  constexpr double kAlongNormal = 0.0;
  if (model.options.joined || model.table->points_mm.empty()) return;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& wave = model.effects[e];
    if (wave.family != find_family("unnamed") || wave.flank != FlankChoice::kBoth ||
        !(wave.order() > 0.0) || wave.shape[0] + wave.shape[1] + wave.shape[3] != 0.0)
      continue;
    std::vector<std::size_t> these{e};
    for (std::size_t k = first_told_here(model); k < model.effects.size(); ++k)
      if (const Effect& name = model.effects[k];
          name.family->named && name.columns() == 2 &&
          (moves_the_teeth(name) ? 1.0 : name.order()) == wave.order())
        these.push_back(k);
    if (these.size() < 2) continue;
    std::sort(these.begin(), these.end());
    std::vector<Effect> with = without(model.effects, these);
    EffectShape shape{wave.order(), kAlongNormal};
    shape.resize(2 + gear_effects::FlankCourse::kValues + 1);
    with.push_back({find_family("unnamed_body_wave"), FlankChoice::kBoth, std::move(shape)});
    const double spared = 2.0 * static_cast<double>(these.size() - 1);
    if (fit_of(model, with)->residual_square() >
        fit_of(model, model.effects)->residual_square() + kValue * spared)
      continue;
    put_in_place_of(model, these, with);
    return;
  }
}

}  // namespace trueflank::loop
