// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/geometry/scalar_root.h"
#include "trueflank/loop/drive/close_drive_loop.h"

// Two efficiencies and a starting torque: too few to single out an effect, enough to say what each would
// have to be, and at which load.
namespace trueflank::loop {
namespace {

using Function = std::function<double(double)>;

/// First sign change in low ... high, by steps and bisection; undefined values (NaN) are passed over.
std::optional<double> root_of(const Function& f, double low, double high) {
  constexpr int kSteps = 80;
  double before = low, at_before = f(low);
  for (int i = 1; i <= kSteps; ++i) {
    const double here = low + (high - low) * i / kSteps;
    const double at_here = f(here);
    if (!std::isnan(at_before) && !std::isnan(at_here) && at_before * at_here <= 0.0) {
      const auto as_before = [&](double place) { return f(place) * at_before > 0.0; };
      const auto [last, first] = sides_of_change(as_before, before, here, 50);
      return 0.5 * (last + first);
    }
    before = here;
    at_before = at_here;
  }
  return std::nullopt;
}

constexpr double kMostFriction = 0.6;

class FewNumbers {
 public:
  FewNumbers(const DriveModel& model, const BenchData& data) : model_(model), data_(data) {
    for (const BenchQuantity& q : data.quantities) {
      switch (q.kind) {
        case BenchQuantityKind::kForwardEfficiency: forward_ = q.value; break;
        case BenchQuantityKind::kBackwardEfficiency: backward_ = q.value; break;
        case BenchQuantityKind::kReverseStartingTorque: start_nm_ = q.value; break;
      }
      if (q.kind != BenchQuantityKind::kReverseStartingTorque && !std::isnan(q.load_nm))
        load_nm_ = q.load_nm;
    }
  }

  DriveLoop close() {
    const DriveEfficiency designed = model_.at(model_.friction);
    LoopResult& r = done_.result;
    r.gear = "drive";
    r.unit = kNewtonMetres;
    r.notes = data_.notes;
    r.observations = static_cast<int>(data_.quantities.size());
    r.noise = kNaN;
    r.before = figures(designed, 0.0);
    r.after = r.before;
    r.structure_p_value = r.structure_left_p_value = kNaN;
    r.verdict = Verdict::kPartlyExplained;
    explain();
    conclude(designed);
    done_.model = model_;
    return std::move(done_);
  }

 private:
  struct Left {
    double points = kNaN, nm = kNaN;
  };
  [[nodiscard]] Left left_of(double forward, double backward, double start_nm) const {
    double sum = 0.0, count = 0.0;
    for (const auto& [measured, predicted] :
         {std::pair(forward_, forward), std::pair(backward_, backward)})
      if (!std::isnan(measured)) {
        sum += 1e4 * (measured - predicted) * (measured - predicted);
        count += 1.0;
      }
    return {count > 0.0 ? std::sqrt(sum / count) : kNaN,
            std::isnan(start_nm_) ? kNaN : std::abs(start_nm_ - start_nm)};
  }

  /// In N m only what has a load: the starting torque, and efficiencies measured at a known one.
  [[nodiscard]] ErrorFigures figures(const DriveEfficiency& e, double start_nm) const {
    double sum = 0.0, count = 0.0, most = 0.0;
    const auto add = [&](double error) {
      if (std::isnan(error)) return;
      sum += error * error;
      count += 1.0;
      most = std::max(most, std::abs(error));
    };
    add(start_nm_ - start_nm);
    add(load_nm_ * (1.0 - e.forward / forward_));
    add((backward_ - e.backward) * load_nm_ / model_.ratio);
    ErrorFigures f;
    f.rms = count > 0.0 ? std::sqrt(sum / count) : kNaN;
    f.max = most;
    f.rms_points = left_of(e.forward, e.backward, start_nm).points;
    return f;
  }

  void add(const std::string& id, std::vector<Parameter> parameters, double load_nm,
           double forward, double backward, double start_nm, const std::string& words) {
    PossibleExplanation p;
    p.id = id;
    p.parameters = std::move(parameters);
    p.load_nm = load_nm;
    const Left left = left_of(forward, backward, start_nm);
    p.left_points = left.points;
    p.left_nm = left.nm;
    const auto met = [&](const char* name, double measured, double predicted, double within) {
      if (!std::isnan(measured) && std::abs(measured - predicted) <= within) p.explains.emplace_back(name);
    };
    // Within half a unit of the last digit that such figures are given with.
    met("forward_efficiency", forward_, forward, 5e-4);
    met("backward_efficiency", backward_, backward, 5e-4);
    met("reverse_starting_torque_nm", start_nm_, start_nm, 0.025 * start_nm_);
    p.text = id + ": " + words +
             printed(" -> forward %.1f %%, backward %.1f %%, starting torque %.3g N m", 100.0 * forward,
                  100.0 * backward, start_nm);
    if (p.explains.empty()) p.text += "; meets none of the numbers";
    done_.result.possible.push_back(std::move(p));
  }

