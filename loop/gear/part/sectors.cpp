// SPDX-License-Identifier: GPL-3.0-or-later
// Some teeth side by side: what waves around the gear, single teeth and levels are made of.
#include "trueflank/loop/gear/part/sectors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/single_teeth.h"
#include "trueflank/loop/gear/remainder_around.h"

namespace trueflank::loop {
namespace {

constexpr int kFewestWavesOfSector = 2;

/// A wave around the gear that is alike all over the flanks.
bool is_wave_of_teeth(const Effect& e) {
  const NeedsToBeSeen needs = e.needs();
  return e.order() > 0.0 && !e.family->tells_order_along_profile && !needs.along_profile &&
         !needs.along_face;
}

/// On which flanks teeth stand out: both alike, both to opposite sides, or one.
struct StandingOut {
  FlankChoice flank = FlankChoice::kBoth;
  bool opposite = false;
};

/// How far each tooth stands out by what some effects say and by what is left beside all.
struct HeightOfTeeth {
  std::vector<double> sum, weight;
};

/// Teeth side by side that stand out most from the rest, of as many as half of them: first and
/// count.
std::pair<int, int> standing_out(const HeightOfTeeth& heights) {
  const auto z = static_cast<int>(heights.sum.size());
  double all = 0.0, of_all = 0.0, most = 0.0;
  for (int k = 0; k < z; ++k) {
    all += heights.sum[static_cast<std::size_t>(k)];
    of_all += heights.weight[static_cast<std::size_t>(k)];
  }
  std::pair<int, int> best{0, 0};
  for (int first = 0; first < z; ++first) {
    double inside = 0.0, of_inside = 0.0;
    for (int count = 1; count <= z / 2; ++count) {
      const auto tooth = static_cast<std::size_t>((first + count - 1) % z);
      inside += heights.sum[tooth];
      of_inside += heights.weight[tooth];
      const double of_outside = of_all - of_inside;
      if (count < 2 || !(of_inside > 0.0) || !(of_outside > 0.0)) continue;
      const double step = inside / of_inside - (all - inside) / of_outside;
      const double square = step * step * of_inside * of_outside / of_all;
      if (!(square > most)) continue;
      most = square;
      best = {first + 1, count};
    }
  }
  return best;
}

/// Drifts of heights, or of teeth that stand aside, from every tooth on: even ones, and those that
/// level off or grow, about their mean or from or to nothing.
std::vector<std::vector<Effect>> drifts_from_every_tooth(const FlankGeometry& geometry,
                                                         FlankChoice flank, double opposite) {
  constexpr double kNearlyEven = 1.5;  // of the teeth
  std::vector<std::vector<Effect>> drifts(2);
  for (int first = 1; first <= geometry.teeth(); ++first) {
    drifts[0].push_back({find_family("unnamed_ramp"),
                         flank,
                         {double(first), 0.0, 0.0, opposite, gear_effects::kMeanOfDrift}});
    for (const double zero : {gear_effects::kFirstOfDrift, gear_effects::kLastOfDrift})
      for (const double share : {0.1, 0.25, 0.5, kNearlyEven})
        for (const double grows : {0.0, 1.0})
          if (grows == 0.0 || share < kNearlyEven)
            drifts[1].push_back(
                {find_family("unnamed_levelling"),
                 flank,
                 {double(first), 0.0, 0.0, opposite, grows, share * geometry.teeth(), zero}});
  }
  return drifts;
}

/// What stands on one tooth that is not near the edges of a sector.
bool is_far_from_edges(const FlankGeometry& geometry, const Effect& effect, const Effect& sector) {
  constexpr double kNear = 3.0;  // teeth
  if (!effect.family->local && !effect.family->is_of_one_tooth) return false;
  const double middle = sector.shape[0] + 0.5 * (sector.shape[1] - 1.0);
  const double off = std::abs(std::remainder(effect.shape[0] - middle, geometry.teeth()));
  return std::abs(off - 0.5 * sector.shape[1]) > std::max(kNear, sector.shape[1] / kNear);
}

/// How far each patch of a flank stands out by what these effects say and by what is left beside
/// all; NaN for other patches.
std::vector<double> heights_of_patches(PartModel& model, const std::vector<std::size_t>& these) {
  const auto fit = fit_of(model, model.effects);
  std::vector<Effect> own;
  for (const std::size_t e : these) own.push_back(model.effects[e]);
  const DiscoveryProblem problem = make_problem(model.geometry, model.table, model.patches, own);
  Eigen::VectorXd height = Eigen::VectorXd::Zero(problem.candidates.rows());
  for (std::size_t i = 0; i < these.size(); ++i)
    height += problem.candidates.middleCols(problem.groups[i].first_column, own[i].columns())
                  .cast<double>() *
              fit->coefficients().segment(fit->first_column(static_cast<int>(these[i])),
                                          own[i].columns());
  std::vector<double> left(model.patches.patches.size(), 0.0), count(left);
  const auto row_um = fit->residuals_um();
  for (std::size_t row = 0; row < row_um->size(); ++row)
    if (const int patch = model.patches.patch_of_row[row]; patch >= 0) {
      left[static_cast<std::size_t>(patch)] += (*row_um)[row];
      count[static_cast<std::size_t>(patch)] += 1.0;
    }
  for (std::size_t p = 0; p < left.size(); ++p) {
    const ObservationKind kind = model.patches.patches[p].kind;
    const bool flank = kind == ObservationKind::kScanFlank || kind == ObservationKind::kIndex;
    left[p] =
        flank && count[p] > 0.0 ? height[static_cast<Eigen::Index>(p)] + left[p] / count[p] : kNaN;
  }
  return left;
}

HeightOfTeeth heights_of_teeth(const PartModel& model, const std::vector<double>& of_patches,
                               const StandingOut& out) {
  const auto z = static_cast<std::size_t>(model.geometry.teeth());
  HeightOfTeeth heights{std::vector<double>(z, 0.0), std::vector<double>(z, 0.0)};
  for (std::size_t p = 0; p < of_patches.size(); ++p) {
    const Patches::Patch& patch = model.patches.patches[p];
    const Place& place = patch.places.front().place;
    const bool here = out.flank == FlankChoice::kBoth ||
                      out.flank == flank_choice(model.geometry, place.side > 0 ? 1 : 0);
    if (!here || std::isnan(of_patches[p])) continue;
    const auto tooth = static_cast<std::size_t>(place.tooth - 1);
    heights.sum[tooth] += patch.weight * of_patches[p] * (out.opposite ? place.side : 1);
    heights.weight[tooth] += patch.weight;
  }
  return heights;
}

/// The flank that has nearly all of what differs from tooth to tooth; both where each has some.
FlankChoice flank_that_differs(const PartModel& model, const std::vector<double>& of_patches) {
  constexpr double kLittle = 0.25;  // of the squares
  const auto squares = [&](FlankChoice flank) {
    const HeightOfTeeth heights = heights_of_teeth(model, of_patches, {.flank = flank});
    double sum = 0.0, square = 0.0, weight = 0.0;
    for (std::size_t k = 0; k < heights.sum.size(); ++k) {
      if (!(heights.weight[k] > 0.0)) continue;
      sum += heights.sum[k];
      square += heights.sum[k] * heights.sum[k] / heights.weight[k];
      weight += heights.weight[k];
    }
    return weight > 0.0 ? square - sum * sum / weight : kNaN;
  };
  const double left = squares(FlankChoice::kLeft), right = squares(FlankChoice::kRight);
  return right < kLittle * left   ? FlankChoice::kLeft
         : left < kLittle * right ? FlankChoice::kRight
                                  : FlankChoice::kBoth;
}

/// These heights without the eccentricity that the patches of one side show.
std::vector<double> without_eccentricity(const PartModel& model, std::vector<double> heights,
                                         const Effect& eccentricity, int side) {
  const auto columns_at = [&](std::size_t p) {
    Eigen::Vector3d columns(1.0, 0.0, 0.0);
    eccentricity.evaluate(model.geometry, model.patches.patches[p].places.front().place,
                          columns.data() + 1);
    return columns;
  };
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t p = 0; p < heights.size(); ++p) {
    const Patches::Patch& patch = model.patches.patches[p];
    if (std::isnan(heights[p]) || patch.places.front().place.side != side) continue;
    const Eigen::Vector3d columns = columns_at(p);
    normal += patch.weight * columns * columns.transpose();
    right += patch.weight * heights[p] * columns;
  }
  const Eigen::Vector3d shown = normal.ldlt().solve(right);
  if (!shown.allFinite()) return heights;
  for (std::size_t p = 0; p < heights.size(); ++p)
    if (!std::isnan(heights[p])) heights[p] -= columns_at(p).tail<2>().dot(shown.tail<2>());
  return heights;
}

/// The heights that some effects have, and the flank that differs. An eccentricity may have taken
/// up a part of what one flank has, and waves on the other flank the opposite: then these are the
/// heights beside the eccentricity that the other flank shows.
std::pair<std::vector<double>, FlankChoice> heights_and_flank(
    PartModel& model, const std::vector<std::size_t>& these,
    const std::vector<std::size_t>& off_axis) {
  std::vector<double> own = heights_of_patches(model, these);
  const FlankChoice flank = flank_that_differs(model, own);
  if (flank != FlankChoice::kBoth || off_axis.empty()) return {std::move(own), flank};
  std::vector<std::size_t> all = these;
  all.insert(all.end(), off_axis.begin(), off_axis.end());
  const std::vector<double> together = heights_of_patches(model, all);
  for (const int side : {1, -1}) {
    std::vector<double> beside =
        without_eccentricity(model, together, model.effects[off_axis.front()], side);
    const FlankChoice of_all = flank_that_differs(model, beside);
    if (of_all == flank_choice(model.geometry, side > 0 ? 0 : 1))
      return {std::move(beside), of_all};
  }
  return {std::move(own), FlankChoice::kBoth};
}

/// The sector that follows best how far teeth stand out, and swellings about its middle; none where
/// none do.
std::vector<Effect> sectors_of_heights(const HeightOfTeeth& heights, const StandingOut& out) {
  const auto [first, teeth] = standing_out(heights);
  if (teeth < 2) return {};
  std::vector<Effect> forms{{find_family("unnamed_sector"),
                             out.flank,
                             {double(first), double(teeth), 0.0, 0.0, out.opposite ? 1.0 : 0.0}}};
  if (out.opposite) return forms;
  for (double middle = -1.0; middle <= 1.0; middle += 0.5)
    for (double half = 0.3; half < 1.0; half *= 1.15)
      forms.push_back({find_family("unnamed_dent"),
                       out.flank,
                       {first + 0.5 * (teeth - 1) + middle, half * teeth, 0.0, 0.0}});
  return forms;
}

/// The answer with a sector that begins and ends over some teeth, the last, in place of these
/// effects, where it says as much: the teeth at its edges stand between. A sharp one where that
/// follows nearly as well. Empty where none does.
std::vector<Effect> with_soft_sector(const PartModel& model, const std::vector<std::size_t>& these,
                                     const Effect& sector) {
  constexpr double kClearly = 9.0, kValue = 6.0;  // chi-square
  constexpr int kPlacesOfSector = 2;
  std::vector<Effect> others, own;
  int values = 0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const bool is_own = std::find(these.begin(), these.end(), e) != these.end();
    (is_own ? own : others).push_back(model.effects[e]);
    // Where a sector begins and ends was sought, too.
    if (is_own && model.effects[e].family == sector.family) values += kPlacesOfSector;
  }
  values += values_of(own, true);
  std::vector<Effect> forms;
  for (const double edge : {1.0, 2.0, 4.0, 8.0})
    if (edge <= sector.shape[1])
      forms.push_back({find_family("unnamed_soft_sector"),
                       sector.flank,
                       {sector.shape[0] + 0.5 * (sector.shape[1] - 1.0), sector.shape[1], edge,
                        sector.shape[4]}});
  // Most of what waves are is no sector: then its edges are not sought.
  constexpr double kOnTheGrid = 0.6;
  const double now = fit_of(model, model.effects)->residual_square(),
               none = std::max(0.0, fit_of(model, others)->residual_square() - now);
  std::vector<Effect> with = with_best_form(
      model, others, forms, {.on_the_grid = now + kValue * values + (1.0 - kOnTheGrid) * none});
  if (with.empty()) return {};
  double gain = now - fit_of(model, with)->residual_square();
  int spared = values - values_of({with.back()}, true);
  std::vector<Effect> sharp = with_best_form(model, others, {sector}, {});
  if (!sharp.empty()) {
    const double of_sharp = now - fit_of(model, sharp)->residual_square();
    if (gain - of_sharp < kClearly + kValue) {
      with = std::move(sharp);
      gain = of_sharp;
      spared = values - values_of({sector}, true) - kPlacesOfSector;
    }
  }
  if (spared < 0 || gain < kClearly - kValue * spared) return {};
  const double left = fit_of(model, with)->residual_square();
  for (const std::vector<Effect>& drifts :
       drifts_from_every_tooth(model.geometry, sector.flank, sector.shape[4])) {
    const std::vector<Effect> drift = with_best_form(model, others, drifts, {});
    if (!drift.empty() && fit_of(model, drift)->residual_square() < left) return {};
  }
  return with;
}

