// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corpus of every fuzz target, each file as it is and changed in many small ways, as ordinary
// tests. TRUEFLANK_CHANGES and TRUEFLANK_SEED ask for more changes and for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
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
constexpr unsigned kChanges = 400, kSeed = 20261122;

unsigned asked(const char* variable, unsigned otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : otherwise;
}

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

/// The number in a text nearest behind a place, as begin and length; nothing of length 0.
std::pair<std::size_t, std::size_t> number_behind(const std::string& bytes, std::size_t at) {
  const auto is_of_number = [&](std::size_t i) {
    return i < bytes.size() && (std::isdigit(static_cast<unsigned char>(bytes[i])) != 0 ||
                                bytes[i] == '.' || bytes[i] == '-');
  };
  while (at < bytes.size() && !is_of_number(at)) ++at;
  std::size_t end = at;
  while (is_of_number(end)) ++end;
  return {at, end - at};
}

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
    switch (below(8)) {
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
      case 5:
      case 6: {
        static const std::vector<std::string> numbers = {
            "1e308",      "-1e308",     "1e-320", "nan", "-0", "0", "-1", "1e9", "1e15", "1e19", "65535",
            "2147483648", "4294967296", "99999999999999999999", "1.0000000000000002", "0.1e-6"};
        const auto [begin, length] = number_behind(bytes, at);
        if (length > 0) bytes.replace(begin, length, numbers[below(numbers.size())]);
        break;
      }
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
  std::minstd_rand random(asked("TRUEFLANK_SEED", kSeed));
  const auto files = corpus(GetParam().name);
  for (unsigned i = 0; i < asked("TRUEFLANK_CHANGES", kChanges); ++i) {
    const fs::path& file = files[i % files.size()];
    run(changed(content_of(file), random), file.string() + ", change " + std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace trueflank::fuzz
