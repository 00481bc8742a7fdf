// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trueflank/loop/gear/close_loop.h"
#include "trueflank/loop/gear/fit/point_fit.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/local/neighbour_teeth.h"
#include "trueflank/loop/gear/random_error.h"
#include "trueflank/loop/gear/remainder.h"
#include "trueflank/loop/gear/table/shared_table.h"

namespace trueflank::loop {

/// Level of a second effect, and of a part's own beside what is of all.
inline constexpr double kNextLevel = 0.01;

struct CourseOverFlanks;

/// Whether traces and scans of the flanks of a side differ in their place over the profile and over
/// the face, and any values in their height.
struct FlankReach {
  bool profile = true, face = true, heights = true;
};

/// The procedure on one table: selection, shapes off the grid, finite displacements, single teeth.
class PartLoop {
 public:
  struct Options {
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
  PartLoop(const FlankGeometry& geometry, SharedTable table, Options options);
  PartLoop(const PartLoop&) = delete;  ///< fits refer to its tables
  PartLoop& operator=(const PartLoop&) = delete;

  void run();

  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }
  [[nodiscard]] const DiscoveryResult& discovery() const { return discovery_; }
  [[nodiscard]] const std::vector<Effect>& candidates() const { return candidates_; }
  /// Candidates whose form these data do not have.
  [[nodiscard]] const std::vector<bool>& unseen() const { return unseen_; }
  /// About the effects found: exact for finite displacements.
  [[nodiscard]] const Observations& table() const { return table_; }
  /// The same at the end, without a copy.
  [[nodiscard]] Observations take_table() && { return std::move(table_).taken(); }
  [[nodiscard]] const Patches& patches() const { return patches_; }
  /// The fit of effects to the table as it is; asked for again, it is at hand.
  [[nodiscard]] std::shared_ptr<const PointFit> fit_of(const std::vector<Effect>& effects) const;
  /// The fit of nothing but the pose to the deviations of the gear as designed.
  [[nodiscard]] std::shared_ptr<const PointFit> plain_fit() const;
  [[nodiscard]] std::vector<std::string> not_observable() const;
  /// How other coefficients of the fit would be if waves around the gear that never change their
  /// sign had a mean that is told as other effects; zero where there is none.
  [[nodiscard]] Eigen::VectorXd without_means_of_waves(const PointFit& fit) const;
  /// True where the test of structure that is left answers yes, how sure, and what it looks like.
  [[nodiscard]] bool structure_is_left() const;
  [[nodiscard]] WhatIsLeft what_is_left() const;
  [[nodiscard]] double structure_left_p_value() const;
  [[nodiscard]] std::string structure_left() const;
  /// Named effects that values one a tooth (index, runout) show alone; empty: none, or nothing else
  /// was measured.
  [[nodiscard]] const std::vector<FoundEffect>& alone() const { return alone_; }

