// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "trueflank/app/commands.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/make.h"

namespace trueflank::app {
namespace {

std::string closing_text(const MakeResult& made, const std::string& folder) {
  const std::string page = open_text((std::filesystem::path(folder) / "report.html").string());
  if (made.written) return made.notes + "written to " + folder + "\n" + page;
  std::string text = "no part was written: a check failed (--allow-failing writes them all the same)\n";
  if (!made.removed.empty())
    text += "removed from " + folder + ": " + std::to_string(made.removed.size()) +
            (made.removed.size() == 1 ? " file" : " files") + " of an earlier run\n";
  return text + page;
}

}  // namespace

int run_make(const MakeOptions& options) {
  const MadeOptions how{.process = options.process, .kerf_mm = options.kerf_mm};
  trueflank::MakeOptions wanted{.folder = options.folder,
                                      .formats = options.formats,
                                      .tolerance_um = options.tolerance_um,
                                      .step_schema = options.step_schema,
                                      .part = options.part,
                                      .correct = options.correct,
                                      .compensate = options.compensate,
                                      .materials_file = options.materials_file,
                                      .allow_failing = options.allow_failing};
  Errors errors = errors_of(wanted);
  for (Error& error : errors_of(how)) errors.push_back(std::move(error));
  if (!errors.empty()) return report_errors(errors);
  const auto gearbox = Gearbox::read(options.design, how);
  if (!gearbox) return report_errors(gearbox.error());
  const auto made = [&] {
    Progress progress("making " + gearbox->design().name, options.quiet);
    wanted.on_written = [&, files = 0](const std::string& file) mutable {
      ++files;
      progress.note(std::to_string(files) + (files == 1 ? " file, " : " files, ") + file);
    };
    return make_parts(*gearbox, wanted);
  }();
  if (!made) return report_errors(made.error());
  if (!options.quiet) {
    const std::string text =
        io::report_text(made->report,
                        {.colour = standard_output_colour(), .every_check = options.verbose}) +
        closing_text(*made, options.folder);
    if (auto ok = print(text); !ok) return report_errors({ok.error()});
  }
  return made->failed ? 1 : 0;
}

}  // namespace trueflank::app
