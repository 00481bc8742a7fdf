// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/mesh_face.h"

#include <algorithm>
#include <cmath>

#include "trueflank/geometry/involute.h"

namespace trueflank {
namespace {

const TrainGear& gear_of(const GearTrain& train, int index) {
  return train.gears[static_cast<std::size_t>(index)];
}

/// The flanks that touch when gear 1's counter-clockwise (side +1) or clockwise flank drives. At the
/// mesh an external mate's counter-clockwise side faces gear 1's; a ring's clockwise side does.
struct TouchingFlanks {
  Flank flank1, flank2;
};
Flank flank_on(int side, GearKind kind) {
  return flank_side(Flank::kLeft, kind) == side ? Flank::kLeft : Flank::kRight;
}
TouchingFlanks touching(const GearPair& pair, int side1) {
  const int side2 = pair.internal() ? -side1 : side1;
  return {flank_on(side1, pair.gear1().kind), flank_on(side2, pair.gear2().kind)};
}

double deviation_of(const TrainGear& gear, Flank flank, double roll_mm, double z_mm) {
  return gear.deviation.empty()
             ? 0.0
             : gear.deviation.deviation_mm(0, flank, roll_mm, z_mm - gear.z_lower_mm);
}

/// What both flanks that touch at a roll of gear 1 have, transverse; `gap_mm`: what parts them along the
/// line of action there.
class TouchingMaterial {
 public:
  TouchingMaterial(const GearTrain& train, const TrainMesh& mesh, int side1, double z_mm)
      : gear1_(gear_of(train, mesh.gear1)),
        gear2_(gear_of(train, mesh.gear2)),
        internal_(gear2_.profile.gear().kind == GearKind::kInternal),
        z_mm_(z_mm) {
    const GearPair pair = train.pair(mesh);
    const double working = working_pressure_angle_rad(pair);
    span_mm_ = pair.centre_distance_mm * std::sin(working);
    to_transverse_ = 1.0 / std::cos(base_helix_angle_rad(pair.gear1()));
    flanks_ = touching(pair, side1);
  }

  [[nodiscard]] double at(double roll1_mm, double gap_mm = 0.0) const {
    const double roll2 =
        internal_ ? roll1_mm + span_mm_ + gap_mm : span_mm_ - roll1_mm - gap_mm;
    return (deviation_of(gear1_, flanks_.flank1, roll1_mm, z_mm_) +
            deviation_of(gear2_, flanks_.flank2, roll2, z_mm_)) *
           to_transverse_;
  }
  /// Rolls of gear 1 at which either field bends, where nothing parts the flanks.
  [[nodiscard]] std::vector<double> breaks() const {
    std::vector<double> rolls = gear1_.deviation.roll_breaks_mm;
    for (double roll : gear2_.deviation.roll_breaks_mm)
      rolls.push_back(internal_ ? roll - span_mm_ : span_mm_ - roll);
    return rolls;
  }

