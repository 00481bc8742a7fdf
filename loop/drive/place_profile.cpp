// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/place_profile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {
namespace {

/// A place at which something begins or jumps is no regular figure: it counts as two
/// (chi-square 5.99 for 3.84).
constexpr double kOfTwo = 1.56;
/// A column of which less than this share stands beside the others does what they do.
constexpr double kOwnShare = 1e-4;
constexpr std::size_t kAtOnce = 32;  // shapes for a processor

}  // namespace

BesideEffects::BesideEffects(const DriveContext& context, const Eigen::VectorXd& value,
                             const std::vector<DriveEffect>& effects, FitRows rows)
    : context_(context) {
  const auto& points = context.table.points;
  weight_.resize(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    weight_[static_cast<Eigen::Index>(i)] =
        rows == FitRows::kAll || points[i].fold != 0 ? 1.0 / points[i].sigma_nm : 0.0;
  const DriveFit fit(context, value, effects, rows);
  Eigen::MatrixXd columns = weight_.asDiagonal() * fit.columns();
  for (Eigen::Index c = 0; c < columns.cols(); ++c)
    columns.col(c) /= std::max(columns.col(c).norm(), 1e-300);
  if (columns.cols() > 0)
    others_ = orthonormal_columns(columns);
  else
    others_.resize(columns.rows(), 0);
  left_ = weight_.cwiseProduct(value);
  left_ -= others_ * (others_.transpose() * left_);
}

void BesideEffects::put_column(const DriveContext& context, const DriveFamily& family,
                               const DriveShape& shape, Eigen::VectorXd& column) const {
  const auto& points = context.table.points;
  column.resize(weight_.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double one = 0.0;
    if (weight_[row] > 0.0) family.evaluate(context, points[i], shape, &one);
    column[row] = weight_[row] * one;
  }
}

Eigen::VectorXf BesideEffects::gains(const Eigen::MatrixXf& columns) const {
  constexpr float kOwn = 1e-3F;  // of single precision
  const Eigen::MatrixXf others = others_.cast<float>();
  const Eigen::VectorXf left = left_.cast<float>(), whole = columns.colwise().squaredNorm(),
                        product = columns.transpose() * left;
  Eigen::VectorXf own = whole;
  if (others.cols() > 0) own -= (others.transpose() * columns).colwise().squaredNorm().transpose();
  return (own.array() > kOwn * whole.array() && whole.array() > 0.0F)
      .select(product.array().square() / own.array().max(1e-30F), 0.0F);
}

double BesideEffects::own_share(const DriveEffect& effect) const {
  Eigen::VectorXd column = column_of(effect);
  const double whole = column.squaredNorm();
  column -= others_ * (others_.transpose() * column);
  return whole > 0.0 ? column.squaredNorm() / whole : 0.0;
}

BesideEffects::Alone BesideEffects::with_column(const Eigen::VectorXd& column, Room& room) const {
  const double whole = column.squaredNorm();
  room.inside.noalias() = others_.transpose() * column;
  room.held.noalias() = others_ * room.inside;
  room.own = column - room.held;
  const double own = room.own.squaredNorm();
  if (!(own > kOwnShare * whole)) return {};
  const double product = room.own.dot(left_);
  return {.gain = product * product / own, .coefficient = product / own, .error_square = 1.0 / own};
}

std::vector<BesideEffects::Alone> BesideEffects::with_each(
    const DriveFamily& family, const std::vector<DriveShape>& shapes) const {
  std::vector<Alone> each(shapes.size());
  for_each_run(shapes.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    const DriveContext own = context_;  // it keeps what was asked last
    Eigen::VectorXd column;
    Room room;
    for (std::size_t k = from; k < to; ++k) {
      put_column(own, family, shapes[k], column);
      each[k] = with_column(column, room);
    }
  });
  return each;
}

Eigen::MatrixXf BesideEffects::columns_of(const std::vector<DriveEffect>& effects) const {
  Eigen::MatrixXf columns(left_.size(), static_cast<Eigen::Index>(effects.size()));
  for_each_run(effects.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
    const DriveContext own = context_;
    Eigen::VectorXd column;
    for (std::size_t k = from; k < to; ++k) {
      put_column(own, *effects[k].family, effects[k].shape, column);
      columns.col(static_cast<Eigen::Index>(k)) = column.cast<float>();
    }
  });
  return columns;
}

