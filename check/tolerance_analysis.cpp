// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/tolerance_analysis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <random>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/clearance_field.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/mesh_findings.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/geometry/flank_tolerance.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

constexpr double kTolerableShare = 0.0027;  // outside of three standard deviations

Result<std::vector<GearSpread>> gear_spreads(const GearTrain& train, const ToleranceOptions& o) {
  std::vector<GearSpread> spreads;
  for (const TrainGear& gear : train.gears) {
    double runout = o.runout_um.value_or(0.0), pitch = o.pitch_um.value_or(0.0);
    if (o.tolerance_class) {
      const auto standard = flank_tolerances(
          tolerance_size(gear.profile.gear(), gear.face_width_mm), *o.tolerance_class);
      if (!standard) {
        Error error = standard.error();
        error.message = gear.name + ": " + error.message;
        return fail(std::move(error));
      }
      if (!o.runout_um) runout = standard->runout_um;
      if (!o.pitch_um) pitch = standard->single_pitch_um;
    }
    spreads.push_back({mm_from_um(o.tooth_thickness_um), 0.5 * mm_from_um(runout), mm_from_um(pitch)});
  }
  return spreads;
}

/// Normal deviates cut off at three standard deviations; the same on every machine.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : engine_(seed) {}
  /// With `limit` at three standard deviations.
  double within(double limit) {
    for (;;) {
      const double u = uniform(), v = uniform();
      const double z = std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(kTwoPi * v);
      if (std::abs(z) <= 3.0) return limit * z / 3.0;
    }
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::mt19937_64 engine_;
};

struct GearError {
  double thickness = 0.0, eccentricity = 0.0;
};

GearError draw(const GearSpread& spread, Normal& normal) {
  return {normal.within(spread.thickness_mm) + std::abs(normal.within(spread.pitch_mm)),
          std::abs(normal.within(spread.eccentricity_mm))};
}

void draw_sets(const GearTrain& train, const ToleranceOptions& options,
               const std::vector<GearSpread>& spreads, std::vector<ClearanceField>& fields,
               ToleranceResult& result) {
  Normal normal(options.seed);
  const Topology& topology = train.topology();
  std::size_t planets = 1;  // of the stage with most
  for (const std::vector<double>& positions : train.phases.position_rad)
    planets = std::max(planets, positions.size());
  std::vector<double> pins(static_cast<std::size_t>(topology.stage_count()));
  std::vector<int> jams(train.meshes.size(), 0);
  int any = 0;
  for (int set = 0; set < options.sets; ++set) {
    std::vector<bool> jammed(train.meshes.size(), false);
    std::vector<GearError> errors(train.gears.size());
    for (std::size_t g = 0; g < train.gears.size(); ++g) errors[g] = draw(spreads[g], normal);
    for (std::size_t i = 0; i < planets; ++i) {
      // sun and rings are one part, each planet is its own, on its own pin
      for (double& pin : pins) pin = normal.within(mm_from_um(options.centre_distance_um));
      for (std::size_t g = 0; g < train.gears.size(); ++g)
        if (i > 0 && train.topology().is_planet_gear(g)) errors[g] = draw(spreads[g], normal);
      for (std::size_t m = 0; m < train.meshes.size(); ++m) {
        const TopologyGear& gear1 = topology.gears[static_cast<std::size_t>(train.meshes[m].gear1)];
        const TopologyGear& gear2 = topology.gears[static_cast<std::size_t>(train.meshes[m].gear2)];
        if (static_cast<int>(i) >= std::max(train.copies_of(gear1.member), train.copies_of(gear2.member))) continue;
        const double pin = pins[static_cast<std::size_t>(gear1.stage) - 1];
        const GearError& e1 = errors[static_cast<std::size_t>(train.meshes[m].gear1)];
        const GearError& e2 = errors[static_cast<std::size_t>(train.meshes[m].gear2)];
        const double wobble = e1.eccentricity + e2.eccentricity;
        const double thickness = e1.thickness + e2.thickness;
        const double clearance = std::min(fields[m].clearance_mm(pin - wobble, thickness),
                                          fields[m].clearance_mm(pin + wobble, thickness));
        if (clearance < -tolerance::kTouch_mm) jammed[m] = true;
      }
    }
    for (std::size_t m = 0; m < jammed.size(); ++m) jams[m] += jammed[m];
    any += std::find(jammed.begin(), jammed.end(), true) != jammed.end();
  }
  result.sets = options.sets;
  result.jam_share = static_cast<double>(any) / options.sets;
  for (std::size_t m = 0; m < jams.size(); ++m)
    result.meshes[m].jam_share = static_cast<double>(jams[m]) / options.sets;
}

Status check_options(const ToleranceOptions& o) {
  const std::pair<const char*, double> values[] = {{"centre_distance_um", o.centre_distance_um},
                                                   {"tooth_thickness_um", o.tooth_thickness_um},
                                                   {"runout_um", o.runout_um.value_or(0.0)},
                                                   {"pitch_um", o.pitch_um.value_or(0.0)}};
  for (const auto& [name, value] : values)
    if (!(value >= 0.0) || !std::isfinite(value))
      return fail({.code = ErrorCode::kOutOfRange,
                   .message = std::string("a tolerance cannot be ") + number_text(value),
                   .key = std::string("tolerances.") + name,
                   .value = number_text(value),
                   .remedy = "0 or more"});
  return {};
}

}  // namespace

