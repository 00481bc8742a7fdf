// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/drive_calibration.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/drive/calibrated_losses.h"
#include "trueflank/loop/result/describe.h"

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
      : closed_(closed),
        design_(design),
        taken_{.losses = design.losses.value_or(LossesDesign{}),
               .bench_temperature_c = closed.table.mean_temperature_c,
               .bench_load_nm = closed.table.most_load_nm} {}

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
    design_.losses = taken_.losses;
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
    taken_.losses.load_nm = rounded(middle(load));
    taken_.losses.input_speed_rpm = rounded(middle(speed));
    if (closed_.table.has_temperature) taken_.losses.reference_c = closed_.table.mean_temperature_c;
  }

  void leave(const std::string& what) { say_once(notes_, "calibrated.toml does not carry " + what); }

  void take(const DriveEffect& effect, double b) {
    const DriveFamily& family = *effect.family;
    if (!family.calibrate)
      leave(family.not_carried.empty() ? family.id : family.id + ": " + family.not_carried);
    else if (family.calibrate(taken_, effect.shape, b))
      carried_ = true;
    else
      leave(family.id + ": " +
            (family.not_carried.empty()
                 ? "the design's [losses] already hold another of its kind with another shape"
                 : family.not_carried));
  }

  void settle_friction() {
    const double before = design_.friction;
    const double backward = taken_.losses.backward_friction.value_or(before);
    design_.friction = std::clamp(before + taken_.friction_shift - 0.5 * taken_.friction_difference, 0.0, 1.0);
    if (taken_.friction_difference != 0.0 || taken_.losses.backward_friction)
      taken_.losses.backward_friction = std::clamp(backward + taken_.friction_shift + 0.5 * taken_.friction_difference, 0.0, 1.0);
  }

  const DriveLoop& closed_;
  GearboxDesign design_;
  CalibratedLosses taken_;
  bool carried_ = false;
  std::vector<std::string> notes_;
};

}  // namespace

CalibratedDesign calibrated_design(const GearboxDesign& design, const DriveLoop& closed) {
  return Calibration(design, closed).run();
}

}  // namespace trueflank::loop
