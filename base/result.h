// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace trueflank {

/// What kind of wrong data or failing environment an Error speaks of.
enum class ErrorCode {
  kSyntax,         ///< the text cannot be read as its format
  kUnknownKey,     ///< a key nobody knows
  kMissingKey,     ///< a key that must be there is not
  kWrongType,      ///< a value of the wrong type
  kOutOfRange,     ///< a value that cannot be
  kInconsistent,   ///< values that contradict each other
  kInfeasible,     ///< geometry that does not exist for these values
  kNotConverged,   ///< an iteration that found no solution
  kUnsupported,    ///< understood, but not built
  kUsage,          ///< wrong command line
  kFileNotFound,   ///< environment: no such file
  kPermission,     ///< environment: not allowed
  kDisk,           ///< environment: writing or reading failed
  kInterrupted,    ///< environment: stopped by a signal
};

/// One error in a user's data, with all that a person or a script needs to mend it.
struct Error {
  ErrorCode code = ErrorCode::kInconsistent;
  std::string message = {};  ///< one sentence to a designer: what is wrong
  std::string key = {};      ///< design file key ("ring1.shift"), column or option; may be empty
  std::string value = {};    ///< the value found; may be empty
  std::string remedy = {};   ///< what would be right; may be empty
  std::string file = {};     ///< may be empty; added by whoever knows the file
  int line = 0;         ///< 1-based; 0 = unknown
};

using Errors = std::vector<Error>;

template <class T>
using Result = tl::expected<T, Error>;

/// Result of a function that reports all errors of its input at once; never empty errors.
template <class T>
using ResultAll = tl::expected<T, Errors>;

using Status = Result<void>;

[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}
[[nodiscard]] inline tl::unexpected<Errors> fail_all(Errors errors) {
  return tl::unexpected<Errors>(std::move(errors));
}

/// Exit code of the program for an error: 3 where the environment failed, else 2.
[[nodiscard]] constexpr int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::kFileNotFound:
    case ErrorCode::kPermission:
    case ErrorCode::kDisk:
    case ErrorCode::kInterrupted:
      return 3;
    default:
      return 2;
  }
}

}  // namespace trueflank
