// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/gear/local/patches.h"
#include "trueflank/loop/gear/table/alike_rows.h"
#include "trueflank/loop/gear/table/shared_table.h"

namespace trueflank::loop {

/// The least squares of PointFit where shapes are tried one after another: columns of effects that
/// stay as they are, and their products, are kept. Of a fit only the residual square and the
/// coefficients are known; no errors. With a stride only every n-th value is used.
///
/// On traces most shapes that are tried are the same on every tooth. Their columns are one value
/// for each kind of rows that differ by the tooth alone, and their products with what stands follow
/// from sums of that over these rows. Of a scan that is done where cells are given, for shapes that
/// are tried alone (rows_of_cells). Shapes that are a form times a factor of the tooth ask for sums
/// over teeth of that form once, and then for the factors of teeth alone.
class TrialFit {
 public:
  TrialFit(const FlankGeometry& geometry, const SharedTable& table, const Patches& patches,
           std::vector<Effect> effects, std::size_t stride = 1, FlankCells cells = {});

  struct Trial {
    double square = 0.0;    ///< weighted residual square
    double retained = 1.0;  ///< least share of the effect's columns that is left beside all others
  };
  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }
  [[nodiscard]] double residual_square() const { return square_; }
  /// Coefficients of an effect's columns.
  [[nodiscard]] Eigen::VectorXd coefficients(std::size_t effect) const;
  /// The fit as it is, judged by one effect.
  [[nodiscard]] Trial as_is(std::size_t effect) const;
  /// The fit with each of other shapes of one effect (of as many columns), on all processors. What is retained
  /// is asked of those alone whose square is below `below`; 0 of the others.
  [[nodiscard]] std::vector<Trial> with_shapes(std::size_t effect,
                                               const std::vector<EffectShape>& shapes,
                                               double below) const;
  /// Puts shapes in place of those that effects have.
  void set_shapes(const std::vector<Effect>& effects);
  /// Puts another in the place of the last effect, digit for digit as if it had stood there from
  /// the beginning. False, and nothing is done, where that would not be so: of scans in other
  /// cells, of another number of columns.
  [[nodiscard]] bool put_effect(std::size_t effect, const Effect& other, FlankCells cells = {});
  /// The columns of an effect, weighted, zeros of traces taken out: one row a value that counts.
  [[nodiscard]] Eigen::MatrixXd columns_of(const Effect& effect) const;
  /// What effects' columns change by from one shape to another, times coefficients: a column each.
  struct Change {
    Effect from, to;
    Eigen::VectorXd coefficients;
  };
  /// Coefficients of such columns, fitted jointly with all that is there.
  [[nodiscard]] Eigen::VectorXd joint_coefficients(const std::vector<Change>& more) const;