/// A sector, or a swelling about its middle, for these effects: the one with sharp edges where that
/// says as much. Of what stands on single teeth one with soft edges is tried for what is at these.
std::vector<Effect> with_sector_for(PartModel& model, std::vector<std::size_t>& these,
                                    const std::vector<Effect>& forms) {
  constexpr double kEdges = 16.0, kClearly = 9.0;  // where a sharp one begins and ends; chi-square
  if (forms.empty()) return {};
  std::vector<std::size_t> with_edges = these, sharp = these;
  std::erase_if(with_edges, [&](std::size_t e) {
    return is_far_from_edges(model.geometry, model.effects[e], forms[0]);
  });
  std::erase_if(sharp, [&](std::size_t e) { return model.effects[e].family->is_of_one_tooth; });
  std::vector<Effect> hard;
  if (sharp.size() > 1) hard = one_form_for(model, sharp, forms);
  std::vector<Effect> soft = with_soft_sector(model, with_edges, forms[0]);
  if (!soft.empty() &&
      (hard.empty() || cost_of(model, soft) < cost_of(model, hard) + kEdges - kClearly)) {
    these = std::move(with_edges);
    return soft;
  }
  these = std::move(sharp);
  return hard;
}

/// A run of effects on neighbouring teeth: which, the first tooth, how many teeth it spans.
struct RunOfTeeth {
  std::vector<std::size_t> effects;
  int first = 0, count = 0;
};

