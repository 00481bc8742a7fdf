// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/export/xml_text.h"
#include "trueflank/session/fixed_text.h"
#include "trueflank/session/search_files.h"

namespace trueflank {
namespace {

constexpr double kWidth = 900, kHeight = 600, kLeft = 80, kRight = 30, kTop = 50, kBottom = 60;

struct Axis {
  std::string title;
  double low = 0.0, high = 1.0, step = 0.2;
  double from = 0.0, to = 1.0;  ///< places on the page

  [[nodiscard]] double at(double value) const {
    return from + (to - from) * (value - low) / (high - low);
  }
};

/// Steps of 1, 2 or 5 times a power of ten, about six of them.
void round_outwards(Axis& axis) {
  if (!(axis.high > axis.low)) axis.high = axis.low + 1.0, axis.low -= 1.0;
  const double raw = (axis.high - axis.low) / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  axis.step = power * (raw / power > 5.0   ? 10.0
                       : raw / power > 2.0 ? 5.0
                       : raw / power > 1.0 ? 2.0
                                           : 1.0);
  axis.low = axis.step * std::floor(axis.low / axis.step);
  axis.high = axis.step * std::ceil(axis.high / axis.step);
}

std::string number(double value, int digits = 2) { return fixed_text(value, digits); }

bool is_share(SearchObjective objective) {
  return objective == SearchObjective::kForward || objective == SearchObjective::kBackward;
}

double shown(SearchObjective objective, const SearchCandidate& c) {
  return (is_share(objective) ? 100.0 : 1.0) * c.value(objective);
}

std::string title_of(SearchObjective objective) {
  return objective_entry(objective).title + std::string(is_share(objective) ? " [%]" : "");
}

struct Dot {
  double x, y;
  bool chosen;
  std::string label;
};

std::vector<Dot> dots_of(const SearchTask& task, const SearchReport& report) {
  const auto& objectives = task.requirements.objectives;
  const auto place = [&](double ratio, const SearchCandidate& c) {
    return objectives.size() > 1 ? shown(objectives[1], c) : std::abs(ratio);
  };
  const std::size_t sets = task.enumeration.sets.size();
  std::vector<Dot> dots;
  for (const RankedCandidate& r : report.ranking) {
    const double ratio = r.set_index < sets ? signed_ratio(task.enumeration.sets[r.set_index])
                                            : signed_ratio(report.pairs[r.set_index - sets]);
    dots.push_back({place(ratio, r.candidate), shown(objectives[0], r.candidate), false, ""});
  }
  for (const FoundDesign& f : report.designs) {
    const TrainTeeth teeth = teeth_of(f);
    dots.push_back({place(teeth.ratio, f.candidate), shown(objectives[0], f.candidate), true,
                    (f.set.train->kind() == "3k" ? "" : f.set.train->kind() + " ") + teeth.text});
  }
  std::erase_if(dots, [](const Dot& d) { return !std::isfinite(d.x) || !std::isfinite(d.y); });
  return dots;
}

std::string axes(const Axis& x, const Axis& y) {
  std::string text;
  const auto line = [&](double x1, double y1, double x2, double y2, const char* colour) {
    text += "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
            "\" y2=\"" + number(y2) + "\" stroke=\"" + colour + "\"/>\n";
  };
  const int x_ticks = static_cast<int>(std::lround((x.high - x.low) / x.step));
  for (int i = 0; i <= x_ticks; ++i) {
    const double at = x.at(x.low + i * x.step);
    line(at, y.to, at, y.from, "#dddddd");
    text += "<text x=\"" + number(at) + "\" y=\"" + number(y.from + 18) +
            "\" text-anchor=\"middle\">" + general_text(x.low + i * x.step) + "</text>\n";
  }
  const int y_ticks = static_cast<int>(std::lround((y.high - y.low) / y.step));
  for (int i = 0; i <= y_ticks; ++i) {
    const double at = y.at(y.low + i * y.step);
    line(x.from, at, x.to, at, "#dddddd");
    text += "<text x=\"" + number(x.from - 8) + "\" y=\"" + number(at + 4) +
            "\" text-anchor=\"end\">" + general_text(y.low + i * y.step) + "</text>\n";
  }
  line(x.from, y.from, x.to, y.from, "#000000");
  line(x.from, y.from, x.from, y.to, "#000000");
  text += "<text x=\"" + number((x.from + x.to) / 2) + "\" y=\"" + number(kHeight - 15) +
          "\" text-anchor=\"middle\">" + io::xml_escaped(x.title) + "</text>\n";
  text += "<text transform=\"translate(20," + number((y.from + y.to) / 2) +
          ") rotate(-90)\" text-anchor=\"middle\">" + io::xml_escaped(y.title) + "</text>\n";
  return text;
}

}  // namespace

std::string search_svg(const SearchTask& task, const SearchReport& report) {
  const auto& objectives = task.requirements.objectives;
  const std::vector<Dot> dots = dots_of(task, report);
  Axis x{
      .title = objectives.size() > 1 ? title_of(objectives[1]) : "ratio, input over output speed",
      .from = kLeft,
      .to = kWidth - kRight};
  Axis y{.title = title_of(objectives[0]), .from = kHeight - kBottom, .to = kTop};
  if (!dots.empty()) {
    const auto [x0, x1] = std::minmax_element(dots.begin(), dots.end(),
                                              [](const Dot& p, const Dot& q) { return p.x < q.x; });
    const auto [y0, y1] = std::minmax_element(dots.begin(), dots.end(),
                                              [](const Dot& p, const Dot& q) { return p.y < q.y; });
    x.low = x0->x, x.high = x1->x, y.low = y0->y, y.high = y1->y;
  }
  round_outwards(x);
  round_outwards(y);
  std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"600\" "
      "viewBox=\"0 0 900 600\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"900\" height=\"600\" fill=\"#ffffff\"/>\n";
  text += "<text x=\"" + number(kLeft) + "\" y=\"28\" font-size=\"16\">" +
          io::xml_escaped(task.requirements.name) + ": " + std::to_string(report.feasible) +
          " tooth sets with shifts that keep every limit, of " + std::to_string(report.considered) +
          " considered</text>\n";
  text += axes(x, y);
  for (const Dot& dot : dots) {
    text += "<circle cx=\"" + number(x.at(dot.x)) + "\" cy=\"" + number(y.at(dot.y)) +
            (dot.chosen ? "\" r=\"4\" fill=\"#d62728\"><title>" + dot.label + "</title></circle>\n"
                        : "\" r=\"1.5\" fill=\"#1f77b4\" fill-opacity=\"0.5\"/>\n");
  }
  if (!report.designs.empty()) {
    const auto best = std::find_if(dots.begin(), dots.end(), [](const Dot& d) { return d.chosen; });
    if (best != dots.end())
      text += "<text x=\"" + number(std::min(x.at(best->x) + 8, kWidth - 160)) + "\" y=\"" +
              number(y.at(best->y) - 6) + "\" fill=\"#d62728\">" + best->label + "</text>\n";
  }
  return text + "</svg>\n";
}

}  // namespace trueflank
