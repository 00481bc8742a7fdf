// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"

#include "trueflank/base/number_text.h"


namespace trueflank::loop {

double CalibratedLosses::at_reference(double amount, double rate_per_c) const {
  return amount * std::exp(-rate_per_c * (losses.reference_c - bench_temperature_c));
}

bool CalibratedLosses::add(double& amount, double more, double& shape, double its_shape) {
  if (amount != 0.0 && std::abs(shape - its_shape) > 1e-9 * std::max(1.0, std::abs(its_shape)))
    return false;
  amount += more;
  shape = its_shape;
  return true;
}

}  // namespace trueflank::loop

namespace trueflank::loop::drive_effects {

std::vector<DriveShape> where_rows_follow_each_other(const DriveContext& context) {
  constexpr int kFewestUnits = 8;
  return context.table.units >= kFewestUnits ? std::vector<DriveShape>{{}} : std::vector<DriveShape>{};
}

std::vector<DriveShape> speed_shapes(const DriveContext& context) {
  std::vector<DriveShape> shapes;
  const double most = context.table.most_speed_rpm;
  // A scale beyond the range is a slope, one below the slowest set points is not seen.
  for (double part : {0.02, 0.04, 0.07, 0.11, 0.16, 0.23, 0.32, 0.45})
    if (part * most > 0.3 * context.table.least_speed_rpm) shapes.push_back({part * most});
  if (!(most > 3.0 * context.table.least_speed_rpm)) shapes.clear();
  return shapes;
}

std::pair<double, double> speed_limits(const DriveContext& context) {
  return {0.3 * context.table.least_speed_rpm + 1e-3 * context.table.most_speed_rpm,
          0.7 * context.table.most_speed_rpm};
}

std::vector<DriveShape> rate_shapes(const DriveContext& context) {
  if (!context.table.has_temperature || context.table.temperature_span_c < 3.0) return {};
  return {{0.005}, {0.01}, {0.018}, {0.027}, {0.04}, {0.06}, {0.09}};
}

std::pair<double, double> rate_limits(const DriveContext&) { return {0.002, 0.2}; }

double thinning(const DriveContext& context, const BenchPoint& p, double rate) {
  return std::exp(-rate * (p.temperature_c - context.table.mean_temperature_c));
}

std::vector<DriveReference> mean_temperature(const DriveContext& context) {
  return {{"reference_c", context.table.mean_temperature_c}};
}

bool can_be_friction(const DriveModel& model, double change) {
  return model.friction + change > 0.0 && model.friction + change < kMostFriction;
}

std::string short_text(double value) { return printed("%.4g", value); }

std::string wave_in_words(const DriveModel& model, double order) {
  std::string text = "in a wave of order " + short_text(order) + " per input turn";
  for (const MemberOrder& member : model.orders)
    if (std::abs(member.order - order) < 1e-6 * std::max(1.0, order)) return text + " (" + member.member + ")";
  return text;
}

std::vector<TermKey> drive_term_keys() {
  using Kind = TermKey::Kind;
  return {{"load_degree"}, {"speed_degree"}, {"temperature_degree"}, {"order", Kind::kNumber},
          {"directions", Kind::kWord, {"equal", "opposite"}}};
}

DriveFamily without_a_name() {
  DriveFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.named = false;
  f.preference = 6;
  f.term_keys = drive_term_keys();
  f.not_carried = "a description without a cause";
  return f;
}

double coordinate(const DriveContext& context, const BenchPoint& p, double over) {
  return over == 0.0   ? context.load_coordinate(p)
         : over == 1.0 ? context.speed_coordinate(p)
                       : context.temperature_coordinate(p);
}

const char* name_of_quantity(double over) {
  return over == 0.0 ? "load" : over == 1.0 ? "speed" : "temperature";
}

}  // namespace trueflank::loop::drive_effects
