// SPDX-License-Identifier: GPL-3.0-or-later
// Traces that share one zero, of which each stands a little higher than the one before it.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/drift_of_traces.h"
#include "trueflank/loop/gear/effects/registry.h"

namespace trueflank::loop::gear_effects {
namespace {

/// As which tooth one comes, from 0 on; between two of them in between.
double tooth_in_turn(const FlankGeometry& geometry, const EffectShape& shape, int tooth) {
  const int since = teeth_since(geometry, tooth, shape[kTeethInTurn]);
  int before = 0;
  for (std::size_t k = kTeethInTurn + 1; k < shape.size(); ++k) {
    const int next = teeth_since(geometry, static_cast<int>(shape[k]), shape[kTeethInTurn]);
    if (since < next)
      return static_cast<double>(k - kTeethInTurn - 1) +
             static_cast<double>(since - before) / (next - before);
    before = next;
  }
  return static_cast<double>(shape.size() - kTeethInTurn - 1);
}

std::string words_of_drift(const ToldForm& told) {
  const EffectShape& shape = told.shape;
  const int sign = told.sign(), flanks = static_cast<int>(shape[kFlanksInTurn]);
  return std::string("from trace to trace, in the order of the teeth, the height drifts") +
         (shape[kDriftWithin] == 0.0 ? " evenly" : " and levels off") +
         (sign == 0  ? ""
          : sign > 0 ? ", towards more material"
                     : ", towards less material") +
         printed(", from tooth %.0f", shape[kTeethInTurn]) +
         printed(" to tooth %.0f", shape.back()) +
         (shape[kZeroOfTraces] == kFirstOfDrift  ? ", from nothing on the first trace"
          : shape[kZeroOfTraces] == kLastOfDrift ? ", to nothing on the last trace"
                                                 : "") +
         (flanks == kLeftOfEachFirst    ? ", of each tooth the left flank first"
          : flanks == kRightOfEachFirst ? ", of each tooth the right flank first"
          : flanks == kAllLeftFirst     ? ", all left flanks first"
          : flanks == kAllRightFirst    ? ", all right flanks first"
                                        : "") +
         ", as where part or machine warms up while it is measured; measure the first tooth again";
}

}  // namespace

double drift_at_trace(double trace, double traces, double within) {
  const double share = trace / (traces - 1.0);
  return within == 0.0 ? share : std::expm1(-share / within) / std::expm1(-1.0 / within);
}

double trace_in_turn(int flanks, double tooth, double teeth, bool left) {
  switch (flanks) {
    case kLeftOfEachFirst:
    case kRightOfEachFirst:
      return 2.0 * tooth + (left == (flanks == kLeftOfEachFirst) ? 0.0 : 1.0);
    case kAllLeftFirst:
    case kAllRightFirst:
      return tooth + (left == (flanks == kAllLeftFirst) ? 0.0 : teeth);
    default:
      return tooth;
  }
}

double traces_in_turn(int flanks, double teeth) { return flanks == kAlike ? teeth : 2.0 * teeth; }

EffectFamily unnamed_drift_of_traces() {
  EffectFamily f =
      described("unnamed_drift_of_traces", {"flanks_in_turn", "within_share", "zero_at", "teeth"});
  f.is_drift = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const int flanks = static_cast<int>(shape[kFlanksInTurn]);
    const auto teeth = static_cast<double>(shape.size() - kTeethInTurn);
    const double traces = traces_in_turn(flanks, teeth), within = shape[kDriftWithin];
    double zero = 0.0;
    if (shape[kZeroOfTraces] == kLastOfDrift) zero = 1.0;
    if (shape[kZeroOfTraces] == kMeanOfDrift)
      for (double trace = 0.0; trace < traces; ++trace)
        zero += drift_at_trace(trace, traces, within) / traces;
    const double trace = trace_in_turn(flanks, tooth_in_turn(g, shape, p.tooth), teeth,
                                       flank_of(g, p) == FlankChoice::kLeft);
    c[0] = drift_at_trace(std::min(trace, traces - 1.0), traces, within) - zero;
  };
  f.values_sought = [](const EffectShape& shape) { return shape[kDriftWithin] != 0.0 ? 1 : 0; };
  f.term_keys = {
      {"flanks_in_turn",
       TermKey::Kind::kWord,
       {"alike", "left_of_each_first", "right_of_each_first", "all_left_first", "all_right_first"}},
      number("within_share"),
      {"zero_at", TermKey::Kind::kWord, {"mean", "first_trace", "last_trace"}},
      {"teeth", TermKey::Kind::kNumbers}};
  f.words = words_of_drift;
  return f;
}

}  // namespace trueflank::loop::gear_effects
