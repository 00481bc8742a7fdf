// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_edit.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"

namespace trueflank {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool blank(char c) { return c == ' ' || c == '\t'; }

/// Where a value of one line stands behind its key; nothing where the line is not `key = value # comment`.
struct ValuePlace {
  std::size_t key_begin = 0, key_end = 0;  ///< of the key's name, quotes and dots included
  std::size_t begin = 0, end = 0;          ///< of the value, blanks left out
};

/// `dotted`: the key with its tables; the line may name any number of them ("ring.cutter.teeth =
/// 20").
std::optional<ValuePlace> value_place(const std::string& line, const std::string& dotted) {
  const auto names = [&](const std::string& name) {
    return name == dotted ||
           (dotted.ends_with(name) && dotted[dotted.size() - name.size() - 1] == '.');
  };
  ValuePlace place;
  while (place.key_begin < line.size() && blank(line[place.key_begin])) ++place.key_begin;
  const auto equals = line.find('=', place.key_begin);
  if (equals == std::string::npos) return std::nullopt;
  place.key_end = equals;
  while (place.key_end > place.key_begin && blank(line[place.key_end - 1])) --place.key_end;
  std::string name = line.substr(place.key_begin, place.key_end - place.key_begin);
  if (name.size() > 2 && name.starts_with('"') && name.ends_with('"'))
    name = name.substr(1, name.size() - 2);
  if (name.empty() || !names(name)) return std::nullopt;
  place.begin = equals + 1;
  while (place.begin < line.size() && blank(line[place.begin])) ++place.begin;
  char quote = 0;
  place.end = place.begin;
  for (std::size_t i = place.begin; i < line.size(); ++i) {
    if (quote == 0 && line[i] == '#') break;
    if (quote == 0 && (line[i] == '"' || line[i] == '\'')) quote = line[i];
    else if (quote == '"' && line[i] == '\\') ++i;
    else if (line[i] == quote) quote = 0;
    if (i < line.size() && !blank(line[i]) && line[i] != '\r') place.end = i + 1;
  }
  if (quote != 0 || place.end <= place.begin) return std::nullopt;
  return place;
}

/// "ring.cutter." of "ring.cutter.teeth = 20"; empty where the line names the key alone.
std::string tables_before(const std::string& line, const ValuePlace& place) {
  const std::string name = line.substr(place.key_begin, place.key_end - place.key_begin);
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot + 1);
}

/// The value replaced; a comment behind it keeps its column where there is room.
std::string with_value(const std::string& line, const ValuePlace& place, const std::string& name,
                       const std::string& value) {
  std::string changed = line.substr(0, place.key_begin) + tables_before(line, place) + name +
                        line.substr(place.key_end, place.begin - place.key_end) + value;
  std::string rest = line.substr(place.end);
  const auto comment = rest.find('#');
  if (comment == std::string::npos) return changed + rest;
  const std::size_t column = place.end + comment;
  if (changed.size() + 1 < column)
    changed.append(column - changed.size(), ' ');
  else
    changed += " ";
  return changed + rest.substr(comment);
}

/// The text of a file being edited; lines keep their numbers until the end.
class Editor {
 public:
  Editor(std::string_view text, const DesignFile& file) : lines_(lines_of(text)), file_(file) {}

  bool apply(const DesignKeyChange& change) {
    const std::string name = name_in_file(change);
    if (!name.empty()) return replace(file_.lines.at(name), change, name);
    return change.after.empty() || insert(change);
  }

  /// Of each table that would lose its last line, one of the keys of `after` that says that it is still there.
  [[nodiscard]] std::vector<DesignKeyChange> keys_of_lost_tables(const std::vector<DesignKeyChange>& changes,
                                                                 const GearboxDesign& after) const {
    std::set<int> lost;
    std::set<std::string> tables;
    for (const DesignKeyChange& change : changes) {
      if (!change.after.empty() || change.table.empty()) continue;
      tables.insert(change.table);
      if (const std::string name = name_in_file(change); !name.empty()) lost.insert(file_.lines.at(name));
    }
    for (const DesignKeyChange& change : changes)
      if (!change.after.empty()) tables.erase(change.table);
    std::vector<DesignKeyChange> keys;
    for (const WrittenKey& key : written_keys(after))
      if (tables.contains(key.table) && !keeps(key.table, lost)) {
        keys.push_back({key.table, key.key, "", key.value});
        tables.erase(key.table);
      }
    return keys;
  }

