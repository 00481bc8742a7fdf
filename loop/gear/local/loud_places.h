// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueflank/loop/discovery/rougher_members.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/observations.h"

// A scanner sees some places worse than others: edges, the depth of a gap, a shining flank.
namespace trueflank::loop {

/// A small part of a scanned flank, by its numbers over the profile and over the face.
struct FlankPart {
  int tooth = 0;
  std::size_t side = 0;  ///< 0 or 1
  int profile = 0, face = 0;
  double um = 0.0;     ///< the mean deviation there
  double known = 1.0;  ///< inverse variance of it, up to a common factor
};

/// Neighbouring parts of all flanks of a side, or one flank, whose random error is larger.
struct LoudPlace {
  enum class Of { kProfile, kFace, kFlank };
  Of of = Of::kFlank;
  std::size_t side = 0;
  int first = 0, last = 0;  ///< numbers of the parts over the profile or the face, or the tooth
  double times = 1.0;       ///< the usual error of the side
  double p_value = 1.0;     ///< of the surest of its parts, corrected for all of them
};

struct LoudPlaces {
  std::vector<double> factors;    ///< one for each part
  std::vector<LoudPlace> places;  ///< those twice as loud as is usual, or more
  std::vector<MemberScatter> flanks;  ///< how much each scatters beside its places: tooth and side
};

/// By what factor the random error of each part is larger than the usual one of its side: the
/// product of one factor for its place over the profile, one for its place over the face, and one
/// for its flank. From how far parts lie off the line between those beside them, less what all
/// flanks of the side have in common: a form of the surface is no error. All are 1 where they
/// differ hardly more than chance makes them.
[[nodiscard]] LoudPlaces loud_places(const std::vector<FlankPart>& parts);

/// A place of a scan at which the random error is at least twice the usual one of its flanks.
struct LouderPlace {
  int source = 0;
  FlankChoice flank = FlankChoice::kBoth;
  int tooth = 0;  ///< 0: all teeth, between two diameters or two heights
  bool over_face = false;
  double low_mm = 0.0, high_mm = 0.0;
  double share = 0.0;  ///< of the profile or the face
  double times = 1.0, p_value = 1.0;

  /// A scanner sees edges, or a flank, two or three times worse; a wide part of all flanks that
  /// scatters as much, or more than that anywhere, is the surface.
  [[nodiscard]] bool is_rough() const {
    constexpr double kWide = 0.14, kRough = 4.0, kRoughWhereWide = 2.5;
    return times >= (share >= kWide ? kRoughWhereWide : kRough);
  }
  /// "on the left flanks between diameters of 40 and 41.2 mm".
  [[nodiscard]] std::string words() const;
};

/// Adds a place; the same one on both sides is one.
void add_louder(std::vector<LouderPlace>& louder, const LouderPlace& place);

/// What notes say of them: of each flank, or part of all flanks, that they count for less; of many
/// flanks in one note with their teeth.
[[nodiscard]] std::vector<std::string> notes_on(const std::vector<LouderPlace>& places);

struct Patches;

/// The louder places of scans whose values still scatter twice as much, or more, beside what was
/// found (`row_um`: what is left of every row), with that factor: a step within a patch is no
/// scatter.
[[nodiscard]] std::vector<LouderPlace> still_louder(const FlankGeometry& geometry,
                                                    const Observations& table,
                                                    const Patches& patches,
                                                    const std::vector<float>& row_um);

}  // namespace trueflank::loop
