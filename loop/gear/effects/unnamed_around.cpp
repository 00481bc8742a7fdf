// SPDX-License-Identifier: GPL-3.0-or-later
// Forms that go from tooth to tooth: sectors, every other tooth, drifts, combs.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"

namespace trueflank::loop::gear_effects {
namespace {

const TermKey kFlanks{"flanks", TermKey::Kind::kWord, {"equal", "opposite"}};
const TermKey kZeroAt{
    "zero_at", TermKey::Kind::kWord, {"mean", "first_tooth", "last_tooth"}};  // of a drift

std::string words_of_zero(double zero_at) {
  return zero_at == kMeanOfDrift    ? ""
         : zero_at == kFirstOfDrift ? ", from nothing on its first tooth"
                                    : ", to nothing on its last tooth";
}

/// 1 on teeth of the sector.
double in_sector(const FlankGeometry& g, int tooth, const EffectShape& shape) {
  return teeth_since(g, tooth, shape[0]) < static_cast<int>(shape[1]) ? 1.0 : 0.0;
}

/// A course of a degree without a height of its own.
double course_of_degree(double degree, double x) {
  // (most of what is tried is constant, straight or bowed, and powers take long)
  return degree == 0.0   ? 1.0
         : degree == 1.0 ? x
         : degree == 2.0 ? x * x - 1.0 / 3.0
                         : std::pow(x, degree);
}
/// Degrees over profile and face and the flanks, from the k-th shape value on.
double form_of_tooth(const FlankGeometry& g, const Place& p, const EffectShape& shape,
                     std::size_t k) {
  return (shape[k + 2] != 0.0 ? p.side : 1) *
         course_of_degree(shape[k], g.profile_coordinate(p.roll_mm)) *
         course_of_degree(shape[k + 1], g.face_coordinate(p.z_mm));
}

/// The same as the form of a family.
auto form_at(std::size_t k) {
  return [k](const FlankGeometry& g, const Place& p, const EffectShape& shape) {
    return form_of_tooth(g, p, shape, k);
  };
}
/// Equal on both flanks, or opposite ones where the k-th shape value says so.
auto place_or_height(std::size_t k) {
  return [k](const FlankGeometry&, const Place& p, const EffectShape& shape) {
    return shape[k] != 0.0 ? static_cast<double>(p.side) : 1.0;
  };
}

/// Teeth between two sectors.
constexpr double kFewestBetween = 2.0;

}  // namespace

EffectFamily unnamed_sector() {
  EffectFamily f = described("unnamed_sector", {"first_tooth", "teeth", "profile_degree",
                                                "face_degree", "opposite_flanks"});
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = in_sector(g, tooth, shape);
                  },
                  form_at(2)});
  f.term_keys = {{"first_tooth"}, {"teeth"}, {"profile_degree"}, {"face_degree"}, kFlanks};
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    return sectors_beside(g, shape, 2);
  };
  f.words = [](const ToldForm& told) {
    return "a sector of " +
           printed("%.0f teeth from tooth %.0f on ", told.shape[1], told.shape[0]) +
           CourseOfTeeth::at(told, 2).does();
  };
  return f;
}

EffectFamily unnamed_sectors() {
  EffectFamily f = described("unnamed_sectors", {"first_tooth", "teeth", "profile_degree",
                                                 "face_degree", "opposite_flanks", "number"});
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    constexpr double kRounding = 1e-9;
                    const double since = std::fmod(teeth_since(g, tooth, shape[0]) + kRounding,
                                                   g.teeth() / shape[5]);
                    factor[0] = since < shape[1] ? 1.0 : 0.0;
                  },
                  form_at(2)});
  f.term_keys = {{"first_tooth"}, {"teeth"}, {"profile_degree"},
                 {"face_degree"}, kFlanks,   {"number"}};
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = sectors_beside(g, shape, 2);
    std::erase_if(shapes, [&](const EffectShape& beside) {
      return beside[1] > g.teeth() / beside[5] - kFewestBetween;
    });
    return shapes;
  };
  f.words = [](const ToldForm& told) {
    return printed(
               "each of %.0f sectors of %.0f teeth, evenly spaced, the first from tooth %.0f on, ",
               told.shape[5], told.shape[1], told.shape[0]) +
           CourseOfTeeth::at(told, 2).does();
  };
  return f;
}

