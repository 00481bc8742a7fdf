// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// A wave of two columns over the flanks of one side: how many waves from root to tip, from the
/// lower end to the upper one, and how many a turn its phase goes on from tooth to tooth.
struct WaveAcross {
  std::size_t effect = 0;
  double profile = 0.0, face = 0.0, order = 0.0;
  double size_um = 0.0;

  [[nodiscard]] WaveAcross reversed() const { return {effect, -profile, -face, -order, size_um}; }
};

[[nodiscard]] WaveAcross wave_across(const FlankGeometry& geometry, const Effect& effect, int side);

/// Waves over the face, on traces, that march from tooth to tooth, beside what is given: of both
/// flanks where these have one phase. Of few traced teeth a wave that all have alike predicts
/// nearly as much: they are to stand before that is chosen.
[[nodiscard]] std::vector<RemainderFinding> marching_waves(PartModel& model);

/// Waves of traces that change their length along the flank, or die away from an end, beside what
/// is given: waves of one length, jumps and ridges that follow them together need not be chosen.
[[nodiscard]] std::vector<RemainderFinding> waves_of_odd_course(const PartModel& model);

/// A part of a wave along one direction for what runs there on these flanks in pieces.
[[nodiscard]] bool tell_as_part_of_a_wave(PartModel& model, const std::vector<std::size_t>& all,
                                          int face, FlankChoice flank);
/// The part of a wave that is most of what runs along one direction, beside a slope and what does
/// not run there; empty where no wave does.
[[nodiscard]] std::optional<RemainderFinding> wave_of_pieces(const PartModel& model, int face,
                                                             FlankChoice flank);
/// A wave over the generating rotation that has a phase of its own on either flank, for those that
/// have the same on both: how far the rotations at which both flanks are made lie apart hangs on
/// tool and machine, and flanks may be made one after the other. Where few teeth are traced,
/// another order has both phases by chance, or two beside each other have. Empty: there is none.
[[nodiscard]] std::vector<Effect> with_phase_of_each_flank(const PartModel& model,
                                                           std::vector<std::size_t>& these);
/// A wave over the profile for one over the generating rotation that every tooth has alike: it is
/// the tool's form or runout, and no machine's order. Also for that and waves over the face, which
/// undo what it has there. Empty where the data show more than the profile wave has.
[[nodiscard]] std::vector<Effect> with_wave_of_the_tool(const PartModel& model,
                                                        std::vector<std::size_t>& these);
/// A wave along the flanks that grows or fades from tooth to tooth, in place of one that all teeth
/// have alike and of the orders that follow its growth. Empty where the data do not clearly show
/// it.
[[nodiscard]] std::vector<Effect> with_growing_wave(const PartModel& model,
                                                    std::vector<std::size_t>& these);
/// Waves around the gear of three orders or more and of like size, none a multiple of the lowest,
/// or of two beside a drift: what one odd form is made of.
void tell_waves_of_a_form(PartModel& model);
/// Waves of one side, about alike over the flank, of orders beside each other are one whose periods
/// a turn are no whole number.
[[nodiscard]] bool tell_as_walking_waves(PartModel& model);
/// Waves of one length along the flanks, told of either flank, are one wave of both, in phase or
/// opposite: an axis that is in waves lifts one flank where it lowers the other.
[[nodiscard]] bool tell_as_waves_of_both_flanks(PartModel& model);

}  // namespace trueflank::loop
