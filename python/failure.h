// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <utility>

#include "trueflank/base/result.h"

namespace trueflank::python {

/// Errors on their way to Python, where they become an InputError or a SystemFailure.
class Failure : public std::exception {
 public:
  explicit Failure(Errors errors) : errors_(std::move(errors)) {}
  explicit Failure(Error error) : errors_{std::move(error)} {}
  [[nodiscard]] const Errors& errors() const { return errors_; }
  [[nodiscard]] const char* what() const noexcept override { return "errors in the user's data"; }

 private:
  Errors errors_;
};

/// The value, or the errors thrown.
template <class T, class E>
T value_or_throw(tl::expected<T, E> result) {
  if (!result) throw Failure(std::move(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Makes Failure the exceptions of trueflank._errors.
void register_failures();

}  // namespace trueflank::python
