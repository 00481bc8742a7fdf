// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/gear/effect.h"

// How effects that are the same on every tooth run along the flanks.
namespace trueflank::loop {

/// Along which direction an effect differs, alike on every tooth and on the flanks it acts on.
/// kOtherwise: it is not alike there, comes in waves around the gear, or has more than two columns.
enum class Runs { kNowhere, kOverProfile, kOverFace, kOverBoth, kOtherwise };

/// Alike on both flanks, or (kOfEither) of either flank by itself: it may be opposite on the other.
enum class Flanks { kAlike, kOfEither };

[[nodiscard]] Runs runs_of(const FlankGeometry& geometry, const Effect& effect,
                           Flanks flanks = Flanks::kAlike);

/// What an effect does on both flanks of the first tooth: a column for each of its own, a row for
/// each place of an even grid, the flank with side 1 first.
[[nodiscard]] Eigen::MatrixXd over_a_tooth(const FlankGeometry& geometry, const Effect& effect);

/// A slope over the profile or the face, and no more.
[[nodiscard]] bool is_straight(const FlankGeometry& geometry, const Effect& effect);

/// A wave around the gear, each tooth as it stands.
[[nodiscard]] bool is_wave_around(const Effect& effect);

/// True where all teeth are moved aside alike at every height: an eccentricity.
[[nodiscard]] bool moves_the_teeth(const Effect& effect);

/// True where the last of the effects dies away over nearly the whole flank beside a slope: a slope
/// and a bow, told another way.
[[nodiscard]] bool is_slope_beside_slope(const FlankGeometry& geometry,
                                         const std::vector<Effect>& with);
/// True where both run along the profile, or both along the face, and differ by a factor and a
/// level.
[[nodiscard]] bool run_alike(const FlankGeometry& geometry, const Effect& a, const Effect& b);

/// True for a name of one column that is the same on every tooth.
[[nodiscard]] bool is_name_of_all_teeth(const Effect& effect);
/// True where a column over a tooth is a sum of two others that differ.
[[nodiscard]] bool is_in_the_span(const Eigen::VectorXd& of, const Eigen::VectorXd& a,
                                  const Eigen::VectorXd& b);

/// True of what is so wide or long that the flank is a small part of it: a bow, told another way.
[[nodiscard]] bool is_longer_than_the_flank(const FlankGeometry& geometry, const Effect& form,
                                            bool face);

}  // namespace trueflank::loop
