// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/simple_courses.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/along_flank.h"
#include "trueflank/loop/gear/effects/columns.h"

namespace trueflank::loop::gear_effects {
namespace {

// Shares of the profile or the face: a course that begins or ends nearer to an end, or is narrower,
// is none of its kind.
constexpr double kNearestEnd = 0.04, kNearestStep = 0.08, kNarrowest = 0.03, kWidest = 0.4,
                 kShortest = 0.02, kLongest = 0.6, kLongestOfBoth = 0.2;

/// Half of a sector: of more teeth it is what the others do not have.
constexpr double kWidestSector_deg = 150.0;

}  // namespace

void FlankCourse::put_in(EffectShape& shape, std::size_t first) const {
  shape[first] = static_cast<double>(kind);
  shape[first + 1] = mm;
  shape[first + 2] = towards;
  shape[first + 3] = half_mm;
}

double FlankCourse::value(const FlankGeometry& g, double face, double at_mm) const {
  const double low = end_mm(g, face, -1.0), high = end_mm(g, face, 1.0);
  const double across = (2.0 * at_mm - low - high) / (high - low);
  const double end = towards > 0.0 ? high : low;
  const auto beyond = [&] {  // of the way from its place to the end
    const double from = stands_at(g, face, mm);
    return end != from ? std::max(0.0, (at_mm - from) / (end - from)) : 0.0;
  };
  const auto dies = [&](double from) { return std::exp(-std::abs(at_mm - from) / mm); };
  switch (kind) {
    case kWhole:
      return 1.0;
    case kSlope:
      return across;
    case kStep: {
      const double off = (at_mm - stands_at(g, face, mm)) * (high > low ? towards : -towards);
      return beyond_edge(off, 2.0 * half_mm);
    }
    case kKink:
      return beyond();
    case kBend:
      return beyond() * beyond();
    case kRise:
      return towards != 0.0 ? dies(end) : dies(low) + dies(high);
    case kBand:
      return bell(at_mm - stands_at(g, face, mm), half_mm);
    case kBow:
      return across * across;
    case kVee: {
      const double from = stands_at(g, face, mm);
      return std::abs(at_mm - from) / std::max(std::abs(high - from), std::abs(low - from));
    }
    case kSwells:
      return 0.5 * (1.0 + std::cos(kPi * (at_mm - stands_at(g, face, mm)) / half_mm));
  }
  return 0.0;
}

bool FlankCourse::is_of_free_form(const FlankGeometry& g, double face) const {
  constexpr double kNearlyAll = 0.35, kLong = 0.25, kLongOfBoth = 0.12, kWide = 0.25,
                   kLongSwell = 0.4;
  const double range = std::abs(range_mm(g, face));
  switch (kind) {
    case kWhole:
    case kSlope:
    case kBow:
      return true;
    case kKink:
    case kBend: {
      const double share = share_at(g, face, mm);
      return (towards > 0.0 ? share : 1.0 - share) < kNearlyAll;
    }
    case kRise:
      return mm > (towards != 0.0 ? kLong : kLongOfBoth) * range;
    case kBand:
      return half_mm > kWide * range;
    case kSwells:
      return half_mm > kLongSwell * range;
    case kStep:
    case kVee:
      return false;
  }
  return false;
}

int FlankCourse::values_sought() const {
  switch (kind) {
    case kWhole:
    case kSlope:
    case kBow:
      return 0;
    case kBand:
    case kSwells:
      return 2;
    case kStep:
      return half_mm > 0.0 ? 2 : 1;
    default:
      return 1;
  }
}

namespace {

/// False of what begins or ends so near to an end, or is so narrow or long, that it is another
/// form.
bool is_of_its_kind(const FlankGeometry& g, double face, const FlankCourse& course) {
  constexpr double kRounding = 1e-9;
  const double range = std::abs(range_mm(g, face));
  const auto between = [](double value, double least, double most) {
    return value >= least - kRounding && value <= most + kRounding;
  };
  if (course.kind == FlankCourse::kRise)
    return between(course.mm / range, kShortest, course.towards != 0.0 ? kLongest : kLongestOfBoth);
  const double share = share_at(g, face, course.mm);
  if (course.kind == FlankCourse::kSwells)
    return between(share, 0.0, 1.0) && between(course.half_mm / range, kNarrowest, kWidest);
  if (course.kind == FlankCourse::kStep || course.kind == FlankCourse::kVee)
    return between(share, kNearestStep, 1.0 - kNearestStep);
  if (course.kind == FlankCourse::kBand)
    return between(share, 0.0, 1.0) && between(course.half_mm / range, kNarrowest, kWidest);
  return course.towards > 0.0 ? between(share, 0.0, 1.0 - kNearestEnd)
                              : between(share, kNearestEnd, 1.0);
}

}  // namespace

std::vector<FlankCourse> FlankCourse::beside(const FlankGeometry& g, double face) const {
  const double range = std::abs(range_mm(g, face));
  std::vector<FlankCourse> courses;
  const auto add = [&](const FlankCourse& course) {
    if (is_of_its_kind(g, face, course)) courses.push_back(course);
  };
  const Kind own = kind;
  if (own == kWhole || own == kSlope || own == kBow) return courses;
  if (own == kRise) {
    for (const double times : {0.7, 0.85, 0.95, 0.99, 1.01, 1.05, 1.18, 1.43})
      add({kind, times * mm, towards});
    if (towards != 0.0) {
      const double length = std::min(0.9, 2.0 * mm / range);
      const double place = place_at(g, face, towards > 0.0 ? 1.0 - length : length);
      add({kKink, place, towards});
      add({kBend, place, towards});
    }
    return courses;
  }
  const double share = share_at(g, face, mm);
  if (own == kSwells) {
    for (const double off : {0.3, 0.1, 0.03, 0.01})
      for (const double sign : {-1.0, 1.0}) {
        const double moved = std::clamp(share + sign * off * half_mm / range, 0.0, 1.0);
        add({kind, place_at(g, face, moved), towards, half_mm});
        add({kind, mm, towards, (1.0 + 0.3 * sign * off) * half_mm});
      }
    return courses;
  }
  for (const double off : {0.05, 0.02, 0.01, 0.005, 0.002, 0.0007})
    for (const double sign : {-1.0, 1.0}) {
      const double moved = std::clamp(share + sign * off, 0.0, 1.0);
      add({kind, place_at(g, face, moved), towards, half_mm});
    }
  if (own == kStep) {
    constexpr double kSharpest = 0.005, kSoftest = 0.05;
    for (const double half :
         {0.0, 0.5 * half_mm, 0.7 * half_mm, 1.4 * half_mm, 2.0 * half_mm, 0.01 * range})
      if (half != half_mm &&
          (half == 0.0 || (half >= kSharpest * range && half <= kSoftest * range)))
        add({kind, mm, towards, half});
  }
  if (own == kBand)
    for (const double times : {0.7, 0.88, 0.96, 1.04, 1.14, 1.43})
      add({kind, mm, towards, times * half_mm});
  if (own == kKink || own == kBend) {
    add({own == kKink ? kBend : kKink, mm, towards});
    const double length = towards > 0.0 ? 1.0 - share : share;
    for (const double times : {0.3, 0.5}) add({kRise, times * length * range, towards});
    // (the farther off it begins, the nearer to a square)
    for (const double longer : {0.7, 1.4}) {
      const double from =
          std::clamp(towards > 0.0 ? 1.0 - longer * length : longer * length, 0.0, 1.0);
      add({own == kKink ? kBend : kKink, place_at(g, face, from), towards});
    }
  }
  return courses;
}

std::string FlankCourse::words(const FlankGeometry& g, double face) const {
  const Kind own = kind;
  const std::string where = own == kWhole || own == kSlope || own == kBow || own == kRise
                                ? ""
                                : words_of_place(g, face, mm);
  const std::string to = gear_effects::towards(face, towards);
  switch (own) {
    case kWhole:
    case kSlope:
      return "";
    case kStep:
      return (towards > 0.0 ? (face != 0.0 ? "above " : "beyond ")
                            : (face != 0.0 ? "below " : "below ")) +
             where + " only";
    case kKink:
      return "more and more evenly from " + where + " on" + to;
    case kBend:
      return "more and more by the square from " + where + " on" + to;
    case kRise: {
      const std::string ends = face != 0.0 ? (towards == 0.0  ? "both ends of the face"
                                              : towards > 0.0 ? "the upper end"
                                                              : "the lower end")
                                           : (towards == 0.0  ? "root and tip"
                                              : towards > 0.0 ? "the tip"
                                                              : "the root");
      return "dying away from " + ends + " " + within(g, face, mm, "within ", "");
    }
    case kBand:
      return "about " + where + ", " + within(g, face, half_mm, "", " to either side");
    case kSwells:
      return "coming and going, " + within(g, face, 2.0 * half_mm, "every ", ", most at ") + where;
    case kVee:
      return "more and more evenly from " + where + " on to both sides";
    case kBow:
      return std::string("more and more towards ") +
             (face != 0.0 ? "both ends of the face" : "root and tip");
  }
  return "";
}

std::vector<std::string> FlankCourse::kind_words() {
  return {"whole", "slope", "step", "kink", "bend", "rise", "band", "bow", "vee", "swells"};
}

void AroundCourse::put_in(EffectShape& shape, std::size_t first) const {
  shape[first] = static_cast<double>(kind);
  shape[first + 1] = towards_deg;
  shape[first + 2] = half_deg;
}

std::pair<int, int> AroundCourse::teeth_of_comb(const FlankGeometry& g) const {
  const double pitch_deg = 360.0 / g.teeth();
  const double off_deg = towards_deg - deg_from_rad(g.centre_rad(1));
  return {std::max(1, static_cast<int>(std::lround(2.0 * half_deg / pitch_deg))),
          static_cast<int>(std::lround(off_deg / pitch_deg)) + 1};
}

AroundCourse AroundCourse::comb(const FlankGeometry& g, int every, int first) {
  const double pitch_deg = 360.0 / g.teeth();
  return {kComb, deg_from_rad(g.centre_rad(1)) + (first - 1) * pitch_deg, 0.5 * every * pitch_deg};
}

AroundCourse AroundCourse::saw(const FlankGeometry& g, int every, int first) {
  AroundCourse course = comb(g, every, first);
  course.kind = kSaw;
  return course;
}

double AroundCourse::value(const FlankGeometry& g, int tooth) const {
  if (kind == kSaw) {
    const auto [every, first] = teeth_of_comb(g);
    return static_cast<double>(teeth_since(g, tooth, first) % every) / std::max(1, every - 1);
  }
  if (kind == kComb) {
    const auto [every, first] = teeth_of_comb(g);
    return (tooth - first) % every == 0 ? 1.0 : 0.0;
  }
  const double off = std::remainder(g.centre_rad(tooth) - rad_from_deg(towards_deg), kTwoPi);
  const double half = rad_from_deg(half_deg);
  switch (kind) {
    case kHalf:
      return std::max(0.0, std::cos(off));
    case kBell:
      return bell(off, half);
    case kSector:
      return std::abs(off) < half ? 1.0 : 0.0;
    case kRamp:
    case kFade: {
      constexpr double kRounding = 1e-9;
      const double from = off < -kRounding ? off + kTwoPi : std::max(0.0, off),
                   share = from / (kTwoPi - kTwoPi / g.teeth());
      return kind == kRamp ? share : 1.0 - share;
    }
    case kWave:
      return std::cos(kPi * off / half);
    case kComesAndGoes:
      return 0.5 * (1.0 + std::cos(kPi * off / half));
    case kEvery:
    case kComb:
    case kSaw:
      break;
  }
  return 1.0;
}

std::vector<AroundCourse> AroundCourse::beside(const FlankGeometry& g) const {
  if (kind == kEvery || kind == kComb) return {};
  constexpr double kNarrowest_deg = 15.0, kWidest_deg = 100.0;
  const double pitch_deg = 360.0 / g.teeth();
  std::vector<AroundCourse> courses;
  if (kind == kSaw) {
    const auto [every, first] = teeth_of_comb(g);
    for (const int off : {-1, 1}) courses.push_back(saw(g, every, first + off));
    return courses;
  }
  const auto add = [&](const AroundCourse& course) {
    if (course.kind == kBell && (course.half_deg < kNarrowest_deg || course.half_deg > kWidest_deg))
      return;
    // (of nearly all teeth, or of one, it is another form)
    if (course.kind == kSector &&
        (course.half_deg < pitch_deg || course.half_deg > kWidestSector_deg))
      return;
    courses.push_back(course);
  };
  const bool begins = kind == kRamp || kind == kFade;
  if (kind == kSector || begins) {
    for (const double teeth : {-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 4.0}) {
      if (begins && teeth != std::floor(teeth)) continue;
      add({kind, towards_deg + teeth * pitch_deg, half_deg});
      if (begins) continue;
      add({kind, towards_deg, half_deg + teeth * pitch_deg});
      for (const double sign : {-1.0, 1.0})
        add({kind, towards_deg + 0.5 * teeth * pitch_deg,
             half_deg + 0.5 * sign * teeth * pitch_deg});
    }
    return courses;
  }
  const bool wave = kind == kWave || kind == kComesAndGoes;
  const double scale = wave ? half_deg / 180.0 : 1.0;
  for (const double off : {-20.0, -7.0, -2.0, -0.7, 0.7, 2.0, 7.0, 20.0})
    add({kind, towards_deg + scale * off, half_deg});
  if (wave) return courses;
  if (kind == kBell) add({kHalf, towards_deg, 0.0});
  if (kind == kBell)
    for (const double times : {0.7, 0.85, 0.95, 1.05, 1.18, 1.43})
      add({kind, towards_deg, times * half_deg});
  else
    for (const double half : {50.0, 65.0, 80.0}) add({kBell, towards_deg, half});
  return courses;
}

std::string AroundCourse::words(const FlankGeometry& g) const {
  const double turned = std::fmod(std::fmod(towards_deg, 360.0) + 360.0, 360.0);
  const std::string towards = printed("towards %.0f deg", turned);
  switch (kind) {
    case kEvery:
      return "the same on every tooth";
    case kHalf:
      return "on the teeth " + towards +
             " and less and less to either side, none on the other half";
    case kBell:
      return "on the teeth " + towards +
             printed(", dying away over %.2g deg to either side", half_deg);
    case kSector: {
      int first = 0, count = 0;
      for (int tooth = 1; tooth <= g.teeth(); ++tooth) {
        if (value(g, tooth) == 0.0) continue;
        ++count;
        if (value(g, tooth == 1 ? g.teeth() : tooth - 1) == 0.0) first = tooth;
      }
      return printed("on %d teeth from tooth %d on", count, first);
    }
    case kRamp:
    case kFade: {
      const double begins = kind == kRamp ? 0.0 : 1.0;
      int first = 1;
      for (int tooth = 2; tooth <= g.teeth(); ++tooth)
        if (std::abs(value(g, tooth) - begins) < std::abs(value(g, first) - begins)) first = tooth;
      return printed("from tooth %d on ", first) +
             (kind == kRamp ? "more and more" : "less and less") +
             " from tooth to tooth, once around";
    }
    case kComesAndGoes:
    case kWave: {
      const int order = static_cast<int>(std::lround(180.0 / half_deg));
      return std::string(kind == kWave ? "" : "coming and going ") +
             (order == 1   ? std::string("once")
              : order == 2 ? std::string("twice")
                           : printed("%d times", order)) +
             " per turn, most " + printed("at %.0f deg", std::fmod(turned, 360.0 / order)) +
             (order > 1 ? " first" : "") + (kind == kWave ? "" : ", nothing between");
    }
    case kComb: {
      const auto [every, first] = teeth_of_comb(g);
      return printed("on one tooth in %d, from tooth %d on", every, first);
    }
    case kSaw: {
      const auto [every, first] = teeth_of_comb(g);
      const int from = (first - 1 + g.teeth()) % g.teeth() + 1;
      return printed("from tooth %d on more and more from tooth to tooth, and anew every %d teeth",
                     from, every);
    }
  }
  return "";
}

std::vector<std::string> AroundCourse::kind_words() {
  return {"half",  "bell", "sector", "ramp",           "wave",
          "every", "comb", "fade",   "comes_and_goes", "saw"};
}

std::vector<AroundCourse> courses_around(const FlankGeometry& g) {
  constexpr int kMostWaves = 2;
  std::vector<AroundCourse> courses{{AroundCourse::kHalf}, {AroundCourse::kRamp}};
  for (const double half : {25.0, 40.0, 60.0, 85.0})
    courses.push_back({AroundCourse::kBell, 0.0, half});
  const double pitch_deg = 360.0 / g.teeth();
  for (double half = 1.5 * pitch_deg; half < kWidestSector_deg;
       half = std::max(half + 0.5 * pitch_deg, 1.25 * half))
    courses.push_back({AroundCourse::kSector, 0.0, half});
  for (int order = 1; order <= kMostWaves && 3 * order <= g.teeth(); ++order)
    courses.push_back({AroundCourse::kWave, 0.0, 180.0 / order});
  return courses;
}

std::vector<FlankCourse> courses_over(const FlankGeometry& g, double face) {
  constexpr int kPlaces = 12;
  const double range = std::abs(range_mm(g, face));
  std::vector<FlankCourse> courses{{FlankCourse::kSlope}, {FlankCourse::kBow}};
  for (int i = 0; i <= kPlaces; ++i) {
    const double share = static_cast<double>(i) / kPlaces, place = place_at(g, face, share);
    for (const double towards : {-1.0, 1.0}) {
      const double length = towards > 0.0 ? 1.0 - share : share;
      if (i > 0 && i < kPlaces) courses.push_back({FlankCourse::kStep, place, towards});
      if (length < 0.1) continue;
      courses.push_back({FlankCourse::kKink, place, towards});
      courses.push_back({FlankCourse::kBend, place, towards});
    }
    for (const double half : {0.06, 0.1, 0.16, 0.25})
      courses.push_back({FlankCourse::kBand, place, 0.0, half * range});
  }
  for (const double towards : {-1.0, 0.0, 1.0})
    for (const double within : {0.04, 0.07, 0.12, 0.18, 0.3})
      if (towards != 0.0 || within <= kLongestOfBoth)
        courses.push_back({FlankCourse::kRise, within * range, towards});
  return courses;
}

}  // namespace trueflank::loop::gear_effects
