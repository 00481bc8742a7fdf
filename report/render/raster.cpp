// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/render/raster.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trueflank/base/contract.h"

namespace trueflank::io {
namespace {

constexpr std::int64_t kUnit = 256;  // parts of a sample
// of a cell, in quarters: every row and every column has its own place
constexpr std::array<std::int64_t, 4> kColumnShift{1, 3, 0, 2}, kRowShift{2, 0, 3, 1};
constexpr int kNarrow = 6;         // samples; fewer are tried one by one
constexpr double kEdgeOn = 1e-12;  // of a plane seen from its side

std::int64_t column_shift(SampleGrid grid, int row) {
  return grid == SampleGrid::kPlain
             ? kUnit / 2
             : kUnit / 8 + kUnit / 4 * kColumnShift[static_cast<std::size_t>(row & 3)];
}
std::int64_t row_shift(SampleGrid grid, int column) {
  return grid == SampleGrid::kPlain
             ? kUnit / 2
             : kUnit / 8 + kUnit / 4 * kRowShift[static_cast<std::size_t>(column & 3)];
}

/// a x + b y + c, above 0 on the inner side of an edge; on it, one of two triangles has it.
struct Edge {
  std::int64_t a, b, c;

  template <class Corner>
  Edge(const Corner& from, const Corner& to) : a(from.y - to.y), b(to.x - from.x) {
    c = -(a * from.x + b * from.y);
    if (!(a > 0 || (a == 0 && b > 0))) c -= 1;
  }
  [[nodiscard]] std::int64_t at(std::int64_t x, std::int64_t y) const { return a * x + b * y + c; }
};

int clamped(double value, int low, int high) {
  return value <= low ? low : value >= high ? high : static_cast<int>(value);
}

/// An edge along the samples of a row.
struct RowEdge {
  Edge edge;
  std::int64_t value = 0,
               step;  ///< without what the sample's column shifts it; from a column to the next
  double inverse;
  std::array<std::int64_t, 4> shift{};

  RowEdge(const Edge& of, SampleGrid grid)
      : edge(of),
        step(of.a * kUnit),
        inverse(of.a != 0 ? 1.0 / static_cast<double>(of.a * kUnit) : 0.0) {
    for (int column = 0; column < 4; ++column)
      shift[static_cast<std::size_t>(column)] = edge.b * row_shift(grid, column);
  }
  [[nodiscard]] std::int64_t in(std::size_t phase) const { return value + shift[phase]; }

  /// At the first column of a row; `from` and `to` leave out columns that lie outside for certain.
  void begin(std::int64_t x0, std::int64_t y0, int first_column, int last_column, int& from,
             int& to) {
    value = edge.at(x0, y0);
    // wherever in the row the sample may be
    const std::int64_t highest = value + std::max<std::int64_t>(0, edge.b * kUnit);
    if (edge.a == 0) {
      if (highest < 0) to = from - 1;
    } else if (const double zero = -static_cast<double>(highest) * inverse; edge.a > 0) {
      from = std::max(from, clamped(std::floor(zero) - 1.0, first_column, last_column + 1));
    } else {
      to = std::min(to, clamped(std::ceil(zero) + 1.0, first_column - 1, last_column));
    }
  }
};

/// Nearness over a triangle, computed where a sample asks for it: most small triangles meet none.
template <class Corner>
class NearnessPlane {
 public:
  NearnessPlane(const std::array<Corner, 3>& corners, const std::array<Edge, 3>& edges)
      : t_(corners), edges_(edges) {}

  [[nodiscard]] double at(std::int64_t x, std::int64_t y) const {
    if (!known_) find();
    const double nearness = t_[0].nearness + kx_ * static_cast<double>(x - t_[0].x) +
                            ky_ * static_cast<double>(y - t_[0].y);
    return std::clamp(nearness, least_, most_);
  }

