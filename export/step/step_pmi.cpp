// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a solid a dimension is about.
#include "trueflank/export/step/step_pmi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "trueflank/base/units.h"

namespace trueflank::io {
namespace {

/// Faces are where their dimensions say, but for rounding; no two walls are this near.
constexpr double kSamePlace_mm = 1e-6;

bool same(double a_mm, double b_mm) { return std::abs(a_mm - b_mm) < kSamePlace_mm; }

class FaceFinder {
 public:
  explicit FaceFinder(const Brep& solid) : solid_(solid) {}

  /// Cylinders about the part's axis.
  [[nodiscard]] PmiFaces about_axis(double diameter_mm, bool hole) const {
    return about_axis(diameter_mm, hole, -kEverywhere, kEverywhere);
  }
  [[nodiscard]] PmiFaces about_axis(double diameter_mm, bool hole, double z_lower_mm,
                                    double z_upper_mm) const {
    return cylinders(diameter_mm, hole, 0.0, z_lower_mm, z_upper_mm);
  }
  /// Holes whose axes are on a circle.
  [[nodiscard]] PmiFaces on_circle(const BoltCircle& bolts) const {
    return cylinders(bolts.made_mm, true, 0.5 * bolts.circle_diameter_mm, -kEverywhere,
                     kEverywhere);
  }
  /// One step of equal holes.
  [[nodiscard]] PmiFaces of_step(const HolePattern& holes, const HoleStep& step) const {
    return cylinders(step.diameter_mm, true, 0.5 * holes.circle_diameter_mm, step.z_lower_mm,
                     step.z_upper_mm);
  }
  /// Planes across the axis, facing up or down.
  [[nodiscard]] PmiFaces at_height(double z_mm) const {
    return planes([&](const Frame3& frame) {
      return std::abs(frame.axis.z()) > 1.0 - 1e-9 && same(frame.origin.z(), z_mm);
    });
  }
  /// Planes along the axis at a distance from it, with normals along a direction.
  [[nodiscard]] PmiFaces flat(const Point3& direction, double distance_mm) const {
    return planes([&](const Frame3& frame) {
      return std::abs(frame.axis.dot(direction)) > 1.0 - 1e-9 &&
             same(frame.origin.dot(direction), distance_mm);
    });
  }

 private:
  static constexpr double kEverywhere = std::numeric_limits<double>::infinity();

  [[nodiscard]] PmiFaces cylinders(double diameter_mm, bool hole, double axis_at_mm,
                                   double z_lower_mm, double z_upper_mm) const {
    PmiFaces found;
    for (std::size_t i = 0; i < solid_.faces.size(); ++i) {
      const BrepFace& face = solid_.faces[i];
      const auto* cylinder = std::get_if<CylinderSurface>(&surface_of(face));
      if (!cylinder || face.same_sense == hole || !same(2.0 * cylinder->radius_mm, diameter_mm))
        continue;
      if (!same(cylinder->frame.origin.head<2>().norm(), axis_at_mm)) continue;
      const auto [low, high] = reach_of(face);
      if (low > z_lower_mm - kSamePlace_mm && high < z_upper_mm + kSamePlace_mm)
        found.push_back(static_cast<int>(i));
    }
    return found;
  }

  template <class Wanted>
  [[nodiscard]] PmiFaces planes(const Wanted& wanted) const {
    PmiFaces found;
    for (std::size_t i = 0; i < solid_.faces.size(); ++i)
      if (const auto* plane = std::get_if<PlaneSurface>(&surface_of(solid_.faces[i]));
          plane && wanted(plane->frame))
        found.push_back(static_cast<int>(i));
    return found;
  }

  [[nodiscard]] const BrepSurface& surface_of(const BrepFace& face) const {
    return solid_.surfaces[static_cast<std::size_t>(face.surface)];
  }
  [[nodiscard]] std::pair<double, double> reach_of(const BrepFace& face) const {
    double low = kEverywhere, high = -kEverywhere;
    for (const BrepLoop& loop : face.loops)
      for (const OrientedEdge& oriented : loop) {
        const BrepEdge& edge = solid_.edges[static_cast<std::size_t>(oriented.edge)];
        for (const int vertex : {edge.start, edge.end}) {
          const double z = solid_.vertices[static_cast<std::size_t>(vertex)].z();
          low = std::min(low, z);
          high = std::max(high, z);
        }
      }
    return {low, high};
  }

