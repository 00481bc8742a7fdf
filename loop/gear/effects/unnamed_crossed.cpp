// SPDX-License-Identifier: GPL-3.0-or-later
// A course over the profile times one over the face; the same on every tooth, or most on the teeth
// towards one direction.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/sign_words.h"
#include "trueflank/loop/gear/effects/simple_courses.h"

namespace trueflank::loop::gear_effects {
namespace {

constexpr std::size_t kProfile = 0, kFace = FlankCourse::kValues,
                      kOpposite = 2 * FlankCourse::kValues, kAround = kOpposite + 1;

double on_a_flank(const FlankGeometry& g, const Place& p, const EffectShape& shape) {
  if (p.surface != Surface::kFlank) return 0.0;
  const double profile = FlankCourse::at(shape, kProfile).value(g, 0.0, p.roll_mm);
  return profile == 0.0 ? 0.0
                        : (shape[kOpposite] != 0.0 ? p.side : 1) * profile *
                              FlankCourse::at(shape, kFace).value(g, 1.0, p.z_mm);
}

/// One of the two by itself.
EffectFamily course_alone(double face) {
  EffectFamily f = described("course", {"course", "mm", "towards", "half_mm"});
  f.evaluate = [face](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank
               ? FlankCourse::at(shape, 0).value(g, face, face == 0.0 ? p.roll_mm : p.z_mm)
               : 0.0;
  };
  return f;
}

EffectFamily::ProductOfCourses of_two_courses() {
  static const EffectFamily profile = course_alone(0.0), face = course_alone(1.0);
  return {&profile, &face, FlankCourse::kValues};
}

bool has(const EffectShape& shape, std::size_t course) {
  return FlankCourse::at(shape, course).kind != FlankCourse::kWhole;
}

NeedsToBeSeen needs_of(const EffectShape& shape) {
  const bool profile = has(shape, kProfile), face = has(shape, kFace);
  return {.along_profile = profile, .along_face = face, .crossed = profile && face};
}

std::vector<EffectShape> courses_beside(const FlankGeometry& g, const EffectShape& shape) {
  std::vector<EffectShape> shapes;
  for (const auto& [first, face] : {std::pair(kProfile, 0.0), std::pair(kFace, 1.0)})
    for (const FlankCourse& course : FlankCourse::at(shape, first).beside(g, face)) {
      shapes.push_back(shape);
      course.put_in(shapes.back(), first);
    }
  return shapes;
}

/// What the courses do, and where: "the profile leans: more material at the tip, above a height of
/// 8 mm only".
std::string words_of_courses(const ToldForm& told, int sign) {
  const EffectShape& shape = told.shape;
  const bool opposite = shape[kOpposite] != 0.0;
  const FlankCourse profile = FlankCourse::at(shape, kProfile),
                    face = FlankCourse::at(shape, kFace);
  const bool leans = profile.kind == FlankCourse::kSlope, turns = face.kind == FlankCourse::kSlope;
  std::vector<std::string> where;
  if (!leans) where.push_back(profile.words(told.geometry, 0.0));
  if (!turns) where.push_back(face.words(told.geometry, 1.0));
  std::erase(where, "");
  std::string text = leans && turns ? "the flanks are twisted"
                     : leans        ? "the profile leans"
                     : turns        ? "the flanks slope over the face"
                                    : "";
  for (const std::string& words : where)
    text += (text.empty() ? "" : leans || turns ? " " : ", and that ") + words;
  if (opposite) text += ", opposite on the two flanks";
  const std::string at = leans && turns ? "at the tip's upper corner"
                         : leans        ? "at the tip"
                         : turns        ? "at the upper end"
                                        : "there";
  return text + there(at, sign, opposite);
}

std::vector<TermKey> keys_of_courses() {
  std::vector<TermKey> keys;
  for (const std::string along : {"profile", "face"}) {
    keys.push_back({along + "_course", TermKey::Kind::kWord, FlankCourse::kind_words()});
    keys.push_back(number(along + "_mm"));
    keys.push_back({along + "_towards"});
    keys.push_back(number(along + "_half_mm"));
  }
  keys.push_back({"flanks", TermKey::Kind::kWord, {"equal", "opposite"}});
  return keys;
}

const std::vector<std::string> kCourseNames{"profile_course",  "profile_mm",   "profile_towards",
                                            "profile_half_mm", "face_course",  "face_mm",
                                            "face_towards",    "face_half_mm", "opposite_flanks"};

int sought_along(const EffectShape& shape) {
  return FlankCourse::at(shape, kProfile).values_sought() +
         FlankCourse::at(shape, kFace).values_sought();
}

}  // namespace

/// A corner at the tip of both ends, a lean above a height, a hollow that ends along the face. Told
/// in place of slopes, bows, twists and waves across the flanks that follow it
/// (products.cpp), and no candidate of its own.
EffectFamily unnamed_crossed() {
  EffectFamily f = described("unnamed_crossed", kCourseNames);
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = on_a_flank(g, p, shape);
  };
  f.product_of_courses = of_two_courses();
  f.same_on_every_tooth = [](const EffectShape&) { return true; };
  f.needs = needs_of;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = courses_beside;
  f.values_sought = sought_along;
  f.term_keys = keys_of_courses();
  f.words = [](const ToldForm& told) {
    return "the same on every tooth, " + words_of_courses(told, told.sign());
  };
  return f;
}

