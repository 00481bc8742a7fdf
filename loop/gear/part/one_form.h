// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "trueflank/loop/gear/part/part_model.h"

namespace trueflank::loop {

/// Effects without those at these places.
[[nodiscard]] std::vector<Effect> without(const std::vector<Effect>& effects,
                                          const std::vector<std::size_t>& these);

/// The cheapest of some answers, and what its last effects stand for.
struct CheapestAnswer {
  double least = 1e300;  ///< what it must cost less than
  std::vector<Effect> effects = {};
  std::vector<std::size_t> these = {};

  /// Keeps an answer that costs less; an empty one is none.
  void ask(const PartModel& model, std::vector<Effect> with, const std::vector<std::size_t>& of);
};

/// The form that leaves least in place of the last effect: of each family the best by trial, of the
/// best of these each in its place, then beside the others. Empty where all leave too much.
[[nodiscard]] std::vector<Effect> best_form_sought(const PartModel& model, std::vector<Effect> rest,
                                                   const std::vector<Effect>& forms,
                                                   const MostLeft& most);
/// The same; asked for the same forms again, the answer is kept.
[[nodiscard]] std::vector<Effect> with_best_form(const PartModel& model,
                                                 const std::vector<Effect>& rest,
                                                 const std::vector<Effect>& forms,
                                                 const MostLeft& most);
/// All others with one of the forms, the last, and what is put beside it in place of these effects:
/// it needs no more values than they do, but for so many, and leaves clearly less; for every value
/// that it spares it may leave a little more, and for each that it needs it must leave less. Empty
/// where none does.
[[nodiscard]] std::vector<Effect> one_form_for(const PartModel& model,
                                               const std::vector<std::size_t>& these,
                                               const std::vector<Effect>& forms,
                                               const std::vector<Effect>& beside = {},
                                               int more_values = 0);
/// True where one of the forms stands for these effects: it is put in their place.
[[nodiscard]] bool put_one_form_for(PartModel& model, const std::vector<std::size_t>& these,
                                    const std::vector<Effect>& forms,
                                    const std::vector<Effect>& beside = {}, int more_values = 0);
/// Two slopes and bows, or one name with a place and a width, follow many forms: a profile that is
/// thicker at its root alone was a pressure angle and a hollow. A sum in which a name stands is
/// told as one form where that says as much with no more values.
void tell_as_one_form(PartModel& model);
/// What stood beside several effects and is nothing beside the one form.
void drop_idle_beside_one_form(PartModel& model);

}  // namespace trueflank::loop