 private:
  const TrainGear &gear1_, &gear2_;
  bool internal_;
  double z_mm_, span_mm_ = 0.0, to_transverse_ = 1.0;
  TouchingFlanks flanks_{};
};

/// Most material that meets on the path of contact.
double most_material_mm(const TouchingMaterial& material, const LineOfAction& line, double gap_mm,
                        int places = 200) {
  double most = -1e300;
  const double length = line.effective_end_mm - line.effective_start_mm;
  for (int i = 0; i <= places; ++i)
    most = std::max(most, material.at(line.effective_start_mm + length * i / places, gap_mm));
  for (double roll : material.breaks())
    if (roll > line.effective_start_mm && roll < line.effective_end_mm)
      most = std::max(most, material.at(roll, gap_mm));
  return most;
}

/// A flank's point with a deviation d lies d further along the line of action than the involute's, and the
/// mate's the rest of the gap away: play = half backlash - (d1 + d2), read where the flanks touch.
double play_mm(const GearTrain& train, const TrainMesh& mesh, int side1, double z_mm) {
  const GearPair pair = train.pair(mesh);
  const LineOfAction line = line_of_action(pair);
  const double half = 0.5 * mesh.backlash_mm * std::cos(working_pressure_angle_rad(pair));
  const TouchingMaterial material(train, mesh, side1, z_mm);
  double play = half - most_material_mm(material, line, 0.0);
  for (int i = 0; i < 3; ++i)  // contracts by the slope of the deviations
    play = half - most_material_mm(material, line, half - play);
  return play;
}

/// In the groove between herringbone halves there are no teeth.
bool in_groove(const CommonFace& face, double z_mm) {
  const double groove = face.upper_mm - face.lower_mm - face.carrying_mm;
  return std::abs(z_mm - 0.5 * (face.lower_mm + face.upper_mm)) < 0.5 * groove - 1e-9;
}

/// The height at which a side has least play; crowning and slopes together put it anywhere.
double height_of_least_play(const GearTrain& train, const TrainMesh& mesh, int side1,
                            const CommonFace& face) {
  constexpr int kHeights = 32;
  const double step = (face.upper_mm - face.lower_mm) / kHeights;
  const LineOfAction line = line_of_action(train.pair(mesh));
  const auto play_at = [&](double z) {
    if (in_groove(face, z)) return 1e300;
    // what runs over the face adds to what runs over the profile: few places tell the height
    return -most_material_mm(TouchingMaterial(train, mesh, side1, z), line, 0.0, 24);
  };
  double best = face.lower_mm, least = 1e300;
  for (int i = 0; i <= kHeights; ++i) {
    const double z = i == kHeights ? face.upper_mm : face.lower_mm + step * i;
    if (const double play = play_at(z); play < least) least = play, best = z;
  }
  double low = std::max(face.lower_mm, best - step), high = std::min(face.upper_mm, best + step);
  for (int k = 0; k < 40; ++k) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (play_at(a) < play_at(b)) high = b;
    else low = a;
  }
  const double refined = 0.5 * (low + high);
  return play_at(refined) < least - 1e-12 ? refined : best;
}

double unrelieved_ratio(const GearTrain& train, const TrainMesh& mesh) {
  const GearPair pair = train.pair(mesh);
  const LineOfAction line = line_of_action(pair);
  const double span = pair.centre_distance_mm * std::sin(working_pressure_angle_rad(pair));
  double start = line.effective_start_mm, end = line.effective_end_mm;
  const auto& m1 = train.design.gears[static_cast<std::size_t>(mesh.gear1)].modifications;
  const auto& m2 = train.design.gears[static_cast<std::size_t>(mesh.gear2)].modifications;
  const auto roll1 = [&](double diameter_mm) {
    return roll_length_mm(0.5 * diameter_mm, base_radius_mm(pair.gear1()));
  };
  const auto roll2 = [&](double diameter_mm) {
    const double roll = roll_length_mm(0.5 * diameter_mm, base_radius_mm(pair.gear2()));
    return pair.internal() ? roll - span : span - roll;
  };
  if (m1.tip_relief_um > 0.0) end = std::min(end, roll1(m1.tip_relief_start_diameter_mm));
  if (m1.root_relief_um > 0.0) start = std::max(start, roll1(m1.root_relief_start_diameter_mm));
  if (m2.tip_relief_um > 0.0) start = std::max(start, roll2(m2.tip_relief_start_diameter_mm));
  if (m2.root_relief_um > 0.0) end = std::min(end, roll2(m2.root_relief_start_diameter_mm));
  return std::max(0.0, end - start) / line.base_pitch_mm;
}

/// The range on one side of the teeth at a height.
ActivePath active_path_at(const TouchingMaterial& material, const LineOfAction& line) {
  constexpr double kEqual_mm = 1e-9;
  const double pitch = line.base_pitch_mm;
  const auto touches = [&](double roll) {
    const double own = material.at(roll);
    for (int sign : {1, -1})
      for (double other = roll + sign * pitch;
           other > line.effective_start_mm && other < line.effective_end_mm; other += sign * pitch)
        if (material.at(other) > own + kEqual_mm) return false;
    return true;
  };
  constexpr int kPlaces = 400;
  // from one end inwards to the first place that touches
  const auto first = [&](double from, double to) {
    double before = from;
    for (int i = 0; i <= kPlaces; ++i) {
      double at = from + (to - from) * i / kPlaces;
      if (!touches(at)) {
        before = at;
        continue;
      }
      for (int k = 0; i > 0 && k < 40; ++k) {
        const double middle = 0.5 * (before + at);
        (touches(middle) ? at : before) = middle;
      }
      return at;
    }
    return to;
  };
  return {first(line.start_mm, line.end_mm), first(line.end_mm, line.start_mm)};
}

}  // namespace

CommonFace common_face(const GearTrain& train, const TrainMesh& mesh) {
  const TrainGear &gear1 = gear_of(train, mesh.gear1), &gear2 = gear_of(train, mesh.gear2);
  CommonFace face;
  const auto lower = [](const TrainGear& g) { return g.z_lower_mm + g.edge_chamfer_mm; };
  const auto upper = [](const TrainGear& g) {
    return g.z_lower_mm + g.face_width_mm - g.edge_chamfer_mm;
  };
  face.lower_mm = std::max(lower(gear1), lower(gear2));
  face.upper_mm = std::min(upper(gear1), upper(gear2));
  face.carrying_mm =
      std::max(0.0, face.upper_mm - face.lower_mm - gear1.twist.relief_groove_mm);
  face.helix_mm = gear1.twist.herringbone ? 0.5 * face.carrying_mm : face.carrying_mm;
  return face;
}