  [[nodiscard]] std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      text += lines_[i] + "\n";
      if (const auto more = behind_.find(i); more != behind_.end())
        for (const std::string& line : more->second) text += line + "\n";
    }
    return text + at_the_end_;
  }

 private:
  /// The dotted name under which the file gives a key, lengths perhaps in inches; empty where it does not.
  [[nodiscard]] std::string name_in_file(const DesignKeyChange& change) const {
    const std::string name = change.dotted();
    if (name.ends_with("_mm"))
      if (const std::string inches = name.substr(0, name.size() - 3) + "_in"; file_.lines.contains(inches)) return inches;
    return file_.lines.contains(name) ? name : "";
  }

  /// True where a table has a header, or a key on another line than these.
  [[nodiscard]] bool keeps(const std::string& table, const std::set<int>& lost) const {
    return std::any_of(file_.lines.begin(), file_.lines.end(), [&](const auto& entry) {
      if (entry.first == table) {
        const std::string& line = lines_.at(static_cast<std::size_t>(entry.second - 1));
        return line.find_first_not_of(" \t") == line.find('[');
      }
      return entry.first.starts_with(table + ".") && !lost.contains(entry.second);
    });
  }

  bool replace(int number, const DesignKeyChange& change, const std::string& dotted) {
    std::string& line = lines_.at(static_cast<std::size_t>(number - 1));
    const auto place = value_place(line, dotted);
    if (!place) return false;
    line = change.after.empty() ? "# " + line : with_value(line, *place, change.key, change.after);
    return true;
  }

  /// Behind the last key of the table, else at the end.
  bool insert(const DesignKeyChange& change) {
    const std::string written = change.key + " = " + change.after;
    if (change.table.empty()) return false;
    const auto header = file_.lines.find(change.table);
    if (header == file_.lines.end()) {
      std::string& tail = at_the_end_;
      const std::string title = "\n[" + change.table + "]\n";
      if (tail.find(title) == std::string::npos) tail += title;
      tail += written + "\n";
      return true;
    }
    int last = header->second;
    std::string tables;  // that keys beside it name: those of a table without a header do
    const std::string prefix = change.table + ".";
    for (const auto& [key, line] : file_.lines)
      if (key.starts_with(prefix) && key.find('.', prefix.size()) == std::string::npos &&
          !is_table(key) && line >= last) {
        const std::string& beside = lines_.at(static_cast<std::size_t>(line - 1));
        const auto place = value_place(beside, key);
        if (!place) continue;  // read from bore_in, it is known as bore_mm too
        last = line;
        tables = tables_before(beside, *place);
      }
    const bool carriage_return = lines_.at(static_cast<std::size_t>(last - 1)).ends_with('\r');
    behind_[static_cast<std::size_t>(last - 1)].push_back(tables + written +
                                                          (carriage_return ? "\r" : ""));
    return true;
  }

  [[nodiscard]] bool is_table(const std::string& key) const {
    const auto next = file_.lines.upper_bound(key);
    return next != file_.lines.end() && next->first.starts_with(key + ".");
  }

  std::vector<std::string> lines_;
  std::map<std::size_t, std::vector<std::string>> behind_;
  std::string at_the_end_;
  const DesignFile& file_;
};

}  // namespace

std::vector<DesignKeyChange> design_changes(const GearboxDesign& before, const GearboxDesign& after) {
  std::map<std::string, std::string> old_values, new_values;
  const auto keys_before = written_keys(before), keys_after = written_keys(after);
  for (const WrittenKey& k : keys_before) old_values[k.table + "." + k.key] = k.value;
  for (const WrittenKey& k : keys_after) new_values[k.table + "." + k.key] = k.value;
  std::vector<DesignKeyChange> changes;
  const auto take = [&](const WrittenKey& k) {
    const std::string name = k.table + "." + k.key;
    const auto was = old_values.find(name), is = new_values.find(name);
    const std::string from = was == old_values.end() ? "" : was->second;
    const std::string to = is == new_values.end() ? "" : is->second;
    const bool known = std::any_of(changes.begin(), changes.end(), [&](const DesignKeyChange& c) {
      return c.table == k.table && c.key == k.key;
    });
    if (from != to && !known) changes.push_back({k.table, k.key, from, to});
  };
  for (const WrittenKey& k : keys_after) take(k);
  for (const WrittenKey& k : keys_before) take(k);
  return changes;
}

ResultAll<EditedDesign> edited_design(std::string_view text, const std::string& file, const GearboxDesign& after) {
  const auto read = read_design_file_text(text, file);
  if (!read) return fail_all(read.error());
  Editor editor(text, *read);
  std::vector<DesignKeyChange> changes = design_changes(read->design, after);
  const std::vector<DesignKeyChange> written_out = editor.keys_of_lost_tables(changes, after);
  changes.insert(changes.end(), written_out.begin(), written_out.end());
  // new keys stand beside those of their table, so before these go
  std::stable_partition(changes.begin(), changes.end(), [](const DesignKeyChange& c) { return !c.after.empty(); });
  bool edited = true;
  for (const DesignKeyChange& change : changes) edited = editor.apply(change) && edited;
  const std::string result = editor.text();
  const auto again = read_design_file_text(result, file);
  if (edited && again && again->design == after) return EditedDesign{result, written_out};
  return EditedDesign{design_file_text(after), {}};
}

ResultAll<std::string> edited_design_text(std::string_view text, const std::string& file,
                                          const GearboxDesign& after) {
  auto edited = edited_design(text, file, after);
  if (!edited) return fail_all(edited.error());
  return std::move(edited->text);
}

}  // namespace trueflank
