// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of the body that carries the teeth: by the direction and the height at which a point lies,
// not by its tooth. What hardens, clamps, gates and ejectors do.
#include <algorithm>
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

/// Where courses stand among the shape values.
constexpr std::size_t kFaceOfWave = 2, kTurnOfWave = kFaceOfWave + FlankCourse::kValues,
                      kProfileOfPlace = 4, kFaceOfPlace = kProfileOfPlace + FlankCourse::kValues,
                      kEndsOfPlace = kFaceOfPlace + FlankCourse::kValues, kFaceOfFacing = 2;

/// No gate is as wide, to either side.
constexpr double kWide_deg = 40.0;

/// A place around the gear that ends: the square of a cosine about its middle, e^-1 of it at the
/// half width as of a bell.
double bell_that_ends(double off, double half) {
  constexpr double kAtHalf = 0.9191;  // acos(exp(-1/2))
  const double phase = kAtHalf * off / half;
  return std::abs(phase) < 0.5 * kPi ? std::cos(phase) * std::cos(phase) : 0.0;
}

/// A cosine up to where it is nothing, e^-1 of it at the half width: a ring between jaws that
/// arches, with cusps where one arch ends and the next begins.
double arch_that_ends(double off, double half) {
  constexpr double kAtHalf = 1.1941;  // acos(exp(-1))
  const double phase = kAtHalf * off / half;
  return std::abs(phase) < 0.5 * kPi ? std::cos(phase) : 0.0;
}

/// How a place around the gear dies away to either side.
enum EndsOfPlace { kAsABell, kAsASquaredCosine, kAsAnArch };
double dying_away(double off, double half, double ends) {
  if (ends == kAsABell) return bell(off, half);
  return ends == kAsASquaredCosine ? bell_that_ends(off, half) : arch_that_ends(off, half);
}

/// What a displacement outwards is worth along the normal.
double worth_of_radius(const FlankGeometry& g, const Place& p) {
  return normal_part(g, p, p.polar_direction[0], p.polar_direction[1]);
}

/// How a wave of the body moves its points.
enum BodyMoves { kAlongNormal, kOutwards, kAlongAxis, kOutwardsWithLands };

/// So many bells, or what `ends` 1, about directions that are evenly spaced: 1 in the middle of
/// one.
double bells_towards(const Place& p, double number, double at_deg, double half_deg, double ends) {
  constexpr double kNothing = 6.0;  // half widths
  const double half = rad_from_deg(half_deg), apart = kTwoPi / number;
  const double off = off_around(p.polar_rad - rad_from_deg(at_deg), apart);
  double size = 0.0;
  for (const double next : {-apart, 0.0, apart})  // (one place: once)
    if (std::abs(off + next) < std::min(kNothing * half, kPi + half))
      size += dying_away(off + next, half, ends);
  return size;
}

double of_both_courses(const FlankGeometry& g, const Place& p, const EffectShape& shape,
                       std::size_t profile, std::size_t face) {
  return FlankCourse::at(shape, profile).value(g, 0.0, p.roll_mm) *
         FlankCourse::at(shape, face).value(g, 1.0, p.z_mm);
}

/// What a place of the body is the product of: bells around the gear, courses over the flank, what
/// a radius is worth.
struct PartsOfPlace {
  EffectFamily around = described("part_around", {"number", "at_deg", "half_deg", "ends"});
  EffectFamily along = described("part_along_flank", {});
  EffectFamily radius = described("part_of_radius", {});

  PartsOfPlace() {
    around.evaluate = [](const FlankGeometry&, const Place& p, const EffectShape& s, double* c) {
      c[0] = p.surface == Surface::kFlank ? bells_towards(p, s[0], s[1], s[2], s[3]) : 0.0;
    };
    along.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& s, double* c) {
      c[0] = p.surface == Surface::kFlank ? of_both_courses(g, p, s, 0, FlankCourse::kValues) : 0.0;
    };
    along.same_on_every_tooth = [](const EffectShape&) { return true; };
    radius.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape&, double* c) {
      c[0] = p.surface == Surface::kFlank ? worth_of_radius(g, p) : 0.0;
    };
  }
};

