// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/products/likeliest_products.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/units.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/products/product_cells.h"

namespace trueflank::loop {
namespace product_cells {
namespace {

/// What a form takes out: the square of its product with the residuals over its own square.
struct Projection {
  double product = 0.0, square = 0.0;
};

Projection projected(const Along& sums, const std::array<double, kProductCells>& form,
                     bool centred) {
  // (the mean of a trace says nothing)
  double product = 0.0, square = 0.0, weight = 0.0, first = 0.0, value = 0.0;
  for (std::size_t i = 0; i < kProductCells; ++i) {
    product += sums[i].value * form[i];
    square += sums[i].weight * form[i] * form[i];
    first += sums[i].weight * form[i];
    weight += sums[i].weight;
    value += sums[i].value;
  }
  if (!centred || !(weight > 0.0)) return {product, square};
  return {product - value * first / weight, square - first * first / weight};
}

/// Ways around the gear that lead to each other where one of them is moved.
int way_around(const Effect& form) {
  constexpr std::size_t kAround = 2 * FlankCourse::kValues + 1;
  if (form.shape.size() <= kAround) return 0;
  const AroundCourse around = AroundCourse::at(form.shape, kAround);
  return around.kind == AroundCourse::kBell ? AroundCourse::kHalf : around.kind;
}

/// The likeliest kinds of courses on the likeliest flanks, a list each, of each way around: the
/// best of each kind.
std::vector<LikelyForms> best_of(std::vector<Likely> all, std::size_t kinds) {
  constexpr std::size_t kOfAKind = 2;
  constexpr std::size_t kFace = FlankCourse::kValues, kOpposite = 2 * FlankCourse::kValues;
  std::stable_sort(all.begin(), all.end(),
                   [](const Likely& a, const Likely& b) { return a.gain > b.gain; });
  const auto alike = [](const Effect& a, const Effect& b) {
    return a.flank == b.flank && way_around(a) == way_around(b) && a.shape[0] == b.shape[0] &&
           a.shape[kFace] == b.shape[kFace] && a.shape[kOpposite] == b.shape[kOpposite];
  };
  std::vector<LikelyForms> best;
  for (const Likely& one : all) {
    if (one.gain < kNearly * all.front().gain || !(one.gain > 0.0)) break;
    const auto kind = std::find_if(best.begin(), best.end(), [&](const LikelyForms& list) {
      return alike(list.forms.front(), one.form);
    });
    if (kind == best.end()) {
      const auto own_way = [&](const LikelyForms& list) {
        return way_around(list.forms.front()) == way_around(one.form);
      };
      if (static_cast<std::size_t>(std::count_if(best.begin(), best.end(), own_way)) < kinds)
        best.push_back({one.gain, {one.form}});
    } else if (kind->forms.size() < kOfAKind) {
      kind->forms.push_back(one.form);
    }
  }
  return best;
}

EffectShape shape_of(const FlankCourse& profile, const FlankCourse& face, const FlankWay& way) {
  EffectShape shape(2 * FlankCourse::kValues + 1);
  profile.put_in(shape, 0);
  face.put_in(shape, FlankCourse::kValues);
  shape.back() = way.opposite ? 1.0 : 0.0;
  return shape;
}

double gain_of(const Projection& p) {
  return p.square > 0.0 ? p.product * p.product / p.square : 0.0;
}

/// The best way around for a form of which every tooth's projection is known: as the residuals are,
/// or beside names that take up what is alike on all teeth.
Likely best_around(const FlankGeometry& g, const Arounds& arounds,
                   const std::vector<Projection>& of_teeth, FlankChoice flank, EffectShape shape) {
  Eigen::VectorXd products(std::ssize(of_teeth)), squares(std::ssize(of_teeth));
  for (Eigen::Index t = 0; t < products.size(); ++t) {
    products[t] = of_teeth[static_cast<std::size_t>(t)].product;
    squares[t] = of_teeth[static_cast<std::size_t>(t)].square;
  }
  const double all = squares.sum();
  if (!(all > 0.0)) return {};
  const Eigen::ArrayXd product = (arounds.on_teeth * products).array(),
                       square = (arounds.squares * squares).array();
  const Eigen::ArrayXd mean = (arounds.on_teeth * squares).array() / all,
                       beside_mean = product - mean * products.sum(),
                       square_beside = square - mean.square() * all;
  constexpr double kAnything = 1e-6;
  const Eigen::ArrayXd gains =
      (square > kAnything * all)
          .select(product.square() / square, 0.0)
          .max((square_beside > kAnything * all).select(beside_mean.square() / square_beside, 0.0));
  // A slope or bow in a wave is what the free form has, and whole sections that stand aside are
  // told as these.
  const FlankCourse profile = FlankCourse::at(shape, 0),
                    face = FlankCourse::at(shape, FlankCourse::kValues);
  const bool free = profile.is_of_free_form(g, 0.0) && face.is_of_free_form(g, 1.0),
             sections = profile.kind == FlankCourse::kWhole;
  Eigen::Index best = 0;
  const double gain = (free       ? Eigen::ArrayXd(gains * arounds.beside_free_form)
                       : sections ? Eigen::ArrayXd(gains * arounds.beside_motions)
                                  : gains)
                          .maxCoeff(&best);
  // (what the same courses on every tooth say nearly as well does not go around the gear)
  constexpr double kMore = 1.05;
  if (gain < kMore * products.sum() * products.sum() / all) return {};
  const std::size_t own = shape.size();
  shape.resize(own + AroundCourse::kValues);
  arounds.courses[static_cast<std::size_t>(best)].put_in(shape, own);
  return {gain, {find_family("unnamed_crossed_around"), flank, std::move(shape)}};
}

/// Over profile and face, of every few teeth that follow each other.
constexpr std::size_t kGroups = 12;
using OfGroups = std::array<std::array<OverFlank, 2>, kGroups>;

OfGroups in_groups(const OfTeeth& teeth) {
  OfGroups groups{};
  for (std::size_t t = 0; t < teeth.size(); ++t)
    for (const std::size_t side : {0U, 1U})
      for (std::size_t u = 0; u < kProductCells; ++u)
        for (std::size_t v = 0; v < kProductCells; ++v)
          groups[t * kGroups / teeth.size()][side][u][v] += teeth[t][side].both[u][v];
  return groups;
}

/// Sums over the profile, with a course over it.
Along summed(const OverFlank& sums, const std::array<double, kProductCells>& profile) {
  Along all{};
  for (std::size_t u = 0; u < kProductCells; ++u) {
    if (profile[u] == 0.0) continue;
    for (std::size_t v = 0; v < kProductCells; ++v)
      all[v] += {profile[u] * profile[u] * sums[u][v].weight, profile[u] * sums[u][v].value};
  }
  return all;
}

/// Of flanks as a form acts on them: one way.
Projection together(const std::array<Projection, 2>& sides, const FlankWay& way) {
  return {way.signs[0] * sides[0].product + way.signs[1] * sides[1].product,
          way.signs[0] * way.signs[0] * sides[0].square +
              way.signs[1] * way.signs[1] * sides[1].square};
}

/// Two courses, and what their product takes out: as it is the same on every tooth, and at most,
/// with a size of its own on every few teeth.
struct Pair {
  std::size_t profile = 0, face = 0, way = 0;
  double alike = 0.0, at_most = 0.0;
};

std::vector<Pair> pairs_of(const OfTeeth& teeth, const std::vector<CourseInCells>& profiles,
                           const std::vector<CourseInCells>& faces,
                           const std::array<FlankWay, 4>& ways) {
  const OfGroups groups = in_groups(teeth);
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < profiles.size(); ++p) {
    std::array<std::array<Along, 2>, kGroups> over_profile;
    for (std::size_t k = 0; k < kGroups; ++k)
      for (const std::size_t side : {0U, 1U})
        over_profile[k][side] = summed(groups[k][side], profiles[p].values);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::array<std::array<Projection, 2>, kGroups> own;
      for (std::size_t k = 0; k < kGroups; ++k)
        for (const std::size_t side : {0U, 1U})
          own[k][side] = projected(over_profile[k][side], faces[f].values, false);
      for (std::size_t w = 0; w < ways.size(); ++w) {
        Pair pair{p, f, w};
        Projection all;
        for (const auto& sides : own) {
          const Projection one = together(sides, ways[w]);
          pair.at_most += gain_of(one);
          all.product += one.product;
          all.square += one.square;
        }
        pair.alike = gain_of(all);
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

/// Levels, slopes and bows over profile and face, as names have them: of the flanks of one side.
struct SumsOfNames {
  static constexpr int kCourses = 5;
  using Vector = Eigen::Matrix<double, kCourses, 1>;
  Eigen::LDLT<Eigen::Matrix<double, kCourses, kCourses>> solver;
  Vector right = Vector::Zero(), solved = Vector::Zero();

  [[nodiscard]] static double coordinate(std::size_t cell) {
    return 2.0 * (static_cast<double>(cell) + 0.5) / kProductCells - 1.0;
  }
  [[nodiscard]] static Vector at(std::size_t u, std::size_t v) {
    const double x = coordinate(u), y = coordinate(v);
    return Vector(1.0, x, x * x, y, y * y);
  }
  explicit SumsOfNames(const OverFlank& sums) {
    Eigen::Matrix<double, kCourses, kCourses> normal =
        1e-9 * Eigen::Matrix<double, kCourses, kCourses>::Identity();
    for (std::size_t u = 0; u < kProductCells; ++u)
      for (std::size_t v = 0; v < kProductCells; ++v) {
        const Vector courses = at(u, v);
        normal += sums[u][v].weight * courses * courses.transpose();
        right += sums[u][v].value * courses;
      }
    solver.compute(normal);
    solved = solver.solve(right);
  }
  /// Squares that they take out.
  [[nodiscard]] double square() const { return right.dot(solved); }
  /// What a form takes out beside them, of its own and its products with them.
  [[nodiscard]] Projection beside(const Projection& own, const Vector& products) const {
    return {own.product - products.dot(solved), own.square - products.dot(solver.solve(products))};
  }
};

/// Pairs of courses as they are the same on every tooth, beside names.
std::vector<Pair> pairs_beside_names(const std::array<OverFlank, 2>& mean,
                                     const std::array<SumsOfNames, 2>& names,
                                     const std::vector<CourseInCells>& profiles,
                                     const std::vector<CourseInCells>& faces,
                                     const std::array<FlankWay, 4>& ways) {
  constexpr double kAnything = 1e-3;  // of a form's square: less is a sum of names
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < profiles.size(); ++p) {
    std::array<Along, 2> over_profile;
    // Of the course times 1, x and x squared.
    std::array<std::array<std::array<double, kProductCells>, 3>, 2> weights{};
    for (const std::size_t side : {0U, 1U}) {
      over_profile[side] = summed(mean[side], profiles[p].values);
      for (std::size_t u = 0; u < kProductCells; ++u) {
        const double at = profiles[p].values[u], x = SumsOfNames::coordinate(u);
        if (at == 0.0) continue;
        for (std::size_t v = 0; v < kProductCells; ++v) {
          const double weight = at * mean[side][u][v].weight;
          weights[side][0][v] += weight;
          weights[side][1][v] += weight * x;
          weights[side][2][v] += weight * x * x;
        }
      }
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::array<Projection, 2> sides;
      for (const std::size_t side : {0U, 1U}) {
        SumsOfNames::Vector products = SumsOfNames::Vector::Zero();
        for (std::size_t v = 0; v < kProductCells; ++v) {
          const double at = faces[f].values[v], y = SumsOfNames::coordinate(v);
          products += at * SumsOfNames::Vector(weights[side][0][v], weights[side][1][v],
                                               weights[side][2][v], weights[side][0][v] * y,
                                               weights[side][0][v] * y * y);
        }
        const Projection own = projected(over_profile[side], faces[f].values, false);
        sides[side] = names[side].beside(own, products);
        if (!(sides[side].square > kAnything * own.square)) sides[side] = {};
      }
      for (std::size_t w = 0; w < ways.size(); ++w)
        pairs.push_back({p, f, w, gain_of(together(sides, ways[w])), 0.0});
    }
  }
  return pairs;
}

/// The best few of every two kinds of courses.
std::vector<Pair> best_pairs(std::vector<Pair> pairs, const std::vector<CourseInCells>& profiles,
                             const std::vector<CourseInCells>& faces) {
  constexpr std::size_t kMost = 48, kOfAKind = 2;
  std::erase_if(pairs, [&](const Pair& pair) {
    return profiles[pair.profile].course.kind == FlankCourse::kWhole ||
           faces[pair.face].course.kind == FlankCourse::kWhole;
  });
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.at_most > b.at_most; });
  std::map<std::array<std::size_t, 3>, std::size_t> of_a_kind;
  std::vector<Pair> best;
  for (const Pair& pair : pairs) {
    if (best.size() == kMost || pair.at_most < kNearly * pairs.front().at_most) break;
    const std::array kinds{static_cast<std::size_t>(profiles[pair.profile].course.kind),
                           static_cast<std::size_t>(faces[pair.face].course.kind), pair.way};
    if (++of_a_kind[kinds] <= kOfAKind) best.push_back(pair);
  }
  return best;
}

/// Pairs of which both run: the likeliest, as the same on every tooth. Where a course in one
/// direction alone says nearly as much there is none; a band times a band is a dish, and a
/// polynomial times a polynomial grows over profile and face (unnamed_product).
std::vector<Likely> likeliest_of(const FlankGeometry& g, const std::vector<Pair>& pairs,
                                 const std::vector<CourseInCells>& profiles,
                                 const std::vector<CourseInCells>& faces,
                                 const std::array<FlankWay, 4>& ways) {
  constexpr double kMore = 1.05;
  const auto is = [](const CourseInCells& course, FlankCourse::Kind kind) {
    return course.course.kind == kind;
  };
  const auto is_crossed = [&](const Pair& pair) {
    return !is(profiles[pair.profile], FlankCourse::kWhole) &&
           !is(faces[pair.face], FlankCourse::kWhole);
  };
  double most = 0.0, most_of_one = 0.0;
  for (const Pair& pair : pairs) {
    double& of_these = is_crossed(pair) ? most : most_of_one;
    of_these = std::max(of_these, pair.alike);
  }
  const double least = std::max(kNearly * most, kMore * most_of_one);
  std::vector<Likely> forms;
  for (const Pair& pair : pairs) {
    const bool dish =
        is(profiles[pair.profile], FlankCourse::kBand) && is(faces[pair.face], FlankCourse::kBand);
    const bool free = profiles[pair.profile].course.is_of_free_form(g, 0.0) &&
                      faces[pair.face].course.is_of_free_form(g, 1.0);
    if (is_crossed(pair) && pair.alike > least && !dish && !free)
      forms.push_back(
          {pair.alike,
           {find_family("unnamed_crossed"), ways[pair.way].flank,
            shape_of(profiles[pair.profile].course, faces[pair.face].course, ways[pair.way])}});
  }
  return forms;
}

/// Of traces: the best course over the profile times the best over the face, where both go around
/// the gear in one way: a place of the flank that traces in both directions cross.
std::vector<Likely> crossed_of(const std::vector<Likely>& forms) {
  constexpr std::size_t kFace = FlankCourse::kValues, kOpposite = 2 * FlankCourse::kValues;
  struct Best {
    const Likely* profile = nullptr;
    const Likely* face = nullptr;
  };
  std::map<std::pair<FlankChoice, EffectShape>, Best> of_a_way;
  for (const Likely& one : forms) {
    if (one.form.family == nullptr) continue;
    const EffectShape& shape = one.form.shape;
    const auto opposite = shape.begin() + static_cast<std::ptrdiff_t>(kOpposite);
    Best& best = of_a_way[{one.form.flank, EffectShape(opposite, shape.end())}];
    const Likely*& along =
        FlankCourse::at(shape, 0).kind != FlankCourse::kWhole ? best.profile : best.face;
    if (along == nullptr || along->gain < one.gain) along = &one;
  }
  std::vector<Likely> crossed;
  for (const auto& [way, best] : of_a_way) {
    if (best.profile == nullptr || best.face == nullptr) continue;
    crossed.push_back({best.profile->gain + best.face->gain, best.profile->form});
    FlankCourse::at(best.face->form.shape, kFace).put_in(crossed.back().form.shape, kFace);
  }
  return crossed;
}

constexpr std::size_t kKindsOfAll = 4, kKindsOfAWay = 2;

}  // namespace
}  // namespace product_cells

