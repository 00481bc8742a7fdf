// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/scans/pits.h"

#include <algorithm>
#include <optional>

#include "trueflank/loop/gear/local/pits/pits.h"

namespace trueflank::loop {

void begin_with_pits(PartModel& model) {
  const std::optional<Pits> pits = pits_of_scans(model.geometry, model.table);
  if (!pits) return;
  model.options.given.push_back(pits->effect);
  model.p_value_of_pits = pits->p_value;
}

void say_how_sure_pits_are(PartModel& model) {
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (model.effects[e].family == find_family("unnamed_pits"))
      model.discovery.chosen[e].p_value = model.p_value_of_pits;
}

}  // namespace trueflank::loop
