// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/effects_file.h"

#include <algorithm>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/design/toml_document.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank {
namespace {

class EffectsReader {
 public:
  explicit EffectsReader(const std::string& path) : path_(path) {}

  ResultAll<loop::DeclaredFamilies> read(std::string_view text) {
    const TomlDocument document = parse_toml(text);
    for (Error error : document.errors) add(std::move(error), error.line);
    for (const TomlEntry& entry : document.root.entries) read_effect(entry);
    if (families_.empty() && errors_.empty())
      add({.code = ErrorCode::kMissingKey,
           .message = "the file declares no effect",
           .remedy = "[NAME] with description, and [NAME.form] with parameter = \"formula\""},
          1);
    if (!errors_.empty()) return fail_all(std::move(errors_));
    return std::make_shared<const std::vector<loop::EffectFamily>>(std::move(families_));
  }

 private:
  void add(Error error, int line) {
    error.file = path_;
    if (error.line == 0) error.line = line;
    errors_.push_back(std::move(error));
  }
  void wrong(const TomlEntry& entry, const std::string& key, const std::string& needed) {
    add({.code = ErrorCode::kWrongType,
         .message = "this key needs " + needed,
         .key = key,
         .value = quoted_toml(entry.value)},
        entry.line);
  }
  [[nodiscard]] static bool is_name(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
      return is_small(c) || is_digit(c) || c == '_';
    });
  }

  void read_effect(const TomlEntry& entry) {
    const auto* table = std::get_if<TomlTable>(&entry.value);
    if (table == nullptr) return wrong(entry, entry.key, "to be a table: [" + entry.key + "]");
    if (!is_name(entry.key))
      return add({.code = ErrorCode::kOutOfRange,
                  .message = "a name of an effect has small letters, digits and _ only",
                  .key = shortened_text(entry.key)},
                 entry.line);
    loop::DeclaredEffect effect{.id = entry.key};
    for (const TomlEntry& item : table->entries) read_item(item, effect);
    const std::size_t before = errors_.size();
    auto family = loop::declared_family(effect);
    if (family)
      families_.push_back(std::move(*family));
    else
      for (const Error& error : family.error()) add(error, line_of(*table, error.key, entry.line));
    if (errors_.size() == before && effect.description.empty())
      add({.code = ErrorCode::kMissingKey,
           .message = "say in a few words what the effect does",
           .key = effect.id + ".description"},
          entry.line);
  }

  /// Line of the formula an error's key "effect.form.parameter" names.
  static int line_of(const TomlTable& effect, const std::string& key, int otherwise) {
    const TomlEntry* form = effect.find("form");
    const auto* table = form == nullptr ? nullptr : std::get_if<TomlTable>(&form->value);
    if (table == nullptr) return otherwise;
    const TomlEntry* found = table->find(key.substr(key.rfind('.') + 1));
    return found == nullptr ? form->line : found->line;
  }

  void read_item(const TomlEntry& item, loop::DeclaredEffect& effect) {
    const std::string key = effect.id + "." + item.key;
    const auto text = [&](std::string& target) {
      if (const auto* value = std::get_if<std::string>(&item.value))
        target = *value;
      else
        wrong(item, key, "a text");
    };
    const auto flag = [&](bool& target) {
      if (const auto* value = std::get_if<bool>(&item.value))
        target = *value;
      else
        wrong(item, key, "true or false");
    };
    if (item.key == "description") return text(effect.description);
    if (item.key == "cause") return text(effect.cause);
    if (item.key == "correction") return text(effect.correction);
    if (item.key == "correctable") return flag(effect.correctable);
    if (item.key == "one_flank_too") return flag(effect.one_flank_too);
    const auto* form = std::get_if<TomlTable>(&item.value);
    if (item.key != "form" || form == nullptr)
      return add({.code = ErrorCode::kUnknownKey,
                  .message = "an effect has no such key",
                  .key = key,
                  .remedy = "description, cause, correction, correctable, one_flank_too, form"},
                 item.line);
    for (const TomlEntry& parameter : form->entries) {
      const auto* formula = std::get_if<std::string>(&parameter.value);
      if (formula == nullptr)
        wrong(parameter, key + "." + parameter.key, "a formula in quotes");
      else
        effect.columns.emplace_back(parameter.key, *formula);
    }
  }

  const std::string& path_;
  Errors errors_;
  std::vector<loop::EffectFamily> families_;
};

}  // namespace

ResultAll<loop::DeclaredFamilies> read_effects_text(std::string_view text,
                                                    const std::string& path) {
  return EffectsReader(path).read(text);
}

ResultAll<loop::DeclaredFamilies> read_effects_file(const std::string& path) {
  const auto text = loop::read_whole_file(path, loop::kMostBytesOfText);
  if (!text) return fail_all({text.error()});
  return read_effects_text(*text, path);
}

}  // namespace trueflank