struct LikeliestProducts::Cells {
  Cells(const FlankGeometry& g, const Observations& table, const Patches& patches,
        const std::vector<float>& row_um)
      : geometry(g),
        scan(!table.points_mm.empty()),
        teeth(product_cells::sums_of(g, table, patches, row_um)),
        profiles(product_cells::in_cells(g, 0.0)),
        faces(product_cells::in_cells(g, 1.0)),
        ways(product_cells::flank_ways(g)) {
    product_cells::CourseInCells whole;
    whole.values.fill(1.0);
    profiles.push_back(whole);
    faces.push_back(whole);
  }

  const FlankGeometry& geometry;
  bool scan;
  product_cells::OfTeeth teeth;
  std::vector<product_cells::CourseInCells> profiles, faces;  ///< the last of each is whole
  std::array<product_cells::FlankWay, 4> ways;
};

LikeliestProducts::LikeliestProducts(const FlankGeometry& geometry, const Observations& table,
                                     const Patches& patches, const std::vector<float>& row_um)
    : cells_(std::make_shared<const Cells>(geometry, table, patches, row_um)) {}

double LikeliestProducts::square() const {
  double square = 0.0;
  for (const auto& tooth : cells_->teeth)
    for (const product_cells::OfFlank& flank : tooth) square += flank.square;
  return square;
}

