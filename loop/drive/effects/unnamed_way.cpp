// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What differs between a load, a speed or a temperature that rises and one that falls: a sensor
// with hysteresis, oil or grease that follows late.
namespace trueflank::loop::drive_effects {

namespace {

enum WayValue : std::size_t { kWayOver, kWayOf, kWayForm, kWayTurns, kWayWithin };
/// As much everywhere; most in the middle of the range, nothing at its ends; as much everywhere
/// once the load has moved a part of the range (kWayWithin) from where it turned.
enum WayForm { kEven, kMiddle, kGoesOver };
constexpr double kLeastWithin = 0.04, kMostWithin = 1.2;
/// What stands where it turned: half of it on either way, as it came, as if it rose, as if it fell,
/// nothing where it stands.
enum WayTurns { kHalves, kAsItCame, kAsItRises, kAsItFalls, kNothing };

double way_of(const BenchPoint& p, const DriveShape& s) {
  if (s[kWayOver] == 2.0)
    return s[kWayTurns] == double(kNothing) ? p.warmth_stepped : p.warmth_kept;
  const bool load = s[kWayOver] == 0.0;
  const int way = load ? p.way : p.speed_way, kept = load ? p.way_kept : p.speed_way_kept;
  switch (static_cast<int>(s[kWayTurns])) {
    case kAsItCame:
      return kept;
    case kNothing:
      return load ? p.way_stepped : p.speed_way_stepped;
    case kAsItRises:
      return std::max(way, kept);
    case kAsItFalls:
      return std::min(way, kept);
    default:
      return way;
  }
}

double form_at(const DriveContext& context, const BenchPoint& p, const DriveShape& s) {
  const bool load = s[kWayOver] == 0.0;
  if (s[kWayForm] == double(kEven)) return 1.0;
  if (s[kWayForm] != double(kMiddle))
    return std::min(1.0, 2.0 * (load ? p.moved : p.speed_moved) / s[kWayWithin] - 1.0);
  const double x =
      load ? p.load_nm / context.table.most_load_nm : context.share_at(1.0, p.speed_rpm);
  return std::max(0.0, 4.0 * x * (1.0 - x));
}

/// Ways that these rows tell apart: where nothing stands at a turn there is one.
std::vector<double> turns_that_differ(const DriveContext& context, double over, bool that_stand) {
  std::vector<double> turns;
  std::vector<std::vector<double>> seen;
  std::vector<double> all{double(kHalves), double(kAsItCame), double(kAsItRises),
                          double(kAsItFalls)};
  if (over == 2.0) all = {double(kAsItCame)};
  if (that_stand) all.push_back(double(kNothing));
  for (const double how : all) {
    std::vector<double> ways;
    for (const BenchPoint& p : context.table.points)
      ways.push_back(way_of(p, {over, 0.0, double(kEven), how}));
    if (std::find(seen.begin(), seen.end(), ways) != seen.end()) continue;
    seen.push_back(std::move(ways));
    turns.push_back(how);
  }
  return turns;
}

std::string where_in_words(const DriveShape& s, const std::vector<Parameter>& figures) {
  if (s[kWayForm] == double(kEven)) return "";
  if (s[kWayForm] == double(kMiddle)) return ", most in the middle of the range";
  return ", and goes over from one to the other within " +
         with_interval(figures[2], s[kWayOver] == 0.0 ? " N m at the output" : " rpm") +
         " of where it turns";
}

/// How far the load at the output, or the speed, moves meanwhile.
double moved_within(const DriveContext& context, const DriveShape& s) {
  return s[kWayWithin] * (s[kWayOver] == 0.0 ? context.table.most_load_nm * context.model.ratio
                                             : context.table.most_speed_rpm);
}

std::string way_told(const DriveContext& context, const DriveShape& s, double amount,
                     const std::vector<Parameter>& figures) {
  const std::string over = name_of_quantity(s[kWayOver]), where = where_in_words(s, figures);
  const bool more = amount > 0.0;
  if (s[kWayOf] == double(kOutputReads)) {
    const std::string half = with_interval(figures[0], " N m");
    return "the output's torque reads " + half + (more ? " more" : " less") + " while the " + over +
           " rises and as much " + (more ? "less" : "more") + " while it falls" + where + ": " +
           with_interval(figures[1], " N m") +
           " between the two (a torque sensor with hysteresis? one at the input " +
           printed("that reads %.3g N m ", figures[0].value / context.model.ratio) +
           (more ? "less" : "more") + " while it rises looks the same)";
  }
  const bool both = context.table.has(true) && context.table.has(false);
  return "a loss that differs with the way of the " + over + ": " +
         with_interval(figures[1], " N m") + (more ? " more" : " less") +
         " while it rises than while it falls" + where +
         (s[kWayOf] == double(kFlanks) ? ", in proportion to the load" : "") +
         (both ? "" : " (or a torque sensor with hysteresis: the other direction would tell)");
}

/// What a sensor reads otherwise, or what the drive loses.
DriveFamily family_of_ways(std::vector<double> of_what) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "of", "form", "turns"};
  f.kind = [](const DriveShape& s) { return static_cast<int>(4.0 * s[kWayOver] + s[kWayOf]); };
  f.preference = 8;
  f.stands_alone = true;
  const auto shapes_of = [of_what](const DriveContext& context, bool that_stand) {
    std::vector<DriveShape> shapes;
    for (const double over : {0.0, 1.0, 2.0}) {
      // (that of a temperature is asked once the others are chosen)
      if (!goes_up_and_down(context, over) || (over == 2.0 && !that_stand)) continue;
      for (const double turns : turns_that_differ(context, over, that_stand))
        for (const double of : of_what)
          for (const double form : {double(kEven), double(kMiddle)})
            if ((turns == double(kHalves) && over != 2.0) || form == double(kEven))
              shapes.push_back({over, of, form, turns});
    }
    return shapes;
  };
  f.shapes = [shapes_of](const DriveContext& context) { return shapes_of(context, false); };
  f.whole_shapes = [shapes_of](const DriveContext& context) { return shapes_of(context, true); };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    const double way = way_of(p, s);
    c[0] = way == 0.0 ? 0.0 : way * form_at(context, p, s) * changed_nm(context, p, s[kWayOf]);
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    const double size =
        std::abs(amount) * (s[kWayOf] == double(kOutputReads) ? context.model.ratio : 1.0);
    std::vector<Parameter> figures{figure_of("to_either_side_nm", size),
                                   figure_of("between_nm", 2.0 * size)};
    if (s[kWayForm] == double(kGoesOver))
      figures.push_back(
          figure_of(s[kWayOver] == 0.0 ? "goes_over_within_nm" : "goes_over_within_rpm",
                    moved_within(context, s)));
    return figures;
  };
  f.told = way_told;
  // Rows that were sped up or slowed down stand at other speeds: it may be a piece of a form of
  // these.
  f.piece_over = [](const DriveShape& s) { return s[kWayOver] == 1.0 ? 1.0 : kOverSeveral; };
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return std::string("that differs with the way of the ") + name_of_quantity(s[kWayOver]) +
           " (rising or falling)";
  };
  return f;
}

}  // namespace

DriveFamily unnamed_way() { return family_of_ways({double(kDrag), double(kFlanks)}); }

DriveFamily unnamed_hysteresis() {
  DriveFamily f = family_of_ways({double(kOutputReads)});
  f.is_loss = false;
  return f;
}

DriveFamily unnamed_play() {
  DriveFamily f = family_of_ways({double(kOutputReads)});
  f.is_loss = false;
  f.whole_shapes = {};
  f.shape_names.emplace_back("within");
  f.shape_values = {{}, {}, {}, {}, {.continuous = true, .limits = [](const DriveContext&) {
                                       return std::pair(kLeastWithin, kMostWithin);
                                     }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (const double over : {0.0, 1.0})
      if (goes_up_and_down(context, over))
        for (const double within : {0.15, 0.35, 0.7})
          shapes.push_back(
              {over, double(kOutputReads), double(kGoesOver), double(kAsItCame), within});
    return shapes;
  };
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double wider : growing_steps(context, 0.02, 1.0)) {
      shapes.push_back(*about);
      shapes.back()[kWayWithin] =
          std::clamp((*about)[kWayWithin] * std::exp(wider), kLeastWithin, kMostWithin);
    }
    return shapes;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
