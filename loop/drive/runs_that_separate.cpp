// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "trueflank/loop/drive/found_drive_effects.h"
#include "trueflank/loop/result/describe.h"

// What to measure next.
namespace trueflank::loop {

namespace {

/// The run that tells losses and readings apart where no effect knows a better one: of what this
/// bench lacks.
std::string what_the_bench_lacks(const BenchTable& table) {
  std::string lacking;
  const auto add = [&](bool lacks, const char* what) {
    if (lacks) lacking += std::string(lacking.empty() ? "" : ", ") + what;
  };
  add(!table.has(true) || !table.has(false), "the other direction too");
  add(table.levels[0] < 4, "more loads");
  add(table.levels[1] < 4, "more speeds");
  return lacking.empty() ? "the same set points several times more, in shuffled order" : lacking;
}

}  // namespace

std::vector<std::string> runs_that_separate(const BenchTable& table,
                                            const std::vector<FoundEffect>& effects) {
  std::vector<std::string> runs;
  const auto say = [&](const std::string& sentence) { say_once(runs, sentence); };
  if (table.impossible == Impossible::kEfficiencyAboveOne)
    say("before any loss is read from these data: a run without the gearbox (or with the roles of "
        "the two "
        "sides swapped), and each torque against a lever and weights, to separate torque_scale and "
        "torque_offset from friction");
  ToldApart told;
  for (const FoundEffect& found : effects)
    for (const std::string& other : found.confounded_with)
      told.add(found.named ? found.id : "what has no name here", other,
               measurement_between(found.id, find_drive_family(found.id), other,
                                   find_drive_family(other), what_the_bench_lacks(table)));
  told.say(runs, "run");
  if (!table.has(true) || !table.has(false))
    say("only one direction was run: the other separates torque scale and offset from friction and "
        "drag");
  if (!(table.most_speed_rpm > 1.5 * table.least_speed_rpm))
    say("the speed hardly changes: a speed sweep separates drag, viscous, bearing and Stribeck "
        "losses");
  if (!table.has_temperature)
    say("log temperature_c: without it the lubricant's thinning is not seen");
  if (!table.has_angle)
    say("log input_angle_deg, counting on over many turns: without it no eccentric member is seen");
  return runs;
}

}  // namespace trueflank::loop
