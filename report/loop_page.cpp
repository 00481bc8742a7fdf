// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_page.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/report/page_texts.h"

namespace trueflank::loop {
namespace {

std::string escaped(const std::string& text) { return io::xml_escaped(text); }

std::string number(double value, const char* format = "%.2f") {
  if (std::isnan(value)) return "–";
  return printed_number(value, format);
}

/// "tooth_thickness" as words.
std::string words(std::string id) {
  for (char& c : id)
    if (c == '_') c = ' ';
  return id;
}

/// A quarter above the noise, and as much more as so many values may scatter.
double larger_than_noise(double noise, int values) {
  return noise * (1.25 + 3.0 / std::sqrt(2.0 * std::max(1, values)));
}

/// What does not add up: a reader must not miss it.
std::string alarm(const LoopResult& r, std::vector<std::string> wrong) {
  const std::string unit = std::string(" ") + r.unit.sign;
  const auto size = [&](double value) { return number(value, "%.3g") + unit; };
  if (r.after.held_out_rms > 1.02 * r.before.held_out_rms)
    wrong.push_back("On data held out from the fit the error grew from " + size(r.before.held_out_rms) + " to " +
                    size(r.after.held_out_rms) + ": do not act on these effects.");
  if (r.verdict == Verdict::kPartlyExplained) wrong.push_back("Structure is left: " + r.structure_left + ".");
  else if (r.after.rms > larger_than_noise(r.noise, r.observations) ||
           r.after.held_out_rms > larger_than_noise(r.noise, r.held_out))
    wrong.push_back("What is left (" + size(r.after.rms) + ", held out " + size(r.after.held_out_rms) +
                    ") is larger than the noise of the measurement (" + size(r.noise) + ").");
  if (20 * r.outliers > r.observations && r.outliers > 2)
    wrong.push_back(std::to_string(r.outliers) + " values were left out as outliers.");
  if (wrong.empty()) return {};
  std::string html = "<div class='alarm' role='alert'><b>This does not add up</b><ul>";
  for (const std::string& sentence : wrong) html += "<li>" + escaped(sentence) + "</li>";
  return html + "</ul></div>";
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoEffect: return "Nothing beyond the measurement's own noise";
    case Verdict::kExplained: return "Explained: what is left is the measurement's own noise";
    case Verdict::kPartlyExplained: return "Partly explained: structure is left";
  }
  return "";
}

std::string figure_cards(const LoopResult& r) {
  const auto card = [&](const char* name, double value, const std::string& small, const char* format = "%.3g") {
    return std::string("<div><dt>") + name + "</dt><dd>" + number(value, format) + "<small>" + small + "</small></dd></div>";
  };
  const std::string unit = std::string(r.unit.sign) + " rms";
  const auto with_points = [&](double points) {
    return std::isfinite(points) ? unit + ", " + number(points, "%.2g") + " points of efficiency" : unit;
  };
  return "<dl class='cards'>" + card("error before", r.before.rms, with_points(r.before.rms_points)) +
         card("error after", r.after.rms, with_points(r.after.rms_points)) +
         card("held out, before", r.before.held_out_rms, with_points(r.before.held_out_rms_points)) +
         card("held out, after", r.after.held_out_rms, with_points(r.after.held_out_rms_points)) +
         card("noise of the measurement", r.noise, r.unit.sign) +
         card("observations", r.observations, std::to_string(r.held_out) + " held out, " + std::to_string(r.outliers) + " outliers", "%.0f") +
         "</dl>";
}

std::string effect_card(const FoundEffect& e, bool of_flanks) {
  std::string html = "<div class='card'><h3>" + escaped(e.named ? words(e.id) : "unnamed structure");
  if (of_flanks)
    html += "<span class='id'>" + (e.flank == "both" ? "both" : escaped(e.flank)) + " flanks</span>";
  html += "</h3><p class='say'>" + escaped(e.sentence) + "</p><p class='sure'>" + escaped(e.sure) + "</p>";
  if (!e.parameters.empty()) {
    html += "<div class='scroll'><table><tr><th></th><th>value</th><th>95 % interval</th><th></th></tr>";
    for (const Parameter& p : e.parameters) {
      if (!e.named && p.name == "order" && p.value == 0.0) continue;  // it is no wave
      const auto [name, unit] = name_and_unit(p.name);
      html += "<tr><td>" + escaped(name) + "</td><td>" + number(p.value, "%.4g") + "</td><td>" +
              (p.high > p.low ? number(p.low, "%.4g") + " … " + number(p.high, "%.4g") : "") + "</td><td>" + unit +
              "</td></tr>";
    }
    html += "</table></div>";
  }
  const double percent = 100.0 * e.explained_fraction;
  html += "<p>It explains " + number(percent, "%.1f") + " % of the variance.</p><div class='share'><i style='width:" +
          number(std::isnan(percent) ? 0.0 : std::fmin(100.0, std::fmax(0.0, percent)), "%.1f") + "%'></i></div>";
  // the sentence mostly ends with it
  if (!e.correction.empty() && e.sentence.find(e.correction) == std::string::npos) html += "<p><b>What to do:</b> " + escaped(e.correction) + "</p>";
  html += "<details><summary>form and cause</summary><p>" + escaped(e.description) + "</p>";
  if (!e.cause.empty()) html += "<p><b>Cause:</b> " + escaped(e.cause) + "</p>";
  html += "</details>";
  if (!e.confounded_with.empty())
    html += "<p class='note'>These data cannot distinguish it from " + escaped(words(joined(e.confounded_with))) + ".</p>";
  return html + "</div>";
}

/// Ids of effects in a sentence as words; names of columns keep theirs.
std::string with_words(std::string text, const LoopResult& r) {
  const auto say = [&](const std::string& id) {
    for (std::size_t at = 0; (at = text.find(id, at)) != std::string::npos;) text.replace(at, id.size(), words(id));
  };
  for (const FoundEffect& e : r.effects) {
    if (e.id.find('_') != std::string::npos) say(e.id);
    for (const std::string& other : e.confounded_with)
      if (other.find('_') != std::string::npos) say(other);
  }
  return text;
}

std::string begun(std::string sentence) {
  if (!sentence.empty() && sentence.front() >= 'a' && sentence.front() <= 'z')
    sentence.front() = static_cast<char>(sentence.front() - 'a' + 'A');
  return sentence;
}

std::string left_over(const LoopResult& r) {
  std::string html = "<h2>What is left</h2><p>" + escaped(begun(r.structure_left)) +
                     (std::isnan(r.structure_left_p_value) ? "" : " (p = " + number(r.structure_left_p_value, "%.2g") + ")") + "</p>";
  const auto list = [&](const char* title, const std::vector<std::string>& items) {
    if (items.empty()) return;
    html += std::string("<p><b>") + title + "</b>";
    if (items.size() == 1) {
      html += " " + escaped(items.front()) + "</p>";
      return;
    }
    html += "</p><ul>";
    for (const std::string& item : items) html += "<li>" + escaped(item) + "</li>";
    html += "</ul>";
  };
  std::vector<std::string> next;
  for (const std::string& item : r.measure_next) next.push_back(with_words(item, r));
  list("Measure next:", next);
  if (!r.not_observable.empty())
    html += "<p><b>These data cannot show:</b> " + escaped(words(joined(r.not_observable))) + "</p>";
  list("Notes:", r.notes);
  return html;
}

/// For the inside of a script element: nothing there may look like its end.
std::string script_text(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string loop_page_opening(const LoopResult& r, const std::string& heading,
                              const std::vector<std::string>& not_adding_up) {
  std::string page =
      "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'>"
      "<meta name='viewport' content='width=device-width, initial-scale=1'><title>" +
      escaped(r.gear) + " – Trueflank loop</title><style>\n" + std::string(page_texts::kLoopStyle) +
      "</style></head><body><main><p class='brand'>Trueflank</p><h1>" + escaped(heading) +
      "</h1><p class='verdict " + to_text(r.verdict) + "'>" + verdict_text(r.verdict) + "</p>" + alarm(r, not_adding_up) + figure_cards(r);
  page += r.effects.empty() ? "" : std::string("<h2>") + (r.effects.size() == 1 ? "The effect" : "The effects") + "</h2>";
  if (!r.effects.empty()) page += "<div class='effects'>";
  for (const FoundEffect& effect : r.effects) page += effect_card(effect, !r.unit.efficiency_points);
  if (!r.effects.empty()) page += "</div>";
  return page + left_over(r);
}

std::string loop_page_end(const LoopResult& r) {
  return "<h2>The same as text</h2><details><summary>what the program printed</summary><pre>" + escaped(loop_text(r)) +
         "</pre></details><script type='application/json' id='loop-data'>" + script_text(loop_json(r)) +
         "</script><script>\n" + std::string(page_texts::kLoopPointer) + "</script></main></body></html>\n";
}

}  // namespace trueflank::loop
