// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

struct JointCureOptions {
  int most_designs = 4000;  ///< laid out at most
  int most_turned = 400;    ///< meshes turned at most
  int most_judged = 60;     ///< asked at most what of the change is needed
  bool farther = true;      ///< where nothing near passes: another rack, then many more teeth (farther_designs.h)
};

/// What a check of a failing design may take: about a second, some seconds where flanks are modified
/// (their meshes are turned at several heights). The change it finds is the smallest where the search
/// ended, and verified in any case.
inline constexpr JointCureOptions kCheckSearch{
    .most_designs = 1500, .most_turned = 120, .most_judged = 40, .farther = false};
inline constexpr JointCureOptions kCheckSearchOfModified{
    .most_designs = 1500, .most_turned = 120, .most_judged = 15, .farther = false};

/// Findings about what stands around the gears (a housing); nothing where its parts cannot be made.
using AroundGears = std::function<std::optional<Findings>(const GearTrain&)>;

/// One change after which every check passes.
struct JointCure {
  GearboxDesign design;      ///< the cured one; where there is none, the nearest that was found
  Findings findings;         ///< of every check of that design
  bool changed = false;
  bool search_ended = true;  ///< false: the options' limits stopped it; a longer search may find a smaller change
  /// In words, where a check still fails: what contradicts what.
  std::string conflict;

  [[nodiscard]] bool cured() const { return verdict(findings) != CheckStatus::kFail; }
};

/// The smallest change found of tips, shifts, centre distance, backlash, root rounding, tooth depth
/// and, last, teeth and number of planets, after which no check fails, nothing about the contact
/// warns (corner_contact, fillet_interference, tip_clearance, contact_ratio) where that can be had,
/// and nothing else warns that did not before. The result has been judged by check_gearbox(). Every
/// key that was changed is needed: with it as before something would fail or warn that does not
/// (needed_changes.h). What is changed together, by size: tips 1 a module, shifts 1, centre
/// distance 1.2 a module, backlash 2 a module, root rounding and addendum 1.5, a tooth 2.3 and
/// more, a planet 2. Guarantees: never a design with more failing checks than the one given, and no
/// check fails that passed before. Not guaranteed: that no smaller change exists, nor that one is
/// found where it does.
[[nodiscard]] JointCure joint_cure(const GearTrain& train, const JointCureOptions& options = {});
/// The same where every check of the train has been asked already, with those of `around` it too.
[[nodiscard]] JointCure joint_cure(const GearTrain& train, const Findings& findings,
                                   const JointCureOptions& options, const AroundGears& around = {});

}  // namespace trueflank
