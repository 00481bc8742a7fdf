// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/effect.h"

// Forms of one kind, with places and widths to start from, that are tried for several effects, and
// in place of which of them: lists of their numbers.
namespace trueflank::loop {

/// Forms along the profile (0) or the face (1), to start from: what is flat and leaves that towards
/// an end, and bands where several effects may be one.
[[nodiscard]] std::vector<Effect> forms_along(const FlankGeometry& geometry, double face,
                                              FlankChoice flank, bool bands);

/// Roofs along the profile (0) or the face (1), to start from.
[[nodiscard]] std::vector<Effect> roofs_along(const FlankGeometry& geometry, double face,
                                              FlankChoice flank);

/// Hollows or swellings from end to end of the profile (0) or the face (1), to start from.
[[nodiscard]] std::vector<Effect> sags_along(const FlankGeometry& geometry, double face,
                                             FlankChoice flank);

/// Steps at places along the profile (0) or the face (1), to start from.
[[nodiscard]] std::vector<Effect> steps_along(const FlankGeometry& geometry, double face,
                                              FlankChoice flank);

/// Waves over the profile, the same on every tooth, about as long as those of an order around the
/// gear.
[[nodiscard]] std::vector<Effect> waves_of_order(const FlankGeometry& geometry, double order,
                                                 FlankChoice flank);

/// Names of these effects that have a place or a width: one alone at its best shape may say it all.
[[nodiscard]] std::vector<Effect> names_with_shapes(const FlankGeometry& geometry,
                                                    const std::vector<Effect>& effects);

/// Waves from a third of the whole length to an S over more than it.
[[nodiscard]] std::vector<Effect> long_waves(const FlankGeometry& geometry, double face,
                                             FlankChoice flank);

/// A slope over the profile (0) or the face (1), without a name.
[[nodiscard]] Effect slope_over(int face, FlankChoice flank);

/// Hollows that end over the profile and over the face, to start from.
[[nodiscard]] std::vector<Effect> dishes(const FlankGeometry& geometry, FlankChoice flank,
                                         const char* family);

/// Swellings or hollows evenly spaced around the gear, to start from: two to kMostSwellings.
inline constexpr int kMostSwellings = 8;
[[nodiscard]] std::vector<Effect> swellings_around(int teeth, FlankChoice flank);

/// The same, or one alone, that die away from an end of the teeth.
[[nodiscard]] std::vector<Effect> swellings_at_ends(const FlankGeometry& geometry, int number);

/// A course over the flanks of a tooth: degrees over profile and face.
struct CourseOverFlanks {
  double profile = 0.0, face = 0.0;
};

/// One tooth in so many that stands out (opposite: aside), from each of the first on.
[[nodiscard]] std::vector<Effect> combs_of(int every, FlankChoice flank, double opposite);
inline constexpr int kMostOfComb = 8;  ///< one tooth in so many, at most

/// Forms that go from tooth to tooth, at every place: sectors and drifts of a course; of heights
/// also dents, saws, combs, swellings, orders of cutting, waves that change; alike or opposite on
/// both flanks, or of one. Those of a set differ by their shape alone, and have as many columns.
[[nodiscard]] std::vector<std::vector<Effect>> forms_from_tooth_to_tooth(
    int teeth, const CourseOverFlanks& course);

/// What slips over some teeth, and stays so up to the last tooth of the gear, to start from.
[[nodiscard]] std::vector<Effect> slips_around(int teeth, FlankChoice flank, double opposite);

/// Of both flanks: places that spring apart at a gap between two teeth, arches once around, and
/// bursts of waves, to start from: a list of each. None of few teeth.
[[nodiscard]] std::vector<std::vector<Effect>> slits_arches_bursts(int teeth, double opposite);

/// Bent axes, and axes with a kink to start from.
[[nodiscard]] std::vector<Effect> bows_of_the_axis();
[[nodiscard]] std::vector<Effect> kinks_of_the_axis(const FlankGeometry& geometry);
/// Sections that slide aside about a height, softly, to start from.
[[nodiscard]] std::vector<Effect> soft_shifts(const FlankGeometry& geometry);

/// Ridges and grooves in lines aslant over the flanks, to start from.
[[nodiscard]] std::vector<Effect> lines_aslant(const FlankGeometry& geometry, FlankChoice flank);

/// Corners to start from.
[[nodiscard]] std::vector<Effect> corners(const FlankGeometry& geometry, FlankChoice flank);

/// All of these, and all less each name, and less all names; none that is empty.
[[nodiscard]] std::vector<std::vector<std::size_t>> with_and_without(
    const std::vector<std::size_t>& all, const std::vector<std::size_t>& names);
/// All of these where they are more than two, every two, and each by itself.
[[nodiscard]] std::vector<std::vector<std::size_t>> all_pairs_and_each(
    const std::vector<std::size_t>& all);
/// So many sectors, evenly spaced around the gear, of at least two teeth and as many between them.
inline constexpr int kMostSectors = 6;
[[nodiscard]] std::vector<Effect> sectors_around(int teeth, FlankChoice flank, double opposite,
                                                 int number);
/// An S over all of the profile (0) or the face (1).
[[nodiscard]] Effect s_over(int face, FlankChoice flank);
/// Forms along the profile (0) or the face (1), and an S.
[[nodiscard]] std::vector<Effect> forms_and_s_along(const FlankGeometry& geometry, int face,
                                                    FlankChoice flank);

}  // namespace trueflank::loop
