// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/body/lone_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/part/one_form.h"

namespace trueflank::loop {
namespace {

/// The middle of a tooth or a sector of which both flanks stand out or lie back [teeth], and half
/// of its teeth.
struct LonePlace {
  double middle = 0.0, half = 0.5;
};
std::optional<LonePlace> lone_place(const Effect& effect) {
  if (effect.flank != FlankChoice::kBoth || effect.columns() != 1) return {};
  if (effect.family == find_family("unnamed_sector")) {
    constexpr std::size_t kProfile = 2, kFace = 3, kOpposite = 4;
    if (effect.shape[kProfile] != 0.0 || effect.shape[kFace] != 0.0 ||
        effect.shape[kOpposite] != 0.0)
      return {};
    return LonePlace{effect.shape[0] + 0.5 * (effect.shape[1] - 1.0), 0.5 * effect.shape[1]};
  }
  const EffectFamily* tooth = find_family("single_tooth");
  if (effect.family != tooth && effect.family != find_form(tooth->form_word)) return {};
  return LonePlace{effect.shape[0], 0.5};
}

std::vector<Effect> places_about(const PartModel& model, const LonePlace& place, double outwards) {
  constexpr double kWidest_deg = 40.0;
  const double pitch_deg = 360.0 / model.geometry.teeth();
  std::vector<Effect> forms;
  for (double half = std::max(1.0, place.half) * pitch_deg; half < kWidest_deg; half *= 1.5)
    for (double off = -2.0; off <= 2.0; off += 0.5) {
      EffectShape shape{1.0, outwards, (place.middle - 1.0 + off) * pitch_deg, half};
      shape.resize(4 + 2 * gear_effects::FlankCourse::kValues + 1);
      forms.push_back({find_family("unnamed_body_place"), FlankChoice::kBoth, std::move(shape)});
    }
  return forms;
}

/// The answer with a place for these, and for nothing or one of them, where it is worth its values
/// clearly.
bool put_place_for(PartModel& model, const LonePlace& place, const std::vector<std::size_t>& these,
                   double p_value) {
  constexpr double kClearly = 16.0;  // chi-square: the places that were asked
  CheapestAnswer best{.least = cost_of(model, model.effects) - kClearly};
  // (at one height of the profile both say the same)
  for (const double outwards : {0.0, 1.0})
    if (outwards == 0.0 || !has_single_values_only(model))
      best.ask(model,
               with_best_form(model, without(model.effects, these),
                              places_about(model, place, outwards), {}),
               these);
  if (best.effects.empty()) return false;
  put_in_place_of(model, these, best.effects);
  model.discovery.chosen.back().p_value = std::min(p_value, model.discovery.chosen.back().p_value);
  return true;
}

}  // namespace

bool tell_lone_places(PartModel& model) {
  constexpr double kBeside = 2.0;  // teeth
  if (model.options.joined) return false;
  const double z = model.geometry.teeth();
  std::vector<std::pair<LonePlace, double>> places;  // and how likely by chance
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (const auto place = lone_place(model.effects[e]))
      places.emplace_back(*place, model.discovery.chosen[e].p_value);
  for (const RemainderFinding& finding : model.remainder)
    if (finding.effect)
      if (const auto place = lone_place(*finding.effect))
        places.emplace_back(*place, finding.p_value);
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.first.half > b.first.half; });
  for (const auto& [place, p_value] : places) {
    std::vector<std::size_t> these;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
      if (const auto own = lone_place(model.effects[e]);
          own && std::abs(std::remainder(own->middle - place.middle, z)) <
                     own->half + place.half + kBeside)
        these.push_back(e);
    if (put_place_for(model, place, these, p_value)) return true;
  }
  return false;
}

}  // namespace trueflank::loop
