// SPDX-License-Identifier: GPL-3.0-or-later
// Measures a gear that sits 30 um off its axis (the data are made here) and lets the loop find out.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/session/close_loop.h"

namespace {

/// Cumulative pitch of both flanks of an eccentric gear with 1 um of noise, as an inspection machine
/// writes it: deviation along the flank normal, both ends of the tooth.
void write_measurement(const trueflank::Gear& gear, const char* path) {
  using namespace trueflank;
  std::ofstream file(path);
  file << "# zero = common\nrecord,tooth,flank,diameter_mm,z_mm,deviation_um\n";
  const double alpha = transverse_pressure_angle_rad(gear);
  unsigned state = 1;
  for (int tooth = 1; tooth <= gear.teeth; ++tooth) {
    for (const int side : {1, -1}) {
      const double tooth_angle = kTwoPi * (tooth - 1) / gear.teeth;
      const double normal = tooth_angle + side * (tooth_half_angle_rad(gear, reference_radius_mm(gear)) +
                                                  0.5 * kPi - alpha);
      state = state * 1664525u + 1013904223u;
      const double noise_um = (state >> 8) / double(1 << 24) * 3.4 - 1.7;
      file << "index," << tooth << ',' << (side > 0 ? "left" : "right") << ','
           << 2.0 * reference_radius_mm(gear) << ",5," << 30.0 * std::cos(normal - 0.7) + noise_um
           << '\n';
    }
  }
}

}  // namespace

int main() {
  using namespace trueflank;
  GearboxDesign design{.name = "measured", .topology = train_topology("gear")};
  design.gears = {{.name = "gear", .teeth = 36, .shift = 0.0, .face_width_mm = 10.0}};
  const auto gearbox = Gearbox::of(design);
  if (!gearbox) return 2;
  write_measurement(gearbox->train().gears.front().profile.gear(), "inspection.csv");
  const auto closed = close_loop(*gearbox, {"inspection.csv"});
  if (!closed) {
    for (const Error& error : closed.error())
      std::fprintf(stderr, "%s:%d: %s\n", error.file.c_str(), error.line, error.message.c_str());
    return 2;
  }
  const loop::LoopResult& result = closed->result();
  std::printf("%s: rms %.1f um before, %.1f um after\n", to_text(result.verdict),
              result.before.rms, result.after.rms);
  for (const loop::FoundEffect& effect : result.effects) {
    std::printf("%s:", effect.id.c_str());
    for (const loop::Parameter& p : effect.parameters)
      std::printf(" %s %.2f (%.2f to %.2f)", p.name.c_str(), p.value, p.low, p.high);
    std::printf("\n");
  }
  return !result.effects.empty() && result.effects.front().id == "eccentricity" ? 0 : 1;
}
