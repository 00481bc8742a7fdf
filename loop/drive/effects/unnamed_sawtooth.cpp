// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A sawtooth over the input's angle: it rises or falls evenly and jumps back, as a ratchet, a screw
// that climbs and snaps or a cam with an edge does.
namespace trueflank::loop::drive_effects {

namespace {

enum ToothOfSaw : std::size_t { kSawOrder, kSawJump, kSawReads, kSawBased };

double saw_place(const BenchPoint& p, const DriveShape& s) {
  const double turns = s[kSawOrder] * p.angle_rad / kTwoPi - s[kSawJump];
  return turns - std::floor(turns);
}

/// Times per turn of the input at which something of this drive can come again.
std::vector<double> saw_orders(const DriveContext& context) {
  constexpr double kFewestTimes = 5.0, kMostPerTurn = 12.0;
  constexpr int kMultiples = 8;
  std::set<double> orders;
  for (const MemberOrder& member : context.model.orders)
    for (int k = 1; k <= kMultiples; ++k) {
      const bool whole = std::abs(member.order * k - std::round(member.order * k)) < 1e-9;
      const double order = member.order * k;
      const bool seen =
          context.table.turns <= 1.01 ? whole : order * context.table.turns >= kFewestTimes;
      if (seen && order <= kMostPerTurn) orders.insert(order);
    }
  for (int k = 1; k <= static_cast<int>(kMostPerTurn); ++k) orders.insert(k);
  std::vector<double> apart;
  for (const double order : orders)
    if (apart.empty() || order > apart.back() + 1e-6) apart.push_back(order);
  return apart;
}

std::vector<DriveShape> saw_shapes(const DriveContext& context, bool reads) {
  constexpr int kJumps = 40;
  std::vector<DriveShape> shapes;
  if (!context.table.has_angle) return shapes;
  for (const double order : saw_orders(context))
    for (int jump = 0; jump < kJumps; ++jump)
      shapes.push_back({order, static_cast<double>(jump) / kJumps, reads ? 1.0 : 0.0, 0.0});
  return shapes;
}

std::string saw_told(const DriveContext& context, const DriveShape& s, double amount,
                     const std::vector<Parameter>& figures) {
  const bool reads = s[kSawReads] != 0.0;
  const Parameter& height = reads ? figures.back() : figures.front();
  std::string member;
  for (const MemberOrder& one : context.model.orders)
    if (std::abs(one.order - s[kSawOrder]) < 1e-6 * std::max(1.0, s[kSawOrder]))
      member = " (" + one.member + ")";
  return (reads ? "a reading of the output's torque" : "a loss at the input") +
         std::string(" in a sawtooth over the angle of the input, ") + short_text(s[kSawOrder]) +
         " per turn" + member + ": it " + (amount > 0.0 ? "rises" : "falls") + " evenly by " +
         with_interval(height, " N m") + " and jumps back at " +
         with_interval(figures[2], " degrees") +
         (s[kSawOrder] > 1.001 ? printed(" and every %.4g degrees on", 360.0 / s[kSawOrder]) : "") +
         (s[kSawBased] != 0.0 ? ", from nothing on" : ", as much above as below its middle") +
         (reads ? kNoLoss : "");
}

DriveFamily sawtooth(bool reads) {
  DriveFamily f = reads ? reading_without_a_name() : without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"order", "jump", "as_it_reads", "based"};
  f.preference = 7;
  f.stands_alone = true;
  f.shape_values = {{}, {.continuous = true, .is_place = true, .reach = 0.03}, {}, {}};
  f.shapes = no_shapes;
  f.whole_shapes = [reads](const DriveContext& context) { return saw_shapes(context, reads); };
  f.falls_in_steps = true;
  f.kin_shapes = [](const DriveShape& s) {
    DriveShape based = s;
    based[kSawBased] = 1.0;
    return std::vector<DriveShape>{s, based};
  };
  f.turns_per_turn = {};
  f.all_shapes = [](const DriveContext& context, const DriveShape* about) {
    std::vector<DriveShape> shapes;
    if (about == nullptr) return shapes;
    for (const double step : growing_steps(context, 0.0005, 0.06)) {
      shapes.push_back(*about);
      shapes.back()[kSawJump] += step;
    }
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& s,
                  double* c) {
    c[0] = (saw_place(p, s) - (s[kSawBased] != 0.0 ? 0.0 : 0.5)) *
           changed_nm(context, p, s[kSawReads] != 0.0 ? double(kOutputReads) : double(kDrag));
  };
  f.figures = [](const DriveContext& context, const DriveShape& s, double amount) {
    std::vector<Parameter> figures{figure_of("amplitude_nm", std::abs(amount)),
                                   figure_of("periods_per_turn", s[kSawOrder]),
                                   figure_of("jumps_at_deg", 360.0 * s[kSawJump] / s[kSawOrder])};
    if (s[kSawReads] != 0.0)
      figures.push_back(figure_of("reads_more_nm", std::abs(amount) * context.model.ratio));
    return figures;
  };
  f.told = saw_told;
  f.words = [](const DriveModel&, const DriveShape& s, const DriveContext*) {
    return "in a sawtooth over the angle of the input, " + short_text(s[kSawOrder]) + " per turn";
  };
  return f;
}

}  // namespace

DriveFamily unnamed_sawtooth() { return sawtooth(false); }
DriveFamily unnamed_reading_sawtooth() { return sawtooth(true); }

}  // namespace trueflank::loop::drive_effects
