// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/design/key_rule.h"
#include "trueflank/train/gearbox_design.h"

// The keys of the design file, each defined here and nowhere else: reader, writer and reference
// (docs/design-file.md) are all made from these tables.
namespace trueflank {

/// Where a key may stand.
enum class KeyPlace {
  kAnywhere,
  kPlanetary,     ///< kinds with planets: required there where required at all
  kOutput,        ///< required for kinds that have no usual output
  kUnlessEveryGear,  ///< required unless every gear has its own
  kExternalGear,
  kRing,          ///< internal gears
  kMaybeRing,     ///< gears that may be either: wheel, gear
};

template <class Target>
struct DesignKey {
  KeyRule rule;
  KeyPlace place = KeyPlace::kAnywhere;
  /// Puts a value that obeys the rule into the design.
  void (*set)(Target&, const KeyValue&) = nullptr;
  /// The value in the file's unit; nothing where the file need not say it. Reads back exactly.
  std::optional<KeyValue> (*get)(const Target&) = nullptr;
};

inline constexpr int kDesignFormat = 1;
/// `format` and `name`.
[[nodiscard]] const std::vector<DesignKey<GearboxDesign>>& file_keys();
/// `[gearbox]`.
[[nodiscard]] const std::vector<DesignKey<GearboxDesign>>& gearbox_keys();
/// `[stage2]`.
[[nodiscard]] const std::vector<DesignKey<StageDesign>>& stage_keys();
/// `[rack]`.
[[nodiscard]] const std::vector<DesignKey<BasicRack>>& rack_keys();
/// A gear's own table.
[[nodiscard]] const std::vector<DesignKey<GearDesign>>& gear_keys();
/// `[<ring>.cutter]`.
[[nodiscard]] const std::vector<DesignKey<ShaperCutter>>& cutter_keys();
/// `[<gear>.modifications]`.
[[nodiscard]] const std::vector<DesignKey<ModificationsDesign>>& modification_keys();

/// `[shafts]`.
[[nodiscard]] const std::vector<DesignKey<ShaftsDesign>>& shafts_keys();
/// `[carrier]`.
[[nodiscard]] const std::vector<DesignKey<CarrierDesign>>& carrier_keys();

/// `[motor]`, `[housing]`, `[output]`, `[bearings]`, `[fasteners]`.
[[nodiscard]] const std::vector<DesignKey<Motor>>& motor_keys();
[[nodiscard]] const std::vector<DesignKey<HousingDesign>>& housing_keys();
[[nodiscard]] const std::vector<DesignKey<OutputDesign>>& output_keys();
[[nodiscard]] const std::vector<DesignKey<BearingsDesign>>& bearings_keys();
[[nodiscard]] const std::vector<DesignKey<FastenersDesign>>& fasteners_keys();

/// `[made]`.
[[nodiscard]] const std::vector<DesignKey<MadeDesign>>& made_keys();
/// `[losses]`.
[[nodiscard]] const std::vector<DesignKey<LossesDesign>>& losses_keys();
/// `[strength]`.
[[nodiscard]] const std::vector<DesignKey<StrengthDesign>>& strength_keys();

/// What a gear is if its `internal` says nothing: rings are internal.
[[nodiscard]] GearKind usual_kind(const std::string& gear_name);
/// Whether `internal` is this gear's to say.
[[nodiscard]] bool may_be_ring(const std::string& gear_name);
/// Whether a key has its place in a gear's table.
[[nodiscard]] bool stands_in(KeyPlace place, const std::string& gear_name, GearKind kind);

}  // namespace trueflank