/// The longest run with at most one tooth left out in a row. Effects by their tooth, in order.
RunOfTeeth longest_run(const std::vector<std::pair<int, std::size_t>>& teeth, int z) {
  RunOfTeeth best;
  for (std::size_t from = 0; from < teeth.size(); ++from) {
    RunOfTeeth run{{teeth[from].second}, teeth[from].first, 1};
    for (std::size_t i = 1; i < teeth.size(); ++i) {
      const auto& [tooth, effect] = teeth[(from + i) % teeth.size()];
      const int count = (tooth - run.first + z) % z + 1;
      if (count - run.count > 2) break;
      run.count = count;
      run.effects.push_back(effect);
    }
    if (run.effects.size() > best.effects.size()) best = std::move(run);
  }
  return best;
}

/// The swelling or sector that says best what some single teeth say, if it leaves little of it;
/// where the teeth leave nothing that others share, if it says as much for its values.
std::optional<Effect> form_of_teeth(const PartModel& model, const std::vector<Effect>& rest,
                                    FlankChoice flank, int first, int count) {
  constexpr double kNearly = 0.1, kNothing = 9.0;                // chi-square
  constexpr double kValuesOfForm = 3.0;                          // a place, a width, a height
  const auto teeth = static_cast<double>(model.effects.size() - rest.size());
  std::vector<Effect> tried{
      {find_family("unnamed_sector"), flank, {double(first), double(count), 0.0, 0.0, 0.0}}};
  for (double middle = -1.0; middle <= 1.0; middle += 0.5)
    for (double half = 0.3; half < 1.0; half *= 1.3)
      tried.push_back({find_family("unnamed_dent"),
                       flank,
                       {first + 0.5 * (count - 1) + middle, half * count, 0.0, 0.0}});
  std::vector<Effect> with = rest;
  with.emplace_back();
  Effect best;
  double least = 1e300;
  const auto try_all = [&](const std::vector<Effect>& forms) {
    for (const Effect& form : forms) {
      with.back() = form;
      const double left =
          PointFit(model.geometry, model.table, model.patches, with).residual_square();
      if (left >= least) continue;
      least = left;
      best = form;
    }
  };
  try_all(tried);
  if (best.family == find_family("unnamed_dent")) {
    const Effect about = best;
    tried.clear();
    for (const double middle : {-0.25, -0.1, 0.0, 0.1, 0.25})
      for (const double wider : {0.85, 0.93, 1.0, 1.08, 1.17}) {
        tried.push_back(about);
        tried.back().shape[0] += middle;
        tried.back().shape[1] *= wider;
      }
    try_all(tried);
  }
  with.back() = best;
  const double all = fit_of(model, model.effects)->residual_square();
  if (least > all + kNearly * (fit_of(model, rest)->residual_square() - all) ||
      (least > all + kNothing + kChiSquareOfValue * (teeth - kValuesOfForm) &&
       !is_shared(model, shared_beside(model, model.effects))))
    return {};
  return best;
}

