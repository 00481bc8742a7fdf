// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/session/search_files.h"
#include "trueflank/session/search_page.h"
#include "trueflank/export/xml_text.h"

namespace trueflank {
namespace {

/// Candidates the page holds at most: it stays below a megabyte.
constexpr std::size_t kMostCandidates = 4000;

/// For the inside of a script element: nothing there may look like its end.
std::string script_text(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

std::string objectives_text(const std::vector<SearchObjective>& objectives) {
  std::string text;
  for (const SearchObjective objective : objectives)
    text += (text.empty() ? "\"" : ", \"") + std::string(objective_entry(objective).column) + "\"";
  return text;
}

/// The heading and the first rows.
std::string first_rows(const std::string& csv) {
  std::size_t end = 0;
  for (std::size_t row = 0; row <= kMostCandidates && end != std::string::npos; ++row) {
    end = csv.find('\n', end);
    if (end != std::string::npos) ++end;
  }
  return csv.substr(0, end);
}

/// The figures beside those that every page shows: ["mass_kg", "mass of the gears [kg]", "mass"], ...
std::string figures_text() {
  std::string text;
  for (const ObjectiveEntry& entry : objective_entries())
    text += (text.empty() ? "[\"" : ", [\"") + std::string(entry.column) + "\", \"" + entry.title + "\", " +
            (entry.larger_is_better ? "true]" : "false]");
  return text;
}

}  // namespace

std::string search_html(const SearchTask& task, const SearchReport& report) {
  const std::pair<std::string_view, std::string> marks[] = {
      {"@TITLE@", io::xml_escaped(task.requirements.name)},
      {"@JSON@", script_text(search_json(task, report))},
      {"@CSV@", script_text(first_rows(search_csv(task, report)))},
      {"@OBJECTIVES@", objectives_text(task.requirements.objectives)},
      {"@FIGURES@", figures_text()},
      {"@TOTAL@", std::to_string(report.ranking.size())}};
  std::string page;
  for (std::string_view rest = kSearchPage; !rest.empty();) {
    const auto at = rest.find('@');
    page += rest.substr(0, at);
    if (at == std::string_view::npos) break;
    rest.remove_prefix(at);
    const auto mark = std::find_if(std::begin(marks), std::end(marks),
                                   [&](const auto& m) { return rest.starts_with(m.first); });
    page += mark == std::end(marks) ? std::string("@") : mark->second;
    rest.remove_prefix(mark == std::end(marks) ? 1 : mark->first.size());
  }
  return page;
}

}  // namespace trueflank