bool is_product_of_polynomials(const FlankGeometry& g, const Effect& form) {
  return form.family == find_family("unnamed_crossed") &&
         FlankCourse::at(form.shape, kProfile).is_of_free_form(g, 0.0) &&
         FlankCourse::at(form.shape, kFace).is_of_free_form(g, 1.0);
}

/// Resin or oil that gathers on the lower side, a tool that wears at its tip from tooth to tooth.
/// Told in place of forms of some teeth, and once or more often per turn, that follow it
/// (products.cpp), and no candidate of its own.
EffectFamily unnamed_crossed_around() {
  EffectFamily f = described("unnamed_crossed_around", kCourseNames);
  for (const char* name : {"around", "towards_deg", "half_deg"}) f.shape_names.emplace_back(name);
  f.one_flank_too = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factor) {
                    factor[0] = AroundCourse::at(shape, kAround).value(g, tooth);
                  },
                  on_a_flank});
  f.product_of_courses = of_two_courses();
  f.needs = needs_of;
  f.faces_a_direction = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape& shape) { return has(shape, kFace); };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = courses_beside(g, shape);
    for (const AroundCourse& around : AroundCourse::at(shape, kAround).beside(g)) {
      shapes.push_back(shape);
      around.put_in(shapes.back(), kAround);
    }
    // (what the free form has is told by that)
    std::erase_if(shapes, [&](const EffectShape& beside) {
      return FlankCourse::at(beside, kProfile).is_of_free_form(g, 0.0) &&
             FlankCourse::at(beside, kFace).is_of_free_form(g, 1.0) &&
             AroundCourse::at(beside, kAround).is_of_free_form();
    });
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    return sought_along(shape) + AroundCourse::at(shape, kAround).values_sought();
  };
  f.term_keys = keys_of_courses();
  f.term_keys.push_back({"around", TermKey::Kind::kWord, AroundCourse::kind_words()});
  f.term_keys.push_back(number("towards_deg"));
  f.term_keys.push_back(number("half_deg"));
  f.words = [](const ToldForm& told) {
    return AroundCourse::at(told.shape, kAround).words(told.geometry) + ", " +
           words_of_courses(told, told.sign());
  };
  return f;
}

bool is_of_a_comb(const Effect& form) {
  return form.family == find_family("unnamed_crossed_around") &&
         AroundCourse::at(form.shape, kAround).kind == AroundCourse::kComb;
}

Effect as_plain_comb(const FlankGeometry& g, const Effect& form) {
  if (!is_of_a_comb(form)) return form;
  const FlankCourse profile = FlankCourse::at(form.shape, kProfile),
                    face = FlankCourse::at(form.shape, kFace);
  const auto degree = [](const FlankCourse& course) {
    return course.kind == FlankCourse::kSlope ? 1.0 : course.kind == FlankCourse::kBow ? 2.0 : 0.0;
  };
  if (!profile.is_polynomial() || !face.is_polynomial()) return form;
  const auto [every, first] = AroundCourse::at(form.shape, kAround).teeth_of_comb(g);
  return {find_family("unnamed_comb"),
          form.flank,
          {double(every), double(first), degree(profile), degree(face), form.shape[kOpposite]}};
}