  const Brep& solid_;
};

bool is_hex(const PartDiameter& d) { return d.bore && d.bore->kind == BoreKind::kHex; }

PmiFaces joined(PmiFaces a, const PmiFaces& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The two flats of a hexagon in the direction of flat i.
std::pair<PmiFaces, PmiFaces> hex_flats(const FaceFinder& find, const PartDiameter& d, int i) {
  const double turn = i * kPi / 3.0;
  const Point3 direction(std::cos(turn), std::sin(turn), 0.0);
  return {find.flat(direction, 0.5 * d.diameter_mm), find.flat(direction, -0.5 * d.diameter_mm)};
}

PmiFaces datum_faces(const FaceFinder& find, const PartDiameter& d) {
  if (!is_hex(d)) return find.about_axis(d.made_mm, d.hole);
  PmiFaces faces;
  for (int i = 0; i < 3; ++i) {
    const auto [one, other] = hex_flats(find, d, i);
    faces = joined(std::move(faces), joined(one, other));
  }
  return faces;
}

std::string note_of(const PartDiameter& d) {
  std::string note = d.limits.fit;
  if (const std::string shape = d.bore ? bore_shape_text(*d.bore) : std::string(); !shape.empty())
    note += (note.empty() ? "" : ", ") + shape;
  return note;
}

void add_dimensions(StepPmi& pmi, const FaceFinder& find, const PartDimensions& dimensions) {
  for (const PartDiameter& d : dimensions.diameters) {
    PmiDimension size{{}, {}, d.diameter_mm, d.limits, note_of(d)};
    if (is_hex(d))
      std::tie(size.faces, size.other_faces) = hex_flats(find, d, 0);
    else
      size.faces = find.about_axis(d.made_mm, d.hole);
    if (!size.faces.empty() && is_hex(d) != size.other_faces.empty())
      pmi.dimensions.push_back(std::move(size));
  }
  for (const auto* lengths : {&dimensions.widths, &dimensions.depths})
    for (const PartWidth& w : *lengths) {
      PmiDimension size{
          find.at_height(w.z_lower_mm), find.at_height(w.z_upper_mm), w.width_mm(), w.limits, {}};
      if (!size.faces.empty() && !size.other_faces.empty())
        pmi.dimensions.push_back(std::move(size));
    }
  for (const BoltCircle& bolts : dimensions.bolt_circles) {
    PmiDimension size{find.on_circle(bolts),
                      {},
                      bolts.hole_diameter_mm,
                      bolts.limits,
                      std::to_string(bolts.count) + " holes"};
    if (!size.faces.empty()) pmi.dimensions.push_back(std::move(size));
  }
}

/// The faces a tolerance is about, and how it is called.
PmiTolerance on_faces(const FaceFinder& find, const GeometricTolerance& t,
                      const PartDimensions& dimensions) {
  PmiTolerance result{
      .name = {}, .faces = {}, .kind = t.kind, .value_mm = t.value_mm, .datum = t.datum};
  switch (t.feature) {
    case ToleratedFeature::kTips: {
      const bool ring = t.gear->profile.gear().kind == GearKind::kInternal;
      result.name = t.gear->name + " tips";
      result.faces =
          find.about_axis(2.0 * t.gear->profile.tip_radius_mm(), ring, t.z_lower_mm, t.z_upper_mm);
      break;
    }
    case ToleratedFeature::kUpperFace:
    case ToleratedFeature::kLowerFace:
      result.name = t.feature == ToleratedFeature::kUpperFace ? "upper face" : "lower face";
      result.faces = find.at_height(t.z_upper_mm);
      break;
    case ToleratedFeature::kSeat:
      result.name = "seat";
      result.faces = find.about_axis(t.made_mm, t.hole);
      break;
    case ToleratedFeature::kHoles:
      result.name = "holes";
      for (const HoleStep& step : dimensions.holes[t.pattern].steps)
        result.faces =
            joined(std::move(result.faces), find.of_step(dimensions.holes[t.pattern], step));
      break;
  }
  return result;
}

void add_tolerances(StepPmi& pmi, const FaceFinder& find, const PartDimensions& dimensions) {
  for (const GeometricTolerance& t : dimensions.tolerances) {
    PmiTolerance tolerance = on_faces(find, t, dimensions);
    if (tolerance.faces.empty()) continue;
    if (t.datum == 'B') pmi.datum_b = find.at_height(dimensions.widths.back().z_upper_mm);
    pmi.tolerances.push_back(std::move(tolerance));
  }
}

void add_gear_data(StepPmi& pmi, const TrainGear& gear) {
  using Unit = PmiProperty::Unit;
  const Gear& g = gear.profile.gear();
  const auto add = [&](const char* key, std::variant<int, double> value, Unit unit) {
    pmi.properties.push_back({gear.name + "." + key, value, unit});
  };
  add("teeth", g.teeth, Unit::kNone);
  add("normal_module_mm", g.normal_module_mm, Unit::kMillimetre);
  add("normal_pressure_angle_deg", deg_from_rad(g.rack.pressure_angle_rad), Unit::kDegree);
  add("helix_angle_deg", deg_from_rad(g.helix_angle_rad), Unit::kDegree);
  add("shift", gear.shift, Unit::kNone);
  add("reference_diameter_mm", 2.0 * reference_radius_mm(g), Unit::kMillimetre);
  add("base_diameter_mm", 2.0 * base_radius_mm(g), Unit::kMillimetre);
  add("tip_diameter_mm", 2.0 * gear.profile.tip_radius_mm(), Unit::kMillimetre);
  add("root_diameter_mm", 2.0 * gear.profile.root_radius_mm(), Unit::kMillimetre);
  add("face_width_mm", gear.face_width_mm, Unit::kMillimetre);
}

}  // namespace

StepPmi step_pmi(const GearTrain& train, const PartShape& part, const Brep& solid) {
  const PartDimensions dimensions = part_dimensions(train, part);
  const FaceFinder find(solid);
  StepPmi pmi;
  if (const PartDiameter* datum = dimensions.datum()) pmi.datum = datum_faces(find, *datum);
  add_dimensions(pmi, find, dimensions);
  if (!pmi.datum.empty()) add_tolerances(pmi, find, dimensions);
  for (const TrainGear* gear : gears_of(train, part)) add_gear_data(pmi, *gear);
  return pmi;
}

}  // namespace trueflank::io
