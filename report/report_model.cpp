// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/report_model.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/export/scene.h"
#include "trueflank/geometry/polyline.h"
#include "trueflank/geometry/section_profile.h"
#include "trueflank/report/flank_limits.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// Coordinates to 0.01 um: below what is drawn, and short to write.
double drawn(double value_mm) { return std::round(value_mm * 1e5) / 1e5; }

Json points_json(const std::vector<Point2>& points, std::size_t count) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    list.push_back(drawn(points[i].x()));
    list.push_back(drawn(points[i].y()));
  }
  return list;
}

/// The outline of tooth 1, modified as at mid face; the page turns copies of it.
Json tooth_json(const ToothProfile& profile, double chord_error_mm) {
  const SectionPolygon polygon = section_polygon(profile, chord_error_mm);
  return points_json(polygon.points, static_cast<std::size_t>(polygon.points_per_tooth));
}

/// Of modified teeth: height and outline of tooth 1 there, twist included, row by row of a mesh of the
/// true surface. Null where the outline of one section says all.
Json rows_json(const TrainGear& gear, double chord_error_mm) {
  if (gear.deviation.empty() && gear.edge_chamfer_mm == 0.0) return nullptr;
  const double middle = 0.5 * gear.face_width_mm, groove = 0.5 * gear.twist.relief_groove_mm;
  std::vector<double> levels{0.0, gear.face_width_mm};
  if (groove > 0.0) levels = {0.0, middle - groove, middle + groove, gear.face_width_mm};
  const ToothedOutline teeth{.profile = &gear.profile,
                             .twist = gear.twist,
                             .deviation = gear.deviation.empty() ? nullptr : &gear.deviation,
                             .edge_chamfer_mm = gear.edge_chamfer_mm};
  const ToothingGrid grid(teeth, levels, chord_error_mm, GridKind::kRows);
  Json rows = Json::array();
  for (const double z : grid.heights_mm()) {
    Json points = Json::array();
    const auto row = grid.row(z);
    for (int i = 0; i < grid.points_per_tooth(); ++i) {
      points.push_back(drawn(row[static_cast<std::size_t>(i)][0]));
      points.push_back(drawn(row[static_cast<std::size_t>(i)][1]));
    }
    rows.push_back({{"z", drawn(z)}, {"tooth", std::move(points)}});
  }
  return rows;
}

Json gear_json(const GearTrain& train, const TrainGear& gear, const HtmlModel& model) {
  const Gear& g = gear.profile.gear();
  Json json = Json::object();
  json["name"] = gear.name;
  json["teeth"] = g.teeth;
  json["internal"] = g.kind == GearKind::kInternal;
  json["z_lower"] = gear.z_lower_mm;
  json["width"] = gear.face_width_mm;
  json["layer"] = gear.layer;
  json["module"] = g.normal_module_mm;
  json["pressure_angle_deg"] = deg_from_rad(g.rack.pressure_angle_rad);
  json["helix_deg"] = deg_from_rad(g.helix_angle_rad);
  json["twist_rad_per_mm"] = std::tan(g.helix_angle_rad) / reference_radius_mm(g);
  json["herringbone"] = train.design.herringbone;
  json["base_radius"] = base_radius_mm(g);
  json["base_half_angle"] = base_half_angle_rad(g);
  json["tip_radius"] = gear.profile.tip_radius_mm();
  json["root_radius"] = gear.profile.root_radius_mm();
  const ToothSection section = section_profile(gear.toothing(), 0.5 * gear.face_width_mm);
  json["tooth"] = tooth_json(section.profile, model.mesh_chord_error_mm);
  json["coarse_tooth"] = tooth_json(gear.profile, model.solid_chord_error_mm);
  json["rows"] = rows_json(gear, model.solid_chord_error_mm);
  json["iso1328"] = nlohmann::ordered_json::parse(flank_limits_json_text(gear));
  return json;
}

Json mesh_json(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  const LineOfAction line = line_of_action(pair);
  Json json = Json::object();
  json["name"] = mesh.name;
  json["gear1"] = mesh.gear1;
  json["gear2"] = mesh.gear2;
  json["centre_distance"] = pair.centre_distance_mm;
  json["working_angle"] = working_pressure_angle_rad(pair);
  json["pitch_radius1"] = pitch_radius1_mm(pair);
  json["pitch_radius2"] = pitch_radius2_mm(pair);
  json["line"] = {{"pitch_point", line.pitch_point_mm},
                  {"start", line.start_mm},
                  {"end", line.end_mm},
                  {"effective_start", line.effective_start_mm},
                  {"effective_end", line.effective_end_mm},
                  {"base_pitch", line.base_pitch_mm}};
  return json;
}

Json direction_json(const DirectionEfficiency& direction) {
  Json json = Json::object();
  json["efficiency"] = direction.efficiency;
  json["self_locking"] = direction.self_locking;
  json["members"] = Json::array();
  for (const auto& member : direction.members)
    json["members"].push_back({{"name", member.name},
                               {"speed", member.speed},
                               {"torque", member.torque},
                               {"power", member.power}});
  json["meshes"] = Json::array();
  for (const auto& mesh : direction.meshes)
    json["meshes"].push_back({{"name", mesh.name},
                              {"driving_gear", mesh.driving_gear},
                              {"rolling_power", mesh.rolling_power},
                              {"loss", mesh.loss}});
  return json;
}

