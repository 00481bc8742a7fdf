// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/part_shape.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "trueflank/base/contract.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/solid/shape/carrier.h"
#include "trueflank/solid/shape/machine/machine_parts.h"
#include "trueflank/solid/shape/machine/stacked_body.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/ring_rim.h"

namespace trueflank {
namespace {

/// Least wall between two outlines, of the module: thinner it is no part of a gear.
constexpr double kLeastWall = 0.25;
/// Wall outside the bolts of a rim without an outer diameter, at least.
constexpr double kLeastBoltWall_mm = 2.0;
/// The neck of a compound planet stays this part of the module inside the smaller root circle.
constexpr double kNeckInset = 0.25;
/// The groove between the halves of a herringbone is cut this part of the module deeper than the roots.
constexpr double kGrooveInset = 0.1;
/// Wall of the neck between a gear and the plate of the carrier that drives it, to the pins of that, and gap to
/// the next carrier's plate.
constexpr double kLeastNeckWall_mm = 0.4;
/// A layer gap below this is no gap that can be made.
constexpr double kLeastGap_mm = 0.01;

class ShapeBuilder {
 public:
  explicit ShapeBuilder(const GearTrain& train)
      : train_(train), layout_(machine_layout(train)), designs_(train.design.gears) {
    if (!layout_) return;
    for (std::size_t i = 0; i < train.gears.size(); ++i)
      if (i == static_cast<std::size_t>(layout_->fixed_gear) ||
          i == static_cast<std::size_t>(layout_->output_gear))
        designs_[i] = machine_gear(*layout_, train, static_cast<int>(i));
  }

