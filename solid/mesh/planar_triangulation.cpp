// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/mesh/planar_triangulation.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

double twice_area(const Point2& a, const Point2& b, const Point2& c) {
  return cross(b - a, c - a);
}

/// The polygon as a ring of corners from which ears are cut.
class EarClipper {
 public:
  EarClipper(const std::vector<Point2>& points, const std::vector<std::uint32_t>& polygon)
      : points_(points), vertex_(polygon) {
    const auto n = static_cast<int>(polygon.size());
    next_.resize(polygon.size());
    previous_.resize(polygon.size());
    for (int i = 0; i < n; ++i) {
      next_[at(i)] = (i + 1) % n;
      previous_[at(i)] = (i + n - 1) % n;
    }
    for (int i = 0; i < n; ++i)
      if (!convex(i)) reflex_.push_back(i);
  }

  std::vector<IndexTriangle> run() {
    std::vector<IndexTriangle> triangles;
    auto left = static_cast<int>(vertex_.size());
    triangles.reserve(vertex_.size());
    int corner = 0, passed = 0;
    while (left > 3) {
      if (is_ear(corner)) {
        triangles.push_back(cut(corner));
        --left;
        passed = 0;
        corner = next_[at(next_[at(corner)])];
      } else {
        TRUEFLANK_EXPECTS(++passed <= left);
        corner = next_[at(corner)];
      }
    }
    triangles.push_back(triangle(corner));
    return triangles;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] const Point2& point(int i) const { return points_[vertex_[at(i)]]; }
  [[nodiscard]] bool convex(int i) const {
    return twice_area(point(previous_[at(i)]), point(i), point(next_[at(i)])) > 0.0;
  }
  [[nodiscard]] IndexTriangle triangle(int i) const {
    return {vertex_[at(previous_[at(i)])], vertex_[at(i)], vertex_[at(next_[at(i)])]};
  }
  [[nodiscard]] bool is_ear(int i) const {
    if (!convex(i)) return false;
    const IndexTriangle t = triangle(i);
    const Point2 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    for (int r : reflex_) {
      const std::uint32_t v = vertex_[at(r)];
      if (v == t[0] || v == t[1] || v == t[2]) continue;
      const Point2& p = points_[v];
      if (twice_area(a, b, p) >= 0.0 && twice_area(b, c, p) >= 0.0 && twice_area(c, a, p) >= 0.0)
        return false;
    }
    return true;
  }
  IndexTriangle cut(int i) {
    const IndexTriangle t = triangle(i);
    const int before = previous_[at(i)], after = next_[at(i)];
    next_[at(before)] = after;
    previous_[at(after)] = before;
    std::erase_if(reflex_, [&](int r) { return r == i || r == before || r == after; });
    for (int r : {before, after})
      if (!convex(r)) reflex_.push_back(r);
    return t;
  }

  const std::vector<Point2>& points_;
  const std::vector<std::uint32_t>& vertex_;
  std::vector<int> next_, previous_, reflex_;
};

/// Triangles with their neighbours; edge e of a triangle runs from corner e to corner e + 1.
class Flipper {
 public:
  Flipper(const std::vector<Point2>& points, std::vector<IndexTriangle>& triangles)
      : points_(points), triangles_(triangles) {
    connect();
  }

  void run() {
    const auto n = static_cast<std::int32_t>(triangles_.size());
    for (std::int32_t t = 0; t < n; ++t)
      for (int e = 0; e < 3; ++e) pending_.push_back({t, e});
    // Each flip raises the triangulation towards Delaunay, so this ends; rounding must not undo that.
    std::size_t budget = 100 * triangles_.size() + 100 * triangles_.size() * triangles_.size() / 64;
    while (!pending_.empty() && budget > 0) {
      const auto [t, e] = pending_.back();
      pending_.pop_back();
      if (flip(t, e)) --budget;
    }
  }

 private:
  struct HalfEdge {
    std::int32_t triangle;
    int edge;
  };
  struct Neighbours {
    std::int32_t triangle[3] = {-1, -1, -1};
  };

