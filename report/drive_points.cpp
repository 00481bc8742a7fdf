// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drive_points.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"

namespace trueflank::loop {
namespace {

constexpr int kMostCells = 14;
constexpr double kFromLeft = 74, kTop = 18, kWidePlot = 500, kHigh = 250;

/// One end of an axis to the other in steps that can be read.
struct Scale {
  double low = 0.0, high = 1.0, step = 1.0;
  Scale(double from, double to) {
    if (!(to > from)) {
      from -= 1.0;
      to += 1.0;
    }
    const double raw = (to - from) / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
    step = power * (raw > 5.0 * power ? 10.0 : raw > 2.0 * power ? 5.0 : raw > power ? 2.0 : 1.0);
    low = step * std::floor(from / step + 1e-9);
    high = step * std::ceil(to / step - 1e-9);
  }
  [[nodiscard]] double share(double value) const {
    return std::clamp((value - low) / (high - low), 0.0, 1.0);
  }
};

/// A chart of points with words for the pointer.
class PointChart {
 public:
  PointChart(const Scale& across, const Scale& up) : x_(across), y_(up) {}
  void dot(const char* kind, double x, double y, const std::string& words) {
    const std::string at_x = place(x_at(x)), at_y = place(y_at(y));
    circles_ +=
        std::string("<circle class='") + kind + "' cx='" + at_x + "' cy='" + at_y + "' r='2.8'/>";
    if (words.empty()) return;
    words_ += (words_.empty() ? "[" : ",[") + at_x + "," + at_y + ",\"" + words + "\"]";
  }
  void line(const char* kind, const std::vector<double>& x, const std::vector<double>& y) {
    std::string d;
    for (std::size_t i = 0; i < x.size(); ++i)
      d += (i ? "L" : "M") + place(x_at(x[i])) + " " + place(y_at(y[i]));
    lines_ += std::string("<path class='") + kind + "' d='" + d + "'/>";
  }
  [[nodiscard]] std::string svg(const std::string& label, const std::string& x_name) const {
    return "<svg class='points' role='img' aria-label='" + label +
           "' viewBox='0 0 590 318' data-chart='{\"kind\":\"points\",\"rows\":[" + words_ + "]}'>" +
           axes(x_name) + circles_ + lines_ + "</svg>";
  }

 private:
  [[nodiscard]] double x_at(double value) const { return kFromLeft + kWidePlot * x_.share(value); }
  [[nodiscard]] double y_at(double value) const { return kTop + kHigh * (1.0 - y_.share(value)); }
  static std::string place(double value) { return printed_number(value, "%.1f"); }
  static std::string text(double x, double y, const char* anchor, const std::string& words) {
    return "<text x='" + place(x) + "' y='" + place(y) + "' text-anchor='" + anchor + "'>" + words +
           "</text>";
  }
  static int ticks(const Scale& scale) {
    return static_cast<int>(std::lround((scale.high - scale.low) / scale.step));
  }
  /// Rounded to the step, so that a sum of steps does not show its last digits.
  static std::string tick_text(const Scale& scale, int i) {
    const double value = scale.step * std::round(scale.low / scale.step + i);
    return printed_number(value == 0.0 ? 0.0 : value, "%.6g");
  }
  [[nodiscard]] std::string axes(const std::string& x_name) const {
    std::string svg;
    for (int i = 0; i <= ticks(y_); ++i) {
      const double value = y_.low + i * y_.step, y = y_at(value);
      svg += "<path class='" + std::string(std::abs(value) < 1e-9 * y_.step ? "zero" : "grid") +
             "' d='M" + place(kFromLeft) + " " + place(y) + "h" + place(kWidePlot) + "'/>" +
             text(kFromLeft - 7, y + 4.5, "end", tick_text(y_, i));
    }
    for (int i = 0; i <= ticks(x_); ++i)
      svg += text(x_at(x_.low + i * x_.step), kTop + kHigh + 18, i == ticks(x_) ? "end" : "middle",
                  tick_text(x_, i));
    return svg + text(kFromLeft + 0.5 * kWidePlot, kTop + kHigh + 40, "middle", x_name);
  }

