// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/session/wished_sets.h"

#include <algorithm>

namespace trueflank {
namespace {

/// Small suns, and rings of which the teeth can still be printed.
WishedSets of_3k(const char* input, const char* output, double ratio_min, double ratio_max) {
  return {.kind = "3k",
          .input = input,
          .output = output,
          .ratio_min = ratio_min,
          .ratio_max = ratio_max,
          .sun = {12, 18},
          .planet1 = {20, 46},
          .planet2 = {20, 46},
          .ring = {60, 96}};
}

/// Few losses whatever the teeth: the strongest is the best. One layer alone has to hold the
/// planets' bearings.
WishedSets of_simple(const char* output, double ratio_min, double ratio_max) {
  return {.kind = "simple",
          .input = "sun",
          .output = output,
          .ratio_min = ratio_min,
          .ratio_max = ratio_max,
          .sun = {12, 45},
          .planet1 = {12, 42},
          .ring = {45, 99},
          .face_width_mm = 14.0,
          .objective = SearchObjective::kTorque};
}

WishedSets of_stepped(const char* output, double ratio_min, double ratio_max) {
  return {.kind = "stepped",
          .input = "sun",
          .output = output,
          .ratio_min = ratio_min,
          .ratio_max = ratio_max,
          .sun = {12, 20},
          .planet1 = {18, 48},
          .planet2 = {13, 27},
          .ring = {45, 84},
          .objective = SearchObjective::kTorque};
}

/// Both stages with the same choice of teeth: suns that stay whole, rings that can still be printed.
WishedSets of_two_stage() {
  return {.kind = "two-stage",
          .input = "sun1",
          .output = "carrier2",
          .ratio_min = 12.0,
          .ratio_max = 60.0,
          .sun = {12, 21},
          .planet1 = {15, 36},
          .planet2 = {15, 36},
          .ring = {48, 87}};
}

}  // namespace

const std::vector<WishedSets>& all_wished_sets() {
  static const std::vector<WishedSets> kAll{of_3k("sun", "ring2", 10.0, 1000.0),
                                            of_3k("sun", "ring1", 10.0, 1000.0),
                                            of_3k("carrier", "ring2", 5.0, 300.0),
                                            of_3k("carrier", "ring1", 5.0, 300.0),
                                            of_stepped("carrier", 5.0, 22.0),
                                            of_stepped("ring", 4.0, 21.0),
                                            of_simple("carrier", 2.6, 8.6),
                                            of_simple("ring", 1.6, 7.6),
                                            of_two_stage(),
                                            {.kind = "pair",
                                             .input = "pinion",
                                             .output = "wheel",
                                             .ratio_min = 1.1,
                                             .ratio_max = 8.0,
                                             .sun = {12, 30},
                                             .planet1 = {12, 96},
                                             .face_width_mm = 15.0,  // shafts end below the lid
                                             .objective = SearchObjective::kTorque}};
  return kAll;
}

const WishedSets* find_wished_sets(const std::string& kind, const std::string& input,
                                   const std::string& output) {
  const auto& all = all_wished_sets();
  const auto it = std::find_if(all.begin(), all.end(), [&](const WishedSets& sets) {
    return sets.kind == kind && (input.empty() || sets.input == input) &&
           (output.empty() || sets.output == output);
  });
  return it == all.end() ? nullptr : &*it;
}

}  // namespace trueflank
