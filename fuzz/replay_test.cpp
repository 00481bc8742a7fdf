// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corpus of every fuzz target, each file as it is and changed in many small ways, as ordinary
// tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "fuzz/targets.h"

namespace trueflank::fuzz {
namespace {

namespace fs = std::filesystem;

/// Of the processor, for one input; sanitizers included.
constexpr double kAtOnce_s = 4.0;
/// Changed inputs a target, shared by its files.
constexpr int kChanges = 400;

class Replay : public testing::TestWithParam<Target> {
 protected:
  static std::vector<fs::path> corpus(std::string_view target) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(TRUEFLANK_SOURCE_DIR) / "fuzz" / "corpus" / target))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  static std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void run(const std::string& bytes, const std::string& what) {
    const std::clock_t begin = std::clock();
    GetParam().run(bytes);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kAtOnce_s) << what;
  }
};

/// One of what slips, transfers and malice do to a file.
std::string changed(std::string bytes, std::minstd_rand& random) {
  const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
  static const std::vector<std::string> words = {"1e308",
                                                 "-1",
                                                 "99999999999999999999",
                                                 "nan",
                                                 "inf",
                                                 "0",
                                                 "\"",
                                                 "{",
                                                 "]",
                                                 "<",
                                                 "\n",
                                                 "\xff\xfe",
                                                 std::string(1, '\0'),
                                                 std::string("\xff\xff\xff\xff"),
                                                 std::string("\x00\x00\x00\x80", 4)};
  const int times = 1 + static_cast<int>(below(4));
  for (int i = 0; i < times; ++i) {
    const std::size_t at = below(bytes.size() + 1);
    switch (below(6)) {
      case 0:
        if (!bytes.empty()) bytes[below(bytes.size())] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, 1 + below(8));
        break;
      case 2:
        bytes.insert(at, words[below(words.size())]);
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size() + 1), 1 + below(60)));
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(below(6), bytes.size() - at),
                      words[below(words.size())]);
    }
  }
  return bytes;
}

TEST_P(Replay, HasADictionaryForTheFuzzer) {
  std::ifstream stream(fs::path(TRUEFLANK_SOURCE_DIR) / "fuzz" / "dictionaries" /
                       (std::string(GetParam().name) + ".dict"));
  int words = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    EXPECT_TRUE(line.size() > 2 && line.front() == '"' && line.back() == '"') << line;
    ++words;
  }
  EXPECT_GT(words, 3);
}

TEST_P(Replay, TakesEveryFileOfItsCorpus) {
  const auto files = corpus(GetParam().name);
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) run(content_of(file), file.string());
}

TEST_P(Replay, TakesItsCorpusChangedInAnyWay) {
  std::minstd_rand random(20261122);
  const auto files = corpus(GetParam().name);
  for (int i = 0; i < kChanges; ++i) {
    const fs::path& file = files[static_cast<std::size_t>(i) % files.size()];
    run(changed(content_of(file), random), file.string() + ", change " + std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace trueflank::fuzz