void move_to_nearest_best(const DriveContext& context, std::span<AskedForm> asked) {
  std::vector<double> most;
  for (const AskedForm& one : asked) most.push_back(one.beside->with(one.form).gain);
  for (int round = 0; round < 2; ++round) {
    std::map<std::pair<const DriveFamily*, DriveShape>, std::vector<std::size_t>> about;
    for (std::size_t a = 0; a < asked.size(); ++a)
      about[{asked[a].form.family, asked[a].form.shape}].push_back(a);
    for (const auto& same : about) {
      const DriveFamily& family = *same.first.first;
      const std::vector<std::size_t>& who = same.second;
      const std::vector<DriveShape> shapes = family.all_shapes(context, &same.first.second);
      Eigen::MatrixXd gains(static_cast<Eigen::Index>(who.size()),
                            static_cast<Eigen::Index>(shapes.size()));
      for_each_run(shapes.size(), kAtOnce, [&](std::size_t from, std::size_t to) {
        const DriveContext own = context;  // it keeps what was asked last
        Eigen::VectorXd column;
        BesideEffects::Room room;
        for (std::size_t k = from; k < to; ++k) {
          asked[who.front()].beside->put_column(own, family, shapes[k], column);
          for (std::size_t w = 0; w < who.size(); ++w)
            gains(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(k)) =
                asked[who[w]].beside->with_column(column, room).gain;
        }
      });
      for (std::size_t w = 0; w < who.size(); ++w)
        for (std::size_t k = 0; k < shapes.size(); ++k)
          if (const double gain = gains(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(k));
              gain > most[who[w]]) {
            most[who[w]] = gain;
            asked[who[w]].form.shape = shapes[k];
          }
    }
  }
}

DriveEffect nearest_best(const DriveContext& context, const BesideEffects& beside,
                         const DriveEffect& form) {
  AskedForm asked{&beside, form};
  move_to_nearest_best(context, {&asked, 1});
  return asked.form;
}

PlaceProfile profile_of_place(const DriveContext& context, const Eigen::VectorXd& value,
                              const std::vector<DriveEffect>& effects, std::size_t effect,
                              FitRows rows, double square_more) {
  const DriveFamily& family = *effects[effect].family;
  std::vector<DriveEffect> others = effects;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(effect));
  const BesideEffects beside(context, value, others, rows);
  struct Tried {
    DriveShape shape;
    BesideEffects::Alone alone;
  };
  std::vector<Tried> tried{{effects[effect].shape, beside.with(effects[effect])}};
  std::vector<DriveShape> shapes;
  if (family.all_shapes) shapes = family.all_shapes(context, &effects[effect].shape);
  const std::vector<BesideEffects::Alone> each = beside.with_each(family, shapes);
  for (std::size_t k = 0; k < shapes.size(); ++k) tried.push_back({std::move(shapes[k]), each[k]});
  if (family.shows && family.shows(context, tried.front().shape))
    std::erase_if(tried, [&](const Tried& t) { return !family.shows(context, t.shape); });
  // The same place in the same words: an amount of the other sign is another form.
  const double sign = tried.front().alone.coefficient;
  std::erase_if(tried, [&](const Tried& t) { return !(t.alone.coefficient * sign > 0.0); });
  PlaceProfile told{.shape = effects[effect].shape, .coefficient = sign, .figures = {}};
  if (tried.empty()) {
    told.figures = family.figures(context, told.shape, told.coefficient);
    return told;
  }
  const auto less = [](const Tried& a, const Tried& b) { return a.alone.gain < b.alone.gain; };
  const Tried* best = &*std::max_element(tried.begin(), tried.end(), less);
  const double most = best->alone.gain;
  const auto rather = [&](const auto& is_plainer) {
    const Tried* plainer = nullptr;
    for (const Tried& t : tried)
      if (most - t.alone.gain <= kOfTwo * square_more && is_plainer(t.shape) &&
          (plainer == nullptr || t.alone.gain > plainer->alone.gain))
        plainer = &t;
    if (plainer != nullptr) best = plainer;
  };
  if (family.was_run)
    rather([&](const DriveShape& shape) { return family.was_run(context, shape); });
  if (family.is_odd) rather([&](const DriveShape& shape) { return !family.is_odd(shape); });
  told.shape = best->shape;
  told.coefficient = best->alone.coefficient;
  told.figures = family.figures(context, told.shape, told.coefficient);
  for (const Tried& t : tried) {
    const double room = square_more - (most - t.alone.gain);
    if (room < (1.0 - kOfTwo) * square_more) continue;
    const double half = room > 0.0 ? std::sqrt(room * t.alone.error_square) : 0.0;
    for (const double by : {-half, 0.0, half}) {
      const std::vector<Parameter> figures =
          family.figures(context, t.shape, t.alone.coefficient + by);
      for (std::size_t k = 0; k < figures.size(); ++k) {
        told.figures[k].low = std::min(told.figures[k].low, figures[k].value);
        told.figures[k].high = std::max(told.figures[k].high, figures[k].value);
      }
    }
  }
  return told;
}

}  // namespace trueflank::loop
