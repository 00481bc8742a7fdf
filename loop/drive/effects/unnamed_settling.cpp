// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// What dies away from the start of the run on: seals and grease that settle, teeth that run in. A
// drive that warms up over the same run loses less in nearly the same course: the rows say which of
// the two it is, or that they cannot.
namespace trueflank::loop::drive_effects {

DriveFamily unnamed_settling() {
  DriveFamily f = without_a_name();
  f.parameters = {"amount_nm"};
  f.shape_names = {"what", "share_of_run"};
  f.preference = 8;
  f.follows_the_run = true;
  // A slower one is a slope over the run, which has names.
  f.shape_values = {
      {}, {.continuous = true, .limits = [](const DriveContext&) { return std::pair(0.02, 0.4); }}};
  f.shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    for (const double what : {double(kFlanks), double(kDrag)})
      for (const double share : {0.06, 0.12, 0.25}) shapes.push_back({what, share});
    return shapes;
  };
  // Two that fall evenly, one fast and one slow, do nearly the same.
  f.whole_shapes = [](const DriveContext& context) {
    std::vector<DriveShape> shapes;
    if (!has_one_course(context)) return shapes;
    for (const double what : {double(kFlanks), double(kDrag)})
      for (const double share : {0.04, 0.06, 0.09, 0.13, 0.19, 0.28, 0.38})
        shapes.push_back({what, share});
    return shapes;
  };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    c[0] = changed_nm(context, p, shape[0]) * std::exp(-p.taken / shape[1]);
  };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext*) {
    return "that dies away from the start of the run on, to a third in " +
           short_text(std::round(100.0 * shape[1])) + " % of it" +
           (shape[0] == double(kFlanks)
                ? ", by the friction of the flanks (running in?)"
                : ", by the same torque at every load (running in, warmth?)");
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