/// Beside a dent or swelling of a few teeth, a form of some, or a tooth that stands aside, a single
/// tooth is what these leave.
void tell_teeth_beside_dents(PartModel& model) {
  constexpr double kBeside = 1.5;  // teeth
  const int z = model.geometry.teeth();
  const EffectFamily *dent = find_family("unnamed_dent"),
                     *aside = find_family("unnamed_tooth_aside");
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const EffectFamily* form = form_instead(model, e);
    if (form == nullptr || !model.effects[e].family->local) continue;
    const bool beside =
        std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& other) {
          const bool of_some = gear_effects::is_of_teeth(other);
          if (other.family != dent && other.family != aside && !of_some) return false;
          const double half = of_some                ? 0.5 * (other.shape[1] - 1.0)
                              : other.family == dent ? other.shape[1]
                                                     : 0.0;
          const double middle = other.shape[0] + (of_some ? half : 0.0);
          return std::abs(std::remainder(middle - model.effects[e].shape[0], z)) < kBeside + half;
        });
    if (beside) model.effects[e].family = form;
  }
}

/// A form for a run of single teeth that goes through one of them; true where they are told as
/// that.
bool tell_run_of_teeth(PartModel& model, std::size_t one) {
  constexpr std::size_t kFewest = 3;
  if (!model.effects[one].family->local) return false;
  const auto fit = fit_of(model, model.effects);
  const auto height = [&](std::size_t e) {
    return fit->coefficients()[fit->first_column(static_cast<int>(e))];
  };
  std::vector<std::pair<int, std::size_t>> teeth;
  for (std::size_t e = one; e < model.effects.size(); ++e)
    if (model.effects[e].family == model.effects[one].family &&
        model.effects[e].flank == model.effects[one].flank && height(e) * height(one) > 0.0)
      teeth.emplace_back(static_cast<int>(model.effects[e].shape[0]), e);
  std::sort(teeth.begin(), teeth.end());
  RunOfTeeth run = longest_run(teeth, model.geometry.teeth());
  if (run.effects.size() < kFewest) return false;
  std::sort(run.effects.rbegin(), run.effects.rend());
  std::vector<Effect> rest = model.effects;
  for (const std::size_t e : run.effects) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
  const std::optional<Effect> form =
      form_of_teeth(model, rest, model.effects[one].flank, run.first, run.count);
  if (!form) {
    for (const std::size_t e : run.effects)
      if (const EffectFamily* height_of_tooth = form_instead(model, e))
        model.effects[e].family = height_of_tooth;
    return false;
  }
  ChosenGroup record;
  record.group = -1;
  record.p_value = model.discovery.chosen[one].p_value;
  for (const std::size_t e : run.effects) {
    record.p_value = std::min(record.p_value, model.discovery.chosen[e].p_value);
    remove_effect(model, e);
  }
  model.effects.push_back(*form);
  model.discovery.chosen.push_back(record);
  return true;
}

