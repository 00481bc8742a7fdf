// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/plane/plane_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/plane/plane_values.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestInPlane = 400, kFewestInPart = 12;
constexpr int kDirectionsAcross = 90, kBinsAcross = 160, kDiscSide = 19, kDiscBins = 60;
constexpr std::size_t kNarrowestStrip = 4, kSmallestDisc = 6;  // bins
/// What a bound more has to take out, in variances of what is left.
constexpr double kOfABoundOfPart = 12.0;

/// A part and the squares that it takes out of the values, about their mean.
struct PartTrial {
  PartOfPlane part;
  double square = 0.0;
  void take(const PartOfPlane& other, double other_square) {
    if (!(other_square > square)) return;
    part = other;
    square = other_square;
  }
};

/// What values with this sum, of so many of all (whose sum is 0), take out.
double square_inside(double sum, double inside, double all) {
  const double outside = all - inside;
  if (inside < static_cast<double>(kFewestInPart) || outside < static_cast<double>(kFewestInPart))
    return 0.0;
  return sum * sum * (1.0 / inside + 1.0 / outside);
}

/// Sums and numbers of the values before each bin.
struct SumsAcross {
  std::array<double, kBinsAcross + 1> sum{}, count{};
};

/// The best strip and the best half plane of one direction.
std::array<PartTrial, 2> best_across(const PlaneValues& values, double direction_deg,
                                     double wide_mm) {
  const double direction = rad_from_deg(direction_deg), step_mm = 2.0 * wide_mm / kBinsAcross;
  const double cosine = std::cos(direction), sine = std::sin(direction);
  SumsAcross upto;
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double along = values.at_mm[0][i] * cosine + values.at_mm[1][i] * sine;
    const auto bin = static_cast<std::size_t>(
        std::clamp(static_cast<int>((along + wide_mm) / step_mm), 0, kBinsAcross - 1));
    upto.sum[bin + 1] += values.um[i];
    upto.count[bin + 1] += 1.0;
  }
  for (std::size_t k = 0; k < kBinsAcross; ++k) {
    upto.sum[k + 1] += upto.sum[k];
    upto.count[k + 1] += upto.count[k];
  }
  const auto all = static_cast<double>(values.um.size());
  std::array<PartTrial, 2> best;
  for (std::size_t from = 0; from < kBinsAcross; ++from)
    for (std::size_t to = from + 1; to <= kBinsAcross; ++to) {
      if (from == 0 && to == kBinsAcross) continue;
      if (from > 0 && to < kBinsAcross && to < from + kNarrowestStrip) continue;
      const double square =
          square_inside(upto.sum[to] - upto.sum[from], upto.count[to] - upto.count[from], all);
      const double from_mm = static_cast<double>(from) * step_mm - wide_mm,
                   to_mm = static_cast<double>(to) * step_mm - wide_mm;
      const bool strip = from > 0 && to < kBinsAcross;
      PartTrial& kept = best[strip ? 0 : 1];
      if (!(square > kept.square)) continue;
      if (strip)
        kept = {{PartOfPlane::kStrip, direction_deg, from_mm, to_mm}, square};
      else if (to == kBinsAcross)
        kept = {{PartOfPlane::kBeyond, direction_deg, from_mm}, square};
      else
        kept = {{PartOfPlane::kBeyond, direction_deg + 180.0, -to_mm}, square};
    }
  return best;
}

/// The best disc about a place.
PartTrial best_about(const PlaneValues& values, double x_mm, double y_mm, double wide_mm) {
  std::array<double, kDiscBins + 1> sum{}, count{};
  const double step_mm = wide_mm / kDiscBins;
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double x = values.at_mm[0][i] - x_mm, y = values.at_mm[1][i] - y_mm;
    const double off = std::sqrt(x * x + y * y) / step_mm;
    if (off >= kDiscBins) continue;
    const auto bin = static_cast<std::size_t>(off);
    sum[bin + 1] += values.um[i];
    count[bin + 1] += 1.0;
  }
  PartTrial best;
  for (std::size_t k = 0; k < kDiscBins; ++k) {
    sum[k + 1] += sum[k];
    count[k + 1] += count[k];
    if (k >= kSmallestDisc)
      best.take({.kind = PartOfPlane::kDisc,
                 .x_mm = x_mm,
                 .y_mm = y_mm,
                 .radius_mm = static_cast<double>(k + 1) * step_mm},
                square_inside(sum[k + 1], count[k + 1], static_cast<double>(values.um.size())));
  }
  return best;
}

