// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/command_shifts.h"

#include <optional>
#include <filesystem>

#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/session/search_files.h"
#include "trueflank/session/shift_map_files.h"

namespace trueflank::app {

int run_shifts(const ShiftsOptions& options) {
  const auto task = prepare_search(options.requirements);
  if (!task) return report_errors(task.error());
  const auto& sets = task->enumeration.sets;
  std::optional<ToothSet> set;
  for (const ToothSet& s : sets) {
    if (teeth_text(s) != options.teeth) continue;
    set = s;
    break;
  }
  if (!set)
    return report_errors({{.code = ErrorCode::kUsage,
                           .message = "no tooth set of these requirements",
                           .key = "--teeth",
                           .value = options.teeth,
                           .remedy = sets.empty() ? "wider requirements: no set fits them"
                                                  : "one that fits them, such as " + teeth_text(sets.front())}});
  if (auto ok = create_output_folder(options.folder); !ok) return report_errors({ok.error()});
  const ShiftSurface surface = shift_surface(stage_requirements(task->requirements, *set), *set, options.points);
  const std::filesystem::path folder = options.folder;
  const std::string title = task->requirements.name + ": " + options.teeth;
  if (auto ok = io::write_file(folder / "shifts.csv", shift_map_csv(*set, surface)); !ok)
    return report_errors({ok.error()});
  if (auto ok = io::write_file(folder / "shifts.html", shift_map_html(title, *set, surface)); !ok)
    return report_errors({ok.error()});
  const bool found = surface.efficiency == surface.efficiency;
  if (!options.quiet) {
    const std::string told =
        found ? options.teeth + ": " + fixed_text(100.0 * surface.efficiency, 3) +
                    " % at a centre distance of " + fixed_text(surface.best.centre_distance, 5) + " modules\n"
              : options.teeth + ": no shifts keep every limit\n";
    if (auto ok = print(told + open_text((folder / "shifts.html").string())); !ok)
      return report_errors({ok.error()});
  }
  return found ? 0 : 1;
}

}  // namespace trueflank::app
