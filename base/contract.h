// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace trueflank {

/// Thrown where a precondition is broken: a bug in the calling code, never a user's data.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] inline void throw_contract_violation(const char* what) {
  throw ContractViolation(what);
}

}  // namespace trueflank

#define TRUEFLANK_STRINGIZE_(x) #x
#define TRUEFLANK_STRINGIZE(x) TRUEFLANK_STRINGIZE_(x)
/// Contract check, always armed.
#define TRUEFLANK_EXPECTS(condition)                                                         \
  do {                                                                                       \
    if (!(condition))                                                                        \
      ::trueflank::throw_contract_violation(__FILE__ ":" TRUEFLANK_STRINGIZE(__LINE__) ": "  \
                                                     "contract broken: " #condition);        \
  } while (false)
