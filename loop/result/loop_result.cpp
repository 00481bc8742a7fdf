// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/result/loop_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

using Json = nlohmann::ordered_json;

/// Nine significant digits: far below any measurement, and the same text for the same result.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, 8.0 - std::floor(std::log10(std::abs(value))));
  const double rounded = std::round(value * scale) / scale;
  return std::isfinite(rounded) ? rounded : value;
}

/// A key that ends with the unit.
std::string in(const ResultUnit& unit, const char* key) { return std::string(key) + "_" + unit.key; }

Json figures(const ErrorFigures& f, const ResultUnit& unit) {
  Json json = {{in(unit, "rms"), number(f.rms)},
               {in(unit, "held_out_rms"), number(f.held_out_rms)},
               {in(unit, "max"), number(f.max)}};
  if (!unit.efficiency_points) return json;
  json["rms_points"] = number(f.rms_points);
  json["held_out_rms_points"] = number(f.held_out_rms_points);
  return json;
}

Json terms_json(const std::vector<Term>& terms, const ResultUnit& unit) {
  Json json = Json::array();
  for (const Term& t : terms) {
    Json term = Json::object();
    for (const auto& [key, value] : t.keys) {
      if (const double* real = std::get_if<double>(&value)) term[key] = number(*real);
      else if (const int* whole = std::get_if<int>(&value)) term[key] = *whole;
      else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
        term[key] = Json::array();
        for (const double each : *list) term[key].push_back(number(each));
      } else
        term[key] = std::get<std::string>(value);
    }
    term[in(unit, "cos")] = number(t.cos);
    term[in(unit, "sin")] = number(t.sin);
    term[in(unit, "amplitude")] = number(t.amplitude());
    term[in(unit, "ci95_half")] = number(t.half_width);
    term["text"] = t.text;
    json.push_back(std::move(term));
  }
  return json;
}

Json possible_json(const std::vector<PossibleExplanation>& possible) {
  Json json = Json::array();
  for (const PossibleExplanation& p : possible) {
    Json parameters = Json::object();
    for (const Parameter& q : p.parameters) parameters[q.name] = number(q.value);
    json.push_back({{"id", p.id},
                    {"parameters", parameters},
                    {"load_nm", number(p.load_nm)},
                    {"explains", p.explains},
                    {"left_points", number(p.left_points)},
                    {"left_nm", number(p.left_nm)},
                    {"text", p.text}});
  }
  return json;
}

Json effect_json(const FoundEffect& e, const ResultUnit& unit) {
  Json parameters = Json::object();
  for (const Parameter& p : e.parameters)
    parameters[p.name] = {{"value", number(p.value)}, {"ci95", {number(p.low), number(p.high)}}};
  Json json = {{"id", e.id},
               {"named", e.named},
               {"sentence", e.sentence},
               {"sure", e.sure},
               {"description", e.description},
               {"cause", e.cause},
               {"correction", e.correction},
               {"flank", e.flank},
               {"parameters", parameters},
               {"explained_fraction", number(e.explained_fraction)},
               {in(unit, "held_out_gain"), number(e.held_out_gain)},
               {"confounded_with", e.confounded_with},
               {"p_value", number(e.p_value)},
               {"bic_gain", number(e.bic_gain)},
               {"correctable", e.correctable}};
  if (!e.by_process.empty()) {
    Json by_process = Json::object();
    for (const auto& [process, cause] : e.by_process) by_process[process] = cause;
    json["by_process"] = by_process;
  }
  if (!e.not_corrected.empty()) json["not_corrected"] = e.not_corrected;
  if (!e.orders_alike.empty()) json["orders_alike"] = e.orders_alike;
  if (!e.side.empty()) json["side"] = e.side;
  if (e.repeatable) {
    json["repeatable"] = *e.repeatable;
    json["repeatability_p_value"] = number(e.repeat_p_value);
    if (!e.part.empty()) json["part"] = e.part;
    Json in_parts = Json::object();
    for (const auto& in_part : e.in_parts)
      for (const auto& [name, value] : in_part.parameters) in_parts[in_part.part][name] = number(value);
    json["in_parts"] = in_parts;
  }
  if (!e.form.empty()) {
    Json form = Json::object();
    for (const auto& [name, formula] : e.form) form[name] = formula;
    json["form"] = form;
  }
  if (!e.terms.empty()) json["terms"] = terms_json(e.terms, unit);
  return json;
}