  void connect() {
    struct Key {
      std::uint32_t low, high;
      HalfEdge side;
    };
    std::vector<Key> keys;
    keys.reserve(3 * triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (int e = 0; e < 3; ++e) {
        const auto owner = static_cast<std::int32_t>(t);
        const std::uint32_t a = corner(owner, e), b = corner(owner, e + 1);
        keys.push_back({std::min(a, b), std::max(a, b), {owner, e}});
      }
    std::sort(keys.begin(), keys.end(), [](const Key& p, const Key& q) {
      if (p.low != q.low) return p.low < q.low;
      if (p.high != q.high) return p.high < q.high;
      return p.side.triangle < q.side.triangle;
    });
    neighbours_.resize(triangles_.size());
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
      const Key &p = keys[i], &q = keys[i + 1];
      if (p.low != q.low || p.high != q.high) continue;
      neighbours_[index(p.side.triangle)].triangle[p.side.edge] = q.side.triangle;
      neighbours_[index(q.side.triangle)].triangle[q.side.edge] = p.side.triangle;
    }
  }

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::uint32_t corner(std::int32_t t, int e) const {
    return triangles_[index(t)][index(e % 3)];
  }
  [[nodiscard]] int edge_to(std::int32_t t, std::int32_t neighbour) const {
    const auto& n = neighbours_[index(t)].triangle;
    return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
  }

  /// The two angles that look at an edge add up to more than pi: the edge is not Delaunay.
  [[nodiscard]] bool bad(const Point2& a, const Point2& b, const Point2& c, const Point2& d) const {
    const Point2 ca = a - c, cb = b - c, da = a - d, db = b - d;
    const double sin_c = cross(ca, cb), cos_c = ca.dot(cb);
    const double sin_d = cross(db, da), cos_d = db.dot(da);
    const double sine_of_sum = sin_c * cos_d + cos_c * sin_d;
    const double scale = std::sqrt(ca.squaredNorm() * cb.squaredNorm()) *
                         std::sqrt(da.squaredNorm() * db.squaredNorm());
    return sine_of_sum < -1e-11 * scale && twice_area(d, b, c) > 0.0 && twice_area(c, a, d) > 0.0;
  }

  bool flip(std::int32_t t, int e) {
    const std::int32_t u = neighbours_[index(t)].triangle[e];
    if (u < 0) return false;
    const int f = edge_to(u, t);
    // t = (a, b, c) with e = ab; u = (b, a, d)
    const std::uint32_t a = corner(t, e), b = corner(t, e + 1), c = corner(t, e + 2);
    const std::uint32_t d = corner(u, f + 2);
    if (!bad(points_[a], points_[b], points_[c], points_[d])) return false;
    auto &nt = neighbours_[index(t)], &nu = neighbours_[index(u)];
    const std::int32_t t_bc = nt.triangle[(e + 1) % 3], t_ca = nt.triangle[(e + 2) % 3];
    const std::int32_t u_ad = nu.triangle[(f + 1) % 3], u_db = nu.triangle[(f + 2) % 3];
    triangles_[index(t)] = {d, b, c};
    triangles_[index(u)] = {c, a, d};
    nt = {{u_db, t_bc, u}};
    nu = {{t_ca, u_ad, t}};
    if (u_db >= 0) relink(u_db, u, t);
    if (t_ca >= 0) relink(t_ca, t, u);
    for (int i = 0; i < 2; ++i) {
      pending_.push_back({t, i});
      pending_.push_back({u, i});
    }
    return true;
  }
  void relink(std::int32_t t, std::int32_t from, std::int32_t to) {
    neighbours_[index(t)].triangle[edge_to(t, from)] = to;
  }

  const std::vector<Point2>& points_;
  std::vector<IndexTriangle>& triangles_;
  std::vector<Neighbours> neighbours_;
  std::vector<HalfEdge> pending_;
};

}  // namespace

std::vector<IndexTriangle> clip_ears(const std::vector<Point2>& points,
                                     const std::vector<std::uint32_t>& polygon) {
  TRUEFLANK_EXPECTS(polygon.size() >= 3);
  return EarClipper(points, polygon).run();
}

void make_delaunay(const std::vector<Point2>& points, std::vector<IndexTriangle>& triangles) {
  Flipper(points, triangles).run();
}

}  // namespace trueflank
