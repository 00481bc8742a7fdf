// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/loud_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/local/rough_flanks.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kNoPart = static_cast<std::size_t>(-1);

class LoudPlaceSearch {
 public:
  explicit LoudPlaceSearch(const std::vector<FlankPart>& parts)
      : parts_(parts), factors_(parts.size(), 1.0) {
    for (const FlankPart& part : parts) {
      teeth_ = std::max(teeth_, static_cast<std::size_t>(part.tooth) + 1);
      profiles_ = std::max(profiles_, static_cast<std::size_t>(part.profile) + 1);
      faces_ = std::max(faces_, static_cast<std::size_t>(part.face) + 1);
    }
    at_.assign(2 * teeth_ * profiles_ * faces_, kNoPart);
    for (std::size_t i = 0; i < parts.size(); ++i)
      at_[place(parts[i].side, static_cast<std::size_t>(parts[i].tooth),
                static_cast<std::size_t>(parts[i].profile),
                static_cast<std::size_t>(parts[i].face))] = i;
  }

  LoudPlaces run() {
    take_common_off();
    for (const std::size_t side : {0U, 1U}) {
      // A place over the profile is judged by neighbours over the face, and the other way round:
      // each difference stands at one place.
      const std::vector<double> profile =
          factors_of(side, LoudPlace::Of::kProfile, profiles_,
                     [](const FlankPart& part) { return static_cast<std::size_t>(part.profile); });
      const std::vector<double> face =
          factors_of(side, LoudPlace::Of::kFace, faces_,
                     [](const FlankPart& part) { return static_cast<std::size_t>(part.face); });
      multiply(side, [&](const FlankPart& part) {
        return profile[static_cast<std::size_t>(part.profile)] *
               face[static_cast<std::size_t>(part.face)];
      });
      const std::vector<double> flank =
          factors_of(side, LoudPlace::Of::kFlank, teeth_,
                     [](const FlankPart& part) { return static_cast<std::size_t>(part.tooth); });
      multiply(side,
               [&](const FlankPart& part) { return flank[static_cast<std::size_t>(part.tooth)]; });
    }
    return {std::move(factors_), std::move(places_), std::move(flanks_)};
  }

 private:
  [[nodiscard]] std::size_t place(std::size_t side, std::size_t tooth, std::size_t profile,
                                  std::size_t face) const {
    return ((side * teeth_ + tooth) * profiles_ + profile) * faces_ + face;
  }

  /// Where too few flanks show a place, nothing is known of what they have in common.
  void take_common_off() {
    constexpr int kFewest = 3;
    left_.assign(parts_.size(), 0.0);
    common_known_.assign(parts_.size(), false);
    for (const std::size_t side : {0U, 1U})
      for (std::size_t u = 0; u < profiles_; ++u)
        for (std::size_t v = 0; v < faces_; ++v) {
          double sum = 0.0, known = 0.0;
          int count = 0;
          for (std::size_t tooth = 0; tooth < teeth_; ++tooth)
            if (const std::size_t i = at_[place(side, tooth, u, v)]; i != kNoPart) {
              sum += parts_[i].known * parts_[i].um;
              known += parts_[i].known;
              ++count;
            }
          if (count < kFewest) continue;
          for (std::size_t tooth = 0; tooth < teeth_; ++tooth)
            if (const std::size_t i = at_[place(side, tooth, u, v)]; i != kNoPart) {
              left_[i] = parts_[i].um - sum / known;
              common_known_[i] = true;
            }
        }
  }

  /// Factors of the members that parts belong to.
  template <class MemberOf>
  [[nodiscard]] std::vector<double> factors_of(std::size_t side, LoudPlace::Of of,
                                               std::size_t members, const MemberOf& member_of) {
    constexpr double kWorth = 1.3;
    std::vector<std::vector<double>> differences(members);
    const bool over_face = of == LoudPlace::Of::kProfile;  // where neighbours stand side by side
    const std::size_t lines = over_face ? profiles_ : faces_,
                      places = over_face ? faces_ : profiles_;
    for (std::size_t tooth = 0; tooth < teeth_; ++tooth)
      for (std::size_t number = 0; number < lines; ++number) {
        std::vector<std::size_t> parts;  // along the line
        for (std::size_t k = 0; k < places; ++k) {
          const std::size_t i =
              over_face ? at_[place(side, tooth, number, k)] : at_[place(side, tooth, k, number)];
          if (i != kNoPart && common_known_[i]) parts.push_back(i);
        }
        for (std::size_t k = 1; k + 1 < parts.size(); ++k)
          if (const auto off = off_its_neighbours(parts[k - 1], parts[k], parts[k + 1], over_face))
            differences[member_of(parts_[parts[k]])].push_back(*off);
      }
    std::vector<double> scatters, values;
    for (std::vector<double>& of_member : differences) {
      values.push_back(static_cast<double>(std::max<std::size_t>(1, of_member.size())));
      scatters.push_back(of_member.size() < kFewestToTell ? 0.0
                                                          : robust_sigma(std::move(of_member)));
    }
    if (of == LoudPlace::Of::kFlank)
      for (std::size_t tooth = 0; tooth < members; ++tooth)
        flanks_.push_back(
            {static_cast<int>(tooth), static_cast<int>(side), scatters[tooth], values[tooth]});
    // (what is known less well weighs nothing)
    for (std::size_t k = 0; k < members; ++k)
      if (values[k] < kFewestToWeigh) scatters[k] = 0.0;
    std::vector<double> factors = loudness_of(scatters, values).factors;
    const bool even = std::all_of(factors.begin(), factors.end(), [](double factor) {
      return factor < kWorth && factor > 1.0 / kWorth;
    });
    if (even) factors.assign(members, 1.0);
    tell_places(side, of, factors, scatters, values);
    return factors;
  }

