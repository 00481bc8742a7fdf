// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/loop/gear/effect.h"

namespace trueflank::loop {

/// An effect that a user describes: what it is called and, for every parameter, the deviation [um
/// along the normal, + = material] that one unit of it makes on a flank, as a formula.
/// Variables: u (-1 root form ... +1 tip, in roll length), v (-1 lower ... +1 upper end of the face),
/// roll_mm, height_mm, radius_mm, theta (angle of the tooth, rad, tooth 1 at 0), angle (of the point,
/// rad), tooth (1, 2, ...), side (+1 counter-clockwise flank, -1 clockwise), teeth, face_mm, module_mm.
struct DeclaredEffect {
  std::string id;
  std::string description = {}, cause = {}, correction = {};
  bool correctable = true;
  bool one_flank_too = false;  ///< may also act on one flank alone
  std::vector<std::pair<std::string, std::string>> columns;  ///< parameter name (with unit), formula
};

inline constexpr int kMostDeclaredColumns = 6;

/// A family of the library from a declaration.
/// Errors: kOutOfRange (no parameter or too many, an id of the library), kSyntax (a formula), each with
/// the key "ID.parameter".
[[nodiscard]] ResultAll<EffectFamily> declared_family(const DeclaredEffect& declared);

}  // namespace trueflank::loop