  ResultAll<PartShapes> build() {
    const Topology& topology = train_.topology();
    for (std::size_t i = 0; i < topology.gears.size(); ++i) {
      const int member = topology.gears[i].member;
      if (topology.first_gear_of(member) != static_cast<int>(i)) continue;  // one body with its first
      if (topology.is_planet(member))
        add_planets(member);
      else
        add_single(member);
    }
    if (errors_.empty() || !layout_)
      for (Error& error : layout_ ? add_machine(train_, *layout_, shapes_) : add_carrier(train_, shapes_))
        errors_.push_back(std::move(error));
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
    return designs_[static_cast<std::size_t>(&gear - train_.gears.data())];
  }
  /// The bore of the body a gear belongs to.
  [[nodiscard]] const BoreDesign& bore_through(const TrainGear& gear) const {
    return first_of_body(train_.design, static_cast<std::size_t>(&gear - train_.gears.data())).bore;
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

  std::vector<Slab> ring_slabs(const TrainGear& gear) {
    Slab slab{.z_lower_mm = 0.0,
              .z_upper_mm = gear.face_width_mm,
              .outer = CircleOutline{Point2::Zero(), rim_radius_mm(gear)},
              .holes = {toothed(gear, 0.0, 0.0)}};
    add_bolts(gear, slab.holes);
    return with_groove(gear, std::move(slab));
  }

  /// A herringbone ring as the two parts that meet at its apex.
  void add_halves(int member, const TrainGear& gear) {
    StackedBody whole;
    whole.add(ring_slabs(gear), 0.0);
    const double apex = 0.5 * gear.face_width_mm;
    for (const bool upper : {false, true}) {
      const std::string name = train_.topology().name_of(member) + (upper ? "_upper" : "_lower");
      const StackedBody half = whole.between(upper ? HeightRange{apex, gear.face_width_mm}
                                                   : HeightRange{0.0, apex});
      shapes_.parts.push_back({.name = name,
                               .slabs = half.slabs(),
                               .member = member,
                               .role = role_of(train_, member)});
      place(name, train_.phases.rotation_rad(member, 0),
            axis_centre_mm(train_, train_.phases, member), gear.z_lower_mm + (upper ? apex : 0.0));
    }
  }

  /// A body that is there once.
  void add_single(int member) {
    const TrainGear& gear = train_.gear(train_.topology().first_gear_of(member));
    if (is_made_in_halves(train_.design, design_of(gear))) return add_halves(member, gear);
    const bool on_carrier = train_.topology().is_carrier(member);
    shapes_.parts.push_back({.name = on_carrier ? gear.name : train_.topology().name_of(member),
                             .slabs = is_ring(gear) ? ring_slabs(gear) : body_slabs(member, 0),
                             .member = member,
                             .role = role_of(train_, member)});
    double lower_mm = gear.z_lower_mm;
    if (on_carrier) lower_mm = set_on_carrier(member, gear, shapes_.parts.back().slabs);
    const int first = train_.topology().first_gear_of(member);
    place(shapes_.parts.back().name, train_.phases.rotation_rad(member, 0) + train_.phases.offset_rad(first, 0),
          axis_centre_mm(train_, train_.phases, member), lower_mm);
  }

  /// A gear that a carrier drives is one body with the upper plate of that, where the design has plates; a neck
  /// joins them. Returns the height of the body's lower face.
  double set_on_carrier(int member, const TrainGear& gear, std::vector<Slab>& slabs) {
    for (const GearTrain* stage : train_.each_stage()) {
      const int planet = stage->topology().first_planet();
      if (stage->topology().name_of(stage->topology().carrier_of(planet)) != train_.topology().name_of(member)) continue;
      const auto carrier = carrier_layout(*stage);
      if (!carrier || !errors_.empty()) break;
      const HeightRange plate = carrier->upper_plate;
      const double bore = largest_radius_mm(bore_through(gear)), root = gear.profile.root_radius_mm();
      const double pins = stage->centre_distance_mm - 0.5 * carrier->pin_hole_diameter_mm - kLeastNeckWall_mm;
      const double neck = std::min(root - std::min(kNeckInset * module_mm(gear), 0.5 * (root - bore)), pins);
      if (!(neck >= bore + kLeastNeckWall_mm)) {
        infeasible(gear.name + ".bore_mm",
                   gear.name + ": the bore leaves no wall in the neck to the carrier's plate, "
                               "which ends at radius " + fixed_mm(neck) + " mm, inside the pins",
                   "a bore whose farthest point stays within radius " +
                       fixed_mm(std::max(0.0, neck - kLeastNeckWall_mm)) + " mm");
        break;
      }
      check_opening(gear, neck);
      StackedBody body;
      body.add(plate, CircleOutline{Point2::Zero(), 0.5 * carrier->outer_diameter_mm});
      if (gear.z_lower_mm > plate.upper_mm)
        body.add({plate.upper_mm, gear.z_lower_mm}, CircleOutline{Point2::Zero(), neck});
      body.add(slabs, gear.z_lower_mm);
      for (const Outline& hole : slabs.front().holes) body.drill({plate.lower_mm, gear.z_lower_mm}, hole);
      const double turned = train_.phases.offset_rad(train_.topology().first_gear_of(member), 0);
      for (const double angle : stage->phases.positions_rad(planet))
        body.drill(plate, CircleOutline{stage->centre_distance_mm * unit_vector(angle - turned),
                                        0.5 * carrier->pin_hole_diameter_mm});
      slabs = body.slabs();
      return plate.lower_mm;
    }
    return gear.z_lower_mm;
  }

  /// The neck goes through the lower plate of the carrier that runs round the gear.
  void check_opening(const TrainGear& gear, double neck_mm) {
    for (const GearTrain* stage : train_.each_stage()) {
      const auto carrier = stage->find(gear.name) ? carrier_layout(*stage) : std::nullopt;
      if (!carrier || 0.5 * carrier->opening_diameter_mm >= neck_mm + kLeastNeckWall_mm) continue;
      infeasible("carrier.opening_diameter_mm",
                 "the neck of " + gear.name + ", of diameter " + fixed_mm(2.0 * neck_mm) +
                     " mm, goes through the carrier's opening of " + fixed_mm(carrier->opening_diameter_mm) + " mm",
                 "at least " + fixed_mm(2.0 * (neck_mm + kLeastNeckWall_mm)) + " mm, or no such key");
    }
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
      const double room = root - largest_radius_mm(bore_through(gear));
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
                 gear.name + ": the bore reaches radius " + fixed_mm(reach) + " mm" + corner +
                     ", the root circle has " + fixed_mm(root_radius_mm) +
                     " mm: no wall of a quarter of the module is left",
                 "a bore whose farthest point stays within radius " +
                     fixed_mm(std::max(0.0, root_radius_mm - wall)) + " mm");
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
                       fixed_mm(*design.outer_diameter_mm) + " mm, root circle " + fixed_mm(2.0 * root) + " mm",
                   "at least " + fixed_mm(2.0 * least) + " mm");
      return 0.5 * *design.outer_diameter_mm;
    }
    double rim = root + usual_rim_mm(m);
    const BoltCircleDesign& bolts = design.bolt_circle;
    if (bolts.count > 0)
      rim = std::max(rim, 0.5 * (bolts.circle_diameter_mm + bolts.hole_diameter_mm) +
                              std::max(m, kLeastBoltWall_mm));
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
                 gear.name + ": the bolt holes reach radius " + fixed_mm(circle - hole) +
                     " mm, the root circle has " + fixed_mm(root) + " mm",
                 "a bolt circle of at least " + fixed_mm(2.0 * (root + wall + hole)) + " mm");
    if (!(circle + hole <= outer - wall))
      infeasible(gear.name + ".bolt_circle_diameter_mm",
                 gear.name + ": the bolt holes reach radius " + fixed_mm(circle + hole) +
                     " mm, the ring ends at " + fixed_mm(outer) + " mm",
                 "an outer diameter of at least " + fixed_mm(2.0 * (circle + hole + wall)) + " mm");
    const double apart = 2.0 * circle * std::sin(kPi / bolts.count);
    if (bolts.count > 1 && !(apart >= 2.0 * hole + wall))
      infeasible(gear.name + ".bolt_hole_diameter_mm",
                 gear.name + ": " + std::to_string(bolts.count) + " bolt holes stand " + fixed_mm(apart) +
                     " mm apart and have a diameter of " + fixed_mm(2.0 * hole) + " mm",
                 "holes of at most " + fixed_mm(std::max(0.0, apart - wall)) + " mm, or fewer");
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
  void add_planets(int member) {
    const AssemblyPhases& phases = train_.phases;
    const std::vector<int> gears = train_.topology().gears_of(member);
    const std::string& name = train_.topology().name_of(member);
    const bool alike = std::all_of(gears.begin(), gears.end(), [&](int gear) {
      const auto& offsets = phases.gear_offset_rad[static_cast<std::size_t>(gear)];
      return std::all_of(offsets.begin(), offsets.end(), [&](double offset) {
        return std::abs(offset - offsets.front()) < tolerance::kAngle_rad;
      });
    });
    const std::size_t errors_before = errors_.size();
    for (std::size_t i = 0; i < phases.positions_rad(member).size(); ++i) {
      const std::string number = std::to_string(i + 1);
      if (i == 0 || !alike) {
        PartShape part{.name = alike ? name : name + "_" + number,
                       .slabs = body_slabs(member, i),
                       .member = member,
                       .role = PartRole::kPlanet};
        if (errors_.size() > errors_before) return;  // the other bodies would say the same
        // in a gearbox compound bodies that are alike have a mark too: they must be turned rightly
        if (!alike || (layout_ && gears.size() > 1)) add_mark(gears, static_cast<int>(i) + 1, part);
        shapes_.parts.push_back(std::move(part));
      }
      place(name + " " + number, phases.rotation_rad(member, i),
            axis_centre_mm(train_, phases, member, i), train_.gear(gears.front()).z_lower_mm);
    }
  }

