// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/result/describe.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/number_text.h"

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

namespace {

/// Which of a key's words a shape value means.
std::size_t word_of(const TermKey& key, double value) {
  return value == 0.0 ? 0
                      : std::clamp<std::size_t>(static_cast<std::size_t>(std::abs(value)), 1,
                                                key.words.size() - 1);
}

}  // namespace

Term term_of(const EffectFacts& facts, const std::vector<double>& shape) {
  Term term;
  term.shape = shape;
  if (!facts.form_word.empty()) term.keys.emplace_back("form", facts.form_word);
  for (std::size_t k = 0; k < facts.term_keys.size() && k < shape.size(); ++k) {
    const TermKey& key = facts.term_keys[k];
    switch (key.kind) {
      case TermKey::Kind::kInteger: term.keys.emplace_back(key.name, static_cast<int>(shape[k])); break;
      case TermKey::Kind::kNumber: term.keys.emplace_back(key.name, shape[k]); break;
      case TermKey::Kind::kWord:
        term.keys.emplace_back(key.name, key.words.at(word_of(key, shape[k])));
        break;
      case TermKey::Kind::kNumbers:
        term.keys.emplace_back(
            key.name,
            std::vector<double>(shape.begin() + static_cast<std::ptrdiff_t>(k), shape.end()));
        break;
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

namespace {

/// "scale or tip relief".
std::string any_of_ids(const std::vector<std::string>& ids) {
  std::string words;
  for (const std::string& id : ids) words += (words.empty() ? "" : " or ") + id;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

std::string sure_words(double p_value, const std::vector<std::string>& confounded_with) {
  std::string text;
  if (std::isnan(p_value)) {
    text = "how sure it is was not asked";
  } else {
    // The largest round number of data sets of which chance alone would make less than one look so.
    double sets = 1.0;
    for (const double next : {5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 1e4, 1e6})
      if (p_value * next < 1.0 - 1e-9) sets = next;
    const char* word = sets >= 500.0   ? "as good as certain"
                       : sets >= 50.0  ? "sure"
                       : sets >= 10.0  ? "likely"
                                       : "a guess";
    text = std::string(word) + ": chance alone does this less than once in " + printed("%.0f", sets) +
           " data sets";
    if (sets < 5.0) text = "a guess: chance alone does this as easily";
  }
  return text + open_names(confounded_with);
}

std::string open_names(const std::vector<std::string>& confounded_with) {
  if (confounded_with.empty()) return "";
  return "; the name is open: " + any_of_ids(confounded_with) + " would look the same here";
}

std::string once_ruled_out(const std::vector<std::string>& confounded_with) {
  if (confounded_with.empty()) return "";
  return " once " + any_of_ids(confounded_with) + ", which would look the same here, is ruled out";
}

void share_out(std::vector<FoundEffect>& effects, const std::vector<double>& mean_squares,
               double whole) {
  const double sum = std::accumulate(mean_squares.begin(), mean_squares.end(), 0.0);
  for (std::size_t i = 0; i < effects.size() && i < mean_squares.size(); ++i)
    effects[i].explained_fraction =
        sum > 0.0 ? std::clamp(whole, 0.0, 1.0) * mean_squares[i] / sum : 0.0;
}

std::string first_action(const std::string& correction) {
  return correction.empty() ? "" : "; " + correction.substr(0, correction.find(';'));
}

void ToldApart::add(const std::string& one, const std::string& other, const std::string& measurement) {
  auto place = std::find_if(by_measurement_.begin(), by_measurement_.end(),
                            [&](const auto& entry) { return entry.first == measurement; });
  if (place == by_measurement_.end())
    place = by_measurement_.insert(by_measurement_.end(), {measurement, {}});
  const auto same = [&](const auto& pair) {
    return pair == std::pair(one, other) || pair == std::pair(other, one);
  };
  if (std::none_of(place->second.begin(), place->second.end(), same)) place->second.emplace_back(one, other);
}

void ToldApart::say(std::vector<std::string>& sentences, const std::string& verb) const {
  for (const auto& [measurement, pairs] : by_measurement_) {
    std::string told;
    for (const auto& [one, other] : pairs) told += (told.empty() ? "" : ", ") + one + " from " + other;
    say_once(sentences, verb + " " + measurement + ": it distinguishes " + told + ", which these data cannot");
  }
}

void say_once(std::vector<std::string>& sentences, const std::string& sentence) {
  if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
    sentences.push_back(sentence);
}

}  // namespace trueflank::loop
