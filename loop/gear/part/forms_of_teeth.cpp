// SPDX-License-Identifier: GPL-3.0-or-later
// What one tooth has by itself, and forms along the flanks of some teeth: told as what they are
// where spots, heights and waves around the gear were what they are made of.
#include "trueflank/loop/gear/part/forms_of_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/part/forms_to_try.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/runs_along.h"
#include "trueflank/loop/gear/part/taken_up.h"

namespace trueflank::loop {
namespace {

bool is_on_one_tooth(const Effect& effect) {
  return effect.family->local || effect.family->is_of_one_tooth;
}

/// The tooth that an effect is on alone, also as a place of the body that is narrower than it; 0:
/// it is on no one tooth.
int tooth_of(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kNarrow = 0.3;  // of a pitch, to either side
  if (is_on_one_tooth(effect)) return static_cast<int>(effect.shape[0]);
  if (effect.family != find_family("unnamed_body_place") || effect.shape[0] != 1.0) return 0;
  const double pitch_deg = 360.0 / geometry.teeth();
  if (effect.shape[3] > kNarrow * pitch_deg) return 0;
  const double off = (effect.shape[2] - deg_from_rad(geometry.centre_rad(1))) / pitch_deg;
  return (static_cast<int>(std::lround(off)) % geometry.teeth() + geometry.teeth()) %
             geometry.teeth() +
         1;
}

/// A tooth that leans or bends over profile or face, or stands out.
Effect form_of_one(int tooth, double profile, double face, FlankChoice flank, bool opposite) {
  return {find_family("unnamed_tooth_form"),
          flank,
          {static_cast<double>(tooth), profile, face, opposite ? 1.0 : 0.0}};
}

/// Along the profile (0) and the face (1): whether a tooth was traced or scanned there. (A single
/// value on either end of a tooth is no lean of it.)
std::array<bool, 2> is_seen_along(const Patches& patches, int tooth) {
  std::array<bool, 2> seen{};
  for (const Patches::Patch& patch : patches.patches) {
    if (patch.places.front().place.tooth != tooth) continue;
    const bool scan = patch.kind == ObservationKind::kScanFlank;
    seen[0] = seen[0] || scan || patch.kind == ObservationKind::kProfile;
    seen[1] = seen[1] || scan || patch.kind == ObservationKind::kHelix;
  }
  return seen;
}

std::vector<Effect> leans_and_bends(const Patches& patches, int tooth, FlankChoice flank) {
  std::vector<Effect> forms;
  const std::array<bool, 2> seen = is_seen_along(patches, tooth);
  for (const double degree : {1.0, 2.0})
    for (const bool face : {false, true})
      for (const bool opposite : {false, true})
        if (seen[face ? 1 : 0] && (!opposite || flank == FlankChoice::kBoth))
          forms.push_back(
              form_of_one(tooth, face ? 0.0 : degree, face ? degree : 0.0, flank, opposite));
  return forms;
}

/// The same form, of some teeth; empty where there is none of its kind.
std::vector<Effect> on_teeth(const std::vector<Effect>& forms, double first, double count) {
  std::vector<Effect> of_teeth;
  for (const Effect& form : forms) {
    const EffectFamily* family = gear_effects::of_teeth(form);
    if (family == nullptr) continue;
    Effect& own = of_teeth.emplace_back(Effect{family, form.flank, form.shape});
    own.shape.insert(own.shape.begin(), {first, count, 0.0});
  }
  return of_teeth;
}

/// Some sectors of two and three teeth may be what is on one tooth alone, as no sector is of one:
/// one that stands out and the rest of it that takes it back.
void tell_tooth_of_sectors(PartModel& model) {
  constexpr double kFew = 3.0;
  const EffectFamily* sectors = find_family("unnamed_sector");
  std::vector<std::size_t> these;
  std::set<int> teeth;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    if (model.effects[e].family != sectors || model.effects[e].shape[1] > kFew) continue;
    these.push_back(e);
    for (int k = 0; k < static_cast<int>(model.effects[e].shape[1]); ++k)
      teeth.insert((static_cast<int>(model.effects[e].shape[0]) - 1 + k) % model.geometry.teeth() +
                   1);
  }
  if (these.size() < 2 || static_cast<double>(teeth.size()) > 2.0 * kFew) return;
  std::vector<std::size_t> all = these;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (is_on_one_tooth(model.effects[e]) &&
        teeth.count(static_cast<int>(model.effects[e].shape[0])) > 0)
      all.push_back(e);
  std::sort(all.begin(), all.end());
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
    std::vector<Effect> forms;
    for (const int tooth : teeth)
      for (Effect& form : leans_and_bends(model.patches, tooth, flank))
        forms.push_back(std::move(form));
    if (put_one_form_for(model, all, forms) ||
        (these != all && put_one_form_for(model, these, forms)))
      return;
  }
}