/// True of what is on teeth near the ends of a run alone.
bool is_at_the_ends(const FlankGeometry& geometry, const Effect& effect, double first,
                    double count) {
  constexpr double kNear = 1.6, kSeen = 0.15;  // teeth; of what it is at most
  constexpr int kPlaces = 5;
  if (effect.columns() != 1) return false;
  const double z = geometry.teeth(), low = geometry.root_form_roll_mm(),
               high = geometry.tip_form_roll_mm();
  double near = 0.0, far = 0.0;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    const double off = std::min(std::abs(std::remainder(tooth - (first - 0.5), z)),
                                std::abs(std::remainder(tooth - (first + count - 0.5), z)));
    double& most = off < kNear ? near : far;
    for (const int side : {-1, 1})
      for (int u = 0; u < kPlaces; ++u)
        for (int v = 0; v < kPlaces; ++v) {
          double value = 0.0;
          effect.evaluate(geometry,
                          geometry.on_flank(tooth, side, low + (u + 0.5) / kPlaces * (high - low),
                                            (v + 0.5) / kPlaces * geometry.face_width_mm()),
                          &value);
          most = std::max(most, std::abs(value));
        }
  }
  return near > 0.0 && far < kSeen * near;
}

}  // namespace

bool tell_as_sector(PartModel& model) {
  std::vector<std::size_t> these;
  const std::vector<Effect> with = with_sector(model, these);
  if (with.empty()) return false;
  put_in_place_of(model, these, with);
  return true;
}

