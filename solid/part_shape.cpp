// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/part_shape.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/solid/carrier.h"
#include "trueflank/solid/outline_loop.h"

namespace trueflank {
namespace {

/// Least wall between two outlines, of the module: thinner it is no part of a gear.
constexpr double kLeastWall = 0.25;
/// Rim of a ring without an outer diameter: of the module, and at least in mm.
constexpr double kRim = 2.5;
constexpr double kLeastRim_mm = 2.0;
/// The neck of a compound planet stays this part of the module inside the smaller root circle.
constexpr double kNeckInset = 0.25;
/// The groove between the halves of a herringbone is cut this part of the module deeper than the roots.
constexpr double kGrooveInset = 0.1;
/// A layer gap below this is no gap that can be made.
constexpr double kLeastGap_mm = 0.01;

std::string text(double value_mm) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value_mm, std::chars_format::fixed, 3);
  return {buffer, end.ptr};
}

class ShapeBuilder {
 public:
  explicit ShapeBuilder(const GearTrain& train) : train_(train) {}

  ResultAll<PartShapes> build() {
    for (const TrainGear& gear : train_.gears) {
      if (gear.name == "planet2") continue;  // one body with planet1
      if (gear.name == "planet1" || gear.name == "planet")
        add_planets(gear);
      else
        add_single(gear);
    }
    for (Error& error : add_carrier(train_, shapes_)) errors_.push_back(std::move(error));
    if (!errors_.empty()) return fail_all(std::move(errors_));
    return std::move(shapes_);
  }

 private:
  void infeasible(std::string key, std::string message, std::string remedy) {
    errors_.push_back({.code = ErrorCode::kInfeasible,
                       .message = std::move(message),
                       .key = std::move(key),
                       .remedy = std::move(remedy)});
  }
  [[nodiscard]] const GearDesign& design_of(const TrainGear& gear) const {
    return *find_gear(train_.design, gear.name);
  }
  static double module_mm(const TrainGear& gear) { return gear.profile.gear().normal_module_mm; }
  static bool is_ring(const TrainGear& gear) {
    return gear.profile.gear().kind == GearKind::kInternal;
  }

  void place(std::string name, double rotation_rad, const Point2& centre, double z_mm) {
    shapes_.assembly.push_back({.part = static_cast<int>(shapes_.parts.size()) - 1,
                                .name = std::move(name),
                                .rotation_rad = rotation_rad,
                                .translation_mm = {centre.x(), centre.y(), z_mm}});
  }

  /// A gear's teeth, standing in a part at a height and turned.
  static ToothedOutline toothed(const TrainGear& gear, double rotation_rad, double z_lower_mm) {
    return {.profile = &gear.profile,
            .rotation_rad = rotation_rad,
            .z_lower_mm = z_lower_mm,
            .twist = gear.twist,
            .deviation = gear.deviation.empty() ? nullptr : &gear.deviation,
            .edge_chamfer_mm = gear.edge_chamfer_mm};
  }

  /// A gear or ring that is a part of its own.
  void add_single(const TrainGear& gear) {
    Slab slab{.z_lower_mm = 0.0, .z_upper_mm = gear.face_width_mm, .outer = {}, .holes = {}};
    if (is_ring(gear)) {
      slab.outer = CircleOutline{Point2::Zero(), rim_radius_mm(gear)};
      slab.holes.push_back(toothed(gear, 0.0, 0.0));
      add_bolts(gear, slab.holes);
    } else {
      slab.outer = toothed(gear, 0.0, 0.0);
      add_bore(gear, gear.profile.root_radius_mm(), slab.holes);
    }
    shapes_.parts.push_back({.name = gear.name, .slabs = with_groove(gear, std::move(slab))});
    const bool wheel = gear.name == "wheel";
    const double rotation = gear.name == "ring2"                    ? train_.phases.ring2_rotation_rad
                            : wheel || gear.name.starts_with("ring") ? train_.phases.ring1_rotation_rad
                                                                     : train_.phases.sun_rotation_rad;
    place(gear.name, rotation, wheel ? wheel_centre_mm(train_) : Point2::Zero(), gear.z_lower_mm);
  }