std::vector<LikelyForms> LikeliestProducts::same_on_every_tooth() const {
  using namespace product_cells;
  const auto& [g, scan, teeth, profiles, faces, ways] = *cells_;
  if (!scan) return {};
  return best_of(likeliest_of(g, pairs_of(teeth, profiles, faces, ways), profiles, faces, ways),
                 kKindsOfAll);
}

LikeliestProducts::BesideNames LikeliestProducts::beside_names() const {
  using namespace product_cells;
  const auto& [g, scan, teeth, profiles, faces, ways] = *cells_;
  if (!scan) return {};
  std::array<OverFlank, 2> mean{};
  for (const auto& group : in_groups(teeth))
    for (const std::size_t side : {0U, 1U})
      for (std::size_t u = 0; u < kProductCells; ++u)
        for (std::size_t v = 0; v < kProductCells; ++v) mean[side][u][v] += group[side][u][v];
  const std::array names{SumsOfNames(mean[0]), SumsOfNames(mean[1])};
  const std::vector<Pair> pairs = pairs_beside_names(mean, names, profiles, faces, ways);
  return {best_of(likeliest_of(g, pairs, profiles, faces, ways), kKindsOfAll),
          square() - names[0].square() - names[1].square()};
}

std::vector<LikelyForms> LikeliestProducts::around_the_gear() const {
  using namespace product_cells;
  // (lambdas capture no structured bindings)
  const FlankGeometry& g = cells_->geometry;
  const bool scan = cells_->scan;
  const auto& teeth = cells_->teeth;
  const auto &profiles = cells_->profiles, &faces = cells_->faces;
  const auto& ways = cells_->ways;
  const Arounds arounds = arounds_of(g);
  const auto likely = [&](const FlankCourse& profile, const FlankCourse& face, const FlankWay& way,
                          const auto& projection) {
    std::vector<Projection> of_teeth;
    for (const auto& tooth : teeth)
      of_teeth.push_back(together({projection(tooth[0]), projection(tooth[1])}, way));
    return best_around(g, arounds, of_teeth, way.flank, shape_of(profile, face, way));
  };
  std::vector<Likely> forms;
  double most_of_whole_flanks = 0.0;
  for (const FlankWay& way : ways) {
    for (const CourseInCells& course : profiles) {
      const Likely one = likely(course.course, {}, way, [&](const OfFlank& flank) {
        return projected(flank.profile, course.values, !scan);
      });
      if (course.course.kind == FlankCourse::kWhole)
        most_of_whole_flanks = std::max(most_of_whole_flanks, one.gain);
      else
        forms.push_back(one);
    }
    for (const CourseInCells& course : faces)
      if (course.course.kind != FlankCourse::kWhole)
        forms.push_back(likely({}, course.course, way, [&](const OfFlank& flank) {
          return projected(flank.face, course.values, !scan);
        }));
  }
  if (scan)
    for (const Pair& pair : best_pairs(pairs_of(teeth, profiles, faces, ways), profiles, faces))
      forms.push_back(likely(profiles[pair.profile].course, faces[pair.face].course, ways[pair.way],
                             [&](const OfFlank& flank) {
                               return projected(summed(flank.both, profiles[pair.profile].values),
                                                faces[pair.face].values, false);
                             }));
  // Where whole flanks that stand out on some teeth say nearly as much there is no course.
  constexpr double kMore = 1.05;
  std::erase_if(forms, [&](const Likely& one) {
    return one.form.family == nullptr || one.gain < kMore * most_of_whole_flanks;
  });
  if (!scan)
    for (Likely& crossed : crossed_of(forms)) forms.push_back(std::move(crossed));
  return best_of(std::move(forms), kKindsOfAWay);
}

