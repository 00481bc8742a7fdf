// SPDX-License-Identifier: GPL-3.0-or-later
// Several steps and rises at the ends at once, jumps that die away, skewed hollows, sawteeth and
// facets, as residuals in cells look like most: the same on every tooth, beside levels of either
// flank, and beside slopes and bows.
#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop {

bool are_no_stairs(const FlankGeometry& geometry, const std::vector<Effect>& effects,
                   std::size_t count) {
  constexpr double kFar = 0.25;  // of the range
  constexpr double kLengths = 2.0;
  for (std::size_t a = effects.size() - count; count > 1 && a < effects.size(); ++a) {
    const EffectShape& one = effects[a].shape;
    if (effects[a].family == find_family("unnamed_rise") &&
        one[1] > kFar * std::abs(gear_effects::range_mm(geometry, one[0])))
      return true;
    // (a step within a rise mends it)
    const auto rises_over = [&](const Effect& rise) {
      return rise.family == find_family("unnamed_rise") && rise.shape[0] == one[0] &&
             std::abs(gear_effects::stands_at(geometry, one[0], one[1]) -
                      gear_effects::end_mm(geometry, one[0], rise.shape[2])) <
                 kLengths * rise.shape[1];
    };
    if (effects[a].family == find_family("unnamed_step") &&
        std::any_of(effects.end() - static_cast<std::ptrdiff_t>(count), effects.end(), rises_over))
      return true;
    if (effects[a].family != find_family("unnamed_step")) continue;
    for (std::size_t b = a + 1; b < effects.size(); ++b) {
      const EffectShape& other = effects[b].shape;
      if (effects[b].family == effects[a].family && one[3] + other[3] > 0.0 &&
          std::abs(gear_effects::stands_at(geometry, one[0], one[1]) -
                   gear_effects::stands_at(geometry, other[0], other[1])) < one[3] + other[3])
        return true;
    }
  }
  return false;
}

namespace product_cells {
namespace {

constexpr Eigen::Index kOfFlank = kProductCells, kOfBoth = 2 * kOfFlank;
constexpr double kFirstPlace = 0.06;
constexpr int kPlacesOfACell = 4;

/// A course over one flank: means over the cells of what it is at a share of the way.
using Course = Eigen::Matrix<double, kOfFlank, 1>;
template <class Function>
Course means_in_cells(Function function) {
  constexpr int kOfACell = 4;
  Course course;
  for (Eigen::Index i = 0; i < kOfFlank; ++i) {
    double sum = 0.0;
    for (int k = 0; k < kOfACell; ++k)
      sum += function((static_cast<double>(i) + (k + 0.5) / kOfACell) / kOfFlank);
    course[i] = sum / kOfACell;
  }
  return course;
}

struct Jump {
  double share = 0.0;  ///< of the way, where it stands
  Course course;
  EffectShape shape;  ///< without the flanks
  const char* family = nullptr;
};

std::vector<double> places_of_jumps() {
  std::vector<double> places;
  for (int k = 1; k < kPlacesOfACell * kProductCells; ++k) {
    const double share = static_cast<double>(k) / (kPlacesOfACell * kProductCells);
    if (share > kFirstPlace && share < 1.0 - kFirstPlace) places.push_back(share);
  }
  return places;
}

/// Sums of all teeth on both flanks, with the roots of the weights on, and forms beside which jumps
/// are sought.
class OnBothFlanks {
 public:
  OnBothFlanks(const OfTeeth& teeth, double face, bool beside_names) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(kOfBoth), value = weight;
    for (const auto& tooth : teeth)
      for (const Eigen::Index side : {0, 1}) {
        const OfFlank& flank = tooth[static_cast<std::size_t>(side)];
        const Along& along = face != 0.0 ? flank.face : flank.profile;
        for (Eigen::Index i = 0; i < kOfFlank; ++i) {
          weight[side * kOfFlank + i] += along[static_cast<std::size_t>(i)].weight;
          value[side * kOfFlank + i] += along[static_cast<std::size_t>(i)].value;
        }
      }
    root_ = weight.cwiseSqrt();
    const Eigen::VectorXd values = (root_.array() > 0.0).select(value.array() / root_.array(), 0.0);
    const Course one = Course::Ones(),
                 slope = means_in_cells([](double share) { return 2.0 * share - 1.0; }),
                 bow = slope.cwiseAbs2();
    add_beside(one, {1.0, 0.0});
    add_beside(one, {0.0, 1.0});
    if (beside_names) {
      add_beside(slope, {1.0, 1.0});
      add_beside(slope, {1.0, -1.0});
      add_beside(bow, {1.0, 1.0});
    }
    values_ = less(values, beside_);
  }

