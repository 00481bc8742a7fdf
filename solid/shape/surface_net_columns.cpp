// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices of modified teeth stand: posts by patch, vertices of the breaks.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/shape/surface_net.h"

namespace trueflank {
namespace {

/// Posts of a neighbour do where they are so little too far apart: the rounding of the others makes
/// up for it.
constexpr double kSlackOfShared = 0.95;
/// Columns of shifted vertices stand nearer to a joint by this share of a step: the vertices there
/// stand as another panel has them.
constexpr double kNarrowerAtJoint = 0.3;
/// Vertices of different breaks that are nearer than this share of a panel have one column.
constexpr double kSameColumn = 1e-4;

constexpr std::uint64_t kAll = ~std::uint64_t{0};

std::uint64_t bit(std::size_t k) { return std::uint64_t{1} << k; }

/// Posts at those of a neighbour, and more of them where they are too far apart.
std::vector<double> between_posts(double from, double to, const ColumnDemand& wanted,
                                  const std::vector<double>& neighbour) {
  std::vector<double> fixed = neighbour, result;
  fixed.insert(fixed.begin(), from);
  fixed.push_back(to);
  for (std::size_t i = 0; i + 1 < fixed.size(); ++i) {
    const int parts = whole_parts(kSlackOfShared * (wanted.at(fixed[i + 1]) - wanted.at(fixed[i])));
    for (int k = 0; k < parts; ++k)
      if (i + static_cast<std::size_t>(k) > 0)
        result.push_back(wanted.between(fixed[i], fixed[i + 1], k, parts));
  }
  return result;
}

}  // namespace

void ToothingGrid::SurfaceNet::spread() {
  g_.edges_.clear();
  for (Panel& panel : panels_)
    if (!panel.land) find_posts(panel);
  lay_strips();
  for (Panel& panel : panels_) {
    const std::size_t first = g_.edges_.size();
    if (panel.land)
      add_land(panel);
    else
      add_panel(panel);
    if (first < g_.edges_.size()) g_.edges_[first].posts = kAll;
  }
  g_.find_ends();
  g_.place_columns();
}

void ToothingGrid::SurfaceNet::add_land(const Panel& panel) {
  double aim = tolerance_;
  for (std::size_t patch = 0; patch < patch_count(); ++patch) {
    const auto& piece = aims_[aims_of(patch, panel.piece)];
    aim = std::min(aim, *std::min_element(piece.begin(), piece.end()));
  }
  const HalfToothPolyline half = tessellate(*g_.toothing_.profile, aim / panel.wider);
  for (const HalfToothPolyline::Edge& e : half.edges)
    if (static_cast<std::size_t>(e.piece) == panel.piece)
      g_.edges_.push_back({panel.piece, e.from, e.to});
  if (panel.piece == panels_.front().piece)
    g_.vertex_at_tooth_middle_ = half.vertex_at_tooth_middle;
  if (panel.piece == panels_.back().piece) g_.vertex_at_gap_middle_ = half.vertex_at_gap_middle;
}

/// Steps of a post, about.
double ToothingGrid::SurfaceNet::rows_of(const Crossing& crossing) const {
  double steps = crossing.rows;
  for (const CellForms& cell : crossing.forms)
    for (const SurfaceForm& form : cell)
      steps = std::max(steps, std::ceil(std::sqrt(std::abs(form.along) / (8.0 * tolerance_))));
  return steps;
}

/// By patch, without the panel's ends. Tall patches first: others take over their posts.
void ToothingGrid::SurfaceNet::find_posts(Panel& panel) const {
  std::vector<std::size_t> order;
  for (std::size_t patch = 0; patch < patch_count(); ++patch) order.push_back(patch);
  const auto height = [&](std::size_t patch) {
    return g_.breaks_mm_[patch + 1] - g_.breaks_mm_[patch];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  std::vector<std::vector<double>>& posts = panel.posts;
  posts.assign(patch_count(), {});
  std::vector<bool> placed(patch_count(), false);
  for (const std::size_t patch : order) {
    choose_crossing(panel, patch);
    placed[patch] = true;
    if (panel.patches[patch].across || panel.patches[patch].bare) continue;
    const ColumnDemand wanted = columns(panel, patch, panel.patches[patch].rows);
    const double narrower = panel.patches[patch].saddle ? kNarrowerAtJoint : 0.0;
    const int count = whole_parts(wanted.whole() + 2.0 * narrower);
    for (int k = 1; k < count; ++k)
      posts[patch].push_back(
          wanted.parameter_of(wanted.whole() * (k - narrower) / (count - 2.0 * narrower)));
    // a post costs a facet a step and one on each break that it does not share
    const double rows = rows_of(panel.patches[patch]);
    double fewest = static_cast<double>(posts[patch].size()) * (rows + 1.0);
    for (const std::size_t other : {patch - 1, patch + 1}) {
      if (other >= patch_count() || !placed[other] || posts[other].empty()) continue;
      const std::vector<double> refined = between_posts(panel.from, panel.to, wanted, posts[other]);
      const double facets = static_cast<double>(refined.size()) * (rows + 1.0) -
                            static_cast<double>(posts[other].size());
      if (facets <= fewest) fewest = facets, posts[patch] = refined;
    }
  }
}

/// Vertices of a break: the posts beside it and chords between them.
std::vector<double> ToothingGrid::SurfaceNet::row_of(const Panel& panel, std::size_t row) const {
  std::vector<double> fixed{panel.from, panel.to};
  for (std::size_t patch = row > 0 ? row - 1 : 0; patch < std::min(row + 1, patch_count()); ++patch)
    fixed.insert(fixed.end(), panel.posts[patch].begin(), panel.posts[patch].end());
  const double sense = panel.to > panel.from ? 1.0 : -1.0;
  std::sort(fixed.begin(), fixed.end(), [&](double a, double b) { return sense * a < sense * b; });
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  const ColumnDemand wanted = chords(panel, row);
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < fixed.size(); ++i) {
    const int parts = whole_parts(wanted.at(fixed[i + 1]) - wanted.at(fixed[i]));
    for (int k = 0; k < parts; ++k)
      result.push_back(wanted.between(fixed[i], fixed[i + 1], k, parts));
  }
  result.push_back(panel.to);
  return result;
}

/// Vertices of an end face between those of the patch's other break, as straight lines of the
/// surface see them.
std::vector<double> ToothingGrid::SurfaceNet::row_between(const Panel& panel, std::size_t patch,
                                                          const std::vector<double>& other) const {
  const double sense = patch == 0 ? -1.0 : 1.0;
  std::vector<double> result{panel.from};
  for (std::size_t i = 0; i + 1 < other.size(); ++i) {
    const double middle = 0.5 * (other[i] + other[i + 1]), half = 0.5 * (other[i + 1] - other[i]);
    const double most = 0.8 * std::abs(half), way = straight_way(panel, patch, middle);
    result.push_back(middle + std::clamp(sense * way, -most, most));
  }
  result.push_back(panel.to);
  return result;
}

/// Rows within the patches at the end faces; where vertices stand between one another, the end
/// face's row, too.
std::vector<std::vector<double>> ToothingGrid::SurfaceNet::level_rows(
    Panel& panel, std::vector<std::vector<double>>& rows) const {
  std::vector<std::vector<double>> levels;
  for (const bool down : {true, false}) {
    const std::size_t patch = down ? 0 : patch_count() - 1;
    if (!down && patch == 0) break;
    if (is_chamfer(patch) && is_fillet(panel))
      add_strips(panel, patch, rows, levels);
    else if (panel.patches[patch].between)
      rows[down ? 0 : patch + 1] = row_between(panel, patch, rows[down ? 1 : patch]);
  }
  return levels;
}

void ToothingGrid::SurfaceNet::add_panel(Panel& panel) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row <= patch_count(); ++row) rows.push_back(row_of(panel, row));
  add_columns(panel, rows, level_rows(panel, rows));
}

