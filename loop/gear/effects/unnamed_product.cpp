// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <string>

#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

constexpr double kTowardsLow = -1.0, kTowardsHigh = 1.0, kTowardsBoth = 0.0, kTowardsMiddle = 2.0;

/// 0 at the far end (of both ends: in the middle; of the middle: at both ends), 1 where it is most.
double grown(double x, double towards, double power) {
  if (towards == kTowardsBoth) return x * x;
  if (towards == kTowardsMiddle) return 1.0 - x * x;
  const double share = 0.5 * (towards == kTowardsHigh ? 1.0 + x : 1.0 - x);
  return power == 1.0 ? share : power == 2.0 ? share * share : share * share * share;
}

bool is_of_an_end(double towards) { return towards == kTowardsLow || towards == kTowardsHigh; }

std::string in_words(double towards, double power, const std::array<const char*, 2>& ends) {
  if (towards == kTowardsBoth) return std::string("both ends of the ") + ends[0];
  if (towards == kTowardsMiddle) return std::string("the middle of the ") + ends[0];
  return std::string("the ") + ends[towards == kTowardsHigh ? 1 : 0] +
         (power == 1.0   ? " evenly"
          : power == 2.0 ? " by the square"
                         : " by the cube");
}

/// What grows, and that it does.
std::string grows(int sign, bool opposite) {
  if (sign == 0) return "grows";
  if (opposite) return "a turn of the teeth " + turned(sign) + " grows";
  return sign > 0 ? "an excess of material grows" : "a lack of material grows";
}

}  // namespace

/// Grows over the profile times over the face. Told in place of slopes, bows and twists that follow
/// it (products.cpp), and no candidate of its own.
EffectFamily unnamed_product() {
  EffectFamily f = described("unnamed_product", {"profile_towards", "profile_power", "face_towards",
                                                 "face_power", "opposite_flanks"});
  f.is_followed_nearly = true;
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank
               ? (shape[4] != 0.0 ? p.side : 1) *
                     grown(g.profile_coordinate(p.roll_mm), shape[0], shape[1]) *
                     grown(g.face_coordinate(p.z_mm), shape[2], shape[3])
               : 0.0;
  };
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_profile = true, .along_face = true, .crossed = true};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.term_keys = {{"profile_towards"},
                 {"profile_power"},
                 {"face_towards"},
                 {"face_power"},
                 {"flanks", TermKey::Kind::kWord, {"equal", "opposite"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const bool opposite = shape[4] != 0.0;
    return "the same on every tooth, " + grows(told.sign(), opposite) + " towards " +
           in_words(shape[0], shape[1], {is_of_an_end(shape[0]) ? "root" : "profile", "tip"}) +
           ", and that the more, towards " +
           in_words(shape[2], shape[3],
                    {is_of_an_end(shape[2]) ? "lower end" : "face", "upper end"}) +
           (opposite ? ", opposite on the two flanks" : "");
  };
  return f;
}

std::vector<Effect> products(FlankChoice flank) {
  constexpr std::array<std::array<double, 2>, 8> kCourses{{{kTowardsLow, 1.0},
                                                           {kTowardsLow, 2.0},
                                                           {kTowardsLow, 3.0},
                                                           {kTowardsHigh, 1.0},
                                                           {kTowardsHigh, 2.0},
                                                           {kTowardsHigh, 3.0},
                                                           {kTowardsBoth, 2.0},
                                                           {kTowardsMiddle, 2.0}}};
  std::vector<Effect> forms;
  for (const auto& profile : kCourses)
    for (const auto& face : kCourses)
      for (const double opposite : {0.0, 1.0})
        if (opposite == 0.0 || flank == FlankChoice::kBoth)
          forms.push_back({find_family("unnamed_product"),
                           flank,
                           {profile[0], profile[1], face[0], face[1], opposite}});
  return forms;
}

}  // namespace trueflank::loop::gear_effects
