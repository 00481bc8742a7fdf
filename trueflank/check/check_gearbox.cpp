// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/check_gearbox.h"

#include <iterator>

#include "trueflank/check/assembly.h"
#include "trueflank/check/axial.h"
#include "trueflank/check/backlash.h"
#include "trueflank/check/centre_distance.h"
#include "trueflank/check/contact_ratio.h"
#include "trueflank/check/planet_spacing.h"
#include "trueflank/check/profile.h"
#include "trueflank/check/tip_clearance.h"
#include "trueflank/check/tip_thickness.h"
#include "trueflank/check/undercut.h"

namespace trueflank {

Findings check_gearbox(const GearTrain& train) {
  Findings all;
  for (const auto check :
       {check_profile, check_undercut, check_tip_thickness, check_centre_distance, check_backlash,
        check_tip_clearance, check_contact_ratio, check_assembly, check_planet_spacing,
        check_axial}) {
    Findings some = check(train);
    all.insert(all.end(), std::make_move_iterator(some.begin()),
               std::make_move_iterator(some.end()));
  }
  return all;
}

}  // namespace trueflank
