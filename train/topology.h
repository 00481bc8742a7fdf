// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

// What a train is made of, as data: axes, the bodies that turn about them, the gears on the bodies,
// the meshes, and which bodies are driven, loaded and held. Kinematics, torque balance, phases,
// assembly, parts and reports all follow from it; the kinds of the design file (design/kinds/) are
// values of it. Any number of axes, carriers and stages can be written down; lay_out() places those
// whose stages have one centre distance each.
namespace trueflank {

/// Stands in for a member: nothing that turns.
inline constexpr int kHousing = -1;
inline constexpr int kNoMember = -1;

/// All axes are parallel. Axis 0 is the train's own; a carried axis stands once for every planet.
struct TopologyAxis {
  int carrier = kHousing;  ///< member that carries it round

  bool operator==(const TopologyAxis&) const = default;
};

/// A body: what turns as one piece.
struct TopologyMember {
  std::string name;  ///< of its part and in reports: sun, planet, carrier, ring1, wheel, ...
  int axis = 0;

  bool operator==(const TopologyMember&) const = default;
};

/// What kind a gear may be.
enum class GearForm { kExternal, kRing, kEither };

/// A gear and the body that carries it. Gears of one body stand in the order of their layers.
struct TopologyGear {
  std::string name;
  int member = 0;
  int layer = 1;  ///< 2 lies above 1
  GearForm form = GearForm::kExternal;
  bool optional = false;  ///< a design may leave it out: it idles
  /// Gears that are tied by meshes have one: it has one centre distance and at most one set of planets.
  /// Gears stand in the order of their stages, and layers count through them.
  int stage = 1;

  bool operator==(const TopologyGear&) const = default;
};

/// Gears in mesh; gear 1 is the inner gear of an internal mesh.
struct TopologyMesh {
  int gear1 = 0, gear2 = 0;

  bool operator==(const TopologyMesh&) const = default;
};

struct Topology {
  std::string kind;  ///< its name in design files and reports
  std::vector<TopologyAxis> axes = {{}};
  std::vector<TopologyMember> members = {};
  std::vector<TopologyGear> gears = {};
  std::vector<TopologyMesh> meshes = {};
  std::vector<int> fixed = {};  ///< members that are held
  int input = kNoMember, output = kNoMember;

  bool operator==(const Topology&) const = default;

  /// Member that carries a member's axis round; kHousing where the axis stands.
  [[nodiscard]] int carrier_of(int member) const {
    return axes[static_cast<std::size_t>(members[static_cast<std::size_t>(member)].axis)].carrier;
  }
  [[nodiscard]] bool is_planet(int member) const { return carrier_of(member) != kHousing; }
  [[nodiscard]] bool is_planet_gear(std::size_t gear) const { return is_planet(gears[gear].member); }
  [[nodiscard]] bool is_carrier(int member) const;
  [[nodiscard]] bool has_planets() const;
  /// The member against which a mesh only rolls: the carrier of the planet in it, or the housing.
  [[nodiscard]] int arm_of(const TopologyMesh& mesh) const;
  /// Gears of a member, in their order; none of a carrier.
  [[nodiscard]] std::vector<int> gears_of(int member) const;
  /// The gear of its body whose tooth 1 is the body's: the first.
  [[nodiscard]] int first_gear_of(int member) const { return gears_of(member).front(); }
  /// kNoMember where there is none of this name.
  [[nodiscard]] int find_member(std::string_view name) const;
  /// -1 where there is none of this name.
  [[nodiscard]] int find_gear(std::string_view name) const;
  /// The first planet body; kNoMember where there is none. The only one of a stage.
  [[nodiscard]] int first_planet() const;
  /// How many there are; 1 where there is no gear.
  [[nodiscard]] int stage_count() const;
  /// "" for kNoMember.
  [[nodiscard]] std::string name_of(int member) const;
  [[nodiscard]] std::string mesh_name(const TopologyMesh& mesh) const;
};

/// The train without a gear: its meshes go with it, and its body where that has no other gear.
[[nodiscard]] Topology without_gear(const Topology& topology, int gear);

/// Meshes that carry nothing whatever the load: those of a body that nothing drives, loads or holds and
/// that has no other mesh.
[[nodiscard]] std::vector<bool> idle_meshes(const Topology& topology);

}  // namespace trueflank