  /// Loud members that stand side by side are one place; flanks are told one by one.
  void tell_places(std::size_t side, LoudPlace::Of of, const std::vector<double>& factors,
                   const std::vector<double>& scatters, const std::vector<double>& values) {
    constexpr double kTold = 2.0;
    const auto known = static_cast<double>(
        std::count_if(scatters.begin(), scatters.end(), [](double s) { return s > 0.0; }));
    bool goes_on = false;
    double logs = 0.0, count = 0.0;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (!(scatters[k] > 0.0)) continue;
      if (factors[k] < kTold) {
        goes_on = false;
        continue;
      }
      const double log = std::log(factors[k]);
      const double p = std::min(
          1.0, known * normal_two_sided(log / std::sqrt(kVarianceOfLogScatter / values[k])));
      const auto number = static_cast<int>(k);
      if (!goes_on || of == LoudPlace::Of::kFlank) {
        places_.push_back({.of = of, .side = side, .first = number, .p_value = p});
        logs = count = 0.0;
      }
      goes_on = true;
      logs += log;
      count += 1.0;
      LoudPlace& place = places_.back();
      place.last = number;
      place.times = std::exp(logs / count);
      place.p_value = std::min(place.p_value, p);
    }
  }

  /// How far a part lies off the straight line between two others, in standard errors as they are
  /// known so far.
  [[nodiscard]] std::optional<double> off_its_neighbours(std::size_t before, std::size_t at,
                                                         std::size_t after, bool over_face) const {
    constexpr double kFarthest = 6.0;
    const auto along_line = [&](std::size_t i) {
      return static_cast<double>(over_face ? parts_[i].face : parts_[i].profile);
    };
    const double reach = along_line(after) - along_line(before);
    if (reach > kFarthest) return {};
    const double of_before = (along_line(after) - along_line(at)) / reach,
                 of_after = 1.0 - of_before;
    const auto variance = [&](std::size_t i) {
      return factors_[i] * factors_[i] / parts_[i].known;
    };
    return (left_[at] - of_before * left_[before] - of_after * left_[after]) /
           std::sqrt(variance(at) + of_before * of_before * variance(before) +
                     of_after * of_after * variance(after));
  }

  template <class FactorOf>
  void multiply(std::size_t side, const FactorOf& factor_of) {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (parts_[i].side == side) factors_[i] *= factor_of(parts_[i]);
  }

  static constexpr std::size_t kFewestToTell = 12;
  static constexpr double kFewestToWeigh = 30.0;
  const std::vector<FlankPart>& parts_;
  std::size_t teeth_ = 0, profiles_ = 0, faces_ = 0;
  std::vector<std::size_t> at_;  ///< number of the part at a place
  std::vector<double> left_;     ///< less what all flanks have in common [um]
  std::vector<bool> common_known_;
  std::vector<double> factors_;
  std::vector<LoudPlace> places_;
  std::vector<MemberScatter> flanks_;
};

}  // namespace

LoudPlaces loud_places(const std::vector<FlankPart>& parts) {
  if (parts.empty()) return {};
  return LoudPlaceSearch(parts).run();
}

std::string LouderPlace::words() const {
  const char* const side = flank == FlankChoice::kLeft    ? "left "
                           : flank == FlankChoice::kRight ? "right "
                                                          : "";
  if (tooth > 0) return printed("on the %sflank of tooth %d", side, tooth);
  return printed("on all %sflanks between %s of %.4g and %.4g mm", side,
                 over_face ? "heights" : "diameters", low_mm, high_mm);
}