EffectFamily unnamed_soft_sector() {
  EffectFamily f =
      described("unnamed_soft_sector", {"middle_tooth", "teeth", "edge_teeth", "opposite_flanks"});
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = in_soft_run(g, tooth, shape[0], shape[1], shape[2]);
                  },
                  place_or_height(3)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    const auto add = [&](std::size_t k, double value) {
      shapes.push_back(shape);
      shapes.back()[k] = value;
    };
    for (const double off : {-1.0, -0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 1.0}) {
      add(0, shape[0] + off);
      if (shape[1] + off >= 2.0 && shape[1] + off < g.teeth()) add(1, shape[1] + off);
    }
    // (steeper ones are sectors with edges between two teeth)
    constexpr double kSteepest = 0.5;
    for (const double times : {0.7, 0.85, 0.95, 1.05, 1.18, 1.43})
      if (times * shape[2] >= kSteepest && times * shape[2] <= shape[1]) add(2, times * shape[2]);
    return shapes;
  };
  f.term_keys = {number("middle_tooth"), number("teeth"), number("edge_teeth"), kFlanks};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const double z = told.geometry.teeth(), middle = shape[0] - 1.0;
    const CourseOfTeeth course{
        .opposite = shape[3] != 0.0, .flank = told.flank, .sign = told.sign()};
    return printed("a sector of about %.0f teeth", shape[1]) +
           printed(" around tooth %.1f, ", middle - z * std::floor(middle / z) + 1.0) +
           over_edges(shape[2], true) + course.does();
  };
  return f;
}

EffectFamily unnamed_tooth_form() {
  EffectFamily f = described("unnamed_tooth_form",
                             {"tooth", "profile_degree", "face_degree", "opposite_flanks"});
  f.is_of_one_tooth = true;
  set_columns(f, {[](const FlankGeometry&, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = tooth == static_cast<int>(shape[0]) ? 1.0 : 0.0;
                  },
                  form_at(1)});
  f.term_keys = {{"tooth"}, {"profile_degree"}, {"face_degree"}, kFlanks};
  f.words = [](const ToldForm& told) {
    return printed("tooth %.0f alone ", told.shape[0]) + CourseOfTeeth::at(told, 1).does();
  };
  return f;
}

EffectFamily unnamed_alternation() {
  EffectFamily f =
      described("unnamed_alternation", {"profile_degree", "face_degree", "opposite_flanks"});
  set_columns(f, {[](const FlankGeometry&, int tooth, const EffectShape&, double* factor) {
                    factor[0] = tooth % 2 == 1 ? 1.0 : -1.0;
                  },
                  form_at(0)});
  f.term_keys = {{"profile_degree"}, {"face_degree"}, kFlanks};
  f.words = [](const ToldForm& told) {
    return "every other tooth differs: one of odd number " + CourseOfTeeth::at(told, 0).does();
  };
  return f;
}

namespace {

/// What begins at its first tooth begins some teeth before or after.
std::vector<EffectShape> begun_beside(const FlankGeometry& g, const EffectShape& shape) {
  std::vector<EffectShape> shapes;
  for (const double off : {-2.0, -1.0, 1.0, 2.0}) {
    shapes.push_back(shape);
    shapes.back()[0] = std::fmod(shape[0] - 1.0 + off + g.teeth(), g.teeth()) + 1.0;
  }
  return shapes;
}

}  // namespace