  Scale x_, y_;
  std::string circles_, lines_, words_;
};

/// Points a chart can carry: of long logs every n-th.
std::size_t stride_of(const DriveLoop& closed) {
  constexpr std::size_t kMostPoints = 3000;
  return closed.table.points.size() / kMostPoints + 1;
}

std::string set_point(const BenchPoint& p) {
  return "line " + std::to_string(p.line) + ", " + (p.forward ? "forward " : "backward ") + printed_number(p.speed_rpm, "%.4g") +
         " rpm, " + printed_number(p.driving_nm, "%.4g") + " N m driving: ";
}

/// What a residual may follow.
struct Quantity {
  const char* name;
  const char* unit;
  double (*of)(const BenchPoint&);
};
std::vector<Quantity> quantities_of(const DriveLoop& closed) {
  std::vector<Quantity> list{
      {"load", "N m at the input", [](const BenchPoint& p) { return p.load_nm; }},
      {"input speed", "rpm", [](const BenchPoint& p) { return p.speed_rpm; }}};
  if (closed.table.has_temperature)
    list.push_back({"temperature", "°C", [](const BenchPoint& p) { return p.temperature_c; }});
  if (closed.table.has_angle)
    list.push_back(
        {"input angle", "turns", [](const BenchPoint& p) { return p.angle_rad / kTwoPi; }});
  list.push_back({"course of the run", "files, their rows in order", [](const BenchPoint& p) { return p.file + p.taken; }});
  return list;
}

/// As torque lost at the input, so that both directions compare.
double at_input_nm(const DriveLoop& closed, std::size_t i, const std::vector<double>& residual) {
  return residual[i] / (closed.table.points[i].forward ? closed.model.ratio : 1.0);
}

/// Mean residual of every cell of a quantity.
struct CellMeans {
  std::vector<double> at, mean;
  double error_nm = 0.0;          ///< the largest standard error of a mean
  double most_significant = 0.0;  ///< the largest mean over its standard error
  double share = 0.0;             ///< of the sum of squares that the means carry
  int cells = 0;

  CellMeans(const DriveLoop& closed, const Quantity& quantity,
            const std::vector<double>& residual) {
    constexpr int kFewest = 8;
    std::vector<double> values;
    for (const BenchPoint& p : closed.table.points) values.push_back(quantity.of(p));
    const CellAxis axis(values);
    std::vector<double> sum(axis.centres.size(), 0.0), squares(sum), n(sum);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto c = static_cast<std::size_t>(axis.cell(values[i]));
      const double r = at_input_nm(closed, i, residual);
      sum[c] += r;
      squares[c] += r * r;
      n[c] += 1.0;
    }
    double all = 0.0, carried = 0.0, within = 0.0, freedom = 0.0;
    const auto spread = [&](std::size_t c) {
      return std::max(0.0, squares[c] - sum[c] * sum[c] / n[c]);
    };
    for (std::size_t c = 0; c < n.size(); ++c) {
      all += squares[c];
      if (n[c] < kFewest) continue;
      within += spread(c);
      freedom += n[c] - 1.0;
    }
    for (std::size_t c = 0; c < n.size(); ++c) {
      if (n[c] < kFewest) continue;
      // a few values may happen to lie close together: never less than the scatter of all cells
      const double m = sum[c] / n[c];
      const double error = std::sqrt(std::max(spread(c) / (n[c] - 1.0), within / freedom) / n[c]);
      at.push_back(axis.centres[c]);
      mean.push_back(m);
      error_nm = std::max(error_nm, error);
      if (error > 0.0) most_significant = std::max(most_significant, std::abs(m) / error);
      // less what chance gives a mean
      carried += n[c] * (m * m - error * error);
      ++cells;
    }
    share = all > 0.0 ? carried / all : 0.0;
  }
};

std::string residual_chart(const DriveLoop& closed, const Quantity& quantity) {
  const std::vector<BenchPoint>& points = closed.table.points;
  double low = 1e300, high = -1e300, least = 0.0, most = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low = std::min(low, quantity.of(points[i]));
    high = std::max(high, quantity.of(points[i]));
    for (const auto* residual : {&closed.before_nm, &closed.after_nm}) {
      least = std::min(least, at_input_nm(closed, i, *residual));
      most = std::max(most, at_input_nm(closed, i, *residual));
    }
  }
  if (!(high > low)) return {};
  PointChart chart(Scale(low, high), Scale(least, most));
  for (const bool after : {false, true})
    for (std::size_t i = 0; i < points.size(); i += stride_of(closed)) {
      const double value = at_input_nm(closed, i, after ? closed.after_nm : closed.before_nm);
      chart.dot(after ? "a" : "w", quantity.of(points[i]), value,
                after ? set_point(points[i]) + "left " + printed_number(value, "%.3g") +
                            " N m, before " +
                            printed_number(at_input_nm(closed, i, closed.before_nm), "%.3g")
                      : "");
    }
  for (const bool after : {false, true}) {
    const CellMeans means(closed, quantity, after ? closed.after_nm : closed.before_nm);
    if (means.cells > 1) chart.line(after ? "am" : "wm", means.at, means.mean);
  }
  const std::string axis = std::string(quantity.name) + ", " + quantity.unit;
  return std::string("<figure><figcaption>residual [N m at the input] over the <b>") +
         quantity.name + "</b></figcaption>" +
         chart.svg("residual before and after over the " + axis, axis) + "</figure>";
}