std::vector<std::string> notes_on(const std::vector<LouderPlace>& places) {
  constexpr std::size_t kMostByThemselves = 3;
  std::vector<std::string> notes;
  std::array<std::set<int>, 2> teeth;  // with left, with right flanks that are louder
  double least = 0.0, most = 0.0;
  std::size_t flanks = 0;
  for (const LouderPlace& place : places) flanks += place.tooth > 0 ? 1 : 0;
  const auto note = [&](const std::string& where, const std::string& times) {
    notes.push_back(where + ", points of the scan scatter " + times +
                    " times as much as elsewhere: what they show counts for less");
  };
  for (const LouderPlace& place : places) {
    if (place.tooth == 0 || flanks <= kMostByThemselves) {
      note(place.words(), printed("%.2g", place.times));
      continue;
    }
    least = least > 0.0 ? std::min(least, place.times) : place.times;
    most = std::max(most, place.times);
    if (place.flank != FlankChoice::kRight) teeth[0].insert(place.tooth);
    if (place.flank != FlankChoice::kLeft) teeth[1].insert(place.tooth);
  }
  if (flanks <= kMostByThemselves) return notes;
  std::string where;
  for (const std::size_t side : {0U, 1U})
    if (!teeth[side].empty())
      where += (where.empty() ? "" : " and ") + words_of_teeth(teeth[side]) +
               (side == 0 ? " (left flanks)" : " (right flanks)");
  note(where, printed("%.2g to %.2g", least, most));
  return notes;
}

void add_louder(std::vector<LouderPlace>& louder, const LouderPlace& place) {
  for (LouderPlace& other : louder) {
    const bool same = place.tooth == 0 && other.tooth == 0 && other.source == place.source &&
                      other.flank != place.flank && other.flank != FlankChoice::kBoth &&
                      other.over_face == place.over_face && other.low_mm < place.high_mm &&
                      place.low_mm < other.high_mm;
    if (!same) continue;
    other.flank = FlankChoice::kBoth;
    other.low_mm = std::min(other.low_mm, place.low_mm);
    other.high_mm = std::max(other.high_mm, place.high_mm);
    other.share = std::max(other.share, place.share);
    other.times = std::sqrt(other.times * place.times);
    other.p_value = std::min(other.p_value, place.p_value);
    return;
  }
  louder.push_back(place);
}

std::vector<LouderPlace> still_louder(const FlankGeometry& geometry, const Observations& table,
                                      const Patches& patches, const std::vector<float>& row_um) {
  constexpr double kTold = 2.0;
  std::vector<LouderPlace> result;
  for (LouderPlace place : patches.louder) {
    std::vector<float> inside, outside;
    for (std::size_t i = 0; i < row_um.size(); ++i) {
      const int patch = patches.patch_of_row[i];
      if (patch < 0) continue;
      const Patches::Patch& of_row = patches.patches[static_cast<std::size_t>(patch)];
      if (of_row.kind != ObservationKind::kScanFlank || of_row.source != place.source) continue;
      const Place& at = table.place(table.rows[i]);
      const bool left = (at.side > 0) == (geometry.sense() > 0.0);
      if (place.flank != FlankChoice::kBoth && left != (place.flank == FlankChoice::kLeft))
        continue;
      const double mm = place.over_face ? at.z_mm : 2.0 * at.radius_mm;
      const bool is_inside =
          place.tooth > 0 ? at.tooth == place.tooth : mm >= place.low_mm && mm <= place.high_mm;
      (is_inside ? inside : outside).push_back(row_um[i]);
    }
    const double usual = robust_sigma(std::move(outside));
    place.times = usual > 0.0 ? robust_sigma(std::move(inside)) / usual : 0.0;
    if (place.times >= kTold) result.push_back(place);
  }
  return result;
}

bool weigh_again(const FlankGeometry& geometry, const Observations& table,
                 const std::vector<float>& left_um, Patches& patches) {
  constexpr double kLouder = 1.3, kMore = 1.5, kShare = 0.02;
  const auto counts = [](const Patches::Patch& patch) {
    return patch.kind == ObservationKind::kScanFlank;
  };
  if (std::none_of(
          patches.patches.begin(), patches.patches.end(),
          [&](const Patches::Patch& patch) { return counts(patch) && patch.loud > kLouder; }))
    return false;
  Patches beside = make_patches(geometry, table, &left_um);
  std::vector<bool> left_out(patches.patches.size(), false);
  for (const auto& [patch, weight] : patches.left_out) left_out[patch] = true;
  std::size_t more = 0, all = 0;
  for (std::size_t i = 0; i < patches.patches.size(); ++i) {
    if (left_out[i] || !counts(patches.patches[i])) continue;
    ++all;
    more += beside.patches[i].weight > kMore * patches.patches[i].weight ? 1 : 0;
  }
  if (!(static_cast<double>(more) > kShare * static_cast<double>(all))) return false;
  patches = std::move(beside);
  return true;
}

}  // namespace trueflank::loop
