// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "trueflank/base/legendre.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// Any course over one quantity: what humps and jumps need, where no single degree would be seen.
namespace trueflank::loop::drive_effects {

namespace {

constexpr int kDegrees = 5;

int degrees_of(const DriveShape& shape) { return std::min(kDegrees, static_cast<int>(shape[1])); }

}  // namespace

DriveFamily unnamed_course() {
  DriveFamily f = without_a_name();
  f.parameters = {"degree_0", "degree_1", "degree_2", "degree_3", "degree_4"};
  f.shape_names = {"over", "levels"};
  f.preference = 7;
  f.columns = degrees_of;
  f.over = first_value;
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    for (int over = 0; over < 3; ++over)
      if (context.table.levels[over] >= 3)
        shapes.push_back({double(over), double(context.table.levels[over])});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    const double x = coordinate(context, p, shape[0]);
    for (int k = 0; k < degrees_of(shape); ++k) c[k] = -context.lever(p) * legendre(k, x);
  };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext*) {
    return std::string("with a course over the ") + name_of_quantity(shape[0]);
  };
  // As many terms as it has degrees.
  f.term_shapes = [](const DriveShape& shape) {
    std::vector<DriveShape> terms;
    for (int k = 0; k < degrees_of(shape); ++k) {
      terms.push_back({0.0, 0.0, 0.0, 0.0, 0.0});
      terms.back()[static_cast<std::size_t>(shape[0])] = k;
    }
    return terms;
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
