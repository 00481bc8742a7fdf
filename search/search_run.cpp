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
#include "trueflank/search/search_values.h"

namespace trueflank {
namespace {

/// Sets looked at together: the best of so many come first.
constexpr std::size_t kBatch = 16384;
constexpr double kNone = -std::numeric_limits<double>::infinity();

int thread_count(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// What a set is worth where it has feasible shifts and one objective ranks.
std::optional<double> merit_of(const SearchRequirements& r, const SearchRecord& record) {
  if (record.result.candidates.empty()) return std::nullopt;
  return record.result.candidates.front().merit(r.objectives.front());
}

/// The merit of the last one listed, as far as is known.
class Threshold {
 public:
  Threshold(const SearchRequirements& r, std::size_t listed, double better_than)
      : r_(r), listed_(listed), least_(listed > 0 && better_than == better_than ? better_than : kNone) {}
  void add(const SearchRecord& record) {
    const auto merit = merit_of(r_, record);
    if (listed_ == 0 || !merit) return;
    best_.insert(*merit);
    if (best_.size() > listed_) best_.erase(best_.begin());
  }
  [[nodiscard]] double merit() const {
    return listed_ > 0 && best_.size() == listed_ ? std::max(least_, *best_.begin()) : least_;
  }

 private:
  const SearchRequirements& r_;
  std::size_t listed_;
  double least_;
  std::multiset<double> best_;
};

enum class Known { kNothing, kOutlines, kProfiles, kAll };

/// A set that waits for its next step.
struct Waiting {
  double bound = std::numeric_limits<double>::infinity();
  std::size_t index = 0;
  ToothSet set;
  Known known = Known::kNothing;
  bool operator<(const Waiting& other) const {
    return bound != other.bound ? bound < other.bound : index > other.index;
  }
};

/// The sets of a run that wait, best first. Not for several threads at a time.
class WaitingSets {
 public:
  using Records = std::map<std::size_t, SearchRecord>;
  WaitingSets(const ToothSets& sets, const SearchPart& part, bool bounded)
      : sets_(sets), part_(part), bounded_(bounded), next_(static_cast<std::size_t>(part.part - 1)) {}

  /// The next one whose bound is not below the threshold; what is `done` is left out.
  std::optional<Waiting> next(double threshold, const Records& done) {
    while (true) {
      if (!heap_.empty() && heap_.top().bound < threshold) drop_all();
      if (threshold >= 0.0) drop_infeasible();
      if (heap_.empty() && take_batch(done)) continue;
      if (!heap_.empty()) {
        const Waiting first = heap_.top();
        heap_.pop();
        return first;
      }
      if (infeasible_.empty()) return std::nullopt;
      const std::size_t index = infeasible_.back();
      infeasible_.pop_back();
      return Waiting{.bound = -1.0, .index = index, .set = sets_[index], .known = Known::kAll};
    }
  }
  /// Those that a bound calls infeasible wait as indices alone: mostly they are all that there is.
  void put_back(const Waiting& waiting) {
    if (waiting.bound < 0.0)
      infeasible_.push_back(waiting.index);
    else
      heap_.push(waiting);
  }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  void drop_all() {
    dropped_ += heap_.size();
    heap_ = {};
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
      heap_.push({.index = next_, .set = sets_[next_], .known = bounded_ ? Known::kNothing : Known::kAll});
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
        threshold_(requirements, listed_sets(requirements), options.better_than),
        waiting_(enumeration.sets, options.part, listed_sets(requirements) > 0) {
    for (const SearchRecord& record : options_.done)
      if (options_.part.holds(record.index) && records_.insert({record.index, record}).second)
        threshold_.add(record);
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
          put_back(bounded(*waiting, threshold()));
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
    auto waiting = stopped_ ? std::nullopt : waiting_.next(threshold_.merit(), records_);
    if (waiting && options_.stop && options_.stop->load()) {
      stopped_ = true;
      return std::nullopt;
    }
    return waiting;
  }

  [[nodiscard]] Waiting bounded(Waiting waiting, double enough) const {
    const DriveDirection direction = r_.objectives.front() == SearchObjective::kForward
                                         ? DriveDirection::kForward
                                         : DriveDirection::kBackward;
    const auto [by, known] = waiting.known == Known::kNothing
                                 ? std::pair(BoundBy::kOutlines, Known::kOutlines)
                             : waiting.known == Known::kOutlines
                                 ? std::pair(BoundBy::kProfiles, Known::kProfiles)
                                 : std::pair(BoundBy::kHalving, Known::kAll);
    // what is told is no more than the meshes': a bound of these below `enough` does
    double bound = efficiency_bound(r_, waiting.set, direction, by, enough);
    if (bound >= 0.0) {
      const ToldEfficiencies told =
          told_efficiencies(r_, signed_ratio(waiting.set), bound, bound);
      bound = direction == DriveDirection::kForward ? told.forward : told.backward;
    }
    waiting.bound = std::min(waiting.bound, bound);
    waiting.known = known;
    return waiting;
  }

  double threshold() {
    const std::lock_guard lock(mutex_);
    return threshold_.merit();
  }

  void put_back(const Waiting& waiting) {
    const std::lock_guard lock(mutex_);
    waiting_.put_back(waiting);
  }

  void keep(SearchRecord record) {
    const std::lock_guard lock(mutex_);
    threshold_.add(record);
    const auto it = records_.insert({record.index, std::move(record)}).first;
    if (options_.on_record)
      options_.on_record(it->second, records_.size() + waiting_.dropped(), total_);
  }

  const SearchRequirements& r_;
  const SearchRunOptions& options_;
  std::map<std::size_t, SearchRecord> records_;
  std::size_t total_ = 0;
  Threshold threshold_;
  WaitingSets waiting_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  bool stopped_ = false;
};

}  // namespace

SearchRecords run_search(const SearchRequirements& requirements, const SetEnumeration& enumeration,
                         const SearchRunOptions& options) {
  return Run(requirements, enumeration, options).run();
}

std::size_t listed_sets(const SearchRequirements& r) {
  // more of the meshes is more of the drive, as long as friction does not fall with the load
  const bool monotone = !r.losses || r.losses->load_friction >= 0.0;
  const bool bounded = r.objectives.size() == 1 && monotone &&
                       (r.objectives.front() == SearchObjective::kForward ||
                        r.objectives.front() == SearchObjective::kBackward);
  return bounded && r.listed > 0 ? static_cast<std::size_t>(std::max(r.listed, r.results)) : 0;
}

SearchRecords listed_records(const SearchRequirements& r, std::vector<SearchRecord> records,
                             std::size_t sets) {
  const std::size_t listed = listed_sets(r);
  const auto feasible = std::stable_partition(
      records.begin(), records.end(),
      [&](const SearchRecord& record) { return merit_of(r, record).has_value(); });
  const bool all = listed == 0 || static_cast<std::size_t>(feasible - records.begin()) < listed;
  if (!all) {
    records.erase(feasible, records.end());
    std::sort(records.begin(), records.end(), [&](const SearchRecord& p, const SearchRecord& q) {
      const double mp = *merit_of(r, p), mq = *merit_of(r, q);
      return mp != mq ? mp > mq : p.index < q.index;
    });
    records.resize(listed);
  }
  std::sort(records.begin(), records.end(),
            [](const SearchRecord& p, const SearchRecord& q) { return p.index < q.index; });
  const std::size_t passed_over = sets - records.size();
  return {.optimised = std::move(records), .passed_over = passed_over};
}

}  // namespace trueflank
