// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/base/legendre.h"
#include "trueflank/loop/drive/effects/columns.h"
#include "trueflank/loop/drive/effects/registry.h"

// A course of the run that comes and goes without a jump: a zero that wanders, a room that warms
// and cools. Jumps and parts of the run only imitate it, and leave its rest.
namespace trueflank::loop::drive_effects {

namespace {

What what_of(const DriveShape& shape) { return static_cast<What>(static_cast<int>(shape[0])); }
int degree_of(const DriveShape& shape) { return static_cast<int>(shape[1]); }
/// What a zero wanders about is no offset of its own.
int first_degree(const DriveShape& shape) { return what_of(shape) == kOutputReads ? 0 : 1; }

}  // namespace

DriveFamily unnamed_wander() {
  DriveFamily f = without_a_name();
  f.parameters = {"degrees"};
  f.shape_names = {"what", "degree"};
  f.preference = 8;
  f.columns = [](const DriveShape& shape) { return 1 + degree_of(shape) - first_degree(shape); };
  // So many columns are no candidates until a scan of what is left finds something slow.
  f.shapes = no_shapes;
  f.shape_of_wander = [](double what, int degree) { return DriveShape{what, double(degree)}; };
  f.evaluate = [](const DriveContext& context, const BenchPoint& p, const DriveShape& shape,
                  double* c) {
    const double changed = changed_nm(context, p, shape[0]);
    for (int k = first_degree(shape); k <= degree_of(shape); ++k)
      *c++ = changed * legendre(k, 2.0 * p.taken - 1.0);
  };
  f.words = [](const DriveModel&, const DriveShape& shape, const DriveContext*) {
    const What what = what_of(shape);
    return std::string("that comes and goes slowly in the course of the run") +
           (what == kFlanks ? ", by the friction of the flanks (warmth, another lubricant?)"
            : what == kDrag ? ", by the same torque at every load (warmth, a seal that settles?)"
                            : ", as a zero of the output's torque that wanders");
  };
  f.term_shapes = [](const DriveShape& shape) {
    const int terms = 1 + degree_of(shape) - first_degree(shape);
    return std::vector<DriveShape>(static_cast<std::size_t>(terms), {0.0, 0.0, 0.0, 0.0, 0.0});
  };
  return f;
}

}  // namespace trueflank::loop::drive_effects