  // -------------------------------------------------------------- bodies of one gear and of several

  /// A gear ahead of the first of its body, whose tooth 1 is on +x of the part.
  [[nodiscard]] double offset_in_body_rad(int first, int gear, std::size_t place) const {
    return gear == first ? 0.0 : train_.phases.offset_rad(gear, place);
  }

  /// External gears stacked upon each other, as body number `place` needs them turned.
  std::vector<Slab> body_slabs(int member, std::size_t place) {
    const std::vector<int> gears = train_.topology().gears_of(member);
    const TrainGear& first = train_.gear(gears.front());
    double root = first.profile.root_radius_mm();
    for (const int g : gears) root = std::min(root, train_.gear(g).profile.root_radius_mm());
    std::vector<Outline> bore;
    add_bore(first, root, bore);
    std::vector<Slab> slabs;
    const TrainGear* below = nullptr;
    for (const int g : gears) {
      const TrainGear& gear = train_.gear(g);
      const double floor = gear.z_lower_mm - first.z_lower_mm;
      if (below) {
        const double top = slabs.back().z_upper_mm;
        if (floor != top)
          add_neck(*below, gear, floor - top, toothed(gear, train_.phases.offset_rad(g, place), floor), slabs);
        else
          check_stack_without_neck(*below, gear);
      }
      for (Slab& slab : with_groove(gear, {.z_lower_mm = floor,
                                           .z_upper_mm = floor + gear.face_width_mm,
                                           .outer = toothed(gear, offset_in_body_rad(gears.front(), g, place), floor),
                                           .holes = bore}))
        slabs.push_back(std::move(slab));
      below = &gear;
    }
    return slabs;
  }

