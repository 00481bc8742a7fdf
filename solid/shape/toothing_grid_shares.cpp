// SPDX-License-Identifier: GPL-3.0-or-later
//
// How rows and columns of modified teeth share the tolerance. Source:
// docs/theory/helical-facets.md.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "trueflank/geometry/polyline.h"
#include "trueflank/solid/shape/toothing_grid.h"

namespace trueflank {
namespace {

/// Columns start at this share of the tolerance where the surface differs from the screw of the
/// section: a deviation that bends the flank a little need not split every chord.
constexpr double kRoomForDeviation = 0.95;
/// Where the errors of rows and columns add up (domes: crowned flanks), what rows may have of the
/// tolerance, how many numbers of rows are looked at, and how many of those with the fewest facets
/// are tried.
constexpr double kLeastOfRows = 0.2, kMostOfRows = 0.7;
constexpr double kMostLookedAt = 16.0;
constexpr std::size_t kMostTrials = 3;
/// Numbers of rows that do not promise fewer facets than this share of what there is are not tried.
constexpr double kWorthATrial = 0.97;
/// The parts of a layer that bends evenly differ by less.
constexpr double kAlike = 1.01;
/// Parts that a layer is cut into at once: few where it may bend in one of them alone.
constexpr int kFewShareParts = 8, kMostParts = 64;

}  // namespace

void ToothingGrid::lay_modified(double tolerance_mm, double aim_mm) {
  lay_columns(aim_mm, 0.0, {});
  lay_rows(aim_mm, 0.0);
  hid_waves_ = cut_hidden_waves(aim_mm);
  const std::vector<bool> crowded = cut_in_rounds(aim_mm);
  if (!teeth_alike_ || std::find(crowded.begin(), crowded.end(), true) == crowded.end()) return;
  std::size_t fewest = points_.size() * heights_mm_.size();
  double best_mm = 0.0, last_mm = 0.0;
  for (const double rows_mm : shares_of_rows(aim_mm, crowded, fewest)) {
    lay_columns(aim_mm, last_mm = rows_mm, crowded);
    lay_rows(aim_mm, rows_mm);
    cut_in_rounds(aim_mm);
    const std::size_t count = points_.size() * heights_mm_.size();
    if (facet_error_mm_ <= tolerance_mm && count < fewest) fewest = count, best_mm = rows_mm;
  }
  if (last_mm > 0.0 && best_mm == last_mm) return;
  lay_columns(aim_mm, best_mm, crowded);
  lay_rows(aim_mm, best_mm);
  cut_in_rounds(aim_mm);
}

std::vector<double> ToothingGrid::shares_of_rows(double aim_mm, const std::vector<bool>& crowded,
                                                 std::size_t fewest) {
  double whole_mm = 0.0;
  for (std::size_t j = 0; j + 1 < breaks_mm_.size(); ++j)
    whole_mm = std::max(whole_mm, layer_error_mm(breaks_mm_[j], breaks_mm_[j + 1], 16));
  const double first = std::max(2.0, std::ceil(std::sqrt(whole_mm / (kMostOfRows * aim_mm))));
  const double last = std::floor(std::sqrt(whole_mm / (kLeastOfRows * aim_mm)));
  const double step = std::max(1.0, std::ceil((last - first + 1.0) / kMostLookedAt));
  std::vector<std::pair<double, double>> promised;  // facets and shares
  for (double parts = first; parts <= last; parts += step) {
    const double rows_mm = kAlike * whole_mm / (parts * parts);
    lay_columns(aim_mm, rows_mm, crowded);
    const double count = static_cast<double>(points_.size()) * (parts + 1.0);
    if (count <= kWorthATrial * static_cast<double>(fewest)) promised.emplace_back(count, rows_mm);
  }
  std::sort(promised.begin(), promised.end());
  std::vector<double> shares_mm;
  for (std::size_t i = 0; i < std::min(promised.size(), kMostTrials); ++i)
    shares_mm.push_back(promised[i].second);
  return shares_mm;
}

void ToothingGrid::lay_columns(double aim_mm, double rows_mm, const std::vector<bool>& crowded) {
  edges_.clear();
  start_columns(kRoomForDeviation * aim_mm);
  if (rows_mm > 0.0) crowd_columns(crowded, kRoomForDeviation * (aim_mm - rows_mm));
}

void ToothingGrid::lay_rows(double aim_mm, double rows_mm) {
  start_layers(kRoomForDeviation * aim_mm);
  refine_columns(aim_mm);
  refine_layers(rows_mm > 0.0 ? rows_mm : aim_mm, rows_mm > 0.0 ? kMostParts : kFewShareParts);
}

void ToothingGrid::crowd_columns(const std::vector<bool>& crowded, double tolerance_mm) {
  const HalfToothPolyline half = tessellate(*toothing_.profile, tolerance_mm);
  std::vector<HalfEdge> edges, finer;
  for (const HalfToothPolyline::Edge& e : half.edges)
    finer.push_back({static_cast<std::size_t>(e.piece), e.from, e.to});
  for (std::size_t piece = 0; piece < crowded.size(); ++piece) {
    const std::vector<HalfEdge>& from = crowded[piece] ? finer : edges_;
    std::copy_if(from.begin(), from.end(), std::back_inserter(edges),
                 [&](const HalfEdge& e) { return e.piece == piece; });
  }
  edges_ = std::move(edges);
  if (crowded[edges_.front().piece]) vertex_at_tooth_middle_ = half.vertex_at_tooth_middle;
  if (crowded[edges_.back().piece]) vertex_at_gap_middle_ = half.vertex_at_gap_middle;
  add_roll_breaks(tolerance_mm);
  find_ends();
  place_columns();
}

}  // namespace trueflank
