// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/loop/drive_effect.h"

// Effects that take power. Torques are at the input shaft; forms and sources: docs/drive-loop.md.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;
using Shapes = std::vector<Shape>;

/// A loss torque at the input [N m per unit], as it shows on the driven side.
template <class Loss>
auto loss(Loss torque) {
  return [torque](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    c[0] = -context.lever(p) * torque(context, p, shape);
  };
}

Shapes speeds(const DriveContext& context) {
  Shapes shapes;
  const double most = context.table.most_speed_rpm;
  // A scale beyond the range is a slope, one below the slowest set points is not seen.
  for (double part : {0.02, 0.04, 0.07, 0.11, 0.16, 0.23, 0.32, 0.45})
    if (part * most > 0.3 * context.table.least_speed_rpm) shapes.push_back({part * most});
  if (!(most > 3.0 * context.table.least_speed_rpm)) shapes.clear();
  return shapes;
}

Shapes temperature_rates(const DriveContext& context) {
  if (!context.table.has_temperature || context.table.temperature_span_c < 3.0) return {};
  return {{0.005}, {0.01}, {0.018}, {0.027}, {0.04}, {0.06}, {0.09}};
}

double thinning(const DriveContext& context, const BenchPoint& p, double rate) {
  return std::exp(-rate * (p.temperature_c - context.table.mean_temperature_c));
}

DriveFamily friction_coefficient() {
  DriveFamily f;
  f.id = "friction_coefficient";
  f.description = "the tooth flanks' friction coefficient is another than designed with";
  f.cause = "lubricant, finish, material of the flanks";
  f.correction = "design with this coefficient; change lubricant or finish";
  f.parameters = {"value"};
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape&, double* c) {
    c[0] = context.friction_slope(p);
  };
  return f;
}

DriveFamily drag_torque() {
  DriveFamily f;
  f.id = "drag_torque";
  f.description = "a torque at the input that depends on neither load nor speed";
  f.cause = "preload of bearings, seals, teeth without backlash, grease";
  f.correction = "check preload, seals, backlash and filling";
  f.parameters = {"torque_nm"};
  f.only_positive = true;
  f.evaluate = loss([](auto&, auto&, auto&) { return 1.0; });
  return f;
}

DriveFamily viscous_drag() {
  DriveFamily f;
  f.id = "viscous_drag";
  f.description = "a torque at the input that grows with speed";
  f.cause = "lubricant's viscosity and filling";
  f.correction = "thinner or less lubricant";
  f.parameters = {"nm_per_rpm"};
  f.only_positive = true;
  f.preference = 1;
  f.evaluate = loss([](auto&, const BenchPoint& p, auto&) { return p.speed_rpm; });
  return f;
}

DriveFamily bearing_friction() {
  DriveFamily f;
  f.id = "bearing_friction";
  f.description = "a torque at the input that grows with the 2/3 power of speed";
  f.cause = "lubricated rolling bearings (Palmgren's load-independent part)";
  f.correction = "bearing size, seals, viscosity";
  f.parameters = {"nm_at_1000_rpm"};
  f.only_positive = true;
  f.preference = 2;
  f.evaluate = loss([](auto&, const BenchPoint& p, auto&) {
    return std::pow(p.speed_rpm / 1000.0, 2.0 / 3.0);
  });
  return f;
}

DriveFamily bearing_load() {
  DriveFamily f;
  f.id = "bearing_load_friction";
  f.description = "a torque at the input in proportion to what the output carries";
  f.cause = "rolling bearings under load (Palmgren's load-dependent part)";
  f.correction = "larger pitch, fewer or smaller bearings";
  f.parameters = {"share"};
  f.only_positive = true;
  f.preference = 4;
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, auto&) {
    return p.forward ? context.efficiency(p) * p.load_nm : p.load_nm;
  });
  return f;
}

DriveFamily stribeck_friction() {
  DriveFamily f;
  f.id = "stribeck_friction";
  f.description = "a torque at the input that fades as the drive speeds up: T exp(-(n/n0)^2)";
  f.cause = "boundary lubrication at low speed";
  f.correction = "lubricant with better boundary film, smoother flanks and seals";
  f.parameters = {"torque_nm"};
  f.shape_names = {"speed_rpm"};
  f.shape_continuous = {true};
  f.only_positive = true;
  f.preference = 2;
  f.shapes = speeds;
  f.evaluate = loss([](auto&, const BenchPoint& p, const Shape& shape) {
    const double x = p.speed_rpm / shape[0];
    return std::exp(-x * x);
  });
  return f;
}

DriveFamily mixed_friction() {
  DriveFamily f;
  f.id = "mixed_friction";
  f.description = "the flanks' friction coefficient is higher at low speed: + value exp(-(n/n0)^2)";
  f.cause = "mixed lubrication of the flanks at low speed";
  f.correction = "viscosity, finish of the flanks";
  f.parameters = {"value"};
  f.shape_names = {"speed_rpm"};
  f.shape_continuous = {true};
  f.only_positive = true;
  f.preference = 3;
  f.shapes = speeds;
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const double x = p.speed_rpm / shape[0];
    c[0] = context.friction_slope(p) * std::exp(-x * x);
  };
  return f;
}