Result<ToleranceResult> analyse_tolerances(const GearTrain& train, const ToleranceOptions& options) {
  if (auto ok = check_options(options); !ok) return fail(ok.error());
  const auto spreads = gear_spreads(train, options);
  if (!spreads) return fail(spreads.error());
  ToleranceResult result;
  std::vector<ClearanceField> fields;
  for (const TrainMesh& mesh : train.meshes) {
    auto field = ClearanceField::make(train, mesh, (*spreads)[static_cast<std::size_t>(mesh.gear1)],
                                      (*spreads)[static_cast<std::size_t>(mesh.gear2)],
                                      mm_from_um(options.centre_distance_um));
    if (!field) {
      Error error = field.error();
      error.message = mesh.name + " at the limits of its tolerances: " + error.message;
      return fail(std::move(error));
    }
    const ChangedPair& nominal = field->at(1, 1);
    const double backlash =
        is_modified(train, mesh) ? nominal.backlash_mm : mesh.backlash_mm;
    MeshTolerance smallest{backlash, backlash, nominal.clearance_mm, 0.0};
    for (int i = 0; i < ClearanceField::kPlaces; ++i)
      for (int k = 0; k < ClearanceField::kPlaces; ++k) {
        const ChangedPair& pair = field->at(i, k);
        smallest.smallest_backlash_mm = std::min(smallest.smallest_backlash_mm, pair.backlash_mm);
        smallest.smallest_clearance_mm = std::min(smallest.smallest_clearance_mm, pair.clearance_mm);
      }
    result.meshes.push_back(smallest);
    fields.push_back(std::move(*field));
  }
  draw_sets(train, options, *spreads, fields, result);
  return result;
}

Findings check_tolerance(const GearTrain& train, const ToleranceResult& result) {
  const auto status_of = [](double clearance_mm, double share) {
    if (clearance_mm >= -tolerance::kTouch_mm) return CheckStatus::kPass;
    return share <= kTolerableShare ? CheckStatus::kWarn : CheckStatus::kFail;
  };
  Findings findings;
  double worst = 1e300;
  for (std::size_t m = 0; m < result.meshes.size(); ++m) {
    const MeshTolerance& mesh = result.meshes[m];
    worst = std::min(worst, mesh.smallest_clearance_mm);
    Finding finding{.id = "tolerance",
                    .where = train.meshes[m].name,
                    .status = status_of(mesh.smallest_clearance_mm, mesh.jam_share),
                    .value = um_from_mm(mesh.smallest_clearance_mm),
                    .limit = 0.0,
                    .margin = um_from_mm(mesh.smallest_clearance_mm),
                    .unit = "um"};
    finding.message = "at the limits of the tolerances backlash falls from " +
                      um_text(mesh.nominal_backlash_mm) + " to " + um_text(mesh.smallest_backlash_mm) +
                      ", clearance to " + um_text(mesh.smallest_clearance_mm) + "; " +
                      number_text(100.0 * mesh.jam_share, 2) + " % of the sets jam here";
    if (finding.status != CheckStatus::kPass)
      finding.cure = "backlash_mm of at least " +
                     bound_text(mesh.nominal_backlash_mm -
                                     std::min(mesh.smallest_backlash_mm, 2.0 * mesh.smallest_clearance_mm),
                                 Rounded::kUp, 3) +
                     ", or closer tolerances";
    findings.push_back(std::move(finding));
  }
  if (result.meshes.empty()) return findings;
  const double share = 100.0 * result.jam_share;
  findings.push_back({.id = "tolerance",
                      .where = "train",
                      .status = status_of(worst, result.jam_share),
                      .value = share,
                      .limit = 100.0 * kTolerableShare,
                      .margin = 100.0 * kTolerableShare - share,
                      .unit = "%",
                      .message = number_text(100.0 - share, 2) + " % of " + std::to_string(result.sets) +
                                 " sets of parts drawn within the tolerances assemble and run, " +
                                 number_text(share, 2) + " % jam",
                      .cure = worst >= -tolerance::kTouch_mm
                                  ? ""
                                  : "more backlash or closer tolerances where the meshes say so"});
  return findings;
}

namespace {

Error unreadable(const std::string& part) {
  return {.code = ErrorCode::kUsage,
          .message = "`" + part + "` is no tolerance",
          .value = part,
          .remedy = "a class of ISO 1328-1 (--tolerance 7), or centre_distance_um=20,"
                    "tooth_thickness_um=10,runout_um=15,pitch_um=5,class=7"};
}

}  // namespace

Result<ToleranceOptions> parse_tolerance(const std::string& text) {
  ToleranceOptions options;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, comma - at);
    at = comma + 1;
    const std::size_t equals = part.find('=');
    const std::string key = equals == std::string::npos ? "class" : part.substr(0, equals);
    const std::string number = equals == std::string::npos ? part : part.substr(equals + 1);
    double value = 0.0;
    const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
    if (read.ec != std::errc() || read.ptr != number.data() + number.size() || !std::isfinite(value))
      return fail(unreadable(part));
    if (key == "centre_distance_um") options.centre_distance_um = value;
    else if (key == "tooth_thickness_um") options.tooth_thickness_um = value;
    else if (key == "runout_um") options.runout_um = value;
    else if (key == "pitch_um") options.pitch_um = value;
    else if (key == "class" && value == std::floor(value) && std::abs(value) < 100.0)
      options.tolerance_class = static_cast<int>(value);
    else return fail(unreadable(part));
  }
  return options;
}

}  // namespace trueflank
