// SPDX-License-Identifier: GPL-3.0-or-later
// One tooth, or one gap, was told in pieces: heights and leans of its flanks. Where one form of the
// whole says as much within the error, it is that.
#include "trueflank/loop/gear/part/single_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/effects/one_tooth.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/fit/trial_fit.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

/// A height, a lean or a bow of one tooth, or of one flank of it.
bool is_piece_of_tooth(const Effect& effect) {
  const EffectFamily* family = effect.family;
  return family == find_family("unnamed_tooth_form") || family == find_family("unnamed_flank") ||
         family == find_family("unnamed_tooth_aside") || family == find_family("single_tooth");
}

bool is_flank_of_tooth(const Effect& effect) {
  return effect.family == find_family("unnamed_flank");
}

/// What the effects leave without these, and the form that leaves least in their place.
struct InPlaceOf {
  double none = 0.0, with = 1e300;
  Effect form;
};

InPlaceOf best_in_place_of(const PartModel& model, const std::vector<std::size_t>& these,
                           const std::vector<Effect>& forms) {
  constexpr double kSimpler = 4.0;  // chi-square that the first of the forms may leave more
  std::vector<Effect> others;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) others.push_back(model.effects[e]);
  InPlaceOf best;
  best.none = fit_of(model, others)->residual_square();
  others.emplace_back();
  for (std::size_t first = 0; first < forms.size();) {
    std::vector<EffectShape> shapes;
    std::size_t next = first;
    for (; next < forms.size() && forms[next].family == forms[first].family &&
           forms[next].flank == forms[first].flank;
         ++next)
      if (is_within_reach(model, forms[next])) shapes.push_back(forms[next].shape);
    others.back() = forms[first];
    first = next;
    if (shapes.empty()) continue;
    const TrialFit fit(model.geometry, model.table, model.patches, others);
    const auto trials = fit.with_shapes(others.size() - 1, shapes, 1e300);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (trials[i].retained < kToldApart ||
          !(trials[i].square < best.with - (best.form.family != nullptr ? kSimpler : 0.0)))
        continue;
      best.with = trials[i].square;
      best.form = others.back();
      best.form.shape = shapes[i];
    }
  }
  return best;
}

/// True where one of the forms says as much as these pieces: it is put in their place. Several
/// pieces need no more than not to be contradicted; one piece is what it is unless the form leaves
/// less.
bool tell_in_place_of(PartModel& model, const std::vector<std::size_t>& these,
                      const std::vector<Effect>& forms) {
  constexpr double kByChance = 1e-3, kClearly = 6.0;  // of chi-square
  constexpr double kNearly = 0.003;                   // of what the pieces take out
  int spared = -1;
  for (const std::size_t e : these) spared += model.effects[e].columns();
  if (spared < 0) return false;
  const double now = fit_of(model, model.effects)->residual_square();
  const InPlaceOf best = best_in_place_of(model, these, forms);
  if (best.form.family == nullptr) return false;
  const double loss = best.with - now;
  if (spared == 0 ? !(loss < -kClearly)
                  : loss > kNearly * (best.none - now) &&
                        minus_log_chi_square_tail(loss, spared) > -std::log(kByChance))
    return false;
  std::vector<Effect> with;
  for (std::size_t e = 0; e < model.effects.size(); ++e)
    if (std::find(these.begin(), these.end(), e) == these.end()) with.push_back(model.effects[e]);
  with.push_back(best.form);
  put_in_place_of(model, these, with);
  return true;
}

/// The pieces told here for which `is_asked` holds.
template <class IsAsked>
std::vector<std::size_t> pieces_of_a_tooth(const PartModel& model, const IsAsked& is_asked) {
  std::vector<std::size_t> these;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (is_piece_of_tooth(model.effects[e]) && is_asked(model.effects[e])) these.push_back(e);
  return these;
}

/// True where a form of some teeth is told at, or beside, one of the two teeth of a gap: its walls
/// may be parts of that.
bool is_beside_form_of_teeth(const PartModel& model, int gap) {
  const int z = model.geometry.teeth();
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (!gear_effects::is_of_teeth(effect)) continue;
    const int first = static_cast<int>(effect.shape[0]), count = static_cast<int>(effect.shape[1]);
    for (int k = -1; k <= count + 1; ++k)
      if ((first - 1 + k + z) % z + 1 == gap || (first - 1 + k + z) % z + 1 == gap % z + 1)
        return true;
  }
  return false;
}