 private:
  struct Row {
    std::uint32_t row = 0;
    int trace = -1;
    double root = 0.0;  ///< of its weight
  };
  /// Of a trace, from one place in rows_ to before another.
  struct Run {
    int trace = 0;
    std::size_t first = 0, end = 0;
  };
  /// Columns with a row for each value (weighted, zeros taken out) or for each kind of rows (neither).
  struct Columns {
    Eigen::MatrixXd values;
    bool of_kinds = false;
  };
  /// Normal equations of all but one effect.
  struct Others;
  void find_alike(FlankCells cells);
  [[nodiscard]] bool is_of_kinds(const Effect& effect) const;
  [[nodiscard]] bool has_exact_kinds() const { return alike_ && table_.points_mm.empty(); }
  /// Where a row's place is, of a row that has one with a weight of 1.
  struct PlaceOfRow {
    std::uint32_t place = 0;
    std::int32_t tooth = 0;  ///< 0: on no flank
    FlankChoice flank = FlankChoice::kBoth;
    std::int8_t side = 0;  ///< 0: on no flank
    bool is_one = false;   ///< false: it has several, or another weight
  };
  /// Rows of the table, and how they are known to its EffectValues.
  struct RowSet {
    std::vector<std::uint32_t> rows;
    std::uint64_t key = 0;
    std::vector<PlaceOfRow> places;
    bool of_scan = false;  ///< each row has one place
  };
  [[nodiscard]] RowSet row_set(std::vector<std::uint32_t> rows) const;
  [[nodiscard]] EffectValues::Values values_at(const Effect& effect, const RowSet& at) const;
  void put_values(const Effect& effect, const RowSet& at, Eigen::MatrixXd& columns) const;
  void put_product_of_courses(const Effect& effect, const RowSet& at,
                              Eigen::MatrixXd& columns) const;
  void put_product_of_parts(const Effect& effect, const RowSet& at, Eigen::MatrixXd& columns) const;
  [[nodiscard]] Columns short_columns_of(const Effect& effect) const;
  [[nodiscard]] Eigen::MatrixXd zeros_of_kinds(const Eigen::MatrixXd& values) const;
  [[nodiscard]] Eigen::MatrixXd full(const Columns& columns) const;
  [[nodiscard]] Eigen::MatrixXd products_with_all(const Columns& columns) const;
  [[nodiscard]] std::vector<Eigen::MatrixXd> products_of_several(
      const std::vector<Columns>& several) const;
  [[nodiscard]] Eigen::MatrixXd own_products(const Columns& columns) const;
  void find_places_on_flanks();
  [[nodiscard]] bool is_form_times_tooth(const Effect& effect) const;
  [[nodiscard]] std::vector<double> form_of(const Effect& effect) const;
  struct FormOnTeeth;
  template <int count>
  void add_over_teeth(const std::vector<double>& rooted, Eigen::Index first,
                      Eigen::MatrixXd& sums) const;
  void sum_up(FormOnTeeth& form) const;
  [[nodiscard]] std::pair<Eigen::MatrixXd, Eigen::MatrixXd> products_of_teeth(
      const Effect& effect, const FormOnTeeth& form) const;
  /// Products of an effect's columns with all columns, and with each other, for each of its shapes,
  /// on all processors.
  void for_forms_times_teeth(
      const Effect& effect, const std::vector<EffectShape>& shapes,
      const std::function<void(std::size_t, const Eigen::MatrixXd&, Eigen::MatrixXd)>& take) const;
  void find_runs();
  template <class Value>
  void means_of_traces(const Value& value, double* means) const;
  void centre(Eigen::MatrixXd& columns) const;
  void put_columns(const std::vector<std::size_t>& effects);
  void sum_over_kinds(Eigen::Index first, Eigen::Index count);
  void put_products(const std::vector<std::size_t>& effects);
  void solve();

  const FlankGeometry& geometry_;
  SharedTable shared_;
  const Observations& table_;
  std::vector<Effect> effects_;
  FlankCells cells_;
  std::vector<Eigen::Index> first_column_;
  std::vector<Row> rows_;
  std::vector<double> root_, weight_;  ///< of the same, beside each other
  std::vector<Run> runs_;
  RowSet all_rows_, first_of_kinds_;
  std::optional<AlikeRows> alike_;          ///< where rows are alike
  /// A place of a row on a flank, and which of the kinds' places it is; places of rows that have
  /// several come after those of all kinds.
  struct PlaceOnFlank {
    std::uint32_t row = 0, kind = 0;
    int tooth = 0;
  };
  std::vector<PlaceOnFlank> on_flanks_;         ///< where kinds are exact
  std::vector<std::uint32_t> places_of_kinds_;  ///< in the table; of a kind on no flank its first
  std::vector<double> trace_weight_;
  Eigen::VectorXd kind_weight_;
  Eigen::MatrixXd kind_products_;  ///< weights less what zeros take; empty: not worth it
  Eigen::MatrixXd columns_;  ///< nuisance, effects, the value last
  Eigen::MatrixXd of_kinds_;  ///< sums of these over rows of a kind, each times the root of its weight
  Eigen::MatrixXd gram_;
  Eigen::VectorXd coefficients_;
  double square_ = 0.0;
};

}  // namespace trueflank::loop
