// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/command_search.h"

#include <charconv>
#include <filesystem>

#include "trueflank/app/error_text.h"
#include "trueflank/app/progress.h"
#include "trueflank/app/search_progress.h"
#include "trueflank/app/terminal.h"
#include "trueflank/session/search_files.h"

namespace trueflank::app {

Result<SearchPart> parse_shard(const std::string& text) {
  SearchPart part;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, part.part);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, part.parts);
    if (second.ec == std::errc() && second.ptr == end && part.part >= 1 && part.part <= part.parts)
      return part;
  }
  return fail({.code = ErrorCode::kUsage, .message = "no such part", .key = "--shard",
               .value = text, .remedy = "i/n with i from 1 to n, for example 2/8"});
}

ResultAll<SearchRecords> run_part(const SearchTask& task, const SearchPart& part,
                                              const SearchOptions& options) {
  const StopOnInterrupt interrupt;  // before the journal: from its first line on --resume is offered
  SearchProgress progress(options.quiet);
  return run_search_part(
      task, {.folder = options.folder,
             .part = part,
             .threads = options.threads,
             .resume = options.resume,
             .stop = &StopOnInterrupt::flag(),
             .on_record = [&](const SearchRecord& record, std::size_t finished, std::size_t total) {
               progress.show(finished, total, record);
             },
             .on_stage = [&](const SearchRecord&, std::size_t finished) {
               progress.show_stages(finished, task.enumeration.stages.size());
             }});
}

int conclude(const SearchTask& task, const SearchRecords& records,
             const SearchOptions& options) {
  const SearchReport report = [&] {
    const Progress progress("judging the best designs", options.quiet);
    return finish_search(task, records);
  }();
  if (auto ok = write_search(task, report, options.folder); !ok) return report_errors({ok.error()});
  if (!options.quiet)
    if (auto ok = print(search_summary(task, report) +
                        open_text((std::filesystem::path(options.folder) / "search.html").string()));
        !ok)
      return report_errors({ok.error()});
  if (report.complete()) return 0;
  const std::string done = report.optimised < report.sets
                               ? std::to_string(report.optimised) + " of " +
                                     std::to_string(report.sets) + " tooth sets"
                               : std::to_string(records.stages.size()) + " of at most " +
                                     std::to_string(task.enumeration.stages.size()) +
                                     " stages of trains in series";
  return report_errors({{.code = ErrorCode::kInterrupted,
                         .message = "stopped after " + done + "; what was found is written",
                         .remedy = "--resume to go on"}});
}

int run_search(const SearchOptions& options) {
  SearchPart part;
  if (!options.shard.empty()) {
    const auto parsed = parse_shard(options.shard);
    if (!parsed) return report_errors({parsed.error()});
    part = *parsed;
    if (!options.merge.empty())
      return report_errors({{.code = ErrorCode::kUsage,
                             .message = "--shard and --merge exclude each other",
                             .remedy = "--shard on every machine, then --merge once"}});
  }
  const auto task = prepare_search(options.requirements, options.materials);
  if (!task) return report_errors(task.error());
  if (auto ok = create_output_folder(options.folder); !ok) return report_errors({ok.error()});
  const auto records =
      options.merge.empty() ? run_part(*task, part, options) : merge_search(*task, options.merge);
  if (!records) return report_errors(records.error());
  if (part.parts == 1) return conclude(*task, *records, options);

  const std::size_t total = part.size(task->enumeration.sets.size());
  if (!options.quiet)
    if (auto ok = print("part " + options.shard + ": " + std::to_string(records->sets()) + " of " +
                        std::to_string(total) + " tooth sets in " +
                        journal_path(options.folder, part).string() +
                        "\nnext, with all parts: trueflank search " + options.requirements +
                        " -o DIR --merge FOLDERS\n");
        !ok)
      return report_errors({ok.error()});
  if (is_complete(*task, *records, part)) return 0;
  return report_errors({{.code = ErrorCode::kInterrupted,
                         .message = "stopped before the part was done",
                         .remedy = "--resume to go on"}});
}

}  // namespace trueflank::app