/// How far the walls of a gap stand out without some effects, the counter-clockwise side of the
/// lower tooth first: the mean of what was measured on these flanks alone.
std::array<double, 2> walls_without(const PartModel& model, int gap,
                                    const std::vector<std::size_t>& these) {
  const auto row_um = fit_of(model, without(model.effects, these))->residuals_um();
  std::array<double, 2> sum{}, count{};
  for (std::size_t i = 0; i < model.table->rows.size(); ++i) {
    const Observation& row = model.table->rows[i];
    const Place& place = model.table->place(row);
    if (row.kind == ObservationKind::kRadial || row.kind == ObservationKind::kSize ||
        place.surface != Surface::kFlank)
      continue;
    const std::size_t wall = place.side > 0 ? 0 : 1;
    if (place.tooth != (wall == 0 ? gap : gap % model.geometry.teeth() + 1)) continue;
    sum[wall] += (*row_um)[i];
    count[wall] += 1.0;
  }
  return {count[0] > 0.0 ? sum[0] / count[0] : 0.0, count[1] > 0.0 ? sum[1] / count[1] : 0.0};
}

bool tell_gap(PartModel& model) {
  const int z = model.geometry.teeth();
  const FlankChoice counter_clockwise = flank_choice(model.geometry, 1);
  std::set<int> gaps;
  for (const std::size_t e : pieces_of_a_tooth(model, is_flank_of_tooth)) {
    const int tooth = static_cast<int>(model.effects[e].shape[0]);
    gaps.insert(model.effects[e].flank == counter_clockwise ? tooth : (tooth + z - 2) % z + 1);
  }
  for (const int gap : gaps) {
    const std::vector<std::size_t> walls = pieces_of_a_tooth(model, [&](const Effect& effect) {
      const int tooth = effect.flank == counter_clockwise ? gap : gap % z + 1;
      return is_flank_of_tooth(effect) && static_cast<int>(effect.shape[0]) == tooth;
    });
    const bool of_scans = !model.table->points_mm.empty();
    if (of_scans && (walls.size() < 2 || is_beside_form_of_teeth(model, gap))) continue;
    std::vector<Effect> forms;
    // (of one wall that stands out: the other must do so, too; runout that denies the wall is none)
    constexpr double kAlike = 0.35;
    const auto without = walls_without(model, gap, walls);
    const auto is_borne_out = [&](double sign) {
      const auto& [lower, upper] = without;
      return walls.size() > 1 ||
             sign * lower * upper > kAlike * std::max(lower * lower, upper * upper);
    };
    for (const double opposite : {0.0, 1.0})
      if (is_borne_out(opposite != 0.0 ? -1.0 : 1.0))
        forms.push_back(
            {find_family("unnamed_gap"), FlankChoice::kBoth, {static_cast<double>(gap), opposite}});
    if (forms.empty()) continue;
    if (tell_in_place_of(model, walls, forms)) return true;
  }
  return false;
}

/// A spot, a form of one tooth or of a few neighbouring ones, by its first tooth and how many;
/// nothing of others.
struct PieceOfPatch {
  std::size_t effect = 0;
  int first = 0, count = 0;
  double diameter_mm = kNaN, height_mm = kNaN;  ///< NaN: it has no such place
};

std::vector<PieceOfPatch> pieces_of_patches(const PartModel& model, FlankChoice flank) {
  constexpr int kFew = 5;
  const EffectFamily *spot = find_family("unnamed_spot"),
                     *dish = find_family("unnamed_dish_of_teeth");
  std::vector<PieceOfPatch> pieces;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != flank) continue;
    PieceOfPatch piece{.effect = e, .first = 1, .count = 1};
    if (effect.family == spot)
      piece.diameter_mm = effect.shape[1], piece.height_mm = effect.shape[2];
    else if (effect.family == dish)
      piece.diameter_mm = effect.shape[3], piece.height_mm = effect.shape[4];
    else if (!gear_effects::is_of_teeth(effect) && !is_piece_of_tooth(effect))
      continue;
    piece.first = static_cast<int>(effect.shape[0]);
    if (gear_effects::is_of_teeth(effect)) piece.count = static_cast<int>(effect.shape[1]);
    if (piece.count <= kFew) pieces.push_back(piece);
  }
  return pieces;
}