/// Neighbouring teeth: the first and how many.
struct SpanOfTeeth {
  int first = 0, count = 0;
  [[nodiscard]] bool operator==(const SpanOfTeeth&) const = default;
};

/// The teeth that a form without a name is of; empty: it is of all, or in waves around the gear.
std::optional<SpanOfTeeth> teeth_of(const Effect& effect) {
  const std::vector<std::string>& names = effect.family->shape_names;
  if (!effect.is_term() || names.empty() || effect.shape.size() < names.size()) return {};
  if (is_on_one_tooth(effect)) return SpanOfTeeth{static_cast<int>(effect.shape[0]), 1};
  if (effect.family == find_family("unnamed_dent")) {
    const int beside = std::max(1, static_cast<int>(std::lround(effect.shape[1])));
    return SpanOfTeeth{static_cast<int>(std::lround(effect.shape[0])) - beside, 2 * beside + 1};
  }
  if (names.size() > 2 && names[1] == "teeth" && effect.columns() <= 2 && effect.order() == 0.0)
    return SpanOfTeeth{static_cast<int>(effect.shape[0]), static_cast<int>(effect.shape[1])};
  return {};
}

/// Along what such a form has a course.
NeedsToBeSeen course_of_some_teeth(const Effect& effect) {
  NeedsToBeSeen course = effect.needs();
  const std::vector<std::string>& names = effect.family->shape_names;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (effect.shape[k] == 0.0) continue;
    course.along_profile =
        course.along_profile || names[k] == "profile_degree" || names[k] == "width_profile_mm";
    course.along_face = course.along_face || names[k] == "face_degree" ||
                        names[k] == "width_face_mm" || names[k] == "half_mm";
  }
  return course;
}

/// True where one lies in the other, but for a tooth at either end.
bool lies_within(const SpanOfTeeth& one, const SpanOfTeeth& all, int z) {
  const int off = ((one.first - all.first + 1) % z + z) % z;
  return off + one.count <= all.count + 2;
}

/// Teeth in a row, with at most one left out between two of them.
std::vector<SpanOfTeeth> runs_of_teeth(const std::set<int>& teeth, int z) {
  std::vector<SpanOfTeeth> runs;
  for (const int first : teeth) {
    const auto is_in = [&](int tooth) { return teeth.count((tooth - 1 + 2 * z) % z + 1) > 0; };
    if (is_in(first - 1) || is_in(first - 2)) continue;
    int count = 1;
    for (int k = 1; k < z; ++k)
      if (is_in(first + k) && k - count <= 1) count = k + 1;
    runs.push_back({first, count});
  }
  return runs;
}

