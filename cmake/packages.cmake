# SPDX-License-Identifier: GPL-3.0-or-later
# Third-party packages, found only where a folder with sources uses them. All come from the
# distribution; nothing is downloaded at configure time.

# find_package with a message that says what to install. A macro: the variables that the package
# sets must reach the caller.
macro(_trueflank_find debian)
  find_package(${ARGN} QUIET)
  if(NOT ${ARGV1}_FOUND)
    message(FATAL_ERROR "trueflank: package `${ARGN}` not found. On Debian: apt-get install ${debian} "
      "(or run scripts/install-dependencies, which installs all of them).")
  endif()
endmacro()

# Finds package `name` and sets `targets` to what to link and `dependency` to the find_package call
# that a project using the installed library needs (empty: none).
function(trueflank_find_package name targets dependency)
  if(name STREQUAL "Eigen")
    _trueflank_find(libeigen3-dev Eigen3 3.4 NO_MODULE)
    set(found Eigen3::Eigen)
    set(call "Eigen3 3.4 NO_MODULE")
  elseif(name STREQUAL "expected")
    _trueflank_find(libexpected-dev tl-expected)
    set(found tl::expected)
    set(call "tl-expected")
  elseif(name STREQUAL "CGAL")
    set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)
    _trueflank_find(libcgal-dev CGAL 5.5)
    set(found CGAL::CGAL)  # makes its users compile with -frounding-math, hence never PUBLIC
    set(call "CGAL 5.5")
  elseif(name STREQUAL "assimp")
    _trueflank_find(libassimp-dev assimp 5.2)
    # Its headers alone: the library is loaded by its name when a file asks for it (export/assimp_reader.cpp).
    set(found ${CMAKE_DL_LIBS})
    set(call "")
  elseif(name STREQUAL "Boost")
    find_path(TRUEFLANK_BOOST_INCLUDE boost/math/special_functions/beta.hpp)
    if(NOT TRUEFLANK_BOOST_INCLUDE)
      message(FATAL_ERROR "trueflank: Boost.Math not found. On Debian: apt-get install libboost-dev (or run "
        "scripts/install-dependencies, which installs all of them).")
    endif()
    set(found "")  # headers alone, where the compiler looks; Boost's target would add definitions
    set(call "")
  elseif(name STREQUAL "NLopt")
    _trueflank_find("libnlopt-dev libnlopt-cxx-dev" NLopt)
    set(found ${NLOPT_LIBRARIES})  # Debian has two configurations with one target each
    set(call "NLopt")
  elseif(name STREQUAL "nlohmann_json")
    _trueflank_find(nlohmann-json3-dev nlohmann_json)
    set(found nlohmann_json::nlohmann_json)
    set(call "nlohmann_json")
  elseif(name STREQUAL "CLI11")
    _trueflank_find(libcli11-dev CLI11)
    set(found CLI11::CLI11)
    set(call "CLI11")
  elseif(name STREQUAL "libdeflate")
    find_library(TRUEFLANK_LIBDEFLATE deflate)
    find_path(TRUEFLANK_LIBDEFLATE_INCLUDE libdeflate.h)
    if(NOT TRUEFLANK_LIBDEFLATE OR NOT TRUEFLANK_LIBDEFLATE_INCLUDE)
      message(FATAL_ERROR "trueflank: libdeflate not found. On Debian: apt-get install libdeflate-dev (or "
        "run scripts/install-dependencies, which installs all of them).")
    endif()
    set(found deflate)  # by its plain name: Debian's package has no CMake configuration
    set(call "")
  elseif(name STREQUAL "hpdf")
    find_library(TRUEFLANK_HPDF hpdf)
    find_path(TRUEFLANK_HPDF_INCLUDE hpdf.h)
    if(NOT TRUEFLANK_HPDF OR NOT TRUEFLANK_HPDF_INCLUDE)
      message(FATAL_ERROR "trueflank: libharu not found. On Debian: apt-get install libhpdf-dev (or run "
        "scripts/install-dependencies, which installs all of them).")
    endif()
    set(found hpdf)  # by its plain name: Debian's package has no CMake configuration
    set(call "")
  else()
    message(FATAL_ERROR "trueflank: unknown package `${name}`; add it to cmake/packages.cmake and "
      "to scripts/packages-build.txt")
  endif()
  set(${targets} ${found} PARENT_SCOPE)
  set(${dependency} ${call} PARENT_SCOPE)
endfunction()

# Links `target` to toolkits of OpenCASCADE. For tests only: loading it costs a program 33 ms, and
# our STEP writer is our own, so that OpenCASCADE can be its judge.
function(trueflank_link_opencascade target)
  # No version here: Debian's configuration refuses every one but the exact 7.6.3.
  _trueflank_find("libocct-data-exchange-dev libocct-ocaf-dev" OpenCASCADE)
  if(OpenCASCADE_VERSION VERSION_LESS 7.6)
    message(FATAL_ERROR "trueflank: OpenCASCADE ${OpenCASCADE_VERSION} found, 7.6 or later needed")
  endif()
  target_include_directories(${target} SYSTEM PRIVATE ${OpenCASCADE_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE ${ARGN})
endfunction()
