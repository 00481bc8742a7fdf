// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include "trueflank/loop/gear/observations.h"
#include "trueflank/loop/gear/table/effect_values.h"

namespace trueflank::loop {

/// A table that procedures on the same data share until one of them changes it: of a million points
/// a copy takes as much memory as all the rest.
class SharedTable {
 public:
  SharedTable(Observations table)  // NOLINT(google-explicit-constructor): it is a table
      : table_(std::make_shared<Observations>(std::move(table))) {}
  operator const Observations&() const { return *table_; }  // NOLINT(google-explicit-constructor)
  const Observations* operator->() const { return table_.get(); }
  /// To change it: nobody else's from now on.
  [[nodiscard]] Observations& own() {
    values_ = std::make_shared<EffectValues>();
    if (table_.use_count() > 1) table_ = std::make_shared<Observations>(*table_);
    return *table_;
  }
  /// The table itself, of its last owner without a copy.
  [[nodiscard]] Observations taken() && { return std::move(own()); }
  /// Values of effects at its rows, of one gear.
  [[nodiscard]] EffectValues& values() const { return *values_; }

 private:
  std::shared_ptr<Observations> table_;
  std::shared_ptr<EffectValues> values_ = std::make_shared<EffectValues>();
};

}  // namespace trueflank::loop
