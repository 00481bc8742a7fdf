// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop::product_cells {
namespace {

/// Waves along one direction in the cells: products with cosine and sine.
struct WaveSum {
  double c = 0.0, s = 0.0, weight = 0.0;
  void add(const Sum& sum, const std::array<double, 2>& unit) {
    c += sum.value * unit[0];
    s += sum.value * unit[1];
    weight += sum.weight;
  }
};
/// (half of the square of a wave is what its cosine has)
double gain_of(double c, double s, double weight) {
  return weight > 0.0 ? 2.0 * (c * c + s * s) / weight : 0.0;
}

// (a cell is half of one at most)
constexpr double kFewestWaves = 2.0, kMostWaves = 14.0, kStepOfWaves = 0.25;

/// Cosine and sine of so many waves over the flank in the middle of a cell.
std::array<double, 2> unit_in_cell(double waves, std::size_t cell) {
  const double angle = kTwoPi * waves * (static_cast<double>(cell) + 0.5) / kProductCells;
  return {std::cos(angle), std::sin(angle)};
}

Effect wave_form(const FlankGeometry& g, const FlankWay& way, int face, double waves,
                 const FlankCourse& course, const AroundCourse& where) {
  const double range_mm =
      face != 0 ? g.face_width_mm() : std::abs(g.tip_form_roll_mm() - g.root_form_roll_mm());
  EffectShape shape(2 + FlankCourse::kValues + AroundCourse::kValues);
  shape[0] = face;
  shape[1] = range_mm / waves;
  course.put_in(shape, 2);
  where.put_in(shape, 2 + FlankCourse::kValues);
  return {find_family("unnamed_crossed_waves"), way.flank, std::move(shape)};
}

/// Waves over profile (0) or face (1) of the flanks of a way, both alike or one: those whose size
/// follows a course in the other direction, alike on every tooth, and those that go around the
/// gear.
struct LikelyWaves {
  std::vector<Likely> across, around;
};
LikelyWaves likely_waves(const FlankGeometry& g, const OfTeeth& teeth, const FlankWay& way,
                         int face, const std::vector<CourseInCells>& across,
                         const Arounds& arounds) {
  LikelyWaves likely;
  for (double waves = kFewestWaves; waves <= kMostWaves; waves += kStepOfWaves) {
    const auto form = [&](const FlankCourse& course, const AroundCourse& where) {
      return wave_form(g, way, face, waves, course, where);
    };
    std::vector<WaveSum> of_teeth(teeth.size());
    std::array<WaveSum, kProductCells> over{};  // the other direction, of all teeth
    for (std::size_t i = 0; i < kProductCells; ++i) {
      const std::array unit = unit_in_cell(waves, i);
      for (std::size_t t = 0; t < teeth.size(); ++t)
        for (const std::size_t side : {0U, 1U}) {
          if (way.signs[side] == 0.0) continue;
          const OfFlank& flank = teeth[t][side];
          of_teeth[t].add(face == 0 ? flank.profile[i] : flank.face[i], unit);
          for (std::size_t k = 0; k < kProductCells; ++k)
            over[k].add(face == 0 ? flank.both[i][k] : flank.both[k][i], unit);
        }
    }
    for (const CourseInCells& course : across) {
      if (course.course.kind == FlankCourse::kSlope) continue;
      double c = 0.0, s = 0.0, weight = 0.0;
      for (std::size_t k = 0; k < kProductCells; ++k) {
        c += course.values[k] * over[k].c;
        s += course.values[k] * over[k].s;
        weight += course.values[k] * course.values[k] * over[k].weight;
      }
      likely.across.push_back({gain_of(c, s, weight), form(course.course, {AroundCourse::kEvery})});
    }
    for (std::size_t a = 0; a < arounds.courses.size(); ++a) {
      const AroundCourse::Kind kind = arounds.courses[a].kind;
      if (kind == AroundCourse::kRamp || kind == AroundCourse::kWave) continue;
      double c = 0.0, s = 0.0, weight = 0.0;
      for (std::size_t t = 0; t < teeth.size(); ++t) {
        const double on =
            arounds.on_teeth(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(t));
        c += on * of_teeth[t].c;
        s += on * of_teeth[t].s;
        weight += on * on * of_teeth[t].weight;
      }
      likely.around.push_back({gain_of(c, s, weight), form({}, arounds.courses[a])});
    }
  }
  return likely;
}

/// Those that go from tooth to tooth by one of these courses.
std::vector<Likely> waves_by(const FlankGeometry& g, const OfTeeth& teeth, const FlankWay& way,
                             int face, double fewest_waves,
                             const std::vector<AroundCourse>& courses) {
  std::vector<Likely> likely;
  for (double waves = fewest_waves; waves <= kMostWaves; waves += kStepOfWaves) {
    std::vector<WaveSum> of_teeth(teeth.size());
    for (std::size_t i = 0; i < kProductCells; ++i)
      for (std::size_t t = 0; t < teeth.size(); ++t)
        for (const std::size_t side : {0U, 1U})
          if (way.signs[side] != 0.0)
            of_teeth[t].add(face == 0 ? teeth[t][side].profile[i] : teeth[t][side].face[i],
                            unit_in_cell(waves, i));
    for (const AroundCourse& course : courses) {
      double c = 0.0, s = 0.0, weight = 0.0;
      for (int tooth = 1; tooth <= g.teeth(); ++tooth) {
        const double on = course.value(g, tooth);
        const WaveSum& own = of_teeth[static_cast<std::size_t>(tooth - 1)];
        c += on * own.c;
        s += on * own.s;
        weight += on * on * own.weight;
      }
      likely.push_back({gain_of(c, s, weight), wave_form(g, way, face, waves, {}, course)});
    }
  }
  return likely;
}

/// The best of these, each kind of course a list.
void add_lists(std::vector<Likely> all, std::vector<LikelyForms>& lists) {
  constexpr std::size_t kKinds = 3, kFew = 3, kAcross = 2, kAround = kAcross + FlankCourse::kValues;
  std::stable_sort(all.begin(), all.end(),
                   [](const Likely& a, const Likely& b) { return a.gain > b.gain; });
  std::vector<LikelyForms> own;
  for (Likely& one : all) {
    if (!(one.gain > 0.0) || one.gain < kNearly * all.front().gain) break;
    const auto list = std::find_if(own.begin(), own.end(), [&](const LikelyForms& other) {
      const EffectShape& shape = other.forms.front().shape;
      return shape[kAcross] == one.form.shape[kAcross] && shape[kAround] == one.form.shape[kAround];
    });
    if (list == own.end()) {
      if (own.size() < kKinds) own.push_back({one.gain, {one.form}});
    } else if (list->forms.size() < kFew) {
      list->forms.push_back(one.form);
    }
  }
  std::move(own.begin(), own.end(), std::back_inserter(lists));
}

}  // namespace

std::vector<LikelyForms> likeliest_waves(const FlankGeometry& g, const OfTeeth& teeth,
                                         const std::vector<CourseInCells>& profiles,
                                         const std::vector<CourseInCells>& faces,
                                         const Arounds& arounds, bool scan) {
  std::vector<LikelyForms> lists;
  for (const FlankWay& way : flank_ways(g))
    for (const int face : {0, 1}) {
      if (way.opposite) continue;
      LikelyWaves waves = likely_waves(g, teeth, way, face, face == 0 ? faces : profiles, arounds);
      if (scan) add_lists(std::move(waves.across), lists);
      add_lists(std::move(waves.around), lists);
    }
  return lists;
}

std::vector<LikelyForms> likeliest_waves_by(const FlankGeometry& g, const OfTeeth& teeth, int face,
                                            double fewest_waves,
                                            const std::vector<AroundCourse>& courses) {
  std::vector<LikelyForms> lists;
  for (const FlankWay& way : flank_ways(g))
    if (!way.opposite) add_lists(waves_by(g, teeth, way, face, fewest_waves, courses), lists);
  return lists;
}

}  // namespace trueflank::loop::product_cells