bool has_course(const EffectShape& shape, std::size_t first) {
  return FlankCourse::at(shape, first).kind != FlankCourse::kWhole;
}

void put_courses_beside(const FlankGeometry& g, const EffectShape& shape, std::size_t first,
                        double face, std::vector<EffectShape>& shapes) {
  for (const FlankCourse& course : FlankCourse::at(shape, first).beside(g, face)) {
    shapes.push_back(shape);
    course.put_in(shapes.back(), first);
  }
}

void add_keys_of_course(const std::string& along, EffectFamily& f) {
  f.term_keys.push_back({along + "_course", TermKey::Kind::kWord, FlankCourse::kind_words()});
  f.term_keys.push_back(number(along + "_mm"));
  f.term_keys.push_back({along + "_towards"});
  f.term_keys.push_back(number(along + "_half_mm"));
}

}  // namespace

/// A body that is out of round by so many waves a turn, along a part of its height or all of it, or
/// wider there (none): outwards (`radial` 1: the flanks; 3: tips and roots, too), all walls along
/// their normals (0), or (2) around the
/// gear, as sections of a helical ring that is bent like a saddle are. Oval at one end from
/// hardening, three lobes where jaws grip, a swelling over a press fit, walls that a light made
/// thicker on one side. The amplitudes are of the radius or along the normal, where the course is
/// most. Told in place of what goes around the gear in waves of that order, or over the face
/// (part/body/body_forms.cpp), and no candidate of its own.
EffectFamily unnamed_body_wave() {
  EffectFamily f = described("unnamed_body_wave", {"order", "radial", "face_course", "face_mm",
                                                   "face_towards", "face_half_mm", "turns_deg"});
  f.columns = [](const EffectShape& shape) { return shape[0] == 0.0 ? 1 : 2; };
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    const bool with_lands = shape[1] == double(kOutwardsWithLands);
    const bool is_moved =
        p.surface == Surface::kFlank ||
        (with_lands && (p.surface == Surface::kTip || p.surface == Surface::kRoot));
    const double worth = !is_moved                                     ? 0.0
                         : shape[1] == double(kAlongNormal)            ? 1.0
                         : shape[1] == double(kOutwards) || with_lands ? worth_of_radius(g, p)
                                                                       : g.normal_z(p);
    const double size =
        is_moved ? worth * FlankCourse::at(shape, kFaceOfWave).value(g, 1.0, p.z_mm) : 0.0;
    double angle = shape[0] * p.polar_rad;
    if (shape[kTurnOfWave] != 0.0)
      angle -= shape[0] * rad_from_deg(shape[kTurnOfWave]) * p.z_mm / g.face_width_mm();
    c[0] = size * std::cos(angle);
    if (shape[0] != 0.0) c[1] = size * std::sin(angle);
  };
  f.order = first_value;
  f.faces_a_direction = true;
  f.needs = [](const EffectShape& shape) {
    const bool face = has_course(shape, kFaceOfWave) || shape[kTurnOfWave] != 0.0;
    return NeedsToBeSeen{.along_face = face, .several_heights = face};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape& shape) {
    return has_course(shape, kFaceOfWave) || shape[kTurnOfWave] != 0.0;
  };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes;
    put_courses_beside(g, shape, kFaceOfWave, 1.0, shapes);
    if (shape[kTurnOfWave] != 0.0)
      for (const double off : {-15.0, -5.0, -1.5, -0.5, 0.5, 1.5, 5.0, 15.0})
        if (shape[kTurnOfWave] != -off / shape[0]) {
          shapes.push_back(shape);
          shapes.back()[kTurnOfWave] += off / shape[0];
        }
    // (a body goes over from one width to another more softly than a flank)
    constexpr double kSoftest = 0.2;  // of the face
    const FlankCourse course = FlankCourse::at(shape, kFaceOfWave);
    if (course.kind == FlankCourse::kStep && course.half_mm > 0.0)
      for (const double times : {0.7, 0.9, 0.97, 1.03, 1.1, 1.4}) {
        shapes.push_back(shape);
        FlankCourse beside = course;
        beside.half_mm = std::min(times * course.half_mm, kSoftest * g.face_width_mm());
        beside.put_in(shapes.back(), kFaceOfWave);
      }
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    return FlankCourse::at(shape, kFaceOfWave).values_sought() +
           (shape[kTurnOfWave] != 0.0 ? 1 : 0);
  };
  f.term_keys = {{"order"},
                 {"moved",
                  TermKey::Kind::kWord,
                  {"along_normal", "outwards", "along_axis", "outwards_with_tips_and_roots"}}};
  add_keys_of_course("face", f);
  f.term_keys.push_back(number("turns_deg"));
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const double direction_rad = told.direction_rad();
    std::string where = FlankCourse::at(shape, kFaceOfWave).words(told.geometry, 1.0);
    if (!where.empty()) where = ", " + where;
    const double turns_deg = shape[kTurnOfWave];
    const std::string turning =
        turns_deg == 0.0
            ? ""
            : printed(" at the lower end, and turning with the height, %.3g deg ",
                      std::abs(turns_deg)) +
                  (turns_deg > 0.0 ? "counter-clockwise" : "clockwise") + " over the face";
    if (shape[0] == 0.0) {
      const int sign = told.sign();
      const std::string what = sign == 0 ? "wider or narrower" : sign > 0 ? "wider" : "narrower";
      return "the body is " + what + where +
             (sign == 0 ? "" : printed(", by %.3g um of radius", std::abs(told.amounts[0]))) +
             (shape[1] == double(kOutwardsWithLands) ? ", flanks, tips and roots alike" : "") +
             ", as over a press fit or a core";
    }
    if (shape[1] == double(kAlongAxis))
      return "points are moved along the axis by their direction, " + times_per_turn(shape[0]) +
             where +
             (std::isnan(direction_rad) ? ""
                                        : printed(", by %.3g um at most, upwards",
                                                  std::hypot(told.amounts[0], told.amounts[1])) +
                                              first_at(direction_rad, shape[0])) +
             ", as of a ring that is bent like a saddle";
    std::string text =
        shape[1] == 0.0 ? "the walls stand out and lie back by the side of the gear they stand on, "
                        : "the gear is out of round ";
    text += times_per_turn(shape[0]) + where;
    if (!std::isnan(direction_rad))
      text += (shape[1] == 0.0 ? ", most"
                               : printed(", by %.3g um of radius at most",
                                         std::hypot(told.amounts[0], told.amounts[1]))) +
              first_at(direction_rad, shape[0]).substr(shape[1] == 0.0 ? 1 : 0);
    text += turning;
    return text + (shape[1] == 0.0 ? ", as from a light, a bath or a mould that differs by side"
                                   : ", as from what grips one end, or from hardening");
  };
  return f;
}

