// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/part/runs_along.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trueflank::loop {

Runs runs_of(const FlankGeometry& geometry, const Effect& effect, Flanks flanks) {
  constexpr int kMostColumns = 2;  // short waves have a cosine and a sine
  using Columns = Eigen::Matrix<double, kMostColumns, 1>;
  constexpr int kOfGrid = 9;
  constexpr double kAlike = 1e-6;
  if (effect.columns() > kMostColumns || effect.order() != 0.0 || effect.family->local)
    return Runs::kOtherwise;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto at = [&](int tooth, int side, double u, double v) {
    Columns values = Columns::Zero();
    effect.evaluate(
        geometry,
        geometry.on_flank(tooth, side, low + u * (high - low), v * geometry.face_width_mm()),
        values.data());
    return values;
  };
  const auto off = [](const Columns& a, const Columns& b) { return (a - b).cwiseAbs().maxCoeff(); };
  double size = 0.0, profile = 0.0, face = 0.0, apart = 0.0;
  for (const int side : {1, -1})
    for (int i = 0; i < kOfGrid; ++i)
      for (int k = 0; k < kOfGrid; ++k) {
        const double u = (i + 0.5) / kOfGrid, v = (k + 0.5) / kOfGrid;
        const Columns here = at(1, side, u, v);
        size = std::max(size, here.cwiseAbs().maxCoeff());
        profile = std::max(profile, off(here, at(1, side, 0.5 / kOfGrid, v)));
        face = std::max(face, off(here, at(1, side, u, 0.5 / kOfGrid)));
        if (effect.flank == FlankChoice::kBoth && flanks == Flanks::kAlike)
          apart = std::max(apart, off(here, at(1, -side, u, v)));
      }
  for (int tooth = 2; tooth <= geometry.teeth(); ++tooth)
    for (const int side : {1, -1})
      apart = std::max(apart, off(at(tooth, side, 0.7, 0.3), at(1, side, 0.7, 0.3)));
  const double nothing = kAlike * size;
  if (apart > nothing) return Runs::kOtherwise;
  if (profile > nothing && face > nothing) return Runs::kOverBoth;
  return profile > nothing ? Runs::kOverProfile : face > nothing ? Runs::kOverFace : Runs::kNowhere;
}

bool is_wave_around(const Effect& effect) {
  return effect.order() > 0.0 && !effect.family->tells_order_along_profile;
}

bool moves_the_teeth(const Effect& effect) {
  return effect.family->displacement_mm && effect.shape.empty() && effect.order() == 0.0 &&
         effect.columns() == 2 && effect.flank == FlankChoice::kBoth &&
         !effect.needs().several_heights;
}

bool is_name_of_all_teeth(const Effect& effect) {
  return effect.family->named && !effect.family->local && effect.columns() == 1 &&
         effect.order() == 0.0;
}

bool is_in_the_span(const Eigen::VectorXd& of, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr double kAlike = 1e-3;
  const Eigen::VectorXd from_a = b - b.dot(a) / a.squaredNorm() * a;
  if (!(from_a.norm() > kAlike * b.norm())) return false;
  const Eigen::VectorXd left =
      of - of.dot(a) / a.squaredNorm() * a - of.dot(from_a) / from_a.squaredNorm() * from_a;
  return left.norm() < kAlike * of.norm();
}

Eigen::MatrixXd over_a_tooth(const FlankGeometry& geometry, const Effect& effect) {
  constexpr int kOfGrid = 9;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  Eigen::MatrixXd field(2 * kOfGrid * kOfGrid, effect.columns());
  std::vector<double> values(static_cast<std::size_t>(effect.columns()));
  Eigen::Index at = 0;
  for (const int side : {1, -1})
    for (int i = 0; i < kOfGrid; ++i)
      for (int k = 0; k < kOfGrid; ++k, ++at) {
        effect.evaluate(geometry,
                        geometry.on_flank(1, side, low + (i + 0.5) / kOfGrid * (high - low),
                                          (k + 0.5) / kOfGrid * geometry.face_width_mm()),
                        values.data());
        for (Eigen::Index c = 0; c < field.cols(); ++c)
          field(at, c) = values[static_cast<std::size_t>(c)];
      }
  return field;
}

bool is_straight(const FlankGeometry& geometry, const Effect& effect) {
  constexpr double kNothing = 1e-6;
  const Runs runs = effect.columns() == 1 ? runs_of(geometry, effect) : Runs::kOtherwise;
  if (runs != Runs::kOverProfile && runs != Runs::kOverFace) return false;
  const int side = effect.flank == FlankChoice::kRight ? -1 : 1;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto at = [&](double share) {
    double value = 0.0;
    effect.evaluate(
        geometry,
        geometry.on_flank(1, side, low + share * (high - low), share * geometry.face_width_mm()),
        &value);
    return value;
  };
  return std::abs(at(0.1) + at(0.9) - 2.0 * at(0.5)) < kNothing * std::abs(at(0.9) - at(0.1)) &&
         std::abs(at(0.1) + at(0.5) - 2.0 * at(0.3)) < kNothing * std::abs(at(0.9) - at(0.1));
}

bool is_slope_beside_slope(const FlankGeometry& geometry, const std::vector<Effect>& with) {
  constexpr double kNearlyAll = 0.7;
  const Effect& rise = with.back();
  if (rise.family != find_family("unnamed_rise")) return false;
  const bool face = rise.shape[0] != 0.0;
  const double range_mm =
      face ? geometry.face_width_mm()
           : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  return rise.shape[1] > kNearlyAll * range_mm &&
         std::any_of(with.begin(), with.end() - 1, [&](const Effect& e) {
           return is_straight(geometry, e) &&
                  runs_of(geometry, e) == (face ? Runs::kOverFace : Runs::kOverProfile);
         });
}

bool run_alike(const FlankGeometry& geometry, const Effect& a, const Effect& b) {
  constexpr int kOfGrid = 9;
  constexpr double kAlike = 0.9999;
  if (a.columns() != 1 || b.columns() != 1) return false;
  const Runs runs = runs_of(geometry, a);
  if ((runs != Runs::kOverProfile && runs != Runs::kOverFace) || runs_of(geometry, b) != runs)
    return false;
  const int side = a.flank == FlankChoice::kRight ? -1 : 1;
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  const auto course = [&](const Effect& effect) {
    Eigen::Matrix<double, kOfGrid, 1> values;
    for (int i = 0; i < kOfGrid; ++i) {
      const double share = (i + 0.5) / kOfGrid;
      effect.evaluate(
          geometry,
          geometry.on_flank(1, side, low + share * (high - low), share * geometry.face_width_mm()),
          &values[i]);
    }
    values.array() -= values.mean();
    return values;
  };
  const auto of_a = course(a), of_b = course(b);
  return std::abs(of_a.dot(of_b)) > kAlike * of_a.norm() * of_b.norm();
}

bool is_longer_than_the_flank(const FlankGeometry& geometry, const Effect& form, bool face) {
  constexpr double kMostOfIt = 0.5, kLongest = 1.5;
  const double range_mm =
      face ? geometry.face_width_mm()
           : std::abs(geometry.tip_form_roll_mm() - geometry.root_form_roll_mm());
  return (form.family == find_family("unnamed_band") && form.shape[2] > kMostOfIt * range_mm) ||
         (form.family == find_family("unnamed_waviness") && form.shape[1] > kLongest * range_mm);
}

}  // namespace trueflank::loop
