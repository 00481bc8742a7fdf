// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/check/finding.h"
#include "trueflank/train/gear_train.h"

// What the checks of meshes share.
namespace trueflank {

[[nodiscard]] inline const std::string& gear1_name(const GearTrain& train, const TrainMesh& mesh) {
  return train.gears[static_cast<std::size_t>(mesh.gear1)].name;
}
[[nodiscard]] inline const std::string& gear2_name(const GearTrain& train, const TrainMesh& mesh) {
  return train.gears[static_cast<std::size_t>(mesh.gear2)].name;
}

/// One finding a mesh; one `not_applicable` of the train where it has no mesh.
template <class Judge>
[[nodiscard]] Findings for_each_mesh(const GearTrain& train, const char* id, const Judge& judge) {
  Findings findings;
  for (const TrainMesh& mesh : train.meshes) findings.push_back(judge(train, mesh));
  if (findings.empty())
    findings.push_back({.id = id,
                        .where = "train",
                        .status = CheckStatus::kNotApplicable,
                        .message = "a single gear has no mate"});
  return findings;
}

}  // namespace trueflank
