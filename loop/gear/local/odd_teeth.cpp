// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/odd_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestOfAKind = 8, kMostTold = 3;

/// Degrees of freedom with which so many teeth tell how far they usually differ, by a median; and
/// slopes of teeth have longer tails than normal errors.
double degrees_of(std::size_t teeth) {
  constexpr double kToldByMedian = 0.37, kTailOfTeeth = 12.0;
  return std::min(kTailOfTeeth, kToldByMedian * static_cast<double>(teeth));
}

/// A form on the flanks of one tooth.
struct OfTooth {
  int tooth = 0, side = -1;  ///< -1: both
  std::size_t form = 0;
  bool opposite = false;
  double um = 0.0;      ///< height of the form
  double square = 0.0;  ///< that it takes out
  double excess = 0.0;  ///< squares of these flanks beyond the usual
  double p_value = 1.0;
};

class OddTeeth {
 public:
  OddTeeth(const FlankGeometry& geometry, const std::vector<ToothMoments>& moments)
      : geometry_(geometry), moments_(moments) {
    for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
      for (const int side : {0, 1})
        if (of(side, tooth).count > 1) teeth_[static_cast<std::size_t>(side)].push_back(tooth);
    for (const int tooth : teeth_[0])
      if (of(1, tooth).count > 1) both_.push_back(tooth);
    tell_usual();
  }

  /// Forms that are most of what stands on their flanks.
  std::vector<OfTooth> forms() {
    constexpr double kMost = 0.6;
    std::vector<OfTooth> found;
    for (std::size_t form = 1; form < ToothMoments::kForms; ++form) {
      for (const int side : {0, 1}) add(form, side, false, found);
      for (const bool opposite : {false, true}) add(form, -1, opposite, found);
    }
    for (OfTooth& one : found) one.p_value = std::min(1.0, looks_ * one.p_value);
    std::erase_if(found, [](const OfTooth& one) {
      return one.p_value > kLevelOfTooth || one.square < kMost * one.excess;
    });
    return found;
  }

