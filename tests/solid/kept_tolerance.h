// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "tests/support/random_designs.h"
#include "trueflank/base/contract.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/solid/measure/measured_mesh.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank::test {

/// Meshes every part of so many random designs that can be laid out, each to a random tolerance. A
/// part that misses it is printed with its design file.
inline void expect_tolerance_kept(std::uint64_t seed, int designs) {
  RandomDesigns random(seed);
  int laid_out = 0, parts = 0, again = 0;
  for (int tried = 0; laid_out < designs; ++tried) {
    ASSERT_LT(tried, 20 * designs) << "hardly any of these designs can be laid out";
    const GearboxDesign design = random.next();
    const double tolerance_mm = random.log_between(2e-4, 2e-2) * design.module_mm;
    const auto train = lay_out(design);
    if (!train) continue;
    const auto shapes = part_shapes(*train);
    if (!shapes) continue;
    ++laid_out;
    for (const PartShape& part : shapes->parts) {
      MeasuredMesh made;
      try {
        made = measured_part_mesh(part, {.tolerance_mm = tolerance_mm});
      } catch (const ContractViolation& broken) {
        ADD_FAILURE() << broken.what() << "\n" << part.name << " at " << tolerance_mm << " mm of\n"
                      << design_file_text(design);
        continue;
      }
      ++parts;
      if (made.part.chord_error_mm < 0.9 * meshing_tolerance_mm(part, tolerance_mm)) ++again;
      EXPECT_LE(made.accuracy_mm, tolerance_mm) << part.name << " of\n" << design_file_text(design);
    }
  }
  std::printf("%d designs, %d parts, %d finer than the mesher's first\n", laid_out, parts, again);
}

}  // namespace trueflank::test
