// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/loop/made_gears.h"
#include "trueflank/base/number_text.h"
#include "trueflank/loop/gear/part/drifts.h"
#include "trueflank/loop/gear/part/fields.h"
#include "trueflank/loop/gear/part/forms_around.h"
#include "trueflank/loop/gear/part/forms_of_teeth.h"
#include "trueflank/loop/gear/part/names/names.h"
#include "trueflank/loop/gear/part/names/names_beside_forms.h"
#include "trueflank/loop/gear/part/names/settled_names.h"
#include "trueflank/loop/gear/part/odd_forms.h"
#include "trueflank/loop/gear/part/one_flank.h"
#include "trueflank/loop/gear/part/one_form.h"
#include "trueflank/loop/gear/part/part_model.h"
#include "trueflank/loop/gear/part/parts_of_forms.h"
#include "trueflank/loop/gear/part/products.h"
#include "trueflank/loop/gear/part/sectors.h"
#include "trueflank/loop/gear/part/tidying.h"
#include "trueflank/loop/gear/part/waves.h"

// Whatever is told in place of random pieces: as little is left as before, as few values are
// told, each effect keeps its record, and the pieces' order says nothing.
namespace trueflank::test {
namespace {

using loop::Effect;
using loop::EffectShape;
using loop::FlankChoice;
using loop::PartModel;

struct Telling {
  const char* name;
  std::function<void(PartModel&)> tell;
};
const std::vector<Telling>& tellings() {
  static const std::vector<Telling> all{
      {"drift aside", [](PartModel& m) { static_cast<void>(tell_as_drift_aside(m)); }},
      {"drift", [](PartModel& m) { static_cast<void>(tell_as_drift(m)); }},
      {"field", [](PartModel& m) { static_cast<void>(tell_as_field(m)); }},
      {"facing", [](PartModel& m) { static_cast<void>(tell_as_facing(m)); }},
      {"alternating wave", [](PartModel& m) { static_cast<void>(tell_as_alternating_wave(m)); }},
      {"ghosts of teeth", loop::tell_ghosts_of_teeth},
      {"levels of bowed waves", loop::tell_levels_of_bowed_waves},
      {"repeating", [](PartModel& m) { static_cast<void>(tell_as_repeating(m)); }},
      {"swellings at an end", [](PartModel& m) { static_cast<void>(tell_as_swellings_at_end(m)); }},
      {"of the other teeth", [](PartModel& m) { static_cast<void>(tell_of_the_other_teeth(m)); }},
      {"forms of teeth", loop::tell_forms_of_teeth},
      {"forms of some teeth", loop::tell_forms_of_some_teeth},
      {"forms of sectors", loop::tell_forms_of_sectors},
      {"one flank as two names", loop::tell_one_flank_as_two_names_of_all},
      {"names in two parts", loop::tell_names_in_two_parts},
      {"usual of equals", loop::tell_the_usual_of_equals},
      {"means of one wave", loop::tell_means_of_one_wave},
      {"means across flanks", loop::tell_means_across_flanks},
      {"what teeth do not share", loop::tell_what_teeth_do_not_share},
      {"means of odd forms", loop::tell_means_of_odd_forms},
      {"what one flank has", loop::tell_what_one_flank_has},
      {"one form", loop::tell_as_one_form},
      {"parts of a form", loop::tell_parts_of_a_form},
      {"corner", [](PartModel& m) { static_cast<void>(tell_as_corner(m)); }},
      {"product", [](PartModel& m) { static_cast<void>(tell_as_product(m)); }},
      {"sector", [](PartModel& m) { static_cast<void>(tell_as_sector(m)); }},
      {"teeth side by side", loop::tell_teeth_side_by_side},
      {"two names as one", loop::tell_two_names_as_one},
      {"bows with a level", loop::tell_bows_with_a_level},
      {"teeth of one flank", loop::tell_teeth_of_one_flank},
      {"waves of a form", loop::tell_waves_of_a_form},
      {"walking waves", [](PartModel& m) { static_cast<void>(tell_as_walking_waves(m)); }},
  };
  return all;
}

/// Some effects that a choice may come to, with sizes [um].
std::vector<std::pair<Effect, double>> random_pieces(std::mt19937_64& random, int teeth) {
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const auto flank = [&] {
    return below(3) == 0 ? (below(2) == 0 ? FlankChoice::kLeft : FlankChoice::kRight)
                         : FlankChoice::kBoth;
  };
  std::vector<std::pair<Effect, double>> pieces;
  const auto add = [&](const char* family, FlankChoice side, EffectShape shape) {
    const Effect effect{loop::find_family(family), side, std::move(shape)};
    const double size_um = (below(2) == 0 ? 1.0 : -1.0) * (4.0 + below(8));
    if (std::none_of(pieces.begin(), pieces.end(),
                     [&](const auto& other) { return other.first == effect; }))
      pieces.emplace_back(effect, size_um);
  };
  const char* const names[] = {"taper", "helix_error", "crowning", "pressure_angle_error",
                               "profile_crowning"};
  for (int n = 1 + below(2); n > 0; --n) add(names[below(5)], flank(), {});
  const double first = 1.0 + below(teeth);
  switch (below(5)) {
    case 0:  // some teeth
      for (int n = 2 + below(2); n > 0; --n)
        add("unnamed_tooth_form", FlankChoice::kBoth,
            {1.0 + static_cast<int>(first + n - 1) % teeth, double(below(2)), 0.0, 0.0});
      break;
    case 1:  // waves of the pitch
      for (int n = 1 + below(3); n > 0; --n)
        add("pitch_wave", FlankChoice::kBoth, {double(2 + below(6))});
      break;
    case 2:  // sectors
      add("unnamed_sector", FlankChoice::kBoth,
          {first, double(2 + below(teeth / 3)), 0.0, double(below(2)), 0.0});
      break;
    case 3:  // waves without a name
      for (int n = 1 + below(2); n > 0; --n)
        add("unnamed", FlankChoice::kBoth,
            {0.0, double(below(3)), double(2 + below(3)), double(below(2))});
      break;
    default:  // along the flanks
      for (int n = 1 + below(2); n > 0; --n)
        add("unnamed", FlankChoice::kBoth, {double(below(4)), 0.0, 0.0, double(below(2))});
  }
  return pieces;
}

/// One form that a gear was made with, and terms that a choice takes it to pieces with.
std::pair<Effect, std::vector<Effect>> form_and_its_pieces(std::mt19937_64& random, int teeth) {
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const auto term = [](double profile, double face, double order, double opposite = 0.0) {
    return Effect{
        loop::find_family("unnamed"), FlankChoice::kBoth, {profile, face, order, opposite}};
  };
  const auto form = [](const char* family, EffectShape shape,
                       FlankChoice flank = FlankChoice::kBoth) {
    return Effect{loop::find_family(family), flank, std::move(shape)};
  };
  const double first = 1.0 + below(teeth), lean = below(2);
  std::vector<Effect> waves;
  for (const double order : {1.0, 2.0, 3.0}) waves.push_back(term(0.0, lean, order));
  switch (teeth % 4 == 0 ? below(6) : 1 + 2 * below(3)) {  // (a comb of four needs as many teeth)
    case 0:
      return {form("unnamed_ramp", {first, 0.0, lean, 0.0, 0.0}), waves};
    case 1:
      return {form("unnamed_sector", {first, double(teeth / 4 + below(teeth / 4)), 0.0, lean, 0.0}),
              waves};
    case 2: {  // every fourth tooth
      std::vector<Effect> combs{term(0.0, 0.0, 0.0)};
      for (int k = 1; 8 * k <= teeth && k < 3; ++k)
        combs.push_back(term(0.0, 0.0, 0.25 * k * teeth));
      return {form("unnamed_comb", {4.0, 1.0 + below(4), 0.0, 0.0, 0.0}), combs};
    }
    case 3: {  // of one flank, along the face
      std::vector<Effect> courses;
      for (const double degree : {0.0, 1.0, 2.0})
        for (const double opposite : {0.0, 1.0})
          courses.push_back(term(0.0, degree, 0.0, opposite));
      return {form("unnamed_rise", {1.0, 3.0, below(2) == 0 ? -1.0 : 1.0},
                   below(2) == 0 ? FlankChoice::kLeft : FlankChoice::kRight),
              courses};
    }
    case 4: {  // an axis that is bent
      std::vector<Effect> bows;
      for (const double degree : {0.0, 1.0, 2.0})
        for (const double opposite : {0.0, 1.0}) bows.push_back(term(0.0, degree, 1.0, opposite));
      return {form("unnamed_bow", {double(below(4)) - 1.0}), bows};
    }
    default: {  // some teeth that lean
      std::vector<Effect> leans;
      const int count = 3 + below(3);
      for (int k = 0; k < count; ++k)
        leans.push_back(form("unnamed_tooth_form",
                             {1.0 + (static_cast<int>(first) + k - 1) % teeth, 1.0, 0.0, 0.0}));
      return {form("unnamed_sector", {first, double(count), 1.0, 0.0, 0.0}), leans};
    }
  }
}

/// A model whose effects are the pieces of which its gear was made, or pieces of the one form that
/// it was made with.
class RandomModel {
 public:
  explicit RandomModel(unsigned seed) : random_(seed) {
    const MadeGear gears[] = {spur(20), ring(40), helical(23, 15.0)};
    const MadeGear& gear = gears[seed % 3];
    geometry_.emplace(geometry_of(gear));
    if (seed % 2 == 0) {
      made_ = random_pieces(random_, gear.teeth);
      for (const auto& [effect, size_um] : made_) pieces_.push_back(effect);
    } else {
      auto [form, pieces] = form_and_its_pieces(random_, gear.teeth);
      made_.emplace_back(std::move(form), seed % 4 == 1 ? 12.0 : -15.0);
      pieces_ = std::move(pieces);
    }
    const auto made = [this](auto&, const FlankSpot& s, auto&) {
      const double low = geometry_->root_form_roll_mm(), high = geometry_->tip_form_roll_mm();
      const loop::Place place = geometry_->on_flank(s.tooth, s.side > 0 ? 1 : -1,
                                                    0.5 * (low + high) + 0.5 * s.u * (high - low),
                                                    0.5 * (1.0 + s.v) * geometry_->face_width_mm());
      double sum = 0.0, columns[8];
      for (const auto& [effect, size_um] : made_) {
        effect.evaluate(*geometry_, place, columns);
        sum += size_um * columns[0];
      }
      return sum;
    };
    data_.scans.push_back(scan_of(gear, {grown(made)}, scanned(2500, 1.0, seed)));
  }
  /// With its pieces in another order.
  void shuffle() { std::shuffle(pieces_.begin(), pieces_.end(), random_); }
  [[nodiscard]] const std::vector<std::pair<Effect, double>>& made() const { return made_; }
  [[nodiscard]] std::unique_ptr<PartModel> model() const {
    auto model = std::make_unique<PartModel>(
        *geometry_, *make_observations(*geometry_, data_, {.aligned = true}), loop::PartOptions());
    divide_into_patches(*model);
    model->unseen = model->banned;
    model->effects = pieces_;
    model->discovery.chosen.resize(model->effects.size());
    return model;
  }

