// SPDX-License-Identifier: GPL-3.0-or-later
#include "failure.h"

#include <pybind11/pybind11.h>

#include <algorithm>

namespace py = pybind11;

namespace trueflank::python {
namespace {

const char* code_text(ErrorCode code) {
  switch (code) {
    case ErrorCode::kSyntax: return "syntax";
    case ErrorCode::kUnknownKey: return "unknown_key";
    case ErrorCode::kMissingKey: return "missing_key";
    case ErrorCode::kWrongType: return "wrong_type";
    case ErrorCode::kOutOfRange: return "out_of_range";
    case ErrorCode::kInconsistent: return "inconsistent";
    case ErrorCode::kInfeasible: return "infeasible";
    case ErrorCode::kNotConverged: return "not_converged";
    case ErrorCode::kUnsupported: return "unsupported";
    case ErrorCode::kUsage: return "usage";
    case ErrorCode::kFileNotFound: return "file_not_found";
    case ErrorCode::kPermission: return "permission";
    case ErrorCode::kDisk: return "disk";
    case ErrorCode::kInterrupted: return "interrupted";
  }
  return "";
}

void set_python_error(const Failure& failure) {
  const py::module_ module = py::module_::import("trueflank._errors");
  py::list problems;
  bool environment = false;
  for (const Error& error : failure.errors()) {
    environment = environment || exit_code(error.code) == 3;
    problems.append(module.attr("Problem")(code_text(error.code), error.message, error.key,
                                           error.value, error.remedy, error.file, error.line));
  }
  const py::object type = module.attr(environment ? "SystemFailure" : "InputError");
  PyErr_SetObject(type.ptr(), type(py::tuple(problems)).ptr());
}

}  // namespace

void register_failures() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      set_python_error(failure);
    }
  });
}

}  // namespace trueflank::python
