// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/screw_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/solid/random_part.h"

// Nets by trying all ways of joining their vertices, and bounds by looking at many places.
namespace trueflank {
namespace {

TEST(TriangleError, IsTheLargestDistanceOfTheParaboloid) {
  test::RandomNumbers random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const double a = random.between(-1.0, 1.0), b = random.between(-1.0, 1.0),
                 c = random.between(-1.0, 1.0);
    // 0 at the corners, a, b, c in the middles of the edges
    double largest = 0.0;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; i + k <= kSteps; ++k) {
        const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(k) / kSteps,
                     w = 1.0 - u - v;
        largest = std::max(largest, std::abs(4.0 * (a * u * v + b * v * w + c * w * u)));
      }
    const double error = triangle_error(a, b, c);
    EXPECT_GE(error, largest - 1e-12) << a << ' ' << b << ' ' << c;
    EXPECT_LE(error, largest + 2e-3) << a << ' ' << b << ' ' << c;
  }
  EXPECT_DOUBLE_EQ(triangle_error(1.0, 1.0, 1.0), 4.0 / 3.0);  // equilateral: by symmetry
  EXPECT_DOUBLE_EQ(triangle_error(-1.0, -1.0, -1.0), 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(triangle_error(1.0, 1.0, 2.0), 2.0);  // rectangular
  EXPECT_DOUBLE_EQ(triangle_error(1.0, -1.0, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(triangle_error(0.0, 0.0, 0.0), 0.0);
}

/// A vertex of one of two chains.
struct Vertex {
  NetNode node;
  double along = 0.0, support = 0.0;
};
using Chain = std::vector<Vertex>;
using Error = std::function<double(const Vertex&, const Vertex&, const Vertex&)>;

double fourth(double e) { return e * e * e * e; }

double widest_step(const Chain& chain) {
  double widest = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i)
    widest = std::max(widest, std::abs(chain[i].along - chain[i - 1].along));
  return widest;
}

/// The least sum of fourth powers of all ways to join two chains from (i, k) on, but for those that
/// join vertices more than one and a half of the widest steps apart; at their ends chains may be.
double least(const Chain& left, const Chain& right, const Error& error, std::size_t i = 0,
             std::size_t k = 0) {
  const double apart = std::abs(left[i].along - right[k].along),
               reach = 1.5 * std::max(widest_step(left), widest_step(right));
  const bool at_end = (i == 0 && right[k].along <= left[i].along) ||
                      (i + 1 == left.size() && right[k].along >= left[i].along);
  if (apart > reach && !at_end) return std::numeric_limits<double>::infinity();
  if (i + 1 == left.size() && k + 1 == right.size()) return 0.0;
  double best = std::numeric_limits<double>::infinity();
  if (i + 1 < left.size())
    best = fourth(error(left[i], right[k], left[i + 1])) + least(left, right, error, i + 1, k);
  if (k + 1 < right.size())
    best = std::min(
        best, fourth(error(left[i], right[k], right[k + 1])) + least(left, right, error, i, k + 1));
  return best;
}

/// The same of the facets that a net has of a region.
double sum_of(const NetPatch& net, int region, const Chain& all, const Error& error) {
  const auto vertex = [&](const NetNode& node) {
    return *std::find_if(all.begin(), all.end(), [&](const Vertex& v) {
      return v.node.column == node.column && v.node.row == node.row;
    });
  };
  double sum = 0.0;
  for (std::size_t t = 0; t < net.facets.size(); ++t)
    if (net.region[t] == region)
      sum += fourth(
          error(vertex(net.facets[t][0]), vertex(net.facets[t][1]), vertex(net.facets[t][2])));
  return sum;
}

std::vector<double> random_heights(test::RandomNumbers& random, int count) {
  std::vector<double> heights;
  for (int k = 0; k < count; ++k)
    heights.push_back((k + random.between(0.3, 0.7) + 0.5) / (count + 1.0));
  return heights;
}

double height_of(const std::vector<double>& inner, int row) {
  const auto k = static_cast<std::size_t>(row);
  return k == 0 ? 0.0 : k > inner.size() ? 1.0 : inner[k - 1];
}

Chain column_of(int column, const std::vector<double>& inner) {
  Chain chain;
  for (int row = 0; row <= static_cast<int>(inner.size()) + 1; ++row)
    chain.push_back({{column, row}, height_of(inner, row), 0.0});
  return chain;
}

TEST(ScrewNet, JoinsNeighbouringColumnsTheBestOfAllWays) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    test::RandomNumbers random(seed);
    // saddles, domes and radial flanks, each a region of one edge
    const NetEdge e{.region = 0,
                    .length_mm = random.between(0.1, 1.0),
                    .turn_rad = seed % 5 == 0 ? 0.0 : random.between(-0.5, 0.5),
                    .support_mm = random.between(-4.0, 4.0),
                    .cosine = random.between(0.5, 1.0)};
    const double turn = random.between(-0.6, 0.6);
    const std::vector<std::vector<double>> inner{
        random_heights(random, static_cast<int>(seed % 4)),
        random_heights(random, static_cast<int>(seed % 5))};
    NetEdge other = e;
    other.region = 1;
    const NetPatch net = net_patch({e, other}, inner, turn);
    EXPECT_EQ(net.inner, inner);
    for (const int i : {0, 1}) {
      const Chain left = column_of(i, inner[static_cast<std::size_t>(i)]),
                  right = column_of(i + 1, inner[static_cast<std::size_t>(1 - i)]);
      // Q = (kappa ds^2 + 2 ds dtau + (p.n) dtau^2) c, an edge is off by an eighth of it
      const auto off = [&](const Vertex& a, const Vertex& b) {
        const double ds = e.length_mm * (b.node.column - a.node.column);
        const double tau = turn * (b.along - a.along);
        return e.cosine / 8.0 *
               (e.turn_rad / e.length_mm * ds * ds + 2.0 * ds * tau + e.support_mm * tau * tau);
      };
      const Error error = [&](const Vertex& a, const Vertex& b, const Vertex& c) {
        return triangle_error(off(a, b), off(b, c), off(c, a));
      };
      Chain all = left;
      all.insert(all.end(), right.begin(), right.end());
      const double best = least(left, right, error);
      EXPECT_NEAR(sum_of(net, i, all, error), best, 1e-9 * best) << seed;
    }
  }
}

