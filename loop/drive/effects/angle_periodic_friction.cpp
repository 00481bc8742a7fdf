// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

std::string periodic_words(const DriveModel& model, const DriveShape& shape) {
  std::string text = wave_in_words(model, shape[0]);
  const bool is_of_a_member = text.back() == ')';
  if (!is_of_a_member && shape[0] == std::round(shape[0]))
    text += " (input shaft, " + short_text(shape[0]) + " times a turn)";
  return text + (shape[1] != 0.0 ? ", in proportion to the load" : "");
}

}  // namespace

DriveFamily angle_periodic_friction() {
  DriveFamily f;
  f.id = "angle_periodic_friction";
  f.description = "the loss torque at the input comes and goes with the angle";
  f.cause = "eccentric or bent member of that order, planet that carries more, cogging";
  f.correction = "measure the member of that order; assemble it turned";
  f.parameters = {"amplitude_nm", "phase_deg"};
  f.shape_names = {"order", "with_load"};
  f.form = ParameterForm::kWave;
  f.preference = 1;
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!context.table.has_angle) return shapes;
    for (const MemberOrder& member : context.model.orders) {
      const bool whole = std::abs(member.order - std::round(member.order)) < 1e-9;
      // Less than a turn and a half of the member is a slope; an angle that starts again every input
      // turn shows whole orders only.
      if (context.table.turns <= 1.01 ? !whole : context.table.turns * member.order < 1.5) continue;
      shapes.push_back({member.order, 0.0});
      shapes.push_back({member.order, 1.0});
    }
    return shapes;
  };
  // Jaws of a coupling, poles, screws: any whole order of the input's shaft, once a spectrum shows
  // it.
  f.shapes_at_order = [](const DriveContext& context, double order) {
    constexpr double kLeastOrder = 3.0, kNear = 0.25;
    const double whole = std::round(order);
    if (whole < kLeastOrder || std::abs(order - whole) > kNear / std::max(1.0, context.table.turns))
      return std::vector<DriveShape>{};
    return std::vector<DriveShape>{{whole, 0.0}, {whole, 1.0}};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    const double size = -context.lever(p) *
                        (shape[1] != 0.0 ? p.load_nm / context.table.most_load_nm : 1.0);
    c[0] = size * std::cos(shape[0] * p.angle_rad);
    c[1] = size * std::sin(shape[0] * p.angle_rad);
  };
  f.order = first_value;
  f.words = [](const DriveModel& model, const DriveShape& shape, const DriveContext*) {
    return periodic_words(model, shape);
  };
  f.detail = [](const DriveModel& model, const DriveShape& shape) {
    return ": " + periodic_words(model, shape);
  };
  f.not_carried = "it cancels over a turn";
  return f;
}

}  // namespace trueflank::loop::drive_effects
