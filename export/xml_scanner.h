// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trueflank::io {

/// Start and end tags of an XML text, one after the other: all that a 3MF model needs, at the speed
/// of a scan. Prefixes of names are dropped ("p:path" is "path"); comments, processing instructions
/// and CDATA are passed over; text between tags is not kept. Entities in a DTD are not expanded.
class XmlScanner {
 public:
  explicit XmlScanner(std::string_view text) : rest_(text) {}

  struct Tag {
    std::string_view name;
    bool is_start = false;  ///< <a> and <a/>
    bool is_end = false;    ///< </a> and <a/>
    std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< values escaped

    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view wanted) const;
    /// Unescaped; empty where there is none.
    [[nodiscard]] std::string text_attribute(std::string_view wanted) const;
  };

  /// False at the end of the text, and where the text is no XML (see is_broken()).
  [[nodiscard]] bool next(Tag& tag);
  [[nodiscard]] bool is_broken() const { return broken_; }
  /// What is not yet read; a caller that knows what comes may take it from the front.
  [[nodiscard]] std::string_view& rest() { return rest_; }

 private:
  bool stop() {
    broken_ = true;
    return false;
  }
  bool skip_markup();
  std::string_view rest_;
  bool broken_ = false;
};

}  // namespace trueflank::io
