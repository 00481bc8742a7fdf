// SPDX-License-Identifier: GPL-3.0-or-later
// Waves of an order around the gear whose size follows a course along the flanks, as residuals in
// cells look like most.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop::product_cells {
namespace {

/// A cosine and a sine with a course, and both without one.
using Normal4 = Eigen::Matrix4d;
struct MomentsOfOrder {
  Normal4 normal = Normal4::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();

  /// What cosine and sine take out with the course; beside those without one.
  [[nodiscard]] double gain(bool beside_plain) const {
    constexpr double kAnything = 1e-6;
    const double trace = normal.topLeftCorner<2, 2>().trace();
    if (!(trace > 0.0)) return 0.0;
    const auto taken = [&](Eigen::Index first, Eigen::Index count) {
      Eigen::MatrixXd own = normal.block(first, first, count, count);
      own.diagonal().array() += kAnything * own.trace();
      const Eigen::VectorXd product = right.segment(first, count);
      return product.dot(symmetric_solution(own, product));
    };
    return beside_plain ? taken(0, 4) - taken(2, 2) : taken(0, 2);
  }
};

/// Cosine and sine of the order on every tooth.
std::vector<Eigen::Vector2d> waves_on_teeth(const FlankGeometry& g, double order) {
  std::vector<Eigen::Vector2d> waves;
  for (int tooth = 1; tooth <= g.teeth(); ++tooth) {
    const double angle = order * g.centre_rad(tooth);
    waves.emplace_back(std::cos(angle), std::sin(angle));
  }
  return waves;
}

/// Along one direction. A trace says nothing of its mean.
MomentsOfOrder of_order_along(const OfTeeth& teeth, const std::vector<Eigen::Vector2d>& waves,
                              const FlankWay& way, bool face,
                              const std::array<double, kProductCells>& course, bool centred) {
  MomentsOfOrder all;
  for (std::size_t t = 0; t < teeth.size(); ++t)
    for (const std::size_t side : {0U, 1U}) {
      if (way.signs[side] == 0.0) continue;
      const Along& sums = face ? teeth[t][side].face : teeth[t][side].profile;
      Eigen::Matrix2d weight = Eigen::Matrix2d::Zero();  // of the course and 1
      Eigen::Vector2d value = Eigen::Vector2d::Zero();
      for (std::size_t i = 0; i < kProductCells; ++i) {
        const Eigen::Vector2d at(course[i], 1.0);
        weight += sums[i].weight * at * at.transpose();
        value += sums[i].value * at;
      }
      if (centred && weight(1, 1) > 0.0) {
        const double mean = weight(0, 1) / weight(1, 1);
        value[0] -= mean * value[1];
        weight(0, 0) -= mean * weight(0, 1);
        weight(0, 1) = weight(1, 0) = weight(1, 1) = value[1] = 0.0;
      }
      const Eigen::Matrix2d wave = waves[t] * waves[t].transpose();
      for (const Eigen::Index a : {0, 1})
        for (const Eigen::Index b : {0, 1}) {
          all.normal.block<2, 2>(2 * a, 2 * b) += weight(a, b) * wave;
          if (b == 0) all.right.segment<2>(2 * a) += way.signs[side] * value[a] * waves[t];
        }
    }
  return all;
}

/// Sums over all teeth in a cell: weights times squares of cosine and sine, and times both; and
/// residuals times either.
using OfCell = Eigen::Matrix<double, 5, 1>;
using CellsOfOrder = std::array<std::array<OfCell, kProductCells>, kProductCells>;

CellsOfOrder weighed(const OfTeeth& teeth, const std::vector<Eigen::Vector2d>& waves,
                     const FlankWay& way) {
  CellsOfOrder cells;
  for (auto& row : cells) row.fill(OfCell::Zero());
  for (std::size_t t = 0; t < teeth.size(); ++t)
    for (const std::size_t side : {0U, 1U}) {
      const double sign = way.signs[side], c = waves[t][0], s = waves[t][1];
      if (sign == 0.0) continue;
      for (std::size_t u = 0; u < kProductCells; ++u)
        for (std::size_t v = 0; v < kProductCells; ++v) {
          const Sum& sum = teeth[t][side].both[u][v];
          cells[u][v] += OfCell(sum.weight * c * c, sum.weight * c * s, sum.weight * s * s,
                                sign * sum.value * c, sign * sum.value * s);
        }
    }
  return cells;
}

/// Adds what a course, to a power, has in cells to one place of the moments.
void add_to(MomentsOfOrder& moments, Eigen::Index a, Eigen::Index b, const OfCell& sums) {
  moments.normal.block<2, 2>(2 * a, 2 * b) << sums[0], sums[1], sums[1], sums[2];
  moments.normal.block<2, 2>(2 * b, 2 * a) = moments.normal.block<2, 2>(2 * a, 2 * b);
  if (b == 1) moments.right.segment<2>(2 * a) = sums.tail<2>();
}

/// Over profile and face at once.
std::vector<Likely> of_order_crossed(const CellsOfOrder& cells,
                                     const std::vector<CourseInCells>& profiles,
                                     const std::vector<CourseInCells>& faces, bool beside_plain,
                                     const auto& form) {
  using Row = std::array<OfCell, kProductCells>;
  std::vector<Likely> likely;
  const auto over_profile = [&](const auto& weight) {
    Row row;
    row.fill(OfCell::Zero());
    for (std::size_t u = 0; u < kProductCells; ++u)
      for (std::size_t v = 0; v < kProductCells; ++v) row[v] += weight(u) * cells[u][v];
    return row;
  };
  const Row plain = over_profile([](std::size_t) { return 1.0; });
  OfCell all = OfCell::Zero();
  for (const OfCell& cell : plain) all += cell;
  for (const CourseInCells& profile : profiles) {
    if (profile.course.kind == FlankCourse::kWhole) continue;
    const Row once = over_profile([&](std::size_t u) { return profile.values[u]; }),
              twice = over_profile(
                  [&](std::size_t u) { return profile.values[u] * profile.values[u]; });
    for (const CourseInCells& face : faces) {
      if (face.course.kind == FlankCourse::kWhole) continue;
      OfCell first = OfCell::Zero(), second = OfCell::Zero();
      for (std::size_t v = 0; v < kProductCells; ++v) {
        first += face.values[v] * once[v];
        second += face.values[v] * face.values[v] * twice[v];
      }
      MomentsOfOrder moments;
      add_to(moments, 0, 0, second);
      add_to(moments, 1, 1, all);
      add_to(moments, 0, 1, first);
      likely.push_back({moments.gain(beside_plain), form(profile.course, face.course)});
    }
  }
  return likely;
}

/// The likeliest kinds, a list each.
std::vector<LikelyForms> lists_of_order(std::vector<Likely> all) {
  constexpr std::size_t kKinds = 4, kOfAKind = 2, kFace = FlankCourse::kValues;
  std::stable_sort(all.begin(), all.end(),
                   [](const Likely& a, const Likely& b) { return a.gain > b.gain; });
  std::vector<LikelyForms> lists;
  for (const Likely& one : all) {
    if (!(one.gain > 0.0) || one.gain < kNearly * all.front().gain) break;
    const auto list = std::find_if(lists.begin(), lists.end(), [&](const LikelyForms& other) {
      const Effect& first = other.forms.front();
      return first.flank == one.form.flank && first.shape[0] == one.form.shape[0] &&
             first.shape[kFace] == one.form.shape[kFace];
    });
    if (list == lists.end()) {
      if (lists.size() < kKinds) lists.push_back({one.gain, {one.form}});
    } else if (list->forms.size() < kOfAKind) {
      list->forms.push_back(one.form);
    }
  }
  return lists;
}

/// On the flanks of a way, all courses in the same order: in one direction, and over both.
struct OfAWay {
  std::vector<Likely> along, crossed;
  void add(const OfAWay& other) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i].gain += other.along[i].gain;
    for (std::size_t i = 0; i < crossed.size(); ++i) crossed[i].gain += other.crossed[i].gain;
  }
};
OfAWay of_a_way(const OfTeeth& teeth, const std::vector<Eigen::Vector2d>& waves,
                const FlankWay& way, const std::vector<CourseInCells>& profiles,
                const std::vector<CourseInCells>& faces, bool scan, const OrderAsked& asked) {
  const auto form = [&](const FlankCourse& profile, const FlankCourse& face) {
    EffectShape shape(2 * FlankCourse::kValues);
    profile.put_in(shape, 0);
    face.put_in(shape, FlankCourse::kValues);
    shape.push_back(way.opposite ? 1.0 : 0.0);
    shape.push_back(asked.order);
    return Effect{find_family("unnamed_crossed_order"), way.flank, std::move(shape)};
  };
  OfAWay forms;
  for (const bool face : {false, true}) {
    // (whole sections that stand aside are told as these)
    if (face ? asked.order == 1.0 && !way.opposite : !asked.along_profile) continue;
    for (const CourseInCells& course : face ? faces : profiles)
      if (!course.course.is_polynomial())
        forms.along.push_back(
            {of_order_along(teeth, waves, way, face, course.values, !scan).gain(asked.beside_plain),
             face ? form({}, course.course) : form(course.course, {})});
  }
  if (!scan || !asked.crossed) return forms;
  forms.crossed =
      of_order_crossed(weighed(teeth, waves, way), profiles, faces, asked.beside_plain, form);
  std::erase_if(forms.crossed, [](const Likely& one) {
    return FlankCourse::at(one.form.shape, 0).is_polynomial() &&
           FlankCourse::at(one.form.shape, FlankCourse::kValues).is_polynomial();
  });
  return forms;
}

}  // namespace

std::vector<LikelyForms> likeliest_orders(const FlankGeometry& g, const OfTeeth& teeth,
                                          const std::vector<CourseInCells>& profiles,
                                          const std::vector<CourseInCells>& faces, bool scan,
                                          const OrderAsked& asked) {
  const std::vector<Eigen::Vector2d> waves = waves_on_teeth(g, asked.order);
  const auto of = [&](const FlankWay& way) {
    return of_a_way(teeth, waves, way, profiles, faces, scan, asked);
  };
  std::vector<Likely> forms;
  for (const FlankWay& way : flank_ways(g)) {
    if (asked.phase_of_each_flank && way.flank != FlankChoice::kLeft) continue;
    OfAWay own = of(way);
    if (asked.phase_of_each_flank) own.add(of(flank_ways(g).back()));
    // (a course in one direction says nearly as much: it is none in both)
    constexpr double kMore = 1.05;
    double most = 0.0;
    for (Likely& one : own.along) {
      most = std::max(most, one.gain);
      forms.push_back(std::move(one));
    }
    for (Likely& one : own.crossed)
      if (one.gain > kMore * most) forms.push_back(std::move(one));
  }
  return lists_of_order(std::move(forms));
}

}  // namespace trueflank::loop::product_cells
