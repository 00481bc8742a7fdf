// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/train/gearbox_design.h"

namespace trueflank {

/// A key of the design file in which two designs differ.
struct DesignKeyChange {
  std::string table, key;     ///< "wheel", "tip_diameter_mm"; table empty: the top of the file
  std::string before, after;  ///< as the file writes them; empty: not written

  [[nodiscard]] std::string dotted() const { return table.empty() ? key : table + "." + key; }
};

/// In the order of the file.
[[nodiscard]] std::vector<DesignKeyChange> design_changes(const GearboxDesign& before,
                                                          const GearboxDesign& after);

struct EditedDesign {
  std::string text;
  /// Keys written although neither design differs in them: where a table loses the only key that the file gives it,
  /// another one says that the table is still there.
  std::vector<DesignKeyChange> written_out;
};
/// A design file's text with only the keys changed in which its design differs from another: comments, order and
/// layout stay. A key that is no longer written becomes a comment; new keys go to the end of their table.
/// Guarantees: the text reads back as `after`. Where a file is written so that this cannot be had (inline tables,
/// say), it is written anew, without its comments.
/// Errors: those of reading the text.
[[nodiscard]] ResultAll<EditedDesign> edited_design(std::string_view text, const std::string& file,
                                                    const GearboxDesign& after);
/// Its text alone.
[[nodiscard]] ResultAll<std::string> edited_design_text(std::string_view text, const std::string& file,
                                                        const GearboxDesign& after);

}  // namespace trueflank