DriveFamily load_dependent_friction() {
  DriveFamily f;
  f.id = "load_dependent_friction";
  f.description =
      "the flanks' friction coefficient changes with load: + value (T / T_most)^exponent, T_most the "
      "bench's largest torque at the input";
  f.cause = "lubricant film under pressure, elastic deformation of teeth and housing";
  f.correction = "stiffness, viscosity; design at the load that counts";
  f.parameters = {"value"};
  f.shape_names = {"exponent"};
  f.shape_continuous = {true};
  f.preference = 2;
  f.shapes = [](const DriveContext&) { return Shapes{{0.3}, {0.5}, {0.75}, {1.0}, {1.4}, {2.0}}; };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const double part = std::max(p.load_nm, 0.0) / context.table.most_load_nm;
    c[0] = context.friction_slope(p) * std::pow(part, shape[0]);
  };
  return f;
}

DriveFamily temperature_viscosity() {
  DriveFamily f;
  f.id = "temperature_viscosity";
  f.description =
      "viscous drag that thins as the drive warms: nm_per_rpm exp(-per_c (t - the bench's mean))";
  f.cause = "viscosity of the lubricant";
  f.correction = "warm up, or a lubricant of higher viscosity index";
  f.parameters = {"nm_per_rpm"};
  f.shape_names = {"per_c"};
  f.shape_continuous = {true};
  f.only_positive = true;
  f.preference = 2;
  f.shapes = temperature_rates;
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const Shape& shape) {
    return p.speed_rpm * thinning(context, p, shape[0]);
  });
  return f;
}

DriveFamily temperature_drag() {
  DriveFamily f = temperature_viscosity();
  f.id = "temperature_drag";
  f.description = "drag that falls as the drive warms: torque_nm exp(-per_c (t - the bench's mean))";
  f.cause = "stiff grease, seals";
  f.correction = "softer grease; warm up";
  f.parameters = {"torque_nm"};
  f.evaluate = loss([](const DriveContext& context, const BenchPoint& p, const Shape& shape) {
    return thinning(context, p, shape[0]);
  });
  return f;
}

DriveFamily direction_dependent_friction() {
  DriveFamily f;
  f.id = "direction_dependent_friction";
  f.description = "the flanks rub more when the output drives: friction backward less forward";
  f.cause = "friction of approach above that of recess, edges of the tips, lubrication";
  f.correction = "tip relief; more recess than approach";
  f.parameters = {"difference"};
  f.preference = 3;
  f.shapes = [](const DriveContext& context) {
    return context.table.has(true) && context.table.has(false) ? Shapes{{}} : Shapes{};
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape&, double* c) {
    c[0] = context.friction_slope(p) * (p.forward ? -0.5 : 0.5);
  };
  return f;
}

DriveFamily mesh_friction() {
  DriveFamily f;
  f.id = "mesh_friction";
  f.description = "one mesh rubs otherwise than designed: its coefficient less the others'";
  f.cause = "that mesh's lubricant, finish or damage";
  f.correction = "inspect that mesh";
  f.parameters = {"difference"};
  f.shape_names = {"mesh"};
  f.preference = 4;
  f.shapes = [](const DriveContext& context) {
    Shapes shapes;
    if (context.model.meshes.size() > 1)
      for (std::size_t k = 0; k < context.model.meshes.size(); ++k)
        shapes.push_back({static_cast<double>(k + 1)});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const DriveEfficiency& slope = context.mesh_slopes[static_cast<std::size_t>(shape[0]) - 1];
    c[0] = context.gain(p) * p.driving_nm * (p.forward ? slope.forward : slope.backward);
  };
  return f;
}

DriveFamily angle_periodic_friction() {
  DriveFamily f;
  f.id = "angle_periodic_friction";
  f.description = "the loss torque at the input comes and goes with the angle";
  f.cause = "eccentric or bent member of that order, planet that carries more, cogging";
  f.correction = "measure the member of that order; assemble it turned";
  f.parameters = {"amplitude_nm", "phase_deg"};
  f.shape_names = {"order", "with_load"};
  f.form = DriveForm::kWave;
  f.preference = 1;
  f.shapes = [](const DriveContext& context) {
    Shapes shapes;
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
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const double size = -context.lever(p) *
                        (shape[1] != 0.0 ? p.load_nm / context.table.most_load_nm : 1.0);
    c[0] = size * std::cos(shape[0] * p.angle_rad);
    c[1] = size * std::sin(shape[0] * p.angle_rad);
  };
  return f;
}

}  // namespace

std::vector<DriveFamily> drive_loss_effects() {
  return {friction_coefficient(), drag_torque(), viscous_drag(), bearing_friction(), bearing_load(),
          stribeck_friction(), mixed_friction(), load_dependent_friction(), temperature_viscosity(),
          temperature_drag(), direction_dependent_friction(), mesh_friction(),
          angle_periodic_friction()};
}

}  // namespace trueflank::loop
