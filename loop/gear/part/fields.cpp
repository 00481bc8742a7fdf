// SPDX-License-Identifier: GPL-3.0-or-later
// Names and waves around the gear that are parts of one thing: of a field in the plane, of what
// hangs on the direction that a flank faces, of waves over the profile that change sign, of bows
// that come and go once around.
#include "trueflank/loop/gear/part/fields.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/products/likeliest_products.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/whole_forms.h"

namespace trueflank::loop {
namespace {

constexpr double kMiddle = 0.5, kEnd = 1.0;  // of profile and face

/// What an effect does in the middle of the profile at a height of every tooth's flanks.
Eigen::VectorXd around(const FlankGeometry& geometry, const PointFit& fit, std::size_t e,
                       double height) {
  const Effect& effect = fit.effects()[e];
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  Eigen::VectorXd values(2 * geometry.teeth()), columns(effect.columns());
  const auto b =
      fit.coefficients().segment(fit.first_column(static_cast<int>(e)), effect.columns());
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {0, 1}) {
      const Place place = geometry.on_flank(tooth, side == 0 ? 1 : -1, low + kMiddle * (high - low),
                                            height * geometry.face_width_mm());
      effect.evaluate(geometry, place, columns.data());
      values[2 * (tooth - 1) + side] = columns.dot(b);
    }
  return values;
}

/// True for a wave of the teeth of such an order that runs neither over profile nor face.
bool is_level_of_order(const Effect& effect, double order) {
  const NeedsToBeSeen needs = effect.needs();
  return effect.order() == order && effect.columns() == 2 && !needs.along_profile &&
         !needs.along_face;
}

/// Waves over the profile (0) or the face (1) whose sign changes from tooth to tooth.
std::vector<Effect> alternating_waves(int teeth, FlankChoice flank, int face) {
  std::vector<Effect> waves;
  for (double over = 0.5; over < 6.0; over += 0.1)
    waves.push_back({find_family("unnamed_marks"),
                     flank,
                     {face == 0 ? over : 0.0, face == 0 ? 0.0 : over, 0.5 * teeth}});
  return waves;
}

}  // namespace

bool tell_as_field(PartModel& model) {
  std::vector<std::size_t> all;
  std::set<double> orders;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const double order = moves_the_teeth(effect) ? 1.0 : effect.order();
    if (effect.flank != FlankChoice::kBoth || effect.needs().along_face ||
        !(order == 1.0 || order == 3.0) || effect.columns() != 2 ||
        effect.family->tells_order_along_profile)
      continue;
    all.push_back(e);
    orders.insert(order);
  }
  if (all.size() < 3 || orders.size() < 2) return false;
  std::vector<Effect> fields;
  for (const double own_power : {2.0, 1.0, 0.0})
    fields.push_back({find_family("unnamed_field"), FlankChoice::kBoth, {own_power}});
  for (const std::size_t kept : all)
    if (moves_the_teeth(model.effects[kept])) {
      std::vector<std::size_t> rest = all;
      std::erase(rest, kept);
      if (put_one_form_for(model, all, fields) || put_one_form_for(model, rest, fields))
        return true;
    }
  return put_one_form_for(model, all, fields);
}

bool tell_as_facing(PartModel& model) {
  constexpr int kMostWaves = 4;
  constexpr double kStep_deg = 10.0;
  std::vector<std::size_t> waves, levels;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.flank != FlankChoice::kBoth || effect.family->local ||
        effect.family->tells_order_along_profile)
      continue;
    const double order = effect.order();
    if ((order >= 1.0 && order <= kMostWaves) || moves_the_teeth(effect) ||
        effect.family == find_family("unnamed_facing"))
      waves.push_back(e);
    else if (runs_of(model.geometry, effect) == Runs::kNowhere)
      levels.push_back(e);
  }
  // (traces and an index at odds over an eccentricity look like one side as well)
  constexpr std::size_t kFewest = 3;
  if (!model.table->points_mm.empty() && waves.size() >= kFewest) {
    std::vector<std::vector<std::size_t>> sets{waves};
    if (!levels.empty()) {
      sets.insert(sets.begin(), waves);
      sets.front().insert(sets.front().end(), levels.begin(), levels.end());
      std::sort(sets.front().begin(), sets.front().end());
    }
    std::vector<Effect> forms;
    for (double towards_deg = 0.0; towards_deg < 360.0; towards_deg += kStep_deg)
      for (const double power : {1.0, 2.0})
        forms.push_back(
            {find_family("unnamed_facing_one_side"), FlankChoice::kBoth, {towards_deg, power}});
    std::vector<std::vector<Effect>> besides{{}};
    if (levels.empty())  // (a bow may have taken up a part of the mean)
      besides.push_back({{find_family("unnamed"), FlankChoice::kBoth, {0.0, 0.0, 0.0, 0.0}}});
    for (std::size_t c = 0; c < model.candidates.size(); ++c)
      if (moves_the_teeth(model.candidates[c]) && !model.unseen[c])
        besides.push_back({model.candidates[c]});
    for (const std::vector<std::size_t>& set : sets)
      for (const std::vector<Effect>& beside : besides)
        if (put_one_form_for(model, set, forms, beside)) return true;
  }
  for (int k = 2; k <= kMostWaves; ++k) {
    std::vector<std::size_t> these;
    for (const std::size_t e : waves)
      if (model.effects[e].order() == k) these.push_back(e);
    if (these.size() > 1 &&
        put_one_form_for(model, these,
                         {{find_family("unnamed_facing"), FlankChoice::kBoth, {double(k)}}}))
      return true;
  }
  return false;
}

