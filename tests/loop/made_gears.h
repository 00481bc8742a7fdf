// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/loop/measured_process.h"
#include "tests/support/survey_size.h"
#include "trueflank/loop/gear/close_loop.h"

// The library's gear for a made one, and the loop closed on what was measured of it.
namespace trueflank::test {

/// Design with the transverse tooth data of the made gear.
inline Gear design_of(const MadeGear& made) {
  Gear gear;
  gear.kind = made.ring ? GearKind::kInternal : GearKind::kExternal;
  gear.teeth = made.teeth;
  gear.helix_angle_rad = made.helix_rad;
  gear.normal_module_mm = made.module_mm * std::cos(made.helix_rad);
  gear.rack.pressure_angle_rad =
      std::atan(std::tan(made.pressure_angle_rad) * std::cos(made.helix_rad));
  // x m tan(alpha) is the same length in both sections' formulas only if x is converted.
  gear.shift = made.shift * std::tan(made.pressure_angle_rad) /
               std::tan(gear.rack.pressure_angle_rad);
  gear.tip_radius_mm = made.tip_mm;
  return gear;
}

/// A made gear whose flank ends where the designed one's does.
inline MadeGear spur(int teeth) {
  MadeGear made;
  made.teeth = teeth;
  made.tip_mm = made.reference() + 1.0;
  made.root_form_mm = ToothProfile::make(design_of(made))->root_form_radius_mm();
  return made;
}
inline MadeGear ring(int teeth) {
  MadeGear made;
  made.teeth = teeth;
  made.ring = true;
  made.tip_mm = made.reference() - 0.8;
  const auto profile = ToothProfile::make(design_of(made));
  made.root_form_mm = profile->root_form_radius_mm();
  made.tip_mm = profile->tip_form_radius_mm();
  return made;
}
inline MadeGear helical(int teeth, double deg) {
  MadeGear made;
  made.teeth = teeth;
  made.helix_rad = deg * M_PI / 180.0;
  made.tip_mm = made.reference() + 0.9;
  made.root_form_mm = ToothProfile::make(design_of(made))->root_form_radius_mm();
  return made;
}

inline loop::FlankGeometry geometry_of(const MadeGear& made) {
  return {*ToothProfile::make(design_of(made)), made.face_mm};
}

inline loop::LoopResult close(const MadeGear& made, const loop::ScanData& scan, bool aligned) {
  loop::MeasuredData data;
  data.scans.push_back(scan);
  return loop::close_loop(geometry_of(made), "gear", data, {.aligned = aligned})->result;
}
inline loop::LoopResult close(const MadeGear& made, const loop::InspectionData& inspection) {
  loop::MeasuredData data;
  data.inspections.push_back(inspection);
  return loop::close_loop(geometry_of(made), "gear", data, {})->result;
}

inline const loop::FoundEffect* find(const loop::LoopResult& result, const std::string& id) {
  for (const auto& effect : result.effects)
    if (effect.id == id) return &effect;
  return nullptr;
}
inline const loop::Parameter& parameter(const loop::FoundEffect& effect, const std::string& name) {
  for (const auto& p : effect.parameters)
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}
inline bool has_name(const loop::LoopResult& result) {
  return std::any_of(result.effects.begin(), result.effects.end(),
                     [](const auto& effect) { return effect.named; });
}
inline ScanOptions scanned(int points, double noise_um, unsigned seed) {
  ScanOptions options;
  options.points = points;
  options.noise_um = noise_um;
  options.seed = seed;
  return options;
}
/// Profile and helix traces of these teeth, without an index.
inline InspectionOptions traced(std::vector<int> teeth, double noise_um, unsigned seed) {
  InspectionOptions options;
  options.teeth = std::move(teeth);
  options.points = 120;
  options.noise_um = noise_um;
  options.index = false;
  options.seed = seed;
  return options;
}
/// The effects in one line, for messages of failing tests.
inline std::string list(const loop::LoopResult& result) {
  std::string text = to_text(result.verdict);
  if (result.verdict == loop::Verdict::kPartlyExplained) text += " (" + result.structure_left + ")";
  for (const auto& effect : result.effects) {
    text += "; " + effect.id + " " + effect.flank;
    for (const auto& p : effect.parameters) text += " " + p.name + "=" + std::to_string(p.value);
    if (!effect.named) text += " {" + effect.description + "}";
    for (const auto& other : effect.confounded_with) text += " ~" + other;
  }
  return text;
}

/// True where the answer has these words.
inline bool tells(const loop::LoopResult& result, const std::string& words) {
  return list(result).find(words) != std::string::npos;
}

/// Of a pit, a lump, or a part of one flank.
inline bool tells_spot(const loop::LoopResult& result) {
  const std::string told = list(result);
  for (const char* words : {"a pit on the", "a lump on the", "part of the left flank", "part of the right flank"})
    if (told.find(words) != std::string::npos) return true;
  return false;
}

/// A named effect is there, with a parameter of about this size.
inline void expect_size(const loop::LoopResult& result, const std::string& name,
                        const std::string& what, double size, double most_off) {
  ASSERT_NE(find(result, name), nullptr) << list(result);
  EXPECT_NEAR(parameter(*find(result, name), what).value, size, most_off) << list(result);
}

}  // namespace trueflank::test