Json strength_json(const StrengthResult& strength) {
  Json json = Json::object();
  json["output_torque_nm"] = strength.output_torque_nm;
  json["input_torque_nm"] = strength.input_torque_nm;
  json["limiting_mesh"] = strength.limiting_mesh;
  json["limiting_gear"] = strength.limiting_gear;
  json["limiting_mode"] = strength.limiting_mode;
  json["meshes"] = Json::array();
  for (const MeshStrength& mesh : strength.meshes)
    json["meshes"].push_back({{"name", mesh.name},
                              {"material1", mesh.tooth1.material},
                              {"material2", mesh.tooth2.material},
                              {"bending_output_nm", mesh.bending_output_nm},
                              {"contact_output_nm", mesh.contact_output_nm}});
  return json;
}

// ---------------------------------------------------------------------------------- the solid model

int gear_index(const GearTrain& train, const ToothProfile* profile) {
  for (std::size_t i = 0; i < train.gears.size(); ++i)
    if (&train.gears[i].profile == profile) return static_cast<int>(i);
  return -1;
}

/// A bore as a polygon: round, with a keyway or a flat facing +x, or a hexagon.
std::vector<Point2> bore_points(const BoreDesign& bore, double chord_error_mm) {
  const double radius = 0.5 * bore.diameter_mm;
  std::vector<Point2> points;
  const auto arc = [&](double from, double to) {
    const int steps = std::max(
        8, static_cast<int>(circle_segments(radius, chord_error_mm) * (to - from) / kTwoPi) + 1);
    for (int i = 0; i <= steps; ++i) points.push_back(radius * unit_vector(from + (to - from) * i / steps));
  };
  switch (bore.kind) {
    case BoreKind::kRound:
      arc(0.0, kTwoPi);
      points.pop_back();
      break;
    case BoreKind::kKeyway: {
      const double half = 0.5 * bore.keyway_width_mm, angle = std::asin(std::min(1.0, half / radius));
      points.emplace_back(radius + bore.keyway_depth_mm, half);
      arc(angle, kTwoPi - angle);
      points.emplace_back(radius + bore.keyway_depth_mm, -half);
      break;
    }
    case BoreKind::kDFlat: {
      const double angle = std::acos(std::clamp(bore.d_flat_mm / radius - 1.0, -1.0, 1.0));
      arc(angle, kTwoPi - angle);
      break;
    }
    case BoreKind::kHex:
      for (int i = 0; i < 6; ++i)
        points.push_back(radius / std::cos(kPi / 6.0) * unit_vector(kPi / 6.0 + i * kPi / 3.0));
      break;
  }
  return points;
}

/// A toothing by its gear, anything else as a circle or a polygon.
Json outline_json(const GearTrain& train, const Outline& outline, double chord_error_mm) {
  if (const auto* toothed = std::get_if<ToothedOutline>(&outline))
    return {{"gear", gear_index(train, toothed->profile)},
            {"rotation", toothed->rotation_rad},
            {"z_lower", toothed->z_lower_mm}};
  if (const auto* circle = std::get_if<CircleOutline>(&outline))
    return {{"circle", {circle->centre.x(), circle->centre.y(), circle->radius_mm}}};
  const BoreDesign& bore = std::get<BoreOutline>(outline).bore;
  if (bore.kind == BoreKind::kRound) return {{"circle", {0.0, 0.0, 0.5 * bore.diameter_mm}}};
  const std::vector<Point2> points = bore_points(bore, chord_error_mm);
  return {{"polygon", points_json(points, points.size())}};
}

Json slab_json(const GearTrain& train, const Slab& slab, double chord_error_mm) {
  Json json = Json::object();
  json["z"] = {slab.z_lower_mm, slab.z_upper_mm};
  json["outer"] = outline_json(train, slab.outer, chord_error_mm);
  json["holes"] = Json::array();
  for (const Outline& hole : slab.holes)
    json["holes"].push_back(outline_json(train, hole, chord_error_mm));
  return json;
}

/// What a part is, for the page: how it is drawn follows from it.
const char* to_text(PartRole role) {
  switch (role) {
    case PartRole::kSun: return "sun";
    case PartRole::kPlanet: return "planet";
    case PartRole::kRing: return "ring";
    case PartRole::kUpperRing: return "upper_ring";
    case PartRole::kCarrier: return "carrier";
    case PartRole::kCasing: return "casing";
    case PartRole::kOutput: return "output";
    case PartRole::kBought: return "bought";
    case PartRole::kOther: break;
  }
  return "other";
}

Json parts_json(const GearTrain& train, const PartShapes& shapes, double chord_error_mm) {
  Json list = Json::array();
  for (const PartShape& part : shapes.parts) {
    Json slabs = Json::array();
    for (const Slab& slab : part.slabs) slabs.push_back(slab_json(train, slab, chord_error_mm));
    list.push_back({{"name", part.name},
                    {"role", to_text(part.role)},
                    {"colour", hex_text(part_colour(part.role))},
                    {"slabs", slabs}});
  }
  return list;
}

