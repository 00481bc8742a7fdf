// SPDX-License-Identifier: GPL-3.0-or-later
//
// The structure of a TOML text: tables, keys and values.
#include <algorithm>

#include "trueflank/design/toml_lexer.h"

namespace trueflank {
namespace {

using Path = std::vector<std::string>;

std::string dotted(const Path& path) {
  std::string text;
  for (const std::string& part : path) text += (text.empty() ? "" : ".") + part;
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

class TomlParser {
 public:
  explicit TomlParser(std::string_view text) : lexer_(text) {}

  TomlDocument parse() {
    while (!lexer_.at_end() && document_.errors.size() < kMostTomlErrors &&
           keys_ <= kMostTomlKeys) {
      statement_line_ = lexer_.line();
      key_.clear();
      value_.clear();
      const TomlLexer start = lexer_;
      if (auto status = statement(); !status) {
        report(status.error());
        lexer_ = start;
        skip_to_next_statement();
      }
    }
    document_.whole = lexer_.at_end();
    return std::move(document_);
  }

 private:
  Status statement() {
    lexer_.skip_blanks();
    if (lexer_.peek() == '#' || lexer_.at_line_end()) return lexer_.end_line();
    value_ = trimmed(lexer_.rest_of_line());
    if (lexer_.peek() == '[') {
      if (auto status = header(); !status) return status;
    } else {
      key_ = dotted(current_path_);
      if (auto status = key_and_value(*current_, current_path_, 0); !status) return status;
    }
    return lexer_.end_line();
  }

  /// [a.b] or [[a.b]]; the keys below a wrong header belong to no table, unless only its bracket is
  /// missing.
  Status header() {
    enter_nowhere();
    current_path_.clear();
    lexer_.advance();
    const bool array = lexer_.take('[');
    auto path = key();
    if (!path) return fail(path.error());
    current_path_ = *path;
    key_ = dotted(*path);
    const Error open = lexer_.error("a table's header whose bracket is not closed",
                                    array ? "[[name]]" : "[name]");
    const bool closed = lexer_.take(']') && (!array || lexer_.take(']'));
    const Status entered = array ? enter_array(*path) : enter_table(*path);
    return closed ? entered : fail(open);
  }

  Status enter_table(const Path& path) {
    TomlTable* table = &document_.root;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const bool last = i + 1 == path.size();
      TomlEntry* entry = table->find(path[i]);
      if (!entry) entry = &add(*table, path[i], TomlTable{});
      TomlTable* inner = std::get_if<TomlTable>(&entry->value);
      if (!inner && (last || !std::holds_alternative<TomlOther>(entry->value)))
        return fail(twice(*entry));
      if (!inner) return {};  // a table inside an array
      if (inner->origin == TomlOrigin::kInline ||
          (last && inner->origin != TomlOrigin::kImplied))
        return fail(twice(*entry));
      if (last) {
        inner->origin = TomlOrigin::kHeader;
        entry->line = statement_line_;
      }
      table = inner;
    }
    current_ = table;
    return {};
  }

  /// Arrays of tables: no file of ours has any, so that one is noted and its tables are dropped.
  Status enter_array(const Path& path) {
    TomlTable* table = &document_.root;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      TomlEntry* entry = table->find(path[i]);
      if (!entry) entry = &add(*table, path[i], TomlTable{});
      if (std::holds_alternative<TomlOther>(entry->value)) return {};
      table = std::get_if<TomlTable>(&entry->value);
      if (!table || table->origin == TomlOrigin::kInline) return fail(twice(*entry));
    }
    if (TomlEntry* entry = table->find(path.back())) {
      if (!std::holds_alternative<TomlOther>(entry->value)) return fail(twice(*entry));
    } else {
      add(*table, path.back(), TomlOther{"an array"});
    }
    return {};
  }

  void enter_nowhere() {
    nowhere_ = {};
    current_ = &nowhere_;
  }

  Result<Path> key() {
    Path path;
    do {
      lexer_.skip_blanks();
      auto part = lexer_.key_part();
      if (!part) return fail(part.error());
      path.push_back(*part);
      lexer_.skip_blanks();
      if (static_cast<int>(path.size()) > kDeepestToml)
        return fail(lexer_.error("a key of more than " + std::to_string(kDeepestToml) + " parts",
                                 "table.key = value"));
    } while (lexer_.take('.'));
    return path;
  }

