// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A loss that is least, or most, somewhere inside the range and grows to both sides; one that grows
// with the load or the speed and comes to an end; a gain of the output's torque that is wrong on
// one side of a load alone.
namespace trueflank::loop::drive_effects {

namespace {

enum ValleyValue : std::size_t { kValleyOver, kValleyPlace, kValleyPower };
/// What a loss that saturates grows with: the driving torque, the speed, what the output carries.
enum SaturatesOver { kOverDriving, kOverSpeed, kOverCarried };
/// Of one that saturates, x its load over the scale: 1 - exp(-x); exp(-x), there at no load;
/// x / (1 + x).
enum SaturatesValue : std::size_t { kSaturatesScale, kSaturatesOver, kSaturatesHow };
enum SaturatesHow { kSoonFull, kDiesAway, kSlowlyFull };
constexpr double kLeastScale = 0.03, kMostScale = 0.6;           // of the largest load or speed
constexpr double kFirstOfRanges = 0.08, kLastOfRanges = 0.95;    // of the largest load
constexpr double kValleyNearest = 0.12, kValleyFarthest = 0.88;  // of the range

double from_valley(const DriveContext& context, double share, const DriveShape& s) {
  const double room = std::max(1.0 - s[kValleyPlace],
                               s[kValleyPlace] - context.least_share(s[kValleyOver])),
               away = std::abs(share - s[kValleyPlace]) / room;
  return s[kValleyPower] == 2.0 ? away * away : away;
}

bool can_have_a_valley(const DriveContext& context, double over) {
  constexpr int kFewestLevels = 6;
  return context.table.levels[static_cast<std::size_t>(over)] >= kFewestLevels &&
         (over != 2.0 || context.table.temperature_span_c > 3.0);
}

std::string unit_of_places(double over) {
  return over == 0.0 ? " N m at the output" : unit_of_quantity(over);
}

double place_of_bench(const DriveContext& context, double over, double share) {
  return context.quantity_at_share(over, share) * (over == 0.0 ? context.model.ratio : 1.0);
}

/// The output's torque over what the largest load makes of it in the lossless drive.
double output_share(const DriveContext& context, const BenchPoint& p) {
  return p.load_nm * (p.forward ? context.efficiency(p) : 1.0) / context.table.most_load_nm;
}
bool is_above_range(const DriveContext& context, const BenchPoint& p, double share_of_load) {
  return output_share(context, p) > share_of_load;
}

}  // namespace

DriveFamily unnamed_valley() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place", "power"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {
      {},
      {.continuous = true,
       .is_place = true,
       .reach = 0.1,
       .limits = [](const DriveContext&) { return std::pair(kValleyNearest, kValleyFarthest); }},
      {}};
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double over : {0.0, 1.0, 2.0}) {
      if (!can_have_a_valley(context, over)) continue;
      for (const double power : {1.0, 2.0})
        for (double place = kValleyNearest; place <= kValleyFarthest; place += 0.02)
          shapes.push_back({over, place, power});
    }
    return shapes;
  };
  f.kind = [](const DriveShape& s) {
    return static_cast<int>(4.0 * s[kValleyOver] + s[kValleyPower]);
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double step : growing_steps(context, 0.002, 0.5)) {
      const double place = (*about)[kValleyPlace] + step;
      if (place >= kValleyNearest && place <= kValleyFarthest)
        shapes.push_back({(*about)[kValleyOver], place, (*about)[kValleyPower]});
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = -context.lever(p) * from_valley(context, context.share_of_range(p, s[kValleyOver]), s);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const std::string unit = s[kValleyOver] == 0.0 ? "output_nm" : key_of_quantity(s[kValleyOver]);
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        figure_of("turns_at_" + unit, place_of_bench(context, s[kValleyOver], s[kValleyPlace]))};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const double over = s[kValleyOver];
    const bool above = 1.0 - s[kValleyPlace] >= s[kValleyPlace] - context.least_share(over);
    const std::string end =
        printed("%.4g", place_of_bench(context, over, above ? 1.0 : context.least_share(over))) +
        unit_of_places(over);
    return std::string("a loss that is ") + (amount > 0.0 ? "least" : "most") + " at a " +
           name_of_quantity(over) + " of " + with_interval(figures[1], unit_of_places(over)) +
           " and " + (amount > 0.0 ? "grows" : "falls") + " to both sides, " +
           (s[kValleyPower] == 2.0 ? "by the square of what it is away" : "evenly") + ": " +
           with_interval(figures[0], amount > 0.0 ? " N m more" : " N m less") + " at " + end;
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that is least or most inside the range of the ") +
           name_of_quantity(s[kValleyOver]);
  };
  return f;
}