EffectFamily unnamed_ramp() {
  EffectFamily f = described("unnamed_ramp", {"first_tooth", "profile_degree", "face_degree",
                                              "opposite_flanks", "zero_at"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const double z = g.teeth();
                    factor[0] = teeth_since(g, tooth, shape[0]) / z -
                                (shape[4] == kMeanOfDrift    ? 0.5
                                 : shape[4] == kFirstOfDrift ? 0.0
                                                             : (z - 1.0) / z);
                  },
                  form_at(1)});
  f.nearby = begun_beside;
  f.term_keys = {{"first_tooth"}, {"profile_degree"}, {"face_degree"}, kFlanks, kZeroAt};
  f.words = [](const ToldForm& told) {
    const CourseOfTeeth course = CourseOfTeeth::at(told, 1);
    return printed("from tooth %.0f on, once around, ", told.shape[0]) + course.what() +
           " drifts evenly" + course.direction() + words_of_zero(told.shape[4]) +
           ", and begins anew, as from a tool that wears or a machine that warms up";
  };
  return f;
}

namespace {

/// An uneven drift, from tooth to tooth once around: it rises by 1 in all from its first tooth to
/// its last. (A level that it would come to after the last tooth stands on none.)
double uneven_drift(const FlankGeometry& g, int tooth, const EffectShape& shape) {
  const double z = g.teeth(), grows = shape[4], within = shape[5];
  // 1 at the steep end and dying away from it; the mean is a geometric sum.
  const double flat = std::exp(-(z - 1.0) / within),
               mean = std::expm1(-z / within) / (z * std::expm1(-1.0 / within));
  const double since = teeth_since(g, tooth, shape[0]);
  const double here = std::exp(-(grows != 0.0 ? z - 1.0 - since : since) / within);
  const double nothing = shape[6] == kMeanOfDrift               ? mean
                         : shape[6] == flat_end_of_drift(grows) ? flat
                                                                : 1.0;
  return (grows != 0.0 ? 1.0 : -1.0) * (here - nothing) / (1.0 - flat);
}

}  // namespace

EffectFamily unnamed_levelling() {
  EffectFamily f =
      described("unnamed_levelling", {"first_tooth", "profile_degree", "face_degree",
                                      "opposite_flanks", "grows", "within_teeth", "zero_at"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = uneven_drift(g, tooth, shape);
                  },
                  form_at(1)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = begun_beside(g, shape);
    for (const double times : {0.7, 0.87, 1.15, 1.43}) {
      EffectShape beside = shape;
      beside[5] = std::clamp(times * shape[5], 1.0, 2.0 * g.teeth());
      if (beside != shape) shapes.push_back(std::move(beside));
    }
    return shapes;
  };
  f.term_keys = {{"first_tooth"},
                 {"profile_degree"},
                 {"face_degree"},
                 kFlanks,
                 {"course", TermKey::Kind::kWord, {"levels_off", "grows"}},
                 number("within_teeth"),
                 kZeroAt};
  f.words = [](const ToldForm& told) {
    const CourseOfTeeth course = CourseOfTeeth::at(told, 1);
    const double teeth = std::min(std::ceil(told.shape[5]), double(told.geometry.teeth()));
    return printed("from tooth %.0f on, once around, ", told.shape[0]) + course.what() +
           (told.shape[4] != 0.0 ? " drifts more and more" : " drifts and levels off") +
           course.direction() +
           printed(told.shape[4] != 0.0 ? ", most of it in the last %.0f teeth"
                                        : ", most of it in the first %.0f teeth",
                   teeth) +
           words_of_zero(told.shape[6]) +
           ", and begins anew, as from a machine that warms up or a tool that wears";
  };
  return f;
}

EffectFamily unnamed_drift_aside() {
  EffectFamily f = described("unnamed_drift_aside", {"first_tooth"});
  f.is_drift = true;
  f.columns = [](const EffectShape&) { return 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const double since = teeth_since(g, p.tooth, shape[0]);
    two_directions(g, p, since / g.teeth() - 0.5, c);
  };
  f.nearby = begun_beside;
  f.term_keys = {{"first_tooth"}};
  f.words = [](const ToldForm& told) {
    return printed("from tooth %.0f on, once around, the teeth drift aside evenly", told.shape[0]) +
           in_direction(told.direction_rad()) +
           ", and begin anew, as where part or probe moved while it was made or measured";
  };
  return f;
}

