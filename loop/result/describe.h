// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/result/effect_facts.h"
#include "trueflank/loop/result/loop_result.h"

// From fitted columns to what people read: the same for gears and drives.
namespace trueflank::loop {

/// value -+ half.
[[nodiscard]] Parameter parameter_of(const std::string& name, double value, double half);
/// Amplitude and phase of a cosine and a sine coefficient, with intervals to first order; `t`: standard
/// errors of a 95 % interval.
[[nodiscard]] std::pair<Parameter, Parameter> wave_parameters(const EffectFacts& facts, double cosine,
                                                              double sine,
                                                              const Eigen::Matrix2d& covariance, double t);
/// A term of an effect without a name from its shape, as its facts have it written.
[[nodiscard]] Term term_of(const EffectFacts& facts, const std::vector<double>& shape);
/// The strongest term first.
void sort_by_size(std::vector<Term>& terms);
/// Order, amplitude and phase of the strongest term (the first): what an effect without a name has for
/// parameters. `key`: of the amplitude.
[[nodiscard]] std::vector<Parameter> parameters_of_terms(const std::vector<Term>& terms, double order,
                                                         const std::string& key, bool with_phase);
/// The measurement that tells one effect from the other; `otherwise` where neither says. Facts may be
/// nullptr: of an effect that is in no library.
[[nodiscard]] std::string measurement_between(const std::string& one, const EffectFacts* facts,
                                              const std::string& other, const EffectFacts* other_facts,
                                              const std::string& otherwise);
/// How sure a finding is, in words that hold a bound of its probability: "sure: chance alone does this less
/// than once in 100 data sets". `confounded_with`: what the name may be instead.
[[nodiscard]] std::string sure_words(double p_value, const std::vector<std::string>& confounded_with);
/// "; the name is open: taper would look the same here"; empty where none would.
[[nodiscard]] std::string open_names(const std::vector<std::string>& confounded_with);
/// Gives effects their shares of `whole`, what all explain of the variance: in proportion to the
/// mean squares of what each, as large as it is told, adds to the values. Where effects neither
/// help nor undo each other these are what each explains; else no other division that adds up
/// exceeds them by so little.
void share_out(std::vector<FoundEffect>& effects, const std::vector<double>& mean_squares,
               double whole);
/// "; " and the first thing to do of a correction; empty where there is none.
[[nodiscard]] std::string first_action(const std::string& correction);
/// What stands after an action whose effect's name is open: " once scale, which would look the same
/// here, is ruled out"; empty where it is not.
[[nodiscard]] std::string once_ruled_out(const std::vector<std::string>& confounded_with);
/// Pairs of effects that no data told apart, each measurement that would tell once: "measure the index of both
/// flanks: it tells lobing from pitch_wave".
class ToldApart {
 public:
  void add(const std::string& one, const std::string& other, const std::string& measurement);
  /// `verb`: "measure" or "run".
  void say(std::vector<std::string>& sentences, const std::string& verb) const;

 private:
  std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> by_measurement_;
};
/// Appends a sentence that is not there yet.
void say_once(std::vector<std::string>& sentences, const std::string& sentence);

}  // namespace trueflank::loop
