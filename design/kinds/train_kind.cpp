// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

#include <algorithm>

#include "trueflank/base/contract.h"

namespace trueflank {

const std::vector<TrainKind>& train_kinds() {
  static const std::vector<TrainKind> kinds{kind_3k(),        kind_stepped(), kind_simple(),
                                            kind_two_stage(), kind_pair(),    kind_gear()};
  return kinds;
}

const TrainKind* find_train_kind(std::string_view name) {
  const auto& kinds = train_kinds();
  const auto it =
      std::find_if(kinds.begin(), kinds.end(), [&](const TrainKind& kind) { return kind.name == name; });
  return it == kinds.end() ? nullptr : &*it;
}

std::string train_kind_names() {
  std::string names;
  const auto& kinds = train_kinds();
  for (std::size_t i = 0; i < kinds.size(); ++i)
    names += (i == 0 ? "" : i + 1 == kinds.size() ? " or " : ", ") + std::string(kinds[i].name);
  return names;
}

Topology train_topology(std::string_view name, std::string_view output, std::string_view input) {
  const TrainKind* kind = find_train_kind(name);
  TRUEFLANK_EXPECTS(kind != nullptr);
  const auto chosen = [](std::string_view asked, const std::vector<std::string>& choices) {
    if (asked.empty()) return choices.empty() ? std::string_view() : std::string_view(choices.front());
    TRUEFLANK_EXPECTS(std::find(choices.begin(), choices.end(), asked) != choices.end());
    return asked;
  };
  return kind->topology(chosen(output, kind->outputs), chosen(input, kind->inputs));
}

}  // namespace trueflank
