// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/carrier.h"

namespace trueflank {

/// A part as a maker thinks of it: pieces one upon the other, and holes of any depth in them.
/// Heights are the assembly's z.
class StackedBody {
 public:
  void add(const HeightRange& z, const Outline& outer);
  /// What of the hole lies in the body is taken away; a hole inside a wider one is not seen.
  void drill(const HeightRange& z, const Outline& hole);
  /// Pieces and holes of a part whose lower face stands at a height.
  void add(const std::vector<Slab>& slabs, double z_mm);

  /// What lies between two heights, each inside the body or at its end.
  [[nodiscard]] StackedBody between(const HeightRange& z) const;

  [[nodiscard]] HeightRange heights() const;
  /// The slabs, bottom at 0.
  [[nodiscard]] std::vector<Slab> slabs() const;

 private:
  struct Piece {
    HeightRange z;
    Outline outline;
  };
  std::vector<Piece> pieces_, holes_;
};

}  // namespace trueflank
