// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/process_compensation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/units.h"

namespace trueflank {
namespace {

Error does_not_exist(const std::string& part, double offset_mm, const std::string& why) {
  return {.code = ErrorCode::kInfeasible,
          .message = part + ": nothing is left where its walls are moved by the process: " + why,
          .key = "made.process",
          .value = std::to_string(um_from_mm(offset_mm)) + " um",
          .remedy = "a process with less horizontal_expansion_mm and elephant_foot_mm"};
}

class Compensator {
 public:
  Compensator(const PartShapes& shapes, const Process& process)
      : process_(process) {
    result_.shapes = shapes;
  }

  Result<CompensatedShapes> run() {
    for (PartShape& part : result_.shapes.parts) {
      std::vector<Slab> slabs;
      for (const Slab& slab : part.slabs)
        for (const Slab& piece : stepped(slab)) {
          auto moved = offset_slab(part.name, piece);
          if (!moved) return fail(std::move(moved.error()));
          slabs.push_back(std::move(*moved));
        }
      part.slabs = std::move(slabs);
    }
    return std::move(result_);
  }

 private:
  /// How far walls move into the material between two heights of a part.
  [[nodiscard]] double inwards_mm(double z_lower, double z_upper) const {
    const double middle = 0.5 * (z_lower + z_upper);
    double foot = 0.0;
    if (process_.elephant_foot_height_mm > middle)
      foot = process_.elephant_foot_mm * (1.0 - middle / process_.elephant_foot_height_mm);
    return process_.horizontal_expansion_mm + foot;
  }

  /// The slab cut into layers as far as the elephant foot reaches.
  [[nodiscard]] std::vector<Slab> stepped(const Slab& slab) const {
    const double top = std::min(process_.elephant_foot_height_mm, slab.z_upper_mm);
    const double layer = process_.layer_mm > 0.0 ? process_.layer_mm : process_.elephant_foot_height_mm;
    if (process_.elephant_foot_mm <= 0.0 || top <= slab.z_lower_mm) return {slab};
    std::vector<Slab> steps;
    const int count =
        std::max(1, static_cast<int>(std::lround((top - slab.z_lower_mm) / layer)));
    for (int i = 0; i < count; ++i) {
      Slab step = slab;
      step.z_lower_mm = slab.z_lower_mm + (top - slab.z_lower_mm) * i / count;
      step.z_upper_mm = slab.z_lower_mm + (top - slab.z_lower_mm) * (i + 1) / count;
      steps.push_back(std::move(step));
    }
    if (top < slab.z_upper_mm) {
      steps.push_back(slab);
      steps.back().z_lower_mm = top;
    }
    return steps;
  }

  Result<Slab> offset_slab(const std::string& part, Slab slab) {
    const double inwards = inwards_mm(slab.z_lower_mm, slab.z_upper_mm);
    if (auto ok = offset(part, slab.outer, inwards, false); !ok) return fail(std::move(ok.error()));
    for (Outline& hole : slab.holes)
      if (auto ok = offset(part, hole, inwards, true); !ok) return fail(std::move(ok.error()));
    return slab;
  }

  Status offset(const std::string& part, Outline& outline, double inwards, bool hole) {
    const double outwards = hole ? inwards : -inwards;  // from the outline's own inside
    if (auto* circle = std::get_if<CircleOutline>(&outline)) {
      circle->radius_mm += outwards;
      if (!(circle->radius_mm > 0.0)) return fail(does_not_exist(part, inwards, "a hole closes"));
      return {};
    }
    if (auto* bore = std::get_if<BoreOutline>(&outline)) {
      BoreDesign& b = bore->bore;
      b.diameter_mm += 2.0 * outwards;
      if (b.kind == BoreKind::kKeyway) b.keyway_width_mm += 2.0 * outwards;
      if (b.kind == BoreKind::kDFlat) b.d_flat_mm += 2.0 * outwards;
      if (!(b.diameter_mm > 0.0)) return fail(does_not_exist(part, inwards, "the bore closes"));
      return {};
    }
    auto& toothed = std::get<ToothedOutline>(outline);
    const bool straight = toothed.toothing().prismatic() && !toothed.toothing().has_deviation();
    if (!straight && process_.elephant_foot_mm > 0.0)
      return fail(Error{.code = ErrorCode::kUnsupported,
                        .message = part + ": the elephant foot is compensated for straight teeth "
                                          "without modifications and chamfers only",
                        .key = "made.process",
                        .remedy = "a process with elephant_foot_mm = 0; the slicer can do it"});
    auto profile = ToothProfile::make(offset_gear(toothed.profile->gear(), inwards));
    if (!profile) return fail(does_not_exist(part, inwards, profile.error().message));
    result_.profiles.push_back(std::move(*profile));
    toothed.profile = &result_.profiles.back();
    return {};
  }

  const Process& process_;
  CompensatedShapes result_;
};

}  // namespace

Gear offset_gear(Gear gear, double inwards_mm) {
  const double m = gear.normal_module_mm, share = inwards_mm / m;
  // a flank moved along its normal in the section by d: 2 d / cos alpha_t less on the reference circle
  gear.thinning_mm += 2.0 * inwards_mm / std::cos(transverse_pressure_angle_rad(gear));
  gear.rack.dedendum += share;
  gear.rack.root_radius = std::max(0.0, gear.rack.root_radius + share);
  gear.tip_radius_mm += gear.kind == GearKind::kExternal ? -inwards_mm : inwards_mm;
  gear.tip_rounding_mm = std::max(0.0, gear.tip_rounding_mm - inwards_mm);
  if (gear.cutter) gear.cutter->tip_radius = std::max(0.0, gear.cutter->tip_radius + share);
  return gear;
}

Result<CompensatedShapes> compensated(const PartShapes& shapes, const Process& process) {
  return Compensator(shapes, process).run();
}

}  // namespace trueflank
