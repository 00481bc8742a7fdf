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
/// Appends a sentence that is not there yet.
void say_once(std::vector<std::string>& sentences, const std::string& sentence);

}  // namespace trueflank::loop
