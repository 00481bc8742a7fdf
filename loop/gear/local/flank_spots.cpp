// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/flank_spots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/far_points.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

constexpr double kClip = 3.5;
constexpr double kFar = 6.0;  ///< spreads
constexpr int kMostCells = 20, kFewestCells = 4;
constexpr std::size_t kFewestPoints = 40, kMostSpots = 3;

std::size_t side_index(int side) { return side > 0 ? 1 : 0; }

/// Sums over the cells before a corner, so that every window is four look-ups.
struct Field {
  std::vector<double> sum, count, plain;
  double loud = 1.0;  ///< scatter over that of the usual flank; 1: no more than by chance
};

/// Cells of a window: over profile and face; 0: over all of it.
struct Window {
  int profile = 0, face = 0;
};

class SpotSearch {
 public:
  SpotSearch(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
             const std::vector<float>& row_um)
      : geometry_(geometry), row_um_(row_um), patch_of_row_(patches.patch_of_row) {
    for (const Patches::Patch& patch : patches.patches)
      loud_of_patch_.push_back(static_cast<float>(patch.loud));
    const auto flanks = 2 * static_cast<std::size_t>(geometry.teeth());
    std::vector<int> flank_of(patches.patches.size(), -1);
    for (std::size_t p = 0; p < flank_of.size(); ++p) {
      const Place& place = patches.patches[p].places.front().place;
      if (patches.patches[p].kind == ObservationKind::kScanFlank)
        flank_of[p] = 2 * (place.tooth - 1) + static_cast<int>(side_index(place.side));
    }
    const RowsByClass rows(table.rows.size(), flanks, [&](std::size_t i) {
      const int patch = patches.patch_of_row[i];
      return patch < 0 ? -1 : flank_of[static_cast<std::size_t>(patch)];
    });
    std::size_t points = 0;  // of all flanks
    for (std::size_t flank = 0; flank < flanks; ++flank) points += rows.count(flank);
    const std::size_t per_flank = points / flanks;
    if (per_flank < kFewestPoints) return;
    cells_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(per_flank) / 2.5)),
                        kFewestCells, kMostCells);
    // A probe may be noisier on one flank than on the other.
    std::array<double, 2> limits{};
    for_each_piece(2, [&](std::size_t side) {
      std::vector<float> um;
      um.reserve(points / 2);
      for (std::size_t flank = side; flank < flanks; flank += 2)
        rows.for_each(flank, [&](std::size_t i) { um.push_back(level_um(i)); });
      limits[side] = kClip * robust_sigma(um);
      const auto limit = static_cast<float>(limits[side]);
      for (float& value : um) value = std::clamp(value, -limit, limit);
      excess_[side] = excess_kurtosis(um);
    });
    std::vector<Field*> fields(flanks, nullptr);
    for (std::size_t flank = 0; flank < flanks; ++flank)
      if (rows.count(flank) > 0)
        fields[flank] = &fields_[{static_cast<int>(flank / 2) + 1, flank % 2 == 1 ? 1 : -1}];
    // Flanks do not ask each other: the same sums on any number of processors.
    for_each_piece(flanks, [&](std::size_t flank) {
      if (fields[flank] == nullptr) return;
      Field& field = *fields[flank];
      field.sum = field.count = field.plain = std::vector<double>(corners(), 0.0);
      const double limit = limits[flank % 2];
      // From one point of a cell to the next: points come in any order, and a flank that leans is
      // not loud.
      std::vector<float> steps, last_um(corners(), std::numeric_limits<float>::quiet_NaN());
      rows.for_each(flank, table, [&](std::size_t i) {
        const Place& place = table.place(table.rows[i]);
        const std::size_t at = corner(cell(geometry.profile_coordinate(place.roll_mm)) + 1,
                                      cell(geometry.face_coordinate(place.z_mm)) + 1);
        const float um = level_um(i);
        field.sum[at] += std::clamp(static_cast<double>(um), -limit, limit);
        field.plain[at] += row_um[i];
        field.count[at] += 1.0;
        if (!std::isnan(last_um[at])) steps.push_back(um - last_um[at]);
        last_um[at] = um;
      });
      field.loud = robust_sigma(std::move(steps));
      for (std::vector<double>* values : {&field.sum, &field.count, &field.plain}) add_up(*values);
    });
    tell_loud_flanks();
    const std::array<double, 2> far_um{kFar / kClip * limits[0], kFar / kClip * limits[1]};
    together_ = far_points_together(
        geometry, table, rows, flanks, row_um,
        [&](std::size_t i, std::size_t side) { return std::abs(level_um(i)) > far_um[side]; });
  }

  std::vector<FlankSpot> run() {
    if (fields_.empty()) return {};
    const std::vector<Window> all = windows();
    std::vector<Spread> spreads(all.size());
    for_each_piece(all.size(), [&](std::size_t i) { spreads[i] = spread_of(all[i]); });
    double tests = 0.0;
    for (const Spread& spread : spreads) tests += spread.tests;
    std::vector<const std::pair<const std::pair<int, int>, Field>*> flanks;
    for (const auto& flank : fields_) flanks.push_back(&flank);
    // Flanks do not ask each other: the same on any number of processors.
    std::vector<OfFlank> best(flanks.size());
    for_each_piece(flanks.size(), [&](std::size_t k) {
      for (std::size_t i = 0; i < all.size(); ++i)
        judge(all[i], spreads[i], flanks[k]->first, flanks[k]->second, best[k]);
    });
    std::vector<FlankSpot> spots;
    for (const OfFlank& found : best) {
      const double p = tests * found.most_likely.p_value;
      if (found.most_likely.p_value >= 1.0 || p >= 1.0) continue;
      spots.push_back(found.square > 0.0 ? found.fullest : found.most_likely);
      spots.back().p_value = p;
    }
    add_far_points(spots);
    std::sort(spots.begin(), spots.end(),
              [](const auto& a, const auto& b) { return a.p_value < b.p_value; });
    if (spots.size() > kMostSpots) spots.resize(kMostSpots);
    return spots;
  }

 private:
  /// What is found on a flank: the window that is the least likely to be an accident, by values that are
  /// cut off so that a wild one does not count; and of those beyond doubt the one that takes out most, by the
  /// values as they are: where a burr stands.
  struct OfFlank {
    FlankSpot most_likely, fullest;
    double square = 0.0;
    double too_near = -1.0;  ///< a score of this size or less changes nothing
  };

  /// Of all windows of a size: how their scores scatter on each side, and how many there are.
  struct Spread {
    std::array<double, 2> of_side{};
    double tests = 0.0;
  };

  /// What is beyond doubt is compared by what it takes out.
  static constexpr double kBeyondDoubt = 1e-8;

  /// A size of a normal value, in standard deviations: smaller ones are certainly as likely as `p`,
  /// or more. On a grid, and where rounding does not decide.
  static double size_as_likely(double p) {
    constexpr double kSteps = 32.0, kBeyondRounding = 1.0 + 1e-9;
    static const std::vector<double> likely = [] {
      std::vector<double> all;
      do all.push_back(normal_two_sided(static_cast<double>(all.size()) / kSteps, 0.0));
      while (all.back() > kBeyondDoubt);
      return all;
    }();
    const auto end = std::partition_point(likely.begin(), likely.end(),
                                          [&](double q) { return q >= kBeyondRounding * p; });
    return static_cast<double>(end - likely.begin() - 1) / kSteps;
  }

  /// A value as it would be where the random error is the usual one of its side.
  [[nodiscard]] float level_um(std::size_t row) const {
    return row_um_[row] / loud_of_patch_[static_cast<std::size_t>(patch_of_row_[row])];
  }

  /// Points that lie far off together, on flanks where no window is as sure.
  void add_far_points(std::vector<FlankSpot>& spots) const {
    constexpr double kLoud = 1.3;  // points lie further off there
    for (const FlankSpot& together : together_) {
      const auto same = std::find_if(spots.begin(), spots.end(), [&](const FlankSpot& spot) {
        return spot.tooth == together.tooth && spot.side == together.side;
      });
      const auto field = fields_.find({together.tooth, together.side});
      if (field != fields_.end() && field->second.loud > kLoud) continue;
      if (same == spots.end())
        spots.push_back(together);
      else if (same->p_value > together.p_value)
        *same = together;
    }
  }

  /// Cells are as many over the profile as over the face, what stands on a flank is as often round
  /// in millimetres: small windows of all proportions.
  [[nodiscard]] std::vector<Window> windows() const {
    std::vector<Window> all;
    std::vector<int> sizes;
    for (int size = std::max(1, cells_ / 10); size <= cells_ / 2;
         size = std::max(size + 1, size * 3 / 2))
      sizes.push_back(size);
    for (const int size : sizes) {
      all.push_back({size, size});
      if (size > cells_ / 4) continue;
      all.push_back({0, size});
      all.push_back({size, 0});
      for (const int other : sizes)
        if (other > size) {
          all.push_back({other, size});
          all.push_back({size, other});
        }
    }
    return all;
  }

  /// A flank that scatters more than the usual one of its side from point to point is measured
  /// against itself; a quiet one may be so by chance.
  void tell_loud_flanks() {
    for (const int side : {-1, 1}) {
      std::vector<Field*> of_side;
      std::vector<double> scatters, values;
      for (auto& [key, field] : fields_) {
        if (key.second != side) continue;
        of_side.push_back(&field);
        scatters.push_back(field.loud);
        values.push_back(field.count.back());
      }
      const Loudness loud = loudness_of(scatters, values);
      degrees_[side_index(side)] = loud.degrees;
      for (std::size_t k = 0; k < of_side.size(); ++k)
        of_side[k]->loud = std::max(1.0, loud.factors[k]);
    }
  }

  [[nodiscard]] std::size_t corners() const {
    return static_cast<std::size_t>((cells_ + 1) * (cells_ + 1));
  }
  [[nodiscard]] std::size_t corner(int u, int v) const {
    return static_cast<std::size_t>(u * (cells_ + 1) + v);
  }
  [[nodiscard]] int cell(double coordinate) const {
    return std::clamp(static_cast<int>(0.5 * (coordinate + 1.0) * cells_), 0, cells_ - 1);
  }
  void add_up(std::vector<double>& values) const {
    for (int u = 1; u <= cells_; ++u)
      for (int v = 1; v <= cells_; ++v)
        values[corner(u, v)] +=
            values[corner(u - 1, v)] + values[corner(u, v - 1)] - values[corner(u - 1, v - 1)];
  }
  [[nodiscard]] double within(const std::vector<double>& values, int u, int v, int du,
                              int dv) const {
    return values[corner(u + du, v + dv)] - values[corner(u, v + dv)] - values[corner(u + du, v)] +
           values[corner(u, v)];
  }

  /// `visit(u, v, count, score)` for every window of a size on a flank that holds enough values.
  template <class Visit>
  void for_each_window(const Window& window, const Field& field, const Visit& visit) const {
    constexpr double kFewestInWindow = 4.0;
    const int du = cells_over_profile(window), dv = cells_over_face(window);
    for (int u = 0; u + du <= cells_; ++u)
      for (int v = 0; v + dv <= cells_; ++v) {
        const double count = within(field.count, u, v, du, dv);
        if (count >= kFewestInWindow)
          visit(u, v, count, within(field.sum, u, v, du, dv) / std::sqrt(count) / field.loud);
      }
  }
  [[nodiscard]] int cells_over_profile(const Window& window) const {
    return window.profile > 0 ? window.profile : cells_;
  }
  [[nodiscard]] int cells_over_face(const Window& window) const {
    return window.face > 0 ? window.face : cells_;
  }

  [[nodiscard]] Spread spread_of(const Window& window) const {
    std::array<std::vector<float>, 2> of_side;
    for (const auto& [key, field] : fields_) {
      std::vector<float>& scores = of_side[side_index(key.second)];
      for_each_window(window, field, [&](int, int, double, double score) {
        scores.push_back(static_cast<float>(score));
      });
    }
    const auto tests = static_cast<double>(of_side[0].size() + of_side[1].size());
    return {{robust_sigma(std::move(of_side[0])), robust_sigma(std::move(of_side[1]))}, tests};
  }

  void judge(const Window& window, const Spread& spreads, const std::pair<int, int>& key,
             const Field& field, OfFlank& found) const {
    const std::size_t side = side_index(key.second);
    const double spread = spreads.of_side[side];
    if (!(spread > 0.0)) return;
    const int du = cells_over_profile(window), dv = cells_over_face(window);
    const double mm_u = (geometry_.tip_form_roll_mm() - geometry_.root_form_roll_mm()) / cells_;
    const double mm_v = geometry_.face_width_mm() / cells_;
    for_each_window(window, field, [&](int u, int v, double count, double score) {
      if (std::abs(score / spread) <= found.too_near) return;
      const double normal = normal_two_sided(score / spread, excess_[side] / count);
      const double p = std::max(normal, least_chance(score / spread, degrees_[side], normal));
      const double sum = within(field.plain, u, v, du, dv), square = sum * sum / count;
      const bool fuller = p < kBeyondDoubt && square > found.square;
      if (!(p < found.most_likely.p_value) && !fuller) return;
      const FlankSpot spot{p,
                           key.first,
                           key.second,
                           geometry_.root_form_roll_mm() + (u + 0.5 * du) * mm_u,
                           (v + 0.5 * dv) * mm_v,
                           window.profile > 0 ? 0.5 * du * mm_u : 0.0,
                           window.face > 0 ? 0.5 * dv * mm_v : 0.0,
                           sum / count,
                           square};
      if (p < found.most_likely.p_value) {
        found.most_likely = spot;
        found.too_near = size_as_likely(std::max(p, kBeyondDoubt));
      }
      if (!fuller) return;
      found.fullest = spot;
      found.square = square;
    });
  }

  const FlankGeometry& geometry_;
  const std::vector<float>& row_um_;
  const std::vector<int>& patch_of_row_;
  std::vector<float> loud_of_patch_;
  int cells_ = 0;
  std::array<double, 2> excess_{};  ///< kurtosis of single values of a side
  std::array<double, 2> degrees_{};  ///< with which the flanks' loudness is known
  std::map<std::pair<int, int>, Field> fields_;
  std::vector<FlankSpot> together_;  ///< points that lie far off
};

}  // namespace

std::vector<FlankSpot> spots_of_scans(const FlankGeometry& geometry, const Observations& table,
                                      const Patches& patches, const std::vector<float>& row_um) {
  return SpotSearch(geometry, table, patches, row_um).run();
}

}  // namespace trueflank::loop