/// What a part says of the values: all of them, and each flank about its mean.
struct SaidOfPart {
  double square = 0.0, amount_um = 0.0;
  double within_square = 0.0, within_um = 0.0, within_variance = 0.0;
  double within_weight = 0.0;  ///< of values that bounds part from others of their flank
  double of_others_um = 0.0;  ///< of all values without those of the tooth that says most within
};

SaidOfPart said_of_part(const PlaneValues& values, const PartOfPlane& part, bool within) {
  struct Sums {
    double n = 0.0, b = 0.0, u = 0.0, bb = 0.0, bu = 0.0, uu = 0.0;
    void add(double of_part, double um) {
      n += 1.0;
      b += of_part;
      u += um;
      bb += of_part * of_part;
      bu += of_part * um;
      uu += um * um;
    }
    void take_off(const Sums& other) {
      n -= other.n;
      b -= other.b;
      u -= other.u;
      bb -= other.bb;
      bu -= other.bu;
      uu -= other.uu;
    }
    [[nodiscard]] double square() const { return bb - b * b / n; }
    [[nodiscard]] double product() const { return bu - b * u / n; }
    /// Enough in the part and outside.
    [[nodiscard]] bool is_split() const {
      return n > 0.0 && square() >= static_cast<double>(kFewestInPart) * (1.0 - b / n);
    }
  };
  Sums all;
  std::vector<Sums> of_flank;
  if (within)
    of_flank.resize(
        static_cast<std::size_t>(*std::max_element(values.flank.begin(), values.flank.end())) + 1);
  const double direction = rad_from_deg(part.direction_deg), cosine = std::cos(direction),
               sine = std::sin(direction);
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double x = values.at_mm[0][i], y = values.at_mm[1][i];
    const double b = part.value_at(part.kind == PartOfPlane::kDisc ? part.along_mm(x, y)
                                                                   : x * cosine + y * sine);
    all.add(b, values.um[i]);
    if (within) of_flank[static_cast<std::size_t>(values.flank[i])].add(b, values.um[i]);
  }
  SaidOfPart found;
  if (!all.is_split()) return found;
  found.amount_um = all.product() / all.square();
  found.square = found.amount_um * all.product();
  if (!within) return found;
  double bb = 0.0, bu = 0.0, uu = 0.0, n = 0.0;
  double of_most = 0.0;
  Sums others = all;
  for (std::size_t k = 0; k < of_flank.size(); k += 2) {  // both flanks of a tooth
    double of_tooth = 0.0;
    Sums without = all;
    for (const std::size_t flank_of_tooth : {k, k + 1}) {
      if (flank_of_tooth >= of_flank.size()) break;
      const Sums& flank = of_flank[flank_of_tooth];
      without.take_off(flank);
      if (flank.n < 2.0) continue;
      of_tooth += flank.product();
      bb += flank.square();
      bu += flank.product();
      uu += flank.uu - flank.u * flank.u / flank.n;
      n += flank.n - 1.0;
    }
    if (!(std::abs(of_tooth) > std::abs(of_most))) continue;
    of_most = of_tooth;
    others = without;
  }
  if (!(bb > 0.0) || n < 2.0) return found;
  found.within_weight = bb;
  found.within_um = bu / bb;
  found.within_square = bu * bu / bb;
  if (others.is_split()) found.of_others_um = others.product() / others.square();
  found.within_variance = (uu - found.within_square) / (n - 1.0);
  return found;
}

/// True where what is left on single flanks says about the same as all together, and does so
/// without the one tooth that says most: a lump of one tooth is no part of the plane.
bool may_be_part(const SaidOfPart& fit, double least_chi_square, double alike) {
  constexpr double kOfOthers = 0.8;
  if (!(fit.within_variance > 0.0)) return false;
  const double share = fit.within_um / fit.amount_um, of_others = fit.of_others_um / fit.amount_um;
  return fit.within_square > least_chi_square * fit.within_variance && share > alike &&
         share < 1.0 / alike && of_others > kOfOthers * alike;
}