/// Walls that face a direction stand out along a part of the height, more and more towards an end
/// or all over, those that face away do not: a fan, a light or a nozzle of one side. Told in place
/// of tilts, tapers, offsets and waves around the gear that follow it (part/fields.cpp), and no
/// candidate of its own.
EffectFamily unnamed_body_facing() {
  EffectFamily f = described("unnamed_body_facing", {"towards_deg", "power", "face_course",
                                                     "face_mm", "face_towards", "face_half_mm"});
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = p.surface == Surface::kFlank
               ? faces(p, shape[0], shape[1]) *
                     FlankCourse::at(shape, kFaceOfFacing).value(g, 1.0, p.z_mm)
               : 0.0;
  };
  f.faces_a_direction = true;
  f.needs = [](const EffectShape&) {
    return NeedsToBeSeen{.along_face = true, .several_heights = true};
  };
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape&) { return true; };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    std::vector<EffectShape> shapes = facings_beside(shape);
    put_courses_beside(g, shape, kFaceOfFacing, 1.0, shapes);
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    return 1 + FlankCourse::at(shape, kFaceOfFacing).values_sought();
  };
  f.term_keys = {number("towards_deg"), {"power"}};
  add_keys_of_course("face", f);
  f.words = [](const ToldForm& told) {
    const std::string where = FlankCourse::at(told.shape, kFaceOfFacing).words(told.geometry, 1.0);
    return "walls that face " + gear_effects::towards(told.shape[0]) + " " + stand(told.sign()) +
           (where.empty() ? "" : ", " + where) +
           ", those that face away do not, as from a fan, a light or a jet of one side";
  };
  return f;
}

