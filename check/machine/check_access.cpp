// SPDX-License-Identifier: GPL-3.0-or-later
//
// A key is a cylinder as wide as the screw's head, from the head to infinity. It is compared with
// every body that is there when the screw is tightened: those of the unit that the screw belongs
// to, up to its step. A set screw's key comes from the side.
#include "trueflank/check/machine/check_access.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/machine/check_bearings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/solid/measure/body_layers.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank {
namespace {

/// Longer than any gearbox.
constexpr double kFar_mm = 1e4;
/// An insert stands on the axis of its screw to within this.
constexpr double kOnAxis_mm = 1e-3;

using Bodies = std::vector<std::size_t>;

class Access {
 public:
  Access(const GearTrain& train, const MachineLayout& layout, const PartShapes& shapes,
         const AssemblyOrder& order)
      : train_(train), m_(layout), shapes_(shapes), order_(order) {}

  [[nodiscard]] Finding of_group(const ScrewGroup& group) const {
    const std::string key = "a key of " + number_text(group.screw.hex_mm, 1) + " mm";
    const double side = -group.way * m_.way;  // of the heads, along z
    double room = kFar_mm;
    std::string near;
    bool held = true;
    for (const AssemblyUnit& unit : order_.units) {
      Bodies there;
      for (const AssemblyStep& step : unit.steps) {
        there.insert(there.end(), step.bodies.begin(), step.bodies.end());
        if (step.unit >= 0) continue;  // tightened when that unit was made
        for (const std::size_t screw : step.bodies) {
          if (!is_of(screw, "screw_", group)) continue;
          held = held && is_held(screw, group, there);
          const auto [gap, body] = least_gap(key_on(screw, group, side), there, screw);
          if (gap >= room) continue;
          room = gap;
          near = body;
        }
      }
    }
    const bool clear = room > 0.0 && held;
    const std::string where = side > 0.0 ? "above" : "below";
    Finding finding = judged(
        {.id = "tool_access",
         .where = group.what,
         .value = held ? room : -1.0,
         .limit = 0.0,
         .unit = "mm",
         .message = !held ? "what the screws " + group.screw.name +
                                " turn into is not there yet when they are put in"
                    : clear ? key + " reaches every screw from " + where + " when it is put in" +
                                  (room < kFar_mm ? ", " + mm_text(room) + " beside " + near : "")
                            : key + " does not get to the screws from " + where + ": " + near +
                                  " stands " + mm_text(-room) + " in its way",
         .cure = "another order of assembly, or smaller heads: another screw in [fasteners]"},
        1e-9);
    if (!clear) finding.status = CheckStatus::kFail;
    return finding;
  }

  /// Its key comes across the axis: nothing but gear and motor may be there at its height.
  [[nodiscard]] Finding of_set_screw() const {
    const auto& s = m_.set_screw;
    const HeightRange across =
        m_.z({s.axis_mm - 0.5 * s.screw.diameter_mm, s.axis_mm + 0.5 * s.screw.diameter_mm});
    const std::string gear = train_.topology().name_of(train_.topology().input);
    std::string blocked = "nothing that it could be reached past";
    const AssemblyUnit& whole = order_.units.back();
    Bodies there;
    for (const AssemblyStep& step : whole.steps) {
      const bool on_shaft = has_gear(step, gear);
      there.insert(there.end(), step.bodies.begin(), step.bodies.end());
      if (!on_shaft) continue;
      blocked.clear();
      for (const std::size_t body : there)
        if (blocked.empty() && !is_motor(body) && name_of(body) != gear && stands_at(body, across))
          blocked = shapes_.assembly[body].name;
      break;
    }
    Finding finding{
        .id = "tool_access", .where = "set screw", .value = 0.0, .limit = 0.0, .margin = 0.0};
    finding.message = "a key of " + number_text(set_screw_key_mm(s), 1) +
                      " mm reaches the set screw from the side before the housing goes over the " +
                      gear;
    if (blocked.empty()) return finding;
    finding.status = CheckStatus::kFail;
    finding.margin = -1.0;
    finding.message = "no key reaches the set screw: " + blocked + " is in its way when the " +
                      gear + " goes on the shaft";
    finding.cure = "set_screw = \"never\" in [fasteners], and retaining compound";
    return finding;
  }

