// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

// What a person is told where the system refused a call on a file, a pipe or a process.
namespace trueflank {

enum class SystemUse { kRead, kWrite, kStartProcess };

/// In words, and the limit itself where a limit was met.
struct SystemFailure {
  std::string reason;  ///< the system's words, then the limit: "File too large: no file may grow
                       ///< beyond 4096 bytes here"
  std::string remedy;  ///< what would help; empty where nobody can know
  std::string limit;   ///< "4096 bytes"; empty where no limit of this process was met
};

/// Of an errno, with the limits that this process has at the moment.
[[nodiscard]] SystemFailure system_failure(int error_number, SystemUse use);

}  // namespace trueflank
