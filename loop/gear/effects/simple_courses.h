// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effect.h"

// Simple courses over the profile (face 0) or the face (1), of which products are made: how much
// there is at a place, 1 where it is most.
namespace trueflank::loop::gear_effects {

/// A course as it stands among the shape values of a form.
struct FlankCourse {
  enum Kind { kWhole, kSlope, kStep, kKink, kBend, kRise, kBand, kBow, kVee, kSwells };
  static constexpr std::size_t kValues = 4;

  Kind kind = kWhole;
  double mm = 0.0;  ///< its place (over the profile a diameter); kRise: within what it dies away
  double towards = 0.0;  ///< -1 root or lower end, 1 tip or upper end; 0: both (kRise)
  double half_mm = 0.0;  ///< half its width (kBand) or period (kSwells: a wave between
                         ///< nothing and all), or over what it rises to either side (kStep)

  [[nodiscard]] static FlankCourse at(const EffectShape& shape, std::size_t first) {
    return {static_cast<Kind>(static_cast<int>(shape[first])), shape[first + 1], shape[first + 2],
            shape[first + 3]};
  }
  void put_in(EffectShape& shape, std::size_t first) const;

  /// At a roll length or height [mm]. kSlope: -1 at the root or the lower end, 1 at the other.
  [[nodiscard]] double value(const FlankGeometry& geometry, double face, double at_mm) const;
  /// A polynomial, as the free form has them, or near to one: a kink or a bend over most of the
  /// way.
  [[nodiscard]] bool is_of_free_form(const FlankGeometry& geometry, double face) const;
  /// A level, a slope or a bow.
  [[nodiscard]] bool is_polynomial() const {
    return kind == kWhole || kind == kSlope || kind == kBow;
  }
  /// Places and widths that were sought.
  [[nodiscard]] int values_sought() const;
  /// The same moved, longer or shorter, or of a kind near to it.
  [[nodiscard]] std::vector<FlankCourse> beside(const FlankGeometry& geometry, double face) const;
  /// "from a height of 3 mm on evenly towards the upper end"; empty for kWhole and kSlope.
  [[nodiscard]] std::string words(const FlankGeometry& geometry, double face) const;
  /// What it is called in term_keys, in the order of Kind.
  [[nodiscard]] static std::vector<std::string> kind_words();
};

/// How a form goes from tooth to tooth, as it stands among its shape values: by the direction in
/// which a tooth stands.
struct AroundCourse {
  /// A cosine on one half and nothing on the other; a bell; some teeth and no others; from nothing
  /// at a tooth evenly to all before it comes around; waves; the same on every tooth; one tooth in
  /// so many, counted from the first one of the gear on; from all at a tooth evenly to nothing
  /// before it comes around; in a wave between nothing and all; from nothing at a tooth evenly to
  /// all over so many, and anew.
  enum Kind { kHalf, kBell, kSector, kRamp, kWave, kEvery, kComb, kFade, kComesAndGoes, kSaw };
  static constexpr std::size_t kValues = 3;

  Kind kind = kHalf;
  double towards_deg = 0.0;  ///< where it is most, or begins (kRamp, kFade, kComb, kSaw)
  double half_deg = 0.0;     ///< half its width (kBell, kSector) or period (the waves, kComb, kSaw)

  /// One tooth in so many, from one on.
  [[nodiscard]] static AroundCourse comb(const FlankGeometry& geometry, int every, int first);
  /// From nothing at one tooth to all over so many.
  [[nodiscard]] static AroundCourse saw(const FlankGeometry& geometry, int every, int first);

  /// Of kComb and kSaw: every how many teeth, and the first.
  [[nodiscard]] std::pair<int, int> teeth_of_comb(const FlankGeometry& geometry) const;
  [[nodiscard]] static AroundCourse at(const EffectShape& shape, std::size_t first) {
    return {static_cast<Kind>(static_cast<int>(shape[first])), shape[first + 1], shape[first + 2]};
  }
  void put_in(EffectShape& shape, std::size_t first) const;
  [[nodiscard]] double value(const FlankGeometry& geometry, int tooth) const;
  /// A mean and waves, as the free form has them; a wide bell is nearly that.
  [[nodiscard]] bool is_of_free_form() const {
    constexpr double kWide_deg = 75.0;
    return kind == kWave || kind == kComesAndGoes || kind == kEvery ||
           (kind == kBell && half_deg > kWide_deg);
  }
  [[nodiscard]] int values_sought() const {
    return kind == kEvery || kind == kSaw                      ? 0
           : kind == kBell || kind == kSector || kind == kComb ? 2
                                                               : 1;
  }
  [[nodiscard]] std::vector<AroundCourse> beside(const FlankGeometry& geometry) const;
  /// "on the teeth towards 30 deg, ... "
  [[nodiscard]] std::string words(const FlankGeometry& geometry) const;
  [[nodiscard]] static std::vector<std::string> kind_words();
};
/// Courses of all kinds around a gear, most towards 0 deg.
[[nodiscard]] std::vector<AroundCourse> courses_around(const FlankGeometry& geometry);

/// Courses of all kinds, to start from.
[[nodiscard]] std::vector<FlankCourse> courses_over(const FlankGeometry& geometry, double face);

}  // namespace trueflank::loop::gear_effects