 private:
  void find() const {
    const double area = static_cast<double>(edges_[0].a) * (t_[2].x - t_[0].x) +
                        static_cast<double>(edges_[0].b) * (t_[2].y - t_[0].y);
    const double k1 = t_[1].nearness - t_[0].nearness, k2 = t_[2].nearness - t_[0].nearness;
    kx_ = (static_cast<double>(edges_[2].a) * k1 + static_cast<double>(edges_[0].a) * k2) / area;
    ky_ = (static_cast<double>(edges_[2].b) * k1 + static_cast<double>(edges_[0].b) * k2) / area;
    const auto [least, most] = std::minmax({t_[0].nearness, t_[1].nearness, t_[2].nearness});
    least_ = least;
    most_ = most;
    known_ = true;
  }

  const std::array<Corner, 3>& t_;
  const std::array<Edge, 3>& edges_;
  mutable bool known_ = false;
  mutable double kx_ = 0.0, ky_ = 0.0, least_ = 0.0, most_ = 0.0;
};

}  // namespace

Eigen::Vector2d sample_place(SampleGrid grid, int x, int y) {
  return Eigen::Vector2d(static_cast<double>(column_shift(grid, y)),
                         static_cast<double>(row_shift(grid, x))) /
         static_cast<double>(kUnit);
}

struct Raster::Drawing {
  SightWindow window;
  std::vector<Sight> behind;  ///< first surface of one body behind the cut; facing away: is_back
  std::vector<std::uint8_t> is_back;
  int low_x = 0, low_y = 0, high_x = 0, high_y = 0;  ///< samples of `behind` that are used
};

Raster::Raster(const std::vector<RasterBody>& bodies, const View& view,
               const std::optional<Cutaway>& cutaway, SampleGrid grid)
    : bodies_(bodies), grid_(grid), has_cut_(cutaway.has_value()) {
  if (cutaway)
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      ViewedPlane p = view.plane(cutaway->normal[i], cutaway->offset_mm[i]);
      if (std::abs(p.e) < kEdgeOn) p.e = kEdgeOn;
      planes_[i] = {-p.a / p.e, -p.b / p.e, -p.c / p.e, p.e < 0.0};
    }
  corners_.resize(bodies_.size());
  first_ = {0};
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const TriangleMesh& mesh = bodies_[i].mesh->mesh;
    corners_[i].reserve(mesh.vertices.size());
    for (const auto& vertex : mesh.vertices) {
      const Eigen::Vector3d p = view.project(bodies_[i].place(vertex));
      corners_[i].push_back({static_cast<std::int32_t>(std::lround(p.x() * kUnit)),
                             static_cast<std::int32_t>(std::lround(p.y() * kUnit)), p.z()});
    }
    first_.push_back(first_.back() + static_cast<std::uint32_t>(mesh.triangles.size()));
  }
  every_triangle_.resize(first_.back());
  std::iota(every_triangle_.begin(), every_triangle_.end(), 0U);
}

std::array<Raster::Corner, 3> Raster::corners_of(std::size_t body, std::uint32_t triangle) const {
  const auto& t = bodies_[body].mesh->mesh.triangles[triangle - first_[body]];
  return {corners_[body][t[0]], corners_[body][t[1]], corners_[body][t[2]]};
}

std::size_t Raster::body_of(std::uint32_t triangle) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), triangle) -
                                  first_.begin()) -
         1;
}

void Raster::sort_into_tiles(int tile, int around, int width, int height) {
  tile_ = tile;
  around_ = around;
  columns_ = (width + tile - 1) / tile;
  const int rows = (height + tile - 1) / tile;
  tiles_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows), {});
  const std::int64_t margin = around * kUnit;
  const auto of = [&](std::int64_t at, int last) {
    return static_cast<int>(std::clamp<std::int64_t>(at / (kUnit * tile), 0, last));
  };
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    for (std::uint32_t t = first_[body]; t < first_[body + 1]; ++t) {
      const auto c = corners_of(body, t);
      const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
      const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
      for (int y = of(top - margin, rows - 1); y <= of(bottom + margin, rows - 1); ++y)
        for (int x = of(left - margin, columns_ - 1); x <= of(right + margin, columns_ - 1); ++x)
          tiles_[static_cast<std::size_t>(y * columns_ + x)].push_back(t);
    }
}