Json bodies_json(const GearTrain& train, const PartShapes& shapes) {
  Json list = Json::array();
  for (const Placement& body : shapes.assembly) {
    const PartShape& part = shapes.parts[static_cast<std::size_t>(body.part)];
    BodyMotion motion = motion_of(train, part.member);
    // what is screwed to a gear beside its axis goes round that
    Point2 pivot = Point2::Zero();
    if (part.member != kNoMember && !part.bought.empty() && motion.orbit == 0.0) {
      pivot = axis_centre_mm(train, train.phases, part.member);
      motion.orbit = motion.turn;
    }
    list.push_back({{"part", body.part},
                    {"name", body.name},
                    {"rotation", body.rotation_rad},
                    {"at", body.translation_mm},
                    {"turn", motion.turn},
                    {"orbit", motion.orbit}});
    if (pivot.norm() > 0.0) list.back()["pivot"] = {pivot.x(), pivot.y()};
  }
  return list;
}

/// The bare toothings where no parts are given: rims and necks as far as they must be.
PartShapes bare_shapes(const GearTrain& train) {
  PartShapes shapes;
  const AssemblyPhases& phases = train.phases;
  const auto slab_of = [&](const TrainGear& gear, double rotation, double floor_mm) {
    const Gear& g = gear.profile.gear();
    Slab slab{.z_lower_mm = gear.z_lower_mm - floor_mm,
              .z_upper_mm = gear.z_lower_mm - floor_mm + gear.face_width_mm,
              .outer = ToothedOutline{&gear.profile, rotation},
              .holes = {}};
    if (g.kind == GearKind::kInternal) {
      slab.holes = {slab.outer};
      slab.outer = CircleOutline{Point2::Zero(), gear.profile.root_radius_mm() + 2.0 * g.normal_module_mm};
    }
    return slab;
  };
  const Topology& topology = train.topology();
  const auto add = [&](int member, std::size_t place, const std::string& part, const std::string& name) {
    const std::vector<int> gears = topology.gears_of(member);
    const TrainGear& first = train.gear(gears.front());
    shapes.parts.push_back({part, {}, member, role_of(train, member)});
    std::vector<Slab>& slabs = shapes.parts.back().slabs;
    const TrainGear* below = nullptr;
    for (const int g : gears) {
      const TrainGear& gear = train.gear(g);
      Slab slab = slab_of(gear, g == gears.front() ? 0.0 : phases.offset_rad(g, place), first.z_lower_mm);
      if (below && slab.z_lower_mm > slabs.back().z_upper_mm) {
        const double neck_mm = std::min(below->profile.root_radius_mm(), gear.profile.root_radius_mm());
        slabs.push_back({slabs.back().z_upper_mm, slab.z_lower_mm, CircleOutline{Point2::Zero(), neck_mm}, {}});
      }
      slabs.push_back(std::move(slab));
      below = &gear;
    }
    const Point2 at = axis_centre_mm(train, phases, member, place);
    const double turned = phases.rotation_rad(member, place) + phases.offset_rad(gears.front(), place);
    shapes.assembly.push_back({static_cast<int>(shapes.parts.size()) - 1, name, turned, {at.x(), at.y(), first.z_lower_mm}});
  };
  for (std::size_t i = 0; i < topology.gears.size(); ++i) {
    const int member = topology.gears[i].member;
    const std::string& name =
        topology.is_carrier(member) ? topology.gears[i].name : topology.members[static_cast<std::size_t>(member)].name;
    if (topology.first_gear_of(member) != static_cast<int>(i)) continue;
    if (!topology.is_planet(member)) add(member, 0, name, name);
    else
      for (std::size_t place = 0; place < phases.positions_rad(member).size(); ++place) {
        const std::string number = std::to_string(place + 1);
        add(member, place, name + "_" + number, name + " " + number);
      }
  }
  return shapes;
}

}  // namespace

std::string report_model_json(const Report& report, const HtmlModel& model) {
  const GearTrain& train = *report.train;
  const PartShapes shapes = model.shapes ? *model.shapes : bare_shapes(train);
  Json json = Json::object();
  json["mesh_chord_error_um"] = um_from_mm(model.mesh_chord_error_mm);
  json["solid_chord_error_um"] = um_from_mm(model.solid_chord_error_mm);
  json["gears"] = Json::array();
  for (const TrainGear& gear : train.gears) json["gears"].push_back(gear_json(train, gear, model));
  json["meshes"] = Json::array();
  for (const TrainMesh& mesh : train.meshes) json["meshes"].push_back(mesh_json(train, mesh));
  json["parts"] = parts_json(train, shapes, model.solid_chord_error_mm);
  json["bodies"] = bodies_json(train, shapes);
  json["forward"] = direction_json(report.efficiency.forward_drive);
  json["backward"] = direction_json(report.efficiency.backward_drive);
  json["strength"] = model.strength ? strength_json(*model.strength) : Json(nullptr);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trueflank::io
