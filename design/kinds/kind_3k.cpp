// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kNewDesign = R"(
[gearbox]
kind = "3k"                    # sun, planets of two layers, two rings: high ratios in one stage
output = "ring2"               # ring1 is fixed; "ring1" would fix ring2
planets = 3
module_mm = 1.0
centre_distance_mm = 27.41     # shifts that are left out are solved from it
friction = 0.1                 # of the tooth flanks, for the efficiency
backlash_mm = 0.05             # per mesh; 3D prints rather want 0.1 to 0.2
layer_gap_mm = 1.0             # between the two layers

[sun]
teeth = 15
face_width_mm = 12.0
bore_mm = 5.0                  # motor shaft ...
bore_d_flat_mm = 4.5           # ... with a flat; or bore_hex_mm, or a keyway

[planet1]                      # one body with planet2
teeth = 39
face_width_mm = 12.0
bore_mm = 10.0                 # through the whole planet

[ring1]
teeth = 93
shift = 0.67                   # profile shift in modules; positive moves a ring's teeth outwards
face_width_mm = 12.0
outer_diameter_mm = 114.0
# bolt_circle_diameter_mm = 105.5
# bolt_count = 8
# bolt_hole_diameter_mm = 4.5

[planet2]
teeth = 32
face_width_mm = 12.0

[ring2]
teeth = 86
shift = 0.65
face_width_mm = 12.0
outer_diameter_mm = 108.0
)";

/// Type I drives ring2 out and holds ring1, type II the other way round. Driven at the carrier it is the
/// split-ring set (Wolfrom's): no power goes through the sun, which may be left out.
Topology topology(std::string_view output, std::string_view input) {
  enum { kSun, kPlanet, kCarrier, kRing1, kRing2 };
  const bool type2 = output == "ring1", split_ring = input == "carrier";
  return {.kind = "3k",
          .axes = {{}, {.carrier = kCarrier}},
          .members = {{"sun"}, {"planet", 1}, {"carrier"}, {"ring1"}, {"ring2"}},
          .gears = {{"sun", kSun, 1, GearForm::kExternal, split_ring},
                    {"planet1", kPlanet},
                    {"ring1", kRing1, 1, GearForm::kRing},
                    {"planet2", kPlanet, 2},
                    {"ring2", kRing2, 2, GearForm::kRing}},
          .meshes = {{0, 1}, {1, 2}, {3, 4}},
          .fixed = {type2 ? kRing2 : kRing1},
          .input = split_ring ? kCarrier : kSun,
          .output = type2 ? kRing1 : kRing2};
}

}  // namespace

TrainKind kind_3k() {
  return {.name = "3k",
          .meaning = "sun, two rings and compound planets",
          .output_meaning = "ring2 (type I, ring1 is fixed) or ring1 (type II, ring2 is fixed)",
          .outputs = {"ring2", "ring1"},
          .output_required = true,
          .inputs = {"sun", "carrier"},
          .input_meaning = "sun, or carrier: the split-ring set, whose sun is optional and idles",
          .topology = &topology,
          .new_design = kNewDesign};
}

}  // namespace trueflank
