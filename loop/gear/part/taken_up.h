// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// What is found in what effects leave. Asked for the same effects again, the answer is kept.
[[nodiscard]] const std::vector<RemainderFinding>& remainder_of(PartModel& model,
                                                                const std::vector<Effect>& effects,
                                                                RemainderOf which);
/// Waves over the generating rotation that the candidates do not have are taken up at once: beside
/// the candidates alone many others imitate them. Forms that the data as they are show, so that a
/// sector or a step stands beside the waves that would otherwise imitate it: candidates like all
/// others.
void nominate(PartModel& model);
/// True where what an effect does is not nearly what others do together.
[[nodiscard]] bool is_told_apart(const PartModel& model, const Effect& effect,
                                 const std::vector<Effect>& beside);
/// The finding enters the model, and all else is chosen anew beside it.
void take_up(PartModel& model, const RemainderFinding& finding);
/// A name that moves the whole gear and went while forms of a few teeth came, though it takes out
/// far more than chance beside them: folds that hold such teeth predict the others badly, and
/// little is told by what they say of it. It stays from now on. True where there was one.
[[nodiscard]] bool take_up_again(PartModel& model, const std::vector<Effect>& before);
/// Takes up what the effects leave as effects; true where there was something.
[[nodiscard]] bool take_up_remainder(PartModel& model);
struct LeastMissed {
  std::size_t effect = 0;
  double loss = 1e300;
};
/// Of the effects [first, end) that are asked for, the one whose loss costs least, and how much
/// (chi-square).
[[nodiscard]] LeastMissed least_missed(const PartModel& model, std::size_t first, std::size_t end,
                                       const std::function<bool(const Effect&)>& is_asked);
/// Machine's orders are many: one that was learnt from four fifths of the data, or before the other
/// effects, must stand out of its kind in all of the data beside these. True where one does not.
[[nodiscard]] bool drop_doubtful_orders(PartModel& model);
/// Bans a family on these flanks; true where that is new.
[[nodiscard]] bool ban_alike(PartModel& model, const Effect& effect);
/// A name must hold whether or not forms without a name stand beside it: where its size hangs on
/// them it is a part of the description, no cause. (What moves teeth aside bends none.) True where
/// any was banned.
[[nodiscard]] bool ban_what_forms_explain(PartModel& model);
/// The locked hold-out may say no: an effect without which its error is smaller is taken back, the
/// one that harms most first. A weak effect that is true may cost a little there by its own error;
/// and of what stands on one tooth the hold-out knows nothing: these go only where the error would
/// rise. A place beyond doubt that goes so (its ends lie in the fold beside it) is told as left.
void veto(PartModel& model);

}  // namespace trueflank::loop