Json iso_json(const LoopResult& r) {
  Json figures = Json::array();
  for (const InspectionFigure& f : r.iso_1328) {
    Json figure = {{"symbol", f.symbol}, {"flank", f.flank}, {"what", f.what}, {"value_um", number(f.value_um)}};
    if (f.accuracy_class > 0)
      figure["class"] = f.accuracy_class > 11 ? Json("over 11") : Json(f.accuracy_class);
    for (std::size_t k = 0; k < f.limits_um.size(); ++k)
      figure["limits_um"][std::to_string(k + 1)] = number(f.limits_um[k]);
    figures.push_back(std::move(figure));
  }
  return {{"note", r.iso_1328_note}, {"figures", std::move(figures)}};
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return "-";
  return std::abs(value) >= 100.0 ? printed("%.1f", value) : printed("%.3g", value);
}

/// What the values held out lose without an effect; empty where that is nothing, as of what stands
/// on one tooth that none of them is of.
std::string held_out_words(double gain, double held_out_rms, const std::string& unit) {
  constexpr double kNothing = 0.005, kSmaller = 0.05;  // of the error held out
  if (gain > kNothing * held_out_rms)
    return "; without it the held-out error is " + short_number(gain) + " " + unit + " larger";
  if (gain < -kSmaller * held_out_rms)
    return "; without it the held-out error is " + short_number(-gain) + " " + unit + " smaller";
  return "";
}

/// The sentence first, then the numbers.
std::string effect_text(const FoundEffect& e, double held_out_rms, const std::string& unit) {
  std::string text = "  " + e.sentence + "\n    " + e.id + (e.flank == "both" ? "" : ", " + e.flank + " flanks") +
                     ": " + e.description + "\n    " + e.sure + "\n";
  if (e.repeatable)
    text += *e.repeatable ? "    repeats from part to part (p = " + short_number(e.repeat_p_value) + ")\n"
                          : "    one-off, on part " + e.part + "\n";
  for (const Parameter& p : e.parameters) {
    const auto [name, in_words] = name_and_unit(p.name);
    text += "    " + name + " " + short_number(p.value);
    if (p.high > p.low) text += "  [" + short_number(p.low) + ", " + short_number(p.high) + "]";
    text += (in_words.empty() ? "" : " " + in_words) + "\n";
  }
  if (std::isfinite(e.explained_fraction))
    text += "    explains " + short_number(100.0 * e.explained_fraction) + " % of the variance" +
            held_out_words(e.held_out_gain, held_out_rms, unit) + "\n";
  if (!e.cause.empty()) text += "    cause: " + e.cause + "\n";
  if (!e.correction.empty()) text += "    do: " + e.correction + "\n";
  if (!e.confounded_with.empty()) text += "    cannot be distinguished from: " + joined(e.confounded_with) + "\n";
  return text;
}

}  // namespace

std::pair<std::string, std::string> name_and_unit(const std::string& parameter) {
  struct Unit {
    std::string_view ending, words;
  };
  static constexpr std::array kUnits{Unit{"_nm_at_1000_rpm", "N m at 1000 rpm"},
                                     Unit{"_um_per_mm", "um per mm"},
                                     Unit{"_nm_per_rpm", "N m per rpm"},
                                     Unit{"_um", "um"},
                                     Unit{"_mm", "mm"},
                                     Unit{"_deg", "degrees"},
                                     Unit{"_nm", "N m"},
                                     Unit{"_rpm", "rpm"},
                                     Unit{"_per_c", "per degree Celsius"},
                                     Unit{"_c", "degrees Celsius"}};
  std::string name = "_" + parameter;
  std::string words;
  for (const Unit& unit : kUnits) {
    if (!name.ends_with(unit.ending)) continue;
    name.resize(name.size() - unit.ending.size());
    words = unit.words;
    break;
  }
  if (name == "_percent") return {"amount", "percent"};
  name = name.empty() ? "amount" : name.substr(1);
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name, words};
}