/// Spots of neighbouring teeth, and what else a few teeth of these have, are one swelling that dies
/// away over them.
bool tell_patch(PartModel& model) {
  const int z = model.geometry.teeth();
  for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
    const std::vector<PieceOfPatch> pieces = pieces_of_patches(model, flank);
    std::set<std::size_t> asked;
    for (const PieceOfPatch& begin : pieces) {
      if (std::isnan(begin.diameter_mm) || asked.count(begin.effect) > 0) continue;
      // All that is joined to it, tooth by tooth, with at most one left out between two.
      std::set<int> teeth;
      std::vector<PieceOfPatch> joined;
      const auto is_near = [&](const PieceOfPatch& piece) {
        for (int k = -2; k < piece.count + 2; ++k)
          if (teeth.count((piece.first - 1 + k + 2 * z) % z + 1) > 0) return true;
        return false;
      };
      const auto join = [&](const PieceOfPatch& piece) {
        joined.push_back(piece);
        asked.insert(piece.effect);
        for (int k = 0; k < piece.count; ++k) teeth.insert((piece.first - 1 + k) % z + 1);
      };
      join(begin);
      for (bool more = true; more;) {
        more = false;
        for (const PieceOfPatch& piece : pieces) {
          const bool is_in = std::any_of(joined.begin(), joined.end(), [&](const auto& one) {
            return one.effect == piece.effect;
          });
          if (is_in || !is_near(piece)) continue;
          join(piece);
          more = true;
        }
      }
      if (teeth.size() < 2 || joined.size() < 2) continue;
      const auto fit = fit_of(model, model.effects);
      std::stable_sort(joined.begin(), joined.end(), [&](const auto& a, const auto& b) {
        return fit->effect_size_um(static_cast<int>(a.effect)) >
               fit->effect_size_um(static_cast<int>(b.effect));
      });
      constexpr int kMostPlaces = 3;
      int places = 0;
      std::vector<Effect> forms;
      std::vector<std::size_t> these;
      for (const PieceOfPatch& piece : joined) {
        these.push_back(piece.effect);
        if (std::isnan(piece.diameter_mm) || ++places > kMostPlaces) continue;
        for (EffectShape& shape :
             gear_effects::patches_about(model.geometry, piece.first + 0.5 * (piece.count - 1),
                                         piece.diameter_mm, piece.height_mm))
          forms.push_back({find_family("unnamed_swelling_over_teeth"), flank, std::move(shape)});
      }
      std::sort(these.begin(), these.end());
      if (put_one_form_for(model, these, forms)) return true;
    }
  }
  return false;
}

bool tell_tooth(PartModel& model) {
  std::set<int> teeth;
  for (const std::size_t e : pieces_of_a_tooth(model, [](const Effect&) { return true; }))
    teeth.insert(static_cast<int>(model.effects[e].shape[0]));
  for (const int tooth : teeth) {
    const auto forms = [&](FlankChoice flank) {
      std::vector<Effect> all;
      for (EffectShape& shape :
           gear_effects::shapes_of_bent_tooth(tooth, flank == FlankChoice::kBoth))
        all.push_back({find_family("unnamed_bent_tooth"), flank, std::move(shape)});
      return all;
    };
    const std::vector<std::size_t> all = pieces_of_a_tooth(
        model, [&](const Effect& effect) { return static_cast<int>(effect.shape[0]) == tooth; });
    if (tell_in_place_of(model, all, forms(FlankChoice::kBoth))) return true;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      std::vector<std::size_t> own = all;
      std::erase_if(own, [&](std::size_t e) { return model.effects[e].flank != flank; });
      if (own.size() > 1 && tell_in_place_of(model, own, forms(flank))) return true;
    }
  }
  return false;
}

}  // namespace

void tell_one_tooth_or_gap(PartModel& model) {
  if (model.options.joined || model.table->rows.empty()) return;
  constexpr int kMost = 6;
  for (int taken = 0; taken < kMost && (tell_gap(model) || tell_patch(model) || tell_tooth(model));
       ++taken) {
  }
}

}  // namespace trueflank::loop