TEST(ScrewNet, JoinsFlanksTheBestOfAllWaysAlongTheirGenerators) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    test::RandomNumbers random(seed);
    const int columns = 1 + static_cast<int>(seed % 4);
    const double turn = (seed % 2 == 0 ? 1.0 : -1.0) * random.between(0.1, 0.6),
                 sense = seed % 4 < 2 ? 1.0 : -1.0;
    std::vector<NetEdge> edges;
    double support = random.between(2.0, 3.0);
    for (int i = 0; i < columns; ++i) {
      const double next = support + random.between(0.2, 0.6);
      edges.push_back({.region = 0,
                       .developable = true,
                       .length_mm = random.between(0.1, 1.0),
                       .turn_rad = sense * random.between(0.1, 0.2),
                       .support_mm = 0.5 * (support + next),
                       .support_from_mm = support,
                       .support_to_mm = next,
                       .cosine = 0.9});
      support = next;
    }
    edges.push_back({.region = 1, .length_mm = 0.3, .turn_rad = 0.1, .support_mm = 3.0});
    std::vector<std::vector<double>> inner(edges.size());
    inner[0] = random_heights(random, 2 + static_cast<int>(seed % 4));
    inner[static_cast<std::size_t>(columns)] =
        random_heights(random, 1 + static_cast<int>(seed % 5));
    const NetPatch net = net_patch(edges, inner, turn);
    // both ways round the border, from the corner of least angle to the one of largest
    const auto vertex = [&](int column, int row) {
      double angle = turn * height_of(inner[static_cast<std::size_t>(column)], row);
      for (int i = 0; i < column; ++i) angle += edges[static_cast<std::size_t>(i)].turn_rad;
      const double at = column < columns
                            ? edges[static_cast<std::size_t>(column)].support_from_mm
                            : edges[static_cast<std::size_t>(columns) - 1].support_to_mm;
      return Vertex{{column, row}, angle, at};
    };
    const auto top = [&](int column) {
      return static_cast<int>(inner[static_cast<std::size_t>(column)].size()) + 1;
    };
    Chain lower, upper, first, last;
    for (int i = 0; i <= columns; ++i) {
      lower.push_back(vertex(i, 0));
      upper.push_back(vertex(i, top(i)));
    }
    for (int row = 1; row < top(0); ++row) first.push_back(vertex(0, row));
    for (int row = 1; row < top(columns); ++row) last.push_back(vertex(columns, row));
    const auto way = [](std::initializer_list<Chain> parts) {
      Chain chain;
      for (const Chain& part : parts) chain.insert(chain.end(), part.begin(), part.end());
      return chain;
    };
    const auto back = [](Chain chain) {
      std::reverse(chain.begin(), chain.end());
      return chain;
    };
    const bool along = sense * turn > 0.0;
    const Chain left =
        along ? way({{lower.front()}, first, upper}) : way({back(lower), first, {upper.front()}});
    const Chain right =
        along ? way({lower, last, {upper.back()}}) : way({{lower.back()}, last, back(upper)});
    const auto off = [&](const Vertex& a, const Vertex& b) {
      const double angle = b.along - a.along;
      return 0.9 / 8.0 * 0.5 * (a.support + b.support) * angle * angle;
    };
    const Error error = [&](const Vertex& a, const Vertex& b, const Vertex& c) {
      return std::max({off(a, b), off(b, c), off(c, a)});
    };
    // the first and the last facet are those of the corners
    const Chain inner_left(left.begin() + 1, left.end() - 1),
        inner_right(right.begin() + 1, right.end() - 1);
    const double best = least(inner_left, inner_right, error) +
                        fourth(error(left[0], right[1], left[1])) +
                        fourth(error(inner_left.back(), inner_right.back(), left.back()));
    EXPECT_NEAR(sum_of(net, 0, way({lower, upper, first, last}), error), best, 1e-9 * best) << seed;
  }
}

TEST(ScrewNet, OfOneRegionAllAroundBeginsAtItsFirstEdge) {
  const std::vector<NetEdge> edges(
      3, {.region = 0, .length_mm = 0.5, .turn_rad = 0.2, .support_mm = 2.0});
  const NetPatch net = net_patch(edges, {{}, {}, {}}, 0.1);
  EXPECT_EQ(net.facets.size(), 6u);
  EXPECT_EQ(net.region, std::vector<int>(6, 0));
}

}  // namespace
}  // namespace trueflank
