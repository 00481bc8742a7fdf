// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For the innermost functions and lambdas: otherwise whether they are inlined depends on what else
// is compiled in the same unit.
#if defined(__GNUC__)
#define TRUEFLANK_ALWAYS_INLINE __attribute__((always_inline))
#else
#define TRUEFLANK_ALWAYS_INLINE
#endif
