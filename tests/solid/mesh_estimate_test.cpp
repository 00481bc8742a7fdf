// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/mesh_estimate.h"

#include <gtest/gtest.h>

#include "tests/support/random_designs.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/solid/mesh/gear_mesh.h"

namespace trueflank {
namespace {

TEST(MeshEstimate, IsWithinAFactorOfThreeOfWhatIsMeshed) {
  test::RandomDesigns random(7);
  int parts = 0;
  while (parts < 120) {
    const GearboxDesign design = random.next();
    const double tolerance_mm = random.log_between(3e-4, 1e-2) * design.module_mm;
    const auto train = lay_out(design);
    if (!train) continue;
    const auto shapes = part_shapes(*train);
    if (!shapes) continue;
    for (const PartShape& part : shapes->parts) {
      const auto facets = static_cast<double>(
          part_mesh(part, {.tolerance_mm = tolerance_mm}).mesh.triangles.size());
      if (facets < 1000.0) continue;
      const double ratio = estimated_facets(part, tolerance_mm) / facets;
      EXPECT_GT(ratio, 1.0 / 3.0) << part.name << " of " << facets << " facets, tolerance "
                            << tolerance_mm << "\n"
                            << design_file_text(design);
      EXPECT_LT(ratio, 3.0) << part.name << " of " << facets << " facets, tolerance "
                            << tolerance_mm << "\n"
                            << design_file_text(design);
      ++parts;
    }
  }
}

}  // namespace
}  // namespace trueflank
