// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_file.h"

#include <algorithm>
#include <filesystem>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/reading.h"
#include "trueflank/design/requirements_keys.h"
#include "trueflank/design/toml_document.h"

namespace trueflank {
namespace {

/// What the search puts behind the name of each design.
constexpr const char* kRankSuffix = "-000";

class RequirementsReader {
 public:
  explicit RequirementsReader(const TomlDocument& document) : root_(document.root) {
    reading_.add_all(root_);
    for (const Error& error : document.errors) reading_.report(error);
  }

  ResultAll<SearchRequirements> read(const std::string& file, MaterialTable materials) {
    SearchRequirements r;
    r.strength.materials = std::move(materials);
    r.name = std::filesystem::path(file).stem().string();
    std::vector<std::string> tables{"material"};
    for (const RequirementsSection& section : requirements_sections()) tables.push_back(section.name);
    for (const RequirementsSection& section : requirements_sections()) {
      const TomlTable* table = section.name.empty() ? &root_ : table_of(root_, section.name);
      if (table && section.begun) section.begun(r);
      read_keys(section.name, table, section.keys, r, section.name.empty() ? tables : kNoTables);
    }
    read_materials(r.strength.materials);
    if (!reading_.has("name")) r.name = design_name_from(r.name);
    if (!is_design_name(r.name + kRankSuffix))
      reading_.report({.code = ErrorCode::kOutOfRange,
                       .message = "no name for designs: empty, too long or not printable",
                       .key = "name",
                       .remedy = "one line of 1 to 90 characters"});
    if (reading_.clean())
      for (Error& error : validate(r)) reading_.report(std::move(error));
    if (!reading_.clean()) return fail_all(reading_.errors(file));
    return r;
  }

  ResultAll<MaterialTable> read_table(const std::string& file, MaterialTable table) {
    for (const TomlEntry& entry : root_.entries)
      if (entry.key != "material")
        reading_.unknown(entry.key, entry.key + " is not known", "[material.NAME]");
    read_materials(table);
    if (!reading_.clean()) return fail_all(reading_.errors(file));
    return table;
  }

 private:
  inline static const std::vector<std::string> kNoTables{};

  const TomlTable* table_of(const TomlTable& parent, const std::string& name) {
    const TomlEntry* entry = parent.find(name);
    if (!entry) return nullptr;
    const auto* table = std::get_if<TomlTable>(&entry->value);
    if (!table)
      reading_.report({.code = ErrorCode::kWrongType,
                       .message = name + " is not a table",
                       .key = name,
                       .remedy = "a table: the line [" + name + "] and its keys below"});
    return table;
  }

  template <class Target>
  void read_keys(const std::string& section, const TomlTable* table,
                 const std::vector<RequirementsKey<Target>>& keys, Target& target,
                 const std::vector<std::string>& tables) {
    const std::string prefix = section.empty() ? "" : section + ".";
    if (table)
      for (const TomlEntry& entry : table->entries)
        if (std::find(tables.begin(), tables.end(), entry.key) == tables.end())
          read_entry(prefix, entry, keys, target, tables);
    for (const auto& key : keys)
      if (key.rule.required && !reading_.has(prefix + key.rule.name))
        reading_.missing(prefix + key.rule.name, prefix + key.rule.name + " is missing",
                         wanted(key.rule));
  }

  template <class Target>
  void read_entry(const std::string& prefix, const TomlEntry& entry,
                  const std::vector<RequirementsKey<Target>>& keys, Target& target,
                  std::vector<std::string> known) {
    const std::string dotted = prefix + entry.key;
    for (const auto& key : keys) {
      known.emplace_back(key.rule.name);
      if (entry.key != key.rule.name) continue;
      if (!reading_.good(dotted)) return;  // its line is already reported
      const auto value = take_value(key.rule, dotted, entry.value);
      if (!value) return reading_.report(value.error());
      if (std::string remedy = key.set(target, *value); !remedy.empty())
        reading_.report({.code = ErrorCode::kOutOfRange,
                         .message = dotted + " cannot be read",
                         .key = dotted,
                         .value = quoted_toml(entry.value),
                         .remedy = std::move(remedy)});
      return;
    }
    const std::string near = nearest_name(entry.key, known);
    std::string list;
    for (const std::string& name : known)
      if (!name.empty()) list += (list.empty() ? "" : ", ") + name;
    reading_.unknown(dotted, dotted + " is not known",
                     near.empty() ? "there are " + list : "did you mean " + near + "?");
  }

  void read_materials(MaterialTable& table) {
    const TomlTable* materials = table_of(root_, "material");
    if (!materials) return;
    for (const TomlEntry& entry : materials->entries) {
      const std::string section = "material." + entry.key;
      const auto* inner = std::get_if<TomlTable>(&entry.value);
      if (!inner) {
        reading_.report({.code = ErrorCode::kWrongType,
                         .message = section + " is not a table",
                         .key = section,
                         .remedy = "a table: [" + section + "] and its keys below"});
        continue;
      }
      Material material{.name = entry.key};
      read_keys(section, inner, material_keys(), material, kNoTables);
      table.set(std::move(material));
    }
  }

  const TomlTable& root_;
  Reading reading_;
};

template <class T, class Read>
ResultAll<T> of_text(std::string_view text, const std::string& file, const Read& read) {
  TomlDocument document = parse_toml(text);
  if (document.whole) return read(RequirementsReader(document));
  for (Error& error : document.errors) error.file = file;
  return fail_all(std::move(document.errors));
}

}  // namespace

ResultAll<SearchRequirements> read_requirements_text(std::string_view text, const std::string& file,
                                                     MaterialTable materials) {
  return of_text<SearchRequirements>(text, file, [&](RequirementsReader reader) {
    return reader.read(file, std::move(materials));
  });
}

ResultAll<SearchRequirements> read_requirements(const std::string& path, MaterialTable materials) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  return read_requirements_text(*text, path, std::move(materials));
}

ResultAll<MaterialTable> read_materials_text(std::string_view text, const std::string& file,
                                             MaterialTable table) {
  return of_text<MaterialTable>(text, file, [&](RequirementsReader reader) {
    return reader.read_table(file, std::move(table));
  });
}

ResultAll<MaterialTable> read_materials(const std::string& path, MaterialTable table) {
  const auto text = read_text_file(path, kLargestDesignFile_bytes);
  if (!text) return fail_all({text.error()});
  return read_materials_text(*text, path, std::move(table));
}

std::vector<RequirementsTable> requirements_tables() {
  std::vector<RequirementsTable> tables;
  for (const RequirementsSection& section : requirements_sections()) {
    RequirementsTable table{section.name, {}};
    for (const auto& key : section.keys) table.rules.push_back(key.rule);
    tables.push_back(std::move(table));
  }
  RequirementsTable materials{"material.NAME", {}};
  for (const auto& key : material_keys()) materials.rules.push_back(key.rule);
  tables.push_back(std::move(materials));
  return tables;
}

}  // namespace trueflank
