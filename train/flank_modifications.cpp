// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/flank_modifications.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/geometry/scalar_root.h"

namespace trueflank {
namespace {

/// Removal that grows from 0 at 0 to 1 at 1.
double grown(double share, ReliefShape shape) {
  if (share <= 0.0) return 0.0;
  return shape == ReliefShape::kLinear ? share : share * share;
}

/// Where such a removal is steepest: at its end.
double steepest_of(double amount_mm, double length_mm, ReliefShape shape) {
  return amount_mm == 0.0
             ? 0.0
             : (shape == ReliefShape::kLinear ? 1.0 : 2.0) * std::abs(amount_mm / length_mm);
}

/// A relief along the roll length, from its start to the end where it is deepest.
struct RollRelief {
  double amount_mm = 0.0, start_mm = 0.0, end_mm = 1.0;
  ReliefShape shape = ReliefShape::kParabola;

  [[nodiscard]] double removed_mm(double roll_mm) const {
    return amount_mm == 0.0 ? 0.0
                            : amount_mm * grown((roll_mm - start_mm) / (end_mm - start_mm), shape);
  }
};

/// Place in a half face of its own, -1 at its lower (outer) to +1 at its upper (inner) end.
struct FaceParts {
  double face_mm = 0.0;
  bool halves = false;
  double half_mm = 0.0;  ///< width of one half

  [[nodiscard]] double place(double z_mm) const {
    if (!halves) return 2.0 * z_mm / face_mm - 1.0;
    const double from_end = z_mm <= 0.5 * face_mm ? z_mm : face_mm - z_mm;
    return 2.0 * from_end / half_mm - 1.0;
  }
};

struct Terms {
  RollRelief tip, root;
  double root_form_mm = 0.0, tip_form_mm = 1.0;
  double profile_crowning_mm = 0.0, profile_slope_mm = 0.0;
  double crowning_mm = 0.0, helix_slope_mm = 0.0;
  double end_relief_mm = 0.0, end_length_mm = 1.0;
  ReliefShape end_shape = ReliefShape::kParabola;
  FaceParts face;
  GearKind kind = GearKind::kExternal;

  [[nodiscard]] double along_profile(double roll_mm) const {
    const double u = 2.0 * (roll_mm - root_form_mm) / (tip_form_mm - root_form_mm) - 1.0;
    return 0.5 * profile_slope_mm * u - profile_crowning_mm * u * u - tip.removed_mm(roll_mm) -
           root.removed_mm(roll_mm);
  }
  [[nodiscard]] double along_face(Flank flank, double z_mm) const {
    const double v = face.place(z_mm);
    const double from_end = std::min(z_mm, face.face_mm - z_mm);
    const double end =
        end_relief_mm == 0.0
            ? 0.0
            : end_relief_mm * grown((end_length_mm - from_end) / end_length_mm, end_shape);
    return 0.5 * helix_slope_mm * v * flank_side(flank, kind) - crowning_mm * v * v - end;
  }
};

class DeviationBuilder {
 public:
  DeviationBuilder(const ModificationsDesign& m, const ToothProfile& profile, const FaceTwist& face)
      : m_(m), profile_(profile), face_(face) {}

  ResultAll<FlankDeviation> build() {
    set_profile_terms();
    set_face_terms();
    if (!errors_.empty()) return fail_all(std::move(errors_));
    FlankDeviation field;
    if (deviates(m_)) field = make_field();
    check(field);
    if (!errors_.empty()) return fail_all(std::move(errors_));
    return field;
  }

 private:
  void report(const std::string& key, double value, std::string message, std::string remedy) {
    errors_.push_back({.code = ErrorCode::kInfeasible,
                       .message = std::move(message),
                       .key = "modifications." + key,
                       .value = trimmed_number(value),
                       .remedy = std::move(remedy)});
  }

  /// A start diameter lies on the involute, off its ends.
  RollRelief relief(const char* name, double amount_um, double start_diameter_mm,
                    double end_roll_mm, ReliefShape shape) {
    if (amount_um == 0.0) return {};
    const double r_b = base_radius_mm(profile_.gear());
    const double start = roll_length_mm(0.5 * start_diameter_mm, r_b);
    const double low = std::min(profile_.root_form_radius_mm(), profile_.tip_form_radius_mm());
    const double high = std::max(profile_.root_form_radius_mm(), profile_.tip_form_radius_mm());
    if (!(0.5 * start_diameter_mm > low && 0.5 * start_diameter_mm < high))
      report(std::string(name) + "_start_diameter_mm", start_diameter_mm, "not on the involute",
             "between root form and tip form circle: more than " + trimmed_number(2.0 * low) +
                 " and less than " + trimmed_number(2.0 * high) + " mm");
    return {mm_from_um(amount_um), start, end_roll_mm, shape};
  }

