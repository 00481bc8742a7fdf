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

void append(Findings& all, Findings some) {
  all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
}

/// What a stage's finding is of in the whole train.
Findings of_stage(Findings findings, std::size_t stage) {
  for (Finding& finding : findings)
    if (finding.where == "train") finding.where = "stage" + std::to_string(stage + 1);
  return findings;
}

/// The stages one after another, check by check; across them only heights matter.
Findings check_stages(const GearTrain& train, const std::vector<MeshState>& states) {
  std::vector<Findings> each;
  auto first = states.begin();
  for (const GearTrain& stage : train.stages) {
    const auto last = first + static_cast<std::ptrdiff_t>(stage.meshes.size());
    each.push_back(of_stage(check_gearbox(stage, {first, last}), each.size()));
    first = last;
  }
  Findings all;
  std::vector<std::size_t> done(each.size(), 0);
  while (done[0] < each[0].size()) {
    const std::string id = each[0][done[0]].id;
    for (std::size_t s = 0; s < each.size(); ++s)
      for (; done[s] < each[s].size() && each[s][done[s]].id == id; ++done[s])
        if (id != "axial") all.push_back(each[s][done[s]]);
    if (id == "axial") append(all, check_axial(train));
  }
  return all;
}

}  // namespace

Findings check_gearbox(const GearTrain& train) { return check_gearbox(train, mesh_states(train)); }

Findings check_gearbox(const GearTrain& train, const std::vector<MeshState>& states) {
  if (!train.stages.empty()) return check_stages(train, states);
  Findings all;
  for (const auto check :
       {check_profile, check_undercut, check_tip_thickness, check_centre_distance, check_backlash,
        check_tip_clearance, check_contact_ratio})
    append(all, check(train));
  for (const auto check : {check_overlap, check_corner_contact, check_fillet_interference, check_involute_interference,
                           check_trochoid_interference, check_trimming_interference,
                           check_assembly})
    append(all, check(train, states));
  for (const auto check : {check_planet_spacing, check_axial, check_manufacturability, check_design_tolerance})
    append(all, check(train));
  return all;
}

}  // namespace trueflank