  [[nodiscard]] Eigen::VectorXd column(const Course& course, const FlankWay& way) const {
    Eigen::VectorXd both(kOfBoth);
    both << way.signs[0] * course, way.signs[1] * course;
    return both.cwiseProduct(root_);
  }
  [[nodiscard]] const std::vector<Eigen::VectorXd>& beside() const { return beside_; }
  [[nodiscard]] const Eigen::VectorXd& values() const { return values_; }

  /// What is left of a column beside others, which are of length 1 and at right angles.
  [[nodiscard]] static Eigen::VectorXd less(Eigen::VectorXd column,
                                            const std::vector<Eigen::VectorXd>& others) {
    for (const Eigen::VectorXd& other : others) column -= other.dot(column) * other;
    return column;
  }

 private:
  void add_beside(const Course& course, const std::array<double, 2>& signs) {
    constexpr double kAnything = 1e-6;
    const Eigen::VectorXd column = this->column(course, {FlankChoice::kBoth, false, signs}),
                          rest = less(column, beside_);
    if (rest.norm() > kAnything * column.norm()) beside_.push_back(rest.normalized());
  }

  Eigen::VectorXd root_, values_;
  std::vector<Eigen::VectorXd> beside_;
};

/// Jumps on all ways of flanks: columns beside what they are sought beside.
struct Columns {
  struct Form {
    std::size_t way = 0, jump = 0;
  };
  std::vector<Form> forms;
  Eigen::MatrixXd rest;
  Eigen::VectorXd square;
};

Columns columns_of(const OnBothFlanks& flanks, const std::vector<Jump>& jumps,
                   const std::array<FlankWay, 4>& ways) {
  Columns columns;
  const auto count = static_cast<Eigen::Index>(ways.size() * jumps.size());
  columns.rest.resize(kOfBoth, count);
  columns.square.resize(count);
  for (std::size_t way = 0; way < ways.size(); ++way)
    for (std::size_t jump = 0; jump < jumps.size(); ++jump) {
      const auto c = static_cast<Eigen::Index>(columns.forms.size());
      const Eigen::VectorXd column = flanks.column(jumps[jump].course, ways[way]);
      columns.square[c] = column.squaredNorm();
      columns.rest.col(c) = OnBothFlanks::less(column, flanks.beside());
      columns.forms.push_back({way, jump});
    }
  return columns;
}

Effect effect_of(const Columns::Form& form, const std::vector<Jump>& jumps,
                 const std::array<FlankWay, 4>& ways) {
  Effect effect{find_family(jumps[form.jump].family), ways[form.way].flank, jumps[form.jump].shape};
  const double opposite = ways[form.way].opposite ? 1.0 : 0.0;
  // (a step has its edge behind the flanks)
  if (effect.family == find_family("unnamed_step"))
    effect.shape.insert(effect.shape.begin() + 2, opposite);
  else
    effect.shape.push_back(opposite);
  return effect;
}

constexpr double kSomething = 1e-3;  // of a jump's square

std::vector<Jump> steps_with_edges(const FlankGeometry& g, double face) {
  constexpr std::array kEdges{0.0, 0.05, 0.1, 0.2};  // of the range
  const double range = std::abs(gear_effects::range_mm(g, face));
  std::vector<Jump> steps;
  for (const double share : places_of_jumps())
    for (const double edge : kEdges) {
      const double place_mm = gear_effects::place_at(g, face, share);
      if (gear_effects::is_step_with_edge(g, face, place_mm, edge * range))
        steps.push_back(
            {share,
             means_in_cells([&](double at) { return gear_effects::beyond_edge(at - share, edge); }),
             {face, place_mm, edge * range},
             "unnamed_step"});
    }
  return steps;
}

std::vector<Jump> fading_jumps(const FlankGeometry& g, double face) {
  constexpr std::array kLengths{0.04, 0.08, 0.16, 0.3};  // of the range
  const double range = std::abs(gear_effects::range_mm(g, face));
  std::vector<Jump> jumps;
  for (const double share : places_of_jumps())
    for (const double length : kLengths)
      for (const double towards : {-1.0, 1.0})
        jumps.push_back(
            {share,
             means_in_cells([&](double at) {
               return gear_effects::fading_jump(towards * (at - share), length, 0.0);
             }),
             {face, gear_effects::place_at(g, face, share), length * range, towards, 0.0},
             "unnamed_fading_jump"});
  return jumps;
}

/// Forms that repeat along the way, of every period and from every place on.
template <class Function>
std::vector<Jump> repeating(const FlankGeometry& g, double face, const char* family,
                            Function function) {
  constexpr double kShortest = 0.09, kLongest = 0.5, kLonger = 1.03;  // of the range
  constexpr int kPhases = 12;
  const double range = std::abs(gear_effects::range_mm(g, face));
  // (over the profile the shares of a ring run against the roll lengths)
  const double sense = gear_effects::range_mm(g, face) > 0.0 ? 1.0 : -1.0;
  std::vector<Jump> jumps;
  for (double period = kShortest; period < kLongest; period *= kLonger)
    for (int phase = 0; phase < kPhases; ++phase) {
      const double share = 0.5 + period * (static_cast<double>(phase) / kPhases - 0.5);
      jumps.push_back(
          {share,
           means_in_cells([&](double at) { return function(sense * (at - share), period); }),
           {face, gear_effects::place_at(g, face, share), period * range},
           family});
    }
  return jumps;
}

std::vector<Jump> skewed_bands(const FlankGeometry& g, double face) {
  constexpr std::array kWidths{0.05, 0.09, 0.15, 0.24, 0.36};  // of the range
  const double range = std::abs(gear_effects::range_mm(g, face));
  const bool turned = gear_effects::range_mm(g, face) < 0.0;
  std::vector<Jump> jumps;
  for (const double share : places_of_jumps())
    for (std::size_t narrow = 0; narrow + 1 < kWidths.size(); ++narrow)
      for (std::size_t wide = narrow + 1; wide < kWidths.size(); ++wide)
        for (const bool above : {false, true}) {
          const double low = kWidths[above ? narrow : wide], high = kWidths[above ? wide : narrow];
          jumps.push_back({share,
                           means_in_cells([&](double at) {
                             return gear_effects::skewed_bell(at - share, low, high);
                           }),
                           {face, gear_effects::place_at(g, face, share),
                            (turned ? high : low) * range, (turned ? low : high) * range},
                           "unnamed_skewed_band"});
        }
  return jumps;
}

std::vector<Jump> rises(const FlankGeometry& g, double face) {
  constexpr std::array kLengths{0.04, 0.06, 0.09, 0.14, 0.2};  // of the range
  const double range = gear_effects::range_mm(g, face);
  std::vector<Jump> jumps;
  for (const double length : kLengths)
    for (const double end : {0.0, 1.0})
      jumps.push_back(
          {end,
           means_in_cells([&](double at) { return std::exp(-std::abs(at - end) / length); }),
           {face, length * std::abs(range), 2.0 * end - 1.0},
           "unnamed_rise"});
  return jumps;
}

/// The best of each way of flanks, a list each.
std::vector<LikelyForms> best_of_each_way(const FlankGeometry& g, const OnBothFlanks& flanks,
                                          const std::vector<Jump>& jumps) {
  const auto ways = flank_ways(g);
  const Columns columns = columns_of(flanks, jumps, ways);
  const Eigen::VectorXd products = columns.rest.transpose() * flanks.values();
  std::vector<LikelyForms> lists;
  double most = 0.0;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    LikelyForms list;
    for (std::size_t c = 0; c < columns.forms.size(); ++c) {
      if (columns.forms[c].way != way) continue;
      const auto at = static_cast<Eigen::Index>(c);
      const double left = columns.rest.col(at).squaredNorm();
      if (!(left > kSomething * columns.square[at])) continue;
      const double gain = products[at] * products[at] / left;
      if (gain > list.gain) list = {gain, {effect_of(columns.forms[c], jumps, ways)}};
    }
    most = std::max(most, list.gain);
    if (!list.forms.empty()) lists.push_back(std::move(list));
  }
  std::erase_if(lists, [&](const LikelyForms& list) { return list.gain < kNearly * most; });
  return lists;
}

}  // namespace

