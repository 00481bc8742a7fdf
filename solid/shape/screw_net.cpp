// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/solid/shape/screw_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"

namespace trueflank {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
/// Vertices farther apart along the chains than so many of their widest steps are never joined.
constexpr double kReach = 1.5;
/// The same along a strip that is joined from edge to edge: its facets may lean.
constexpr double kReachAcross = 4.0;
/// Strips with no more edges are joined in every way, and the best one taken.
constexpr int kNarrow = 6;

/// A corner whose angle lies farther out than this share of a strip's is where it ends.
constexpr double kBeyond = 0.05;
/// The same of its widest step.
constexpr double kBeyondStep = 0.5;
/// Vertices of a row between strips are as near to its height, as a share of the patch.
constexpr double kSameHeight = 1e-9;

/// A vertex on one of two chains, with its place along them.
struct Link {
  NetNode node;
  double along = 0.0;    ///< what both chains ascend in
  double support = 0.0;  ///< of a developable surface
  NetPoint point = {};   ///< where the surface is known by points
};
using Chain = std::vector<Link>;

double widest_step(const Chain& chain) {
  double widest = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i)
    widest = std::max(widest, chain[i].along - chain[i - 1].along);
  return widest;
}

/// Triangles between a chain on the left and one on the right, each ending where the other does.
/// `error(a, b, c)` of a triangle of links.
template <class Error>
class Zip {
 public:
  Zip(const Chain& left, const Chain& right, const Error& error, double reach_steps = kReach)
      : left_(left), right_(right), error_(error) {
    const double reach = reach_steps * std::max(widest_step(left), widest_step(right));
    std::size_t cells = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto is_before = [](const Link& link, double along) { return link.along < along; };
      auto low = static_cast<std::size_t>(
          std::lower_bound(right.begin(), right.end(), left[i].along - reach, is_before) -
          right.begin());
      auto high = static_cast<std::size_t>(
          std::lower_bound(right.begin(), right.end(), left[i].along + reach, is_before) -
          right.begin());
      if (i == 0) low = 0;
      if (i + 1 == left.size()) high = right.size();
      low = std::min(low, right.size() - 1);
      rows_.push_back({low, std::max(high, low + 1), cells});
      cells += rows_.back().high - low;
    }
    cost_.assign(cells, kNoLimit);
    from_left_.assign(cells, false);
  }

  /// Sum of the fourth powers of the errors.
  double settle_all() {
    for (std::size_t i = 0; i < left_.size(); ++i)
      for (std::size_t j = rows_[i].low; j < rows_[i].high; ++j) settle(i, j);
    return cost_.back();
  }

  /// After settle_all(). Returns the largest error of these facets.
  double add_to(std::vector<std::array<NetNode, 3>>& facets) const {
    double largest = 0.0;
    const std::size_t begin = facets.size();
    std::size_t i = left_.size() - 1, j = right_.size() - 1;
    while (i > 0 || j > 0) {
      const bool step = j == 0 || (i > 0 && from_left_[cell(i, j)]);
      const Link& next = step ? left_[i] : right_[j];
      step ? --i : --j;
      facets.push_back({left_[i].node, right_[j].node, next.node});
      largest = std::max(largest, std::abs(error_(left_[i], right_[j], next)));
    }
    std::reverse(facets.begin() + static_cast<std::ptrdiff_t>(begin), facets.end());
    return largest;
  }

 private:
  struct Row {
    std::size_t low = 0, high = 0, first = 0;
  };
  [[nodiscard]] std::size_t cell(std::size_t i, std::size_t j) const {
    return rows_[i].first + j - rows_[i].low;
  }
  [[nodiscard]] double cost(std::size_t i, std::size_t j) const {
    return j < rows_[i].low || j >= rows_[i].high ? kNoLimit : cost_[cell(i, j)];
  }
  void settle(std::size_t i, std::size_t j) {
    const std::size_t here = cell(i, j);
    if (i == 0 && j == 0) {
      cost_[here] = 0.0;
      return;
    }
    const auto through = [&](double before, const Link& a, const Link& b, const Link& c) {
      if (before == kNoLimit) return kNoLimit;
      const double error = error_(a, b, c);
      return before + error * error * error * error;
    };
    const double by_left =
        i == 0 ? kNoLimit : through(cost(i - 1, j), left_[i - 1], right_[j], left_[i]);
    const double by_right =
        j == 0 ? kNoLimit : through(cost(i, j - 1), left_[i], right_[j - 1], right_[j]);
    from_left_[here] = by_left < by_right;
    cost_[here] = std::min(by_left, by_right);
  }

  const Chain &left_, &right_;
  const Error& error_;
  std::vector<Row> rows_;
  std::vector<double> cost_;
  std::vector<bool> from_left_;
};