  void set_profile_terms() {
    t_.kind = profile_.gear().kind;
    t_.root_form_mm = profile_.root_form_roll_length_mm();
    t_.tip_form_mm = profile_.tip_form_roll_length_mm();
    t_.tip = relief("tip_relief", m_.tip_relief_um, m_.tip_relief_start_diameter_mm, t_.tip_form_mm,
                    m_.tip_relief_shape);
    t_.root = relief("root_relief", m_.root_relief_um, m_.root_relief_start_diameter_mm,
                     t_.root_form_mm, m_.root_relief_shape);
    t_.profile_crowning_mm = mm_from_um(m_.profile_crowning_um);
    t_.profile_slope_mm = mm_from_um(m_.profile_slope_um);
  }

  void set_face_terms() {
    const double width = face_.face_width_mm;
    t_.face = {width, face_.herringbone, 0.5 * (width - face_.relief_groove_mm)};
    t_.crowning_mm = mm_from_um(m_.crowning_um);
    t_.helix_slope_mm = mm_from_um(m_.helix_slope_um);
    t_.end_relief_mm = mm_from_um(m_.end_relief_um);
    t_.end_shape = m_.end_relief_shape;
    t_.end_length_mm = m_.end_relief_length_mm;
    const double room = face_.herringbone ? t_.face.half_mm : 0.5 * width;
    if (m_.end_relief_um > 0.0 && !(t_.end_length_mm > 0.0 && t_.end_length_mm <= room))
      report("end_relief_length_mm", m_.end_relief_length_mm, "does not fit the face",
             "more than 0 and at most " + trimmed_number(room) + " mm, half the face");
  }

  [[nodiscard]] FlankDeviation make_field() const {
    FlankDeviation field;
    field.deviation_mm = [t = t_](int, Flank flank, double roll_mm, double z_mm) {
      return t.along_profile(roll_mm) + t.along_face(flank, z_mm);
    };
    field.varies_along_face =
        t_.crowning_mm != 0.0 || t_.helix_slope_mm != 0.0 || t_.end_relief_mm != 0.0;
    for (const RollRelief& relief : {t_.tip, t_.root})
      if (relief.amount_mm != 0.0) field.roll_breaks_mm.push_back(relief.start_mm);
    const double width = face_.face_width_mm;
    if (t_.end_relief_mm != 0.0 && 2.0 * t_.end_length_mm < width)
      field.z_breaks_mm = {t_.end_length_mm, width - t_.end_length_mm};
    if (field.varies_along_face && face_.herringbone)
      field.z_breaks_mm.insert(
          field.z_breaks_mm.begin() + static_cast<std::ptrdiff_t>(field.z_breaks_mm.size() / 2),
          0.5 * width);
    std::sort(field.roll_breaks_mm.begin(), field.roll_breaks_mm.end());
    return field;
  }

  /// The key that removes most at an end of the flank, whose own relief is given.
  [[nodiscard]] std::string deepest_key(const char* relief) const {
    std::pair<double, const char*> deepest{mm_from_um(value_of(relief)), relief};
    for (const auto& other :
         {std::pair{mm_from_um(m_.profile_crowning_um), "profile_crowning_um"},
          std::pair{mm_from_um(m_.crowning_um), "crowning_um"},
          std::pair{mm_from_um(m_.end_relief_um), "end_relief_um"},
          std::pair{0.5 * std::abs(mm_from_um(m_.profile_slope_um)), "profile_slope_um"},
          std::pair{0.5 * std::abs(mm_from_um(m_.helix_slope_um)), "helix_slope_um"},
          std::pair{m_.edge_chamfer_mm, "edge_chamfer_mm"}})
      if (other.first > deepest.first) deepest = other;
    return deepest.second;
  }
  [[nodiscard]] double value_of(const std::string& key) const {
    if (key == "tip_relief_um") return m_.tip_relief_um;
    if (key == "root_relief_um") return m_.root_relief_um;
    if (key == "profile_crowning_um") return m_.profile_crowning_um;
    if (key == "crowning_um") return m_.crowning_um;
    if (key == "end_relief_um") return m_.end_relief_um;
    if (key == "profile_slope_um") return m_.profile_slope_um;
    if (key == "helix_slope_um") return m_.helix_slope_um;
    return m_.edge_chamfer_mm;
  }

