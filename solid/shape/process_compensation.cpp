// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/process_compensation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/solid/shape/bed_chamfer.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

Error does_not_exist(const std::string& part, double offset_mm, const std::string& why) {
  return {.code = ErrorCode::kInfeasible,
          .message = part + ": nothing is left where its walls are moved by the process: " + why,
          .key = "made.process",
          .value = trimmed_number(um_from_mm(offset_mm)) + " um",
          .remedy = "a process with less horizontal_expansion_mm"};
}

/// What the moved outlines refer to.
struct MovedProfiles {
  std::deque<ToothProfile> teeth;
  std::deque<InsetProfile> bed_chamfers;
};

class Compensator {
 public:
  Compensator(const PartShapes& shapes, const Process& process)
      : process_(process) {
    result_.shapes = shapes;
  }

  Result<CompensatedShapes> run() {
    for (PartShape& part : result_.shapes.parts)
      for (Slab& slab : part.slabs) {
        if (auto ok = offset(part.name, slab.outer, false); !ok) return fail(std::move(ok.error()));
        for (Outline& hole : slab.holes)
          if (auto ok = offset(part.name, hole, true); !ok) return fail(std::move(ok.error()));
      }
    if (process_.elephant_foot_mm > 0.0) add_bed_chamfers();
    result_.shapes.kept.push_back(std::move(profiles_));
    return std::move(result_);
  }

 private:
  void add_bed_chamfers() {
    const double depth = process_.elephant_foot_mm;
    const double height = process_.elephant_foot_height_mm > 0.0 ? process_.elephant_foot_height_mm : depth;
    for (PartShape& part : result_.shapes.parts)
      if (auto note = add_bed_chamfer(part, depth, height, profiles_->bed_chamfers))
        result_.notes.push_back(std::move(*note));
  }

  Status offset(const std::string& part, Outline& outline, bool hole) {
    const double inwards = process_.horizontal_expansion_mm;
    const double outwards = hole ? inwards : -inwards;  // from the outline's own inside
    if (!std::holds_alternative<ToothedOutline>(outline)) {
      outline = grown(std::move(outline), outwards);
      if (!(extent(outline).inner_radius_mm > 0.0))
        return fail(does_not_exist(part, inwards, "a hole closes"));
      return {};
    }
    auto& toothed = std::get<ToothedOutline>(outline);
    if (const auto known = result_.moved.find(toothed.profile); known != result_.moved.end()) {
      toothed.profile = known->second;
      return {};
    }
    auto profile = ToothProfile::make(offset_gear(toothed.profile->gear(), inwards));
    if (!profile) return fail(does_not_exist(part, inwards, profile.error().message));
    profiles_->teeth.push_back(std::move(*profile));
    result_.moved[toothed.profile] = &profiles_->teeth.back();
    toothed.profile = &profiles_->teeth.back();
    return {};
  }

  const Process& process_;
  std::shared_ptr<MovedProfiles> profiles_ = std::make_shared<MovedProfiles>();
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
