// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trueflank/loop/discovery/course_scan.h"

// Forms that courses over the same places are asked for. Knows nothing of gears.
namespace trueflank::loop {

/// A step, band or kink along a course, about its mean; a kink beside the straight line.
struct CourseForm {
  CourseFinding::Kind kind = CourseFinding::Kind::kStep;
  double at = 0.0, width = 0.0;  ///< [rows]
  Eigen::VectorXd values;
  double square = 0.0;
  double line_slope = 0.0;  ///< kKink: what was taken off, a course of a slope's bend
  Eigen::VectorXd powers;   ///< squares of its coefficients on the cosines
  /// Steps and bands beside the straight line.
  Eigen::VectorXd beside_line, powers_beside_line;
  double square_beside_line = 0.0;
};

/// What courses of so many rows are asked for; the same whatever they hold.
struct CourseForms {
  explicit CourseForms(Eigen::Index rows);
  Eigen::MatrixXd basis;  ///< orthonormal cosines
  std::vector<CourseForm> forms;

 private:
  void add(CourseFinding::Kind kind, double at, double width, Eigen::VectorXd values);
};

/// A loop asks a few times for the same two numbers of rows: those asked for last are at hand.
[[nodiscard]] const CourseForms& forms_of_rows(Eigen::Index rows);

}  // namespace trueflank::loop