  void explain() {
    const bool both = !std::isnan(forward_) && !std::isnan(backward_);
    friction_alone();
    if (!std::isnan(start_nm_) && start_nm_ > 0.0) {
      drag_alone();
      if (both) drag_with_friction();
    }
    if (!both) return;
    direction();
    scale();
    if (!std::isnan(start_nm_) && start_nm_ > 0.0) offset();
  }

  void friction_alone() {
    const auto square = [&](double mu) {
      const DriveEfficiency e = model_.at(mu);
      return left_of(e.forward, e.backward, 0.0).points;
    };
    if (std::isnan(square(0.1))) return;
    double best = 0.0;
    for (int i = 0; i <= 240; ++i)
      if (const double mu = kMostFriction * i / 240.0; square(mu) < square(best)) best = mu;
    for (double step = kMostFriction / 480.0; step > 1e-6; step *= 0.5)
      for (const double mu : {best - step, best + step})
        if (mu >= 0.0 && square(mu) < square(best)) best = mu;
    const DriveEfficiency e = model_.at(best);
    add("friction_coefficient", {{"value", best, kNaN, kNaN}}, kNaN, e.forward, e.backward, 0.0,
        printed("%.4f, the best compromise, at any load", best));
  }

  /// Drag that holds the start at the output: T0 = T_start eta_b / G.
  [[nodiscard]] double drag_of(double mu) const { return start_nm_ * model_.at(mu).backward / model_.ratio; }
  [[nodiscard]] double forward_with(double mu, double drag_nm, double load_nm) const {
    return load_nm / (load_nm / model_.at(mu).forward + model_.ratio * drag_nm);
  }
  [[nodiscard]] double backward_with(double mu, double drag_nm, double load_nm) const {
    return model_.at(mu).backward - drag_nm * model_.ratio / load_nm;
  }

  void drag_alone() {
    const double mu = model_.friction, drag = drag_of(mu);
    if (std::isnan(load_nm_)) {
      // The load at which the backward efficiency would fall to what was measured.
      const double excess = model_.at(mu).backward - backward_;
      if (!(excess > 0.0)) return;
      const double load = drag * model_.ratio / excess;
      add("drag_torque", {{"torque_nm", drag, kNaN, kNaN}}, load, forward_with(mu, drag, load),
          backward_with(mu, drag, load), start_nm_,
          printed("%.3g N m at the input, friction as designed, if the backward test ran at %.2g N m of output "
               "torque", drag, load));
      return;
    }
    add("drag_torque", {{"torque_nm", drag, kNaN, kNaN}}, load_nm_, forward_with(mu, drag, load_nm_),
        backward_with(mu, drag, load_nm_), start_nm_,
        printed("%.3g N m at the input, friction as designed, at the %.3g N m of the test", drag, load_nm_));
  }

  void drag_with_friction() {
    if (!std::isnan(load_nm_)) return;
    const auto mismatch = [&](double mu) {
      const DriveEfficiency e = model_.at(mu);
      const double forward = 1.0 / forward_ - 1.0 / e.forward, backward = e.backward - backward_;
      return forward > 0.0 || backward > 0.0 ? forward - backward : kNaN;
    };
    const auto mu = root_of(mismatch, 0.0, kMostFriction);
    if (!mu) return drag_at_two_loads();
    const double drag = drag_of(*mu), gap = model_.at(*mu).backward - backward_;
    if (!(gap > 1e-6)) return;
    const double load = drag * model_.ratio / gap;
    add("friction_coefficient + drag_torque",
        {{"value", *mu, kNaN, kNaN}, {"torque_nm", drag, kNaN, kNaN}}, load,
        forward_with(*mu, drag, load), backward_with(*mu, drag, load), start_nm_,
        printed("friction %.4f and %.3g N m at the input, if both efficiencies were measured at %.2g N m of "
             "output torque", *mu, drag, load));
  }

  /// No one load meets both efficiencies: forward where the drag is nothing, backward at a light load.
  void drag_at_two_loads() {
    const auto mu = root_of([&](double m) { return model_.at(m).forward - forward_; }, 0.0, kMostFriction);
    if (!mu) return;
    const double drag = drag_of(*mu), gap = model_.at(*mu).backward - backward_;
    if (!(gap > 1e-6)) return;
    const double load = drag * model_.ratio / gap;
    add("friction_coefficient + drag_torque",
        {{"value", *mu, kNaN, kNaN}, {"torque_nm", drag, kNaN, kNaN}}, load, forward_,
        backward_with(*mu, drag, load), start_nm_,
        printed("friction %.4f and %.3g N m at the input, if backward was measured at %.2g N m of output torque "
             "and forward at loads far above; with both at one load they cannot", *mu, drag, load));
  }

