// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_keys.h"

namespace trueflank {

const std::vector<DesignKey<MadeDesign>>& made_keys() {
  using M = MadeDesign;
  using Value = std::optional<KeyValue>;
  static const std::vector<DesignKey<M>> keys{
      {{.name = "process", .type = KeyType::kText, .by_default = "none",
        .meaning = "how the parts are made, by name ([made](made.md)): what it cannot make is "
                   "warned of"},
       KeyPlace::kAnywhere,
       // the reader puts the process of that name here
       [](M& m, const KeyValue& v) { m.process = Process{.name = std::get<std::string>(v)}; },
       [](const M& m) { return m.process ? Value(m.process->name) : Value(); }},
      {{.name = "kerf_mm", .unit = "mm", .lower = 0, .upper = 20, .by_default = "none",
        .meaning = "width of the cut of a wire or beam: DXF files of parts hold the path of its "
                   "middle"},
       KeyPlace::kAnywhere,
       [](M& m, const KeyValue& v) { m.kerf_mm = std::get<double>(v); },
       [](const M& m) { return m.kerf_mm ? Value(*m.kerf_mm) : Value(); }},
  };
  return keys;
}

}  // namespace trueflank