/// True where flanks that bounds cross say otherwise than all together.
bool is_denied_within(const SaidOfPart& fit, double alike) {
  constexpr double kSaysSomething = 16.0;  // chi-square, were it as all together say
  if (!(fit.within_weight > 0.0)) return false;
  const double share = fit.within_um / fit.amount_um;
  return fit.amount_um * fit.amount_um * fit.within_weight > kSaysSomething * fit.within_variance &&
         !(share > alike && share < 1.0 / alike);
}

/// How much more the inner and the outer halves of flanks differ than their scatter lets them: the
/// variance of errors that hang together, over that of errors that do not. 1 at least.
double variance_times(const PlaneValues& values, double variance) {
  struct Half {
    double n = 0.0, sum = 0.0;
  };
  std::vector<double> radius;
  for (std::size_t i = 0; i < values.um.size(); ++i)
    radius.push_back(std::hypot(values.at_mm[0][i], values.at_mm[1][i]));
  const double middle = median(std::vector<double>(radius));
  std::vector<std::array<Half, 2>> flanks(
      static_cast<std::size_t>(*std::max_element(values.flank.begin(), values.flank.end())) + 1);
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    Half& half = flanks[static_cast<std::size_t>(values.flank[i])][radius[i] > middle ? 1 : 0];
    half.n += 1.0;
    half.sum += values.um[i];
  }
  std::vector<double> off;
  for (const auto& [inner, outer] : flanks)
    if (inner.n > 0.0 && outer.n > 0.0)
      off.push_back((outer.sum / outer.n - inner.sum / inner.n) /
                    std::sqrt(variance * (1.0 / inner.n + 1.0 / outer.n)));
  if (off.empty()) return 1.0;
  const double usual = median(std::vector<double>(off));
  for (double& one : off) one -= usual;
  const double sigma = robust_sigma(std::move(off));
  return std::max(1.0, sigma * sigma);
}

/// To the best place near it.
void move_part_to_place(const PlaneValues& values, double radius_mm, PartTrial& trial) {
  constexpr int kMostSteps = 25;
  for (int step = 0; step < kMostSteps; ++step) {
    const double before = trial.square;
    for (const PartOfPlane& beside : trial.part.beside(radius_mm))
      trial.take(beside, said_of_part(values, beside, false).square);
    if (!(trial.square > before)) return;
  }
}

/// What lies beyond a bound, or what lies before it: the side that says more of the values as they
/// are, with nothing on the other.
void take_side_with_material(const PlaneValues& values, PartOfPlane& part) {
  if (part.kind != PartOfPlane::kBeyond) return;
  std::array<double, 2> sum{}, count{};  // before, beyond
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const std::size_t side =
        part.value(values.at_mm[0][i], values.at_mm[1][i]) > 0.5 ? std::size_t{1} : std::size_t{0};
    sum[side] += values.um[i] + values.mean_um;
    count[side] += 1.0;
  }
  if (!(sum[0] * sum[0] * count[1] > sum[1] * sum[1] * count[0])) return;
  part.direction_deg += 180.0;
  part.from_mm = -part.from_mm;
}

/// Sharp bounds into the middle between the values on both sides: in a gap between teeth all places
/// say the same.
void put_bounds_between_values(const PlaneValues& values, PartOfPlane& part) {
  if (part.edge_mm > 0.0) return;
  const auto put = [&](double PartOfPlane::*bound) {
    double before = -1e300, after = 1e300;
    for (std::size_t i = 0; i < values.um.size(); ++i) {
      const double along = part.along_mm(values.at_mm[0][i], values.at_mm[1][i]);
      if (along < part.*bound)
        before = std::max(before, along);
      else
        after = std::min(after, along);
    }
    if (before > -1e300 && after < 1e300) part.*bound = 0.5 * (before + after);
  };
  put(part.kind == PartOfPlane::kDisc ? &PartOfPlane::radius_mm : &PartOfPlane::from_mm);
  if (part.kind == PartOfPlane::kStrip) put(&PartOfPlane::to_mm);
}

/// Squares that the distance from the axis takes out: what all teeth have alike over the profile.
double square_by_radius(const PlaneValues& values, double wide_mm) {
  constexpr std::size_t kRings = 60;
  std::array<double, kRings> sum{}, count{};
  for (std::size_t i = 0; i < values.um.size(); ++i) {
    const double radius = std::hypot(values.at_mm[0][i], values.at_mm[1][i]) / wide_mm;
    const auto ring = std::min(kRings - 1, static_cast<std::size_t>(radius * kRings));
    sum[ring] += values.um[i];
    count[ring] += 1.0;
  }
  double square = 0.0;
  for (std::size_t ring = 0; ring < kRings; ++ring)
    if (count[ring] > 0.0) square += sum[ring] * sum[ring] / count[ring];
  return square;
}

}  // namespace

