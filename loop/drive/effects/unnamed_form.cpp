// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/legendre.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// Loss torque at the input as Legendre over load x speed x temperature, alike or opposite in the two
// directions, or a wave over the input's angle. It describes and is given no cause.
namespace trueflank::loop::drive_effects {

namespace {

/// Degrees of the load, speed and temperature that the bench's range can carry.
std::vector<DriveShape> smooth_shapes(const DriveContext& context) {
  const bool speed = context.table.most_speed_rpm > 1.2 * context.table.least_speed_rpm;
  const bool warm = context.table.has_temperature && context.table.temperature_span_c >= 3.0;
  const bool both = context.table.has(true) && context.table.has(false);
  std::vector<DriveShape> shapes;
  for (int load = 0; load <= 3; ++load)
    for (int fast = 0; fast <= (speed ? 3 : 0); ++fast)
      for (int hot = 0; hot <= (warm ? 3 : 0); ++hot) {
        if (load + fast + hot > 3 || (hot > 1 && load + fast > 1)) continue;
        for (int opposite = 0; opposite <= (both ? 1 : 0); ++opposite)
          shapes.push_back({double(load), double(fast), double(hot), 0.0, double(opposite)});
      }
  return shapes;
}

std::string course(int degree, const char* over) {
  switch (degree) {
    case 0: return "";
    case 1: return std::string(", sloping over the ") + over;
    case 2: return std::string(", curved over the ") + over;
    case 3: return std::string(", S-shaped over the ") + over;
    default: return std::string(", W-shaped over the ") + over;
  }
}

std::string in_words(const DriveModel& model, const DriveShape& s) {
  std::string text;
  if (s[3] != 0.0) text = wave_in_words(model, s[3]);
  else if (s[0] + s[1] + s[2] == 0.0) text = "constant";
  else
    text = (course(static_cast<int>(s[0]), "load") + course(static_cast<int>(s[1]), "speed") +
            course(static_cast<int>(s[2]), "temperature")).substr(2);
  return text + (s[4] != 0.0 ? ", opposite in the two directions" : "");
}

}  // namespace

DriveFamily unnamed_form() {
  DriveFamily f = without_a_name();
  f.parameters = {"cos_nm", "sin_nm"};
  f.shape_names = {"load_degree", "speed_degree", "temperature_degree", "order", "opposite_directions"};
  f.columns = [](const DriveShape& shape) { return shape[3] != 0.0 ? 2 : 1; };
  f.shapes = smooth_shapes;
  f.order = [](const DriveShape& shape) { return shape[3]; };
  f.shape_of_wave = [](double order, bool opposite) {
    return DriveShape{0.0, 0.0, 0.0, order, opposite ? 1.0 : 0.0};
  };
  f.piece_over = [](const DriveShape& s) {
    if (s[3] != 0.0) return kOverSeveral;
    double over = kOverNothing;
    for (const std::size_t k : {0U, 1U, 2U})
      if (s[k] != 0.0) over = over == kOverNothing ? static_cast<double>(k) : kOverSeveral;
    return over;
  };
  f.beside_load = [](const DriveShape& s) {
    if (s[3] != 0.0 || s[0] == 0.0 || (s[1] != 0.0) == (s[2] != 0.0)) return kOverNothing;
    return s[1] != 0.0 ? 1.0 : 2.0;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
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
  f.words = [](const DriveModel& model, const DriveShape& shape, const DriveContext*) {
    return in_words(model, shape);
  };
  f.term_shapes = [](const DriveShape& shape) { return std::vector<DriveShape>{shape}; };
  return f;
}

}  // namespace trueflank::loop::drive_effects
