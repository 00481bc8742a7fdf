// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

// What an effect of a gear and one of a drive have in common: everything that does not ask where a value
// was measured.
namespace trueflank::loop {

/// How coefficients of the columns become the parameters people read.
enum class ParameterForm {
  kPlain,  ///< a parameter a column
  kWave,   ///< two columns (cosine, sine): amplitude and phase
};

/// Another effect that the same data may show.
struct ToldFrom {
  std::string id;
  std::string measurement;  ///< that tells the two apart
};

/// How a shape value of an effect without a name is written among its terms.
struct TermKey {
  enum class Kind {
    kInteger,
    kNumber,
    kWord,
    kNumbers,  ///< all values from there on: a list
  };
  std::string name;
  Kind kind = Kind::kInteger;
  std::vector<std::string> words = {};  ///< kWord: for 0, for 1 (and all beyond the last), ...
};

/// What is known of one kind of effect before any data. One object in one file of effects/.
struct EffectFacts {
  std::string id;
  std::string description, cause;
  std::string correction;               ///< what the maker should do
  std::vector<std::string> parameters;  ///< with their unit; kPlain: one a column; kWave: amplitude, phase
  /// Values that shape the columns and are searched: order, height_mm, tooth, ...
  std::vector<std::string> shape_names = {};
  /// What files mean that do not have them; empty: they must.
  std::vector<double> shape_where_absent = {};
  ParameterForm form = ParameterForm::kPlain;
  double phase_divisor = 1.0;  ///< kWave: phase = angle / divisor (2 for an axis in the plane)
  bool named = true;           ///< false: a description without a cause
  bool only_positive = false;  ///< an amount below zero is not this effect
  int preference = 0;          ///< lower wins between equals
  /// Pairs may stand with either of the two.
  std::vector<ToldFrom> told_from = {};
  /// Causes of this one effect that no measurement of the same kind tells apart, and what would; may be
  /// empty.
  std::string causes_told_by = {};
  /// Sentence for data that cannot show it: what would. Effects of one sentence are shown by the same.
  std::string shown_by = {};
  /// What its form is called where its cause cannot be: "bulge_at_lower_face"; empty: not at all.
  std::string form_word = {};
  /// That form in words, for a coefficient above and below 0; empty: as its description.
  std::array<std::string, 2> form_told = {};
  /// Effects without a name: how a term of theirs is written, a key a value of its shape.
  std::vector<TermKey> term_keys = {};
};

}  // namespace trueflank::loop