std::vector<Effect> with_walls_of_one_side(const PartModel& model,
                                           std::vector<std::size_t>& these) {
  constexpr double kMostWaves = 4.0, kStep_deg = 10.0;
  std::vector<std::size_t> all, names;
  bool leans = false, grows = false, bends = false;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const EffectFamily& family = *effect.family;
    if (family.local || family.tells_order_along_profile) continue;
    const NeedsToBeSeen needs = effect.needs();
    const Runs runs = runs_of(model.geometry, effect, Flanks::kOfEither);
    const bool moves = effect.columns() == 2 && effect.order() == 0.0 && runs == Runs::kOtherwise &&
                       !needs.along_profile && !family.shape_is_step &&
                       (family.displacement_mm || needs.several_heights);
    const bool wave = effect.columns() == 2 && effect.order() > 0.0 &&
                      effect.order() <= kMostWaves && !needs.along_profile;
    const bool facing = &family == find_family("unnamed_facing") ||
                        &family == find_family("unnamed_facing_one_side");
    if (!moves && !wave && !facing && runs != Runs::kNowhere && runs != Runs::kOverFace) continue;
    all.push_back(e);
    if (family.named) names.push_back(e);
    leans =
        leans || (moves && needs.several_heights) || (effect.order() == 1.0 && needs.along_face);
    grows = grows || runs == Runs::kOverFace;
    bends = bends || (wave && effect.order() > 1.0 && needs.along_face);
  }
  if (!leans || !grows || !bends) return {};
  std::vector<Effect> forms;
  const double face_mm = model.geometry.face_width_mm();
  for (double towards_deg = 0.0; towards_deg < 360.0; towards_deg += kStep_deg)
    for (const double towards : {-1.0, 1.0}) {
      EffectShape shape{towards_deg, 1.0};
      shape.resize(2 + gear_effects::FlankCourse::kValues);
      gear_effects::FlankCourse{gear_effects::FlankCourse::kKink, towards > 0.0 ? 0.0 : face_mm,
                                towards}
          .put_in(shape, 2);
      forms.push_back({find_family("unnamed_body_facing"), FlankChoice::kBoth, std::move(shape)});
    }
  return cheapest_one_form(model, with_and_without(all, names), forms, {}, these);
}

bool tell_as_alternating_wave(PartModel& model) {
  const int z = model.geometry.teeth();
  if (z % 2 != 0) return false;
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
    std::vector<std::size_t> these;
    bool alternates = false, bends = false;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      const bool alternation = effect.family == find_family("unnamed_alternation");
      const bool order = effect.family->tells_order_along_profile &&
                         std::remainder(effect.order(), z) != 0.0 &&
                         std::remainder(2.0 * effect.order(), z) == 0.0;
      if (!(alternation || order) || (flank != FlankChoice::kBoth && effect.flank != flank))
        continue;
      these.push_back(e);
      alternates = alternates || alternation;
      bends = bends || order || effect.shape[0] > 0.0;
    }
    if (!alternates || !bends || these.size() < 2) continue;
    if (put_one_form_for(model, these, alternating_waves(z, flank, 0))) return true;
  }
  return false;
}

