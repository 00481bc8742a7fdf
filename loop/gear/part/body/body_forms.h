// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Courses over the profile (0) or the face (1) to begin with: they are moved to their place.
[[nodiscard]] std::vector<gear_effects::FlankCourse> coarse_courses(const FlankGeometry& geometry,
                                                                    double face);

/// Courses over the face that a width may have: these, and a waist.
[[nodiscard]] std::vector<gear_effects::FlankCourse> courses_of_a_width(
    const FlankGeometry& geometry);

/// Bodies that are wider along the face by these courses: flanks, tips and roots.
[[nodiscard]] std::vector<Effect> wider_bodies(
    const std::vector<gear_effects::FlankCourse>& courses);

/// A body that is out of round along a part of its height, for what goes around the gear in waves
/// of one order, along the face or not.
[[nodiscard]] bool tell_as_body_wave(PartModel& model);

/// Views of a scan that do not meet, or a radius that drifts once around, for what goes around the
/// gear in waves, on single teeth and on all: a scale, too, and lobes, may be such pieces.
[[nodiscard]] bool tell_as_views(PartModel& model);
/// Places of the body that stand out or lie back, by direction and height: one for forms of teeth
/// that lie side by side; several, evenly spaced, for waves of an order and its multiples, or for
/// forms of teeth that lie so; one for each run of teeth where a comb has parts of them.
[[nodiscard]] bool tell_as_body_place(PartModel& model);

}  // namespace trueflank::loop
