// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many more random designs than measured_mesh_test.cpp has time for. TRUEFLANK_DESIGNS and
// TRUEFLANK_SEED ask for others, TRUEFLANK_SMALL_DESIGNS for more of those with few teeth.
#include <algorithm>
#include <cstdlib>

#include "tests/solid/kept_tolerance.h"
#include "tests/support/sampled_deviation.h"
#include "tests/support/survey_size.h"
#include "trueflank/solid/measure/mesh_validity.h"

namespace trueflank {
namespace {

std::uint64_t asked(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(KeptTolerance, ByEveryPartOfRandomDesigns) {
  test::expect_tolerance_kept(
      asked("TRUEFLANK_SEED", 20),
      static_cast<int>(asked("TRUEFLANK_DESIGNS", test::survey_size(15, 500))));
}

/// The other measure knows nothing of the program's own: it walks on the surface.
TEST(KeptTolerance, ByPartsOfManySmallDesignsAsAnotherMeasureSeesThem) {
  const std::uint64_t seed = asked("TRUEFLANK_SEED", 20);
  const auto designs =
      static_cast<int>(asked("TRUEFLANK_SMALL_DESIGNS", test::survey_size(30, 100)));
  test::RandomDesigns random(seed, test::RandomDesigns::Size::kSmall);
  int parts = 0, walked = 0, tried = 0;
  double nearest = 0.0;
  for (int laid_out = 0; laid_out < designs; ++tried) {
    ASSERT_LT(tried, 50 * designs + 1000) << "hardly any of these designs can be laid out";
    const GearboxDesign design = random.next();
    const double tolerance_mm = random.log_between(5e-4, 5e-2) * design.module_mm;
    const auto train = lay_out(design);
    if (!train) continue;
    const auto shapes = part_shapes(*train);
    if (!shapes) continue;
    ++laid_out;
    for (const PartShape& part : shapes->parts) {
      const std::string where = part.name + ", design " + std::to_string(tried) + " of seed " + std::to_string(seed) +
                                ", tolerance " + std::to_string(tolerance_mm) + " mm:\n" + design_file_text(design);
      MeasuredMesh made;
      try {
        made = measured_part_mesh(part, {.tolerance_mm = tolerance_mm});
      } catch (const ContractViolation& broken) {
        ADD_FAILURE() << broken.what() << " " << where;
        continue;
      }
      ++parts;
      EXPECT_LE(made.accuracy_mm, tolerance_mm) << where;
      EXPECT_TRUE(mesh_validity(made.part.mesh).valid()) << where;
      constexpr int kPlaces = 60;
      const auto seen = test::sampled_deviation(made.part.mesh, part, kPlaces, random.whole(0, 1 << 30), tolerance_mm);
      if (!seen) continue;
      ++walked;
      nearest = std::max(nearest, seen->surface_to_facets_mm / tolerance_mm);
      EXPECT_LE(seen->largest_mm(), tolerance_mm)
          << "facets " << seen->facets_to_surface_mm << ", surface " << seen->surface_to_facets_mm << ", measured "
          << made.accuracy_mm << " at " << seen->worst_place_mm[0] << " " << seen->worst_place_mm[1] << " "
          << seen->worst_place_mm[2] << " " << where;
    }
  }
  std::printf("%d designs of %d, %d parts, %d seen by both measures; nearest to its tolerance: %.3f of it\n", designs,
              tried, parts, walked, nearest);
}

}  // namespace
}  // namespace trueflank
