// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/search_session.h"

#include <algorithm>
#include <system_error>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/tolerance_analysis.h"
#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/session/journal_file.h"
#include "trueflank/session/search_files.h"

namespace trueflank {
namespace {

/// design-001.toml and on, with three digits or more.
bool is_designs_name(std::string_view name) {
  constexpr std::string_view kBefore = "design-", kAfter = ".toml";
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter) || name.size() < kBefore.size() + 3 + kAfter.size())
    return false;
  name.remove_prefix(kBefore.size());
  name.remove_suffix(kAfter.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Design files of an earlier search in this folder: they would stand beside the new ones.
void remove_old_designs(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (is_designs_name(entry.path().filename().string())) old.push_back(entry.path());
  for (const auto& path : old) std::filesystem::remove(path, ignored);
}

Status write_designs(const SearchReport& report, const std::filesystem::path& folder,
                     const std::string& name) {
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const FoundDesign& found = report.designs[i];
    GearboxDesign design = found.design;
    design.name = name + "-" + design_stem(i).substr(7);
    const std::string comment = "Found by trueflank search: ratio " + fixed_text(teeth_of(found).ratio, 4) +
                                ", " + fixed_text(100 * found.candidate.forward, 2) + " % forward, " +
                                fixed_text(100 * found.candidate.backward, 2) + " % backward";
    const auto path = folder / (design_stem(i) + ".toml");
    if (auto ok = io::write_file(path, design_file_text(design, comment)); !ok) return ok;
  }
  return {};
}

/// Of a part of which a journal says that it was done.
SearchRecords whole_part(const SearchTask& task, SearchJournal done, const SearchPart& part) {
  SearchRecords records = listed_records(task.requirements, std::move(done.records),
                                         part.size(task.enumeration.sets.size()));
  records.stages = listed_stages(task.requirements, task.enumeration, done.stages, part);
  return records;
}

/// Also by the share of sets that assemble, where tolerances are asked for.
DesignVerdict judged_within_tolerance(const SearchRequirements& r, const GearTrain& train) {
  DesignVerdict verdict = judged_by_checks(train);
  if (!r.tolerance || !verdict.failed.empty()) return verdict;
  const auto result = analyse_tolerances(train, {.centre_distance_um = r.tolerance->centre_distance_um,
                                                 .tooth_thickness_um = r.tolerance->tooth_thickness_um,
                                                 .tolerance_class = r.tolerance->tolerance_class});
  if (result) verdict.assembling_share = 1.0 - result->jam_share;
  if (r.assembling_share_min > 0.0 && !(verdict.assembling_share >= r.assembling_share_min))
    verdict.failed.emplace_back("tolerance");
  return verdict;
}

}  // namespace

ResultAll<SearchTask> prepare_search(const std::string& requirements_file,
                                     const std::string& materials_file) {
  MaterialTable materials;
  if (!materials_file.empty()) {
    auto read = read_materials(materials_file);
    if (!read) return fail_all(read.error());
    materials = std::move(*read);
  }
  auto requirements = read_requirements(requirements_file, std::move(materials));
  if (!requirements) return fail_all(requirements.error());
  SearchTask task{.requirements = std::move(*requirements), .enumeration = {}};
  task.enumeration = enumerate_sets(task.requirements);
  return task;
}

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

std::filesystem::path journal_path(const std::filesystem::path& folder, const SearchPart& part) {
  if (part.parts == 1) return folder / "search.journal";
  return folder / ("search-" + std::to_string(part.part) + "-of-" + std::to_string(part.parts) +
                   ".journal");
}

ResultAll<SearchRecords> run_search_part(const SearchTask& task,
                                                     const SearchPartOptions& options) {
  JournalFile journal;
  auto done = JournalFile::open(task, journal_path(options.folder, options.part), options.resume, journal);
  if (!done) return fail_all({done.error()});
  if (std::find(done->ended.begin(), done->ended.end(), options.part) != done->ended.end())
    return whole_part(task, std::move(*done), options.part);
  SearchRunOptions run{.threads = options.threads,
                       .part = options.part,
                       .done = std::move(done->records),
                       .done_stages = std::move(done->stages)};
  run.stop = options.stop;
  run.on_record = [&](const SearchRecord& record, std::size_t finished, std::size_t total) {
    journal.append(record);
    if (options.on_record) options.on_record(record, finished, total);
  };
  run.on_stage = [&](const SearchRecord& stage, std::size_t finished) {
    journal.append_stage(stage);
    if (options.on_stage) options.on_stage(stage, finished);
  };
  SearchRecords records = run_search(task.requirements, task.enumeration, run);
  SearchJournal written{.records = records.optimised, .stages = records.stages};
  if (is_complete(task, records, options.part)) written.ended.push_back(options.part);
  if (auto ok = journal.close(task, written); !ok) return fail_all({ok.error()});
  return records;
}

