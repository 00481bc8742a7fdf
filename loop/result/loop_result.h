// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "trueflank/base/units.h"

// What the loop found out, before it is written anywhere. Used for gears and for whole drives.
namespace trueflank::loop {

struct Parameter {
  std::string name;   ///< with its unit, as in loop.json
  double value = kNaN;
  double low = kNaN, high = kNaN;  ///< 95 % interval
};

/// Unit of the figures of a result.
struct ResultUnit {
  const char* key;         ///< ends the keys of loop.json
  const char* text;        ///< as sentences write it
  const char* sign;        ///< as pages write it
  bool efficiency_points;  ///< errors are told in points of efficiency too
};
inline constexpr ResultUnit kMicrometres{"um", "um", "µm", false},
    kNewtonMetres{"nm", "N m", "N m", true};

/// One term of an effect without a name, in the unit of the result: of a gear Legendre(profile) x
/// Legendre(face) x order around it; of a drive a loss torque at the input, Legendre(load) x
/// Legendre(speed) x Legendre(temperature), or a wave over the input's angle.
struct Term {
  std::vector<double> shape;  ///< as its effect has it
  /// The shape as loop.json writes it.
  std::vector<std::pair<std::string, std::variant<int, double, std::string, std::vector<double>>>>
      keys;
  double cos = 0.0, sin = 0.0;  ///< sin 0 where it is no wave
  double half_width = 0.0;      ///< of the 95 % interval of the amplitude
  std::string text;             ///< in words
  [[nodiscard]] double amplitude() const;
};

struct FoundEffect {
  std::string id;
  bool named = true;
  /// One line for the shop: what is wrong, what follows from it, what to do.
  std::string sentence;
  std::string sure;  ///< how sure it is, in words (describe.h)
  std::string description, cause, correction;
  /// Where the process is not known: ways of making, and what causes such a form in each.
  std::vector<std::pair<std::string, std::string>> by_process;
  std::string flank = "both";
  std::vector<Parameter> parameters;
  std::vector<Term> terms;  ///< unnamed effects
  std::string side;         ///< of a sensor effect: input or output; else empty
  /// Effects a user declared: name and formula of every parameter.
  std::vector<std::pair<std::string, std::string>> form;
  double explained_fraction = 0.0;
  double held_out_gain = kNaN;  ///< in the unit of the result
  double p_value = kNaN;
  double bic_gain = kNaN;
  std::vector<std::string> confounded_with;
  /// What is to be measured again before it is believed; empty: nothing.
  std::string measure_again = {};
  /// Waves per turn that the teeth that were traced would show alike; empty: none.
  std::vector<int> orders_alike;
  bool correctable = true;
  /// Why it is not corrected although its kind could be; empty: it is, or its kind cannot.
  std::string not_corrected = {};
  /// @name Where several parts were measured
  /// @{
  std::optional<bool> repeatable = {};  ///< told from one-off effects; empty: one part only
  double repeat_p_value = kNaN;         ///< of a mean like this if it were random from part to part
  std::string part = {};                ///< of a one-off effect: the part it is on
  struct InPart {
    std::string part;
    std::vector<std::pair<std::string, double>> parameters;
  };
  std::vector<InPart> in_parts = {};    ///< fitted to each part alone
  /// @}
};

enum class Verdict { kNoEffect, kExplained, kPartlyExplained };
[[nodiscard]] const char* to_text(Verdict verdict);

struct ErrorFigures {
  double rms = 0.0, held_out_rms = kNaN, max = 0.0;
  double rms_points = kNaN, held_out_rms_points = kNaN;  ///< drives: points of efficiency
};

/// What one effect would have to be to explain a few numbers that cannot single any out.
struct PossibleExplanation {
  std::string id;
  std::vector<Parameter> parameters;  ///< without intervals: as many equations as unknowns, or fewer
  double load_nm = kNaN;              ///< output torque at which it would; NaN: at any
  std::vector<std::string> explains;  ///< names of the quantities it then meets
  double left_points = kNaN;          ///< rms of the efficiencies it leaves
  double left_nm = kNaN;              ///< of the starting torque
  std::string text;
};

/// A figure of ISO 1328-1:2013 as inspectors print it.
struct InspectionFigure {
  std::string symbol;        ///< "f_Halpha"
  std::string flank;         ///< left, right or both
  std::string what;          ///< in words
  double value_um = kNaN;
  int accuracy_class = 0;    ///< 1 ... 11 that it just meets, 12: none of them, 0: the quantity has none
  std::vector<double> limits_um;  ///< of the classes 1 ... 11 for this gear; empty: the quantity has none
};

struct LoopResult {
  std::string gear;             ///< gear's name, or "drive"
  std::string process;          ///< that made the part, as said with design or data; empty: not said
  ResultUnit unit = kMicrometres;
  int observations = 0, held_out = 0, outliers = 0;
  double noise = 0.0;
  ErrorFigures before, after;
  std::vector<FoundEffect> effects;
  double structure_p_value = 1.0;       ///< before anything was chosen
  double structure_left_p_value = 1.0;
  std::string structure_left;
  Verdict verdict = Verdict::kNoEffect;
  /// Where several parts were measured: figures of each, and the error on a part that took no part in
  /// fitting the repeatable effects (each left out in turn).
  struct PartFigures {
    std::string name;
    int observations = 0;
    ErrorFigures before, after;
  };
  std::vector<PartFigures> parts;
  double new_part_before = kNaN, new_part_after = kNaN;
  std::vector<std::string> not_observable;  ///< ids of effects these data cannot show
  std::vector<std::string> measure_next;    ///< what would separate what is confounded
  std::vector<std::string> notes;
  std::vector<PossibleExplanation> possible;  ///< of single numbers of a drive
  std::vector<InspectionFigure> iso_1328;     ///< of a gear's records; empty: none
  std::string iso_1328_note;                  ///< how they were evaluated
};

/// A parameter's name and unit in words: "centre diameter", "mm"; no unit: empty.
[[nodiscard]] std::pair<std::string, std::string> name_and_unit(const std::string& parameter);
/// loop.json: docs/loop.md. Same result, same bytes.
[[nodiscard]] std::string loop_json(const LoopResult& result);
/// What a person reads first.
[[nodiscard]] std::string loop_text(const LoopResult& result);

}  // namespace trueflank::loop
