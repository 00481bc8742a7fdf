// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trueflank/check/contact_judgement.h"
#include "trueflank/check/cure/design_change.h"

// Tips of a changed design, made as short as its complaints ask; the joint cure's. Each returns
// whether any changed.
namespace trueflank {

/// Of the module: what may be taken off a tip at a root or at its neighbour.
inline constexpr double kMostShortenedTip = 0.6;

/// Tips whose written diameter reaches into a fillet, or leaves too little contact, end where clear
/// ones would.
bool shorten_given(const GearTrain& laid, const Judgement& judgement, DesignChange& change);
/// Tips that come too near the mate's root circle, or to their neighbour.
bool shorten_at_roots(const GearTrain& laid, const Judgement& judgement, DesignChange& change);
/// The tip that turning shows in the way, by bisection; `bisected` counts the meshes turned for it.
bool shorten_in_the_way(const GearTrain& laid, int layer, ContactJudge& judge, int& bisected,
                        DesignChange& change);

}  // namespace trueflank
