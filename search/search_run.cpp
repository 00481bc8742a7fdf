// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which sets are optimised, and in which order. What is returned does not depend on either: the
// best are among those whose bound is not below the merit of the last one listed, and these are
// optimised in every run.
#include <algorithm>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <queue>
#include <set>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/search/search.h"
#include "trueflank/search/search_bound.h"
#include "trueflank/search/search_listing.h"
#include "trueflank/search/search_stage_pairs.h"

namespace trueflank {
namespace {

/// Sets looked at together: the best of so many come first.
constexpr std::size_t kBatch = 16384;
int thread_count(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::vector<Merits> merits_of(const SearchRequirements& r, const SearchRecord& record) {
  std::vector<Merits> designs;
  for (const SearchCandidate& candidate : record.result.candidates)
    designs.push_back(merits_of(candidate, r.objectives));
  return designs;
}

enum class Known { kNothing, kOutlines, kProfiles, kAll };

/// A set that waits for its next step.
struct Waiting {
  std::size_t index = 0;
  ToothSet set;
  Known known = Known::kNothing;
  MeshBounds meshes;
  double size_mm = 0.0;  ///< at least
  Merits merits;         ///< at most; empty: nothing is known
  [[nodiscard]] double promise() const {
    return merits.empty() ? std::numeric_limits<double>::infinity() : merits.front();
  }
  bool operator<(const Waiting& other) const {
    return promise() != other.promise() ? promise() < other.promise() : index > other.index;
  }
};

/// The sets of a run that wait, best first. Not for several threads at a time.
class WaitingSets {
 public:
  using Records = std::map<std::size_t, SearchRecord>;
  WaitingSets(const ToothSets& sets, const SearchPart& part, bool bounded)
      : sets_(sets),
        part_(part),
        bounded_(bounded),
        next_(static_cast<std::size_t>(part.part - 1)) {}

  /// The next one that may be listed; what is `done` is left out.
  std::optional<Waiting> next(const Listing& listing, const Records& done) {
    while (true) {
      drop_excluded(listing);
      if (!listing.wants_any()) drop_infeasible();
      if (heap_.empty() && take_batch(done)) continue;
      if (!heap_.empty()) {
        const Waiting first = heap_.top();
        heap_.pop();
        return first;
      }
      if (infeasible_.empty()) return std::nullopt;
      const std::size_t index = infeasible_.back();
      infeasible_.pop_back();
      return Waiting{.index = index, .set = sets_[index], .known = Known::kAll};
    }
  }
  /// Those that a bound calls infeasible wait as indices alone: mostly they are all that there is.
  void put_back(const Waiting& waiting) {
    if (waiting.meshes.possible())
      heap_.push(waiting);
    else
      infeasible_.push_back(waiting.index);
  }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  void drop_excluded(const Listing& listing) {
    while (!heap_.empty() && !heap_.top().merits.empty() && listing.excludes(heap_.top().merits)) {
      if (heap_.top().merits.size() == 1) {  // the others are no better
        dropped_ += heap_.size();
        heap_ = {};
      } else {
        ++dropped_;
        heap_.pop();
      }
    }
  }
  void drop_infeasible() {
    dropped_ += infeasible_.size();
    infeasible_ = {};
  }
  bool take_batch(const Records& done) {
    std::size_t taken = 0;
    for (; next_ < sets_.size() && taken < kBatch; next_ += static_cast<std::size_t>(part_.parts)) {
      if (done.contains(next_)) continue;
      ++taken;
      heap_.push(
          {.index = next_, .set = sets_[next_], .known = bounded_ ? Known::kNothing : Known::kAll});
    }
    return taken > 0;
  }

  const ToothSets& sets_;
  SearchPart part_;
  bool bounded_;
  std::size_t next_, dropped_ = 0;
  std::priority_queue<Waiting> heap_;
  std::vector<std::size_t> infeasible_;
};

class Run {
 public:
  Run(const SearchRequirements& requirements, const SetEnumeration& enumeration,
      const SearchRunOptions& options)
      : r_(requirements),
        options_(options),
        listing_(listed_sets(requirements), options.better_than),
        waiting_(enumeration.sets, options.part, listed_sets(requirements) > 0) {
    for (const SearchRecord& record : options_.done)
      if (options_.part.holds(record.index) && records_.insert({record.index, record}).second)
        listing_.add(merits_of(r_, record));
    total_ = options_.part.size(enumeration.sets.size());
  }

  SearchRecords run() {
    const auto work = [this] { this->work(); };
    auto threads =
        helping_threads(static_cast<std::size_t>(thread_count(options_.threads) - 1), work);
    work();
    threads.clear();  // joins
    if (failure_) std::rethrow_exception(failure_);
    std::vector<SearchRecord> records;
    for (auto& [index, record] : records_) records.push_back(std::move(record));
    if (stopped_) return {.optimised = std::move(records)};
    return listed_records(r_, std::move(records), total_);
  }

 private:
  void work() {
    try {
      while (const auto waiting = next()) {
        if (waiting->known != Known::kAll) {
          put_back(bounded(*waiting, enough()));
          continue;
        }
        keep({waiting->index, optimise_set(r_, waiting->set)});
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  std::optional<Waiting> next() {
    const std::lock_guard lock(mutex_);
    // a stop that comes when nothing is left is none
    auto waiting = stopped_ ? std::nullopt : waiting_.next(listing_, records_);
    if (waiting && options_.stop && options_.stop->load()) {
      stopped_ = true;
      return std::nullopt;
    }
    return waiting;
  }

  [[nodiscard]] Waiting bounded(Waiting waiting, double enough) const {
    const auto [by, known] =
        waiting.known == Known::kNothing    ? std::pair(BoundBy::kOutlines, Known::kOutlines)
        : waiting.known == Known::kOutlines ? std::pair(BoundBy::kProfiles, Known::kProfiles)
                                            : std::pair(BoundBy::kHalving, Known::kAll);
    waiting.meshes.lower(r_, waiting.set, by, enough);
    if (waiting.known == Known::kNothing) waiting.size_mm = least_size_mm(r_, waiting.set);
    waiting.known = known;
    if (waiting.meshes.possible())
      waiting.merits = merit_bounds(r_, signed_ratio(waiting.set), waiting.meshes, waiting.size_mm);
    return waiting;
  }

  /// A mesh efficiency that is listed no more: what is told is no more than the meshes'.
  double enough() {
    const std::lock_guard lock(mutex_);
    const bool efficiency = r_.objectives == std::vector{SearchObjective::kForward} ||
                            r_.objectives == std::vector{SearchObjective::kBackward};
    return efficiency ? listing_.least() : 0.0;
  }

  void put_back(const Waiting& waiting) {
    const std::lock_guard lock(mutex_);
    waiting_.put_back(waiting);
  }

  void keep(SearchRecord record) {
    const std::lock_guard lock(mutex_);
    listing_.add(merits_of(r_, record));
    const auto it = records_.insert({record.index, std::move(record)}).first;
    if (options_.on_record)
      options_.on_record(it->second, records_.size() + waiting_.dropped(), total_);
  }

  const SearchRequirements& r_;
  const SearchRunOptions& options_;
  std::map<std::size_t, SearchRecord> records_;
  std::size_t total_ = 0;
  Listing listing_;
  WaitingSets waiting_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  bool stopped_ = false;
};

}  // namespace

namespace {

/// Trains of two stages are listed up to this where all sets are.
constexpr std::size_t kMostPairs = 1000;

}  // namespace

SearchRecords run_search(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                         const SearchRunOptions& options) {
  SearchRecords records = Run(requirements, enumeration, options).run();
  if (enumeration.stages.empty()) return records;
  records.stages = options.done_stages;
  records.stages_left = records.sets() < options.part.size(enumeration.sets.size());
  if (records.stages_left) return records;
  StageRunOptions stages{.listed = listed_pairs(requirements),
                         .threads = static_cast<std::size_t>(thread_count(options.threads)),
                         .part = options.part,
                         .done = options.done_stages,
                         .stop = options.stop};
  std::size_t finished = 0;
  stages.on_record = [&](const SearchRecord& record) {
    if (options.on_stage) options.on_stage(record, ++finished);
  };
  StageRun run = run_stages(requirements, enumeration.stages, stages);
  records.stages_left = run.stopped;
  records.stages = run.stopped ? std::move(run.stages)
                               : listed_stages(requirements, enumeration, run.stages, options.part);
  return records;
}

std::size_t listed_sets(const SearchRequirements& r) {
  return has_bounds(r) && r.listed > 0 ? static_cast<std::size_t>(std::max(r.listed, r.results))
                                       : 0;
}

std::size_t listed_pairs(const SearchRequirements& r) {
  return r.listed > 0 ? static_cast<std::size_t>(std::max(r.listed, r.results)) : kMostPairs;
}

SearchRecords listed_records(const SearchRequirements& r, std::vector<SearchRecord> records,
                             std::size_t sets) {
  Listing listing(listed_sets(r));
  for (const SearchRecord& record : records) listing.add(merits_of(r, record));
  if (listing.is_full()) {
    const auto merit = [&](const SearchRecord& record) {
      return record.result.candidates.front().merit(r.objectives.front());
    };
    std::erase_if(records, [&](const SearchRecord& record) {
      const std::vector<Merits> designs = merits_of(r, record);
      return std::all_of(designs.begin(), designs.end(),
                         [&](const Merits& merits) { return listing.excludes(merits); });
    });
    std::sort(records.begin(), records.end(), [&](const SearchRecord& p, const SearchRecord& q) {
      const double mp = merit(p), mq = merit(q);
      return mp != mq ? mp > mq : p.index < q.index;
    });
    if (r.objectives.size() == 1) records.resize(listed_sets(r));
  }
  std::sort(records.begin(), records.end(),
            [](const SearchRecord& p, const SearchRecord& q) { return p.index < q.index; });
  const std::size_t passed_over = sets - records.size();
  return {.optimised = std::move(records), .passed_over = passed_over};
}

std::vector<SearchRecord> listed_stages(const SearchRequirements& r,
                                        const SetEnumeration& enumeration,
                                        const std::vector<SearchRecord>& stages,
                                        const SearchPart& part) {
  return stages_of_best_pairs(r, enumeration.stages, stages, listed_pairs(r), part);
}

}  // namespace trueflank
