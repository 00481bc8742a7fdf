// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/base/units.h"

namespace trueflank {

/// What strength and inertia need to know of a material.
struct Material {
  std::string name;
  double bending_limit_mpa = kNaN;  ///< sigma_Flim of JGMA 401-01: pulsating, no notch factor beside it
  double contact_limit_mpa = kNaN;  ///< sigma_Hlim
  double elastic_modulus_mpa = kNaN;
  double poisson_ratio = kNaN;
  double density_kg_m3 = kNaN;
  std::string source = {};  ///< where the limits come from, or that they are assumed

  bool operator==(const Material&) const = default;
};

/// A table a user can extend and override (docs/strength.md).
class MaterialTable {
 public:
  /// The built-in materials.
  MaterialTable();

  /// Adds a material, or replaces the one of that name.
  void set(Material material);
  /// nullptr where there is none.
  [[nodiscard]] const Material* find(const std::string& name) const;
  [[nodiscard]] const std::vector<Material>& all() const { return materials_; }

 private:
  std::vector<Material> materials_;
};

/// What gears are made of where nobody says.
inline constexpr const char* kDefaultMaterial = "scm440-hb280";

}  // namespace trueflank
