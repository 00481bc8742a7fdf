// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/loop_page.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/export/xml_text.h"

namespace trueflank::loop {
namespace {

/// The house's colours and type, as in report.html.
constexpr const char* kStyle = R"(
:root{--paper:#f6f7f9;--card:#fff;--ink:#16202c;--soft:#5a6675;--line:#dde2e8;--accent:#0b5cad;--accent-soft:#e3eefa;
--pass:#1b7f4b;--pass-soft:#e2f4ea;--warn:#96600a;--warn-soft:#fdf1d8;--none:#6b7683;--none-soft:#eceff2;color-scheme:light dark;
--shadow:0 1px 2px rgb(15 25 40/7%),0 4px 16px rgb(15 25 40/5%)}
@media(prefers-color-scheme:dark){:root{--paper:#10151b;--card:#181f27;--ink:#e6ebf1;--soft:#9aa7b5;--line:#2b3540;--accent:#79b4f0;
--accent-soft:#1a2c40;--pass:#68c993;--pass-soft:#16301f;--warn:#e8b45a;--warn-soft:#33270f;--none:#97a3b0;--none-soft:#242d36;--shadow:none}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:92rem;margin:0 auto;padding:0 1.25rem 3rem}
.brand{margin:0;padding:.55rem 0;font-weight:700;color:var(--accent)}
h1{margin:1.2rem 0 .6rem;font-size:clamp(1.6rem,4.5vw,2.4rem);line-height:1.15;letter-spacing:-.015em;overflow-wrap:anywhere}
h2{margin:2.5rem 0 .75rem;font-size:1.4rem;letter-spacing:-.01em}h3{margin:0;font-size:1.15rem}
.verdict{display:inline-block;margin:0;padding:.45rem .9rem;border-radius:10px;font-weight:600}
.explained{color:var(--pass);background:var(--pass-soft)}.partly_explained{color:var(--warn);background:var(--warn-soft)}
.no_effect{color:var(--none);background:var(--none-soft)}
.alarm{margin:1rem 0 0;padding:.9rem 1.2rem;border:3px solid #b3261e;border-radius:12px;background:#b3261e;color:#fff;font-size:1.05rem}
.alarm b{font-size:1.2rem}.alarm ul{margin:.4rem 0 0;padding-left:1.2rem}
.say{font-size:1.12rem;font-weight:600}.sure{color:var(--soft)}
.tip{position:fixed;z-index:9;pointer-events:none;padding:.25rem .55rem;border-radius:6px;background:var(--ink);color:var(--paper);font-size:.9rem;font-variant-numeric:tabular-nums}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(9.5rem,1fr));gap:.8rem;margin:1.25rem 0 0}
.cards>div,.card,figure{background:var(--card);border:1px solid var(--line);border-radius:12px;box-shadow:var(--shadow)}
.cards>div{padding:.8rem 1rem}.cards dt{color:var(--soft);font-size:.85rem}
.cards dd{margin:.1rem 0 0;line-height:1.2;font-size:1.5rem;font-weight:650;letter-spacing:-.02em;font-variant-numeric:tabular-nums}
.cards small{font-size:.85rem;font-weight:500;color:var(--soft);margin-left:.3em;letter-spacing:0}
.card{padding:1rem 1.2rem;margin:0 0 .9rem}.card p{margin:.4rem 0}.id{color:var(--soft);font-weight:500;font-size:.9rem;margin-left:.5em}
.share{height:.5rem;margin-bottom:.6rem;border-radius:9px;background:var(--none-soft);overflow:hidden;max-width:24rem}.share i{display:block;height:100%;background:var(--accent)}
.note{color:var(--soft);font-size:.92rem;max-width:50rem}
.two{display:grid;grid-template-columns:1fr 1fr;gap:.8rem}figure{margin:0;padding:.7rem .8rem}figcaption{font-size:.9rem;color:var(--soft)}
figcaption b{color:var(--ink)}svg{display:block;width:100%;height:auto}svg text{fill:var(--soft);font-size:12px}
.grid{stroke:var(--line);fill:none}.zero{stroke:var(--soft);fill:none;stroke-width:.7;opacity:.6}
.f{fill:var(--none);opacity:.55}.a{fill:var(--accent)}.z{stroke:var(--line);fill:none}
.four{display:grid;grid-template-columns:repeat(auto-fit,minmax(max(19rem,23%),1fr));gap:.8rem}.four svg text{font-size:11px}
.effects{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(25rem,100%),1fr));gap:.9rem}.effects .card{margin:0}.effects td:not(:last-child){white-space:nowrap}
.points text{font-size:13px}.points .w{fill:#c77700;opacity:.5}.points .a{opacity:.75}.am,.wm{fill:none;stroke:var(--accent);stroke-width:2.4;stroke-linejoin:round}
.wm{stroke:#c77700;stroke-dasharray:6 4}.key span{display:inline-block;margin-right:.5rem;font-weight:600}
.key span::before{content:"";display:inline-block;width:.75em;height:.75em;border-radius:50%;margin-right:.4em;background:var(--accent)}.key .w::before{background:#c77700}
.t{stroke:var(--accent);fill:none;stroke-width:1.1}.b{fill:var(--accent)}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.95rem}td,th{padding:.3rem .8rem .3rem 0;text-align:left}
th{color:var(--soft);font-weight:600}td+td,th+th{text-align:right}.words :is(td,th){text-align:left;vertical-align:top}.scroll{overflow-x:auto}
pre{white-space:pre-wrap;font-size:.85rem;background:var(--card);border:1px solid var(--line);border-radius:12px;padding:1rem}
summary{cursor:pointer;color:var(--accent)}
@media(max-width:46rem){main{padding:0 .8rem 2rem}.two,.four{grid-template-columns:1fr}svg text{font-size:15px}.points text{font-size:21px}.four svg text{font-size:11px}}
@media print{@page{margin:14mm}body{background:#fff;font-size:10pt}main{padding:0}h2,h2+p{break-after:avoid}h2{margin-top:1.2rem}
.cards{grid-template-columns:repeat(6,1fr)}.cards>div{padding:.4rem .6rem}.cards dd{font-size:1.1rem}.say{font-size:1rem}.effects td{white-space:normal}
figure,.card,.cards,.four,tr{break-inside:avoid;box-shadow:none}.two,.four,.effects{grid-template-columns:1fr 1fr}details{display:none}h2:has(+details){display:none}
.scroll{overflow:visible}svg{print-color-adjust:exact;-webkit-print-color-adjust:exact}.share{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

/// The value under the pointer, of every chart that carries its values (data-chart).
constexpr const char* kPointerScript = R"(<script>
(() => {
  const tip = document.createElement('div');
  tip.className = 'tip';
  tip.hidden = true;
  document.body.append(tip);
  const part = (t, n) => Math.min(n - 1, Math.max(0, Math.floor(t * n)));
  const signed = v => (v > 0 ? '+' : '') + v;
  const text = (c, x, y) => {
    if (c.kind === 'points') {
      let best = 14, said = '';
      for (const [px, py, words] of c.rows) {
        const d = Math.hypot(px - x, py - y);
        if (d < best) { best = d; said = words; }
      }
      return said;
    }
    const u = (x - c.x) / c.w, v = 1 - (y - c.y) / c.h;
    if (u < 0 || u > 1 || v < 0 || v > 1) return '';
    const grid = c.kind === 'grid';
    const k = part(grid ? v : u, c.rows.length), row = c.rows[k], i = part(grid ? u : v, row.length);
    if (row[i] === null) return '';
    const along = Math.round(100 * (i + 0.5) / row.length);
    if (grid) return `${Math.round(100 * (k + 0.5) / c.rows.length)} % root to tip, ${along} % bottom to top: ${signed(row[i])} ${c.unit}`;
    return `${c.row} ${c.numbers[k] ?? k + 1}${c.along ? `, ${along} % ${c.along}` : ''}: ${signed(row[i])} ${c.unit}`;
  };
  for (const svg of document.querySelectorAll('svg[data-chart]')) {
    let chart;
    svg.addEventListener('pointermove', e => {
      chart ??= JSON.parse(svg.dataset.chart);
      const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
      const said = text(chart, p.x, p.y);
      tip.hidden = !said;
      tip.textContent = said;
      tip.style.left = Math.min(e.clientX + 14, innerWidth - tip.offsetWidth - 8) + 'px';
      tip.style.top = e.clientY + 14 + 'px';
    });
    svg.addEventListener('pointerleave', () => { tip.hidden = true; });
  }
})();
</script>)";

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
      escaped(r.gear) + " – Trueflank loop</title><style>" + kStyle +
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
         "</script>" + kPointerScript + "</main></body></html>\n";
}

}  // namespace trueflank::loop
