// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/bench_visits.h"

namespace trueflank::loop {

double CalibratedLosses::at_reference(double amount, double rate_per_c) const {
  return amount * std::exp(-rate_per_c * (losses.reference_c - bench_temperature_c));
}

bool CalibratedLosses::add(double& amount, double more, double& shape, double its_shape) {
  if (amount != 0.0 && std::abs(shape - its_shape) > 1e-9 * std::max(1.0, std::abs(its_shape)))
    return false;
  amount += more;
  shape = its_shape;
  return true;
}

}  // namespace trueflank::loop

namespace trueflank::loop::drive_effects {

std::vector<DriveShape> where_rows_follow_each_other(const DriveContext& context) {
  constexpr int kFewestUnits = 8;
  return context.table.units >= kFewestUnits ? std::vector<DriveShape>{{}} : std::vector<DriveShape>{};
}

std::vector<DriveShape> speed_shapes(const DriveContext& context) {
  std::vector<DriveShape> shapes;
  const double most = context.table.most_speed_rpm;
  // A scale beyond the range is a slope, one below the slowest set points is not seen.
  for (double part : {0.02, 0.04, 0.07, 0.11, 0.16, 0.23, 0.32, 0.45})
    if (part * most > 0.3 * context.table.least_speed_rpm) shapes.push_back({part * most});
  if (!(most > 3.0 * context.table.least_speed_rpm)) shapes.clear();
  return shapes;
}

std::vector<double> places_between(std::vector<double> shares, double about, std::ptrdiff_t most) {
  std::sort(shares.begin(), shares.end());
  const auto n = static_cast<std::ptrdiff_t>(shares.size()),
             at = std::upper_bound(shares.begin(), shares.end(), about) - shares.begin();
  std::vector<double> places;
  for (auto k = std::max<std::ptrdiff_t>(1, at - most); k < std::min(n, at + most); ++k)
    if (const auto row = static_cast<std::size_t>(k); shares[row] > shares[row - 1])
      places.push_back(0.5 * (shares[row] + shares[row - 1]));
  return places;
}

std::vector<DriveShape> fading_shapes(const DriveContext& context) {
  std::vector<DriveShape> shapes;
  for (const double exponent : {2.0, 1.0})
    for (const DriveShape& speed : speed_shapes(context))
      shapes.push_back({speed.front(), exponent});
  return shapes;
}

std::pair<double, double> speed_limits(const DriveContext& context) {
  return {0.3 * context.table.least_speed_rpm + 1e-3 * context.table.most_speed_rpm,
          0.7 * context.table.most_speed_rpm};
}

std::vector<DriveShape> rate_shapes(const DriveContext& context) {
  if (!context.table.has_temperature || context.table.temperature_span_c < 3.0) return {};
  return {{0.005}, {0.01}, {0.018}, {0.027}, {0.04}, {0.06}, {0.09}};
}

std::pair<double, double> rate_limits(const DriveContext&) { return {0.002, 0.2}; }

double thinning(const DriveContext& context, const BenchPoint& p, double rate) {
  return std::exp(-rate * (p.temperature_c - context.table.mean_temperature_c));
}

std::vector<DriveReference> mean_temperature(const DriveContext& context) {
  return {{"reference_c", context.table.mean_temperature_c}};
}

bool can_be_friction(const DriveModel& model, const DriveShape&, double change) {
  return model.friction + change > 0.0 && model.friction + change < kMostFriction;
}

std::string short_text(double value) { return printed("%.4g", value); }

std::string wave_in_words(const DriveModel& model, double order) {
  std::string text = "in a wave of order " + short_text(order) + " per input turn";
  for (const MemberOrder& member : model.orders)
    if (std::abs(member.order - order) < 1e-6 * std::max(1.0, order)) return text + " (" + member.member + ")";
  return text;
}

std::vector<TermKey> drive_term_keys() {
  using Kind = TermKey::Kind;
  return {{"load_degree"}, {"speed_degree"}, {"temperature_degree"}, {"order", Kind::kNumber},
          {"directions", Kind::kWord, {"equal", "opposite"}}};
}

DriveFamily without_a_name() {
  DriveFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.named = false;
  f.preference = 6;
  f.term_keys = drive_term_keys();
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 0.0}};
  };
  f.not_carried = "a description without a cause";
  return f;
}

