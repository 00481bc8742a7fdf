// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/effects/sign_words.h"

#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/columns.h"

namespace trueflank::loop::gear_effects {
namespace {

std::string by_sign(int sign, const char* positive, const char* negative, const char* unknown) {
  return sign > 0 ? positive : sign < 0 ? negative : unknown;
}

/// Where a course is largest, and whether that is more than one place.
struct Most {
  std::string where;
  bool several = false;
};

Most most_of(double profile_degree, double face_degree) {
  const bool profile = profile_degree > 0.0, face = face_degree > 0.0;
  const bool at_tip = std::fmod(profile_degree, 2.0) == 1.0,
             at_upper = std::fmod(face_degree, 2.0) == 1.0;
  if (!face) return at_tip ? Most{"the tip", false} : Most{"root and tip", true};
  if (!profile) return at_upper ? Most{"the upper end", false} : Most{"both ends", true};
  if (at_tip && at_upper) return {"the tip's upper corner", false};
  if (at_tip) return {"both corners of the tip", true};
  if (at_upper) return {"the upper corners of root and tip", true};
  return {"the four corners", true};
}

}  // namespace

std::string a_ridge(int sign) { return by_sign(sign, "a ridge", "a groove", "a groove or ridge"); }
std::string a_swelling(int sign) {
  return by_sign(sign, "a swelling", "a hollow", "a hollow or swelling");
}
std::string stand(int sign) {
  return by_sign(sign, "stand out", "lie back", "stand out or lie back");
}
std::string stands(int sign) {
  return by_sign(sign, "stands out", "lies back", "stands out or lies back");
}
std::string turned(int sign) { return by_sign(sign, "counter-clockwise", "clockwise", ""); }

std::string there(const std::string& where, int sign, bool opposite) {
  if (sign == 0) return "";
  return ": " + where +
         (opposite ? " the teeth stand " + turned(sign) : " the flanks " + stand(sign));
}

std::string first_at(double direction_rad, double order) {
  if (std::isnan(direction_rad)) return "";
  const double period = 360.0 / order, angle = deg_from_rad(direction_rad) / order;
  const double first = angle - period * std::floor(angle / period);
  return printed(period < 20.0 ? ", at %.1f deg" : ", at %.0f deg", first) +
         (order > 1.0 ? " first" : "");
}

std::string in_direction(double direction_rad) {
  return std::isnan(direction_rad) ? "" : ", " + towards(deg_from_rad(direction_rad));
}

CourseOfTeeth CourseOfTeeth::at(const ToldForm& form, std::size_t k) {
  return {form.shape[k],
          form.shape[k + 1],
          form.shape[k + 2] != 0.0,
          form.flank,
          form.sign(),
          form.amounts.size() == 1 ? std::abs(form.amounts[0]) : kNaN};
}

std::string CourseOfTeeth::in_all() const {
  const bool profile = profile_degree > 0.0, face = face_degree > 0.0;
  if (!std::isfinite(um) || profile == face) return "";
  constexpr double kOfLean = 2.0;
  const double degree = profile_degree + face_degree;
  if (degree == 1.0)
    return printed(", by %.3g um ", kOfLean * um) +
           (profile ? "from root to tip" : "over the face");
  if (degree == 2.0)
    return printed(", by %.3g um from the middle to ", bow * um) +
           (profile ? "root and tip" : "the ends");
  return "";
}

std::string CourseOfTeeth::material() const {
  if (sign == 0) return "";
  if (profile_degree == 0.0 && face_degree == 0.0)
    return opposite ? "the teeth stand " + turned(sign) : "the flanks " + stand(sign);
  const Most most = most_of(profile_degree, face_degree);
  if (opposite) return most.where + (most.several ? " stand " : " stands ") + turned(sign);
  return by_sign(sign, "more", "less", "") + " material at " + most.where;
}

std::string CourseOfTeeth::does() const {
  if (profile_degree == 0.0 && face_degree == 0.0) {
    if (opposite) return "stands aside" + (sign == 0 ? "" : ", " + turned(sign));
    return stands(sign) + (flank == FlankChoice::kBoth ? " on both flanks" : "");
  }
  const std::string more = material();
  const double degree = profile_degree + face_degree;
  return (profile_degree > 0.0 && face_degree > 0.0 ? std::string("is twisted")
          : degree == 1.0                           ? std::string("leans over the ")
                                                    : std::string("is bowed over the ")) +
         (profile_degree > 0.0 && face_degree > 0.0 ? ""
          : profile_degree > 0.0                    ? "profile"
                                                    : "face") +
         (more.empty() ? (opposite ? ", opposite on the two flanks" : "") : ": " + more) + in_all();
}

std::string CourseOfTeeth::what() const {
  if (profile_degree == 0.0 && face_degree == 0.0)
    return opposite ? "the place of the teeth" : "the height";
  if (profile_degree > 0.0 && face_degree > 0.0) return "the twist";
  return std::string(profile_degree + face_degree == 1.0 ? "the lean" : "the bow") + " over the " +
         (profile_degree > 0.0 ? "profile" : "face");
}

std::string CourseOfTeeth::direction() const {
  if (sign == 0) return opposite ? ", opposite on the two flanks" : "";
  if (profile_degree > 0.0 || face_degree > 0.0) {
    const Most most = most_of(profile_degree, face_degree);
    if (opposite) return ", " + most.where + " " + turned(sign);
    return ", towards " + material();
  }
  if (opposite) return ", " + turned(sign);
  return by_sign(sign, ", towards more material", ", towards less material", "");
}

}  // namespace trueflank::loop::gear_effects
