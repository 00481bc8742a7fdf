// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "trueflank/loop/drive/drive_fit.h"

// Where a form without a name may lie, by what every place would leave.
namespace trueflank::loop {

struct PlaceProfile {
  DriveShape shape;  ///< the one to be told
  double coefficient = 0.0;
  std::vector<Parameter> figures;  ///< of the family, with 95 % intervals
};

/// All shapes of the effect are tried beside the other effects as they are: those that leave no
/// more than `square_more` above the least are inside the interval. Of these one that was run is
/// told before others. Guarantees: the told figures lie in their intervals. Not that the other
/// effects' shapes are free.
[[nodiscard]] PlaceProfile profile_of_place(const DriveContext& context,
                                            const Eigen::VectorXd& value,
                                            const std::vector<DriveEffect>& effects,
                                            std::size_t effect, FitRows rows, double square_more);

/// Columns beside those of other effects: what one of them more would take off.
class BesideEffects {
 public:
  BesideEffects(const DriveContext& context, const Eigen::VectorXd& value,
                const std::vector<DriveEffect>& effects, FitRows rows);
  struct Alone {
    double gain = 0.0;  ///< squared error, in the noise's units, that it takes off
    double coefficient = 0.0;
    double error_square = 0.0;  ///< of the coefficient, for a noise of 1
  };
  /// Of an effect of one column.
  [[nodiscard]] Alone with(const DriveEffect& effect) const {
    Room room;
    return with_column(column_of(effect), room);
  }
  /// The same of many shapes of a family, on all processors.
  [[nodiscard]] std::vector<Alone> with_each(const DriveFamily& family,
                                             const std::vector<DriveShape>& shapes) const;
  /// The columns of effects, one each, in single precision; on all processors.
  [[nodiscard]] Eigen::MatrixXf columns_of(const std::vector<DriveEffect>& effects) const;
  /// The same of many columns of one each, as column_of() gives them: what each takes off.
  [[nodiscard]] Eigen::VectorXf gains(const Eigen::MatrixXf& columns) const;
  /// What a column needs beside it: kept from one to the next.
  struct Room {
    Eigen::VectorXd inside, held, own;
  };
  /// The same of a column, as column_of() gives it.
  [[nodiscard]] Alone with_column(const Eigen::VectorXd& column, Room& room) const;
  /// An effect's column in the noise's units, 0 for rows not seen.
  [[nodiscard]] Eigen::VectorXd column_of(const DriveEffect& effect) const {
    Eigen::VectorXd column;
    put_column(context_, *effect.family, effect.shape, column);
    return column;
  }
  /// The same in the room of another. `context`: this one's, or a copy for one thread.
  void put_column(const DriveContext& context, const DriveFamily& family, const DriveShape& shape,
                  Eigen::VectorXd& column) const;
  /// Share of the squares of its column that the others do not hold.
  [[nodiscard]] double own_share(const DriveEffect& effect) const;
  /// What the others alone leave.
  [[nodiscard]] double square() const { return left_.squaredNorm(); }
  /// Columns that are independent.
  [[nodiscard]] int columns() const { return static_cast<int>(others_.cols()); }

 private:
  const DriveContext& context_;
  Eigen::VectorXd weight_;  ///< 0 for rows not seen
  Eigen::MatrixXd others_;  ///< orthonormal
  Eigen::VectorXd left_;
};

/// Of what falls in steps over its places the best near by.
[[nodiscard]] DriveEffect nearest_best(const DriveContext& context, const BesideEffects& beside,
                                       const DriveEffect& form);

/// A form that is asked beside others.
struct AskedForm {
  const BesideEffects* beside = nullptr;  ///< all of the same rows
  DriveEffect form;
};
/// The same of many, in their place: those about the same shape share the columns.
void move_to_nearest_best(const DriveContext& context, std::span<AskedForm> asked);

}  // namespace trueflank::loop