void ToothingGrid::SurfaceNet::add_columns(const Panel& panel,
                                           const std::vector<std::vector<double>>& rows,
                                           const std::vector<std::vector<double>>& levels) {
  std::vector<double> columns;
  for (const auto* all : {&rows, &levels})
    for (const auto& row : *all) columns.insert(columns.end(), row.begin(), row.end());
  const double sense = panel.to > panel.from ? 1.0 : -1.0;
  std::sort(columns.begin(), columns.end(),
            [&](double a, double b) { return sense * a < sense * b; });
  const double same = kSameColumn * std::abs(panel.to - panel.from);
  std::vector<double> apart;
  for (const double c : columns)
    if (apart.empty() || std::abs(c - apart.back()) > same) apart.push_back(c);
  apart.front() = panel.from, apart.back() = panel.to;
  const auto standing = [&](const std::vector<std::vector<double>>& all, double column) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (std::any_of(all[k].begin(), all[k].end(),
                      [&](double p) { return std::abs(p - column) <= same; }))
        bits |= bit(k);
    return bits;
  };
  for (std::size_t i = 0; i + 1 < apart.size(); ++i) {
    HalfEdge edge{panel.piece, apart[i], apart[i + 1]};
    if (i > 0) {
      edge.rows = standing(rows, apart[i]), edge.posts = standing(panel.posts, apart[i]);
      edge.levels = standing(levels, apart[i]);
    }
    g_.edges_.push_back(edge);
  }
}

}  // namespace trueflank
