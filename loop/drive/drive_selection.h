// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/drive/close_drive_loop.h"
#include "trueflank/loop/drive/drive_fit.h"
#include "trueflank/loop/drive/wave_spectrum.h"

namespace trueflank::loop {

/// Figures that effects have together: coefficients, and the shapes that move.
[[nodiscard]] int size_of(const std::vector<DriveEffect>& effects);
/// The same with what a scan chose: where in the run or a turn something begins and ends.
[[nodiscard]] int size_with_changes(const std::vector<DriveEffect>& effects);

/// One outcome of the engine with its shapes refined on the training rows.
struct DriveOutcome {
  DiscoveryResult discovery;
  std::vector<DriveEffect> effects;
  Eigen::VectorXd fold_errors;
  double square = 0.0,
         rows = 1.0;  ///< of what it leaves of the training rows, in their noise's units
  /// Times as much as independent rows that the sums over units scatter: errors inside a unit hang together.
  double shared = 1.0;
  [[nodiscard]] int size() const { return size_of(effects); }
  [[nodiscard]] int preference() const {
    int sum = 0;
    for (const DriveEffect& effect : effects) sum += effect.family->preference;
    return sum;
  }
  [[nodiscard]] bool has(const DriveFamily* family) const {
    return std::any_of(effects.begin(), effects.end(),
                       [&](const DriveEffect& e) { return e.family == family; });
  }
};

class BesideEffects;

/// True where the fuller set takes off more than what chance lets the figures that it has more.
[[nodiscard]] bool earns_its_figures(const DriveOutcome& fuller, const DriveOutcome& plain);

/// The choice of the effects of a drive: what the engine finds among all candidates, made simpler
/// where less explains as well, and held to the rows that were locked away.
class DriveSelection {
 public:
  DriveSelection(const DriveModel& model, BenchTable table, const DriveLoopOptions& options);

  /// The effects that are left at the end.
  DriveOutcome run();

  [[nodiscard]] DriveContext context() const;
  /// Of what hangs together some is left when units were merged: a quarter of the level makes up
  /// for it.
  [[nodiscard]] double share_of_level() const { return table_.drifts ? 0.25 : 1.0; }
  /// Friction and scale of a fit become the place about which the model is linear.
  [[nodiscard]] static DriveState state_of(const DriveFit& fit);
  /// False where a friction that differs between the directions would be next to nothing in one.
  [[nodiscard]] bool rubs_both_ways(const DriveState& state) const;
  /// False where the friction of one mesh would be next to nothing beside the design's.
  [[nodiscard]] bool every_mesh_rubs(const DriveState& state) const;
  /// True of two readings with names that together are next to nothing of what each is.
  [[nodiscard]] static bool readings_cancel(const DriveFit& fit, std::size_t one,
                                            std::size_t other);
  /// The place about which the model is linear.
  void move_state_to(const DriveState& state) { state_ = state; }

  [[nodiscard]] const DriveModel& model() const { return model_; }
  [[nodiscard]] const BenchTable& table() const { return table_; }
  [[nodiscard]] const DriveState& state() const { return state_; }
  /// Measured less predicted driven torque of each row, newton metres.
  [[nodiscard]] const Eigen::VectorXd& value_nm() const { return value_; }
  [[nodiscard]] const std::vector<DriveEffect>& candidates() const { return candidates_; }
  /// Effects that explain as much in place of one that was taken, by its id.
  [[nodiscard]] const std::map<std::string, std::set<std::string>>& exchangeable() const {
    return exchangeable_;
  }
  /// Effects were taken back.
  [[nodiscard]] bool vetoed() const { return vetoed_; }
  /// How sure a form was (chi-square) that the hold-out denied; 0: none was.
  [[nodiscard]] double most_denied() const { return most_denied_; }
  /// False where data that gain power leave no room for this loss.
  [[nodiscard]] bool may_be_there(const DriveFamily& family) const;
  /// The table; nothing else is asked for afterwards.
  [[nodiscard]] BenchTable take_table() { return std::move(table_); }

