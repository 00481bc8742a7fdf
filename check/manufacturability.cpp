// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/manufacturability.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

/// A place of a part against what the process can make.
struct Feature {
  std::string what;
  double value_mm = kNaN, limit_mm = 0.0;
  std::string cure;
};

/// Farthest point of a bore from the axis.
double reach_mm(const BoreDesign& bore) {
  const double r = 0.5 * bore.diameter_mm;
  if (bore.kind == BoreKind::kHex) return r / std::cos(kPi / 6.0);
  if (bore.kind == BoreKind::kKeyway)
    return std::hypot(r + bore.keyway_depth_mm, 0.5 * bore.keyway_width_mm);
  return r;
}

/// The wall between bore and root circle; nothing where there is no bore.
std::optional<Feature> bore_wall(const GearTrain& train, const TrainGear& gear,
                                 const Process& process) {
  const BoreDesign& bore =
      first_of_body(train.design, static_cast<std::size_t>(&gear - train.gears.data())).bore;
  if (bore.diameter_mm <= 0.0) return std::nullopt;
  return Feature{"wall between bore and root circle",
                 gear.profile.root_radius_mm() - reach_mm(bore), process.least_wall_mm,
                 "a smaller bore"};
}

std::optional<Feature> rim_wall(const GearTrain& train, const TrainGear& gear,
                                const Process& process) {
  const GearDesign* design = find_gear(train.design, gear.name);
  if (!design || !design->outer_diameter_mm) return std::nullopt;
  return Feature{"rim", 0.5 * *design->outer_diameter_mm - gear.profile.root_radius_mm(),
                 process.least_wall_mm, "a larger outer_diameter_mm"};
}

std::vector<Feature> features_of(const GearTrain& train, const TrainGear& gear,
                                 const Process& process) {
  std::vector<Feature> features{
      {"tooth tip", least_tip_thickness_mm(gear), process.least_tip_mm,
       "a larger module, or a shorter tooth (tip_diameter_mm)"},
      {"gap between teeth at the root form circle", least_gap_mm(gear.profile),
       process.least_gap_mm, "a larger module"},
      {"radius of the root", least_root_radius_mm(gear.profile), process.least_root_radius_mm,
       "a larger rack.root_radius (a ring's cutter.tip_radius) or module"}};
  const bool ring = gear.profile.gear().kind == GearKind::kInternal;
  if (auto wall = ring ? rim_wall(train, gear, process) : bore_wall(train, gear, process))
    features.push_back(std::move(*wall));
  return features;
}

/// A value that equals its limit but for rounding meets it.
double met_margin(double margin_mm) {
  return std::abs(margin_mm) < tolerance::kTouch_mm ? 0.0 : margin_mm;
}

Finding judge_gear(const GearTrain& train, const TrainGear& gear, const Process& process) {
  Finding finding{.id = "manufacturability", .where = gear.name, .unit = "mm"};
  std::string below;
  for (const Feature& feature : features_of(train, gear, process)) {
    if (feature.limit_mm <= 0.0) continue;
    const double margin = met_margin(feature.value_mm - feature.limit_mm);
    if (std::isnan(finding.margin) || margin < finding.margin) {
      finding.value = feature.value_mm;
      finding.limit = feature.limit_mm;
      finding.margin = margin;
    }
    if (margin >= 0.0) continue;
    finding.status = CheckStatus::kWarn;
    below += (below.empty() ? "" : "; ") + feature.what + " " + mm_text(feature.value_mm) +
             ", least " + mm_text(feature.limit_mm);
    finding.cure += (finding.cure.empty() ? "" : "; ") + feature.cure;
  }
  finding.message = gear.name + " by " + process.name + ": " +
                    (below.empty() ? std::string("nothing is below what the process makes") : below);
  return finding;
}

Finding judge_mesh(const GearTrain& train, const TrainMesh& mesh, const Process& process) {
  const double of_modifications = mesh.backlash_mm - modified_mesh(train, mesh).backlash_mm;
  const double least =
      (std::isnan(mesh.smallest_backlash_mm) ? mesh.backlash_mm : mesh.smallest_backlash_mm) -
      of_modifications;
  Finding finding{.id = "manufacturability",
                  .where = mesh.name,
                  .value = least,
                  .limit = process.backlash_mm,
                  .margin = met_margin(least - process.backlash_mm),
                  .unit = "mm"};
  finding.message = "backlash " + mm_text(least) + ", " + process.name + " wants " +
                    mm_text(process.backlash_mm);
  if (finding.margin >= 0.0) return finding;
  finding.status = CheckStatus::kWarn;
  finding.cure = "backlash_mm = " + bound_text(process.backlash_mm, Rounded::kUp, 3);
  return finding;
}

}  // namespace

double least_root_radius_mm(const ToothProfile& profile) {
  constexpr int kSteps = 200;
  double least = kNaN;
  const auto& pieces = profile.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Curve& curve = pieces[i].curve;
    if (pieces[i].kind == PieceKind::kRoot && i > 0) {
      const Curve& before = pieces[i - 1].curve;
      const double turn = std::abs(cross(tangent_at(before, before.end), tangent_at(curve, curve.begin)));
      if (turn > 1e-3) return 0.0;
    }
    if (pieces[i].kind != PieceKind::kFillet || std::holds_alternative<Involute>(curve.shape))
      continue;
    const double step = (curve.end - curve.begin) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double from = curve.begin + step * k, to = from + step;
      const Point2 a = tangent_at(curve, from), b = tangent_at(curve, to);
      const double turn = std::abs(std::atan2(cross(a, b), a.dot(b)));
      const double length = (point_at(curve, to) - point_at(curve, from)).norm();
      const double radius = length / turn;
      if (turn > 0.0 && !(radius >= least)) least = radius;
    }
  }
  return least;
}

double least_gap_mm(const ToothProfile& profile) {
  const Gear& gear = profile.gear();
  const double radius = profile.root_form_radius_mm();
  return 2.0 * radius * std::sin(kPi / gear.teeth - tooth_half_angle_rad(gear, radius));
}

Findings check_manufacturability(const GearTrain& train) {
  Findings findings;
  if (!train.design.made.process) return findings;
  const Process& process = *train.design.made.process;
  for (const TrainGear& gear : train.gears) findings.push_back(judge_gear(train, gear, process));
  if (process.backlash_mm > 0.0)
    for (const TrainMesh& mesh : train.meshes) findings.push_back(judge_mesh(train, mesh, process));
  return findings;
}

}  // namespace trueflank
