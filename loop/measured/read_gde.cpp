// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/loop/measured/read_measurement.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

constexpr double kMostGdeTeeth = 1e6;

/// One step through XML text: an opening tag, a closing tag, or text between.
struct Token {
  enum class Kind { kOpen, kClose, kText } kind = Kind::kText;
  std::string name;  ///< local name in lower case
  std::map<std::string, std::string> attributes;
  std::string_view text;
  bool empty_element = false;
  int line = 1;
};

class XmlTokens {
 public:
  explicit XmlTokens(std::string_view text) : text_(text) {}
  std::optional<Token> next() {
    while (at_ < text_.size()) {
      Token token;
      token.line = line_;
      if (text_[at_] != '<') {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        token.text = trimmed(take(end));
        if (!token.text.empty()) return token;
        continue;
      }
      const std::size_t end = text_.find('>', at_);
      if (end == std::string_view::npos) return std::nullopt;
      std::string_view tag = take(end + 1);
      tag = tag.substr(1, tag.size() - 2);
      if (tag.empty() || tag.front() == '?' || tag.front() == '!') continue;
      token.kind = tag.front() == '/' ? Token::Kind::kClose : Token::Kind::kOpen;
      if (tag.front() == '/') tag.remove_prefix(1);
      token.empty_element = !tag.empty() && tag.back() == '/';
      if (token.empty_element) tag.remove_suffix(1);
      token.name = local(tag.substr(0, tag.find_first_of(" \t\r\n")));
      read_attributes(tag, token.attributes);
      return token;
    }
    return std::nullopt;
  }

 private:
  static std::string local(std::string_view name) {
    const std::size_t colon = name.rfind(':');
    return lowered(trimmed(colon == std::string_view::npos ? name : name.substr(colon + 1)));
  }
  std::string_view take(std::size_t end) {
    const std::string_view part = text_.substr(at_, end - at_);
    line_ += static_cast<int>(std::count(part.begin(), part.end(), '\n'));
    at_ = end;
    return part;
  }
  static void read_attributes(std::string_view tag, std::map<std::string, std::string>& attributes) {
    std::size_t at = tag.find('=');
    std::size_t after = 0;  // of the attribute before: nothing is searched twice
    while (at != std::string_view::npos && at + 1 < tag.size()) {
      std::size_t begin = tag.substr(after, at - after).find_last_of(" \t\r\n");
      if (begin != std::string_view::npos) begin += after;
      const char quote = tag[at + 1];
      const std::size_t end = tag.find(quote, at + 2);
      if (begin == std::string_view::npos || end == std::string_view::npos) return;
      attributes[local(tag.substr(begin + 1, at - begin - 1))] =
          std::string(tag.substr(at + 2, end - at - 2));
      after = end + 1;
      at = tag.find('=', after);
    }
  }
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

bool holds(const std::string& name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](auto word) { return name.find(word) != std::string::npos; });
}

/// Gathers what is known while walking down: kind of curve, tooth, flank, then its points.
class GdeReader {
 public:
  GdeReader(const std::string& file, std::string_view text) : tokens_(text), bad_(file) {
    data_.file = file;
  }
  Result<InspectionData> read(std::vector<std::string>& notes) {
    while (auto token = tokens_.next()) {
      if (token->kind == Token::Kind::kOpen) open(*token);
      else if (token->kind == Token::Kind::kClose) close(*token);
      else leaf(name_, std::string(token->text), token->line);
    }
    if (data_.rows.empty())
      return fail({.code = ErrorCode::kSyntax,
                   .message = "no measured curve was understood in this GDE file",
                   .remedy = "deviations of profile or helix curves with tooth, flank and place; or "
                             "export the inspection CSV of docs/loop.md",
                   .file = data_.file});
    bad_.tell(notes);
    std::string list;
    for (const std::string& name : unknown_) {
      if (list.size() > 300) break;
      list += (list.empty() ? "" : ", ") + name;
    }
    if (!list.empty()) notes.push_back(data_.file + ": not understood: " + list);
    return std::move(data_);
  }

 private:
  void open(const Token& token) {
    name_ = token.name;
    if (holds(name_, {"point", "value_pair", "measured_value"})) point_ = InspectionRow{};
    if (holds(name_, {"profile"})) record_ = RecordKind::kProfile;
    else if (holds(name_, {"helix", "lead", "flankline"})) record_ = RecordKind::kHelix;
    for (const auto& [key, value] : token.attributes) leaf(key, value, token.line);
    if (token.empty_element) close(token);
  }
  void close(const Token& token) {
    if (holds(token.name, {"point", "value_pair", "measured_value"})) finish_point(token.line);
    name_.clear();
  }
  void leaf(const std::string& name, const std::string& text, int line) {
    const double value = number_in(trimmed(text));
    if (holds(name, {"tooth"})) tooth_of(name, value, text, line);
    else if (holds(name, {"flank", "side"})) flank_of(text);
    else if (holds(name, {"deviation", "dev"})) point_.deviation_um = deviation_ = value;
    else if (holds(name, {"diameter"})) point_.diameter_mm = value;
    else if (holds(name, {"radius"})) point_.diameter_mm = 2.0 * value;
    else if (name == "z" || holds(name, {"face_position", "axial", "height"})) point_.z_mm = value;
    else if (name == "values") values(text, line);
    else if (!name.empty() && !text.empty()) unknown_.insert(name);
  }
  /// `tooth_width = 12.5` is no tooth's number, and `tooth = 1e30` is none that can be.
  void tooth_of(const std::string& name, double value, const std::string& text, int line) {
    if (value >= 1.0 && value <= kMostGdeTeeth && value == std::floor(value)) {
      tooth_ = static_cast<int>(value);
    } else if (name == "tooth" || holds(name, {"number", "no"})) {
      if (text.empty()) return;
      tooth_ = 0;
      bad_.add(line, "tooth \"" + text.substr(0, 40) + "\" is no tooth number");
    }
  }
  void flank_of(const std::string& text) {
    const std::string low = lowered(text);
    if (low.starts_with("l")) flank_ = Flank::kLeft;
    if (low.starts_with("r")) flank_ = Flank::kRight;
  }
  void values(const std::string&, int line) { bad_.add(line, "a list of values without places"); }
  void finish_point(int line) {
    InspectionRow row = point_;
    row.record = record_;
    row.tooth = tooth_;
    row.flank = flank_;
    row.line = line;
    const bool placed = record_ == RecordKind::kProfile ? row.diameter_mm > 0.0 : !std::isnan(row.z_mm);
    if (tooth_ < 1 || std::isnan(deviation_) || !placed)
      bad_.add(line, "a point without tooth, place or deviation");
    else data_.rows.push_back(row);
    point_ = {};
    deviation_ = kNaN;
  }

  XmlTokens tokens_;
  BadLines bad_;
  InspectionData data_;
  InspectionRow point_;
  std::string name_;
  std::set<std::string> unknown_;
  RecordKind record_ = RecordKind::kProfile;
  Flank flank_ = Flank::kLeft;
  int tooth_ = 0;
  double deviation_ = kNaN;
};

}  // namespace

Result<InspectionData> read_gde(const std::string& file, std::string_view text,
                                std::vector<std::string>& notes) {
  return GdeReader(file, text).read(notes);
}

}  // namespace trueflank::loop