DriveFamily unnamed_saturating() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"scale", "over", "how"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {
      {.continuous = true,
       .limits = [](const DriveContext&) { return std::pair(kLeastScale, kMostScale); }},
      {},
      {}};
  f.shapes = no_shapes;
  // (what fills up more slowly is nearly in proportion)
  f.shows = [](const DriveContext&, const DriveShape& s) {
    constexpr double kSlowest = 0.35;
    return s[kSaturatesHow] != double(kSlowlyFull) || s[kSaturatesScale] < kSlowest;
  };
  f.whole_shapes = [](const DriveContext& context) {
    constexpr double kOfLeast = 0.7;  // at the least load a quarter of what dies away is left
    const double least = kOfLeast * context.table.least_load_nm / context.table.most_load_nm;
    std::vector<DriveShape> shapes;
    for (const double over : {double(kOverDriving), double(kOverSpeed), double(kOverCarried)}) {
      const bool speed = over == double(kOverSpeed);
      if (!can_have_a_valley(context, speed ? 1.0 : 0.0)) continue;
      for (double scale = kLeastScale; scale < kMostScale; scale *= 1.15) {
        shapes.push_back({scale, over, double(kSoonFull)});
        shapes.push_back({scale, over, double(kSlowlyFull)});
        // (what dies away over the speed has a name)
        if (!speed && scale >= least) shapes.push_back({scale, over, double(kDiesAway)});
      }
    }
    return shapes;
  };
  f.kind = [](const DriveShape& s) {
    return static_cast<int>(3.0 * s[kSaturatesHow] + s[kSaturatesOver]);
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.01, 1.5, kLeastScale, kMostScale, true});
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double over = s[kSaturatesOver],
                 share = over == double(kOverDriving) ? p.load_nm / context.table.most_load_nm
                         : over == double(kOverSpeed) ? p.speed_rpm / context.table.most_speed_rpm
                                                      : context.share_of_range(p, 0.0),
                 x = share / s[kSaturatesScale], gone = std::exp(-x);
    c[0] = -context.lever(p) * (s[kSaturatesHow] == double(kDiesAway)     ? gone
                                : s[kSaturatesHow] == double(kSlowlyFull) ? x / (1.0 + x)
                                                                          : 1.0 - gone);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const BenchTable& t = context.table;
    const double scale = s[kSaturatesScale];
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(amount)),
        s[kSaturatesOver] == double(kOverDriving)
            ? figure_of("within_input_nm", scale * t.most_load_nm)
        : s[kSaturatesOver] == double(kOverSpeed)
            ? figure_of("within_rpm", scale * t.most_speed_rpm)
            : figure_of("within_output_nm", scale * t.most_carried_nm * context.model.ratio)};
  };
  f.told = [](const DriveContext&, const DriveShape& s, double amount,
              const std::vector<Parameter>& figures) {
    const bool speed = s[kSaturatesOver] == double(kOverSpeed), gone = s[kSaturatesHow] == double(kDiesAway);
    const std::string size = with_interval(figures[0], amount > 0.0 ? " N m" : " N m less"),
                      within = with_interval(figures[1], speed ? " rpm"
                                                         : s[kSaturatesOver] == double(kOverDriving)
                                                             ? " N m at the input"
                                                             : " N m at the output");
    if (gone)
      return "a loss at low load that dies away as the load grows: " + size +
             " at no load, all but a third of that gone within " + within +
             " (bearings or planets that skid, a part that finds its seat under load?)";
    return std::string("a loss that grows with the ") + (speed ? "speed" : "load") +
           " and saturates: it comes to " + size +
           (s[kSaturatesHow] == double(kSlowlyFull) ? ", slowly, half of that within "
                                                    : ", all but a third of that within ") +
           within + (speed ? "" : " (dry friction that is full soon?)");
  };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return s[kSaturatesHow] == double(kDiesAway)
               ? std::string("that dies away as the load grows")
               : std::string("that grows with the ") +
                     (s[kSaturatesOver] == double(kOverSpeed) ? "speed" : "load") +
                     " and saturates";
  };
  return f;
}