/// A wave of an order around the gear that is there, or larger, along a part of the flanks: work
/// that three jaws grip at one end. Told in place of what runs along the flanks in waves of that
/// order (products.cpp), and no candidate of its own.
EffectFamily unnamed_crossed_order() {
  constexpr std::size_t kOrder = kOpposite + 1;
  EffectFamily f = described("unnamed_crossed_order", kCourseNames);
  f.shape_names.emplace_back("order");
  f.columns = [](const EffectShape&) { return 2; };
  f.one_flank_too = true;
  set_columns(f, {[](const FlankGeometry& g, int tooth, const EffectShape& shape, double* factors) {
                    const double angle = shape[kOrder] * g.centre_rad(tooth);
                    factors[0] = std::cos(angle);
                    factors[1] = std::sin(angle);
                  },
                  on_a_flank});
  f.product_of_courses = of_two_courses();
  f.order = [](const EffectShape& shape) { return shape[kOrder]; };
  f.needs = needs_of;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape& shape) { return has(shape, kFace); };
  f.nearby = courses_beside;
  f.values_sought = sought_along;
  f.term_keys = keys_of_courses();
  f.term_keys.push_back({"order"});
  f.words = [](const ToldForm& told) {
    const double direction_rad = told.direction_rad();
    const std::string text = times_per_turn(told.shape[kOrder]) + ", " +
                             words_of_courses(told, std::isnan(direction_rad) ? 0 : 1);
    return std::isnan(direction_rad)
               ? text
               : text + ", most" + first_at(direction_rad, told.shape[kOrder]).substr(1);
  };
  return f;
}

/// Waves over the profile (0) or the face (1), weighed by a course in the other direction, by one
/// around the gear, or both: chatter that grows with the height, or of the teeth of one side. Told
/// in place of waves and of what else follows them (products.cpp), and no candidate of
/// its own.
EffectFamily unnamed_crossed_waves() {
  constexpr std::size_t kOther = 2, kWhere = kOther + FlankCourse::kValues;
  EffectFamily f =
      described("unnamed_crossed_waves",
                {"along", "wavelength_mm", "across_course", "across_mm", "across_towards",
                 "across_half_mm", "around", "towards_deg", "half_deg"});
  f.columns = [](const EffectShape&) { return 2; };
  f.one_flank_too = true;
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = c[1] = 0.0;
    if (p.surface != Surface::kFlank) return;
    const double other = shape[0] != 0.0 ? 0.0 : 1.0;
    const double size = FlankCourse::at(shape, kOther).value(g, other, along(other, p)) *
                        AroundCourse::at(shape, kWhere).value(g, p.tooth);
    if (size == 0.0) return;
    const double angle = kTwoPi * along(shape[0], p) / shape[1];
    c[0] = size * std::cos(angle);
    c[1] = size * std::sin(angle);
  };
  f.same_on_every_tooth = [](const EffectShape& shape) {
    return AroundCourse::at(shape, kWhere).kind == AroundCourse::kEvery;
  };
  f.needs = [](const EffectShape& shape) {
    const bool crossed = has(shape, kOther);
    return NeedsToBeSeen{.along_profile = shape[0] == 0.0 || crossed,
                         .along_face = shape[0] != 0.0 || crossed,
                         .crossed = crossed};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    for (const double times : {0.97, 0.99, 0.997, 1.003, 1.01, 1.03}) {
      shapes.push_back(shape);
      shapes.back()[1] *= times;
    }
    for (const FlankCourse& course :
         FlankCourse::at(shape, kOther).beside(g, shape[0] != 0.0 ? 0.0 : 1.0)) {
      shapes.push_back(shape);
      course.put_in(shapes.back(), kOther);
    }
    for (const AroundCourse& around : AroundCourse::at(shape, kWhere).beside(g)) {
      shapes.push_back(shape);
      around.put_in(shapes.back(), kWhere);
    }
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    return 1 + FlankCourse::at(shape, kOther).values_sought() +
           AroundCourse::at(shape, kWhere).values_sought();
  };
  f.term_keys = {kAlong,
                 number("wavelength_mm"),
                 {"across_course", TermKey::Kind::kWord, FlankCourse::kind_words()},
                 number("across_mm"),
                 {"across_towards"},
                 number("across_half_mm"),
                 {"around", TermKey::Kind::kWord, AroundCourse::kind_words()},
                 number("towards_deg"),
                 number("half_deg")};
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const std::string where =
        FlankCourse::at(shape, kOther).words(told.geometry, shape[0] != 0.0 ? 0.0 : 1.0);
    return AroundCourse::at(shape, kWhere).words(told.geometry) + ", " +
           waves_over(told.geometry, shape[0], shape[1]) + (where.empty() ? "" : ", " + where);
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
