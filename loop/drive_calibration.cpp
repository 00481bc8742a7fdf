// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive_calibration.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {
namespace {

constexpr double kLoaded = 0.2;

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? kNaN : values[values.size() / 2];
}

/// Four significant digits: an operating point is a choice, not a measurement.
double rounded(double value) {
  if (!(value > 0.0)) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  return std::round(value / step) * step;
}

class Calibration {
 public:
  Calibration(const GearboxDesign& design, const DriveLoop& closed)
      : closed_(closed), design_(design), losses_(design.losses.value_or(LossesDesign{})) {}

  CalibratedDesign run() {
    if (!design_.losses) set_point();
    for (std::size_t e = 0, column = 0; e < closed_.effects.size(); ++e) {
      take(closed_.effects[e], closed_.coefficients[column]);
      column += static_cast<std::size_t>(closed_.effects[e].columns());
    }
    CalibratedDesign result;
    result.notes = notes_;
    if (!carried_) return result;
    settle_friction();
    design_.losses = losses_;
    result.design = design_;
    return result;
  }

 private:
  void set_point() {
    std::vector<double> load, speed, temperature;
    for (const BenchPoint& p : closed_.table.points) {
      if (p.load_nm < kLoaded * closed_.table.most_load_nm) continue;
      load.push_back(p.forward ? p.driven_nm : p.driving_nm);
      speed.push_back(p.speed_rpm);
      temperature.push_back(p.temperature_c);
    }
    losses_.load_nm = rounded(middle(load));
    losses_.input_speed_rpm = rounded(middle(speed));
    if (closed_.table.has_temperature) losses_.reference_c = closed_.table.mean_temperature_c;
  }

  void leave(const std::string& what) { notes_.push_back("calibrated.toml does not carry " + what); }

  void take(const DriveEffect& effect, double b) {
    const std::string& id = effect.family->id;
    const double reference = closed_.table.mean_temperature_c;
    bool taken = true;
    if (id == "friction_coefficient") shift_ += b;
    else if (id == "direction_dependent_friction") difference_ += b;
    else if (id == "drag_torque") taken = add(losses_.drag_torque_nm, b, losses_.drag_per_c, 0.0);
    else if (id == "viscous_drag") taken = add(losses_.viscous_nm_per_rpm, b, losses_.viscous_per_c, 0.0);
    else if (id == "temperature_drag")
      taken = add(losses_.drag_torque_nm, b * at_reference(effect.shape[0], reference), losses_.drag_per_c,
                  effect.shape[0]);
    else if (id == "temperature_viscosity")
      taken = add(losses_.viscous_nm_per_rpm, b * at_reference(effect.shape[0], reference),
                  losses_.viscous_per_c, effect.shape[0]);
    else if (id == "bearing_friction") losses_.bearing_nm_at_1000_rpm += b;
    else if (id == "bearing_load_friction") losses_.bearing_load_share += b;
    else if (id == "stribeck_friction")
      taken = add(losses_.stribeck_torque_nm, b, losses_.stribeck_speed_rpm, effect.shape[0]);
    else if (id == "mixed_friction")
      taken = add(losses_.mixed_friction, b, losses_.mixed_friction_speed_rpm, effect.shape[0]);
    else if (id == "load_dependent_friction") {
      taken = add(losses_.load_friction, b, losses_.load_friction_exponent, effect.shape[0]);
      if (taken) losses_.load_friction_reference_nm = closed_.table.most_load_nm;
    } else {
      if (effect.family->is_loss && effect.family->named)
        leave(id == "angle_periodic_friction" ? id + ": it cancels over a turn" : id);
      else if (!effect.family->named) leave("unnamed structure");
      else leave(id + ": it is the bench's, not the drive's");
      return;
    }
    if (taken) carried_ = true;
    else leave(id + ": the design's [losses] already hold another of its kind with another shape");
  }

  [[nodiscard]] double at_reference(double rate, double reference_c) const {
    return std::exp(-rate * (losses_.reference_c - reference_c));
  }

  /// One amount with one shape: a second of another shape cannot stand beside it.
  static bool add(double& amount, double more, double& shape, double its_shape) {
    if (amount != 0.0 && std::abs(shape - its_shape) > 1e-9 * std::max(1.0, std::abs(its_shape)))
      return false;
    amount += more;
    shape = its_shape;
    return true;
  }

  void settle_friction() {
    const double before = design_.friction;
    const double backward = losses_.backward_friction.value_or(before);
    design_.friction = std::clamp(before + shift_ - 0.5 * difference_, 0.0, 1.0);
    if (difference_ != 0.0 || losses_.backward_friction)
      losses_.backward_friction = std::clamp(backward + shift_ + 0.5 * difference_, 0.0, 1.0);
  }

  const DriveLoop& closed_;
  GearboxDesign design_;
  LossesDesign losses_;
  double shift_ = 0.0, difference_ = 0.0;
  bool carried_ = false;
  std::vector<std::string> notes_;
};

}  // namespace

CalibratedDesign calibrated_design(const GearboxDesign& design, const DriveLoop& closed) {
  return Calibration(design, closed).run();
}

}  // namespace trueflank::loop
