// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "failure.h"
#include "trueflank/design/design_file.h"
#include "trueflank/solid/gear_mesh.h"
#include "trueflank/solid/part_shape.h"
#include "trueflank/train/gear_train.h"

// The Python module, one part a file. Texts of JSON become dicts by Python's own json: the numbers
// are those of the program's files, null is None.
namespace trueflank::python {

namespace py = pybind11;

/// A design laid out, with its parts made when first asked for.
class Gearbox {
 public:
  Gearbox(DesignFile file, GearTrain train)
      : file_(std::move(file)), train_(std::make_unique<GearTrain>(std::move(train))) {}
  static std::shared_ptr<Gearbox> of(ResultAll<DesignFile> file);

  [[nodiscard]] const GearTrain& train() const { return *train_; }
  [[nodiscard]] const DesignFile& file() const { return file_; }
  /// Throws Failure where the parts cannot be made.
  [[nodiscard]] const PartShapes& shapes() const;
  /// Throws Failure where there is no such gear; the only gear for an empty name.
  [[nodiscard]] const TrainGear& gear(const std::string& name) const;
  /// Throws Failure where there is no such part.
  [[nodiscard]] const PartShape& part(const std::string& name) const;
  /// Errors of later stations with file and line of their keys.
  [[nodiscard]] Failure failure(Errors errors) const { return Failure(located(std::move(errors), file_)); }

 private:
  DesignFile file_;
  std::unique_ptr<GearTrain> train_;  // shapes point into it
  mutable std::once_flag made_;
  mutable std::optional<ResultAll<PartShapes>> shapes_;
};

/// A mesh of triangles that NumPy sees without copying.
struct Mesh {
  TriangleMesh mesh;
  double chord_error_um = kNaN;  ///< NaN: unknown
};

[[nodiscard]] inline py::object json_loads(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

/// os.fspath of a str or PathLike.
[[nodiscard]] inline std::string path_text(const py::object& path) {
  return py::cast<std::string>(py::module_::import("os").attr("fspath")(path));
}

[[nodiscard]] double checked_tolerance_mm(double tolerance_um);

void bind_mesh(py::module_& module);
void bind_gearbox(py::module_& module);
void bind_search(py::module_& module);
/// Onto the class Gearbox.
void bind_loop(py::module_& module);

}  // namespace trueflank::python