std::vector<Effect> with_comb(const PartModel& model, std::vector<std::size_t>& these) {
  constexpr double kClearly = 20.0;  // chi-square
  CheapestAnswer best{.least = cost_of(model, model.effects) - kClearly};
  for (const int face : {0, 1}) {
    std::vector<std::size_t> all, alike, names;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
      const Effect& effect = model.effects[e];
      const Runs runs = runs_of(model.geometry, effect, Flanks::kOfEither);
      const NeedsToBeSeen needs = effect.needs();
      const bool differs = runs == Runs::kOtherwise && !effect.family->is_of_one_tooth &&
                           needs.along_profile == (face == 0) && needs.along_face == (face == 1);
      const bool same = runs == (face == 0 ? Runs::kOverProfile : Runs::kOverFace);
      if (!differs && !same) continue;
      all.push_back(e);
      if (same) alike.push_back(e);
      if (same && effect.family->named) names.push_back(e);
    }
    if (all.size() < 2 || alike.size() == all.size()) continue;
    for (const std::vector<std::size_t>& set : with_and_without(all, names)) {
      const LikeliestProducts likeliest(
          model.geometry, model.table, model.patches,
          *fit_of(model, without(model.effects, set))->residuals_um());
      std::vector<std::vector<Effect>> forms;
      for (LikelyForms& likely : likeliest.combs(face)) forms.push_back(std::move(likely.forms));
      // (what is there on every other tooth with the other sign is no comb beside its mean)
      const int z = model.geometry.teeth();
      for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
        if (z % 2 == 0) forms.push_back(alternating_waves(z, flank, face));
      for (const std::vector<Effect>& some : forms)
        best.ask(model, one_form_for(model, set, some), set);
    }
  }
  if (!best.effects.empty()) these = std::move(best.these);
  return std::move(best.effects);
}

void tell_ghosts_of_teeth(PartModel& model) {
  const double z = model.geometry.teeth();
  constexpr int kMostTurns = 5;
  const auto comes_by_turns = [&](double order, int turns) {
    return std::remainder(order, z) != 0.0 && std::remainder(turns * order, z) == 0.0;
  };
  std::vector<std::size_t> told;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (!model.effects[e].family->tells_order_along_profile || form_instead(model, e) == nullptr)
      continue;
    const double order = model.effects[e].order(), off = std::abs(std::remainder(order, z));
    const bool part =
        std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& other) {
          const bool by_turns =
              other.family == find_family("unnamed_alternation") ||
              other.family == find_family("unnamed_comb") ||
              (other.family == find_family("unnamed_marks") && other.shape[2] != 0.0);
          for (int turns = 2; turns <= kMostTurns; ++turns)
            if (comes_by_turns(order, turns) &&
                (by_turns || (other.family->tells_order_along_profile && other.order() != order &&
                              comes_by_turns(other.order(), turns))))
              return true;
          return !by_turns && other.is_term() && !other.family->tells_order_along_profile &&
                 off > 0.0 && other.order() == off && other.needs().along_profile;
        });
    if (part) told.push_back(e);
  }
  for (const std::size_t e : told) model.effects[e].family = form_instead(model, e);
}

void tell_levels_of_bowed_waves(PartModel& model) {
  constexpr double kLeast = 0.2, kMost = 0.8;  // of a bow v^2 - 1/3: a half
  constexpr double kInStep = 0.85;
  if (model.effects.empty()) return;
  const auto fit = fit_of(model, model.effects);
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const EffectFamily* form = form_instead(model, e);
    const Effect& wave = model.effects[e];
    if (form == nullptr || wave.family->displacement_mm || !(wave.order() > 0.0) ||
        !is_level_of_order(wave, wave.order()))
      continue;
    const Eigen::VectorXd level = around(model.geometry, *fit, e, kMiddle);
    for (std::size_t b = 0; b < model.effects.size(); ++b) {
      const Effect& bow = model.effects[b];
      if (!bow.is_term() || bow.order() != wave.order() || bow.columns() != 2 ||
          !bow.needs().along_face || bow.needs().along_profile)
        continue;
      const Eigen::VectorXd middle = around(model.geometry, *fit, b, kMiddle),
                            end = around(model.geometry, *fit, b, kEnd);
      // (an end of a bow's polynomial is twice as high as its middle is low)
      const double share = level.norm() / end.norm();
      if (middle.dot(end) < 0.0 && share > kLeast && share < kMost &&
          level.dot(end) > kInStep * level.norm() * end.norm()) {
        model.effects[e].family = form;
        break;
      }
    }
  }
}

}  // namespace trueflank::loop