std::vector<Effect> with_sector(PartModel& model, std::vector<std::size_t>& these) {
  const EffectFamily* sector_family = find_family("unnamed_sector");
  std::vector<std::size_t> waves, moved, levels, teeth, off_axis;
  std::vector<Effect> sectors;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if ((effect.family->local && effect.columns() == 1) || effect.family->is_of_one_tooth) {
      teeth.push_back(e);
    } else if (effect.family == sector_family && effect.shape[2] == 0.0 && effect.shape[3] == 0.0) {
      waves.push_back(e);
      sectors.push_back(effect);
    } else if (effect.family == find_family("unnamed_dent") && effect.shape[3] == 0.0) {
      waves.push_back(e);
    } else if (is_wave_of_teeth(effect)) {
      (effect.family->displacement_mm ? moved : waves).push_back(e);
    } else if (moves_the_teeth(effect)) {
      off_axis.push_back(e);
    } else if (runs_of(model.geometry, effect) == Runs::kNowhere) {
      levels.push_back(e);
    }
  }
  if (sectors.empty() && static_cast<int>(waves.size()) < kFewestWavesOfSector) return {};
  const bool drifts =
      std::any_of(model.effects.begin(), model.effects.end(), [](const Effect& effect) {
        return (effect.family == find_family("unnamed_ramp") ||
                effect.family == find_family("unnamed_levelling")) &&
               effect.shape[1] == 0.0 && effect.shape[2] == 0.0;
      });
  using Some = std::vector<std::vector<std::size_t>>;
  std::vector<std::size_t> before;
  for (const Some& with :
       {Some{moved, levels, teeth}, Some{levels, teeth}, Some{teeth}, Some{levels}, Some{}}) {
    std::vector<std::size_t> set = waves;
    for (const std::vector<std::size_t>& more : with)
      set.insert(set.end(), more.begin(), more.end());
    std::sort(set.begin(), set.end());
    if (set == before) continue;
    before = set;
    const auto [heights, flank] = heights_and_flank(model, set, off_axis);
    std::vector<StandingOut> outs{{}, {.opposite = true}};
    // (waves beside a drift are what that leaves of another)
    if (flank != FlankChoice::kBoth && !drifts) outs.insert(outs.begin(), {.flank = flank});
    for (const StandingOut& out : outs) {
      these = set;
      std::vector<Effect> with_one = with_sector_for(
          model, these, sectors_of_heights(heights_of_teeth(model, heights, out), out));
      if (!with_one.empty()) return with_one;
    }
  }
  return {};
}

bool tell_as_moved_part(PartModel& model) {
  constexpr int kMoreValues = 2, kSteps = 6;  // of an end, a sixth of a pitch each
  const EffectFamily *teeth = find_family("unnamed_moved_sector"),
                     *part = find_family("unnamed_moved_part");
  if (model.table->points_mm.empty()) return false;
  const double pitch_deg = 360.0 / model.geometry.teeth(),
               first_deg = deg_from_rad(model.geometry.centre_rad(1));
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& moved = model.effects[e];
    if (moved.family != teeth && moved.family != part) continue;
    const bool by_teeth = moved.family == teeth;
    const double first = by_teeth ? moved.shape[0] : (moved.shape[0] - first_deg) / pitch_deg + 1.5,
                 count = by_teeth ? moved.shape[1] : moved.shape[1] / pitch_deg;
    std::vector<std::size_t> with_ends;
    for (std::size_t other = first_told_here(model); other < model.effects.size(); ++other)
      if (other == e || is_at_the_ends(model.geometry, model.effects[other], first, count))
        with_ends.push_back(other);
    // (an edge through teeth leaves something on these)
    if (with_ends.size() == 1) continue;
    const double from_deg = first_deg + (first - 1.5) * pitch_deg, over_deg = count * pitch_deg,
                 step_deg = pitch_deg / kSteps;
    std::vector<Effect> forms;
    for (int before = -kSteps; before <= kSteps; ++before)
      for (int after = -kSteps; after <= kSteps; ++after)
        forms.push_back({part,
                         FlankChoice::kBoth,
                         {from_deg - before * step_deg, over_deg + (before + after) * step_deg}});
    if (put_one_form_for(model, with_ends, forms, {}, kMoreValues)) return true;
  }
  return false;
}

void tell_teeth_side_by_side(PartModel& model) {
  // (what stood before the first of a run has moved up when the run is told)
  for (std::size_t one = model.options.given.size(); one < model.effects.size();)
    one = tell_run_of_teeth(model, one) ? model.options.given.size() : one + 1;
  tell_teeth_beside_dents(model);
}

}  // namespace trueflank::loop
