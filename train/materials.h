// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueflank/base/units.h"

namespace trueflank {

/// A fatigue limit that falls with temperature T [C] and load cycles N:
/// base - fall T^fall_exponent + (life - life_fall T^life_fall_exponent) N^-life_exponent [MPa].
struct PlasticLimit {
  double base = kNaN, fall = 0.0, fall_exponent = 1.0;
  double life = 0.0, life_fall = 0.0, life_fall_exponent = 1.0, life_exponent = 0.0;

  /// Never below 0.
  [[nodiscard]] double at(double temperature_c, double cycles) const;
  bool operator==(const PlasticLimit&) const = default;
};

/// What a plastic's rating needs beside (strength_plastic.h).
struct PlasticProperties {
  PlasticLimit root, flank;
  double highest_c = kNaN;                 ///< of the tooth, for years
  double dry_friction = kNaN;              ///< against steel
  double wear_mm3_per_nm = kNaN;           ///< dry, against steel; NaN: not known
  double modulus_falls_per_c = 0.0;        ///< share of the elastic modulus lost a degree above 23 C
  std::string source = {};                 ///< or that it is assumed

  bool operator==(const PlasticProperties&) const = default;
};

/// What strength and inertia need to know of a material.
struct Material {
  std::string name;
  double bending_limit_mpa = kNaN;  ///< sigma_Flim of JGMA 401-01: pulsating, no notch factor beside it
  double contact_limit_mpa = kNaN;  ///< sigma_Hlim
  double elastic_modulus_mpa = kNaN;
  double poisson_ratio = kNaN;
  double density_kg_m3 = kNaN;
  std::string source = {};  ///< where the limits come from, or that they are assumed
  std::optional<PlasticProperties> plastic = {};

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