double coordinate(const DriveContext& context, const BenchPoint& p, double over) {
  return over == 0.0   ? context.load_coordinate(p)
         : over == 1.0 ? context.speed_coordinate(p)
                       : context.temperature_coordinate(p);
}

const char* name_of_quantity(double over) {
  return over == 0.0 ? "load" : over == 1.0 ? "speed" : "temperature";
}

double in_direction(const DriveContext& context, const BenchPoint& p, double which) {
  if (which == kAsItReads || which == kAsItsGainReads)
    return context.model.ratio * context.misread(p, false) *
           (which == kAsItsGainReads ? true_share(context, p) : 1.0);
  return is_of_direction(p, which) ? -context.lever(p) : 0.0;
}

double sized_loss_nm(const DriveContext& context, const BenchPoint& p, double of) {
  return of == kBySpeed ? -context.lever(p) * p.speed_rpm / context.table.most_speed_rpm
                        : changed_nm(context, p, of);
}

std::string in_proportion(double of) {
  return of == kBySpeed          ? " in proportion to the speed"
         : of == double(kFlanks) ? " in proportion to the load"
                                 : "";
}

std::string at_the_largest(double of) {
  return of == kBySpeed          ? " at the largest speed"
         : of == double(kFlanks) ? " at the largest load"
                                 : "";
}

double true_share(const DriveContext& context, const BenchPoint& p) {
  const double eta = context.efficiency(p);
  const double input_nm = p.forward ? context.load_nm(p) * eta : p.driven_nm / std::max(eta, 0.05);
  return std::max(0.0, input_nm) / std::max(context.table.most_load_nm, 1e-300);
}

std::string reads_in_words(const Parameter& figure) {
  Parameter size = figure;
  if (figure.value < 0.0) size = {figure.name, -figure.value, -figure.high, -figure.low};
  return "reads " + with_interval(size, " N m") + (figure.value < 0.0 ? " less" : " more");
}

DriveFamily reading_without_a_name() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.preference = 7;
  f.is_loss = false;
  f.stands_alone = true;
  return f;
}

std::vector<DriveShape> terms_of_reading(double what) {
  return {{what == double(kOutputGain) ? 1.0 : 0.0, 0.0, 0.0, 0.0, 1.0}};
}

std::vector<double> directions_alone(const DriveContext& context) {
  return context.table.has(true) && context.table.has(false) ? std::vector{0.0, 1.0, 2.0}
                                                             : std::vector{0.0};
}

std::string direction_in_words(double which) {
  return which == 0.0 ? "" : which == 1.0 ? " while the input drives" : " while the output drives";
}

std::string key_of_quantity(double over) {
  return over == 0.0 ? "load_nm" : over == 1.0 ? "rpm" : "c";
}

std::string unit_of_quantity(double over) {
  return over == 0.0 ? " N m at the input" : over == 1.0 ? " rpm" : " C";
}

std::string unit_alone(double over) { return over == 0.0 ? " N m" : over == 1.0 ? " rpm" : " C"; }

Parameter figure_of(const std::string& name, double value) { return {name, value, value, value}; }

std::string with_interval(const Parameter& figure, const std::string& unit) {
  std::string text = printed("%.4g", figure.value);
  if (figure.high > figure.low)
    text += " (" + printed("%.4g", figure.low) + " to " + printed("%.4g", figure.high) + ")";
  return text + unit;
}

