// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

namespace trueflank::loop::drive_effects {

namespace {

std::string place_in_words(const DriveShape& s, const DriveContext* context, const char* what) {
  const std::string text = std::string("with a ") + what + " over the " + name_of_quantity(s[0]);
  if (context == nullptr) return text;
  return text + " at " + short_text(context->quantity_at(s[0], s[1])) +
         (s[0] == 0.0 ? " N m at the input" : s[0] == 1.0 ? " rpm" : " C");
}

/// A step at a place, or a hump about one, over load, speed or temperature (in -1 ... 1 of the range).
DriveFamily at_a_place(bool hump) {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"over", "place"};
  f.over = first_value;
  f.shape_values = {{},
                    {.continuous = true,
                     .is_place = true,
                     .limits = [](const DriveContext&) { return std::pair(-0.95, 0.95); }}};
  if (hump) {
    f.shape_names.push_back("width");
    f.shape_values.push_back(
        {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.08, 0.8); }});
  }
  f.shapes = [hump](const DriveContext& context) {
    std::vector<DriveShape> shapes;
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
  f.evaluate = [hump](const DriveContext& context, const BenchPoint& p, const DriveShape& shape, double* c) {
    const double x = coordinate(context, p, shape[0]) - shape[1];
    const double size = hump ? std::exp(-x * x / (shape[2] * shape[2])) : x > 0.0 ? 1.0 : 0.0;
    c[0] = -context.lever(p) * size;
  };
  f.words = [hump](const DriveModel&, const DriveShape& shape, const DriveContext* context) {
    return place_in_words(shape, context, hump ? "hump" : "step");
  };
  f.term_shapes = [](const DriveShape&) {
    return std::vector<DriveShape>{{0.0, 0.0, 0.0, 0.0, 0.0}};
  };
  return f;
}

}  // namespace

DriveFamily unnamed_step() { return at_a_place(false); }
DriveFamily unnamed_hump() { return at_a_place(true); }

}  // namespace trueflank::loop::drive_effects
