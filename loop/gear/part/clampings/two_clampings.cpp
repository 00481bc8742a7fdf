// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/clampings/two_clampings.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

const char* const kMeasureAgain =
    "the index of both flanks in one clamping: an eccentricity and a wave of pitch once per turn "
    "are "
    "what two clampings make, one of the left flanks and one of the right ones";

/// Numbers of two effects in a fit; empty: one of them is not there.
struct TwoEffects {
  int first = 0, second = 0;
};
template <class IsFirst, class IsSecond>
std::optional<TwoEffects> two_effects(const PointFit& fit, IsFirst is_first, IsSecond is_second) {
  const auto number = [&](const auto& is) {
    const auto found = std::find_if(fit.effects().begin(), fit.effects().end(), is);
    return found == fit.effects().end() ? -1 : static_cast<int>(found - fit.effects().begin());
  };
  const TwoEffects both{number(is_first), number(is_second)};
  return both.first < 0 || both.second < 0 ? std::nullopt : std::optional(both);
}

/// What others with two columns each would have to be to do to the index what two effects of the
/// fit do: their four coefficients.
Eigen::Vector4d same_by(const FlankGeometry& geometry, const Observations& table,
                        const PointFit& fit, TwoEffects these, const std::vector<Effect>& others) {
  std::vector<const Place*> places;
  for (const Observation& row : table.rows)
    if (row.kind == ObservationKind::kIndex) places.push_back(&table.place(row));
  const Eigen::Index n = std::ssize(places);
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(n, 6);  // (and a zero of each side)
  Eigen::VectorXd told = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Place& place = *places[static_cast<std::size_t>(i)];
    double columns[8];
    for (const Eigen::Index k : {0, 1}) {
      others[static_cast<std::size_t>(k)].evaluate(geometry, place, columns);
      moves.row(i).segment<2>(2 * k) << columns[0], columns[1];
    }
    moves(i, place.side > 0 ? 4 : 5) = 1.0;
    for (const int e : {these.first, these.second}) {
      fit.effects()[static_cast<std::size_t>(e)].evaluate(geometry, place, columns);
      for (int k = 0; k < 2; ++k)
        told[i] += fit.coefficients()[fit.first_column(e) + k] * columns[k];
    }
  }
  return moves.colPivHouseholderQr().solve(told).head<4>();
}

std::string in_words(const Eigen::Vector2d& wave_um, const char* what) {
  return gear_effects::um(wave_um.norm()) + what +
         gear_effects::towards(deg_from_rad(std::atan2(wave_um[1], wave_um[0])));
}

/// The sentence up to what is to be done.
std::string without_action(const FoundEffect& found) {
  const std::string action = first_action(found.correction);
  return action.empty() ? found.sentence : found.sentence.substr(0, found.sentence.find(action));
}

/// Beside two names: they may be two clampings.
void say_clampings_beside_names(const FlankGeometry& geometry, const Observations& table,
                                const PointFit& fit, TwoEffects names,
                                std::vector<FoundEffect>& effects) {
  const Eigen::Vector4d moved =
      same_by(geometry, table, fit, names,
              {clamping_of(FlankChoice::kLeft), clamping_of(FlankChoice::kRight)});
  for (FoundEffect& found : effects) {
    const EffectFamily* family = find_family(found.id);
    const bool once = family == eccentric().family || (family == wave_of_pitch().family &&
                                                       gear_effects::figure(found, "order") == 1.0);
    if (!once || found.flank != "both") continue;
    found.sentence =
        without_action(found) +
        "; or left and right flanks were measured in two clampings, the left ones " +
        in_words(moved.head<2>(), " off the axis ") + ", the right ones " +
        in_words(moved.tail<2>(), " off the axis ") +
        ": in all numbers the same; measure both flanks in one clamping before anything is "
        "corrected";
    found.sure = "that both sides differ so, " + found.sure +
                 "; whether it is the gear, the table or two clampings is open";
    found.measure_again = kMeasureAgain;
  }
}

/// Beside two clampings: they may be two names.
void say_names_beside_clampings(const FlankGeometry& geometry, const Observations& table,
                                const PointFit& fit, TwoEffects clampings,
                                std::vector<FoundEffect>& effects) {
  const Eigen::Vector4d named =
      same_by(geometry, table, fit, clampings, {eccentric(), wave_of_pitch()});
  for (FoundEffect& found : effects) {
    if (found.terms.size() != 1 || found.flank == "both" || found.terms.front().keys.empty() ||
        found.terms.front().keys.front().first != "file")
      continue;
    found.sentence +=
        "; in all numbers the same as " + in_words(named.head<2>(), " of eccentricity ") +
        " and a pitch wave once per turn of " + gear_effects::um(named.tail<2>().norm()) +
        ", which would nearly take each other back: less likely";
    found.measure_again = kMeasureAgain;
  }
}

}  // namespace

Effect clamping_of(FlankChoice flank) { return {find_family("unnamed_clamping"), flank, {0.0}}; }
Effect eccentric() { return {find_family("eccentricity"), FlankChoice::kBoth, {}}; }
Effect wave_of_pitch() { return {find_family("pitch_wave"), FlankChoice::kBoth, {1.0}}; }

bool is_index_alone(const Observations& table) {
  return std::all_of(table.rows.begin(), table.rows.end(), [](const Observation& row) {
    return row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kSize;
  });
}

void say_two_clampings(const FlankGeometry& geometry, const Observations& table,
                       const PointFit& fit, std::vector<FoundEffect>& effects) {
  if (!is_index_alone(table)) return;
  const auto is = [](const Effect& wanted) {
    return [wanted](const Effect& effect) { return effect == wanted; };
  };
  if (const auto names = two_effects(fit, is(eccentric()), is(wave_of_pitch())))
    say_clampings_beside_names(geometry, table, fit, *names, effects);
  if (const auto clampings = two_effects(fit, is(clamping_of(FlankChoice::kLeft)),
                                         is(clamping_of(FlankChoice::kRight))))
    say_names_beside_clampings(geometry, table, fit, *clampings, effects);
}

}  // namespace trueflank::loop
