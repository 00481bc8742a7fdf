// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/command_shifts.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/session/search_files.h"
#include "trueflank/session/shift_map_files.h"

namespace trueflank::app {

namespace {

/// The sets of a search that have some teeth, stages of trains in series too; the best first.
struct SetsOfTeeth {
  std::vector<ToothSet> sets;
  std::vector<double> efficiencies;  ///< best over the shifts; of one set alone not computed
  std::string other;                 ///< teeth that could be asked for, where none have these
};

SetsOfTeeth sets_of_teeth(const SearchTask& task, const std::string& teeth) {
  SetsOfTeeth found;
  const auto look = [&](const ToothSet& set) {
    const std::string text = teeth_text(set);
    if (text == teeth) found.sets.push_back(set);
    if (found.other.empty()) found.other = text;
  };
  for (const ToothSet& set : task.enumeration.sets) look(set);
  for (const ToothSet& stage : task.enumeration.stages) look(stage);
  if (found.sets.size() < 2) return found;
  std::vector<std::pair<double, ToothSet>> ranked;
  for (const ToothSet& set : found.sets)
    ranked.emplace_back(best_efficiency(stage_requirements(task.requirements, set), set), set);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    return a.first > b.first || (a.first == a.first && b.first != b.first);
  });
  found.sets.clear();
  for (const auto& [efficiency, set] : ranked) {
    found.sets.push_back(set);
    found.efficiencies.push_back(efficiency);
  }
  return found;
}

std::string percent_text(double efficiency) {
  return efficiency == efficiency ? fixed_text(100.0 * efficiency, 3) + " %"
                                  : "no shifts keep every limit";
}

std::string told_text(const std::string& teeth, const SetsOfTeeth& found,
                      const ShiftSurface& surface) {
  std::string text = teeth + ": " + percent_text(surface.efficiency);
  if (surface.efficiency == surface.efficiency)
    text += " at a centre distance of " + fixed_text(surface.best.centre_distance, 5) + " modules";
  text += "\n";
  if (found.sets.size() > 1)
    text +=
        "  as " + train_text(found.sets.front()) +
        "; these have the same teeth, and are mapped where the requirements ask for them alone:\n";
  for (std::size_t i = 1; i < found.sets.size(); ++i)
    text += "  " + train_text(found.sets[i]) + ": " + percent_text(found.efficiencies[i]) + "\n";
  return text;
}

}  // namespace

int run_shifts(const ShiftsOptions& options) {
  const auto task = prepare_search(options.requirements);
  if (!task) return report_errors(task.error());
  const SetsOfTeeth found = sets_of_teeth(*task, options.teeth);
  if (found.sets.empty())
    return report_errors(
        {{.code = ErrorCode::kUsage,
          .message = "no tooth set of these requirements",
          .key = "--teeth",
          .value = options.teeth,
          .remedy = found.other.empty() ? "wider requirements: no set fits them"
                                        : "one that fits them, such as " + found.other}});
  if (auto ok = create_output_folder(options.folder); !ok) return report_errors({ok.error()});
  const ToothSet& set = found.sets.front();
  const ShiftSurface surface =
      shift_surface(stage_requirements(task->requirements, set), set, options.points);
  const std::filesystem::path folder = options.folder;
  const std::string title = task->requirements.name + ": " + options.teeth;
  const std::pair<const char*, std::string> files[] = {
      {"shifts.csv", shift_map_csv(surface)},
      {"shifts-borders.csv", shift_borders_csv(surface)},
      {"shifts.html", shift_map_html(title, set, surface)}};
  for (const auto& [name, text] : files)
    if (auto ok = io::write_file(folder / name, text); !ok) return report_errors({ok.error()});
  if (!options.quiet) {
    const std::string told = told_text(options.teeth, found, surface);
    if (auto ok = print(told + open_text((folder / "shifts.html").string())); !ok)
      return report_errors({ok.error()});
  }
  return surface.efficiency == surface.efficiency ? 0 : 1;
}

}  // namespace trueflank::app
