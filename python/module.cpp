// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.h"

PYBIND11_MODULE(_core, module) {
  using namespace trueflank::python;
  module.doc() = "The compiled part of trueflank; import trueflank instead.";
  module.attr("__version__") = TRUEFLANK_VERSION;
  register_failures();
  bind_mesh(module);
  bind_gear(module);
  bind_gearbox(module);
  bind_loop(module);
  bind_search(module);
}