  /// A gear's slab, parted by the groove between the halves of a herringbone where it has one.
  std::vector<Slab> with_groove(const TrainGear& gear, Slab whole) {
    const double width = gear.twist.relief_groove_mm;
    if (!(width > 0.0)) return {std::move(whole)};
    const double middle = 0.5 * (whole.z_lower_mm + whole.z_upper_mm);
    Slab lower = whole, groove = whole, upper = whole;
    lower.z_upper_mm = groove.z_lower_mm = middle - 0.5 * width;
    groove.z_upper_mm = upper.z_lower_mm = middle + 0.5 * width;
    const double root = gear.profile.root_radius_mm(), inset = kGrooveInset * module_mm(gear);
    if (is_ring(gear)) {
      double room = extent(whole.outer).inner_radius_mm - root;
      for (std::size_t i = 1; i < whole.holes.size(); ++i) {  // bolts stand outside the teeth
        const OutlineExtent bolt = extent(whole.holes[i]);
        room = std::min(room, bolt.centre.norm() - bolt.outer_radius_mm - root);
      }
      groove.holes[0] = CircleOutline{Point2::Zero(), root + std::min(inset, 0.5 * room)};
    } else {
      const double room = root - largest_radius_mm(design_of(gear.name == "planet2" ? *train_.find("planet1") : gear).bore);
      groove.outer = CircleOutline{Point2::Zero(), root - std::min(inset, 0.5 * room)};
    }
    return {std::move(lower), std::move(groove), std::move(upper)};
  }

  // -------------------------------------------------------------- bores, rims, bolts

  /// Adds the gear's bore; an error where it leaves no wall inside a radius.
  void add_bore(const TrainGear& gear, double root_radius_mm, std::vector<Outline>& holes) {
    const BoreDesign& bore = design_of(gear).bore;
    if (bore.diameter_mm <= 0.0) return;
    const double reach = largest_radius_mm(bore);
    const double wall = kLeastWall * module_mm(gear);
    if (!(reach + wall <= root_radius_mm)) {
      const bool hex = bore.kind == BoreKind::kHex;
      const char* corner = bore.kind == BoreKind::kKeyway ? " at the keyway's corner"
                           : hex                          ? " at the hexagon's corners"
                                                          : "";
      infeasible(gear.name + (hex ? ".bore_hex_mm" : ".bore_mm"),
                 gear.name + ": the bore reaches radius " + text(reach) + " mm" + corner +
                     ", the root circle has " + text(root_radius_mm) +
                     " mm: no wall of a quarter of the module is left",
                 "a bore whose farthest point stays within radius " +
                     text(std::max(0.0, root_radius_mm - wall)) + " mm");
      return;
    }
    holes.push_back(BoreOutline{bore});
  }

  double rim_radius_mm(const TrainGear& gear) {
    const GearDesign& design = design_of(gear);
    const double root = gear.profile.root_radius_mm(), m = module_mm(gear);
    const double least = root + kLeastWall * m;
    if (design.outer_diameter_mm) {
      if (!(0.5 * *design.outer_diameter_mm >= least))
        infeasible(gear.name + ".outer_diameter_mm",
                   gear.name + ": the rim is too thin: outer diameter " +
                       text(*design.outer_diameter_mm) + " mm, root circle " + text(2.0 * root) + " mm",
                   "at least " + text(2.0 * least) + " mm");
      return 0.5 * *design.outer_diameter_mm;
    }
    double rim = root + std::max(kRim * m, kLeastRim_mm);
    const BoltCircleDesign& bolts = design.bolt_circle;
    if (bolts.count > 0)
      rim = std::max(rim, 0.5 * (bolts.circle_diameter_mm + bolts.hole_diameter_mm) +
                              std::max(m, kLeastRim_mm));
    return rim;
  }