  /// Whether the teeth of one section of a planet may go on up to the other: inside that one's roots,
  /// and clear of what it is in mesh with.
  [[nodiscard]] bool may_go_on(const TrainGear& small, const TrainGear& large) const {
    const double tip = small.profile.tip_radius_mm(), a = train_.centre_distance_mm;
    const double room = train_.design.machine->housing.clearance_mm;
    bool clear = tip + kLeastWall * std::min(module_mm(small), module_mm(large)) <=
                 large.profile.root_radius_mm();
    for (std::size_t i = 0; i < train_.gears.size(); ++i) {
      const TrainGear& other = train_.gears[i];
      if (train_.topology().is_planet_gear(i) || other.layer != large.layer) continue;
      clear = clear && (is_ring(other) ? a + tip + room <= other.profile.tip_radius_mm()
                                       : a - tip - room >= other.profile.tip_radius_mm());
    }
    return clear;
  }

  /// Teeth in the place of a neck, on a planet that a printer makes: they would hang over the neck.
  [[nodiscard]] std::optional<Outline> teeth_for_neck(const TrainGear& lower, const TrainGear& upper,
                                                      const Outline& lower_teeth,
                                                      const ToothedOutline& upper_teeth) const {
    const auto& process = train_.design.made.process;
    if (!layout_ || !process || !(process->ledge_mm > 0.0)) return std::nullopt;
    if (may_go_on(upper, lower) && is_plain_prism(upper_teeth)) return upper_teeth;
    const auto* teeth = std::get_if<ToothedOutline>(&lower_teeth);
    if (teeth && may_go_on(lower, upper) && is_plain_prism(*teeth)) return *teeth;
    return std::nullopt;
  }

  void add_neck(const TrainGear& lower, const TrainGear& upper, double gap_mm,
                const ToothedOutline& upper_teeth, std::vector<Slab>& slabs) {
    if (!(gap_mm >= kLeastGap_mm)) {
      infeasible("gearbox.layer_gap_mm",
                 "the planet's layers stand " + fixed_mm(gap_mm) + " mm apart: no neck fits between them",
                 "0, or at least " + fixed_mm(kLeastGap_mm) + " mm");
      return;
    }
    const double root =
        std::min(lower.profile.root_radius_mm(), upper.profile.root_radius_mm());
    const double room = root - largest_radius_mm(bore_through(lower));
    const double inset = std::min(
        kNeckInset * std::min(module_mm(lower), module_mm(upper)), 0.5 * room);
    Slab neck = slabs.back();  // the same bore
    neck.z_lower_mm = slabs.back().z_upper_mm;
    neck.z_upper_mm = neck.z_lower_mm + gap_mm;
    const auto teeth = teeth_for_neck(lower, upper, slabs.back().outer, upper_teeth);
    neck.outer = teeth ? *teeth : Outline{CircleOutline{Point2::Zero(), root - inset}};
    if (!teeth && shrink_neck(upper_teeth, slabs, neck)) return;
    slabs.push_back(std::move(neck));
  }

  /// A printed neck one layer high, where straight teeth of both sections may go on towards each other: the
  /// upper ones are then printed on the lower ones, as on supports.
  bool shrink_neck(const ToothedOutline& upper_teeth, std::vector<Slab>& slabs, Slab neck) const {
    const auto& process = train_.design.made.process;
    const auto* lower_teeth = std::get_if<ToothedOutline>(&slabs.back().outer);
    if (!layout_ || !process || !(process->ledge_mm > 0.0) || !lower_teeth) return false;
    if (!is_plain_prism(*lower_teeth) || !is_plain_prism(upper_teeth)) return false;
    const double gap = neck.z_upper_mm - neck.z_lower_mm, layer = process->layer_mm;
    // what is left between the teeth that go on and the other section's mates
    const double left = 0.5 * (gap + layer);
    if (!(gap > 2.0 * layer) || left < 0.5 * train_.design.machine->housing.clearance_mm) return false;
    Slab lower = slabs.back(), upper = neck;
    lower.z_lower_mm = neck.z_lower_mm;
    lower.z_upper_mm = neck.z_lower_mm = neck.z_lower_mm + 0.5 * (gap - layer);
    upper.z_lower_mm = neck.z_upper_mm = neck.z_lower_mm + layer;
    upper.outer = upper_teeth;
    for (Slab* slab : {&lower, &neck, &upper}) slabs.push_back(std::move(*slab));
    return true;
  }