  void direction() {
    const auto forward = root_of([&](double mu) { return model_.at(mu).forward - forward_; }, 0.0, kMostFriction);
    const auto backward = root_of([&](double mu) { return model_.at(mu).backward - backward_; }, 0.0, kMostFriction);
    if (!forward || !backward) return;
    add("direction_dependent_friction",
        {{"value_forward", *forward, kNaN, kNaN}, {"value_backward", *backward, kNaN, kNaN}}, kNaN,
        forward_, backward_, 0.0,
        printed("friction %.4f forward and %.4f backward, at any load", *forward, *backward));
    add("load_dependent_friction",
        {{"value_forward", *forward, kNaN, kNaN}, {"value_backward", *backward, kNaN, kNaN}}, kNaN,
        forward_, backward_, 0.0,
        printed("friction %.4f at the forward test's load and %.4f at the backward one's: only if the two ran "
             "at different loads (or speeds, or temperatures)", *forward, *backward));
  }

  void scale() {
    const auto mu = root_of(
        [&](double m) {
          const DriveEfficiency e = model_.at(m);
          return e.forward * e.backward - forward_ * backward_;
        },
        0.0, kMostFriction);
    if (!mu) return;
    const double factor = forward_ / model_.at(*mu).forward;
    add("torque_scale", {{"factor", factor, kNaN, kNaN}, {"value", *mu, kNaN, kNaN}}, kNaN,
        factor * model_.at(*mu).forward, model_.at(*mu).backward / factor, 0.0,
        printed("output torque reads %.4f times too much against the input's, with friction %.4f, at any "
             "load", factor, *mu));
  }

  /// A sensor that reads the starting torque at rest: o at the output.
  void offset() {
    if (!std::isnan(load_nm_)) return;
    const auto load_of = [&](double mu) {  // from the backward efficiency: eta_b (1 - o / W)
      const double part = 1.0 - backward_ / model_.at(mu).backward;
      return part > 0.0 ? start_nm_ / part : kNaN;
    };
    const auto mu = root_of(
        [&](double m) {
          const double load = load_of(m);
          return model_.at(m).forward * load / (load - start_nm_) - forward_;
        },
        0.0, kMostFriction);
    if (!mu) return;
    const double load = load_of(*mu);
    add("torque_offset", {{"offset_nm", start_nm_, kNaN, kNaN}, {"value", *mu, kNaN, kNaN}}, load,
        model_.at(*mu).forward * load / (load - start_nm_),
        model_.at(*mu).backward * (1.0 - start_nm_ / load), start_nm_,
        printed("output sensor reads %.3g N m at rest (and so does the starting torque), with friction %.4f, "
             "if the tests ran at %.2g N m of output torque", start_nm_, *mu, load));
  }

  void conclude(const DriveEfficiency& designed) {
    LoopResult& r = done_.result;
    r.structure_left = printed("the model as designed (friction %.3g) gives forward %.1f %%, backward %.1f %% "
                            "and no starting torque", model_.friction, 100.0 * designed.forward,
                            100.0 * designed.backward);
    if (!std::isnan(forward_) && forward_ > 1.0)
      r.structure_left += "; a forward efficiency above one is no friction but a torque scale or offset";
    if (!std::isnan(backward_) && backward_ > 1.0)
      r.structure_left += "; a backward efficiency above one is no friction but a torque scale or offset";
    r.structure_left += "; " + std::to_string(data_.quantities.size()) +
                        " numbers single out no effect: as many unknowns meet them as they are, each in "
                        "its own way";
    double low = 1e300, high = 0.0;
    for (const PossibleExplanation& p : r.possible)
      if (!std::isnan(p.load_nm)) {
        low = std::min(low, p.load_nm);
        high = std::max(high, p.load_nm);
      }
    r.measure_next.push_back(
        "a load sweep: forward and backward at the same ten or more output torques" +
        (high > 0.0 ? printed(", from none to well above %.2g N m", 10.0 * high) : std::string()) +
        ", each set point repeated. A drag costs less and less efficiency as the load grows, a friction or a "
        "torque scale the same at every load; a scale raises one direction and lowers the other");
    r.measure_next.push_back("zero readings of both torques at rest, to rule out torque_offset");
    r.measure_next.push_back(
        "torque_scale and direction_dependent_friction stay the same even in a load sweep: each torque "
        "against a lever and weights separates them");
  }

  const DriveModel& model_;
  const BenchData& data_;
  double forward_ = kNaN, backward_ = kNaN, start_nm_ = kNaN, load_nm_ = kNaN;
  DriveLoop done_{};
};

}  // namespace

ResultAll<DriveLoop> explain_quantities(const DriveModel& model, const BenchData& data) {
  return FewNumbers(model, data).close();
}

}  // namespace trueflank::loop
