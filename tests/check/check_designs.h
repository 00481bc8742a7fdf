// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tests/support/train_members.h"
#include "trueflank/check/finding.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/gear_train.h"

// Designs the tests of the checks start from.
namespace trueflank::test {

/// The paper's prototype, 12/39/90/32/81.
inline GearboxDesign paper_design(double backlash_mm = 0.05) {
  GearboxDesign d{.name = "bilateral-drive-96",
                  .topology = train_topology("3k", "ring2"),
                  .planets = 3,
                  .centre_distance_mm = 25.6826,
                  .backlash_mm = backlash_mm,
                  .tips = TipCircles::kStandard};
  d.gears = {{.name = "sun", .teeth = 12},
             {.name = "planet1", .teeth = 39},
             {.name = "ring1", .kind = GearKind::kInternal, .teeth = 90, .shift = 0.5225},
             {.name = "planet2", .teeth = 32},
             {.name = "ring2", .kind = GearKind::kInternal, .teeth = 81, .shift = 1.9967}};
  return d;
}

inline GearboxDesign simple_design(int sun, int planet, int ring, int planets) {
  GearboxDesign d{.name = "simple",
                  .topology = train_topology("simple", "carrier"),
                  .planets = planets,
                  .tips = TipCircles::kStandard};
  d.gears = {{.name = "sun", .teeth = sun},
             {.name = "planet", .teeth = planet},
             {.name = "ring", .kind = GearKind::kInternal, .teeth = ring}};
  return d;
}

inline GearboxDesign pair_design(int pinion, int wheel, bool internal, double backlash_mm = 0.0) {
  GearboxDesign d{.name = "pair",
                  .topology = train_topology("pair"),
                  .backlash_mm = backlash_mm,
                  .tips = TipCircles::kStandard};
  d.gears = {{.name = "pinion", .teeth = pinion},
             {.name = "wheel",
              .kind = internal ? GearKind::kInternal : GearKind::kExternal,
              .teeth = wheel}};
  return d;
}

inline GearDesign& gear(GearboxDesign& design, const std::string& name) {
  for (GearDesign& g : design.gears)
    if (g.name == name) return g;
  throw std::logic_error("no gear " + name);
}

/// The number that stands after some words of a message; not a number where they are not said.
inline double told(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

/// The one finding of an id at a place; throws where there is none.
inline Finding only(const Findings& findings, const std::string& id, const std::string& where = "") {
  for (const Finding& f : findings)
    if (f.id == id && (where.empty() || f.where == where)) return f;
  throw std::logic_error("no finding " + id + " at " + where);
}

}  // namespace trueflank::test
