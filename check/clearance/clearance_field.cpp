// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/check/clearance/clearance_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueflank/base/tolerance.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank {
namespace {

constexpr double kPlane_mm = 1e-5;  // so little off the plane of a cell is no matter beside any tolerance

bool jams(double clearance_mm) { return clearance_mm < -tolerance::kTouch_mm; }

/// The same with modified flanks: the modifications go with the flanks, and the sections decide.
ChangedPair changed_modified(const GearTrain& train, const TrainMesh& mesh, const GearPair& pair) {
  GearTrain other = train;
  other.gears[static_cast<std::size_t>(mesh.gear1)].profile = *pair.profile1;
  other.gears[static_cast<std::size_t>(mesh.gear2)].profile = *pair.profile2;
  TrainMesh changed = mesh;
  changed.centre_distance_mm = pair.centre_distance_mm;
  changed.backlash_mm = circumferential_backlash_mm(pair);
  return {modified_mesh(other, changed).backlash_mm, modified_clearance_mm(other, changed)};
}

Result<ChangedPair> changed(const GearTrain& train, const TrainMesh& mesh, double distance_mm,
                            double thickness1_mm, double thickness2_mm) {
  const GearPair pair = train.pair(mesh);
  Gear gear1 = pair.gear1(), gear2 = pair.gear2();
  gear1.thinning_mm -= thickness1_mm;
  gear2.thinning_mm -= thickness2_mm;
  const auto profile1 = ToothProfile::make(gear1), profile2 = ToothProfile::make(gear2);
  if (!profile1) return fail(profile1.error());
  if (!profile2) return fail(profile2.error());
  const GearPair other{&*profile1, &*profile2, pair.centre_distance_mm + distance_mm};
  if (std::isnan(working_pressure_angle_rad(other)))
    return fail({.code = ErrorCode::kOutOfRange,
                 .message = "at centre distance " + mm_text(other.centre_distance_mm) +
                            " the teeth no longer mesh",
                 .remedy = "a smaller tolerance of the centre distance"});
  if (is_modified(train, mesh)) return changed_modified(train, mesh, other);
  return ChangedPair{circumferential_backlash_mm(other), sweep_clearance_mm(other)};
}

}  // namespace

Result<ClearanceField> ClearanceField::make(const GearTrain& train, const TrainMesh& mesh,
                                            const GearSpread& spread1, const GearSpread& spread2,
                                            double distance_mm) {
  ClearanceField field(train, mesh);
  field.distance_mm_ = distance_mm + spread1.eccentricity_mm + spread2.eccentricity_mm;
  field.thickness1_mm_ = spread1.thickness_mm + spread1.pitch_mm;
  field.thickness2_mm_ = spread2.thickness_mm + spread2.pitch_mm;
  constexpr int kStep = kSteps / (kPlaces - 1);
  for (int i = 0; i <= kSteps; i += kStep)
    for (int k = 0; k <= kSteps; k += kStep) {
      Place& place = field.place(i, k);
      if (place) continue;
      const auto pair = field.turned(i, k);
      if (!pair) return fail(pair.error());
      place = *pair;
    }
  return field;
}

const ChangedPair& ClearanceField::at(int distance_place, int thickness_place) const {
  constexpr int kStep = kSteps / (kPlaces - 1);
  return *place(kStep * distance_place, kStep * thickness_place);
}

/// Without a width all places of a direction are one.
const ClearanceField::Place& ClearanceField::place(int distance, int thickness) const {
  const int i = distance_mm_ > 0.0 ? distance : kSteps / 2;
  const int k = thickness1_mm_ + thickness2_mm_ > 0.0 ? thickness : kSteps / 2;
  return places_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
}

ClearanceField::Place& ClearanceField::place(int distance, int thickness) {
  return const_cast<Place&>(std::as_const(*this).place(distance, thickness));
}

Result<ChangedPair> ClearanceField::turned(int distance, int thickness) const {
  const double u = 2.0 * distance / kSteps - 1.0, v = 2.0 * thickness / kSteps - 1.0;
  return changed(*train_, *mesh_, u * distance_mm_, v * thickness1_mm_, v * thickness2_mm_);
}

/// NaN where the teeth do not mesh.
double ClearanceField::clearance_at(int distance, int thickness) {
  Place& turned_place = place(distance, thickness);
  if (!turned_place) turned_place = turned(distance, thickness).value_or(ChangedPair{});
  return turned_place->clearance_mm;
}

bool ClearanceField::worth_halving(const Cell& cell) {
  if (cell.size == 1) return false;
  const auto known = halved_.find(cell);
  if (known != halved_.end()) return known->second;
  const auto [i, k, size] = cell;
  const double corners[] = {clearance_at(i, k), clearance_at(i + size, k), clearance_at(i, k + size),
                            clearance_at(i + size, k + size)};
  const auto jammed = std::count_if(std::begin(corners), std::end(corners), jams);
  const bool worth = jammed > 0 && jammed < 4 &&
                     std::abs(clearance_at(i + size / 2, k + size / 2) - interpolated(cell, 0.5, 0.5)) > kPlane_mm;
  return halved_[cell] = worth;
}

double ClearanceField::interpolated(const Cell& cell, double u, double v) {
  const auto [i, k, size] = cell;
  return (1.0 - u) * ((1.0 - v) * clearance_at(i, k) + v * clearance_at(i, k + size)) +
         u * ((1.0 - v) * clearance_at(i + size, k) + v * clearance_at(i + size, k + size));
}

double ClearanceField::clearance_mm(double distance_mm, double thickness_mm) {
  const auto steps_at = [](double value, double half) {
    return half > 0.0 ? 0.5 * kSteps * (std::clamp(value / half, -1.0, 1.0) + 1.0) : 0.5 * kSteps;
  };
  const double x = steps_at(distance_mm, distance_mm_), y = steps_at(thickness_mm, thickness1_mm_ + thickness2_mm_);
  const auto first_of = [](double steps, int low, int size) { return steps >= low + size ? low + size : low; };
  Cell cell{0, 0, kSteps};
  do {
    const int size = cell.size / 2;
    cell = {first_of(x, cell.distance, size), first_of(y, cell.thickness, size), size};
  } while (worth_halving(cell));
  return interpolated(cell, (x - cell.distance) / cell.size, (y - cell.thickness) / cell.size);
}

}  // namespace trueflank
