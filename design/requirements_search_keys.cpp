// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_sections.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "trueflank/search/search_figures.h"

namespace trueflank::requirements {
namespace {

/// "forward, mass", or with weights: "forward: 1, mass: 0.2".
std::string set_objectives(R& r, const V& v) {
  r.objectives.clear();
  r.weights.clear();
  for (const std::string& word : words(text(v))) {
    const std::string name = word.substr(0, word.find(':'));
    const auto& all = objective_entries();
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const ObjectiveEntry& entry) { return name == entry.name; });
    if (it == all.end()) {
      std::string names;
      for (const ObjectiveEntry& entry : all) names += (names.empty() ? "" : ", ") + std::string(entry.name);
      return names + ": one, or several by commas";
    }
    if (std::find(r.objectives.begin(), r.objectives.end(), it->objective) != r.objectives.end())
      return "each objective once";
    r.objectives.push_back(it->objective);
    if (name == word) continue;
    double weight = 0.0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + name.size() + 1, end, weight);
    if (error != std::errc() || stop != end || !(weight > 0.0 && weight <= 1000.0))
      return "weights above 0, at most 1000: \"forward: 1, mass: 0.2\"";
    r.weights.push_back({it->objective, weight});
  }
  if (!r.weights.empty() && r.weights.size() != r.objectives.size())
    return "a weight for each objective, or for none";
  if (!r.weights.empty()) r.objectives = {SearchObjective::kWeighted};
  return "";
}

}  // namespace

RequirementsSection search() {
  return {
      "search",
      {{{.name = "objectives",
         .type = KeyType::kText,
         .by_default = "\"forward\"",
         .meaning = "one figure of the list above, or several for their Pareto front, or with weights: "
                    "\"forward: 1, mass: 0.2\""},
        set_objectives},
       {{.name = "loss_model",
         .type = KeyType::kChoice,
         .choices = {"contact_ratios", "path_integral"},
         .by_default = "path_integral",
         .meaning = "how a mesh's basic efficiency is computed: by the sliding itself, or by the "
                    "paper's formula"},
        [](R& r, const V& v) {
          r.loss_model =
              text(v) == "path_integral" ? LossModel::kPathIntegral : LossModel::kContactRatios;
          return std::string();
        }},
       {{.name = "results",
         .type = KeyType::kWhole,
         .lower = 1,
         .upper = 1000,
         .by_default = "20",
         .meaning = "design files written at most"},
        [](R& r, const V& v) { return r.results = whole(v), std::string(); }},
       {{.name = "listed",
         .type = KeyType::kWhole,
         .lower = 0,
         .upper = 1000000,
         .by_default = "200",
         .meaning = "tooth sets in search.csv, the best; sets of which a bound says that they "
                    "cannot be among them are not optimised; 0: all"},
        [](R& r, const V& v) { return r.listed = whole(v), std::string(); }}}};
}

}  // namespace trueflank::requirements
