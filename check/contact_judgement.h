// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/train/gear_train.h"

// A quick judge of many designs, for the joint cure: the figures of the checks without their words and cures.
namespace trueflank {

/// One complaint about a design.
struct Complaint {
  std::string id;        ///< of the check
  int layer = 0;         ///< 0: the train
  double lacking = 0.0;  ///< of what the check wants, in modules or as a ratio; > 0
  bool fails = false;    ///< else it warns
};

struct Judgement {
  std::vector<Complaint> complaints;
  [[nodiscard]] double failing() const;  ///< sum of what fails, 1 and more each; 0: nothing fails
  [[nodiscard]] double worrying() const; ///< sum of what warns
  [[nodiscard]] bool clean() const { return complaints.empty(); }
};

/// Turns meshes, and remembers those it has turned.
class ContactJudge {
 public:
  /// What needs no turning: centre_distance, backlash, tip_clearance, contact_ratio, fillet_interference,
  /// planet_spacing, axial, assembly by closed form. `layer`: 0 for all.
  [[nodiscard]] static Judgement without_turning(const GearTrain& train, int layer = 0);

  /// overlap and corner_contact of the meshes of a layer.
  [[nodiscard]] Judgement by_turning(const GearTrain& train, int layer = 0);

  /// Clearances of a mesh, centred and driving (that of zero backlash is the centred one).
  struct Clearances {
    double centred_mm = kNaN, driving_mm = kNaN;
    bool tip_of_gear1 = true;  ///< whose tip is in the way, where one is
  };
  [[nodiscard]] const Clearances& clearances(const GearTrain& train, const TrainMesh& mesh);

  [[nodiscard]] int turned() const { return turned_; }

 private:
  std::unordered_map<std::string, Clearances> known_;
  int turned_ = 0;
};

[[nodiscard]] int layer_of(const GearTrain& train, const TrainMesh& mesh);

}  // namespace trueflank
