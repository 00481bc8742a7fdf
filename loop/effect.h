// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trueflank/loop/flank_geometry.h"

namespace trueflank::loop {

/// Which flanks an effect acts on.
enum class FlankChoice { kBoth, kLeft, kRight };

/// How coefficients of the columns become the parameters people read.
enum class ParameterForm {
  kPlain,  ///< a parameter a column
  kWave,   ///< two columns (cosine, sine): amplitude and phase
};

/// What the correction may do with an effect.
enum class Correctable { kGeometry, kNoCause };

/// One kind of effect: where its columns come from and how it is told. A new effect is one entry in
/// one of the effects_*.cpp tables.
/// Columns are the deviation [um, + = material, along the normal] per unit coefficient; coefficients are
/// in the parameters' unit.
struct EffectFamily {
  std::string id;
  std::string description;
  std::string cause;
  std::string correction;  ///< what the manufacturer should do
  std::vector<std::string> parameters;  ///< kPlain: one a column; kWave: amplitude, phase
  /// Values that shape the columns and are searched: order, height_mm, tooth, ...
  std::vector<std::string> shape_names = {};
  ParameterForm form = ParameterForm::kPlain;
  double phase_divisor = 1.0;       ///< kWave: phase = angle / divisor (2 for an axis in the plane)
  bool one_flank_too = false;       ///< may act on one flank only
  bool flank_only = false;          ///< must act on one flank only
  bool local = false;               ///< lives on one tooth
  bool only_positive = false;       ///< an amount below zero is not this effect
  bool shape_is_continuous = false; ///< refined after the choice
  bool named = true;
  Correctable correctable = Correctable::kGeometry;
  int preference = 0;               ///< lower wins between equals
  /// Declared by a user: name and formula of every parameter, as declared.
  std::vector<std::pair<std::string, std::string>> formulas = {};
  std::function<int(const std::vector<double>& shape)> columns;
  std::function<std::vector<std::vector<double>>(const FlankGeometry&)> shapes;
  std::function<void(const FlankGeometry&, const Place&, const std::vector<double>& shape,
                     double* columns)>
      evaluate;
  /// Effects that move the body: the displacement [mm] of a point [mm] for coefficients in the
  /// parameters' units; empty where the deviation along the normal says all.
  std::function<std::array<double, 3>(const FlankGeometry&, const std::array<double, 3>& point,
                                      const std::vector<double>& shape, const double* coefficients)>
      displacement_mm;
};

/// An effect with its shape fixed: what a candidate of the selection is.
struct Effect {
  const EffectFamily* family = nullptr;
  FlankChoice flank = FlankChoice::kBoth;
  std::vector<double> shape;

  [[nodiscard]] int columns() const { return family->columns(shape); }
  /// Columns at a place; zero where the effect does not act on that flank.
  void evaluate(const FlankGeometry& geometry, const Place& place, double* values) const;
};

/// The library: all families, named ones first. Lives as long as the program.
[[nodiscard]] const std::vector<EffectFamily>& effect_library();
/// The family of an id; nullptr where there is none.
[[nodiscard]] const EffectFamily* find_family(const std::string& id);
/// Families a user declared. Shared: effects point into them.
using DeclaredFamilies = std::shared_ptr<const std::vector<EffectFamily>>;
/// Every candidate for a gear: of the library and of what the user declared.
[[nodiscard]] std::vector<Effect> candidate_effects(const FlankGeometry& geometry,
                                                    const DeclaredFamilies& declared = nullptr);

/// @name Parts of the library, by what the effects act on
/// @{
[[nodiscard]] std::vector<EffectFamily> body_effects();   ///< move the tooth system or all walls
[[nodiscard]] std::vector<EffectFamily> flank_effects();  ///< shape every flank alike
[[nodiscard]] std::vector<EffectFamily> wave_effects();   ///< vary around the gear
[[nodiscard]] std::vector<EffectFamily> free_effects();   ///< described, not explained
/// @}

/// Share of the flank's normal that lies in the transverse plane: what a displacement there is worth.
[[nodiscard]] double normal_part(const FlankGeometry& geometry, const Place& place, double ux,
                                 double uy);

}  // namespace trueflank::loop