 private:
  void hold_to_single_values();
  std::vector<double> weigh_single_values_by(const PartLoop& alone);
  [[nodiscard]] bool adopt_from_single_values(const PartLoop& alone, std::vector<Effect> more,
                                              std::vector<double> p_values);
  [[nodiscard]] bool adopt(const std::vector<Effect>& more, const std::vector<double>& p_values,
                           const std::vector<Effect>& instead_of = {});
  [[nodiscard]] std::vector<Effect> waves_in_place_of(const std::vector<Effect>& alone) const;
  void drop_what_new_ones_say(std::size_t first_new);
  void remove_effect(std::size_t effect);
  [[nodiscard]] std::vector<FoundEffect> told() const;
  void ban_what_cannot_be_seen();
  [[nodiscard]] bool is_within_reach(const Effect& effect) const;
  void ban_given();
  [[nodiscard]] bool is_rounding() const;
  void explain_what_is_left();
  void explain();
  void select();
  void finish_choice();
  void ask_what_is_left();
  void nominate();
  void add_candidate(Effect effect);
  [[nodiscard]] bool is_told_apart(const Effect& effect, const std::vector<Effect>& beside) const;
  [[nodiscard]] std::optional<Effect> name_like(const RemainderFinding& finding,
                                                const std::vector<Effect>& beside) const;
  void put_on_the_grid(const Effect& name);
  [[nodiscard]] std::vector<Effect> names_alike(const Effect& form) const;
  [[nodiscard]] bool take_up_remainder();
  void take_up(const RemainderFinding& finding);
  [[nodiscard]] bool take_up_again(const std::vector<Effect>& before);
  void explain_with_whole_forms();
  [[nodiscard]] bool take_up_whole_forms();
  [[nodiscard]] std::vector<double> left_with(const std::vector<std::size_t>& these) const;
  [[nodiscard]] std::vector<Effect> with_form_on_teeth(std::vector<std::size_t>& these,
                                                       double& p_value) const;
  [[nodiscard]] std::vector<Effect> with_sections_aside(std::vector<std::size_t>& these) const;
  [[nodiscard]] std::vector<Effect> with_one_side(std::vector<std::size_t>& these) const;
  class Products;
  [[nodiscard]] std::vector<Effect> with_products(std::vector<std::size_t>& these) const;
  [[nodiscard]] std::vector<Effect> with_reversal(std::vector<std::size_t>& these) const;
  [[nodiscard]] std::vector<Effect> with_phase_of_each_flank(std::vector<std::size_t>& these) const;
  [[nodiscard]] std::vector<Effect> with_pair_for(const std::vector<std::size_t>& these,
                                                  const EffectFamily& family) const;
  [[nodiscard]] std::vector<Effect> cheapest_one_form(
      const std::vector<std::vector<std::size_t>>& sets, const std::vector<Effect>& forms,
      const std::vector<Effect>& beside, std::vector<std::size_t>& these) const;
  [[nodiscard]] bool ban_what_forms_explain();
  [[nodiscard]] bool drop_idle_forms();
  [[nodiscard]] bool drop_doubtful_orders();
  [[nodiscard]] bool is_order_of_all_data(std::size_t e);
  [[nodiscard]] bool has_phases_of_its_order(const Effect& wave,
                                             const std::vector<float>& row_um) const;
  [[nodiscard]] bool is_likeliest_order(const Effect& wave, const std::vector<Effect>& beside);
  [[nodiscard]] bool ban_alike(const Effect& effect);
  void veto();
  const std::vector<RemainderFinding>& remainder_of(const std::vector<Effect>& effects,
                                                    RemainderOf which);
  [[nodiscard]] bool put_refined_shapes_on_the_grid();
  [[nodiscard]] bool settle_poses_of_scans();
  [[nodiscard]] bool linearise();
  [[nodiscard]] bool moves_points() const;
  void choose_motions();
  bool put_points_back();
  [[nodiscard]] bool ban_misnamed();
  [[nodiscard]] bool ban_impossible();
  [[nodiscard]] bool ban_waves_of_a_drift();
  void drop_impossible();
  void drop_what_mends_a_shape();
  void drop_doubtful_names();
  void join_flanks();
  void add_names(int most_values);
  void tell_two_names_as_one();
  void tell_one_flank_as_two_names_of_all();
  void tell_names_in_two_parts();
  [[nodiscard]] bool is_shown_beside(std::size_t effect,
                                     const std::vector<EffectShape>& terms) const;
  void tell_teeth_of_one_flank();
  void tell_bows_with_a_level();
  void drop_echoes_of_forms();
  void tell_parts_of_a_form();
  [[nodiscard]] bool stands_on_every_flank(const PointFit& fit, std::size_t effect) const;
  [[nodiscard]] bool stands_beside_forms(const PointFit& fit, std::size_t effect) const;
  [[nodiscard]] bool stands_beside_one_form(const PointFit& fit, std::size_t effect,
                                            bool face) const;
  [[nodiscard]] std::optional<int> flank_that_shows(const PointFit& fit, std::size_t effect,
                                                    bool face) const;
  void tell_parts_beside_forms();
  void tell_parts_of_a_sector();
  void tell_means_of_odd_forms();
  void tell_means_of_one_wave();
  void tell_parts_in_the_mean_of_waves();
  void tell_imitations();
  void tell_means_across_flanks();
  void tell_what_waves_leave();
  void tell_what_teeth_do_not_share();
  void tell_as_one_form();
  /// What was told of other data stands in front, and stays as it is.
  [[nodiscard]] std::size_t first_told_here() const {
    return options_.given.size() - given_p_values_.size();
  }
  [[nodiscard]] bool tell_as_wave_over_profile(const std::vector<std::size_t>& over_profile,
                                               FlankChoice flank);
  [[nodiscard]] bool tell_as_form_beside_slope(const std::vector<std::size_t>& all, int face,
                                               FlankChoice flank);
  [[nodiscard]] std::vector<Effect> names_along(int face, bool opposite_too = false) const;
  [[nodiscard]] int preference_of(const Effect& name) const;
  /// What a form that is tried may leave at most: before its place and widths are sought, and then.
  struct MostLeft {
    double on_the_grid = 1e300, in_place = 1e300;
    [[nodiscard]] bool operator==(const MostLeft&) const = default;
  };
  [[nodiscard]] std::vector<Effect> with_best_form(const std::vector<Effect>& rest,
                                                   const std::vector<Effect>& forms,
                                                   const MostLeft& most) const;
  [[nodiscard]] std::vector<Effect> best_form_sought(std::vector<Effect> rest,
                                                     const std::vector<Effect>& forms,
                                                     const MostLeft& most) const;
  [[nodiscard]] std::optional<double> largest_wavelength_mm(
      const std::vector<std::size_t>& of) const;
  [[nodiscard]] std::optional<RemainderFinding> wave_of_pieces(int face, FlankChoice flank) const;
  [[nodiscard]] bool tell_as_part_of_a_wave(const std::vector<std::size_t>& all, int face,
                                            FlankChoice flank);
  [[nodiscard]] bool tell_as_dish_of_all_flanks();
  [[nodiscard]] std::vector<std::vector<std::size_t>> crossed_sets(int fewest_values) const;
  [[nodiscard]] bool tell_as_corner();
  [[nodiscard]] bool tell_as_product();
  [[nodiscard]] bool tell_as_form_of_other_flanks(int face);
  [[nodiscard]] bool tell_as_name_with_a_place(int face);
  [[nodiscard]] bool put_dish_for(const std::vector<std::size_t>& these, FlankChoice flank);
  [[nodiscard]] bool tell_as_field();
  [[nodiscard]] bool tell_as_facing();
  [[nodiscard]] bool tell_as_walking_waves();
  [[nodiscard]] bool tell_as_swellings_at_end();
  [[nodiscard]] bool tell_as_alternating_wave();
  [[nodiscard]] bool tell_as_drift_aside();
  void tell_ghosts_of_teeth();
  void tell_levels_of_bowed_waves();
  [[nodiscard]] bool tell_as_bow();
  [[nodiscard]] std::vector<Effect> sectors_in_place_of(const std::vector<std::size_t>& these,
                                                        bool opposite);
  [[nodiscard]] std::vector<Effect> with_soft_sector(const std::vector<std::size_t>& these,
                                                     const Effect& sector) const;
  [[nodiscard]] std::vector<Effect> with_sector_for(std::vector<std::size_t>& these, bool opposite);
  [[nodiscard]] std::vector<Effect> with_sector(std::vector<std::size_t>& these);
  [[nodiscard]] bool tell_as_sector();
  struct WavesAround {
    std::vector<std::size_t> waves, levels;
  };
  [[nodiscard]] WavesAround waves_around(FlankChoice flank) const;
  [[nodiscard]] bool put_form_for_multiples(const WavesAround& around, int of, std::size_t fewest,
                                            const std::vector<Effect>& forms);
  [[nodiscard]] bool tell_as_repeating();
  [[nodiscard]] std::vector<std::vector<Effect>> drifts_in_place_of(
      const std::vector<std::size_t>& these, double profile, double face, bool evenly);
  [[nodiscard]] bool tell_as_drift();
  void drop_idle_beside_one_form();
  void turn_kinks_beside_slopes();
  void name_terms_beside_forms();
  [[nodiscard]] bool is_beyond_doubt(const PointFit& fit, std::size_t effect) const;
  [[nodiscard]] bool is_settled(const PointFit& fit, std::size_t effect) const;
  [[nodiscard]] bool is_settled_wave(const PointFit& fit, std::size_t effect) const;
  [[nodiscard]] std::vector<Effect> names_of_term(const Effect& term) const;
  [[nodiscard]] bool tell_as_names(int face);
  void name_what_is_settled();
  void name_forms_beside_names();
  struct LeastMissed {
    std::size_t effect = 0;
    double loss = 1e300;
  };
  [[nodiscard]] LeastMissed least_missed(std::size_t first, std::size_t end,
                                         const std::function<bool(const Effect&)>& is_asked) const;
  [[nodiscard]] std::vector<Effect> one_form_for(const std::vector<std::size_t>& these,
                                                 const std::vector<Effect>& forms,
                                                 const std::vector<Effect>& beside = {},
                                                 int more_values = 0) const;
  [[nodiscard]] bool put_one_form_for(const std::vector<std::size_t>& these,
                                      const std::vector<Effect>& forms,
                                      const std::vector<Effect>& beside = {}, int more_values = 0);
  void put_in_place_of(const std::vector<std::size_t>& these, const std::vector<Effect>& with);
  void tell_level_of_forms();
  void tell_waves_of_a_form();
  void tell_teeth_side_by_side();
  void tell_forms_of_teeth();
  void tell_tooth_of_sectors();
  [[nodiscard]] bool tell_as_form_of_some_teeth(FlankChoice flank);
  void tell_forms_of_some_teeth();
  void tell_forms_of_sectors();
  void tell_teeth_beside_dents();
  [[nodiscard]] const EffectFamily* form_instead(std::size_t effect) const;
  [[nodiscard]] std::optional<Effect> form_of_teeth(const std::vector<Effect>& rest,
                                                    FlankChoice flank, int first, int count) const;
  void doubt_names_below_what_is_left();
  void prefer_names();
  void prefer_one_name_to_two();
  [[nodiscard]] double cost_of(const std::vector<Effect>& effects) const;
  [[nodiscard]] std::vector<RemainderFinding> other_starts() const;
  [[nodiscard]] bool begins_better();
  void take_other_start();
  struct BesideForms {
    std::vector<Effect> rest;
    std::vector<std::vector<Effect>> causes;
  };
  [[nodiscard]] BesideForms beside_forms(const CourseOverFlanks& course) const;
  [[nodiscard]] std::vector<RemainderFinding> forms_around(const CourseOverFlanks& course,
                                                           int teeth) const;
  /// True where one effect is nearly what others do together, or a named wave has the order of
  /// evenly spaced swellings beside it, which are waves of that order: their sizes mean nothing.
  [[nodiscard]] bool has_pieces_that_cancel() const;
  void take_form_around();
  void take_form_around(const CourseOverFlanks& course, int teeth);
  void drop_names_that_may_be_nothing();
  [[nodiscard]] bool adopt_if_simpler(Options options, int least_spared);
  void take_over(PartLoop& other);
  [[nodiscard]] const EffectFamily* form_of_level(std::size_t effect) const;
  [[nodiscard]] bool has_single_values_only() const;
  void look_at_single_teeth();
  void drop_teeth_within_the_tails();
  void look_at_sizes();
  void look_at_neighbours();
  [[nodiscard]] bool neighbours_share() const;
  void leave_out_across_steps();
  void divide_into_patches();
  void forget_roughness_of_forms();
  void forget_fits();
  [[nodiscard]] DiscoveryProblem& candidates_problem();