  void add_bolts(const TrainGear& gear, std::vector<Outline>& holes) {
    const BoltCircleDesign& bolts = design_of(gear).bolt_circle;
    if (bolts.count <= 0) return;
    const double wall = kLeastWall * module_mm(gear);
    const double circle = 0.5 * bolts.circle_diameter_mm, hole = 0.5 * bolts.hole_diameter_mm;
    const double root = gear.profile.root_radius_mm();
    const double outer = rim_radius_without_errors_mm(gear);
    if (!(circle - hole >= root + wall))
      infeasible(gear.name + ".bolt_circle_diameter_mm",
                 gear.name + ": the bolt holes reach radius " + text(circle - hole) +
                     " mm, the root circle has " + text(root) + " mm",
                 "a bolt circle of at least " + text(2.0 * (root + wall + hole)) + " mm");
    if (!(circle + hole <= outer - wall))
      infeasible(gear.name + ".bolt_circle_diameter_mm",
                 gear.name + ": the bolt holes reach radius " + text(circle + hole) +
                     " mm, the ring ends at " + text(outer) + " mm",
                 "an outer diameter of at least " + text(2.0 * (circle + hole + wall)) + " mm");
    const double apart = 2.0 * circle * std::sin(kPi / bolts.count);
    if (bolts.count > 1 && !(apart >= 2.0 * hole + wall))
      infeasible(gear.name + ".bolt_hole_diameter_mm",
                 gear.name + ": " + std::to_string(bolts.count) + " bolt holes stand " + text(apart) +
                     " mm apart and have a diameter of " + text(2.0 * hole) + " mm",
                 "holes of at most " + text(std::max(0.0, apart - wall)) + " mm, or fewer");
    for (int i = 0; i < bolts.count; ++i)
      holes.push_back(CircleOutline{circle * unit_vector(kTwoPi * i / bolts.count), hole});
  }

  [[nodiscard]] double rim_radius_without_errors_mm(const TrainGear& gear) {
    const std::size_t before = errors_.size();
    const double radius = rim_radius_mm(gear);
    errors_.resize(before);
    return radius;
  }

  // -------------------------------------------------------------- planets

  /// The planets' bodies: one part where all are alike, else one each with its mark.
  void add_planets(const TrainGear& planet1) {
    const AssemblyPhases& phases = train_.phases;
    const auto& offsets = phases.planet_offset_rad;
    const bool alike = std::all_of(offsets.begin(), offsets.end(), [&](double offset) {
      return std::abs(offset - offsets.front()) < tolerance::kAngle_rad;
    });
    const std::size_t errors_before = errors_.size();
    for (std::size_t i = 0; i < phases.planet_position_rad.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      if (i == 0 || !alike) {
        PartShape part{.name = alike ? "planet" : "planet_" + number,
                       .slabs = planet_slabs(planet1, offsets[i])};
        if (errors_.size() > errors_before) return;  // the other bodies would say the same
        if (!alike) add_mark(planet1, static_cast<int>(i) + 1, part);
        shapes_.parts.push_back(std::move(part));
      }
      place("planet " + number, phases.planet_rotation_rad[i],
            train_.centre_distance_mm * unit_vector(phases.planet_position_rad[i]),
            planet1.z_lower_mm);
    }
  }

  std::vector<Slab> planet_slabs(const TrainGear& planet1, double offset_rad) {
    const TrainGear* planet2 = train_.find("planet2");
    const double root1 = planet1.profile.root_radius_mm();
    const double root2 = planet2 ? planet2->profile.root_radius_mm() : root1;
    const double width1 = planet1.face_width_mm;
    std::vector<Outline> bore;
    add_bore(planet1, std::min(root1, root2), bore);
    std::vector<Slab> slabs = with_groove(planet1, {.z_lower_mm = 0.0,
                                                    .z_upper_mm = width1,
                                                    .outer = toothed(planet1, 0.0, 0.0),
                                                    .holes = bore});
    if (!planet2) return slabs;
    const double z2 = planet2->z_lower_mm - planet1.z_lower_mm;
    if (z2 != width1) add_neck(planet1, *planet2, z2 - width1, slabs);
    else check_stack_without_neck(planet1, *planet2);
    for (Slab& slab : with_groove(*planet2, {.z_lower_mm = z2,
                                             .z_upper_mm = z2 + planet2->face_width_mm,
                                             .outer = toothed(*planet2, offset_rad, z2),
                                             .holes = bore}))
      slabs.push_back(std::move(slab));
    return slabs;
  }

