// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "trueflank/loop/gear/close_loop.h"
#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/local/neighbour_teeth.h"
#include "trueflank/loop/gear/remainder.h"
#include "trueflank/loop/gear/table/shared_table.h"

namespace trueflank::loop {

/// Level of a second effect, and of a part's own beside what is of all.
inline constexpr double kNextLevel = 0.01;

struct PartOptions {
  DeclaredFamilies declared = nullptr;
  Makings makings = kAnyMaking;  ///< ways of making that are open: of others no cause is named
  /// Effects that are in the model from the start (with free coefficients): found on other data.
  std::vector<Effect> given = {};
  bool joined = false;      ///< parts in one table: what is one part's own is looked at there
  bool names_only = false;  ///< no forms without a name
  std::vector<const EffectFamily*> without = {};  ///< families that are not asked about
  int tables = 1;  ///< of how many this is one: the false alarm rate is shared among them
  /// Forms to begin with, as if they had been found first; empty: the choice begins by itself, and
  /// is made again from such ones where it ends in many pieces.
  std::vector<RemainderFinding> start = {};
};

/// Whether traces and scans of the flanks of a side differ in their place over the profile and over
/// the face, and any values in their height.
struct FlankReach {
  bool profile = true, face = true, heights = true;
};

/// What a form that is tried may leave at most: before its place and widths are sought, and then.
struct MostLeft {
  double on_the_grid = 1e300, in_place = 1e300;
  [[nodiscard]] bool operator==(const MostLeft&) const = default;
};

/// A form that was sought, and what was found.
struct SoughtForm {
  std::vector<Effect> rest, forms;
  MostLeft most;
  std::vector<Effect> found;
};

/// Residuals and what was found in them, for one set of effects.
struct KeptRemainder {
  bool valid = false;
  std::vector<Effect> effects;
  std::shared_ptr<const std::vector<float>> row_um;
  std::array<std::optional<std::vector<RemainderFinding>>, 2> findings;  ///< of training, of all
};

/// The model of one table: what was measured, the candidates, the effects chosen so far and the
/// fits that were made on the way. Steps of the procedure (part_loop.h) change it one after the
/// other; each is a function of the file that is named for what it looks at.
struct PartModel {
  PartModel(const FlankGeometry& of_geometry, SharedTable of_table, PartOptions with);
  PartModel(const PartModel&) = delete;  ///< fits refer to its tables
  PartModel& operator=(const PartModel&) = delete;

  const FlankGeometry& geometry;
  PartOptions options;
  SharedTable table;  ///< about the effects found: exact for finite displacements
  Patches patches;

  std::vector<Effect> candidates;
  std::vector<bool> banned;
  std::vector<bool> unseen;         ///< candidates whose form these data do not have
  std::array<FlankReach, 2> reach;  ///< of the sides: 1 the one that lies counter-clockwise
  DiscoveryProblem problem;         ///< of the candidates on the patches; without groups: not yet
  std::vector<Effect> problem_of;   ///< candidates as they stand in it
  std::optional<Discovery> choice;  ///< of the problem; its rest is not asked yet

  std::vector<Effect> effects;
  DiscoveryResult discovery;  ///< chosen: in the order of effects; group -1: not of the candidates
  std::vector<double> given_p_values;  ///< of the given ones that were told here, which stand last
  double p_value_of_pits = 1.0;        ///< where these are given (pits.h)
  std::vector<Effect> left_beside;     ///< beside which the test of what is left was made
  std::vector<RemainderFinding> remainder;  ///< what no effect found took up
  SharedByNeighbours neighbours;
  bool vetoed = false;                ///< effects were taken back
  std::optional<Effect> denied_spot;  ///< one of them, though it stands out beyond doubt
  /// Named effects that values one a tooth (index, runout) show alone; empty: none, or nothing else
  /// was measured.
  std::vector<FoundEffect> alone;

  std::vector<RemainderFinding> beside_slopes;  ///< forms that the data show beside a slope
  bool asked_for_starts = false;                ///< whether the choice was made again from them
  std::unique_ptr<PartModel> other_start;       ///< the best of these choices

  KeptRemainder kept;
  std::shared_ptr<const std::vector<float>> plain_um;  ///< what the plain fit leaves, where asked
  mutable std::vector<std::shared_ptr<const PointFit>> fits;  ///< the one asked for last first
  mutable std::shared_ptr<const PointFit> plain_fit;
  mutable std::deque<SoughtForm> sought;       ///< the last one last: different steps ask the same
  mutable std::vector<Effect> no_products_in;  ///< for which no product stands
  /// A form and the names it was compared with; while forms are compared one after the other, and
  /// until the columns of candidates are made.
  mutable std::vector<Effect> names_of;
  mutable DiscoveryProblem names;
};

/// What was told of other data stands in front, and stays as it is.
[[nodiscard]] inline std::size_t first_told_here(const PartModel& model) {
  return model.options.given.size() - model.given_p_values.size();
}
/// What effects are told by: their sizes, and with places and widths those that were sought.
[[nodiscard]] int values_of(const std::vector<Effect>& effects, bool places_too);
void divide_into_patches(PartModel& model);
/// Where some teeth have a form along their flanks, neighbouring values of a scan differ by that.
void forget_roughness_of_forms(PartModel& model);
/// Where values, places or weights changed.
void forget_fits(PartModel& model);
[[nodiscard]] std::shared_ptr<const PointFit> fit_of(const PartModel& model,
                                                     const std::vector<Effect>& effects);
[[nodiscard]] std::shared_ptr<const PointFit> plain_fit(const PartModel& model);
void leave_out_across_steps(PartModel& model);
[[nodiscard]] bool moves_points(const PartModel& model);
/// Points that an effect moved which is no longer there. True where there are some.
[[nodiscard]] bool put_points_back(PartModel& model);
/// Takes over an answer in which the last effects stand for these.
void put_in_place_of(PartModel& model, const std::vector<std::size_t>& these,
                     const std::vector<Effect>& with);
/// Takes an effect out of the answer, wherever it stands.
void remove_effect(PartModel& model, std::size_t e);
/// What was chosen for another table of the same part; values, patches and places stay.
void take_over_choice(PartModel& model, const PartModel& other);
/// The answer of another model of the same part, with its table.
void take_over(PartModel& model, PartModel& other);
void add_candidate(PartModel& model, Effect effect);
/// Index, runout and sizes: no trace, no scan.
[[nodiscard]] bool has_single_values_only(const PartModel& model);
/// What effects leave, and how many values they are told by (chi-square).
[[nodiscard]] double cost_of(const PartModel& model, const std::vector<Effect>& effects);

}  // namespace trueflank::loop