/// A strip of a patch: of so many, the one that lies above so many others.
struct Level {
  int below = 0, strips = 1;
};

class PatchBuilder {
 public:
  PatchBuilder(const std::vector<NetEdge>& edges, std::vector<std::vector<double>> inner,
               double turn_rad, const NetSurface* surface, const NetRows* rows)
      : edges_(edges), turn_(turn_rad), surface_(surface), rows_(rows) {
    TRUEFLANK_EXPECTS(!edges.empty() && inner.size() == edges.size());
    result_.inner = std::move(inner);
  }

  NetPatch build() {
    const auto n = static_cast<int>(edges_.size());
    int first = 0;
    while (first < n && edge(first).region == edge(first + n - 1).region) ++first;
    for (int i = first; i < first + n;) {
      int end = i + 1;
      while (end < first + n && edge(end).region == edge(i).region) ++end;
      if (surface_ != nullptr)
        add_strip_of_surface(i, end);
      else if (edge(i).developable)
        add_plain_strips(i, end);
      else
        for (int k = i; k < end; ++k) add_band(k);
      result_.region.resize(result_.facets.size(), edge(i).region);
      i = end;
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] const NetEdge& edge(int i) const {
    return edges_[static_cast<std::size_t>(i) % edges_.size()];
  }
  [[nodiscard]] const std::vector<double>& inner(int column) const {
    return result_.inner[static_cast<std::size_t>(column) % edges_.size()];
  }
  [[nodiscard]] int last_row(int column) const {
    return static_cast<int>(inner(column).size()) + 1;
  }
  [[nodiscard]] double height(const NetNode& node) const {
    if (node.row == 0) return 0.0;
    return node.row == last_row(node.column)
               ? 1.0
               : inner(node.column)[static_cast<std::size_t>(node.row - 1)];
  }

  /// `column` lies between the edges `first` and before `last`.
  [[nodiscard]] NetPoint point(const NetNode& node, int last) const {
    if (surface_ == nullptr) return {};
    const bool at_end = node.column == last;
    return (*surface_)(at_end ? node.column - 1 : node.column, at_end, height(node));
  }
  /// Of the section's normal.
  static double angle_of(const NetPoint& p) { return std::atan2(p.normal.y(), p.normal.x()); }
  /// Of the middle of a chord, by the points and normals at its ends.
  static double off_chord(const Link& a, const Link& b) {
    return (b.point.normal - a.point.normal).dot(b.point.at - a.point.at) / 8.0;
  }

  /// Between two columns.
  void add_band(int i) {
    const NetEdge& e = edge(i);
    const auto chain = [&](int column) {
      Chain links;
      for (int row = 0; row <= last_row(column); ++row)
        links.push_back({{column, row}, height({column, row}), 0.0, {}});
      return links;
    };
    const auto off = [&](const Link& a, const Link& b) {
      const double ds = e.length_mm * (b.node.column - a.node.column);
      const double turn = turn_ * (b.along - a.along);
      return e.cosine / 8.0 *
             (e.turn_rad * e.length_mm * (ds != 0.0 ? 1.0 : 0.0) + 2.0 * ds * turn +
              e.support_mm * turn * turn);
    };
    const auto error = [&](const Link& a, const Link& b, const Link& c) {
      return triangle_error(off(a, b), off(b, c), off(c, a));
    };
    const Chain left = chain(i), right = chain(i + 1);
    Zip zip(left, right, error);
    zip.settle_all();
    zip.add_to(result_.facets);
  }

  [[nodiscard]] bool is_on(const std::vector<bool>& row, int column) const {
    return rows_ == nullptr || row[static_cast<std::size_t>(column) % edges_.size()];
  }
  static double error_of(const Link& a, const Link& b, const Link& c) {
    return triangle_error(off_chord(a, b), off_chord(b, c), off_chord(c, a));
  }

  /// The border of a strip, counter-clockwise from its lower left corner.
  struct Border {
    Chain loop;
    std::array<std::size_t, 4> corners{};  ///< lower left, lower right, upper right, upper left
    [[nodiscard]] Chain way(std::size_t from, std::size_t to) const {
      Chain chain;
      for (std::size_t k = from;; k = k + 1 < loop.size() ? k + 1 : 0) {
        chain.push_back(loop[k]);
        if (k == to) return chain;
      }
    }
    [[nodiscard]] Chain way_back(std::size_t from, std::size_t to) const {
      Chain chain = way(to, from);
      std::reverse(chain.begin(), chain.end());
      return chain;
    }
  };
  static constexpr int kNoRow = -1;
  /// The row of a column's vertex between two strips.
  [[nodiscard]] int row_of(int column, const Level& level) const {
    if (level.below == 0) return 0;
    if (level.below == level.strips) return last_row(column);
    const double at = static_cast<double>(level.below) / level.strips;
    const auto& heights = inner(column);
    for (std::size_t k = 0; k < heights.size(); ++k)
      if (std::abs(heights[k] - at) < kSameHeight) return static_cast<int>(k) + 1;
    return kNoRow;
  }
  [[nodiscard]] bool has_vertex(int column, const Level& level) const {
    if (level.below == 0) return is_on(rows_->lower, column);
    if (level.below == level.strips) return is_on(rows_->upper, column);
    return row_of(column, level) != kNoRow;
  }
  /// `along(column, height)` of its vertices.
  template <class Along>
  [[nodiscard]] Border border(int from, int to, const Along& along, const Level& strip = {}) const {
    Border result;
    const Level lower = strip, upper{strip.below + 1, strip.strips};
    const auto add = [&](int column, int row) {
      const NetNode node{column, row};
      result.loop.push_back({node, along(column, height(node)), 0.0, point(node, to)});
    };
    for (int i = from; i <= to; ++i)
      if (i == from || i == to || has_vertex(i, lower)) add(i, row_of(i, lower));
    result.corners[1] = result.loop.size() - 1;
    for (int row = row_of(to, lower) + 1; row < row_of(to, upper); ++row) add(to, row);
    result.corners[2] = result.loop.size();
    for (int i = to; i >= from; --i)
      if (i == from || i == to || has_vertex(i, upper)) add(i, row_of(i, upper));
    result.corners[3] = result.loop.size() - 1;
    for (int row = row_of(from, upper) - 1; row > row_of(from, lower); --row) add(from, row);
    return result;
  }

  /// Between two columns that have vertices inside the patch, or could have: whichever way of joining
  /// them has the least error.
  void add_strip_of_surface(int from, int to) {
    const bool inside = !inner(from).empty() || !inner(to).empty();
    const bool wide = to - from > kNarrow;
    if (edge(from).strips > 1) return add_strips_across(from, to);
    best_ = {};
    if (!inside || edge(from).across)
      join_across(from, to, inside);
    else if (!edge(from).developable)
      join_upwards(from, to);
    else {
      add_strips(from, to);
      if (!wide && best_.largest > rows_->tolerance_mm)
        join_upwards(from, to), join_across(from, to, inside);
    }
    result_.facets.insert(result_.facets.end(), best_.facets.begin(), best_.facets.end());
  }

  /// One above the other.
  void add_strips_across(int from, int to) {
    const int strips = edge(from).strips;
    for (int below = 0; below < strips; ++below) {
      best_ = {};
      const Level lower{below, strips}, upper{below + 1, strips};
      const auto has_side = [&](int column) {
        return row_of(column, upper) > row_of(column, lower) + 1;
      };
      join_across(from, to, has_side(from) || has_side(to), lower);
      result_.facets.insert(result_.facets.end(), best_.facets.begin(), best_.facets.end());
    }
  }

  /// From edge to edge of the patch.
  void join_across(int from, int to, bool inside, const Level& level = {}) {
    std::vector<double> way{0.0};
    for (int i = from; i < to; ++i) way.push_back(way.back() + edge(i).length_mm);
    const Border strip = border(from, to, [&](int column, double) {
      return way[static_cast<std::size_t>(column - from)];
    }, level);
    const auto [ll, lr, ur, ul] = strip.corners;
    const double reach = edge(from).in_chamfer ? kReach : kReachAcross;
    if (!inside) return join(strip.way_back(ul, ur), strip.way(ll, lr), reach);
    for (const std::size_t start : {ll, ul})
      for (const std::size_t end : {ur, lr}) join_corners(strip, start, end, reach);
  }

  /// From column to column.
  void join_upwards(int from, int to) {
    const Border strip = border(from, to, [](int, double height) { return height; });
    const auto [ll, lr, ur, ul] = strip.corners;
    if (lr == 1 && ul == ur + 1) return join(strip.way_back(ll, ul), strip.way(lr, ur), kReach);
    for (const std::size_t start : {ll, lr})
      for (const std::size_t end : {ur, ul}) join_corners(strip, start, end, kReach);
  }

  /// Both ways round a strip from one corner to another.
  void join_corners(const Border& strip, std::size_t start, std::size_t end, double reach_steps) {
    const Chain right = strip.way(start, end), left = strip.way_back(start, end);
    if (left.size() > 2 && right.size() > 2) join_ways(left, right, error_of, reach_steps);
  }

  /// Two chains with their first and last vertices in common.
  template <class Error>
  void join_ways(const Chain& left, const Chain& right, const Error& error, double reach_steps) {
    const Chain inner_left(left.begin() + 1, left.end() - 1),
        inner_right(right.begin() + 1, right.end() - 1);
    Zip zip(inner_left, inner_right, error, reach_steps);
    const auto fourth = [](double e) { return e * e * e * e; };
    const double cost = zip.settle_all() + fourth(error(left[0], right[1], left[1])) +
                        fourth(error(inner_left.back(), inner_right.back(), left.back()));
    if (!(cost < best_.cost) && !best_.facets.empty()) return;
    best_ = {cost, 0.0, {{left[0].node, right[1].node, left[1].node}}};
    best_.largest = std::max({zip.add_to(best_.facets), error(left[0], right[1], left[1]),
                              error(inner_left.back(), inner_right.back(), left.back())});
    best_.facets.push_back({inner_left.back().node, inner_right.back().node, left.back().node});
  }

  void join(const Chain& left, const Chain& right, double reach_steps) {
    Zip zip(left, right, error_of, reach_steps);
    const double cost = zip.settle_all();
    if (!(cost < best_.cost) && !best_.facets.empty()) return;
    best_.cost = cost;
    best_.facets.clear();
    zip.add_to(best_.facets);
  }

  /// The two ways round a strip's border from its corner of least angle to that of the largest,
  /// where these are not opposite (in chamfers strips are trapezia). Else leaves the chains as they
  /// are.
  static void split_at_ends(const Chain& loop, const std::array<std::size_t, 4>& corners,
                            Chain& left, Chain& right) {
    const auto lower = [&](std::size_t a, std::size_t b) { return loop[a].along < loop[b].along; };
    const auto [first, last] = std::minmax_element(corners.begin(), corners.end(), lower);
    const auto [start, end] = std::minmax(left.front().along, left.back().along);
    const double range = loop[*last].along - loop[*first].along;
    const double beyond = std::min(kBeyond * range, kBeyondStep * widest_step(loop));
    if (start - loop[*first].along <= beyond && loop[*last].along - end <= beyond) return;
    const std::size_t n = loop.size(), ahead = (*last + n - *first) % n;
    if (ahead < 2 || n - ahead < 2) return;  // no vertices on one of the ways
    Chain forwards, backwards;
    for (std::size_t k = 0; k <= ahead; ++k) forwards.push_back(loop[(*first + k) % n]);
    for (std::size_t k = 0; k <= n - ahead; ++k) backwards.push_back(loop[(*first + n - k) % n]);
    right = forwards, left = backwards;
  }

  void add_plain_strips(int from, int to) {
    best_ = {};
    add_strips(from, to);
    result_.facets.insert(result_.facets.end(), best_.facets.begin(), best_.facets.end());
  }

  /// Columns `from` to `to` of a developable surface. Both ways round its border the angle of the
  /// normal ascends (or descends), from one corner to the opposite one.
  void add_strips(int from, int to) {
    double angle = 0.0;
    Chain lower, upper, at_from, at_to;
    double first = 0.0, upwards = turn_;
    if (surface_ != nullptr) {
      first = angle_of(point({from, 0}, to));
      upwards = std::remainder(angle_of(point({from, last_row(from)}, to)) - first, kTwoPi);
    }
    const auto link = [&](int column, int row, double support) {
      const NetPoint on = point({column, row}, to);
      const double at = surface_ != nullptr ? std::remainder(angle_of(on) - first, kTwoPi)
                                            : angle + turn_ * height({column, row});
      return Link{{column, row}, at, support, on};
    };
    for (int i = from; i <= to; ++i) {
      const double support = i < to ? edge(i).support_from_mm : edge(i - 1).support_to_mm;
      const bool end = i == from || i == to;
      if (end || rows_ == nullptr || is_on(rows_->lower, i)) lower.push_back(link(i, 0, support));
      if (end || rows_ == nullptr || is_on(rows_->upper, i))
        upper.push_back(link(i, last_row(i), support));
      if (i == from || i == to)
        for (int row = 1; row < last_row(i); ++row)
          (i == from ? at_from : at_to).push_back(link(i, row, support));
      if (i < to) angle += edge(i).turn_rad;
    }
    if (surface_ != nullptr) angle = lower.back().along;
    const bool along = angle * upwards > 0.0;
    const auto reversed = [](Chain chain) {
      std::reverse(chain.begin(), chain.end());
      return chain;
    };
    const auto joined = [](Chain a, const Chain& b, const Chain& c) {
      a.insert(a.end(), b.begin(), b.end());
      a.insert(a.end(), c.begin(), c.end());
      return a;
    };
    // from the corner where both begin to the one where both end
    Chain left = along ? joined({lower.front()}, at_from, upper)
                       : joined(reversed(lower), at_from, {upper.front()});
    Chain right = along ? joined(lower, at_to, {upper.back()})
                        : joined({lower.back()}, at_to, reversed(upper));
    Chain loop;
    std::array<std::size_t, 4> corners{};
    if (surface_ != nullptr) {
      loop = joined(lower, at_to, reversed(upper));
      corners = {0, lower.size() - 1, lower.size() + at_to.size(), loop.size() - 1};
      const Chain back = reversed(at_from);
      loop.insert(loop.end(), back.begin(), back.end());
      split_at_ends(loop, corners, left, right);
    }
    const double sense = left.back().along < left.front().along ? -1.0 : 1.0;
    for (Chain* chain : {&left, &right})
      for (Link& l : *chain) l.along *= sense;
    const double cosine = edge(from).cosine;
    const auto off = [&](const Link& a, const Link& b) {
      return cosine / 16.0 * std::abs(a.support + b.support) * (b.along - a.along) *
             (b.along - a.along);
    };
    const auto error = [&](const Link& a, const Link& b, const Link& c) {
      if (surface_ != nullptr)
        return triangle_error(off_chord(a, b), off_chord(b, c), off_chord(c, a));
      return std::max({off(a, b), off(b, c), off(c, a)});
    };
    join_ways(left, right, error, kReach);
    if (edge(from).in_chamfer && best_.largest > rows_->tolerance_mm)
      for (const auto& [start, end] : {std::pair{0, 2}, {1, 3}, {0, 1}, {3, 2}})
        join_around(loop, corners[static_cast<std::size_t>(start)],
                    corners[static_cast<std::size_t>(end)], error);
  }

  /// Both ways round a closed border from one vertex to another.
  template <class Error>
  void join_around(const Chain& loop, std::size_t start, std::size_t end, const Error& error) {
    const std::size_t n = loop.size(), ahead = (end + n - start) % n;
    if (ahead < 2 || n - ahead < 2) return;  // no vertices on one of the ways
    const double sense = loop[end].along < loop[start].along ? -1.0 : 1.0;
    Chain forwards, backwards;
    for (std::size_t k = 0; k <= ahead; ++k) forwards.push_back(loop[(start + k) % n]);
    for (std::size_t k = 0; k <= n - ahead; ++k) backwards.push_back(loop[(start + n - k) % n]);
    for (Chain* chain : {&forwards, &backwards})
      for (Link& link : *chain) link.along *= sense;
    join_ways(backwards, forwards, error, kReach);
  }

  const std::vector<NetEdge>& edges_;
  double turn_ = 0.0;
  const NetSurface* surface_ = nullptr;
  const NetRows* rows_ = nullptr;
  struct Joined {
    double cost = kNoLimit;  ///< sum of the fourth powers of errors
    double largest = 0.0;    ///< of the errors
    std::vector<std::array<NetNode, 3>> facets = {};
  };
  Joined best_ = {};  ///< of a strip
  NetPatch result_;
};

}  // namespace

double triangle_error(double a, double b, double c) {
  const double largest = std::max({std::abs(a), std::abs(b), std::abs(c)});
  if (!((a > 0.0) == (b > 0.0) && (b > 0.0) == (c > 0.0))) return largest;
  a = std::abs(a), b = std::abs(b), c = std::abs(c);
  if (2.0 * largest >= a + b + c) return largest;  // obtuse
  const double squares = a * a + b * b + c * c;
  return std::max(largest, 4.0 * a * b * c / (2.0 * (a * b + b * c + c * a) - squares));
}

NetPatch net_patch(const std::vector<NetEdge>& edges, std::vector<std::vector<double>> inner,
                   double turn_rad) {
  return PatchBuilder(edges, std::move(inner), turn_rad, nullptr, nullptr).build();
}

NetPatch net_patch(const std::vector<NetEdge>& edges, std::vector<std::vector<double>> inner,
                   double turn_rad, const NetSurface& surface, const NetRows& rows) {
  return PatchBuilder(edges, std::move(inner), turn_rad, &surface, &rows).build();
}

}  // namespace trueflank