  /// The flank that deviates most of all from its usual size; `p_value` 1 where there is none.
  OfTooth any_form() const {
    constexpr double kLeastTimes = 1.5;  // the usual rms
    std::vector<double> logs;
    std::vector<OfTooth> flanks;
    for (const int side : {0, 1})
      for (const int tooth : teeth_[static_cast<std::size_t>(side)]) {
        const double square = mean_square(side, tooth) / usual_[static_cast<std::size_t>(side)];
        if (!(square > 0.0)) continue;
        logs.push_back(std::log(square));
        flanks.push_back({.tooth = tooth, .side = side, .excess = square});
      }
    OfTooth most;
    if (logs.size() < 2 * kFewestOfAKind) return most;
    const double middle = median(logs);
    std::vector<double> apart = logs;
    for (double& log : apart) log -= middle;
    const double spread = robust_sigma(std::move(apart));
    if (!(spread > 0.0)) return most;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      if (flanks[i].excess < kLeastTimes * kLeastTimes ||
          may_be_louder(flanks[i].side, flanks[i].tooth, flanks[i].excess))
        continue;
      const double p = student_two_sided((logs[i] - middle) / spread, degrees_of(logs.size()));
      if (p >= most.p_value) continue;
      most = flanks[i];
      most.p_value = p;
      most.um = std::sqrt(mean_square(most.side, most.tooth));
    }
    most.p_value = std::min(1.0, static_cast<double>(logs.size()) * most.p_value);
    return most;
  }
  [[nodiscard]] double usual_um(int side) const {
    return std::sqrt(usual_[static_cast<std::size_t>(side)]);
  }

 private:
  [[nodiscard]] const ToothMoments& of(int side, int tooth) const {
    return moments_[ToothMoments::at(side, tooth)];
  }

  /// Of a flank's values about their mean, as loud as the usual flank is.
  [[nodiscard]] double mean_square(int side, int tooth) const {
    const ToothMoments& own = of(side, tooth);
    const double n = own.count;
    return std::max(0.0, own.squares - own.total * own.total / n) /
           ((n - 1.0) * own.loud * own.loud);
  }
  /// True of a flank whose values scatter from place to place by so much more than usual that its
  /// mean square, so many times the usual one, may be that alone.
  [[nodiscard]] bool may_be_louder(int side, int tooth, double times) const {
    constexpr double kSure = 3.0;
    const ToothMoments& own = of(side, tooth);
    if (!(own.scatter > 1.0)) return false;
    return 0.5 * std::log(times) + std::log(own.loud) <
           std::log(own.scatter) + kSure * std::sqrt(kVarianceOfLogScatter / own.scatter_values);
  }
  void tell_usual() {
    for (const int side : {0, 1}) {
      std::vector<double> squares;
      for (const int tooth : teeth_[static_cast<std::size_t>(side)])
        squares.push_back(mean_square(side, tooth));
      if (!squares.empty()) usual_[static_cast<std::size_t>(side)] = median(std::move(squares));
    }
  }
  [[nodiscard]] double excess(int side, int tooth) const {
    const ToothMoments& own = of(side, tooth);
    return (mean_square(side, tooth) - usual_[static_cast<std::size_t>(side)]) * (own.count - 1.0) *
           own.loud * own.loud;
  }

  /// The height of a form on one flank, or what both have of it.
  [[nodiscard]] double height(std::size_t form, int side, int tooth, bool opposite) const {
    const auto own = [&](int one) {
      return of(one, tooth).sum_beside_level(form) / of(one, tooth).square_beside_level(form);
    };
    return side >= 0 ? own(side) : 0.5 * (own(1) + (opposite ? -1.0 : 1.0) * own(0));
  }
  /// A flank on which a form hardly varies (one line of a scan at one height) does not show it.
  [[nodiscard]] bool shows(std::size_t form, int side, int tooth) const {
    constexpr double kVaries = 0.3;
    // Mean squares of u and of u^2 - 1/3 over an even flank.
    constexpr double kOfSlope = 1.0 / 3.0, kOfBow = 4.0 / 45.0;
    const ToothMoments& own = of(side, tooth);
    return own.square[form] > 0.0 &&
           own.square_beside_level(form) >
               kVaries * (form < 3 ? kOfSlope : kOfBow) * static_cast<double>(own.count);
  }
  [[nodiscard]] bool has(std::size_t form, int side, int tooth) const {
    for (const int one : {0, 1})
      if ((side < 0 || side == one) && !shows(form, one, tooth)) return false;
    return true;
  }

  /// The tooth with most of a form.
  void add(std::size_t form, int side, bool opposite, std::vector<OfTooth>& found) {
    std::vector<int> teeth;
    std::vector<double> heights;
    for (const int tooth : side < 0 ? both_ : teeth_[static_cast<std::size_t>(side)]) {
      if (!has(form, side, tooth)) continue;
      teeth.push_back(tooth);
      heights.push_back(height(form, side, tooth, opposite));
    }
    if (teeth.size() < kFewestOfAKind) return;
    looks_ += static_cast<double>(teeth.size());
    const double middle = median(heights);
    std::vector<double> apart = heights;
    for (double& one : apart) one -= middle;
    const double spread = robust_sigma(std::move(apart));
    if (!(spread > 0.0)) return;
    OfTooth most{.side = side, .form = form, .opposite = opposite};
    for (std::size_t i = 0; i < teeth.size(); ++i) {
      const double off = heights[i] - middle;
      double loud = 1.0, square = 0.0, beyond = 0.0;
      for (const int one : {0, 1}) {
        if (side >= 0 && side != one) continue;
        loud = std::max(loud, of(one, teeth[i]).loud);
        square += off * off * of(one, teeth[i]).square_beside_level(form);
        beyond += excess(one, teeth[i]);
      }
      const double p = student_two_sided(off / (loud * spread), degrees_of(teeth.size()));
      if (p >= most.p_value) continue;
      most.tooth = teeth[i];
      most.um = off;
      most.square = square;
      most.excess = beyond;
      most.p_value = p;
    }
    found.push_back(most);
  }

  const FlankGeometry& geometry_;
  const std::vector<ToothMoments>& moments_;
  std::array<std::vector<int>, 2> teeth_;
  std::vector<int> both_;
  std::array<double, 2> usual_{};  ///< mean square of the usual flank's values
  double looks_ = 0.0;
};