/// A place of the body that stands out or lies back: by the direction in which a point lies, along
/// the normal or, `radial` 1, outwards; all over profile and face or along a part of them; a bell
/// around the gear or, `ends` 1, a squared cosine, as what sags on one side, or, `ends` 2, an arch,
/// as a ring between jaws. A sink beside a gate, the mark of an ejector, a press fit over a keyway.
/// Told in place of forms of some teeth that lie side by side (part/body/body_forms.cpp), and no
/// candidate of its own.
EffectFamily unnamed_body_place() {
  EffectFamily f = described("unnamed_body_place", {"number", "radial", "at_deg", "half_deg"});
  for (const std::string along : {"profile", "face"})
    for (const char* value : {"_course", "_mm", "_towards", "_half_mm"})
      f.shape_names.push_back(along + value);
  f.shape_names.emplace_back("ends");
  f.evaluate = [](const FlankGeometry& g, const Place& p, const EffectShape& shape, double* c) {
    c[0] = 0.0;
    if (p.surface != Surface::kFlank) return;
    double size = bells_towards(p, shape[0], shape[2], shape[3], shape[kEndsOfPlace]);
    if (size == 0.0) return;
    size *= of_both_courses(g, p, shape, kProfileOfPlace, kFaceOfPlace);
    c[0] = shape[1] == 0.0 ? size : size * worth_of_radius(g, p);
  };
  f.parts = [](const EffectShape& shape) {
    static const PartsOfPlace families;
    std::vector<Effect> parts{{&families.around,
                               FlankChoice::kBoth,
                               {shape[0], shape[2], shape[3], shape[kEndsOfPlace]}}};
    if (has_course(shape, kProfileOfPlace) || has_course(shape, kFaceOfPlace))
      parts.push_back({&families.along,
                       FlankChoice::kBoth,
                       {shape.begin() + std::ptrdiff_t{kProfileOfPlace},
                        shape.begin() + std::ptrdiff_t{kEndsOfPlace}}});
    if (shape[1] != 0.0) parts.push_back({&families.radius, FlankChoice::kBoth, {}});
    return parts;
  };
  f.needs = [](const EffectShape& shape) {
    const bool profile = has_course(shape, kProfileOfPlace), face = has_course(shape, kFaceOfPlace);
    return NeedsToBeSeen{.along_profile = profile,
                         .along_face = face,
                         .several_heights = face,
                         .crossed = profile && face};
  };
  f.faces_a_direction = true;
  f.is_followed_nearly = true;
  f.is_fine = [](const FlankGeometry&, const EffectShape&) { return true; };
  f.bends_over_the_face = [](const EffectShape& shape) { return has_course(shape, kFaceOfPlace); };
  f.nearby = [](const FlankGeometry& g, const EffectShape& shape) {
    constexpr double kWidest_deg = 75.0, kHalfOfWholeArch = 1.1941 / kPi;
    const double narrowest_deg = 90.0 / g.teeth();
    std::vector<EffectShape> shapes;
    for (const double off : {-0.5, -0.15, -0.04, 0.0, 0.04, 0.15, 0.5})
      for (const double times : {0.8, 0.93, 0.98, 1.0, 1.02, 1.07, 1.25}) {
        EffectShape beside = shape;
        beside[2] += off * shape[3];
        beside[3] = std::clamp(times * shape[3], narrowest_deg,
                               std::min(kWidest_deg, 0.4 * 360.0 / shape[0]));
        if (beside != shape) shapes.push_back(std::move(beside));
      }
    shapes.push_back(shape);
    shapes.back()[1] = 1.0 - shape[1];
    for (const EndsOfPlace ends : {kAsABell, kAsASquaredCosine, kAsAnArch}) {
      if (shape[kEndsOfPlace] == ends) continue;
      shapes.push_back(shape);
      shapes.back()[kEndsOfPlace] = ends;
    }
    // (arches from one jaw to the next)
    if (shape[0] > 1.0) {
      shapes.push_back(shape);
      shapes.back()[kEndsOfPlace] = kAsAnArch;
      shapes.back()[3] = kHalfOfWholeArch * 360.0 / shape[0];
    }
    put_courses_beside(g, shape, kProfileOfPlace, 0.0, shapes);
    put_courses_beside(g, shape, kFaceOfPlace, 1.0, shapes);
    return shapes;
  };
  f.values_sought = [](const EffectShape& shape) {
    constexpr int kPlaceAndWidth = 2;
    return kPlaceAndWidth + FlankCourse::at(shape, kProfileOfPlace).values_sought() +
           FlankCourse::at(shape, kFaceOfPlace).values_sought();
  };
  f.term_keys = {{"number"},
                 {"moved", TermKey::Kind::kWord, {"along_normal", "outwards"}},
                 number("at_deg"),
                 number("half_deg")};
  add_keys_of_course("profile", f);
  add_keys_of_course("face", f);
  f.term_keys.push_back(
      {"dies_away", TermKey::Kind::kWord, {"as_a_bell", "as_a_squared_cosine", "as_an_arch"}});
  f.words = [](const ToldForm& told) {
    const EffectShape& shape = told.shape;
    const int sign = told.sign();
    const double apart_deg = 360.0 / shape[0],
                 at_deg = std::fmod(std::fmod(shape[2], apart_deg) + apart_deg, apart_deg);
    // A ring that is pushed outwards has flanks that lie back.
    const bool of_a_ring = shape[1] != 0.0 && told.geometry.sense() < 0.0;
    const bool one = shape[0] == 1.0;
    std::string text;
    if (of_a_ring)
      text = (one ? "a place" : printed("%.0f places evenly spaced around the gear", shape[0])) +
             std::string(" where the ring is pushed ") +
             (sign == 0  ? "inwards or outwards"
              : sign > 0 ? "outwards"
                         : "inwards");
    else
      text = one ? a_swelling(sign) + " of the body"
                 : printed("%.0f ", shape[0]) +
                       (sign > 0   ? "swellings"
                        : sign < 0 ? "hollows"
                                   : "swellings or hollows") +
                       " of the body evenly spaced around the gear";
    text += std::string(one ? "" : ", one") + printed(" towards %.0f deg", at_deg) +
            printed(", %.2g deg to either side", shape[3]);
    for (const auto& [first, face] :
         {std::pair(kProfileOfPlace, 0.0), std::pair(kFaceOfPlace, 1.0)})
      if (const std::string where = FlankCourse::at(shape, first).words(told.geometry, face);
          !where.empty())
        text += ", " + where;
    if (shape[1] != 0.0 && sign != 0)
      text += printed(", by %.3g um of radius", std::abs(told.amounts[0]));
    return text + ": there the teeth " +
           (sign == 0 ? "stand out or lie back" : stand(of_a_ring ? -sign : sign)) +
           " on both flanks, as from " +
           (shape[kEndsOfPlace] == kAsAnArch && !one
                ? "a thin ring that arches between the jaws of a chuck"
            : shape[3] > kWide_deg ? "a body that sags, warps or is held on one side"
                                   : "a gate, an ejector or a clamp");
  };
  return f;
}

}  // namespace trueflank::loop::gear_effects