DriveFamily unnamed_gain_of_range() {
  enum GainOfRange : std::size_t { kRangePlace, kRangeBelow };
  DriveFamily f = reading_without_a_name();
  f.shape_names = {"place", "below"};
  f.correction =
      "load the output by weights on a lever, below and above this torque: what its torque reads "
      "otherwise on one side alone is the error of that range";
  f.shape_values = {
      {.continuous = true,
       .is_place = true,
       .reach = 0.03,
       .limits = [](const DriveContext&) { return std::pair(kFirstOfRanges, kLastOfRanges); }},
      {}};
  f.falls_in_steps = true;
  f.asked_of_one_direction = true;
  f.shapes = no_shapes;
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!can_have_a_valley(context, 0.0)) return shapes;
    for (const double below : {0.0, 1.0})
      for (double place = kFirstOfRanges; place < kLastOfRanges; place += 0.01)
        shapes.push_back({place, below});
    return shapes;
  };
  f.kind = [](const DriveShape& s) { return static_cast<int>(s[kRangeBelow]); };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    return about == nullptr
               ? std::vector<DriveShape>{}
               : with_first_moved(context, *about, {0.0005, 0.1, kFirstOfRanges, kLastOfRanges});
  };
  // A range that few rows are in is not seen.
  f.shows = [](const DriveContext& context, const DriveShape& s) {
    constexpr double kFewest = 8.0, kLeastPart = 0.1;
    double above = 0.0, n = 0.0;
    for (const BenchPoint& p : context.table.points) {
      above += is_above_range(context, p, s[kRangePlace]) ? 1.0 : 0.0;
      n += 1.0;
    }
    return std::min(above, n - above) >= std::max(kFewest, kLeastPart * n);
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const bool above = is_above_range(context, p, s[kRangePlace]);
    c[0] = above == (s[kRangeBelow] == 0.0)
               ? output_share(context, p) * changed_nm(context, p, kOutputReads)
               : 0.0;
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double place = s[kRangePlace] * context.table.most_load_nm,
                 end = s[kRangeBelow] == 0.0 ? context.table.most_carried_nm : place,
                 gain = amount / context.table.most_load_nm;
    return std::vector<Parameter>{
        figure_of("amplitude_nm", std::abs(gain) * end), figure_of("gain_percent", 100.0 * gain),
        figure_of(s[kRangeBelow] == 0.0 ? "from_output_nm" : "up_to_output_nm",
                  place * context.model.ratio),
        figure_of("reads_more_nm", gain * end * context.model.ratio)};
  };
  f.told = [](const DriveContext& context, const DriveShape& s, double,
              const std::vector<Parameter>& figures) {
    const bool both = context.table.has(true) && context.table.has(false);
    return "the output's torque reads " + percent_in_words(figures[1]) +
           (s[kRangeBelow] == 0.0 ? " from a load of " : " up to a load of ") +
           with_interval(figures[2], " N m at the output") +
           (s[kRangeBelow] == 0.0 ? " on and is right below" : " and is right above") + ": it " +
           reads_in_words(figures[3]) +
           (s[kRangeBelow] == 0.0 ? " at the largest load" : " there") + (both ? kNoLoss : "") +
           ": a range of the amplifier with another gain?";
  };
  f.words = [](const DriveModel&, const DriveShape&, const DriveContext*) {
    return std::string("as a gain of the output's torque on one side of a load alone");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{1.0, 0.0, 0.0, 0.0, 1.0}};
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