Raster::Passage Raster::passage(int x, int y) const {
  constexpr double kShare = 1.0 / kUnit;
  const double u = x + kShare * static_cast<double>(column_shift(grid_, y)),
               v = y + kShare * static_cast<double>(row_shift(grid_, x));
  Passage passage{3e38, -3e38, 0};
  for (int i = 0; i < 2; ++i) {
    const CutPlane& p = planes_[static_cast<std::size_t>(i)];
    const double at = p.x * u + p.y * v + p.constant;
    if (p.enters) {
      passage.in = std::min(passage.in, at);
    } else if (at > passage.out) {
      passage.out = at;
      passage.plane = i;
    }
  }
  return passage;
}

template <class Put>
void Raster::scan(const std::array<Corner, 3>& t, const SightWindow& window, const Put& put) const {
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto cell = [](std::int64_t at) {
    return static_cast<int>(at >= 0 ? at / kUnit : -((kUnit - 1 - at) / kUnit));
  };
  // samples stand between these in their cells
  const std::int64_t low = grid_ == SampleGrid::kPlain ? kUnit / 2 : kUnit / 8, high = kUnit - low;
  const int first_row = std::max(window.y, cell(top - high + kUnit - 1)),
            last_row = std::min(window.y + window.height - 1, cell(bottom - low));
  const int first_column = std::max(window.x, cell(left - high + kUnit - 1)),
            last_column = std::min(window.x + window.width - 1, cell(right - low));
  if (first_row > last_row || first_column > last_column) return;
  const std::array<Edge, 3> edges{Edge(t[0], t[1]), Edge(t[1], t[2]), Edge(t[2], t[0])};
  const NearnessPlane plane(t, edges);
  const auto take = [&](int column, int row, std::int64_t x, std::int64_t y) {
    put(column, row, plane.at(x, y));
  };
  const auto x_of = [&](int column, int row) { return column * kUnit + column_shift(grid_, row); };
  const auto y_of = [&](int column, int row) { return row * kUnit + row_shift(grid_, column); };
  if (last_column - first_column < kNarrow) {
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column)
        if (const std::int64_t x = x_of(column, row), y = y_of(column, row);
            (edges[0].at(x, y) | edges[1].at(x, y) | edges[2].at(x, y)) >= 0)  // none has a sign
          take(column, row, x, y);
    return;
  }
  std::array<RowEdge, 3> in_row{RowEdge(edges[0], grid_), RowEdge(edges[1], grid_),
                                RowEdge(edges[2], grid_)};
  for (int row = first_row; row <= last_row; ++row) {
    const std::int64_t x0 = column_shift(grid_, row), y0 = row * kUnit;
    int from = first_column, to = last_column;
    for (RowEdge& edge : in_row) edge.begin(x0, y0, first_column, last_column, from, to);
    for (RowEdge& edge : in_row) edge.value += edge.step * from;
    for (int column = from; column <= to; ++column) {
      const auto phase = static_cast<std::size_t>(column & 3);
      const bool inside = (in_row[0].in(phase) | in_row[1].in(phase) | in_row[2].in(phase)) >=
                          0;  // none has a sign
      for (RowEdge& edge : in_row) edge.value += edge.step;
      if (inside) take(column, row, x_of(column, row), y_of(column, row));
    }
  }
}