  [[nodiscard]] double steepest_slope(const FlankDeviation& field) const {
    constexpr int kSteps = 64;
    const double span = t_.tip_form_mm - t_.root_form_mm, width = face_.face_width_mm;
    // reliefs may be shorter than the steps below
    double steepest = steepest_of(t_.end_relief_mm, t_.end_length_mm, t_.end_shape);
    for (const RollRelief& relief : {t_.tip, t_.root})
      steepest = std::max(
          steepest, steepest_of(relief.amount_mm, relief.end_mm - relief.start_mm, relief.shape));
    for (Flank flank : {Flank::kLeft, Flank::kRight})
      for (int i = 0; i < kSteps; ++i) {
        const double roll = t_.root_form_mm + span * i / kSteps, z = width * i / kSteps;
        const auto d = [&](double l, double h) { return field.deviation_mm(0, flank, l, h); };
        steepest = std::max(
            {steepest, std::abs((d(roll + span / kSteps, 0.0) - d(roll, 0.0)) * kSteps / span),
             std::abs((d(roll, z + width / kSteps) - d(roll, z)) * kSteps / width)});
      }
    return steepest;
  }

  /// Least angle from the middle of a tooth to its flanks and fillets, at a height: that of the tip land or of a waist
  /// that undercut left.
  [[nodiscard]] double least_half_angle_rad(const Toothing& toothing, double z_mm) const {
    constexpr int kSteps = 48;
    double least = 1e300;
    for (std::size_t piece = involute_piece(profile_); piece < profile_.pieces().size(); ++piece) {
      const Curve& curve = profile_.pieces()[piece].curve;
      for (const int side : {1, -1})
        for (int i = 1; i <= kSteps; ++i) {  // not the tip, which has a check of its own
          const ToothPlace place{.tooth = 0,
                                 .side = side,
                                 .piece = piece,
                                 .parameter = std::lerp(curve.begin, curve.end, static_cast<double>(i) / kSteps)};
          least = std::min(least, side * polar_angle_rad(section_point(toothing, place, z_mm)));
        }
    }
    return least;
  }

  /// The chamfers of both flanks must not meet where undercut left the tooth thinnest.
  void check_waist(const Toothing& toothing) {
    if (m_.edge_chamfer_mm == 0.0) return;
    const auto keeps_apart = [&](double chamfer_mm) {
      Toothing chamfered = toothing;
      chamfered.edge_chamfer_mm = chamfer_mm;
      return least_half_angle_rad(chamfered, 0.0) > 0.0 &&
             least_half_angle_rad(chamfered, face_.face_width_mm) > 0.0;
    };
    if (!keeps_apart(m_.edge_chamfer_mm)) {
      const double most = sides_of_change(keeps_apart, 0.0, m_.edge_chamfer_mm, 20).first;
      report("edge_chamfer_mm", m_.edge_chamfer_mm,
             "meets that of the other flank at the end faces, where undercut left the tooth thinnest",
             "less than " + trimmed_number(most));
    }
  }

  void check(const FlankDeviation& field) {
    if (!field.empty() && leans_too_far(field)) return;
    if (field.empty() && m_.edge_chamfer_mm == 0.0) return;
    const Toothing toothing{.profile = &profile_,
                            .twist = face_,
                            .deviation = field.empty() ? nullptr : &field,
                            .edge_chamfer_mm = m_.edge_chamfer_mm};
    if (chamfer_takes_the_flank() || parts_flanks_that_meet(toothing)) return;
    check_tip_lands(toothing);
  }

  bool leans_too_far(const FlankDeviation& field) {
    const double slope = steepest_slope(field);
    if (!(slope > kSteepestSlope)) return false;
    errors_.push_back({.code = ErrorCode::kInfeasible,
                       .message = "the flank would lean by " + trimmed_number(slope) +
                                  " against the involute or the helix",
                       .key = "modifications",
                       .remedy = "smaller amounts or longer reliefs: a lean of at most " +
                                 trimmed_number(kSteepestSlope)});
    return true;
  }

