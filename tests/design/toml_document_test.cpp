// SPDX-License-Identifier: GPL-3.0-or-later
//
// What TOML 1.0 calls valid and invalid; each text below was also put to Python's tomllib, which
// agrees but where noted.
#include "trueflank/design/toml_document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trueflank {
namespace {

/// The value of the one dotted key there is.
TomlValue value_of(const std::string& text) {
  const TomlDocument document = parse_toml("v = " + text);
  EXPECT_TRUE(document.errors.empty()) << text << ": " << document.errors.front().message;
  return document.errors.empty() ? document.root.entries.at(0).value : TomlValue(TomlUnreadable{});
}

TEST(TomlDocument, ReadsWholeNumbersOfEveryBase) {
  EXPECT_EQ(std::get<std::int64_t>(value_of("1_000")), 1000);
  EXPECT_EQ(std::get<std::int64_t>(value_of("-17")), -17);
  EXPECT_EQ(std::get<std::int64_t>(value_of("+0")), 0);
  EXPECT_EQ(std::get<std::int64_t>(value_of("0xDead_beef")), 0xDEADBEEF);
  EXPECT_EQ(std::get<std::int64_t>(value_of("0o755")), 0755);
  EXPECT_EQ(std::get<std::int64_t>(value_of("0b1101_0110")), 0b11010110);
  EXPECT_EQ(std::get<std::int64_t>(value_of("-9223372036854775808")),
            std::numeric_limits<std::int64_t>::min());
}

TEST(TomlDocument, ReadsFloatsToTheLastBit) {
  EXPECT_EQ(std::get<double>(value_of("25.6826")), 25.6826);
  EXPECT_EQ(std::get<double>(value_of("-3.1_4e+0_2")), -314.0);
  EXPECT_EQ(std::get<double>(value_of("5e-22")), 5e-22);
  EXPECT_EQ(std::get<double>(value_of("1E06")), 1e6);
  EXPECT_TRUE(std::signbit(std::get<double>(value_of("-0.0"))));
  EXPECT_EQ(std::get<double>(value_of("-inf")), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(std::get<double>(value_of("+nan"))));
}

TEST(TomlDocument, ReadsTheFourKindsOfStrings) {
  EXPECT_EQ(std::get<std::string>(value_of(R"("a\tb\"c\\ \u00e9 \U0001F600")")),
            "a\tb\"c\\ \u00e9 \U0001F600");
  EXPECT_EQ(std::get<std::string>(value_of(R"('C:\new')")), "C:\\new");
  EXPECT_EQ(std::get<std::string>(value_of("\"\"\"\na\n\"b\"\\\n \n  c\"\"\"\"\"")),
            "a\n\"b\"c\"\"");
  EXPECT_EQ(std::get<std::string>(value_of("'''\r\na\r\n'b'''''")), "a\n'b''");
  EXPECT_EQ(std::get<std::string>(value_of("\"größe\" # größe")), "größe");
}

TEST(TomlDocument, RecognisesWhatNoFileOfOursUses) {
  for (const char* array : {"[]", "[1, 'a', [2.5], {b = 1},]", "[ # x\n 1,\n\n 2 # y\n]"})
    EXPECT_STREQ(std::get<TomlOther>(value_of(array)).kind, "an array") << array;
  for (const char* time : {"1979-05-27", "07:32:00", "07:32:00.999", "1979-05-27T07:32:00Z",
                           "1979-05-27 07:32:00.5-07:00", "2024-02-29"})
    EXPECT_STREQ(std::get<TomlOther>(value_of(time)).kind, "a date or time") << time;
  const auto tables = parse_toml("[[x]]\na = 1\n[x.y]\nb = 2\n[[x]]\n[z]\nc = 3\n");
  EXPECT_TRUE(tables.errors.empty());
  EXPECT_STREQ(std::get<TomlOther>(tables.root.find("x")->value).kind, "an array");
  EXPECT_EQ(std::get<TomlTable>(tables.root.find("z")->value).entries.size(), 1u);
}

TEST(TomlDocument, PutsKeysIntoTheTablesTheyNameWithTheirLines) {
  const auto document = parse_toml(
      "\xEF\xBB\xBFtop = 1\r\n[a.b] # c\r\n\"quoted key\" = 2\r\nd . e = 3\nd.'f' = 4\n\n"
      "g = { h = 5, i.j = 6 }\n[a]\nk = 7");
  ASSERT_TRUE(document.errors.empty()) << document.errors.front().message;
  const auto table = [](const TomlTable& in, const char* key) {
    return std::get<TomlTable>(in.find(key)->value);
  };
  const TomlTable a = table(document.root, "a"), b = table(a, "b");
  EXPECT_EQ(document.root.find("top")->line, 1);
  EXPECT_EQ(document.root.find("a")->line, 8);
  EXPECT_EQ(a.find("b")->line, 2);
  EXPECT_EQ(b.find("quoted key")->line, 3);
  EXPECT_EQ(table(b, "d").find("f")->line, 5);
  EXPECT_EQ(std::get<std::int64_t>(table(table(b, "g"), "i").find("j")->value), 6);
  EXPECT_EQ(a.find("k")->line, 9);
}

TEST(TomlDocument, AcceptsWhatIsValid) {
  for (const char* text : {"", "\n \n\t# only comments", "a = 1", "1 = 2", "- = 3", "'' = 4",
                           "a.b = 1\na.c = 2", "[a.b]\n[a]", "[a]\n[a.b]\n[c]\n[a.d]",
                           "a.b.c = 1\n[a.b.d]\n", "a = {}", "a = 'x' # y"})
    EXPECT_TRUE(parse_toml(text).errors.empty()) << text;
}

TEST(TomlDocument, RefusesWhatIsInvalid) {
  for (const char* text :
       {"a", "a =", "= 1", "a = 1 2", "a = 1 b = 2", "a = 01", "a = 1_", "a = _1", "a = 1__0",
        "a = 1.", "a = .5", "a = 1.e2", "a = 1e", "a = 0x", "a = 0xG", "a = 0b2", "a = +0x1",
        "a = 0X1", "a = True", "a = nan1", "a = Inf", "a = 99999999999999999999", "a = abc",
        "a = \"x", "a = 'x", "a = \"\\q\"", "a = \"\\u12\"", "a = \"\\ud800\"",
        "a = \"\\UFFFFFFFF\"", "a = \"\"\"x", "a = '''x", "a = \"x\ny\"", "a = \"\x01\"",
        "# \x7F", "a = 1 # \x01", "a = \"\\\n\"", "\"\"\"a\"\"\" = 1", "a. = 1", ".a = 1",
        "a b = 1", "größe = 1", "30\xEF\xB9\xBF = 1", "[a", "[a]]", "[]", "[ ]", "[a.]", "[[a]",
        "[ [a] ]", "[a] b = 1", "[+]", "[a\n]", "a = [1", "a = [1 2]", "a = [,]", "a = {b = 1",
        "a = {b = 1,}", "a = {b}", "a = {b = 1\n}", "a = 1\na = 2", "[a]\n[a]", "a = 1\n[a]",
        "a = {}\n[a.b]", "a = {}\na.b = 1", "a.b = 1\n[a]", "[a.b]\n[a]\nb.c = 1", "a = 1\na.b = 2",
        "[[a]]\n[a]", "[a]\n[[a]]", "a = []\n[[a.b.c]]\nd = x", "a = {b = 1, b = 2}",
        "a = {b.c = 1, b = 2}", "a = 1979-13-01", "a = 1979-02-29", "a = 25:00:00", "a = 07:32",
        "a = 1979-05-27T", "a = 1979-05-27T07:32:00+25:00", "a = 1T\\u", "a = 1\rb = 2",
        "a = 2024-05-27  07:32:00",
        // tomllib reads infinity and takes the last two
        "a = 1e999", "[a.b.c]\n[a]\nb.d = 1", "a = 9223372036854775808"}) {
    const auto errors = parse_toml(text).errors;
    ASSERT_FALSE(errors.empty()) << text;
    for (const Error& error : errors) {
      EXPECT_GE(error.line, 1) << text;
      EXPECT_FALSE(error.remedy.empty()) << text;
      EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(ErrorCode::kSyntax));
    }
  }
}

TEST(TomlDocument, TellsEveryWrongLineOnceAndKeepsTheRightOnes) {
  const auto document = parse_toml(
      "a = x\nb = 1\nc = [1,\n 2\nd = 3\n[e\nf = 4\n[g]\nh = \"\"\"\ni = 5\nb = \"");
  std::string lines;
  for (const Error& error : document.errors) lines += std::to_string(error.line) + " ";
  EXPECT_EQ(lines, "1 5 6 9 11 ");
  for (const char* key : {"b", "d", "e", "g"}) EXPECT_TRUE(document.root.find(key)) << key;
  EXPECT_TRUE(std::holds_alternative<TomlUnreadable>(document.root.find("a")->value));
  EXPECT_TRUE(std::get<TomlTable>(document.root.find("e")->value).find("f"));
}

TEST(TomlDocument, WritesTextAndNumbersThatReadBack) {
  for (const char* text : {"", "a\"b\\c", "\x01\x1B[31m\x7F", "\u0085\u009B", "größe 齿 \U0001F600"}) {
    const std::string written = toml_string(text);
    EXPECT_EQ(std::get<std::string>(value_of(written)), text);
    for (const char c : written) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20) << written;
    EXPECT_EQ(written.find("\u009B"), std::string::npos);
  }
  for (double number : {0.1, 1.0, -25.6826, 1e300, 5e-324, 1.0 / 3.0, 1e15, 123456789.0})
    EXPECT_EQ(std::get<double>(value_of(toml_number(number))), number);
}

TEST(TomlDocument, QuotesValuesOnOneShortLine) {
  EXPECT_EQ(quoted_toml(value_of("\"a\\nb\"")), "\"a\\u000Ab\"");
  EXPECT_EQ(quoted_toml(value_of("1.50")), "1.5");
  EXPECT_EQ(quoted_toml(value_of("[1]")), "an array");
  const TomlValue much(std::string(50, 'x') + std::string(50, '\xC3'));
  const std::string long_text = quoted_toml(much);
  EXPECT_LE(long_text.size(), 60u);
  EXPECT_TRUE(long_text.ends_with("..."));
}

}  // namespace
}  // namespace trueflank