void Raster::draw_body(std::size_t body, const std::uint32_t* begin, const std::uint32_t* end,
                       Drawing& drawing) const {
  SightWindow& window = drawing.window;
  const bool cut = has_cut_ && bodies_[body].cut;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(x - window.x);
  };
  for (const std::uint32_t* triangle = begin; triangle != end; ++triangle) {
    std::array<Corner, 3> t = corners_of(body, *triangle);
    const std::int64_t area = (std::int64_t{t[1].x} - t[0].x) * (std::int64_t{t[2].y} - t[0].y) -
                              (std::int64_t{t[1].y} - t[0].y) * (std::int64_t{t[2].x} - t[0].x);
    const bool back = area > 0;  // y grows downwards
    if (area == 0 || (back && !cut)) continue;
    if (!back) std::swap(t[1], t[2]);
    const auto keep = [&](Sight& sight, double nearness) {
      const auto near = static_cast<float>(nearness);
      if (near <= sight.nearness) return false;
      sight = {near, *triangle};
      return true;
    };
    if (!cut) {
      scan(t, window,
           [&](int x, int y, double nearness) { keep(window.sights[index(x, y)], nearness); });
      continue;
    }
    scan(t, window, [&](int x, int y, double nearness) {
      const Passage p = passage(x, y);
      const std::size_t i = index(x, y);
      if (p.out >= p.in || nearness >= p.in) {  // the line misses the wedge, or is before it
        if (!back) keep(window.sights[i], nearness);
      } else if (nearness <= p.out && keep(drawing.behind[i], nearness)) {
        drawing.is_back[i] = back ? 1 : 0;
        drawing.low_x = std::min(drawing.low_x, x);
        drawing.high_x = std::max(drawing.high_x, x);
        drawing.low_y = std::min(drawing.low_y, y);
        drawing.high_y = std::max(drawing.high_y, y);
      }
    });
  }
  if (cut) close_cut(body, drawing);
}

/// Where the body's first surface behind the wedge is seen from inside, the line of sight enters it
/// through the plane of the cut.
void Raster::close_cut(std::size_t body, Drawing& drawing) const {
  SightWindow& window = drawing.window;
  for (int y = drawing.low_y; y <= drawing.high_y; ++y)
    for (int x = drawing.low_x; x <= drawing.high_x; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
          static_cast<std::size_t>(x - window.x);
      Sight behind = drawing.behind[i];
      if (behind.surface == kNoSight.surface) continue;
      if (drawing.is_back[i] != 0) {
        const Passage p = passage(x, y);
        behind = {static_cast<float>(p.out), SurfaceName::cut_face(body, p.plane)};
      }
      if (behind.nearness > window.sights[i].nearness) window.sights[i] = behind;
      drawing.behind[i] = kNoSight;
    }
  drawing.low_x = drawing.low_y = 1 << 30;
  drawing.high_x = drawing.high_y = -1;
}

SightWindow Raster::draw(int x, int y, int width, int height) const {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Drawing drawing{.window = {x, y, width, height, std::vector<Sight>(count, kNoSight)},
                  .behind = {},
                  .is_back = {},
                  .low_x = 1 << 30,
                  .low_y = 1 << 30,
                  .high_x = -1,
                  .high_y = -1};
  if (has_cut_) {
    drawing.behind.assign(count, kNoSight);
    drawing.is_back.assign(count, 0);
  }
  const std::uint32_t *begin = every_triangle_.data(), *end = begin + every_triangle_.size();
  if (tile_ > 0) {
    const int column = (x + around_) / tile_, row = (y + around_) / tile_;
    TRUEFLANK_EXPECTS(x + width <= (column + 1) * tile_ + around_ &&
                      y + height <= (row + 1) * tile_ + around_);
    const auto& tile = tiles_[static_cast<std::size_t>(row * columns_ + column)];
    begin = tile.data();
    end = begin + tile.size();
  }
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const std::uint32_t* from = std::lower_bound(begin, end, first_[body]);
    const std::uint32_t* to = std::lower_bound(from, end, first_[body + 1]);
    if (from != to) draw_body(body, from, to, drawing);
  }
  return std::move(drawing.window);
}

}  // namespace trueflank::io
