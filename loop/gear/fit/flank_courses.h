// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "trueflank/loop/gear/fit/point_fit.h"

// What the effects of a fit do along the flanks of a tooth, over the profile or over the face.
namespace trueflank::loop {

/// Places over each flank of a tooth: a course has those of the left flank, then of the right one.
inline constexpr int kPlaces = 33;

/// What an effect does along the flanks of one tooth.
[[nodiscard]] Eigen::VectorXd values_along(const FlankGeometry& geometry, const PointFit& fit,
                                           std::size_t effect, bool face, int tooth = 1);

/// True where one tooth does not say what the mean of all does: a form of some teeth.
[[nodiscard]] bool differs_by_tooth(const Effect& effect);

/// True of what moves whole teeth in a direction, and bends none.
[[nodiscard]] bool moves_teeth_aside(const Effect& effect);

/// What an effect does in the mean of the teeth, of some where all are more than are needed.
[[nodiscard]] Eigen::VectorXd mean_over_teeth(const FlankGeometry& geometry, const PointFit& fit,
                                              std::size_t effect, bool face);

/// Along the flanks, each about its mean; in the mean of the teeth where they differ.
[[nodiscard]] Eigen::VectorXd course_of(const FlankGeometry& geometry, const PointFit& fit,
                                        std::size_t effect, bool face);

/// How the two flanks of a tooth go together in a course.
enum class Kind { kEqual, kOpposite, kNeither };
[[nodiscard]] Kind kind_of(const Eigen::VectorXd& course);

/// True where a course leaves one of the flanks nearly level.
[[nodiscard]] bool is_of_one_flank(const Eigen::VectorXd& course);

/// The part of a course that is of a kind: what is equal on both flanks is no part of a name that
/// is opposite on them. What is of one flank is wholly there.
[[nodiscard]] Eigen::VectorXd part_of_kind(const Eigen::VectorXd& course, Kind kind);

/// The part of a course that polynomials follow.
[[nodiscard]] Eigen::VectorXd slow_part(const Eigen::VectorXd& course);

[[nodiscard]] bool is_form_without_name(const Effect& effect);

/// A form without a name that is no wave around the gear.
[[nodiscard]] bool is_common_form(const Effect& effect);

/// What the forms without a name do in the mean of the teeth, but for slopes that are opposite on
/// the two flanks: these are no part of what is equal on both.
[[nodiscard]] Eigen::VectorXd mean_of_forms(const FlankGeometry& geometry, const PointFit& fit,
                                            bool face);

/// True where an effect changes some tooth along a course, which what is equal on both flanks does
/// not along what is opposite on them.
[[nodiscard]] bool changes_along(const FlankGeometry& geometry, const PointFit& fit,
                                 std::size_t effect, const Eigen::VectorXd& course, bool face);

/// How large the forms without a name are along each flank, over a name's course there: the
/// largest of any tooth.
[[nodiscard]] std::array<double, 2> forms_over_name(const FlankGeometry& geometry,
                                                    const PointFit& fit,
                                                    const Eigen::VectorXd& name, bool face);

}  // namespace trueflank::loop