  void check_stack_without_neck(const TrainGear& lower, const TrainGear& upper) {
    const double wall = kLeastWall * std::min(module_mm(lower), module_mm(upper));
    const auto fits = [&](const TrainGear& small, const TrainGear& large) {
      return small.profile.tip_radius_mm() + wall <= large.profile.root_radius_mm();
    };
    if (fits(lower, upper) || fits(upper, lower)) return;
    infeasible("gearbox.layer_gap_mm",
               "without a layer gap one section of the planet must lie inside the other's root "
               "circle: " + lower.name + " reaches from diameter " +
                   fixed_mm(2.0 * lower.profile.root_radius_mm()) + " to " +
                   fixed_mm(2.0 * lower.profile.tip_radius_mm()) + " mm, " + upper.name + " from " +
                   fixed_mm(2.0 * upper.profile.root_radius_mm()) + " to " +
                   fixed_mm(2.0 * upper.profile.tip_radius_mm()) + " mm: their teeth would cross",
               "a layer gap of at least " + fixed_mm(kLeastGap_mm) + " mm, 1 mm for a usual neck");
  }

  /// What a mark in the upper face stays outside of: the bore, or the seat of a bearing.
  [[nodiscard]] double inside_of_mark_mm(const TrainGear& top_gear) const {
    const double bore = largest_radius_mm(bore_through(top_gear));
    if (!layout_ || !train_.design.machine->bearings.planet) return bore;
    return std::max(bore,
                    0.5 * layout_->fits.planet.hole_mm(train_.design.machine->bearings.planet->outer_mm));
  }

  /// Blind holes in the upper face, as many as the body's number; in a gearbox they leave its
  /// walls.
  void add_mark(const std::vector<int>& gears, int number, PartShape& part) {
    const TrainGear& top_gear = train_.gear(gears.back());
    const double inner = inside_of_mark_mm(top_gear);
    const double web = top_gear.profile.root_radius_mm() - inner;
    double hole = std::min(0.75, 0.15 * web);  // radius
    if (layout_) hole = std::min(hole, 0.5 * web - layout_->wall_mm);
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
      part.marks.push_back({circle * unit_vector(step * (i - 0.5 * (number - 1))), hole});
    top.holes.insert(top.holes.end(), part.marks.begin(), part.marks.end());
    part.slabs.push_back(std::move(top));
  }

  const GearTrain& train_;
  std::optional<MachineLayout> layout_;  ///< of a gearbox with a housing
  std::vector<GearDesign> designs_;      ///< as its rings have them
  PartShapes shapes_;
  Errors errors_;
};

}  // namespace

PartRole role_of(const GearTrain& train, int member) {
  const Topology& topology = train.topology();
  if (train.meshes.empty()) return PartRole::kOther;
  if (topology.is_planet(member)) return PartRole::kPlanet;
  const std::vector<int> gears = topology.gears_of(member);
  if (gears.empty()) return PartRole::kCarrier;
  const TrainGear& gear = train.gear(gears.front());
  if ((gears.front() == 0 || topology.has_planets()) && gear.profile.gear().kind == GearKind::kExternal)
    return PartRole::kSun;
  return gear.layer > 1 ? PartRole::kUpperRing : PartRole::kRing;
}

ResultAll<PartShapes> part_shapes(const GearTrain& train) { return ShapeBuilder(train).build(); }

ResultAll<PartShapes> part_shapes(std::shared_ptr<const GearTrain> train) {
  auto shapes = part_shapes(*train);
  if (shapes) shapes->kept.push_back(std::move(train));
  return shapes;
}

}  // namespace trueflank
