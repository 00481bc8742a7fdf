// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/app/command_search.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>

#include "trueflank/app/error_text.h"
#include "trueflank/app/search_files.h"
#include "trueflank/app/search_session.h"
#include "trueflank/app/terminal.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/export/atomic_file.h"

namespace trueflank::app {

DesignVerdict judged_by_checks(const GearTrain& train) {
  DesignVerdict verdict;
  const auto add = [](std::vector<std::string>& ids, const std::string& id) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
  };
  for (const Finding& finding : check_gearbox(train)) {
    if (finding.status == CheckStatus::kFail) add(verdict.failed, finding.id);
    if (finding.status == CheckStatus::kWarn) add(verdict.warned, finding.id);
  }
  return verdict;
}

namespace {

/// Design files of an earlier search in this folder: they would stand beside the new ones.
void remove_old_designs(const std::string& folder) {
  static const std::regex kOurs("design-[0-9]{3,}\\.toml");
  std::error_code ignored;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (std::regex_match(entry.path().filename().string(), kOurs)) old.push_back(entry.path());
  for (const auto& path : old) std::filesystem::remove(path, ignored);
}

Status write_designs(const SearchReport& report, const std::string& folder,
                     const std::string& name) {
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& found = report.designs[i];
    GearboxDesign design = found.design;
    design.name = name + "-" + design_stem(i).substr(7);
    char comment[200];
    std::snprintf(comment, sizeof comment,
                  "Found by trueflank search: ratio %.4f, %.2f %% forward, %.2f %% backward",
                  signed_ratio(found.set), 100 * found.candidate.forward,
                  100 * found.candidate.backward);
    const auto path = std::filesystem::path(folder) / (design_stem(i) + ".toml");
    if (auto ok = io::write_file(path, design_file_text(design, comment)); !ok) return ok;
  }
  return {};
}

/// All records of the journals in some folders; each set once.
ResultAll<std::vector<SearchRecord>> merged(const SearchTask& task,
                                            const std::vector<std::string>& folders) {
  std::map<std::size_t, SearchRecord> records;
  Errors errors;
  for (const std::string& folder : folders) {
    std::error_code error;
    std::vector<std::filesystem::path> journals;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".journal") journals.push_back(entry.path());
    if (error || journals.empty())
      errors.push_back({.code = error ? ErrorCode::kFileNotFound : ErrorCode::kInconsistent,
                        .message = error ? "no such folder" : "no journal in this folder",
                        .remedy = "output folders of trueflank search --shard",
                        .file = folder});
    std::sort(journals.begin(), journals.end());
    for (const auto& path : journals) {
      const auto text = read_text_file(path.string(), std::numeric_limits<std::size_t>::max());
      auto read = text ? read_journal(*text, task.requirements, task.enumeration)
                       : Result<std::vector<SearchRecord>>(fail(text.error()));
      if (read) {
        for (SearchRecord& record : *read) records.try_emplace(record.index, std::move(record));
      } else {
        Error wrong = read.error();
        wrong.file = path.string();
        errors.push_back(std::move(wrong));
      }
    }
  }
  const std::size_t total = task.enumeration.sets.size();
  if (errors.empty() && records.size() < total)
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = "the journals hold " + std::to_string(records.size()) + " of " +
                                 std::to_string(total) + " tooth sets",
                      .key = "--merge",
                      .remedy = "the folders of all shards, each finished"});
  if (!errors.empty()) return fail_all(std::move(errors));
  std::vector<SearchRecord> result;
  for (auto& [index, record] : records) result.push_back(std::move(record));
  return result;
}

}  // namespace

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

ResultAll<SearchTask> prepare_search(const SearchOptions& options) {
  MaterialTable materials;
  if (!options.materials.empty()) {
    auto read = read_materials(options.materials);
    if (!read) return fail_all(read.error());
    materials = std::move(*read);
  }
  auto requirements = read_requirements(options.requirements, std::move(materials));
  if (!requirements) return fail_all(requirements.error());
  SearchTask task{.requirements = std::move(*requirements), .enumeration = {}};
  task.enumeration = enumerate_sets(task.requirements);
  return task;
}

ResultAll<std::vector<SearchRecord>> run_search_part(const SearchTask& task, const SearchPart& part,
                                                     const SearchOptions& options) {
  const StopOnInterrupt interrupt;  // before the journal: from its first line on --resume is offered
  Journal journal;
  auto done = Journal::open(task, Journal::path_in(options.folder, part), options.resume, journal);
  if (!done) return fail_all({done.error()});
  SearchRunOptions run{.threads = options.threads, .part = part, .done = std::move(*done)};
  std::vector<SearchRecord> records;
  {
    ProgressLine progress(run.done.size(), options.quiet);
    run.stop = &StopOnInterrupt::flag();
    run.on_record = [&](const SearchRecord& record, std::size_t finished, std::size_t total) {
      journal.append(record);
      progress.show(finished, total, record);
    };
    records = trueflank::run_search(task.requirements, task.enumeration, run);
  }
  if (auto ok = journal.close(task, records); !ok) return fail_all({ok.error()});
  return records;
}

int finish_search(const SearchTask& task, const std::vector<SearchRecord>& records,
                  const SearchOptions& options) {
  const SearchReport report =
      conclude_search(task.requirements, task.enumeration, records, judged_by_checks);
  const std::filesystem::path folder(options.folder);
  remove_old_designs(options.folder);
  if (auto ok = write_designs(report, options.folder, task.requirements.name); !ok)
    return report_errors({ok.error()});
  const std::pair<const char*, std::string> files[] = {{"search.csv", search_csv(task, report)},
                                                       {"search.json", search_json(task, report)},
                                                       {"search.svg", search_svg(task, report)},
                                                       {"search.html", search_html(task, report)}};
  for (const auto& [name, text] : files)
    if (auto ok = io::write_file(folder / name, text); !ok) return report_errors({ok.error()});
  if (!options.quiet)
    if (auto ok = print(search_summary(report)); !ok) return report_errors({ok.error()});
  if (report.optimised == report.sets) return 0;
  return report_errors({{.code = ErrorCode::kInterrupted,
                         .message = "stopped after " + std::to_string(report.optimised) + " of " +
                                    std::to_string(report.sets) +
                                    " tooth sets; what was found is written",
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
  const auto task = prepare_search(options);
  if (!task) return report_errors(task.error());
  if (auto ok = io::create_folder(options.folder); !ok) return report_errors({ok.error()});
  const auto records =
      options.merge.empty() ? run_search_part(*task, part, options) : merged(*task, options.merge);
  if (!records) return report_errors(records.error());
  if (part.parts == 1) return finish_search(*task, *records, options);

  std::size_t total = 0;
  for (std::size_t i = 0; i < task->enumeration.sets.size(); ++i) total += part.holds(i);
  if (!options.quiet)
    if (auto ok = print("part " + options.shard + ": " + std::to_string(records->size()) + " of " +
                        std::to_string(total) + " tooth sets in " +
                        Journal::path_in(options.folder, part).string() +
                        "\nnext, with all parts: trueflank search " + options.requirements +
                        " -o DIR --merge FOLDERS\n");
        !ok)
      return report_errors({ok.error()});
  if (records->size() == total) return 0;
  return report_errors({{.code = ErrorCode::kInterrupted,
                         .message = "stopped before the part was done",
                         .remedy = "--resume to go on"}});
}

}  // namespace trueflank::app