/// Sectors that lean or are bowed, waves and swellings of some teeth and spots of neighbouring ones
/// are what a form with a place is made of that these teeth have: a groove, a ridge, a step.
bool tell_as_form_of_some_teeth(PartModel& model, FlankChoice flank) {
  constexpr int kPlaceAndWidth = 2;
  const int z = model.geometry.teeth();
  struct Piece {
    std::size_t effect = 0;
    SpanOfTeeth teeth;
  };
  std::vector<Piece> pieces;
  std::vector<std::size_t> along[2];  // of all teeth: over the profile, over the face
  std::set<int> of_one;
  std::set<FlankChoice> flanks;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    if (effect.family->named || (effect.flank != flank && flank != FlankChoice::kBoth)) continue;
    const NeedsToBeSeen needs = effect.needs();
    if (const std::optional<SpanOfTeeth> teeth = teeth_of(effect)) {
      if (2 * teeth->count > z) continue;
      pieces.push_back({e, *teeth});
      flanks.insert(effect.flank);
      if (teeth->count == 1) of_one.insert(teeth->first);
    } else if (effect.is_term() && effect.flank == flank) {
      if (needs.along_profile && !needs.along_face) along[0].push_back(e);
      if (needs.along_face && !needs.along_profile) along[1].push_back(e);
    }
  }
  if (pieces.empty() ||
      (flank == FlankChoice::kBoth && flanks.count(flank) == 0 && flanks.size() < 2))
    return false;
  std::vector<SpanOfTeeth> spans;
  for (const Piece& piece : pieces)
    if (piece.teeth.count > 1) spans.push_back(piece.teeth);
  for (const SpanOfTeeth& run : runs_of_teeth(of_one, z)) {
    if (run.count > 1) spans.push_back(run);
    // (that of a tooth and one beside it may be all that was found)
    if (run.count == 1 && pieces.size() > 1)
      for (const int first : {run.first - 1, run.first}) spans.push_back({first, 2});
  }
  std::set<int> measured;
  for (const Patches::Patch& patch : model.patches.patches)
    measured.insert(patch.places.front().place.tooth);
  const auto is_measured = [&](int tooth) {
    return measured.count(((tooth - 1) % z + z) % z + 1) > 0;
  };
  // A form of some teeth ends on teeth that show it.
  for (SpanOfTeeth& span : spans) {
    for (; span.count > 1 && !is_measured(span.first); --span.count) ++span.first;
    while (span.count > 1 && !is_measured(span.first + span.count - 1)) --span.count;
  }
  std::vector<SpanOfTeeth> tried;
  for (SpanOfTeeth span : spans) {
    span.first = (span.first - 1 + z) % z + 1;
    if (std::find(tried.begin(), tried.end(), span) != tried.end()) continue;
    tried.push_back(span);
    std::vector<std::size_t> within;
    bool runs[2] = {false, false};
    for (const Piece& piece : pieces) {
      if (!lies_within(piece.teeth, span, z)) continue;
      within.push_back(piece.effect);
      const NeedsToBeSeen needs = course_of_some_teeth(model.effects[piece.effect]);
      runs[0] = runs[0] || needs.along_profile;
      runs[1] = runs[1] || needs.along_face;
    }
    for (const int face : {0, 1}) {
      if (within.empty() || !runs[face]) continue;
      std::vector<Effect> whole = forms_along(model.geometry, face, flank, true);
      for (Effect& step : steps_along(model.geometry, face, flank))
        whole.push_back(std::move(step));
      const std::vector<Effect> forms = on_teeth(whole, span.first, span.count);
      std::vector<std::size_t> all = within;
      all.insert(all.end(), along[face].begin(), along[face].end());
      std::sort(all.begin(), all.end());
      if (put_one_form_for(model, all, forms, {}, kPlaceAndWidth) ||
          (all != within && put_one_form_for(model, within, forms, {}, kPlaceAndWidth)))
        return true;
    }
  }
  return false;
}

}  // namespace