 private:
  void measure_residual();
  [[nodiscard]] bool gains_power() const {
    return table_.impossible == Impossible::kEfficiencyAboveOne;
  }
  /// The effects that are left at the end, of all that may be there.
  DriveOutcome choose();
  /// True of so many rows that effects are sought on some of them.
  [[nodiscard]] bool is_a_log() const;
  /// The same of a log: sought on some rows, and settled on all.
  DriveOutcome of_a_log();
  /// Effects with a name that only so many rows show, where nothing is left beside them.
  void add_names_that_many_rows_show(DriveOutcome& outcome);
  [[nodiscard]] double rows_of_training() const;
  /// Data that gain power show a sensor that misreads, and a loss beside it is as unsure as that is. It is
  /// fitted where both directions were run, the sensors alone leave more than it does, and nothing is left
  /// beside it.
  DriveOutcome losses_beside_gains(DriveOutcome sensors);
  template <class Predicate>
  bool ban(const Predicate& which) {
    bool any = false;
    for (std::size_t g = 0; g < candidates_.size(); ++g)
      if (!banned_[g] && which(candidates_[g])) banned_[g] = any = true;
    return any;
  }

  /// The engine's choice among all that is not banned.
  [[nodiscard]] Discovery select();
  /// The same with its shapes refined.
  [[nodiscard]] DriveOutcome outcome_of(const DiscoveryResult& chosen) const;
  [[nodiscard]] double shared_inside_units(const DriveFit& fit) const;
  /// Selection until shapes, friction and scale stand still and no effect has the wrong sign.
  DriveOutcome settle();
  bool put_shapes_on_the_grid(const DriveOutcome& outcome);
  bool ban_wrong_signs(const DriveOutcome& outcome);
  bool move_state(const DriveOutcome& outcome);
  /// Where the spectrum of what is left has a line that noise would not make: one candidate more.
  bool propose_wave(const DriveOutcome& outcome);
  /// Effects with a name that do as well as this wave beside others, in all their shapes.
  [[nodiscard]] std::vector<DriveEffect> names_of_wave(const std::vector<DriveEffect>& beside,
                                                       const DriveEffect& wave) const;
  /// Where a part of the run, or of every turn of a shaft, differs from the rest more than noise
  /// would: one candidate more. What goes round with the angle, or has no name, may only imitate it
  /// and is left out while it is looked for; a spell that was chosen stays.
  bool propose_spell(const DriveOutcome& outcome);
  /// Where the rest moves slowly over the run as noise would not, whatever has no name left out:
  /// one candidate more.
  bool propose_wander(const DriveOutcome& outcome);
  /// Where a loss dies away and comes again after as many rows: one candidate more.
  bool propose_rest(const DriveOutcome& outcome);
  /// What the training leaves of these effects, some of them left out.
  [[nodiscard]] Eigen::VectorXd left_without(
      const DriveOutcome& outcome,
      const std::function<bool(const DriveEffect&)>& is_left_out) const;
  /// Where the rest jumps to and fro between two levels at no regular times: one candidate more.
  bool propose_states(const DriveOutcome& outcome);
  /// False where it is one already.
  bool add_candidate(const DriveEffect& effect);
  /// Tries the named effects in the order in which people would think of them: where the plainer
  /// ones predict as well as what the engine chose among all, they are kept.
  DriveOutcome plainest(DriveOutcome outcome);
  [[nodiscard]] static bool is_plainer(const DriveOutcome& other, const DriveOutcome& outcome);
  /// Plain effects that predict nearly as well as a set with a description: one of them left out after the
  /// other, as a plainer one may stand in the way of the one that does it. `other` where none is enough.
  DriveOutcome with_another_name(DriveOutcome other, const DriveOutcome& outcome,
                                 const std::vector<bool>& banned);
  /// Leaves out one kind of effect after the other: where the rest finds a set that predicts as
  /// well, the two cannot be told apart, and the simpler one is kept.
  DriveOutcome simplest(DriveOutcome outcome);
  /// The simplest, but for one that leaves structure of which the fuller set leaves none.
  DriveOutcome simplest_that_is_enough(DriveOutcome whole);
  /// Asked of the training rows alone.
  [[nodiscard]] bool leaves_structure(const DriveOutcome& outcome) const;
  /// A selection among fewer candidates, about its own state; wrong signs are banned in it alone.
  DriveOutcome settled(std::vector<bool> banned);
  /// The state of an outcome that was settled about another one.
  void settle_state(const DriveOutcome& outcome);
  /// A polynomial over one quantity only imitates a step or a hump over it: where one of these, of fewer
  /// figures, leaves no more, it takes its place. The engine asks the folds, of which what stands in a short
  /// part of the run fills few.
  void sharpen_courses(DriveOutcome& outcome);
  /// Descriptions over one quantity, and names that mend them, told as one form beside drag and
  /// friction where that leaves no more than chance: where a loss begins, stands out or jumps.
  struct OneForm;
  struct PricedForm;
  void tell_as_one_form(DriveOutcome& outcome);
  /// Of a set with two new forms without a name the first alone, as the last effect; empty of
  /// others.
  [[nodiscard]] static OneForm without_second_form(const OneForm& set);
  void add_sets_with_one_form(const DriveOutcome& outcome, const OneForm& base, double over,
                              bool with_load, std::vector<OneForm>& sets);
  /// What a set leaves, and its figures; false where an amount cannot be what it is called.
  [[nodiscard]] bool fits(OneForm& set) const;
  /// What its training leaves of all rows.
  [[nodiscard]] double square_of_all(const OneForm& set) const;
  /// Of every kind the form over a quantity that takes most off beside these effects.
  [[nodiscard]] std::vector<DriveEffect> likeliest_forms(const std::vector<DriveEffect>& base,
                                                         double over) const;
  /// Of few rows a name that is as good as certain by a normal law, where nothing was chosen or one
  /// name that leaves surely more. True where one was taken.
  bool take_what_few_rows_show(DriveOutcome& outcome);
  /// A name of the whole run and a jump that takes it back, told as a loss of the first rows.
  void tell_as_first_rows(DriveOutcome& outcome);
  /// Effects that together do what one form does alone, told as that.
  void tell_as_alike(DriveOutcome& outcome);
  bool tell_as_alike(DriveOutcome& outcome, const DriveFamily& family);
  /// A wave over the angle may be in proportion to the load, grow over the run, or come by the
  /// clock: told so where that leaves surely less than it and the waves beside it.
  void tell_waves(DriveOutcome& outcome);
  /// Parts of one turn, and the waves that make one up, told as one place of it.
  void tell_as_one_place_of_a_turn(DriveOutcome& outcome);
  /// Each of what may be all that a bench holds in place of what was chosen, or beside its names:
  /// told where it leaves clearly less, or does alone what several pieces do.
  void tell_as_whole_forms(DriveOutcome& outcome);
  /// A short loss that comes again at no turn of a shaft, in place of all that has no name.
  void tell_as_pits(DriveOutcome& outcome);
  /// A loss that comes and goes over the run in waves: with the load or the speed, or of a period
  /// that changes.
  void tell_as_waves_of_the_run(DriveOutcome& outcome);
  /// A loss that starts at rows of the run and dies away.
  void tell_as_starts(DriveOutcome& outcome);
  /// Starts that do nearly as well of the rows seen, and of all rows surely better. The last effect
  /// has them.
  void let_held_out_rows_settle_starts(std::vector<DriveEffect>& effects) const;
  /// Losses that nearly every bench has and that hold what is the same everywhere of others.
  [[nodiscard]] std::vector<DriveEffect> plain_losses() const;
  [[nodiscard]] std::vector<DriveEffect> with_plain_losses(std::vector<DriveEffect> effects) const;
  /// The names that may stand beside what comes again, without the plain ones.
  [[nodiscard]] OneForm names_beside_what_comes_again(const DriveOutcome& outcome) const;
  /// The best of these sets, of which the last is the form, with any of the plain losses, where it
  /// leaves clearly less than the outcome or does alone what several do. True where one was told.
  bool tell_if_clearly(DriveOutcome& outcome, const std::vector<PricedForm>& found);
  /// A kin of a form that leaves the same of the rows seen, and of all rows surely less.
  void let_held_out_rows_settle_kin(DriveOutcome& outcome);
  /// A form that may be all there is, what it takes off, and how dear the looks for it are
  /// (chi-square).
  struct WholeForm {
    DriveEffect effect;
    double gain = 0.0, looks = 0.0;
  };
  /// The shapes of these, with their columns: computed once for a state.
  struct WholeColumns {
    std::vector<DriveEffect> effects;
    Eigen::MatrixXf columns;
    DriveState state;
  };
  void fill_whole_columns();
  /// What is left of the price of its looks beside that of what it stands for (chi-square).
  [[nodiscard]] double looks_beyond(const DriveOutcome& outcome, const PricedForm& priced) const;
  /// True where names that the set does not hold take back in one direction what they do.
  [[nodiscard]] bool drop_names_that_cancel(const DriveOutcome& outcome, const OneForm& set) const;
  /// True where one was told. `pieces_too`: several pieces may also be two forms.
  bool tell_as_one_whole(DriveOutcome& outcome, bool pieces_too);
  /// Waves of one direction, or of a part of the range, of which the spectra of parts tell.
  void add_waves_of_parts(const std::vector<DriveEffect>& base,
                          std::vector<WholeForm>& forms) const;
  /// Of this order the likeliest wave that grows with the square of the speed, the likeliest that
  /// is largest at a speed, and the likeliest whose phase goes with the speed or the load.
  [[nodiscard]] std::vector<DriveEffect> waves_by_speed_or_load(
      const std::vector<DriveEffect>& base, double order) const;
  void add_waves_over_the_angle(const std::vector<DriveEffect>& base,
                                std::vector<WholeForm>& forms) const;
  /// Of places that leave the same of the rows seen those that are locked away say which it is: on
  /// which side of an edge they lie.
  void let_held_out_rows_settle_sides(OneForm& set) const;
  /// True where the hold-out would take some of it back.
  [[nodiscard]] bool is_denied(DriveOutcome outcome);
  /// Two levels far apart, of which every row may have either.
  void tell_as_scattered_states(DriveOutcome& outcome);
  /// The names that may stand beside levels: none that changes over the run.
  [[nodiscard]] static OneForm names_beside_levels(const DriveOutcome& outcome, bool with_drag);
  /// Levels that are new after every jump of the run, in place of all that follows the run.
  void tell_as_levels_of_the_run(DriveOutcome& outcome);
  /// Effects beside which whole forms are asked. `with_places`: also where a loss begins, jumps or
  /// stands out.
  struct AskedBeside {
    std::vector<DriveEffect> base;
    bool with_places = false;
  };
  /// The likeliest forms beside each, at their best places near by.
  [[nodiscard]] std::vector<std::vector<WholeForm>> whole_forms(
      const std::vector<AskedBeside>& asked) const;
  /// The same beside one, where a coarse look finds them.
  [[nodiscard]] std::vector<WholeForm> likeliest_whole_forms(const AskedBeside& asked,
                                                             const BesideEffects& beside) const;
  [[nodiscard]] OneForm as_it_is(const DriveOutcome& outcome) const;
  /// The last of the set is new, and surer than what it stands for by `gain` (chi-square).
  void exchange_as_sure(DriveOutcome& outcome, const OneForm& set, double gain);
  /// The same, where the rows held out do not deny the set alone: else the outcome stays, and how
  /// sure the set was is kept. True where it was exchanged.
  [[nodiscard]] bool exchange_unless_denied(DriveOutcome& outcome, const OneForm& set, double gain);
  /// `name_is_open`: the names it stands for explain as much.
  void exchange_effects(DriveOutcome& outcome, const OneForm& set, bool name_is_open);
  /// What follows the temperature may follow the run in which the drive grew warm: where that leaves surely
  /// less, it takes its place.
  void follow_the_run(DriveOutcome& outcome);
  void settle_after_exchange(DriveOutcome& outcome);
  /// A name of no more figures that people think of earlier takes the place of one that explains no
  /// more: beside forms that were told late the choice among names is asked again.
  void prefer_plainer_names(DriveOutcome& outcome);
  /// False where an amount cannot be what it is called.
  [[nodiscard]] bool is_possible(const DriveOutcome& outcome) const;
  /// Of several effects those that are nothing once all shapes are free: they only mended another's
  /// shape.
  void drop_what_is_nothing(DriveOutcome& outcome);
  /// A gain that changes and is right somewhere stands for a scale beside it: where it is right is
  /// moved, and the scale goes.
  void absorb_the_scale(DriveOutcome& outcome);
  /// What looked most like structure that is left was asked beside the effects as they were chosen:
  /// beside those that took their place it may be nothing.
  void ask_what_is_left_again(DriveOutcome& outcome);
  /// The locked hold-out may say no: while its error would rise, the effect goes that harms it
  /// most.
  void veto(DriveOutcome& outcome);
  /// Where the hold-out denies the simpler set: what was chosen before it was made simpler, if it
  /// denies none of that.
  void stand_by_the_whole(const DriveOutcome& whole, DriveOutcome& outcome);
  void leave_out(DriveOutcome& outcome, std::size_t effect);
  void remember(const DriveOutcome& kept, const DriveOutcome& other);

  static constexpr std::size_t kMostSoughtRows = 1000, kMostSettledRows = 12000;

  const DriveModel& model_;
  const DriveLoopOptions& options_;
  BenchTable table_;
  const EfficiencyCurve curve_;
  const std::vector<EfficiencyCurve> mesh_curves_;
  DriveState state_;
  Eigen::VectorXd value_;
  std::vector<DriveEffect> candidates_;
  DriveProblem problem_;  ///< made for candidates and state when they were last asked
  std::vector<bool> banned_;
  WaveSpectra spectra_;
  std::map<std::string, std::set<std::string>> exchangeable_;
  bool vetoed_ = false;  ///< effects were taken back
  double most_denied_ = 0.0;
  bool losses_beside_gains_ = false;
  WholeColumns whole_;
};

}  // namespace trueflank::loop
