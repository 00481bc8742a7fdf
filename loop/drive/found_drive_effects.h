// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "trueflank/loop/drive/bench_remainder.h"
#include "trueflank/loop/drive/drive_fit.h"
#include "trueflank/loop/result/loop_result.h"

// From chosen columns to what people read: parameters with intervals, words, what cannot be told apart.
namespace trueflank::loop {

struct DriveSources {
  const DriveContext& context;        ///< at the state of the fit to all rows
  const DriveFit& all;                ///< fitted to all rows
  const DriveFit& training;           ///< the same effects fitted without the hold-out
  const Eigen::VectorXd& value;
  const BenchRemainder& remainder;    ///< what the fit to all rows leaves
  const std::vector<ChosenGroup>& chosen;  ///< of the engine, in the order of the effects
  const std::vector<DriveEffect>& candidates;
  /// id -> ids that predict as well in its place.
  const std::map<std::string, std::set<std::string>>& exchangeable;
  /// Of the effects, in their order: figures with intervals of those that have any.
  const std::vector<std::vector<Parameter>>& figures;
};

/// Parameters of one effect of a fit with their 95 % intervals: its shape, its amounts, the figures they hold at.
[[nodiscard]] std::vector<Parameter> drive_parameters(const DriveFit& fit, const Eigen::MatrixXd& covariance,
                                                      int effect);

/// Named effects in the order they were chosen, unnamed terms gathered by their order.
[[nodiscard]] std::vector<FoundEffect> describe_drive_effects(const DriveSources& sources);

/// A candidate in words: "angle_periodic_friction at 0.1176 per input turn (carrier)".
[[nodiscard]] std::string words_for(const DriveModel& model, const DriveEffect& effect,
                                    const DriveContext* context = nullptr);

/// The run that would separate what is confounded, or show what this bench cannot.
[[nodiscard]] std::vector<std::string> runs_that_separate(const BenchTable& table,
                                                          const std::vector<FoundEffect>& effects);

/// Plain root mean squares [N m] and in points of efficiency of the loaded rows.
[[nodiscard]] ErrorFigures drive_errors(const DriveContext& context, const Eigen::VectorXd& left_all,
                                        const Eigen::VectorXd& left_training);

}  // namespace trueflank::loop
