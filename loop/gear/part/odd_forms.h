// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Where one of several names along the flanks is what such waves leave in the mean, it is told as
/// a form; so is a height that is no more than theirs.
void tell_parts_in_the_mean_of_waves(PartModel& model);
/// What coefficients would be without that mean; zero elsewhere.
[[nodiscard]] Eigen::VectorXd without_means_of_waves(const PartModel& model, const PointFit& fit);
/// What comes and goes once around and never changes its sign (a side that cools later) has a mean
/// of the same course. Two names or more that make up the course of a wave without a name, as large
/// as that, are its mean.
void tell_means_of_one_wave(PartModel& model);
/// A slope, a bow or a height that forms without a name change from one end of the flanks to the
/// other is the mean of these: growth above a height was a scale. (Not what shows beside a height,
/// a lean and a turn that are free.)
void tell_means_across_flanks(PartModel& model);
/// A name says that all teeth have a form alike. Where these differ in it by more than that itself,
/// it is the mean of something else (a dent of every fourth tooth): a form.
void tell_what_teeth_do_not_share(PartModel& model);
/// An odd form around the gear has a mean of its own: what leans or bends all flanks by less than
/// such a form changes it from tooth to tooth is that mean. And what twists the flanks beside forms
/// that bend over both, profile and face, is a part of these.
void tell_means_of_odd_forms(PartModel& model);

}  // namespace trueflank::loop