std::vector<LikelyForms> LikeliestProducts::steps(double face, bool beside_names) const {
  return product_cells::likeliest_steps(cells_->geometry, cells_->teeth, face, beside_names);
}

std::vector<LikelyForms> LikeliestProducts::jumps(double face, bool beside_names) const {
  return product_cells::likeliest_jumps(cells_->geometry, cells_->teeth, face, beside_names);
}

std::vector<LikelyForms> LikeliestProducts::stairs(double face, bool beside_names) const {
  return product_cells::likeliest_stairs(cells_->geometry, cells_->teeth, face, beside_names);
}

std::vector<LikelyForms> LikeliestProducts::waves() const {
  const auto& [g, scan, teeth, profiles, faces, ways] = *cells_;
  return product_cells::likeliest_waves(g, teeth, profiles, faces, product_cells::arounds_of(g),
                                        scan);
}

std::vector<LikelyForms> LikeliestProducts::growing_waves(int face) const {
  constexpr double kFewestWaves = 2.0, kApart_deg = 15.0;
  constexpr int kMostOften = 3;  // a turn
  const FlankGeometry& g = cells_->geometry;
  std::vector<gear_effects::AroundCourse> courses;
  for (int first = 1; first <= g.teeth(); ++first)
    for (const auto kind : {gear_effects::AroundCourse::kRamp, gear_effects::AroundCourse::kFade})
      courses.push_back({kind, deg_from_rad(g.centre_rad(first))});
  for (int order = 1; order <= kMostOften && 4 * order <= g.teeth(); ++order)
    for (double at = 0.0; at < 360.0 / order; at += kApart_deg / order)
      courses.push_back({gear_effects::AroundCourse::kComesAndGoes, at, 180.0 / order});
  return product_cells::likeliest_waves_by(g, cells_->teeth, face, kFewestWaves, courses);
}