std::string torque_chart(const DriveLoop& closed, bool forward) {
  double high = 1e-300;
  for (const BenchPoint& p : closed.table.points)
    if (p.forward == forward) high = std::max(high, p.driven_nm);
  const Scale scale(0.0, high);
  PointChart chart(scale, scale);
  chart.line("zero", {0.0, scale.high}, {0.0, scale.high});
  for (const bool after : {false, true})
    for (std::size_t i = 0; i < closed.table.points.size(); i += stride_of(closed)) {
      const BenchPoint& p = closed.table.points[i];
      if (p.forward != forward) continue;
      const double before = p.driven_nm - closed.before_nm[i],
                   now = p.driven_nm - closed.after_nm[i];
      chart.dot(after ? "a" : "w", p.driven_nm, after ? now : before,
                after ? set_point(p) + "measured " + printed_number(p.driven_nm, "%.4g") +
                            ", model before " + printed_number(before, "%.4g") + ", after " +
                            printed_number(now, "%.4g")
                      : "");
    }
  const std::string side = forward ? "forward: output" : "backward: input";
  return "<figure><figcaption><b>" + side +
         "</b> torque of the model [N m] over the measured one</figcaption>" +
         chart.svg(side + " torque of the model over the measured one", "measured, N m") +
         "</figure>";
}

const char* const kColours =
    "<p class='note key'><span class='w'>before</span> <span class='a'>after</span> the loop";

}  // namespace

CellAxis::CellAxis(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double span = values.back() - values.front();
  for (std::size_t i = 0; i < values.size();) {
    std::size_t k = i;
    double sum = 0.0;
    while (k < values.size() && values[k] - values[i] <= 0.025 * span) sum += values[k++];
    centres.push_back(sum / static_cast<double>(k - i));
    i = k;
  }
  if (static_cast<int>(centres.size()) <= kMostCells) return;
  const double low = values.front();
  centres.clear();
  for (int i = 0; i < kMostCells; ++i) centres.push_back(low + span * (i + 0.5) / kMostCells);
}

int CellAxis::cell(double value) const {
  const auto nearest = std::min_element(centres.begin(), centres.end(), [&](double a, double b) {
    return std::abs(a - value) < std::abs(b - value);
  });
  return static_cast<int>(nearest - centres.begin());
}

std::string torque_charts(const DriveLoop& closed) {
  std::string html = std::string("<h2>Torque, measured and predicted</h2>") + kColours +
                     "; on the line the model is right.</p><div class='two'>";
  for (const bool forward : {true, false})
    if (closed.table.has(forward)) html += torque_chart(closed, forward);
  return html + "</div>";
}

std::string residual_charts(const DriveLoop& closed) {
  std::string html = std::string("<h2>Residual, before and after</h2>") + kColours +
                     "; measured less model, above zero the drive loses less than the model. The "
                     "lines are means: where the model is "
                     "whole the blue one is level at zero.</p><div class='two'>";
  for (const Quantity& quantity : quantities_of(closed)) html += residual_chart(closed, quantity);
  return html + "</div>";
}

std::vector<std::string> residual_trends(const DriveLoop& closed) {
  constexpr double kShare = 0.1;
  // neighbours of a log that drifts hang together: their means scatter more
  const double errors = closed.table.drifts ? 12.0 : 6.0;
  std::vector<std::string> sentences;
  if (closed.table.points.empty()) return sentences;
  for (const Quantity& quantity : quantities_of(closed)) {
    const CellMeans means(closed, quantity, closed.after_nm);
    if (means.cells < 2 || means.most_significant < errors || means.share < kShare) continue;
    const auto [low, high] = std::minmax_element(means.mean.begin(), means.mean.end());
    const auto at = [&](auto it) {
      return printed_number(*it, "%.3g") + " N m at " +
             printed_number(means.at[static_cast<std::size_t>(it - means.mean.begin())], "%.4g") +
             " " + quantity.unit;
    };
    sentences.push_back(std::string("What is left still follows the ") + quantity.name +
                        ": on average " + at(low) + ", " + at(high) +
                        " (torque at the input; chance moves these means by " +
                        printed_number(means.error_nm, "%.1g") + " N m).");
  }
  return sentences;
}

}  // namespace trueflank::loop
