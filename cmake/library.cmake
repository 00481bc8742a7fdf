# SPDX-License-Identifier: GPL-3.0-or-later

# The library of one folder:
#   trueflank_library(<folder>
#     DEPENDS <other folders>...       may be included in our headers
#     PUBLIC_PACKAGES <packages>...    header-only, may be included in our headers
#     PACKAGES <packages>...           included in .cpp only
#     HEADERS <file>...
#     SOURCES <file>...)
# Target trueflank_<folder>, alias trueflank::<folder>. A folder without sources is header-only, and
# its PACKAGES are not looked for.
function(trueflank_library folder)
  cmake_parse_arguments(arg "" "" "DEPENDS;PUBLIC_PACKAGES;PACKAGES;HEADERS;SOURCES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "trueflank_library(${folder}): what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()
  set(target trueflank_${folder})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(interface PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(interface INTERFACE)
  endif()
  add_library(trueflank::${folder} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${folder}
    POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} ${interface} cxx_std_20)
  # The folders stand at the top level and are included as trueflank/<folder>/..., in the tree as after
  # installation: a link in the build folder makes it so.
  set(include_root ${PROJECT_BINARY_DIR}/include)
  file(MAKE_DIRECTORY ${include_root}/trueflank)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/trueflank/${folder} SYMBOLIC)
  list(TRANSFORM arg_HEADERS PREPEND ${include_root}/trueflank/${folder}/)
  target_sources(${target} ${interface}
    FILE_SET HEADERS BASE_DIRS ${include_root} FILES ${arg_HEADERS})
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(${target} ${interface} trueflank::${dependency})
  endforeach()
  foreach(package IN LISTS arg_PUBLIC_PACKAGES)
    trueflank_find_package(${package} package_targets call)
    target_link_libraries(${target} ${interface} ${package_targets})
    set_property(GLOBAL APPEND PROPERTY TRUEFLANK_DEPENDENCIES ${call})
  endforeach()
  if(NOT arg_SOURCES)
    return()
  endif()
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:trueflank_options>)
  foreach(package IN LISTS arg_PACKAGES)
    trueflank_find_package(${package} package_targets call)
    target_link_libraries(${target} PRIVATE ${package_targets})
    if(call)
      set_property(GLOBAL APPEND PROPERTY TRUEFLANK_DEPENDENCIES ${call})
    endif()
  endforeach()
endfunction()
