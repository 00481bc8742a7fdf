// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/course_forms.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "trueflank/base/units.h"

namespace trueflank::loop {
namespace {

using CourseKind = CourseFinding::Kind;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Orthonormal cosines over the rows: errors that hang together are nearly independent in them.
MatrixXd cosines(Index m) {
  MatrixXd c(m, m);
  for (Index k = 0; k < m; ++k)
    for (Index i = 0; i < m; ++i)
      c(k, i) = std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(m)) *
                std::cos(kPi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) /
                         static_cast<double>(m));
  return c;
}

}  // namespace

CourseForms::CourseForms(Index m) : basis(cosines(m)) {
  for (Index i = 2; i <= m - 2; ++i) {
    VectorXd step = VectorXd::Zero(m);
    step.tail(m - i).setOnes();
    add(CourseKind::kStep, static_cast<double>(i), 0.0, std::move(step));
  }
  const VectorXd line = VectorXd::LinSpaced(m, -1.0, 1.0);
  for (Index i = std::max<Index>(3, m / 16); i <= m - std::max<Index>(3, m / 16); ++i) {
    VectorXd kink = VectorXd::Zero(m);
    for (Index k = i; k < m; ++k)
      kink[k] = (static_cast<double>(k - i) + 0.5) / static_cast<double>(m - i);
    kink.array() -= kink.mean();
    const double slope = kink.dot(line) / line.squaredNorm();
    kink -= slope * line;
    add(CourseKind::kKink, static_cast<double>(i), 0.0, std::move(kink));
    // (the line goes from the middle of the first row to that of the last)
    forms.back().line_slope = 2.0 * slope * static_cast<double>(m - i) / static_cast<double>(m - 1);
  }
  for (double width = 1.2; width < 0.25 * static_cast<double>(m); width *= 1.6)
    for (double at = 0.5; at < static_cast<double>(m); at += std::max(0.5, 0.4 * width)) {
      VectorXd band(m);
      for (Index i = 0; i < m; ++i) {
        const double off = (static_cast<double>(i) + 0.5 - at) / width;
        band[i] = std::exp(-off * off);
      }
      add(CourseKind::kBand, at, width, std::move(band));
    }
}

void CourseForms::add(CourseKind kind, double at, double width, VectorXd values) {
  values.array() -= values.mean();
  const double square = values.squaredNorm();
  const VectorXd line = VectorXd::LinSpaced(values.size(), -1.0, 1.0);
  VectorXd beside = values - values.dot(line) / line.squaredNorm() * line;
  VectorXd powers = (basis * values).cwiseAbs2(), powers_beside = (basis * beside).cwiseAbs2();
  const double square_beside = beside.squaredNorm();
  forms.push_back({.kind = kind,
                   .at = at,
                   .width = width,
                   .values = std::move(values),
                   .square = square,
                   .powers = std::move(powers),
                   .beside_line = std::move(beside),
                   .powers_beside_line = std::move(powers_beside),
                   .square_beside_line = square_beside});
}

const CourseForms& forms_of_rows(Index m) {
  constexpr std::size_t kMostKept = 2;
  thread_local std::deque<CourseForms> kept;
  for (const CourseForms& known : kept)
    if (known.basis.rows() == m) return known;
  if (kept.size() == kMostKept) kept.pop_front();
  return kept.emplace_back(m);
}

}  // namespace trueflank::loop