 private:
  std::mt19937_64 random_;
  std::optional<loop::FlankGeometry> geometry_;
  std::vector<std::pair<Effect, double>> made_;
  std::vector<Effect> pieces_;
  loop::MeasuredData data_;
};

std::vector<std::string> told(const std::vector<Effect>& effects) {
  std::vector<std::string> all;
  for (const Effect& effect : effects) {
    all.push_back(effect.family->id + " " + std::to_string(static_cast<int>(effect.flank)));
    for (const double value : effect.shape) all.back() += " " + printed_number(value, "%.3f");
  }
  std::sort(all.begin(), all.end());
  return all;
}
int values_told(const std::vector<Effect>& effects) {
  int values = 0;
  for (const Effect& effect : effects) values += effect.columns();
  return values;
}

TEST(RandomPieces, AreToldAsWhatLeavesAsLittleOfThem) {
  for (unsigned seed = 1; seed <= survey_size(4U, 16U); ++seed) {
    RandomModel gear(seed);
    for (const Telling& telling : tellings()) {
      const auto model = gear.model();
      const std::vector<Effect> before = model->effects;
      const double left = fit_of(*model, before)->residual_square();
      telling.tell(*model);
      const std::string where = std::string(telling.name) + ", seed " + std::to_string(seed) +
                                ": " + joined(told(before), "; ") + " -> " +
                                joined(told(model->effects), "; ");
      EXPECT_EQ(model->effects.size(), model->discovery.chosen.size()) << where;
      if (model->effects == before) continue;
      EXPECT_LE(values_told(model->effects), values_told(before)) << where;
      EXPECT_LE(fit_of(*model, model->effects)->residual_square(), 1.05 * left) << where;
      gear.shuffle();
      const auto shuffled = gear.model();
      telling.tell(*shuffled);
      EXPECT_EQ(told(shuffled->effects), told(model->effects)) << where;
    }
  }
}

// Of random size, place and gear: what a drift, a comb, a form of one flank and a bent axis come to
// in pieces.
TEST(RandomPieces, OfOneFormAreToldAsItWhereverItStands) {
  const std::vector<std::pair<std::string, std::function<void(PartModel&)>>> ways{
      {"unnamed_ramp", [](PartModel& m) { static_cast<void>(tell_as_drift(m)); }},
      {"unnamed_sector", [](PartModel& m) { static_cast<void>(tell_as_sector(m)); }},
      {"unnamed_comb", [](PartModel& m) { static_cast<void>(tell_as_repeating(m)); }},
      {"unnamed_rise", loop::tell_as_one_form},
      {"unnamed_bow", loop::tell_as_one_form}};
  for (unsigned seed = 1; seed <= survey_size(13U, 41U); seed += 2) {
    RandomModel gear(seed);
    const Effect& form = gear.made().front().first;
    for (const auto& [family, tell] : ways) {
      if (form.family->id != family) continue;
      const auto model = gear.model();
      if (model->effects.front().family == loop::find_family("unnamed_tooth_form")) continue;
      tell(*model);
      const std::string where = "seed " + std::to_string(seed) + ": " + joined(told({form}), "; ") +
                                " is told as " + joined(told(model->effects), "; ");
      EXPECT_EQ(model->effects.size(), 1U) << where;
      EXPECT_EQ(model->effects.front().family, form.family) << where;
      EXPECT_EQ(model->effects.front().flank, form.flank) << where;
      EXPECT_NEAR(model->effects.front().shape[0], form.shape[0], 0.5) << where;
    }
  }
}

}  // namespace
}  // namespace trueflank::test
