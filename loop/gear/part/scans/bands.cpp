// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/scans/bands.h"

#include "trueflank/loop/gear/local/bands.h"
#include "trueflank/loop/gear/part/choice.h"

namespace trueflank::loop {

std::optional<RemainderFinding> bands_of_flanks(const PartModel& model) {
  if (model.options.joined || is_rounding(model)) return {};
  const auto row_um = fit_of(model, model.options.given)->residuals_um();
  const std::optional<Bands> bands =
      bands_over_face(model.geometry, model.table, model.patches, *row_um);
  if (!bands) return {};
  RemainderFinding finding;
  finding.p_value = bands->p_value;
  finding.amount_um = bands->amount_um;
  finding.effect = bands->form;
  return finding;
}

}  // namespace trueflank::loop
