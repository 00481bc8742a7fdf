// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"
#include "trueflank/loop/drive/forms_of_rows/forms_of_rows.h"

// A short loss that comes again every so many degrees of the input, whatever shaft has no turn of
// it: a pit in a ring that every ball runs over.
namespace trueflank::loop::drive_effects {

double place_of_pit(const BenchTable& table, const BenchPoint& p, const DriveShape& s) {
  const auto& all = table.every_row();
  const double middle = 0.5 * (all.front().angle_rad + all.back().angle_rad),
               order = order_of_pits(table, s),
               off = order * (p.angle_rad - middle) / kTwoPi - s[kPitCentre];
  return off - std::round(off);
}

double order_of_pits(const BenchTable& table, const DriveShape& s) {
  return s[kPitOrder] + s[kPitSlip] / std::max(1.0, table.turns);
}

namespace {

/// Of the first one from the angle 0 on [turns of the input].
double first_pit(const BenchTable& table, const DriveShape& s) {
  BenchPoint at_zero;
  at_zero.angle_rad = 0.0;
  double before = -place_of_pit(table, at_zero, s);
  if (before < 0.0) before += 1.0;
  return before / order_of_pits(table, s);
}

/// Of a period to either side: wider is a wave.
constexpr double kWidestPit = 0.2;

std::vector<DriveShape> pits_about(const DriveShape* about) {
  std::vector<DriveShape> shapes;
  if (about == nullptr) return shapes;
  const double half = (*about)[kPitHalf];
  const std::vector<double> edges = coarse_steps(0.004 * half, 0.4 * half);
  for (const double slip : coarse_steps(0.004, 0.15))
    for (const double begin : edges)
      for (const double end : edges) {
        const double wide = half + 0.5 * (end - begin);
        if (!(wide > 0.0 && wide < kWidestPit)) continue;
        shapes.push_back(*about);
        shapes.back()[kPitSlip] += slip;
        shapes.back()[kPitCentre] += 0.5 * (begin + end);
        shapes.back()[kPitHalf] = wide;
      }
  return shapes;
}

std::string pits_told(const DriveContext& context, const DriveShape& s, double amount,
                      const std::vector<Parameter>& figures) {
  const bool sharp = s[kPitSharp] != 0.0;
  return "a short loss at the input that comes again every " +
         with_interval(figures[1], " degrees of the input") + " (" +
         printed("%.4g times a turn", order_of_pits(context.table, s)) +
         ", which is no turn of a shaft): " + with_interval(figures[0], " N m") +
         (amount > 0.0 ? " more" : " less") +
         (sharp ? " over " + with_interval(figures[3], " degrees") + " each, first from "
                : ", half of that " + with_interval(figures[3], " degrees") +
                      " to either side, first at ") +
         with_interval(figures[2], " degrees") + (sharp ? " on" : "") +
         " (a pit in a ring of a bearing that every ball runs over, a slip ring?)";
}

}  // namespace

DriveFamily unnamed_pits() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "slip", "centre", "half_width", "sharp"};
  f.preference = 8;
  f.stands_alone = true;
  f.dearer = kDearerForms;
  f.falls_in_steps = true;
  f.comes_again_over_the_angle = true;
  f.shape_values = {{},
                    {.continuous = true, .is_place = true, .reach = 0.05},
                    {.continuous = true, .is_place = true, .reach = 0.03},
                    {.continuous = true,
                     .limits = [](const DriveContext&) { return std::pair(0.004, kWidestPit); }},
                    {}};
  f.shapes = no_shapes;
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kPitSharp]); };
  f.all_shapes = [](const DriveContext&, const DriveShape* about) { return pits_about(about); };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double x = place_of_pit(context.table, p, s) / s[kPitHalf],
                 size = s[kPitSharp] != 0.0 ? (std::abs(x) <= 1.0 ? 1.0 : 0.0)
                        : x * x < 40.0      ? std::exp2(-x * x)
                                            : 0.0;
    c[0] = size == 0.0 ? 0.0 : size * changed_nm(context, p, double(kDrag));
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double every = 360.0 / order_of_pits(context.table, s),
                 at = 360.0 * first_pit(context.table, s);
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("every_deg", every)};
    if (s[kPitSharp] != 0.0) {
      figures.push_back(figure_of("from_deg", at - every * s[kPitHalf]));
      figures.push_back(figure_of("width_deg", 2.0 * every * s[kPitHalf]));
    } else {
      figures.push_back(figure_of("at_deg", at));
      figures.push_back(figure_of("half_width_deg", every * s[kPitHalf]));
    }
    return figures;
  };
  f.told = pits_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext* context) {
    return "that is short and comes again" +
           (context ? printed(" %.4g times a turn of the input", order_of_pits(context->table, s))
                    : std::string(" every so many degrees of the input"));
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