namespace {

std::vector<double> levels_of_values(std::vector<double> values) {
  constexpr std::size_t kMost = 24;
  constexpr double kApart = 0.02;  // of the range
  std::sort(values.begin(), values.end());
  const double apart = kApart * (values.back() - values.front());
  std::vector<double> levels;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && values[i] - values[i - 1] > apart) {
      levels.push_back(sum / count);
      sum = count = 0.0;
    }
    sum += values[i];
    count += 1.0;
  }
  levels.push_back(sum / count);
  const double widest = values.back() - values.front();
  // A ramp has no levels: even steps.
  if (levels.size() >= 4 && levels.size() <= kMost) return levels;
  levels.clear();
  for (std::size_t k = 0; k < kMost; ++k)
    levels.push_back(values.front() + widest * static_cast<double>(k) / (kMost - 1.0));
  return levels;
}

}  // namespace

std::vector<double> levels_run(const DriveContext& context, double over) {
  return levels_of_values(values_of(context.table.points, over == 0.0 ? &BenchPoint::load_nm
                                                          : over == 1.0
                                                              ? &BenchPoint::speed_rpm
                                                              : &BenchPoint::temperature_c));
}

std::vector<double> places_between_levels(const DriveContext& context, double over) {
  const std::vector<double> levels =
      over == 0.0 ? levels_of_values(values_of(context.table.points, &BenchPoint::carried_nm))
                  : levels_run(context, over);
  std::vector<double> places;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    if (k > 0) places.push_back(context.share_at(over, levels[k]));
    places.push_back(context.share_at(over, 0.5 * (levels[k] + levels[k + 1])));
  }
  return places;
}

std::vector<double> growing_steps(const DriveContext& context, double first, double last) {
  constexpr std::size_t kVeryMany = 3000;
  const double growth = context.table.points.size() < kVeryMany ? 1.3 : 2.0;
  std::vector<double> steps{0.0};
  for (double step = first; step < last; step *= growth) {
    steps.push_back(step);
    steps.push_back(-step);
  }
  return steps;
}

std::vector<DriveShape> with_first_moved(const DriveContext& context, const DriveShape& about,
                                         const ValueSteps& steps) {
  std::vector<DriveShape> shapes;
  for (const double step : growing_steps(context, steps.first, steps.last)) {
    const double value = steps.as_shares ? about.front() * std::exp(step) : about.front() + step;
    if (!(value >= steps.least && value <= steps.most)) continue;
    shapes.push_back(about);
    shapes.back().front() = value;
  }
  return shapes;
}

std::string percent_in_words(const Parameter& figure) {
  Parameter size = figure;
  if (figure.value < 0.0) size = {figure.name, -figure.value, -figure.high, -figure.low};
  return with_interval(size, " %") + (figure.value < 0.0 ? " less" : " more");
}

bool goes_up_and_down(const DriveContext& context, double over) {
  constexpr int kFewestTurns = 4, kFewestRows = 8;
  int turns = 0, before = 0;
  std::array<int, 2> rows{};
  for (const BenchPoint& p : context.table.points) {
    const int way = over == 0.0 ? p.way : over == 1.0 ? p.speed_way : p.warmth_stepped;
    if (way == 0) continue;
    ++rows[way > 0 ? 1 : 0];
    turns += before != 0 && way != before ? 1 : 0;
    before = way;
  }
  return turns >= kFewestTurns && rows[0] >= kFewestRows && rows[1] >= kFewestRows;
}

bool some_follows_the_load(const std::vector<DriveEffect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const DriveEffect& e) {
    if (e.family->named) return false;
    if (e.family->over) return e.family->over(e.shape) == 0.0;
    const std::vector<DriveShape> terms = e.family->term_shapes(e.shape);
    return !e.family->stands_alone &&
           std::any_of(terms.begin(), terms.end(), [](const auto& t) { return t[0] != 0.0; });
  });
}

}  // namespace trueflank::loop::drive_effects
