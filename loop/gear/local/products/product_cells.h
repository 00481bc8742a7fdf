// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "trueflank/loop/gear/effects/simple_courses.h"
#include "trueflank/loop/gear/local/products/likeliest_products.h"

// Residuals summed in cells of every flank, and courses in these: what likeliest_products.h seeks
// in.
namespace trueflank::loop::product_cells {

using gear_effects::AroundCourse;
using gear_effects::FlankCourse;

inline constexpr int kProductCells = 32;

/// Sums of weights and of weighted residuals.
struct Sum {
  double weight = 0.0, value = 0.0;
  void operator+=(const Sum& other) {
    weight += other.weight;
    value += other.value;
  }
};
using Along = std::array<Sum, kProductCells>;
using OverFlank = std::array<Along, kProductCells>;  ///< [profile][face]

/// What is measured of the flank of a tooth.
struct OfFlank {
  Along profile{}, face{};
  OverFlank both{};     ///< of scans
  double square = 0.0;  ///< of the residuals
};

/// A course with its values in the middles of the cells.
struct CourseInCells {
  FlankCourse course;
  std::array<double, kProductCells> values{};
};
/// Of all kinds over the profile (0) or the face (1).
[[nodiscard]] std::vector<CourseInCells> in_cells(const FlankGeometry& geometry, double face);

/// Both flanks alike, both in opposite directions, or one of them.
struct FlankWay {
  FlankChoice flank;
  bool opposite;
  std::array<double, 2> signs;  ///< of the clockwise side and the other
};
[[nodiscard]] std::array<FlankWay, 4> flank_ways(const FlankGeometry& geometry);

/// A form and what it takes out.
struct Likely {
  double gain = 0.0;
  Effect form;
};

inline constexpr double kNearly =
    0.5;  // of what the best takes out: in its place it may be the best

/// How forms may go from tooth to tooth: a row each, of every tooth.
struct Arounds {
  std::vector<AroundCourse> courses;
  Eigen::MatrixXd on_teeth, squares;
  Eigen::ArrayXd beside_free_form;  ///< 0 of a mean and waves, 1 of others
  Eigen::ArrayXd beside_motions;    ///< 0 of one wave a turn, as what moves aside has it
};
[[nodiscard]] Arounds arounds_of(const FlankGeometry& geometry);
/// One tooth in so many alone.
[[nodiscard]] Arounds combs_around(const FlankGeometry& geometry);

using OfTeeth = std::vector<std::array<OfFlank, 2>>;
[[nodiscard]] OfTeeth sums_of(const FlankGeometry& geometry, const Observations& table,
                              const Patches& patches, const std::vector<float>& row_um);

/// Waves that a course in the other direction weighs (of scans), or one around the gear: lists of
/// unnamed_crossed_waves.
[[nodiscard]] std::vector<LikelyForms> likeliest_waves(const FlankGeometry& geometry,
                                                       const OfTeeth& teeth,
                                                       const std::vector<CourseInCells>& profiles,
                                                       const std::vector<CourseInCells>& faces,
                                                       const Arounds& arounds, bool scan);

/// Waves along one direction that go from tooth to tooth by one of these courses.
[[nodiscard]] std::vector<LikelyForms> likeliest_waves_by(const FlankGeometry& geometry,
                                                          const OfTeeth& teeth, int face,
                                                          double fewest_waves,
                                                          const std::vector<AroundCourse>& courses);

/// Waves over the profile that are the same on every tooth, beside the set of effects that leaves
/// least with them.
[[nodiscard]] LikelyWavesBeside likeliest_profile_waves(
    const FlankGeometry& geometry, const OfTeeth& teeth,
    const std::vector<std::vector<Effect>>& besides);

/// Waves of an order around the gear whose size follows a course along the flanks: lists of
/// unnamed_crossed_order.
[[nodiscard]] std::vector<LikelyForms> likeliest_orders(const FlankGeometry& geometry,
                                                        const OfTeeth& teeth,
                                                        const std::vector<CourseInCells>& profiles,
                                                        const std::vector<CourseInCells>& faces,
                                                        bool scan, const OrderAsked& asked);

/// Steps over the profile (0) or the face (1) that are the same on every tooth: lists of
/// unnamed_step, one for each way of flanks, sharp and with edges. A level is free beside them;
/// `beside_names`: so are a slope and a bow.
[[nodiscard]] std::vector<LikelyForms> likeliest_steps(const FlankGeometry& geometry,
                                                       const OfTeeth& teeth, double face,
                                                       bool beside_names);

/// The same of jumps that die away (unnamed_fading_jump), of skewed hollows (unnamed_skewed_band)
/// of sawteeth (unnamed_sawtooth) and of facets (unnamed_arches).
[[nodiscard]] std::vector<LikelyForms> likeliest_jumps(const FlankGeometry& geometry,
                                                       const OfTeeth& teeth, double face,
                                                       bool beside_names);
/// Two steps and rises at the ends, three, ...: those of a list stand beside each other.
[[nodiscard]] std::vector<LikelyForms> likeliest_stairs(const FlankGeometry& geometry,
                                                        const OfTeeth& teeth, double face,
                                                        bool beside_names);

}  // namespace trueflank::loop::product_cells
