// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/check_gearbox.h"

#include <iterator>

#include "trueflank/check/assembly.h"
#include "trueflank/check/axial.h"
#include "trueflank/check/backlash.h"
#include "trueflank/check/centre_distance.h"
#include "trueflank/check/clearance/overlap.h"
#include "trueflank/check/contact_ratio.h"
#include "trueflank/check/corner_contact.h"
#include "trueflank/check/design_tolerances.h"
#include "trueflank/check/fillet_interference.h"
#include "trueflank/check/involute_interference.h"
#include "trueflank/check/manufacturability.h"
#include "trueflank/check/planet_spacing.h"
#include "trueflank/check/profile.h"
#include "trueflank/check/tip_clearance.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/check/trimming_interference.h"
#include "trueflank/check/trochoid_interference.h"
#include "trueflank/check/undercut.h"

namespace trueflank {
namespace {

/// One of the checks; of meshes, some need their states, which are found once for all of them.
struct Check {
  Findings (*of_train)(const GearTrain&) = nullptr;
  Findings (*of_meshes)(const GearTrain&, const std::vector<MeshState>&) = nullptr;
  bool across_stages = false;  ///< judges all stages as one; the others judge each by itself

  [[nodiscard]] Findings operator()(const GearTrain& train, const std::vector<MeshState>& states) const {
    return of_train != nullptr ? of_train(train) : of_meshes(train, states);
  }
};

/// In the order of the report.
constexpr Check kChecks[] = {
    {.of_train = check_profile},
    {.of_train = check_undercut},
    {.of_train = check_tip_thickness},
    {.of_train = check_centre_distance},
    {.of_train = check_backlash},
    {.of_train = check_tip_clearance},
    {.of_train = check_contact_ratio},
    {.of_meshes = check_overlap},
    {.of_meshes = check_corner_contact},
    {.of_meshes = check_fillet_interference},
    {.of_meshes = check_involute_interference},
    {.of_meshes = check_trochoid_interference},
    {.of_meshes = check_trimming_interference},
    {.of_meshes = check_assembly},
    {.of_train = check_planet_spacing},
    {.of_train = check_axial, .across_stages = true},
    {.of_train = check_manufacturability},
    {.of_train = check_design_tolerance},
};

void append(Findings& all, Findings some) {
  all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
}

/// What a stage's finding is of in the whole train.
Findings of_stage(Findings findings, std::size_t stage) {
  for (Finding& finding : findings)
    if (finding.where == "train") finding.where = "stage" + std::to_string(stage + 1);
  return findings;
}

/// One check of every stage, first stage first.
Findings of_every_stage(const Check& check, const GearTrain& train, const std::vector<MeshState>& states) {
  Findings all;
  auto first = states.begin();
  for (std::size_t s = 0; s < train.stages.size(); ++s) {
    const auto last = first + static_cast<std::ptrdiff_t>(train.stages[s].meshes.size());
    append(all, of_stage(check(train.stages[s], {first, last}), s));
    first = last;
  }
  return all;
}

}  // namespace

Findings check_gearbox(const GearTrain& train) { return check_gearbox(train, mesh_states(train)); }

Findings check_gearbox(const GearTrain& train, const std::vector<MeshState>& states) {
  Findings all;
  for (const Check& check : kChecks)
    append(all, train.stages.empty() || check.across_stages ? check(train, states)
                                                            : of_every_stage(check, train, states));
  return all;
}

}  // namespace trueflank