ResultAll<SearchRecords> merge_search(const SearchTask& task,
                                            const std::vector<std::string>& folders) {
  SearchJournal all;
  Errors errors;
  for (const std::string& folder : folders) {
    std::error_code error;
    std::vector<std::filesystem::path> journals;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".journal") journals.push_back(entry.path());
    if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory)
      errors.push_back({.code = ErrorCode::kFileNotFound,
                        .message = "no such folder",
                        .remedy = "output folders of trueflank search --shard",
                        .file = folder});
    else if (error)
      errors.push_back(io::file_error("read folder", folder, error.value()));
    else if (journals.empty())
      errors.push_back({.code = ErrorCode::kInconsistent,
                        .message = "no journal in this folder",
                        .remedy = "output folders of trueflank search --shard",
                        .file = folder});
    std::sort(journals.begin(), journals.end());
    for (const auto& path : journals) {
      const auto read = read_journal_file(task, path);
      if (read) {
        all.records.insert(all.records.end(), read->records.begin(), read->records.end());
        all.stages.insert(all.stages.end(), read->stages.begin(), read->stages.end());
        all.ended.insert(all.ended.end(), read->ended.begin(), read->ended.end());
      } else {
        errors.push_back(read.error());
      }
    }
  }
  SearchRecords result = gathered_records(task, std::move(all));
  const std::size_t total = task.enumeration.sets.size();
  if (errors.empty() && result.stages_left)
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = "the journals do not cover all trains in series",
                      .key = "--merge",
                      .remedy = "the folders of all shards, each finished"});
  if (errors.empty() && result.sets() < total)
    errors.push_back({.code = ErrorCode::kInconsistent,
                      .message = "the journals cover " + std::to_string(result.sets()) + " of " +
                                 std::to_string(total) + " tooth sets",
                      .key = "--merge",
                      .remedy = "the folders of all shards, each finished"});
  if (!errors.empty()) return fail_all(std::move(errors));
  return result;
}

bool is_complete(const SearchTask& task, const SearchRecords& records, const SearchPart& part) {
  return !records.stages_left && records.sets() == part.size(task.enumeration.sets.size());
}

namespace {

/// Each index once, in their order.
std::vector<SearchRecord> once(std::vector<SearchRecord> records) {
  std::stable_sort(
      records.begin(), records.end(),
      [](const SearchRecord& p, const SearchRecord& q) { return p.index < q.index; });
  const auto same = [](const SearchRecord& p, const SearchRecord& q) { return p.index == q.index; };
  records.erase(std::unique(records.begin(), records.end(), same), records.end());
  return records;
}

}  // namespace

SearchRecords gathered_records(const SearchTask& task, SearchJournal journal) {
  const SetEnumeration& enumeration = task.enumeration;
  std::vector<SearchRecord> records = once(std::move(journal.records)),
                            stages = once(std::move(journal.stages));
  const std::size_t total = enumeration.sets.size();
  std::size_t covered = 0, next = 0;
  for (std::size_t i = 0; i < total; ++i) {
    const bool recorded = next < records.size() && records[next].index == i;
    covered += recorded || journal.covers(i);
    next += recorded;
  }
  SearchRecords result;
  if (covered == total) {
    result = listed_records(task.requirements, std::move(records), total);
  } else {
    result.passed_over = covered - records.size();
    result.optimised = std::move(records);
  }
  result.stages_left = !journal.covers_all(enumeration.stages.size());
  result.stages = result.stages_left ? std::move(stages)
                                     : listed_stages(task.requirements, enumeration, stages);
  return result;
}

SearchReport finish_search(const SearchTask& task, const SearchRecords& records) {
  return conclude_search(
      task.requirements, task.enumeration, records,
      [&](const GearTrain& train) { return judged_within_tolerance(task.requirements, train); });
}

Status write_search(const SearchTask& task, const SearchReport& report,
                    const std::filesystem::path& folder) {
  remove_old_designs(folder);
  if (auto ok = write_designs(report, folder, task.requirements.name); !ok) return ok;
  const std::pair<const char*, std::string> files[] = {{"search.csv", search_csv(task, report)},
                                                       {"search.json", search_json(task, report)},
                                                       {"search.svg", search_svg(task, report)},
                                                       {"search.html", search_html(task, report)}};
  for (const auto& [name, text] : files)
    if (auto ok = io::write_file(folder / name, text); !ok) return ok;
  return {};
}

}  // namespace trueflank
