// SPDX-License-Identifier: GPL-3.0-or-later
// A pair of gears as exact STEP, as STL within a micrometre, and its report as a page.
#include <cstdio>

#include "trueflank/check/check_gearbox.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/export_parts.h"
#include "trueflank/export/report_html.h"

int main() {
  using namespace trueflank;
  GearboxDesign design{.name = "pair", .kind = TrainKind::kPair, .output = OutputMember::kWheel};
  design.backlash_mm = 0.04;
  design.gears = {{.name = "pinion", .teeth = 17, .shift = 0.3}, {.name = "wheel", .teeth = 40}};
  const auto train = lay_out(design);
  if (!train) return 2;
  const auto shapes = part_shapes(*train);
  if (!shapes) return 2;
  const auto files = io::export_parts({.train = &*train, .shapes = &*shapes},
                                      {.folder = "parts",
                                       .formats = {io::FileFormat::kStep, io::FileFormat::kStl},
                                       .tolerance_mm = 0.001});
  if (!files) {
    std::fprintf(stderr, "%s\n", files.error().front().message.c_str());
    return 3;
  }
  for (const io::ReportedFile& file : *files)
    std::printf("%-14s %8llu bytes\n", file.path.c_str(), (unsigned long long)file.bytes);
  const io::Report report{.train = &*train,
                          .findings = check_gearbox(*train),
                          .efficiency = efficiency(*train),
                          .files = *files};
  const auto written =
      io::write_file("parts/report.html", io::report_html(report, {.shapes = &*shapes}));
  return written ? 0 : 3;
}
