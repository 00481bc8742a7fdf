// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/parallel_jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

using namespace std::chrono_literals;

TEST(ParallelJobs, EachRunsOnceAndAfterWhatItNeeds) {
  for (int round = 0; round < 50; ++round) {
    constexpr std::size_t kJobs = 40;
    std::vector<std::atomic<int>> runs(kJobs);
    std::atomic<int> too_early{0};
    std::vector<QueuedJob> jobs;
    for (std::size_t i = 0; i < kJobs; ++i) {
      std::vector<std::size_t> needs;
      for (const std::size_t back : {1U, 7U, 8U})
        if (i >= back && (i + back) % 3 == 0) needs.push_back(i - back);
      jobs.push_back({[&, i, needs] {
                        for (const std::size_t need : needs)
                          if (runs[need] != 1) ++too_early;
                        if (i % 5 == 0) std::this_thread::sleep_for(50us);
                        ++runs[i];
                        return true;
                      },
                      needs});
    }
    run_jobs(jobs);
    EXPECT_EQ(too_early, 0);
    for (const auto& count : runs) EXPECT_EQ(count, 1);
  }
}

TEST(ParallelJobs, AFreeProcessorPassesOverWhatIsNotReady) {
  std::atomic<bool> third_ran{false};
  bool third_ran_first = false;
  run_jobs({{[&] {
               for (int i = 0; i < 2000 && !third_ran; ++i) std::this_thread::sleep_for(1ms);
               return true;
             }, {}},
            {[&] { return third_ran_first = third_ran, true; }, {0}},
            {[&] { return third_ran = true; }, {}}});
  if (std::thread::hardware_concurrency() > 1) {
    EXPECT_TRUE(third_ran_first);
  }
}

TEST(ParallelJobs, AfterARefusalOrAnExceptionNoneBegins) {
  std::atomic<int> later{0};
  run_jobs({{[] { return false; }, {}}, {[&] { return ++later, true; }, {0}}});
  EXPECT_EQ(later, 0);
  EXPECT_THROW(run_jobs({{[]() -> bool { throw std::runtime_error("no"); }, {}},
                         {[&] { return ++later, true; }, {0}}}),
               std::runtime_error);
  EXPECT_EQ(later, 0);
  run_jobs({});
}

TEST(ParallelJobs, TheFirstInTheQueueThatFailsIsToldWhicheverEndsFirst) {
  for (const bool slow : {false, true}) {
    std::atomic<bool> seventh_failed{false};
    std::atomic<int> done{0};
    std::vector<QueuedJob> jobs(12, {[&] { return ++done, true; }, {}});
    // the fifth needs the fourth, which ends after the seventh has failed
    jobs[3] = {[&] {
                 for (int i = 0; i < 2000 && slow && !seventh_failed; ++i)
                   std::this_thread::sleep_for(1ms);
                 return true;
               },
               {}};
    jobs[4] = {[] { return false; }, {3}};
    jobs[6] = {[&] { return seventh_failed = true, false; }, {}};
    EXPECT_EQ(run_jobs(jobs), 4U);
    EXPECT_GE(done, 3);  // all before it
    if (std::thread::hardware_concurrency() > 1 && slow) {
      EXPECT_TRUE(seventh_failed);
    }
    jobs[4] = {[]() -> bool { throw std::runtime_error("the fifth"); }, {3}};
    jobs[5] = {[]() -> bool { throw std::logic_error("the sixth"); }, {}};
    EXPECT_THROW(run_jobs(jobs), std::runtime_error);
  }
  EXPECT_EQ(run_jobs({{[] { return true; }, {}}}), std::nullopt);
}

TEST(ParallelJobs, MayNeedEarlierJobsOnly) {
  EXPECT_THROW(run_jobs({{[] { return true; }, {0}}}), ContractViolation);
}

}  // namespace
}  // namespace trueflank::io
