// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/search/search_enumerate.h"
#include "trueflank/search/search_optimise.h"
#include "trueflank/search/search_record.h"
#include "trueflank/search/search_relax.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/search/search_stages.h"
#include "trueflank/train/gear_train.h"

// A search: enumerate, optimise every set that is left (in parallel, in parts, resumable), then rank
// and let the exact checks judge from the best downwards. Everything but the run itself is a pure
// function, so that parts put together give the answer of one run.
namespace trueflank {

/// What a search has of its tooth sets, or of those of a part.
struct SearchRecords {
  std::vector<SearchRecord> optimised;  ///< by index
  /// Sets of which a bound says that they cannot be among the best that are listed, or that were not
  /// among them. Where there are any, `optimised` holds those that are listed and no others.
  std::size_t passed_over = 0;
  /// Stages of trains in series, by index into SetEnumeration::stages: those of the pairs listed.
  std::vector<SearchRecord> stages;
  bool stages_left = false;  ///< the run was stopped before it knew which pairs are listed
  [[nodiscard]] std::size_t sets() const { return optimised.size() + passed_over; }
};

struct SearchRunOptions {
  int threads = 0;  ///< 0: as many as the machine has
  SearchPart part;
  std::vector<SearchRecord> done, done_stages;  ///< of an earlier run: not computed again
  const std::atomic<bool>* stop = nullptr;  ///< set: what is under way is finished, no more started
  /// Where bounds are known, sets of which they say that they are worse than this merit are passed
  /// over; NaN: none.
  double better_than = kNaN;
  /// Called for every new record, one call at a time, in no fixed order; `finished` counts the sets
  /// that are passed over too.
  std::function<void(const SearchRecord&, std::size_t finished, std::size_t total)> on_record;
  /// Called for every new record of a stage in series, of which so many were optimised.
  std::function<void(const SearchRecord&, std::size_t finished)> on_stage;
};

/// How many sets of one search are listed (SearchRequirements::listed): the best by one objective, by
/// several those that fewer others beat in all of them. 0: all, since their number does not say or no
/// bound is known.
[[nodiscard]] std::size_t listed_sets(const SearchRequirements& requirements);
/// Likewise how many trains in series; always a number.
[[nodiscard]] std::size_t listed_pairs(const SearchRequirements& requirements);

/// Optimises the sets of one part, those of the best bound (search_bound.h) first, until no other can
/// be among the best that are listed; then the stages of trains in series (search_stage_pairs.h).
/// Where fewer sets have feasible shifts than are listed, all sets are optimised and recorded.
/// Stopped early it returns what there is, with nothing passed over.
/// Guarantees: the same records for any number of threads and whatever was done before.
[[nodiscard]] SearchRecords run_search(const SearchRequirements& requirements,
                                       const SetEnumeration& enumeration,
                                       const SearchRunOptions& options = {});

/// The records of `sets` tooth sets as a run that did them all returns them: cut to those listed.
/// Requires: what is missing could not be among them.
[[nodiscard]] SearchRecords listed_records(const SearchRequirements& requirements,
                                           std::vector<SearchRecord> records, std::size_t sets);
/// Likewise those of stages in series, all of whose pairs or those of one part are known.
[[nodiscard]] std::vector<SearchRecord> listed_stages(const SearchRequirements& requirements,
                                                      const SetEnumeration& enumeration,
                                                      const std::vector<SearchRecord>& stages,
                                                      const SearchPart& part = {});

/// What the exact checks say of a design.
struct DesignVerdict {
  std::vector<std::string> failed;  ///< ids; empty: it passes
  std::vector<std::string> warned;
  double assembling_share = kNaN;  ///< of sets within the tolerances asked for
};
using DesignJudge = std::function<DesignVerdict(const GearTrain&)>;

/// A candidate in the ranking.
struct RankedCandidate {
  /// Of the enumeration; beyond its size: of SearchReport::pairs, behind it.
  std::size_t set_index = 0;
  SearchCandidate candidate;
  bool on_front = false;  ///< not dominated (one objective: the best)
};

/// A design that passed the checks.
struct FoundDesign {
  std::size_t set_index = 0;
  ToothSet set;  ///< of a train in series its first stage
  std::optional<StagePair> stages;
  SearchCandidate candidate;
  GearboxDesign design;
  DesignVerdict verdict;
  double exact_forward = kNaN, exact_backward = kNaN;  ///< by the path integral
  FormulaEfficiency by_formula;
  /// The first objective where it is the only one and an efficiency: no shifts of the set that keep
  /// the limits give more (search_certify.h), and how much more that is; else NaN.
  double certified_bound = kNaN, certified_gap = kNaN;
  LimitReserve reserve{};                ///< that the checks asked for beyond the limits
  std::vector<BindingLimit> binding;     ///< limits it stands on, and what each costs
  /// The greatest reserve, in modules.
  [[nodiscard]] double tightened() const;
};

struct SearchReport {
  long long considered = 0;
  std::vector<SetClass> classes;  ///< of everything that fell, whole numbers first, then shifts
  std::size_t sets = 0;           ///< that were to be optimised
  std::size_t optimised = 0;      ///< that were, or passed over; fewer: stopped early
  std::size_t passed_over = 0;    ///< of them, since they could not be among those listed
  std::size_t feasible = 0;       ///< with shifts that keep all limits
  long long evaluations = 0;      ///< of a layer
  bool stages_left = false;       ///< stopped before it was known which trains in series are listed
  /// Everything was looked at.
  [[nodiscard]] bool complete() const { return optimised == sets && !stages_left; }
  std::vector<StagePair> pairs;          ///< trains of two stages that are ranked
  std::vector<RankedCandidate> ranking;  ///< of all candidates, best first
  std::vector<FoundDesign> designs;      ///< judged, best first
  std::vector<BindingLimit> binding_ranges;  ///< of tooth numbers and ratio, of the best design
  std::size_t judged = 0;
  std::vector<SetClass> fell_in_checks;  ///< by check id, of those judged
};

/// Ranks records and judges from the best until enough designs passed. A design that fails a check is
/// optimised again with more distance from the limits concerned, at most four times; then the border
/// of the check is sought, until a design that passes is at most 1e-5 worse than one that fails.
/// Where a set that was passed over could be among the designs (so many of the listed failed a check),
/// more are optimised. Guarantees: a function of records alone, not of how they came about.
[[nodiscard]] SearchReport conclude_search(const SearchRequirements& requirements,
                                           const SetEnumeration& enumeration,
                                           const SearchRecords& records,
                                           const DesignJudge& judge);

/// @name Journal: one line a record, read back bit for bit
/// @{
[[nodiscard]] std::string journal_header(const SearchRequirements& requirements,
                                         const SetEnumeration& enumeration);
[[nodiscard]] std::string journal_line(const SearchRecord& record);
[[nodiscard]] std::string journal_stage_line(const SearchRecord& stage);
/// Ends the journal of a part that is done.
[[nodiscard]] std::string journal_end(const SearchPart& part);
struct SearchJournal {
  std::vector<SearchRecord> records, stages;
  std::vector<SearchPart> ended;  ///< parts of which nothing is missing but what was passed over
  [[nodiscard]] bool covers(std::size_t index) const;
  /// Every one of so many.
  [[nodiscard]] bool covers_all(std::size_t count) const;
};
/// Reads header and records; a last line cut short is left out. Errors: kInconsistent where the
/// journal is of other requirements, kSyntax.
[[nodiscard]] Result<SearchJournal> read_journal(const std::string& text,
                                                 const SearchRequirements& requirements,
                                                 const SetEnumeration& enumeration);
/// @}

}  // namespace trueflank