std::vector<LikelyForms> likeliest_jumps(const FlankGeometry& g, const OfTeeth& teeth, double face,
                                         bool beside_names) {
  const OnBothFlanks flanks(teeth, face, beside_names);
  std::vector<LikelyForms> lists;
  for (const std::vector<Jump>& jumps :
       {fading_jumps(g, face), skewed_bands(g, face),
        repeating(g, face, "unnamed_sawtooth", gear_effects::sawtooth),
        repeating(g, face, "unnamed_arches", gear_effects::arches)})
    for (LikelyForms& list : best_of_each_way(g, flanks, jumps)) lists.push_back(std::move(list));
  return lists;
}

std::vector<LikelyForms> likeliest_stairs(const FlankGeometry& g, const OfTeeth& teeth, double face,
                                          bool beside_names) {
  constexpr std::size_t kMost = 4;
  constexpr int kRounds = 2;
  constexpr double kFewest = 0.01;  // of what all take out
  constexpr double kApart = 2.0 / kProductCells;
  const OnBothFlanks flanks(teeth, face, beside_names);
  std::vector<Jump> forms = steps_with_edges(g, face);
  for (Jump& rise : rises(g, face)) forms.push_back(std::move(rise));
  const auto ways = flank_ways(g);
  const Columns columns = columns_of(flanks, forms, ways);
  std::vector<std::size_t> chosen;
  // The step that takes out most beside the chosen ones, and what that is.
  const auto best_beside = [&](std::vector<std::size_t> others) {
    std::vector<Eigen::VectorXd> base;
    for (const std::size_t other : others) {
      const Eigen::VectorXd rest =
          OnBothFlanks::less(columns.rest.col(static_cast<Eigen::Index>(other)), base);
      base.push_back(rest.normalized());
    }
    const Eigen::VectorXd left = OnBothFlanks::less(flanks.values(), base);
    const Eigen::VectorXd products = columns.rest.transpose() * left;
    Eigen::VectorXd squares = columns.rest.colwise().squaredNorm().transpose();
    for (const Eigen::VectorXd& one : base) squares -= (columns.rest.transpose() * one).cwiseAbs2();
    std::pair<std::size_t, double> best{columns.forms.size(), 0.0};
    for (std::size_t c = 0; c < columns.forms.size(); ++c) {
      const auto at = static_cast<Eigen::Index>(c);
      if (!(squares[at] > kSomething * columns.square[at])) continue;
      const double gain = products[at] * products[at] / squares[at];
      const Jump& step = forms[columns.forms[c].jump];
      // (beside another it would only mend its place or its edge)
      if (!(gain > best.second) ||
          std::any_of(others.begin(), others.end(), [&](std::size_t other) {
            const double off = std::abs(forms[columns.forms[other].jump].share - step.share);
            return off < kApart && (off > 0.0 || columns.forms[other].way == columns.forms[c].way);
          }))
        continue;
      best = {c, gain};
    }
    return best;
  };
  const auto taken_by = [&](const std::vector<std::size_t>& these) {
    std::vector<Eigen::VectorXd> base;
    double sum = 0.0;
    for (const std::size_t one : these) {
      base.push_back(
          OnBothFlanks::less(columns.rest.col(static_cast<Eigen::Index>(one)), base).normalized());
      const double product = base.back().dot(flanks.values());
      sum += product * product;
    }
    return sum;
  };
  // (waves on a part of the way are followed by steps, too, and much of them is left)
  constexpr double kLeft = 0.15, kByChance = 2.0 * kOfBoth;
  const double all = flanks.values().squaredNorm();
  std::vector<LikelyForms> stairs;
  double taken = 0.0;
  while (chosen.size() < kMost) {
    const auto [next, gain] = best_beside(chosen);
    if (next == columns.forms.size()) break;
    chosen.push_back(next);
    for (int round = 0; round < kRounds && chosen.size() > 1; ++round)
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        std::vector<std::size_t> others = chosen;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        const auto [other, more] = best_beside(others);
        if (other != columns.forms.size()) chosen[k] = other;
      }
    const double now = taken_by(chosen);
    if (!(now - taken > kFewest * now)) break;
    taken = now;
    if (chosen.size() == 1 || all - now > kLeft * all + kByChance) continue;
    LikelyForms list{.gain = now};
    for (const std::size_t one : chosen)
      list.forms.push_back(effect_of(columns.forms[one], forms, ways));
    stairs.push_back(std::move(list));
  }
  return stairs;
}

}  // namespace product_cells
}  // namespace trueflank::loop