double Term::amplitude() const { return std::hypot(cos, sin); }

const char* to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoEffect: return "no_effect";
    case Verdict::kExplained: return "explained";
    default: return "partly_explained";
  }
}

std::string loop_json(const LoopResult& r) {
  Json effects = Json::array();
  for (const FoundEffect& effect : r.effects) effects.push_back(effect_json(effect, r.unit));
  Json json = {{"format", "trueflank-loop"},
               {"version", 1},
               {"gear", r.gear},
               {"process", r.process.empty() ? Json(nullptr) : Json(r.process)},
               {"data",
                {{"observations", r.observations},
                 {"held_out", r.held_out},
                 {in(r.unit, "noise"), number(r.noise)},
                 {"outliers", r.outliers}}},
               {"before", figures(r.before, r.unit)},
               {"after", figures(r.after, r.unit)},
               {"structure", {{"p_value", number(r.structure_p_value)}}},
               {"effects", effects},
               {"structure_left",
                {{"p_value", number(r.structure_left_p_value)}, {"description", r.structure_left}}},
               {"verdict", to_text(r.verdict)},
               {"not_observable", r.not_observable},
               {"measure_next", r.measure_next},
               {"notes", r.notes}};
  if (!r.possible.empty()) json["possible"] = possible_json(r.possible);
  if (!r.iso_1328.empty()) json["iso_1328"] = iso_json(r);
  if (!r.parts.empty()) {
    Json parts = Json::array();
    for (const auto& part : r.parts)
      parts.push_back({{"name", part.name},
                       {"observations", part.observations},
                       {"before", figures(part.before, r.unit)},
                       {"after", figures(part.after, r.unit)}});
    json["parts"] = parts;
    json["new_part"] = {{in(r.unit, "rms_before"), number(r.new_part_before)},
                        {in(r.unit, "rms_after"), number(r.new_part_after)}};
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string loop_text(const LoopResult& r) {
  const std::string unit = r.unit.text;
  std::string text = r.gear + ": " + to_text(r.verdict) + "\n";
  text += "  " + std::to_string(r.observations) + " values, " + std::to_string(r.held_out) +
          " held out, " + std::to_string(r.outliers) + " outliers; noise " +
          short_number(r.noise) + " " + unit + "\n";
  text += "  error before " + short_number(r.before.rms) + " " + unit + " rms (held out " +
          short_number(r.before.held_out_rms) + "), after " + short_number(r.after.rms) +
          " (held out " + short_number(r.after.held_out_rms) + ")\n";
  if (std::isfinite(r.before.rms_points))
    text += "  in points of efficiency before " + short_number(r.before.rms_points) + " (held out " +
            short_number(r.before.held_out_rms_points) + "), after " +
            short_number(r.after.rms_points) + " (held out " +
            short_number(r.after.held_out_rms_points) + ")\n";
  for (const FoundEffect& e : r.effects) text += effect_text(e, r.after.held_out_rms, unit);
  if (!r.parts.empty())
    text += "  a part not fitted to: " + short_number(r.new_part_before) + " " + unit +
            " rms as designed, " + short_number(r.new_part_after) +
            " with the repeatable effects of the others\n";
  text += "  left: " + r.structure_left + " (p = " + short_number(r.structure_left_p_value) + ")\n";
  for (const PossibleExplanation& p : r.possible) text += "  possible: " + p.text + "\n";
  for (const std::string& next : r.measure_next) text += "  next: " + next + "\n";
  for (const std::string& note : r.notes) text += "  note: " + note + "\n";
  return text;
}

}  // namespace trueflank::loop