 private:
  [[nodiscard]] const PartShape& part(std::size_t body) const {
    return shapes_.parts[static_cast<std::size_t>(shapes_.assembly[body].part)];
  }
  [[nodiscard]] const std::string& name_of(std::size_t body) const { return part(body).name; }
  [[nodiscard]] bool is_motor(std::size_t body) const {
    return name_of(body).starts_with("motor_");
  }
  [[nodiscard]] bool is_of(std::size_t body, const char* kind, const ScrewGroup& group) const {
    return name_of(body).starts_with(kind) && name_of(body).ends_with("_" + group.what);
  }
  [[nodiscard]] Point2 axis_of(std::size_t body) const {
    const auto& move = shapes_.assembly[body].translation_mm;
    return {move[0], move[1]};
  }
  [[nodiscard]] bool has_gear(const AssemblyStep& step, const std::string& gear) const {
    return std::any_of(step.bodies.begin(), step.bodies.end(),
                       [&](std::size_t body) { return name_of(body) == gear; });
  }
  [[nodiscard]] bool stands_at(std::size_t body, const HeightRange& z) const {
    const auto layers = body_layers(part(body), shapes_.assembly[body]);
    return std::any_of(layers.begin(), layers.end(), [&](const BodyLayer& layer) {
      return layer.z.lower_mm < z.upper_mm && layer.z.upper_mm > z.lower_mm;
    });
  }

  /// Its insert, or the motor, is there.
  [[nodiscard]] bool is_held(std::size_t screw, const ScrewGroup& group,
                             const Bodies& there) const {
    return std::any_of(there.begin(), there.end(), [&](std::size_t body) {
      if (std::isnan(group.insert_mm)) return is_motor(body);
      return is_of(body, "insert_", group) && (axis_of(body) - axis_of(screw)).norm() < kOnAxis_mm;
    });
  }

  [[nodiscard]] BodyLayer key_on(std::size_t screw, const ScrewGroup& group, double side) const {
    const HeightRange head = m_.z({group.head_top_mm(), group.head_top_mm()});
    const HeightRange z = side > 0.0 ? HeightRange{head.upper_mm, head.upper_mm + kFar_mm}
                                     : HeightRange{head.lower_mm - kFar_mm, head.lower_mm};
    return {z, {axis_of(screw), 0.5 * group.screw.head_diameter_mm}, {}};
  }

  [[nodiscard]] std::pair<double, std::string> least_gap(const BodyLayer& key, const Bodies& there,
                                                         std::size_t screw) const {
    std::pair<double, std::string> least{kFar_mm, ""};
    for (const std::size_t body : there) {
      if (body == screw) continue;
      for (const BodyLayer& layer : body_layers(part(body), shapes_.assembly[body])) {
        if (layer.z.upper_mm <= key.z.lower_mm || layer.z.lower_mm >= key.z.upper_mm) continue;
        if (const double gap = gap_at_rest_mm(key, layer); gap < least.first)
          least = {gap, shapes_.assembly[body].name};
      }
    }
    return least;
  }

  const GearTrain& train_;
  const MachineLayout& m_;
  const PartShapes& shapes_;
  const AssemblyOrder& order_;
};

}  // namespace

Findings check_access(const GearTrain& train, const MachineLayout& layout, const PartShapes& shapes,
                      const AssemblyOrder& order) {
  if (!order.exists()) return {};
  const Access access(train, layout, shapes, order);
  Findings findings;
  for (const ScrewGroup* group :
       {&layout.motor_screws, &layout.housing_screws, &layout.carrier_screws, &layout.output_screws,
        &layout.retainer_screws})
    if (group->fits() && !group->at.empty()) findings.push_back(access.of_group(*group));
  if (layout.set_screw.is_there()) findings.push_back(access.of_set_screw());
  return findings;
}

}  // namespace trueflank