  const FlankGeometry& geometry_;
  Options options_;
  SharedTable table_;
  Patches patches_;
  std::vector<Effect> candidates_;
  std::vector<bool> banned_, unseen_;
  std::array<FlankReach, 2> reach_;  ///< of the sides: 1 the one that lies counter-clockwise
  DiscoveryProblem problem_;         ///< of the candidates on the patches; without groups: not yet
  std::vector<Effect> problem_of_;   ///< candidates as they stand in it
  std::optional<Discovery> choice_;  ///< of problem_; its rest is not asked yet
  DiscoveryResult
      discovery_;  ///< chosen: in the order of effects_; group -1: not of the candidates
  std::vector<Effect> effects_;
  std::vector<Effect> left_beside_;  ///< beside which the test of what is left was made
  SharedByNeighbours neighbours_;
  bool vetoed_ = false;                ///< effects were taken back
  std::optional<Effect> denied_spot_;  ///< one of them, though it stands out beyond doubt
  std::vector<double> given_p_values_;
  std::vector<RemainderFinding> beside_slopes_;  ///< forms that the data show beside a slope
  bool asked_for_starts_ = false;            ///< whether the choice was made again from them
  std::unique_ptr<PartLoop> other_start_;    ///< the best of these choices
  /// Residuals and what was found in them, for one set of effects.
  struct Kept {
    bool valid = false;
    std::vector<Effect> effects;
    std::shared_ptr<const std::vector<float>> row_um;
    std::array<std::optional<std::vector<RemainderFinding>>, 2> findings;  ///< of training, of all
  };
  Kept kept_;
  mutable std::vector<std::shared_ptr<const PointFit>> fits_;  ///< the one asked for last first
  mutable std::shared_ptr<const PointFit> plain_fit_;
  /// Forms that were sought, and what was found: different steps ask the same.
  struct SoughtForm {
    std::vector<Effect> rest, forms;
    MostLeft most;
    std::vector<Effect> found;
  };
  mutable std::deque<SoughtForm> sought_;               ///< the last one last
  mutable std::vector<Effect> no_products_in_;          ///< for which no product stands
  std::shared_ptr<const std::vector<float>> plain_um_;  ///< what it leaves, where it was looked at
  /// A form and the names it was compared with; while forms are compared one after the other, and
  /// until the columns of candidates are made.
  mutable std::vector<Effect> names_of_;
  mutable DiscoveryProblem names_;
  std::vector<FoundEffect> alone_;
  std::vector<RemainderFinding> remainder_;  ///< what no effect found took up
};

/// Columns of effects that are fitted whatever is selected.
void add_nuisance(DiscoveryProblem& problem, const DiscoveryProblem& fitted);

/// What effects are told by: their sizes, and with places and widths those that were sought.
[[nodiscard]] int values_of(const std::vector<Effect>& effects, bool places_too);

/// Where an effect's interval and that of values one a tooth alone have nothing in common: says so
/// in the notes, and the interval holds both.
void say_where_records_differ(const std::vector<FoundEffect>& alone, LoopResult& result);

}  // namespace trueflank::loop
