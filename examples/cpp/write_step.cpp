// SPDX-License-Identifier: GPL-3.0-or-later
// A pair of gears as exact STEP, as STL within a micrometre, and its report as a page.
#include <cstdio>

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/session/make.h"

int main() {
  using namespace trueflank;
  GearboxDesign design{.name = "pair", .topology = train_topology("pair")};
  design.backlash_mm = 0.04;
  design.gears = {{.name = "pinion", .teeth = 17, .shift = 0.3}, {.name = "wheel", .teeth = 40}};
  const auto gearbox = Gearbox::of(design);
  if (!gearbox) return 2;
  const auto made = make_parts(
      *gearbox, {.folder = "parts", .formats = {"step", "stl"}, .tolerance_um = 1.0});
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().front().message.c_str());
    return 3;
  }
  for (const io::ReportedFile& file : made->report.files)
    std::printf("%-14s %8llu bytes\n", file.path.c_str(), (unsigned long long)file.bytes);
  return made->failed ? 1 : 0;
}
