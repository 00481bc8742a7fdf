// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever the text: the reader gives a design or an error with a line, and never crashes.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "trueflank/design/design_file.h"

namespace trueflank {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> example_texts() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(TRUEFLANK_SOURCE_DIR "/examples"))
    if (entry.path().filename() == "design.toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    texts.push_back(text.str());
  }
  return texts;
}

void expect_design_or_error_with_line(const std::string& text) {
  const auto design = read_design_text(text, "rubbish.toml");
  if (design) return;
  ASSERT_FALSE(design.error().empty());
  for (const Error& error : design.error()) {
    ASSERT_GE(error.line, 1) << error.message << "\n" << text;
    ASSERT_FALSE(error.message.empty()) << text;
    ASSERT_TRUE(error.code == ErrorCode::kUnknownKey || !error.remedy.empty())
        << error.message << "\n" << text;
    ASSERT_EQ(error.file, "rubbish.toml");
  }
}

TEST(DesignRubbish, EveryTruncationOfTheExamplesIsADesignOrAnErrorWithALine) {
  const auto texts = example_texts();
  ASSERT_GE(texts.size(), 6u);
  for (const std::string& text : texts)
    for (std::size_t end = 0; end < text.size(); end += 3)
      expect_design_or_error_with_line(text.substr(0, end));
}

TEST(DesignRubbish, MutatedExamplesAreADesignOrAnErrorWithALine) {
  const auto texts = example_texts();
  const std::string pieces[] = {"=",    "[",   "]",    "{",    "}",      "\"",     "'",    ".",
                                "#",    "\n",  "nan",  "-",    "1e999",  "\"\"\"", "'''",  ",",
                                "\\",   "\t",  "\r",   "\xC3", "\xEF\xB9\xBF", "30\xEF\xB9\xBF=1\n",
                                "true", "0x1", "a.b.", "[[x]]\n", std::string(1, '\0'), "inf"};
  std::mt19937 engine(11);
  for (int i = 0; i < 6000; ++i) {
    std::string text = texts[engine() % texts.size()];
    for (unsigned change = engine() % 4; change < 4; ++change) {
      const std::size_t at = engine() % (text.size() + 1);
      if (engine() % 3 == 0)
        text.erase(at, engine() % 20);
      else if (engine() % 2 == 0)
        text.insert(at, pieces[engine() % std::size(pieces)]);
      else if (at < text.size())
        text[at] = static_cast<char>(engine());
    }
    expect_design_or_error_with_line(text);
  }
}

TEST(DesignRubbish, BinaryIsRefusedInOneClearMessage) {
  struct Case {
    std::string text;
    const char* message;
    int line;
  };
  for (const Case& c : std::vector<Case>{
           {std::string("a\nb\0c", 5), "the file holds a NUL byte: it is no text", 2},
           {std::string("\xFF\xFE[\0g\0", 6), "the file is UTF-16 text", 1},
           {"name = \"\xC0\xAF\"", "the file is not UTF-8 text", 1},
           {"\n\n# \xED\xA0\x80", "the file is not UTF-8 text", 3},
           {"# \xF4\x90\x80\x80", "the file is not UTF-8 text", 1},
           {"# \xE2\x82", "the file is not UTF-8 text", 1}}) {
    const auto design = read_design_text(c.text, "binary");
    ASSERT_FALSE(design);
    ASSERT_EQ(design.error().size(), 1u);
    const Error& error = design.error().front();
    EXPECT_EQ(error.message, c.message);
    EXPECT_EQ(error.line, c.line);
    EXPECT_EQ(error.file, "binary");
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::kSyntax));
  }
}

TEST(DesignRubbish, DeepNestingAndManyKeysCannotExhaustStackOrTime) {
  std::string key = "a", keys;
  for (int i = 0; i < 200000; ++i) key += ".a";
  for (int i = 0; i < 100000; ++i) keys += "k" + std::to_string(i) + " = 1\n";
  for (const std::string& text :
       {key + " = 1", "[" + key + "]", "[[" + key + "]]", "x = {" + key + " = 1}",
        "x = " + std::string(400000, '['), "x = [" + std::string(300, '{'), keys,
        "x = " + std::string(300000, '"'), std::string(300000, '['),
        std::string(500000, '\n') + "=", std::string(1000000, '=')}) {
    const auto design = read_design_text(text, "deep.toml");
    ASSERT_FALSE(design);
    EXPECT_LT(design.error().size(), 1002u);
    for (const Error& error : design.error()) EXPECT_LT(error.message.size(), 300u);
  }
}

/// What reading a path says.
Error error_of_path(const std::string& path) {
  const auto design = read_design_file(path);
  EXPECT_FALSE(design);
  EXPECT_EQ(design.error().size(), 1u);
  return design ? Error{} : design.error().front();
}

TEST(DesignRubbish, FilesThatCannotBeReadAreTheEnvironmentsFault) {
  for (const char* path : {"", "/nowhere/design.toml", "/dev/null/design.toml"}) {
    const Error error = error_of_path(path);
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::kFileNotFound));
    EXPECT_EQ(exit_code(error.code), 3);
    EXPECT_NE(error.message.find(path), std::string::npos);
  }
  const fs::path secret = fs::path(TRUEFLANK_TEST_OUTPUT_DIR) / "design_secret.toml";
  std::ofstream(secret) << "format = 1\n";
  ::chmod(secret.c_str(), 0);
  if (::access(secret.c_str(), R_OK) != 0) {
    const Error error = error_of_path(secret.string());
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::kPermission));
    EXPECT_EQ(exit_code(error.code), 3);
  }
  fs::remove(secret);
}

TEST(DesignRubbish, DirectoriesAndEndlessFilesAreWrongInput) {
  const Error directory = error_of_path(TRUEFLANK_SOURCE_DIR);
  EXPECT_EQ(exit_code(directory.code), 2);
  EXPECT_NE(directory.message.find("is a directory"), std::string::npos);
  const Error endless = error_of_path("/dev/zero");
  EXPECT_EQ(exit_code(endless.code), 2);
  EXPECT_NE(endless.message.find("larger than 1048576 bytes"), std::string::npos);
}

TEST(DesignRubbish, APipeIsReadLikeAFile) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string text =
      "format = 1\nname = \"p\"\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1\n[gear]\nteeth = 20\n"
      "face_width_mm = 5\n";
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  const auto design = read_design("/proc/self/fd/" + std::to_string(ends[0]));
  ::close(ends[0]);
  ASSERT_TRUE(design) << design.error().front().message;
  EXPECT_EQ(design->name, "p");
}

TEST(DesignRubbish, OfThousandsOfErrorsTheFirstThousandIsTold) {
  std::string text = "format = 1\n";
  for (int i = 0; i < 9000; ++i) text += "unknown_key_number_" + std::to_string(i) + " = 1\n";
  const auto design = read_design_text(text, "long.toml");
  ASSERT_FALSE(design);
  ASSERT_EQ(design.error().size(), 1001u);
  EXPECT_EQ(design.error()[3].line, 5);
  EXPECT_EQ(design.error().back().message, "and 8001 errors more");  // [gearbox] is missing too
}

}  // namespace
}  // namespace trueflank
