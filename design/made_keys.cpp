// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/key_values.h"

namespace trueflank {
namespace {

template <std::optional<double> MadeDesign::*Member>
DesignKey<MadeDesign> micrometres(const char* name, const char* by_default, const char* meaning) {
  return {{.name = name, .unit = "um", .lower = 0, .upper = 10000, .by_default = by_default, .meaning = meaning},
          KeyPlace::kAnywhere,
          [](MadeDesign& m, const KeyValue& v) { m.*Member = mm_from_um(std::get<double>(v)); },
          [](const MadeDesign& m) {
            return m.*Member ? std::optional<KeyValue>(um_from_mm(*(m.*Member))) : std::optional<KeyValue>();
          }};
}

}  // namespace

const std::vector<DesignKey<MadeDesign>>& made_keys() {
  using M = MadeDesign;
  using MayBe = std::optional<KeyValue>;
  static const std::vector<DesignKey<M>> keys{
      {{.name = "process",
        .type = KeyType::kText,
        .by_default = "none",
        .meaning = "how the parts are made, by name ([made](made.md)): what it cannot make is "
                   "warned of"},
       KeyPlace::kAnywhere,
       // the reader puts the process of that name here
       [](M& m, const KeyValue& v) { m.process = Process{.name = std::get<std::string>(v)}; },
       [](const M& m) { return m.process ? MayBe(m.process->name) : MayBe(); }},
      {{.name = "kerf_mm",
        .unit = "mm",
        .lower = 0,
        .upper = 20,
        .by_default = "none",
        .meaning = "width of the cut of a wire or beam: DXF files of parts hold the path of its "
                   "middle"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.kerf_mm = std::get<double>(v); },
       [](const M& m) { return m.kerf_mm ? MayBe(*m.kerf_mm) : MayBe(); }},
      {{.name = "tolerance_class",
        .type = KeyType::kWhole,
        .lower = 1,
        .upper = 11,
        .by_default = "the process's",
        .meaning = "class of ISO 1328-1 that every gear keeps, for its runout and pitch: sets that "
                   "jam within "
                   "the tolerances fail the check `tolerance`"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.tolerance_class = key_values::whole(v); },
       [](const M& m) {
         return m.tolerance_class ? MayBe(static_cast<std::int64_t>(*m.tolerance_class)) : MayBe();
       }},
      micrometres<&M::axis_tolerance_mm>("axis_tolerance_um", "the process's",
                                         "plus or minus, of the distance of two axes"),
      micrometres<&M::thickness_tolerance_mm>(
          "thickness_tolerance_um", "the process's",
          "plus or minus, of the teeth on the reference circle"),
      micrometres<&M::clearance_mm>(
          "clearance_um", "none",
          "least distance of mating teeth with the play centred; less fails the check "
          "`overlap`"),
      {{.name = "bed",
        .type = KeyType::kText,
        .by_default = "none: no plates",
        .meaning = "the printer's bed, by its name or as \"250x210\" in mm: print plates are "
                   "written for it "
                   "([gearbox](gearbox.md))"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.bed = std::get<std::string>(v); },
       [](const M& m) { return m.bed.empty() ? MayBe() : MayBe(m.bed); }},
  };
  return keys;
}

}  // namespace trueflank