RemainderFinding finding_of_tooth(const FlankGeometry& geometry, const OfTooth& one) {
  const double u = one.form == 1 ? 1.0 : one.form == 3 ? 2.0 : 0.0;
  const double v = one.form == 2 ? 1.0 : one.form == 4 ? 2.0 : 0.0;
  return finding_of(geometry, "unnamed_tooth_form", flank_choice(geometry, one.side),
                    {double(one.tooth), u, v, one.opposite ? 1.0 : 0.0}, one.p_value, one.um, true,
                    one.square);
}

}  // namespace

std::vector<RemainderFinding> odd_teeth(const FlankGeometry& geometry,
                                        const MomentsOfTeeth& moments) {
  std::vector<RemainderFinding> told;
  for (const auto& [key, of_teeth] : moments) {
    if (key.first == MomentsOf::kOthers) continue;
    OddTeeth odd(geometry, of_teeth);
    std::vector<OfTooth> forms = odd.forms();
    std::stable_sort(forms.begin(), forms.end(),
                     [](const auto& a, const auto& b) { return a.square > b.square; });
    std::vector<int> teeth;
    for (const OfTooth& one : forms) {
      if (teeth.size() == kMostTold ||
          std::find(teeth.begin(), teeth.end(), one.tooth) != teeth.end())
        continue;
      teeth.push_back(one.tooth);
      told.push_back(finding_of_tooth(geometry, one));
    }
    const OfTooth any = odd.any_form();
    if (any.p_value > kLevelOfTooth ||
        std::find(teeth.begin(), teeth.end(), any.tooth) != teeth.end())
      continue;
    const FlankChoice flank = flank_choice(geometry, any.side);
    told.push_back(
        {.p_value = any.p_value,
         .text = printed("the %s flank of tooth %d has a form of its own%s: %.3g um rms, the usual "
                         "flank %.3g um",
                         flank == FlankChoice::kLeft ? "left" : "right", any.tooth,
                         key.first == MomentsOf::kProfiles  ? " over the profile"
                         : key.first == MomentsOf::kHelices ? " over the face"
                                                            : "",
                         any.um, odd.usual_um(any.side)),
         .amount_um = any.um});
  }
  // Two questions of every record: forms, and any form.
  const auto questions = 2.0 * static_cast<double>(moments.size());
  for (RemainderFinding& one : told) one.p_value = std::min(1.0, questions * one.p_value);
  std::erase_if(told, [](const RemainderFinding& one) { return one.p_value > kLevelOfTooth; });
  return told;
}

std::vector<RemainderFinding> without_spots_alike(std::vector<RemainderFinding> odd,
                                                  std::vector<RemainderFinding>& found) {
  std::erase_if(odd, [&](const RemainderFinding& form) {
    if (!form.effect) return false;
    const bool both = form.effect->flank == FlankChoice::kBoth;
    const double square = both ? 0.5 * form.square : form.square;  // on either
    const auto is_alike = [&](const RemainderFinding& spot) {
      return spot.local && spot.effect &&
             spot.effect->shape.front() == form.effect->shape.front() &&
             (both || spot.effect->flank == form.effect->flank);
    };
    if (std::any_of(found.begin(), found.end(), [&](const RemainderFinding& spot) {
          return is_alike(spot) && spot.square > square;
        }))
      return true;
    std::erase_if(found, is_alike);
    return false;
  });
  return odd;
}

}  // namespace trueflank::loop
