# SPDX-License-Identifier: GPL-3.0-or-later
# What every target of this project is compiled with, and no consumer of it.
add_library(trueflank_options INTERFACE)
target_compile_features(trueflank_options INTERFACE cxx_std_20)
target_compile_options(trueflank_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # Designated initialisers leave members out on purpose: their defaults are in the class.
  -Wno-missing-field-initializers
  # g++ 12 sees overlaps and overflows that are none in std::string's operator+ and insert (GCC bug 105651),
  # the latter where <string> is precompiled.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
  # g++ looks for garbage from half a gigabyte on: the same object file, sooner (docs/decisions/0250).
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  # The same numbers on every processor: no fused multiply-add behind our back.
  -ffp-contract=off)
