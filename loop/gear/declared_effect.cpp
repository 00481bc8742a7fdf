// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/declared_effect.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/gear/formula.h"

namespace trueflank::loop {
namespace {

const std::vector<std::string>& variable_names() {
  static const std::vector<std::string> names{"u",     "v",     "roll_mm", "height_mm",
                                              "radius_mm", "theta", "angle",   "tooth",
                                              "side",  "teeth", "face_mm", "module_mm"};
  return names;
}

std::array<double, 12> variables_at(const FlankGeometry& g, const Place& p) {
  return {g.profile_coordinate(p.roll_mm),
          g.face_coordinate(p.z_mm),
          p.roll_mm,
          p.z_mm,
          p.radius_mm,
          g.centre_rad(p.tooth),
          p.polar_rad,
          static_cast<double>(p.tooth),
          static_cast<double>(p.side),
          static_cast<double>(g.teeth()),
          g.face_width_mm(),
          g.gear().normal_module_mm};
}

}  // namespace

ResultAll<EffectFamily> declared_family(const DeclaredEffect& declared) {
  Errors errors;
  if (find_family(declared.id) != nullptr)
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = "the library has an effect of this name",
                      .key = declared.id,
                      .remedy = "another name"});
  const auto count = static_cast<int>(declared.columns.size());
  if (count < 1 || count > kMostDeclaredColumns)
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = "an effect has 1 to " + std::to_string(kMostDeclaredColumns) +
                                 " parameters, each with its formula",
                      .key = declared.id + ".form",
                      .value = std::to_string(count)});
  EffectFamily family;
  std::vector<Formula> formulas;
  double operations = 0.0;
  for (const auto& [name, text] : declared.columns) {
    auto formula = Formula::make(text, variable_names());
    if (!formula) {
      errors.push_back(formula.error());
      errors.back().key = declared.id + ".form." + name;
      continue;
    }
    operations += static_cast<double>(formula->operations());
    formulas.push_back(std::move(*formula));
    family.parameters.push_back(name);
  }
  if (!errors.empty()) return fail_all(std::move(errors));
  family.id = declared.id;
  family.description = declared.description;
  family.cause = declared.cause;
  family.correction = declared.correction;
  family.one_flank_too = declared.one_flank_too;
  family.correctable = declared.correctable ? Correctable::kGeometry : Correctable::kNoCause;
  family.formulas = declared.columns;
  family.operations += operations;
  family.bends_over_the_face = [](const EffectShape&) { return true; };
  family.columns = [count](const std::vector<double>&) { return count; };
  family.evaluate = [formulas](const FlankGeometry& g, const Place& p, const std::vector<double>&,
                               double* c) {
    std::fill_n(c, formulas.size(), 0.0);
    if (p.surface != Surface::kFlank) return;
    const auto values = variables_at(g, p);
    for (std::size_t k = 0; k < formulas.size(); ++k) {
      const double value = formulas[k](values.data());
      c[k] = std::isfinite(value) ? value : 0.0;
    }
  };
  return family;
}

}  // namespace trueflank::loop