EffectFamily unnamed_broken_wave() {
  EffectFamily f =
      described("unnamed_broken_wave", {"periods_per_turn", "first_tooth", "opposite_flanks"});
  f.is_drift = true;
  f.columns = [](const EffectShape&) { return 2; };
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const double since = teeth_since(g, tooth, shape[1]);
                    const double angle = kTwoPi * shape[0] * since / g.teeth();
                    factors[0] = std::cos(angle);
                    factors[1] = std::sin(angle);
                  },
                  place_or_height(2)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double longer : {-0.1, -0.03, 0.0, 0.03, 0.1})
      for (const double off : {-1.0, 0.0, 1.0}) {
        EffectShape beside = shape;
        beside[0] += longer;
        beside[1] = std::fmod(shape[1] - 1.0 + off + g.teeth(), g.teeth()) + 1.0;
        if (beside != shape && beside[0] > 0.2) shapes.push_back(std::move(beside));
      }
    return shapes;
  };
  f.term_keys = {number("periods_per_turn"), {"first_tooth"}, kFlanks};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    return printed("from tooth %.0f on, once around, the teeth stand ", shape[1]) +
           (shape[2] != 0.0 ? "ahead and behind" : "high and low") +
           printed(
               " in a wave of %.3g periods a turn, which does not close, as from a cutter that "
               "runs out and takes no whole number of teeth a turn",
               shape[0]);
  };
  return f;
}

EffectFamily unnamed_saw() {
  EffectFamily f = described("unnamed_saw", {"restarts_every", "first_tooth", "profile_degree",
                                             "face_degree", "opposite_flanks", "zero_at"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const int every = static_cast<int>(shape[0]);
                    const int since = teeth_since(g, tooth, shape[1]) % every;
                    // (from the first tooth of a run to its last)
                    factor[0] = static_cast<double>(since) / (every - 1) -
                                (shape[5] == kMeanOfDrift    ? 0.5
                                 : shape[5] == kFirstOfDrift ? 0.0
                                                             : 1.0);
                  },
                  form_at(2)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double longer : {-1.0, 0.0, 1.0})
      for (const double off : {-1.0, 0.0, 1.0}) {
        EffectShape beside = shape;
        beside[0] += longer;
        beside[1] = std::fmod(shape[1] - 1.0 + off + g.teeth(), g.teeth()) + 1.0;
        if (beside != shape && beside[0] >= 4.0 && 2.0 * beside[0] <= g.teeth())
          shapes.push_back(std::move(beside));
      }
    return shapes;
  };
  f.term_keys = {{"restarts_every"}, {"first_tooth"}, {"profile_degree"},
                 {"face_degree"},    kFlanks,         kZeroAt};
  f.words = [](const ToldForm& told) {
    const CourseOfTeeth course = CourseOfTeeth::at(told, 2);
    return printed("from tooth %.0f on ", told.shape[1]) + course.what() + " drifts evenly" +
           course.direction() + words_of_zero(told.shape[5]) +
           printed(
               ", and begins anew every %.0f teeth, as from a tool that wears and is dressed or "
               "set again",
               told.shape[0]);
  };
  return f;
}

EffectFamily unnamed_comb() {
  EffectFamily f = described(
      "unnamed_comb", {"every", "first_tooth", "profile_degree", "face_degree", "opposite_flanks"});
  f.is_followed_nearly = true;
  set_columns(f, {[](const FlankGeometry&, int tooth, const EffectShape& shape, double* factor) {
                    const int every = static_cast<int>(shape[0]);
                    factor[0] = (tooth - static_cast<int>(shape[1])) % every == 0 ? 1.0 : 0.0;
                  },
                  form_at(2)});
  f.needs = [](const EffectShape& shape) {
    return NeedsToBeSeen{.along_profile = shape[2] > 0.0, .along_face = shape[3] > 0.0};
  };
  f.term_keys = {{"every"}, {"first_tooth"}, {"profile_degree"}, {"face_degree"}, kFlanks};
  f.words = [](const ToldForm& told) {
    return printed("one tooth in %.0f, from tooth %.0f on, ", told.shape[0], told.shape[1]) +
           CourseOfTeeth::at(told, 2).does() + ", as from a cutter of so many teeth or starts";
  };
  return f;
}

