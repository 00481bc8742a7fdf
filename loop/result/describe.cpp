// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/result/describe.h"

#include <algorithm>
#include <cmath>

namespace trueflank::loop {

Parameter parameter_of(const std::string& name, double value, double half) {
  return {name, value, value - half, value + half};
}

std::pair<Parameter, Parameter> wave_parameters(const EffectFacts& facts, double c, double s,
                                                const Eigen::Matrix2d& covariance, double t) {
  const double amplitude = std::hypot(c, s);
  const Eigen::Vector2d along(c / amplitude, s / amplitude), across(-s / amplitude, c / amplitude);
  const double half = t * std::sqrt(std::max(0.0, along.dot(covariance * along)));
  const double turn = t * std::sqrt(std::max(0.0, across.dot(covariance * across))) / amplitude;
  const double phase = deg_from_rad(std::atan2(s, c)) / facts.phase_divisor;
  const double spread = deg_from_rad(std::min(turn, kPi)) / facts.phase_divisor;
  return {{facts.parameters[0], amplitude, std::max(0.0, amplitude - half), amplitude + half},
          {facts.parameters[1], phase, phase - spread, phase + spread}};
}

Term term_of(const EffectFacts& facts, const std::vector<double>& shape) {
  Term term;
  term.shape = shape;
  for (std::size_t k = 0; k < facts.term_keys.size() && k < shape.size(); ++k) {
    const TermKey& key = facts.term_keys[k];
    switch (key.kind) {
      case TermKey::Kind::kInteger: term.keys.emplace_back(key.name, static_cast<int>(shape[k])); break;
      case TermKey::Kind::kNumber: term.keys.emplace_back(key.name, shape[k]); break;
      case TermKey::Kind::kWord: term.keys.emplace_back(key.name, key.words[shape[k] != 0.0 ? 1 : 0]); break;
    }
  }
  return term;
}

void sort_by_size(std::vector<Term>& terms) {
  std::sort(terms.begin(), terms.end(),
            [](const Term& a, const Term& b) { return a.amplitude() > b.amplitude(); });
}

std::vector<Parameter> parameters_of_terms(const std::vector<Term>& terms, double order,
                                           const std::string& key, bool with_phase) {
  const Term& main = terms.front();
  const double amplitude = main.amplitude();
  std::vector<Parameter> parameters{{"order", order, order, order},
                                    {key, amplitude, std::max(0.0, amplitude - main.half_width),
                                     amplitude + main.half_width}};
  if (!with_phase) return parameters;
  const double phase = deg_from_rad(std::atan2(main.sin, main.cos));
  const double spread = deg_from_rad(std::min(kPi, main.half_width / amplitude));
  parameters.push_back({"phase_deg", phase, phase - spread, phase + spread});
  return parameters;
}

std::string measurement_between(const std::string& one, const EffectFacts* facts, const std::string& other,
                                const EffectFacts* other_facts, const std::string& otherwise) {
  for (const auto& [from, to] : {std::pair(facts, other), std::pair(other_facts, one)}) {
    if (from == nullptr) continue;
    for (const ToldFrom& told : from->told_from)
      if (told.id == to) return told.measurement;
  }
  return otherwise;
}

void say_once(std::vector<std::string>& sentences, const std::string& sentence) {
  if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
    sentences.push_back(sentence);
}

}  // namespace trueflank::loop
