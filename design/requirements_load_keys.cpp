// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_sections.h"

#include <cstddef>
#include <string_view>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"

namespace trueflank {
namespace requirements {
namespace {

KeyRule drive_rule(const char* name, const char* unit, double upper, const char* by_default,
                   const char* meaning) {
  return {.name = name, .unit = unit, .lower = 0, .upper = upper, .by_default = by_default, .meaning = meaning};
}

KeyRule factor_rule(const char* name, const char* by_default, const char* meaning) {
  return {.name = name, .lower = 0.01, .upper = 100, .by_default = by_default, .meaning = meaning};
}

template <std::size_t I>
std::string set_loss(R& r, const V& v) {
  if (!r.losses) r.losses.emplace();
  losses_keys()[I].set(*r.losses, v);
  return {};
}

constexpr std::size_t kLossKeys = 18;

/// The keys of the design file's `[losses]`.
template <std::size_t... I>
RequirementsSection losses_of(std::index_sequence<I...>) {
  TRUEFLANK_EXPECTS(losses_keys().size() == kLossKeys);
  RequirementsSection section{"losses", {}};
  (section.keys.push_back({losses_keys()[I].rule, set_loss<I>}), ...);
  // The table may be left out; a load it needs is 1 N m then, a speed 0.
  for (auto& key : section.keys)
    if (key.rule.required) {
      key.rule.required = false;
      key.rule.by_default = key.rule.name == std::string_view("load_nm") ? "1" : "0";
    }
  return section;
}

}  // namespace

RequirementsSection motor() {
  return {"motor",
          {{drive_rule("torque_nm", "N m", 1e9, "none", "at the input, either way"),
            [](R& r, const V& v) { return r.motor.torque_nm = number(v), std::string(); }},
           {drive_rule("speed_rpm", "rpm", 1e7, "none", "the motor turns no faster"),
            [](R& r, const V& v) { return r.motor.speed_rpm = number(v), std::string(); }},
           {drive_rule("rotor_inertia_kg_m2", "kg m2", 1e6, "0", "of the motor, on the input"),
            [](R& r, const V& v) { return r.motor.rotor_kg_m2 = number(v), std::string(); }},
           {drive_rule("load_inertia_kg_m2", "kg m2", 1e9, "0", "on the output"),
            [](R& r, const V& v) { return r.motor.load_kg_m2 = number(v), std::string(); }},
           {drive_rule("load_torque_nm", "N m", 1e9, "0", "on the output, against its motion"),
            [](R& r, const V& v) { return r.motor.load_nm = number(v), std::string(); }},
           {drive_rule("move_deg", "deg", 1e6, "90", "of the output from rest to rest, for `settling`"),
            [](R& r, const V& v) { return r.motor.move_rad = rad_from_deg(number(v)), std::string(); }}}};
}

RequirementsSection strength() {
  return {
      "strength",
      {{{.name = "output_torque_nm",
         .unit = "N m",
         .lower = 0,
         .upper = 1e9,
         .by_default = "none",
         .meaning = "to be carried by every design"},
        [](R& r, const V& v) { return r.output_torque_nm = number(v), std::string(); }},
       {{.name = "material",
         .type = KeyType::kText,
         .by_default = kDefaultMaterial,
         .meaning = "of every gear (docs/strength.md)"},
        [](R& r, const V& v) { return r.strength.material = text(v), std::string(); }},
       {{.name = "reversing",
         .type = KeyType::kFlag,
         .by_default = "true",
         .meaning = "loaded in both directions"},
        [](R& r, const V& v) { return r.strength.reversing = flag(v), std::string(); }},
       {factor_rule("overload_factor", "1", "K_O"),
        [](R& r, const V& v) { return r.strength.overload_factor = number(v), std::string(); }},
       {factor_rule("dynamic_factor", "1", "K_V"),
        [](R& r, const V& v) { return r.strength.dynamic_factor = number(v), std::string(); }},
       {factor_rule("face_load_factor", "1", "K_Hbeta"),
        [](R& r, const V& v) { return r.strength.face_load_factor = number(v), std::string(); }},
       {factor_rule("planet_load_factor", "1", "worst planet's share over the mean"),
        [](R& r, const V& v) { return r.strength.planet_load_factor = number(v), std::string(); }},
       {factor_rule("bending_life_factor", "1", "K_L"),
        [](R& r, const V& v) { return r.strength.bending_life_factor = number(v), std::string(); }},
       {factor_rule("contact_life_factor", "1", "K_HL"),
        [](R& r, const V& v) { return r.strength.contact_life_factor = number(v), std::string(); }},
       {factor_rule("bending_safety", "1.2", "S_F"),
        [](R& r, const V& v) { return r.strength.bending_safety = number(v), std::string(); }},
       {factor_rule("contact_safety", "1.15", "S_H"),
        [](R& r, const V& v) { return r.strength.contact_safety = number(v), std::string(); }}}};
}

RequirementsSection losses() { return losses_of(std::make_index_sequence<kLossKeys>{}); }

}  // namespace requirements

const std::vector<RequirementsKey<Material>>& material_keys() {
  using Own = Material;
  using requirements::number, requirements::text, requirements::V;
  static const std::vector<RequirementsKey<Material>> kKeys{
      {{.name = "bending_limit_mpa",
        .unit = "MPa",
        .lower = 0.1,
        .upper = 1e4,
        .required = true,
        .meaning = "sigma_Flim, pulsating"},
       [](Own& m, const V& v) { return m.bending_limit_mpa = number(v), std::string(); }},
      {{.name = "contact_limit_mpa",
        .unit = "MPa",
        .lower = 0.1,
        .upper = 1e4,
        .required = true,
        .meaning = "sigma_Hlim"},
       [](Own& m, const V& v) { return m.contact_limit_mpa = number(v), std::string(); }},
      {{.name = "elastic_modulus_mpa", .unit = "MPa", .lower = 1, .upper = 1e7, .required = true},
       [](Own& m, const V& v) { return m.elastic_modulus_mpa = number(v), std::string(); }},
      {{.name = "poisson_ratio", .lower = 0, .upper = 0.5, .required = true},
       [](Own& m, const V& v) { return m.poisson_ratio = number(v), std::string(); }},
      {{.name = "density_kg_m3", .unit = "kg/m3", .lower = 1, .upper = 1e5, .required = true},
       [](Own& m, const V& v) { return m.density_kg_m3 = number(v), std::string(); }},
      {{.name = "source",
        .type = KeyType::kText,
        .by_default = "empty",
        .meaning = "where the limits come from"},
       [](Own& m, const V& v) { return m.source = text(v), std::string(); }}};
  return kKeys;
}

}  // namespace trueflank