double twist_over_face_rad(const GearTrain& train, const TrainMesh& mesh) {
  const TrainGear &gear1 = gear_of(train, mesh.gear1), &gear2 = gear_of(train, mesh.gear2);
  const double width =
      std::min(gear1.z_lower_mm + gear1.face_width_mm, gear2.z_lower_mm + gear2.face_width_mm) -
      std::max(gear1.z_lower_mm, gear2.z_lower_mm);
  return std::abs(gear1.twist.turn_rad_per_mm) * std::max(0.0, width) *
         (gear1.twist.herringbone ? 0.5 : 1.0);
}

double overlap_ratio(const GearTrain& train, const TrainMesh& mesh) {
  const Gear& gear = gear_of(train, mesh.gear1).profile.gear();
  return common_face(train, mesh).helix_mm * std::sin(std::abs(gear.helix_angle_rad)) /
         (kPi * gear.normal_module_mm);
}

std::vector<double> section_heights_mm(const GearTrain& train, const TrainMesh& mesh) {
  const CommonFace face = common_face(train, mesh);
  const double middle = 0.5 * (face.lower_mm + face.upper_mm);
  std::vector<double> heights{middle};
  const TrainGear* const gears[] = {&gear_of(train, mesh.gear1), &gear_of(train, mesh.gear2)};
  bool varies = false;
  for (const TrainGear* gear : gears) varies = varies || gear->deviation.varies_along_face;
  if (!varies) return heights;
  const double width = face.upper_mm - face.lower_mm;
  const double half_groove = 0.5 * (width - face.carrying_mm);
  if (half_groove > 1e-9) heights = {middle - half_groove, middle + half_groove};
  for (double share : {0.0, 0.25, 0.75, 1.0})
    if (const double at = face.lower_mm + share * width; !in_groove(face, at))
      heights.push_back(at);
  for (const TrainGear* gear : gears)
    for (double z : gear->deviation.z_breaks_mm)
      if (const double at = gear->z_lower_mm + z;
          at > face.lower_mm && at < face.upper_mm && !in_groove(face, at))
        heights.push_back(at);
  for (int side : {1, -1}) heights.push_back(height_of_least_play(train, mesh, side, face));
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end(),
                            [](double a, double b) { return std::abs(a - b) < 1e-9; }),
                heights.end());
  return heights;
}

ModifiedMesh modified_mesh(const GearTrain& train, const TrainMesh& mesh) {
  ModifiedMesh result;
  result.modified = !gear_of(train, mesh.gear1).deviation.empty() ||
                    !gear_of(train, mesh.gear2).deviation.empty();
  result.backlash_mm = mesh.backlash_mm;
  const GearPair pair = train.pair(mesh);
  if (!result.modified) {
    result.ccw_play_mm = result.cw_play_mm =
        0.5 * mesh.backlash_mm * std::cos(working_pressure_angle_rad(pair));
    result.unrelieved_contact_ratio = contact_ratios(pair).effective;
    return result;
  }
  result.ccw_play_mm = result.cw_play_mm = 1e300;
  for (double z : section_heights_mm(train, mesh)) {
    result.ccw_play_mm = std::min(result.ccw_play_mm, play_mm(train, mesh, 1, z));
    result.cw_play_mm = std::min(result.cw_play_mm, play_mm(train, mesh, -1, z));
  }
  result.backlash_mm =
      (result.ccw_play_mm + result.cw_play_mm) / std::cos(working_pressure_angle_rad(pair));
  result.unrelieved_contact_ratio = unrelieved_ratio(train, mesh);
  return result;
}

ActivePath active_path(const GearTrain& train, const TrainMesh& mesh) {
  const LineOfAction line = line_of_action(train.pair(mesh));
  if (gear_of(train, mesh.gear1).deviation.empty() && gear_of(train, mesh.gear2).deviation.empty())
    return {line.start_mm, line.end_mm};
  const CommonFace face = common_face(train, mesh);
  ActivePath path{line.end_mm, line.start_mm};  // grows to what either side has
  for (int side : {1, -1}) {
    const double z = height_of_least_play(train, mesh, side, face);
    const ActivePath of = active_path_at(TouchingMaterial(train, mesh, side, z), line);
    path.start_mm = std::min(path.start_mm, of.start_mm);
    path.end_mm = std::max(path.end_mm, of.end_mm);
  }
  return path;
}

}  // namespace trueflank
