// SPDX-License-Identifier: GPL-3.0-or-later
// What is bought and made, and how it lies on the printer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/check/machine_designs.h"
#include "trueflank/solid/measure/bill_of_materials.h"
#include "trueflank/solid/measure/mass_properties.h"
#include "trueflank/solid/shape/machine/print_plates.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank {
namespace {

TEST(BillOfMaterials, CountsEveryBodyOnce) {
  const Made made(k3k + kMachine);
  const BillOfMaterials bill = bill_of_materials(made.shapes, [](const PartShape&) {
    return PartMaterial{"pla", 1000.0};
  });
  int count = 0;
  double mass_g = 0.0;
  for (const BillLine& line : bill) {
    count += line.count;
    if (!std::isnan(line.mass_g)) mass_g += line.mass_g * line.count;
  }
  EXPECT_EQ(count, static_cast<int>(made.shapes.assembly.size()));
  double volume = 0.0;
  for (const Placement& body : made.shapes.assembly)
    if (const PartShape& part = made.shapes.parts[static_cast<std::size_t>(body.part)];
        part.bought.empty())
      volume += mass_properties(part, 1.0).volume_mm3;
  EXPECT_NEAR(mass_g, 1e-3 * volume, 1e-6 * volume);
  const std::string csv = bill_csv(bill);
  EXPECT_NE(csv.find(",\"ISO 4762 M3x30\",3,,,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",\"ball bearing 625 (5x16x5)\",6,,,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nplanet,,3,pla,"), std::string::npos) << csv;
}

TEST(PrintPlates, HoldEveryPartThatIsMadeWithoutOverlap) {
  const Made made(k3k + kMachine);
  for (const Bed& bed : standard_beds()) {
    const auto plates = print_plates(made.shapes, bed);
    ASSERT_TRUE(plates) << bed.name;
    std::size_t count = 0;
    for (const PrintPlate& plate : *plates) {
      count += plate.size();
      const auto reach = [&](const PrintedPart& p) {
        double r = 0.0;
        for (const Slab& slab : made.shapes.parts[static_cast<std::size_t>(p.part)].slabs)
          r = std::max(r, extent(slab.outer).outer_radius_mm);
        return r;
      };
      for (std::size_t i = 0; i < plate.size(); ++i) {
        const double r = reach(plate[i]);
        EXPECT_GE(plate[i].at_mm.x() - r, -1e-9);
        EXPECT_LE(plate[i].at_mm.x() + r, bed.width_mm + 1e-9);
        EXPECT_GE(plate[i].at_mm.y() - r, -1e-9);
        EXPECT_LE(plate[i].at_mm.y() + r, bed.depth_mm + 1e-9);
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GE((plate[i].at_mm - plate[j].at_mm).norm(), r + reach(plate[j]) + 4.999);
      }
    }
    const auto is_made = [&](const Placement& p) {
      return made.shapes.parts[static_cast<std::size_t>(p.part)].bought.empty();
    };
    EXPECT_EQ(count, static_cast<std::size_t>(std::count_if(made.shapes.assembly.begin(),
                                                            made.shapes.assembly.end(), is_made)));
  }
  const auto small = print_plates(made.shapes, *find_bed("60x60"));
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().key, "made.bed");
}

/// What hangs over at the bed's side: a part the right way up widens nowhere by more than a ledge.
TEST(PrintPlates, PartsLieTheRightWayUp) {
  for (const std::string& text : {k3k + kMachine, large_sun(), held_carrier(large_sun()),
                                  kPair + kBox, kRingPair + kRingBox}) {
    const Made made(text);
    for (const PartShape& part : made.shapes.parts) {
      if (!part.bought.empty()) continue;
      std::vector<Slab> slabs = part.slabs;
      if (part.upside_down) std::reverse(slabs.begin(), slabs.end());
      for (std::size_t i = 1; i < slabs.size(); ++i) {
        const double widened =
            extent(slabs[i].outer).inner_radius_mm - extent(slabs[i - 1].outer).outer_radius_mm;
        EXPECT_LE(widened, 0.5) << part.name << " slab " << i;
      }
    }
  }
}

}  // namespace
}  // namespace trueflank