void tell_forms_of_teeth(PartModel& model) {
  if (model.options.joined) return;
  tell_tooth_of_sectors(model);
  const auto on_tooth = [&](int tooth, const auto& is_asked) {
    std::vector<std::size_t> these;
    for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
      if (tooth_of(model.geometry, model.effects[e]) == tooth && is_asked(model.effects[e]))
        these.push_back(e);
    return these;
  };
  std::set<int> teeth;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e)
    if (const int tooth = tooth_of(model.geometry, model.effects[e]); tooth != 0)
      teeth.insert(tooth);
  for (const int tooth : teeth) {
    const auto put = [&](const std::vector<std::size_t>& these, FlankChoice flank) {
      const std::vector<Effect> forms = leans_and_bends(model.patches, tooth, flank);
      return put_one_form_for(model, these, forms) ||
             put_one_form_for(model, these, forms, {form_of_one(tooth, 0.0, 0.0, flank, false)});
    };
    const std::vector<std::size_t> all = on_tooth(tooth, [](const Effect&) { return true; });
    std::set<FlankChoice> flanks;
    for (const std::size_t e : all) flanks.insert(model.effects[e].flank);
    const bool on_both = flanks.size() > 1 || flanks.count(FlankChoice::kBoth) > 0;
    if (flanks.size() > 1 && put(all, FlankChoice::kBoth)) continue;
    if (on_both &&
        put_one_form_for(model, all,
                         on_teeth(corners(model.geometry, FlankChoice::kBoth), tooth, 1.0)))
      continue;
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight}) {
      const std::vector<std::size_t> these =
          on_tooth(tooth, [&](const Effect& effect) { return effect.flank == flank; });
      if (these.empty() || put(these, flank)) continue;
      const auto put_own = [&](const std::vector<Effect>& forms) {
        return put_one_form_for(model, these, on_teeth(forms, tooth, 1.0));
      };
      // (lines aslant are several spots, and a profile beside a lead does not tell them from one)
      bool is_one = these.size() > 1 && !model.table->points_mm.empty() &&
                    put_own(lines_aslant(model.geometry, flank));
      for (const double face : {0.0, 1.0})
        is_one = is_one || put_own(steps_along(model.geometry, face, flank)) ||
                 put_own(forms_along(model.geometry, face, flank, false));
      is_one = is_one || put_own(corners(model.geometry, flank));
      // (a spot that ends softly is many sharp ones)
      if (!is_one) put_own(dishes(model.geometry, flank, "unnamed_dish"));
    }
  }
}

void tell_forms_of_some_teeth(PartModel& model) {
  if (model.options.joined) return;
  constexpr int kMost = 4;
  constexpr double kSought = 36.0;  // chi-square
  int taken = 0;
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight})
    while (taken < kMost && tell_as_form_of_some_teeth(model, flank)) ++taken;
  if (taken == 0) return;
  drop_idle_beside_one_form(model);
  while (model.effects.size() > 1) {
    const auto [idle, loss] = least_missed(
        model, first_told_here(model), model.effects.size(),
        [](const Effect& e) { return !e.family->local && (!e.family->named || e.order() > 0.0); });
    if (!(loss < kSought)) return;
    remove_effect(model, idle);
  }
}

void tell_forms_of_sectors(PartModel& model) {
  if (model.options.joined) return;
  const EffectFamily *sectors = find_family("unnamed_sector"),
                     *marks = find_family("unnamed_marks");
  for (const FlankChoice flank : {FlankChoice::kBoth, FlankChoice::kLeft, FlankChoice::kRight}) {
    const auto once = [&] {
      std::vector<std::size_t> of_sectors, along, waves;
      for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
        const Effect& effect = model.effects[e];
        if (effect.flank != flank && effect.flank != FlankChoice::kBoth) continue;
        if (effect.family == sectors && effect.flank == flank)
          of_sectors.push_back(e);
        else if (effect.flank == flank && !effect.family->named &&
                 gear_effects::of_teeth(effect) != nullptr)
          along.push_back(e);
        else if (effect.family == marks || effect.family->tells_order_along_profile ||
                 (!effect.family->named && effect.order() > 0.0))
          waves.push_back(e);
      }
      for (const Runs runs : {Runs::kOverProfile, Runs::kOverFace}) {
        std::vector<std::size_t> with_waves = waves;
        std::vector<Effect> forms;
        for (const std::size_t form : along) {
          if (runs_of(model.geometry, model.effects[form]) != runs) continue;
          with_waves.push_back(form);
          for (const std::size_t sector : of_sectors)
            for (Effect& own : on_teeth({model.effects[form]}, model.effects[sector].shape[0],
                                        model.effects[sector].shape[1]))
              forms.push_back(std::move(own));
        }
        if (forms.empty()) continue;
        for (const bool with_sectors : {true, false}) {
          std::vector<std::size_t> these = with_waves;
          if (with_sectors) these.insert(these.end(), of_sectors.begin(), of_sectors.end());
          std::sort(these.begin(), these.end());
          if (these.size() > 1 && put_one_form_for(model, these, forms)) return true;
        }
      }
      return false;
    };
    constexpr int kMost = 3;
    for (int taken = 0; taken < kMost && once(); ++taken) {
    }
  }
}

}  // namespace trueflank::loop
