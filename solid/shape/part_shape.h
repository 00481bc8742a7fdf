// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "trueflank/train/gear_train.h"

// What a part is, before any backend: a stack of slabs bounded by exact outlines, prismatic but for
// toothed outlines with twist or deviation. Mesh,
// B-rep, drawings and OpenSCAD are all made from this one description.
namespace trueflank {

/// Chamfer of a whole outline where the part lies on the bed of a printer, at z = 0.
struct BedChamfer {
  double grow_mm = 0.0;  ///< moves the outline at z = 0: + outwards, as a hole does; linear to 0
  double height_mm = 0.0;

  [[nodiscard]] double grow_at_mm(double z_mm) const {
    if (!(z_mm < height_mm)) return 0.0;
    return grow_mm * (1.0 - (z_mm > 0.0 ? z_mm / height_mm : 0.0));
  }
  bool operator==(const BedChamfer&) const = default;
};

/// All teeth of a gear: outer outline of an external gear, hole of a ring.
struct ToothedOutline {
  const ToothProfile* profile = nullptr;  ///< not owned; lives in the GearTrain
  double rotation_rad = 0.0;              ///< of tooth 1 from +x at the gear's lower face
  double z_lower_mm = 0.0;                ///< the gear's lower face in the part's frame
  FaceTwist twist = {};
  const FlankDeviation* deviation = nullptr;  ///< not owned; lives in the GearTrain
  double edge_chamfer_mm = 0.0;
  const Displacement* displacement = nullptr;  ///< not owned; in the gear's frame
  const InsetProfile* bed = nullptr;  ///< bed chamfer of the gear's lower face, see Toothing; not owned
  double bed_height_mm = 0.0;

  [[nodiscard]] Toothing toothing() const {
    return {profile, twist, deviation, edge_chamfer_mm, displacement, bed, bed_height_mm};
  }
};
struct CircleOutline {
  Point2 centre = Point2::Zero();
  double radius_mm = 1.0;
  BedChamfer bed = {};
};
/// A bore of any kind, about the origin; keyway, flat and the first hex flat face +x.
struct BoreOutline {
  BoreDesign bore;
  BedChamfer bed = {};
};
using Outline = std::variant<ToothedOutline, CircleOutline, BoreOutline>;

/// One layer. Holes do not touch each other or the outer outline.
struct Slab {
  double z_lower_mm = 0.0, z_upper_mm = 0.0;
  Outline outer;
  std::vector<Outline> holes;
};

/// What a part is to the eye: files and drawings colour by it.
enum class PartRole { kOther, kSun, kPlanet, kRing, kUpperRing, kCarrier, kCasing, kOutput, kBought };

/// A part in its own frame: axis z, lowest face at z = 0, tooth 1 (of a body's first gear) on +x.
/// Slabs are stacked bottom to top and touch; a hole that is equal in neighbours runs through.
struct PartShape {
  std::string name;  ///< file name: that of its member (sun, ring1, ...), planet_2 where planets differ
  std::vector<Slab> slabs;
  int member = kNoMember;  ///< of the topology: whose turning it follows
  PartRole role = PartRole::kOther;
  std::string bought = {};  ///< what to order: a standard's designation; empty: a part that is made
  std::vector<CircleOutline> marks = {};  ///< of the holes of the last slab those that only mark where tooth 1 is
  bool upside_down = false;  ///< lies on a printer's bed with its upper face: nothing overhangs then
};

/// A part's place in the assembly: turned about z, then moved.
struct Placement {
  int part = 0;            ///< index into PartShapes::parts
  std::string name;        ///< "sun", "planet 1", ...
  double rotation_rad = 0.0;
  std::array<double, 3> translation_mm{};
};

struct PartShapes {
  std::vector<PartShape> parts;
  std::vector<Placement> assembly;  ///< one placement a body
  std::vector<std::string> notes;   ///< what was left out for want of room, a sentence each
  /// What the outlines refer to and is nobody else's: it lives as long as a copy of these shapes.
  std::vector<std::shared_ptr<const void>> kept = {};
};

/// The parts of a train, one a member with gears, and the assembly in mesh at train.phases. Planets are
/// one part `planet` where all bodies are alike, else `planet_1` ... `planet_N` with an index mark on
/// the upper face: as many blind holes as the body's number, about the direction of P1's tooth 1.
/// A body of several gears has a neck over the layer gap, a little inside both root circles; without a gap
/// one section must lie inside the other's root circle. A ring without an outer diameter gets a rim of
/// 2.5 modules, 2 mm at least, and room for its bolts; bolt 1 is on +x.
/// Errors: all at once, keys of the design file, kInfeasible where a bore, neck, rim or bolt circle
/// leaves no wall of a quarter of the module.
[[nodiscard]] ResultAll<PartShapes> part_shapes(std::shared_ptr<const GearTrain> train);
/// The same of a train that outlives the shapes.
[[nodiscard]] ResultAll<PartShapes> part_shapes(const GearTrain& train);
[[nodiscard]] ResultAll<PartShapes> part_shapes(GearTrain&& train) = delete;

/// Of the body of a member.
[[nodiscard]] PartRole role_of(const GearTrain& train, int member);

}  // namespace trueflank