  /// `a.b = value` in a table whose own path is `at`.
  Status key_and_value(TomlTable& table, const Path& at, int depth) {
    const int line = lexer_.line();
    auto path = key();
    if (!path) return fail(path.error());
    Path whole = at;
    whole.insert(whole.end(), path->begin(), path->end());
    key_ = dotted(whole);
    if (!lexer_.take('=')) return fail(lexer_.error("a = is missing", "key = value"));
    lexer_.skip_blanks();
    if (depth == 0) value_ = trimmed(lexer_.rest_of_line());
    TomlTable* inner = &table;
    for (std::size_t i = 0; i + 1 < path->size(); ++i) {
      TomlEntry* entry = inner->find((*path)[i]);
      if (!entry) entry = &add(*inner, (*path)[i], TomlTable{.origin = TomlOrigin::kDotted}, line);
      inner = std::get_if<TomlTable>(&entry->value);
      if (!inner || inner->origin != TomlOrigin::kDotted) return fail(twice(*entry));
    }
    if (TomlEntry* entry = inner->find(path->back())) return fail(twice(*entry));
    auto read = value(whole, depth);
    // a key whose value is wrong is there all the same
    add(*inner, path->back(), read ? *read : TomlValue(TomlUnreadable{}), line);
    return read ? Status() : fail(read.error());
  }

  Result<TomlValue> value(const Path& at, int depth) {
    const int line = lexer_.line();
    if (lexer_.peek() == '"' || lexer_.peek() == '\'')
      return lexer_.string().map([](std::string text) { return TomlValue(std::move(text)); });
    const bool array = lexer_.peek() == '[';
    if (array || lexer_.peek() == '{') {
      if (depth >= kDeepestToml)
        return fail(lexer_.error(
            "brackets in more than " + std::to_string(kDeepestToml) + " levels", "key = value"));
      lexer_.advance();
      return array ? rest_of_array(at, depth + 1) : rest_of_inline_table(at, depth + 1);
    }
    auto read = toml_word_value(lexer_.word());
    if (!read) read.error().line = line;
    return read;
  }

  Result<TomlValue> rest_of_array(const Path& at, int depth) {
    for (;;) {
      if (auto status = lexer_.skip_blank_lines(); !status) return fail(status.error());
      if (lexer_.take(']')) return TomlValue(TomlOther{"an array"});
      if (auto element = value(at, depth); !element) return fail(element.error());
      if (auto status = lexer_.skip_blank_lines(); !status) return fail(status.error());
      if (lexer_.take(',')) continue;
      if (lexer_.take(']')) return TomlValue(TomlOther{"an array"});
      return fail(lexer_.error("an array whose ] is missing", "[1, 2]"));
    }
  }

  Result<TomlValue> rest_of_inline_table(const Path& at, int depth) {
    TomlTable table{.origin = TomlOrigin::kInline};
    lexer_.skip_blanks();
    if (lexer_.take('}')) return TomlValue(std::move(table));
    do {
      lexer_.skip_blanks();
      if (auto status = key_and_value(table, at, depth); !status) return fail(status.error());
      lexer_.skip_blanks();
    } while (lexer_.take(','));
    if (!lexer_.take('}'))
      return fail(
          lexer_.error("an inline table whose } is missing", "{ key = value, key = value }"));
    return TomlValue(std::move(table));
  }

  TomlEntry& add(TomlTable& table, const std::string& key, TomlValue value, int line = 0) {
    ++keys_;
    if (keys_ == kMostTomlKeys + 1)
      report(lexer_.error("the file has more than " + std::to_string(kMostTomlKeys) + " keys",
                          "a file of text people can read"));
    table.entries.push_back(
        {.key = key, .value = std::move(value), .line = line > 0 ? line : statement_line_});
    return table.entries.back();
  }

  Error twice(const TomlEntry& first) {
    Error error = lexer_.error(
        "given twice, first in line " + std::to_string(first.line), "one of the two");
    error.line = statement_line_;
    return error;
  }

  void report(Error error) {
    error.key = shortened_text(key_);
    error.value = shortened_text(value_);
    document_.errors.push_back(std::move(error));
  }

  /// The next line that begins a table or a key, so that one slip is reported once.
  void skip_to_next_statement() {
    do {
      lexer_.skip_line();
    } while (!lexer_.at_end() && !begins_statement(lexer_.rest_of_line()));
  }

  static bool begins_statement(std::string_view line) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') return true;
    const auto is_name = [](std::string_view name) {
      return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                     "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                     "0123456789_-. \"'") == std::string_view::npos;
    };
    if (text.front() == '[') return is_name(text.substr(1, text.find(']') - 1));
    const auto equals = text.find('=');
    return equals != std::string_view::npos && is_name(text.substr(0, equals));
  }

  TomlLexer lexer_;
  TomlDocument document_;
  TomlTable nowhere_;  ///< takes the keys of tables that are dropped
  TomlTable* current_ = &document_.root;
  Path current_path_;
  int statement_line_ = 1;
  int keys_ = 0;
  std::string key_, value_;  ///< of the statement, for its errors
};

}  // namespace

TomlDocument parse_toml(std::string_view text) {
  TomlDocument document;
  if (auto status = check_text_encoding(text); !status) {
    document.errors = {status.error()};
    document.whole = false;
    return document;
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return TomlParser(text).parse();
}

}  // namespace trueflank