std::vector<LikelyForms> LikeliestProducts::combs(int face) const {
  using namespace product_cells;
  constexpr double kFewestWaves = 1.25;
  const FlankGeometry& g = cells_->geometry;
  const Arounds combs = combs_around(g);
  std::vector<Likely> forms;
  for (const FlankWay& way : cells_->ways)
    for (const CourseInCells& course : face == 0 ? cells_->profiles : cells_->faces) {
      if (course.course.kind == FlankCourse::kWhole) continue;
      std::vector<Projection> of_teeth;
      for (const auto& tooth : cells_->teeth) {
        std::array<Projection, 2> sides;
        for (const std::size_t side : {0U, 1U})
          sides[side] = projected(face == 0 ? tooth[side].profile : tooth[side].face, course.values,
                                  !cells_->scan);
        of_teeth.push_back(together(sides, way));
      }
      Likely one = best_around(
          g, combs, of_teeth, way.flank,
          face == 0 ? shape_of(course.course, {}, way) : shape_of({}, course.course, way));
      if (one.form.family != nullptr) forms.push_back(std::move(one));
    }
  std::vector<LikelyForms> lists = best_of(std::move(forms), kKindsOfAll);
  for (LikelyForms& likely : lists)
    for (Effect& form : likely.forms) form = gear_effects::as_plain_comb(g, form);
  for (LikelyForms& waves : likeliest_waves_by(g, cells_->teeth, face, kFewestWaves, combs.courses))
    lists.push_back(std::move(waves));
  return lists;
}

LikelyWavesBeside LikeliestProducts::profile_waves(
    const std::vector<std::vector<Effect>>& besides) const {
  return product_cells::likeliest_profile_waves(cells_->geometry, cells_->teeth, besides);
}

std::vector<LikelyForms> LikeliestProducts::of_order(const OrderAsked& asked) const {
  const auto& [g, scan, teeth, profiles, faces, ways] = *cells_;
  return product_cells::likeliest_orders(g, teeth, profiles, faces, scan, asked);
}

}  // namespace trueflank::loop