  /// The chamfer lowers the tip at the end faces, where the fillet must not be reached.
  bool chamfer_takes_the_flank() {
    const double flank_mm = std::abs(profile_.tip_form_radius_mm() - profile_.root_form_radius_mm());
    if (!(m_.edge_chamfer_mm >= flank_mm && m_.edge_chamfer_mm > 0.0)) return false;
    report("edge_chamfer_mm", m_.edge_chamfer_mm,
           "lowers the tip at the end faces below the flank, which is " + trimmed_number(flank_mm) +
               " mm high between its form circles",
           "less than " + trimmed_number(flank_mm));
    return true;
  }

  /// Where the flanks of neighbours meet in the gap's middle, what moves them there parts or crosses them.
  bool parts_flanks_that_meet(const Toothing& toothing) {
    const ProfilePiece& last = profile_.pieces().back();
    if (last.kind != PieceKind::kInvolute) return false;
    const ToothPlace end{.tooth = 0,
                         .side = 1,
                         .piece = profile_.pieces().size() - 1,
                         .parameter = last.curve.end};
    for (int i = 0; i <= kHeights; ++i) {
      const double turn = deviation_turn_rad(toothing, end, height_mm(i));
      if (std::abs(turn) * profile_.root_radius_mm() < tolerance::kShortestPiece_mm) continue;
      const std::string key = deepest_key("root_relief_um");
      report(key, value_of(key),
             "moves flanks that meet in the middle of the gap, before the root circle",
             "none, or a rack.dedendum small enough to leave a root between them");
      return true;
    }
    return false;
  }

  void check_tip_lands(const Toothing& toothing) {
    double least = 1e300, most = -1e300, at = 0.0;
    for (int i = 0; i <= kHeights; ++i) {
      const double land = tip_land_half_angle_rad(toothing, height_mm(i));
      if (land < least) least = land, at = height_mm(i);
      most = std::max(most, land);
    }
    const double design = tooth_half_angle_rad(
        profile_.gear(), std::max(profile_.tip_radius_mm(), base_radius_mm(profile_.gear())));
    const double r_a = profile_.tip_radius_mm();
    const std::string key = deepest_key("tip_relief_um");
    if (profile_.notes().pointed && most * r_a > tolerance::kShortestPiece_mm)
      report(key, value_of(key), "adds to flanks that meet in a pointed tip, which would cross",
             "none, or a tip_diameter_mm below " + trimmed_number(2.0 * r_a) +
                 " mm, where the tooth has a land");
    else if (least > 0.0 || (design <= 0.0 && least >= design - 1e-12))
      check_waist(toothing);
    else
      report(key, value_of(key),
             "the modifications remove " + trimmed_number(1e3 * r_a * (design - least)) +
                 " um of arc at the tip of a flank (at z = " + trimmed_number(at) +
                 " mm), and half the tip land has " +
                 trimmed_number(1e3 * r_a * std::max(design, 0.0)) + " um",
             "less, or a tip_diameter_mm with a wider land");
  }

  static constexpr int kHeights = 16;  // equal steps over the face width
  [[nodiscard]] double height_mm(int step) const { return face_.face_width_mm * step / kHeights; }

  const ModificationsDesign& m_;
  const ToothProfile& profile_;
  FaceTwist face_;
  Terms t_;
  Errors errors_;
};

}  // namespace

bool deviates(const ModificationsDesign& m) {
  return m.tip_relief_um != 0.0 || m.root_relief_um != 0.0 || m.profile_crowning_um != 0.0 ||
         m.profile_slope_um != 0.0 || m.crowning_um != 0.0 || m.end_relief_um != 0.0 ||
         m.helix_slope_um != 0.0;
}

double tip_land_half_angle_rad(const Toothing& toothing, double z_mm) {
  const auto& pieces = toothing.profile->pieces();
  double least = 1e300;
  for (const int side : {1, -1}) {
    const ToothPlace place{.tooth = 0,
                           .side = side,
                           .piece = 0,
                           .parameter = pieces.front().kind == PieceKind::kTip
                                            ? pieces.front().curve.end
                                            : pieces.front().curve.begin};
    least = std::min(least, side * polar_angle_rad(section_point(toothing, place, z_mm)));
  }
  return least;
}

ResultAll<FlankDeviation> design_deviation(const ModificationsDesign& modifications,
                                           const ToothProfile& profile, const FaceTwist& face) {
  return DeviationBuilder(modifications, profile, face).build();
}

}  // namespace trueflank