namespace {

/// A shape that begins so many teeth before or after, on a tooth of the gear.
void move_tooth(const FlankGeometry& g, double teeth, double& tooth) {
  tooth = std::fmod(tooth - 1.0 + teeth + g.teeth(), g.teeth()) + 1.0;
}

/// "teeth 5 to 9", once around: up to the one before `after`.
std::string from_to(const FlankGeometry& g, double first, double after) {
  double last = after;
  move_tooth(g, -1.0, last);
  return printed("teeth %.0f to %.0f", first, last);
}

}  // namespace

EffectFamily unnamed_stairs() {
  EffectFamily f = described("unnamed_stairs",
                             {"first_tooth", "second_tooth", "third_tooth", "opposite_flanks"});
  f.columns = [](const EffectShape&) { return 2; };
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const int since = teeth_since(g, tooth, shape[0]);
                    const auto is_after = [&](double first) {
                      return since >= teeth_since(g, static_cast<int>(first), shape[0]);
                    };
                    const bool third = is_after(shape[2]), second = !third && is_after(shape[1]);
                    factors[0] = second ? 1.0 : 0.0;
                    factors[1] = third ? 1.0 : 0.0;
                  },
                  place_or_height(3)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr int kFewest = 2;
    std::vector<EffectShape> shapes;
    for (const std::size_t k : {0, 1, 2})
      for (const double off : {-4.0, -2.0, -1.0, 1.0, 2.0, 4.0}) {
        EffectShape beside = shape;
        move_tooth(g, off, beside[k]);
        const int second = teeth_since(g, static_cast<int>(beside[1]), beside[0]),
                  third = teeth_since(g, static_cast<int>(beside[2]), beside[0]);
        if (second >= kFewest && third >= second + kFewest && third <= g.teeth() - kFewest)
          shapes.push_back(std::move(beside));
      }
    return shapes;
  };
  f.term_keys = {{"first_tooth"}, {"second_tooth"}, {"third_tooth"}, kFlanks};
  f.words = [](const ToldForm& told) {
    const FlankGeometry& g = told.geometry;
    const EffectShape& shape = told.shape;
    const bool opposite = shape[3] != 0.0;
    const std::string base = from_to(g, shape[0], shape[1]),
                      cause = ", as from a tool that is dressed or set again";
    if (told.amounts.size() != 2)
      return std::string(opposite ? "the place of the teeth" : "the height") +
             " goes in steps: " + from_to(g, shape[1], shape[2]) + " and " +
             from_to(g, shape[2], shape[0]) + " differ from " + base + cause;
    const auto run = [&](std::size_t k, double first, double after) {
      const double um = told.amounts[k];
      return from_to(g, first, after) + " " +
             (opposite ? "stand " + turned(um < 0.0 ? -1 : 1) : stand(um < 0.0 ? -1 : 1)) +
             printed(" by %.3g um", std::abs(um));
    };
    return std::string(opposite ? "the place of the teeth" : "the height") +
           " goes in steps: against " + base + ", " + run(0, shape[1], shape[2]) + " and " +
           run(1, shape[2], shape[0]) + cause;
  };
  return f;
}

