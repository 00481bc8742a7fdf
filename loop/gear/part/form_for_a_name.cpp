// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/form_for_a_name.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/runs_along.h"

namespace trueflank::loop {

bool tell_as_form_for_a_name(PartModel& model) {
  constexpr double kClearly = 18.0;  // chi-square, of one value more
  constexpr double kShare = 0.02;    // of what the name takes out: it is another form
  constexpr int kMore = 1;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect name = model.effects[e];
    if (!name.family->named || values_of({name}, true) != 1) continue;
    const Runs runs = runs_of(model.geometry, name);
    if (runs != Runs::kOverProfile && runs != Runs::kOverFace) continue;
    const double face = runs == Runs::kOverFace ? 1.0 : 0.0;
    const std::vector<Effect> with =
        one_form_for(model, {e}, forms_along(model.geometry, face, name.flank, false), {}, kMore);
    if (with.empty()) continue;
    std::vector<Effect> without = model.effects;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(e));
    const double now = fit_of(model, model.effects)->residual_square();
    const double gain = now - fit_of(model, with)->residual_square();
    const double of_name = fit_of(model, without)->residual_square() - now;
    if (gain < std::max(kClearly, kShare * of_name)) continue;
    put_in_place_of(model, {e}, with);
    return true;
  }
  return false;
}

}  // namespace trueflank::loop
