// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/flank_courses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {

Eigen::VectorXd values_along(const FlankGeometry& geometry, const PointFit& fit, std::size_t effect,
                             bool face, int tooth) {
  const Effect& one = fit.effects()[effect];
  const int first = fit.first_column(static_cast<int>(effect));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(2 * kPlaces);
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  double columns[8];
  for (int i = 0; i < 2 * kPlaces; ++i) {
    const double share = static_cast<double>(i % kPlaces) / (kPlaces - 1);
    const double roll = low + (face ? 0.5 : share) * (high - low);
    one.evaluate(geometry,
                 geometry.on_flank(tooth, i < kPlaces ? 1 : -1, roll,
                                   (face ? share : 0.5) * geometry.face_width_mm()),
                 columns);
    for (int k = 0; k < one.columns(); ++k) values[i] += fit.coefficients()[first + k] * columns[k];
  }
  return values;
}

bool differs_by_tooth(const Effect& effect) {
  const EffectFamily& family = *effect.family;
  return family.faces_a_direction ||
         (effect.is_term() && effect.order() == 0.0 &&
          !(family.same_on_every_tooth && family.same_on_every_tooth(effect.shape)));
}

bool moves_teeth_aside(const Effect& effect) {
  const NeedsToBeSeen needs = effect.needs();
  return effect.family->faces_a_direction && effect.columns() == 2 && !needs.along_profile &&
         !needs.along_face && !needs.several_heights;
}

Eigen::VectorXd mean_over_teeth(const FlankGeometry& geometry, const PointFit& fit,
                                std::size_t effect, bool face) {
  constexpr int kTeeth = 12;
  const bool all = differs_by_tooth(fit.effects()[effect]);
  const int teeth = all ? geometry.teeth() : std::min(kTeeth, geometry.teeth());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(2 * kPlaces);
  for (int i = 0; i < teeth; ++i)
    mean += values_along(geometry, fit, effect, face, 1 + i * geometry.teeth() / teeth) / teeth;
  return mean;
}

Eigen::VectorXd course_of(const FlankGeometry& geometry, const PointFit& fit, std::size_t effect,
                          bool face) {
  Eigen::VectorXd course = differs_by_tooth(fit.effects()[effect])
                               ? mean_over_teeth(geometry, fit, effect, face)
                               : values_along(geometry, fit, effect, face);
  course.head(kPlaces).array() -= course.head(kPlaces).mean();
  course.tail(kPlaces).array() -= course.tail(kPlaces).mean();
  // What does not run that way leaves the rounding of its mean.
  constexpr double kNothing_um = 1e-6;
  if (course.norm() < kNothing_um) course.setZero();
  return course;
}

Kind kind_of(const Eigen::VectorXd& course) {
  constexpr double kNothing = 1e-6;
  const double nothing = kNothing * course.norm();
  if ((course.head(kPlaces) - course.tail(kPlaces)).norm() <= nothing) return Kind::kEqual;
  if ((course.head(kPlaces) + course.tail(kPlaces)).norm() <= nothing) return Kind::kOpposite;
  return Kind::kNeither;
}

bool is_of_one_flank(const Eigen::VectorXd& course) {
  constexpr double kNearlyNothing = 0.25;
  const auto bends = [](const auto& flank) {
    return (flank.array() - flank.mean()).matrix().norm();
  };
  const double left = bends(course.head(kPlaces)), right = bends(course.tail(kPlaces));
  return std::min(left, right) < kNearlyNothing * std::max(left, right);
}

Eigen::VectorXd part_of_kind(const Eigen::VectorXd& course, Kind kind) {
  if (kind == Kind::kNeither || is_of_one_flank(course)) return course;
  const double sign = kind == Kind::kEqual ? 1.0 : -1.0;
  const Eigen::VectorXd half = 0.5 * (course.head(kPlaces) + sign * course.tail(kPlaces));
  Eigen::VectorXd part(course.size());
  part << half, sign * half;
  return part;
}

Eigen::VectorXd slow_part(const Eigen::VectorXd& course) {
  constexpr int kDegrees = 4;
  Eigen::MatrixXd powers(kPlaces, kDegrees + 1);
  for (int i = 0; i < kPlaces; ++i)
    for (int d = 0; d <= kDegrees; ++d) powers(i, d) = std::pow(2.0 * i / (kPlaces - 1) - 1.0, d);
  const Eigen::MatrixXd fit =
      SymmetricSolver(powers.transpose() * powers).solve_columns(powers.transpose());
  Eigen::VectorXd slow(course.size());
  slow << powers * (fit * course.head(kPlaces)), powers * (fit * course.tail(kPlaces));
  return slow;
}

bool is_common_form(const Effect& e) {
  return e.is_term() && e.family->form_word.empty() && e.order() == 0.0;
}

bool is_form_without_name(const Effect& e) { return e.is_term() && e.family->form_word.empty(); }

namespace {

/// A course that is a straight line on either flank, opposite to the other's.
bool is_opposite_slope(const Eigen::VectorXd& course) {
  constexpr double kNothing = 1e-6;
  double bends = 0.0;
  for (Eigen::Index i = 1; i + 1 < course.size(); ++i)
    if (i != kPlaces && i + 1 != kPlaces)
      bends = std::max(bends, std::abs(course[i - 1] - 2.0 * course[i] + course[i + 1]));
  const double nothing = kNothing * course.norm();
  return bends <= nothing && (course.head(kPlaces) + course.tail(kPlaces)).norm() <= nothing;
}

}  // namespace

Eigen::VectorXd mean_of_forms(const FlankGeometry& geometry, const PointFit& fit, bool face) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(2 * kPlaces);
  for (std::size_t e = 0; e < fit.effects().size(); ++e) {
    if (!is_form_without_name(fit.effects()[e]) || fit.effects()[e].order() > 0.0) continue;
    const Eigen::VectorXd own = mean_over_teeth(geometry, fit, e, face);
    if (!is_opposite_slope(own)) mean += own;
  }
  return mean;
}

bool changes_along(const FlankGeometry& geometry, const PointFit& fit, std::size_t effect,
                   const Eigen::VectorXd& course, bool face) {
  constexpr double kNoPart = 0.2;
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    Eigen::VectorXd own = values_along(geometry, fit, effect, face, tooth);
    own.head(kPlaces).array() -= own.head(kPlaces).mean();
    own.tail(kPlaces).array() -= own.tail(kPlaces).mean();
    if (std::abs(own.dot(course)) > kNoPart * own.norm() * course.norm()) return true;
  }
  return false;
}

std::array<double, 2> forms_over_name(const FlankGeometry& geometry, const PointFit& fit,
                                      const Eigen::VectorXd& name, bool face) {
  const std::vector<Effect>& effects = fit.effects();
  const bool all_alike = std::none_of(effects.begin(), effects.end(), [](const Effect& e) {
    return is_form_without_name(e) && (e.order() > 0.0 || differs_by_tooth(e));
  });
  std::array<double, 2> most{};
  for (int tooth = 1; tooth <= (all_alike ? 1 : geometry.teeth()); ++tooth) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * kPlaces);
    for (std::size_t e = 0; e < effects.size(); ++e)
      if (is_form_without_name(effects[e])) sum += values_along(geometry, fit, e, face, tooth);
    for (const int flank : {0, 1}) {
      const auto own = sum.segment(flank * kPlaces, kPlaces);
      auto& at = most[static_cast<std::size_t>(flank)];
      at = std::max(at, (own.array() - own.mean()).matrix().norm() /
                            name.segment(flank * kPlaces, kPlaces).norm());
    }
  }
  return most;
}

}  // namespace trueflank::loop