EffectFamily unnamed_drift_of_some() {
  EffectFamily f = described("unnamed_drift_of_some", {"first_tooth", "teeth", "profile_degree",
                                                       "face_degree", "opposite_flanks", "falls"});
  f.is_drift = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    const double since = teeth_since(g, tooth, shape[0]);
                    factor[0] = since >= shape[1] ? 0.0
                                : shape[5] != 0.0 ? (shape[1] - since) / shape[1]
                                                  : (since + 1.0) / shape[1];
                  },
                  form_at(2)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kFewest = 3.0;
    std::vector<EffectShape> shapes;
    // Teeth more at its first and at its last: where it jumps it moves by one.
    const auto add = [&](double first, double last) {
      EffectShape beside = shape;
      move_tooth(g, -first, beside[0]);
      beside[1] += first + last;
      if (beside[1] >= kFewest && beside[1] < g.teeth()) shapes.push_back(std::move(beside));
    };
    const bool falls = shape[5] != 0.0;
    for (const double jump : {-1.0, 0.0, 1.0})
      for (const double off : {-6.0, -4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0, 6.0})
        if (jump != 0.0 || off != 0.0) add(falls ? jump : off, falls ? off : jump);
    return shapes;
  };
  f.term_keys = {{"first_tooth"}, {"teeth"}, {"profile_degree"},
                 {"face_degree"}, kFlanks,   {"course", TermKey::Kind::kWord, {"rises", "falls"}}};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const CourseOfTeeth course = CourseOfTeeth::at(told, 2);
    double after = shape[0];
    move_tooth(told.geometry, shape[1], after);
    const std::string teeth = "over " + from_to(told.geometry, shape[0], after) + " alone ";
    return teeth + course.what() +
           (shape[5] != 0.0 ? " jumps" + course.direction() + ", and drifts back evenly"
                            : " drifts evenly" + course.direction() + ", and jumps back") +
           ", as from a tool that begins to wear or something that comes loose";
  };
  return f;
}

namespace {

/// A wave of some teeth that stands out to one way on all of them.
struct OneWay {
  int sign = 0;   ///< 0: it does not, or its phase is not known
  int tooth = 0;  ///< where it stands out most
};
OneWay one_way_of_wave(const ToldForm& told) {
  constexpr double kNothing = 0.2;  // of the largest: what an end may have of the other way
  if (told.amounts.size() < 2) return {};
  double most = 0.0, least = 0.0, middle = 0.0;
  for (double since = 0.0; since < told.shape[1]; since += 1.0) {
    const double angle = kTwoPi * told.shape[2] * since / told.geometry.teeth(),
                 um = told.amounts[0] * std::cos(angle) + told.amounts[1] * std::sin(angle);
    if (std::abs(um) > std::max(most, -least)) middle = since;
    most = std::max(most, um);
    least = std::min(least, um);
  }
  if (std::min(most, -least) > kNothing * std::max(most, -least)) return {};
  double tooth = told.shape[0];
  move_tooth(told.geometry, middle, tooth);
  return {most > -least ? 1 : -1, static_cast<int>(tooth)};
}

}  // namespace

EffectFamily unnamed_wave_of_some() {
  EffectFamily f = described("unnamed_wave_of_some",
                             {"first_tooth", "teeth", "periods_per_turn", "opposite_flanks"});
  f.columns = [](const EffectShape&) { return 2; };
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const double since = teeth_since(g, tooth, shape[0]);
                    const bool on = since < shape[1];
                    const double angle = kTwoPi * shape[2] * since / g.teeth();
                    factors[0] = on ? std::cos(angle) : 0.0;
                    factors[1] = on ? std::sin(angle) : 0.0;
                  },
                  place_or_height(3)});
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = sectors_beside(g, shape, 2);
    for (const double longer : {-0.5, -0.2, -0.07, 0.07, 0.2, 0.5}) {
      shapes.push_back(shape);
      shapes.back()[2] += longer;
    }
    return shapes;
  };
  f.term_keys = {{"first_tooth"}, {"teeth"}, number("periods_per_turn"), kFlanks};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    double after = shape[0];
    move_tooth(told.geometry, shape[1], after);
    const std::string teeth =
        "over " + from_to(told.geometry, shape[0], after) + " alone the teeth ";
    if (const OneWay way = one_way_of_wave(told); way.sign != 0) {
      return teeth +
             (shape[3] != 0.0 ? "stand aside, " + turned(way.sign)
                              : std::string(way.sign > 0 ? "stand out" : "lie back")) +
             printed(", most about tooth %d, in half a wave", way.tooth);
    }
    return teeth + "stand " + (shape[3] != 0.0 ? "ahead and behind" : "high and low") +
           printed(" in waves of %.3g a turn, %.1f teeth long", shape[2],
                   told.geometry.teeth() / shape[2]);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