  void add_neck(const TrainGear& planet1, const TrainGear& planet2, double gap_mm,
                std::vector<Slab>& slabs) {
    if (!(gap_mm >= kLeastGap_mm)) {
      infeasible("gearbox.layer_gap_mm",
                 "the planet's layers stand " + text(gap_mm) + " mm apart: no neck fits between them",
                 "0, or at least " + text(kLeastGap_mm) + " mm");
      return;
    }
    const double root =
        std::min(planet1.profile.root_radius_mm(), planet2.profile.root_radius_mm());
    const double room = root - largest_radius_mm(design_of(planet1).bore);
    const double inset = std::min(
        kNeckInset * std::min(module_mm(planet1), module_mm(planet2)), 0.5 * room);
    Slab neck = slabs.back();  // the same bore
    neck.z_lower_mm = slabs.back().z_upper_mm;
    neck.z_upper_mm = neck.z_lower_mm + gap_mm;
    neck.outer = CircleOutline{Point2::Zero(), root - inset};
    slabs.push_back(std::move(neck));
  }

  void check_stack_without_neck(const TrainGear& planet1, const TrainGear& planet2) {
    const double wall = kLeastWall * std::min(module_mm(planet1), module_mm(planet2));
    const auto fits = [&](const TrainGear& small, const TrainGear& large) {
      return small.profile.tip_radius_mm() + wall <= large.profile.root_radius_mm();
    };
    if (fits(planet1, planet2) || fits(planet2, planet1)) return;
    infeasible("gearbox.layer_gap_mm",
               "without a layer gap one section of the planet must lie inside the other's root "
               "circle: planet1 reaches from diameter " +
                   text(2.0 * planet1.profile.root_radius_mm()) + " to " +
                   text(2.0 * planet1.profile.tip_radius_mm()) + " mm, planet2 from " +
                   text(2.0 * planet2.profile.root_radius_mm()) + " to " +
                   text(2.0 * planet2.profile.tip_radius_mm()) + " mm: their teeth would cross",
               "a layer gap of at least " + text(kLeastGap_mm) + " mm, 1 mm for a usual neck");
  }

  /// Blind holes in the upper face, as many as the body's number.
  void add_mark(const TrainGear& planet1, int number, PartShape& part) {
    const TrainGear& top_gear = train_.find("planet2") ? *train_.find("planet2") : planet1;
    const double inner = largest_radius_mm(design_of(planet1).bore);
    const double web = top_gear.profile.root_radius_mm() - inner;
    const double hole = std::min(0.75, 0.15 * web);  // radius
    const double circle = inner + 0.5 * web;
    const double step = 4.0 * hole / circle;
    Slab& body = part.slabs.back();
    const double depth = std::min(0.5, 0.25 * (body.z_upper_mm - body.z_lower_mm));
    if (hole < 0.15 || step * number > 0.9 * kTwoPi) {
      shapes_.notes.push_back(part.name + ": no room for an index mark of " +
                              std::to_string(number) + " holes between bore and root circle");
      return;
    }
    Slab top = body;
    body.z_upper_mm -= depth;
    top.z_lower_mm = body.z_upper_mm;
    for (int i = 0; i < number; ++i)
      top.holes.push_back(
          CircleOutline{circle * unit_vector(step * (i - 0.5 * (number - 1))), hole});
    part.slabs.push_back(std::move(top));
  }

  const GearTrain& train_;
  PartShapes shapes_;
  Errors errors_;
};

}  // namespace

ResultAll<PartShapes> part_shapes(const GearTrain& train) { return ShapeBuilder(train).build(); }

}  // namespace trueflank
