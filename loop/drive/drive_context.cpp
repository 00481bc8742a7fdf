// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_context.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {

double faded(double speed_rpm, double scale_rpm, double exponent) {
  const double x = speed_rpm / scale_rpm;
  return std::exp(exponent == 1.0 ? -x : -x * x);
}

double DriveContext::friction(const BenchPoint& p) const {
  double mu = designed_friction(p) + state.shift + (p.forward ? -0.5 : 0.5) * state.difference;
  if (state.load_value != 0.0)
    mu += state.load_value *
          std::pow(std::max(load_nm(p), 0.0) / table.most_load_nm, state.load_exponent);
  if (state.mixed_value != 0.0)
    mu += state.mixed_value * faded(p.speed_rpm, state.mixed_speed_rpm, state.mixed_exponent);
  if (state.speed_share != 0.0)
    mu += (designed_friction(p) + state.shift) * state.speed_share *
          course_of_speed(p.speed_rpm, state.speed_bend);
  return mu;
}

double DriveContext::course_of_speed(double speed_rpm, double bend) const {
  constexpr double kLeast = 0.005;  // of the largest: no power of a standing drive
  const double least = kLeast * table.most_speed_rpm,
               middle = std::sqrt(std::max(table.least_speed_rpm, least) * table.most_speed_rpm);
  return std::expm1(-bend * std::log(std::max(speed_rpm, least) / middle)) / bend;
}

double DriveContext::friction_slope(const BenchPoint& p) const {
  return row_friction_slopes.of(table.points, p, [&] {
    return gain(p) * p.driving_nm * last(p).secant(curve, designed_friction(p), friction(p));
  });
}

double DriveContext::mesh_slope(const BenchPoint& p, std::size_t mesh) const {
  const double designed = designed_friction(p);
  const auto found = state.mesh_value.find(mesh);
  return gain(p) * p.driving_nm *
         mesh_curves[mesh].secant(
             p.forward, designed,
             designed + (found == state.mesh_value.end() ? 0.0 : found->second));
}

double DriveContext::load_coordinate(const BenchPoint& p) const {
  return 2.0 * p.load_nm / std::max(table.most_load_nm, 1e-300) - 1.0;
}

double DriveContext::speed_coordinate(const BenchPoint& p) const {
  if (p.known_speed_rpm == p.speed_rpm) return p.known_speed_coordinate;
  const double most = table.most_speed_rpm, least = table.least_speed_rpm;
  if (!(most > least)) return 0.0;
  if (least > 0.1 * most) return 2.0 * (p.speed_rpm - least) / (most - least) - 1.0;
  // Friction changes most at the low end of a wide range.
  const double start = 0.05 * most;
  return last_speed_coordinates.at(p.speed_rpm, [&](double speed_rpm) {
    return 2.0 * std::log((start + speed_rpm) / (start + least)) /
               std::log((start + most) / (start + least)) -
           1.0;
  });
}

double DriveContext::temperature_coordinate(const BenchPoint& p) const {
  if (!table.has_temperature || !(table.temperature_span_c > 0.0)) return 0.0;
  return 2.0 * (p.temperature_c - table.mean_temperature_c) / table.temperature_span_c;
}

double DriveContext::quantity_at(double over, double coordinate) const {
  if (over == 0.0) return 0.5 * (coordinate + 1.0) * table.most_load_nm;
  if (over == 2.0) return table.mean_temperature_c + 0.5 * coordinate * table.temperature_span_c;
  const double most = table.most_speed_rpm, least = table.least_speed_rpm,
               part = 0.5 * (coordinate + 1.0);
  if (!(most > least)) return least;
  if (least > 0.1 * most) return least + part * (most - least);
  const double start = 0.05 * most;
  return last_speeds.at(part, [&](double of_range) {
    return (start + least) * std::pow((start + most) / (start + least), of_range) - start;
  });
}

double DriveContext::coordinate_of(double over, double quantity) const {
  BenchPoint p;
  p.load_nm = p.speed_rpm = p.temperature_c = quantity;
  return over == 0.0   ? load_coordinate(p)
         : over == 1.0 ? speed_coordinate(p)
                       : temperature_coordinate(p);
}

double DriveContext::share_of_range(const BenchPoint& p, double over) const {
  return share_at(over, over == 0.0 ? p.carried_nm : over == 1.0 ? p.speed_rpm : p.temperature_c);
}

double DriveContext::share_at(double over, double quantity) const {
  if (over == 0.0) return quantity / std::max(table.most_carried_nm, 1e-300);
  if (over == 2.0)
    return (quantity - table.least_temperature_c) / std::max(table.temperature_span_c, 1e-300);
  return (quantity - table.least_speed_rpm) /
         std::max(table.most_speed_rpm - table.least_speed_rpm, 1e-300);
}

double DriveContext::quantity_at_share(double over, double share) const {
  if (over == 0.0) return share * table.most_carried_nm;
  if (over == 2.0) return table.least_temperature_c + share * table.temperature_span_c;
  return table.least_speed_rpm + share * (table.most_speed_rpm - table.least_speed_rpm);
}

double DriveContext::least_share(double over) const {
  return over == 0.0 ? table.least_carried_nm / std::max(table.most_carried_nm, 1e-300) : 0.0;
}

std::vector<EfficiencyCurve> mesh_curves(const DriveModel& model) {
  std::vector<EfficiencyCurve> curves;
  for (std::size_t k = 0; k < model.meshes.size() && model.meshes.size() > 1; ++k)
    curves.emplace_back(model, k);
  return curves;
}

double predicted_nm(const DriveModel& model, const EfficiencyCurve& curve, const BenchPoint& p) {
  const double efficiency = curve.at(p.forward, model.friction_at(p.at()));
  double known = 0.0;
  if (model.losses)
    known = loss_torque_nm(*model.losses, p.at(), p.forward ? efficiency * p.load_nm : p.load_nm);
  if (p.forward) return model.ratio * efficiency * (p.driving_nm - known);
  return efficiency * p.driving_nm / model.ratio - known;
}

}  // namespace trueflank::loop
