# SPDX-License-Identifier: GPL-3.0-or-later
# Headers of the standard library and of Eigen that most sources include, compiled once instead of in
# each of them: 0.4 to 0.8 of the time of a source. Sources still include what they use, and `make asan`, which
# builds without (CMAKE_DISABLE_PRECOMPILE_HEADERS), would say where one does not.
# (std::quoted is known with <filesystem>: a function of ours of this name would be taken for it.)
# None of our own headers stands here: a change of one would compile everything again.
set(TRUEFLANK_PRECOMPILED_HEADERS
  <algorithm> <array> <charconv> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <map>
  <memory> <numeric> <optional> <random> <set> <string> <string_view> <utility> <variant> <vector>
  <tl/expected.hpp> <Eigen/Core> <Eigen/Geometry>)

# A target that compiles them with the flags of the libraries, or (with further headers and OPTIONS) of the tests.
function(trueflank_precompiled target)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: its precompiled headers are used by others.\n")
  add_library(${target} OBJECT ${source})
  trueflank_find_package(Eigen eigen call)
  trueflank_find_package(expected expected call)
  target_link_libraries(${target} PRIVATE trueflank_options ${eigen} ${expected} ${arg_LIBRARIES})
  target_compile_options(${target} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${TRUEFLANK_PRECOMPILED_HEADERS} ${arg_HEADERS})
endfunction()
