// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/loop/drive_effect.h"

// The free form: loss torque at the input as Legendre over load x speed x temperature, alike or opposite
// in the two directions, or a wave over the input's angle. It describes and is given no cause.
namespace trueflank::loop {
namespace {

using Shape = std::vector<double>;

double legendre(int degree, double x) {
  if (degree == 0) return 1.0;
  double before = 1.0, now = x;
  for (int k = 1; k < degree; ++k) {
    const double next = ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0);
    before = now;
    now = next;
  }
  return now;
}

/// Degrees of the load, speed and temperature that the bench's range can carry.
std::vector<Shape> smooth_shapes(const DriveContext& context) {
  const bool speed = context.table.most_speed_rpm > 1.2 * context.table.least_speed_rpm;
  const bool warm = context.table.has_temperature && context.table.temperature_span_c >= 3.0;
  const bool both = context.table.has(true) && context.table.has(false);
  std::vector<Shape> shapes;
  for (int load = 0; load <= 3; ++load)
    for (int fast = 0; fast <= (speed ? 3 : 0); ++fast)
      for (int hot = 0; hot <= (warm ? 3 : 0); ++hot) {
        if (load + fast + hot > 3 || (hot > 1 && load + fast > 1)) continue;
        for (int opposite = 0; opposite <= (both ? 1 : 0); ++opposite)
          shapes.push_back({double(load), double(fast), double(hot), 0.0, double(opposite)});
      }
  return shapes;
}

DriveFamily free_form() {
  DriveFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.parameters = {"cos_nm", "sin_nm"};
  f.shape_names = {"load_degree", "speed_degree", "temperature_degree", "order", "opposite_directions"};
  f.named = false;
  f.preference = 6;
  f.columns = [](const Shape& shape) { return shape[3] != 0.0 ? 2 : 1; };
  f.shapes = smooth_shapes;  // waves are proposed by the spectrum of what is left (likeliest_order)
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    double value = -context.lever(p);
    if (shape[0] > 0.0) value *= legendre(static_cast<int>(shape[0]), context.load_coordinate(p));
    if (shape[1] > 0.0) value *= legendre(static_cast<int>(shape[1]), context.speed_coordinate(p));
    if (shape[2] > 0.0) value *= legendre(static_cast<int>(shape[2]), context.temperature_coordinate(p));
    if (shape[4] != 0.0 && !p.forward) value = -value;
    if (shape[3] == 0.0) {
      c[0] = value;
      return;
    }
    c[0] = value * std::cos(shape[3] * p.angle_rad);
    c[1] = value * std::sin(shape[3] * p.angle_rad);
  };
  return f;
}

constexpr int kCourseDegrees = 5;

double coordinate(const DriveContext& context, const BenchPoint& p, double over) {
  return over == 0.0   ? context.load_coordinate(p)
         : over == 1.0 ? context.speed_coordinate(p)
                       : context.temperature_coordinate(p);
}

/// Any course over one quantity: what humps and jumps need, where no single degree would be seen.
DriveFamily free_course() {
  DriveFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.parameters = {"degree_0", "degree_1", "degree_2", "degree_3", "degree_4"};
  f.shape_names = {"over", "levels"};
  f.named = false;
  f.preference = 7;
  f.columns = [](const Shape& shape) { return std::min(kCourseDegrees, static_cast<int>(shape[1])); };
  f.shapes = [](const DriveContext& context) {
    std::vector<Shape> shapes;
    for (int over = 0; over < 3; ++over)
      if (context.table.levels[over] >= 3)
        shapes.push_back({double(over), double(context.table.levels[over])});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const double x = coordinate(context, p, shape[0]);
    const int columns = std::min(kCourseDegrees, static_cast<int>(shape[1]));
    for (int k = 0; k < columns; ++k) c[k] = -context.lever(p) * legendre(k, x);
  };
  return f;
}

/// A step at a place, or a hump about one, over load, speed or temperature (in -1 ... 1 of the range).
DriveFamily free_place(bool hump) {
  DriveFamily f;
  f.id = "unnamed";
  f.description = "structure that no named effect explains";
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place"};
  f.shape_continuous = {false, true};
  f.named = false;
  f.preference = 6;
  if (hump) {
    f.shape_names.push_back("width");
    f.shape_continuous.push_back(true);
  }
  f.shapes = [hump](const DriveContext& context) {
    std::vector<Shape> shapes;
    for (int over = 0; over < 3; ++over) {
      if (context.table.levels[over] < 4) continue;
      for (double place : {-0.75, -0.5, -0.25, 0.05, 0.25, 0.5, 0.75}) {
        if (!hump) shapes.push_back({double(over), place});
        else
          for (double width : {0.15, 0.35}) shapes.push_back({double(over), place, width});
      }
    }
    return shapes;
  };
  f.evaluate = [hump](const DriveContext& context, const BenchPoint& p, const Shape& shape, double* c) {
    const double x = coordinate(context, p, shape[0]) - shape[1];
    const double size = hump ? std::exp(-x * x / (shape[2] * shape[2])) : x > 0.0 ? 1.0 : 0.0;
    c[0] = -context.lever(p) * size;
  };
  return f;
}

}  // namespace

std::vector<DriveFamily> drive_free_effects() {
  return {free_form(), free_course(), free_place(false), free_place(true)};
}

}  // namespace trueflank::loop