std::optional<LikeliestPart> likeliest_part_of_plane(const FlankGeometry& geometry,
                                                     const Observations& table,
                                                     const std::vector<float>& row_um,
                                                     const std::vector<bool>& used,
                                                     BoundsOfPart bounds) {
  const PlaneValues values = values_in_plane(geometry, table, row_um, used);
  if (values.um.size() < kFewestInPlane) return {};
  double wide_mm = 0.0;
  for (std::size_t i = 0; i < values.um.size(); ++i)
    wide_mm = std::max(wide_mm, std::hypot(values.at_mm[0][i], values.at_mm[1][i]));
  wide_mm *= 1.001;
  constexpr double kClearly = 80.0;  // chi-square within flanks
  constexpr double kAlike = 0.75, kWorthMoving = 60.0, kOffTheAxis = 0.55;
  constexpr double kMuch =
      0.3;  // of all squares: the best bounds may cross flanks, the grid's none
  std::array<PartTrial, 3> best;  // by kind
  std::vector<std::array<PartTrial, 2>> across(kDirectionsAcross);
  for_each_piece(across.size(), [&](std::size_t k) {
    across[k] = best_across(values, 180.0 * static_cast<double>(k) / kDirectionsAcross, wide_mm);
  });
  for (const auto& trials : across)
    for (const PartTrial& trial : trials) best[trial.part.kind].take(trial.part, trial.square);
  std::vector<PartTrial> about(static_cast<std::size_t>(kDiscSide) * kDiscSide);
  for_each_piece(about.size(), [&](std::size_t k) {
    const auto at = [&](std::size_t step) {
      return (2.0 * static_cast<double>(step) / (kDiscSide - 1) - 1.0) * wide_mm;
    };
    const double x_mm = at(k % kDiscSide), y_mm = at(k / kDiscSide);
    if (std::hypot(x_mm, y_mm) > kOffTheAxis * wide_mm)
      about[k] = best_about(values, x_mm, y_mm, wide_mm);
  });
  for (const PartTrial& trial : about) best[PartOfPlane::kDisc].take(trial.part, trial.square);
  double all = 0.0;
  for (const double um : values.um) all += um * um;
  const double radius_mm = geometry.reference_radius_mm();
  PartTrial chosen;
  double least = 1e300;
  for (PartTrial& trial : best) {
    if (trial.square < kWorthMoving * all / static_cast<double>(values.um.size()) ||
        (trial.square < kMuch * all &&
         !may_be_part(said_of_part(values, trial.part, true), 0.4 * kClearly, 0.5 * kAlike)))
      continue;
    move_part_to_place(values, radius_mm, trial);
    const double cost = static_cast<double>(values.um.size()) * std::log(all - trial.square) +
                        kOfABoundOfPart * trial.part.values_sought();
    if (!(cost < least)) continue;
    least = cost;
    chosen = trial;
  }
  if (!(chosen.square > square_by_radius(values, wide_mm))) return {};
  take_side_with_material(values, chosen.part);
  put_bounds_between_values(values, chosen.part);
  // Within the flanks that its bounds cross.
  SaidOfPart fit = said_of_part(values, chosen.part, true);
  fit.within_variance *= variance_times(values, fit.within_variance);
  const bool crosses = may_be_part(fit, kClearly, kAlike);
  if (!crosses && (bounds == BoundsOfPart::kCrossFlanks || chosen.part.edge_mm > 0.0 ||
                   chosen.square < kMuch * all || is_denied_within(fit, kAlike)))
    return {};
  constexpr double kLooks = 1e6;
  const double chi_square = fit.within_square / fit.within_variance;
  LikeliestPart found{chosen.part};
  if (crosses) found.p_value = std::min(1.0, kLooks * std::exp(-0.5 * chi_square));
  found.amount_um = fit.amount_um;
  found.square =
      fit.square * static_cast<double>(values.rows) / static_cast<double>(values.um.size());
  return found;
}

}  // namespace trueflank::loop
