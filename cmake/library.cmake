# SPDX-License-Identifier: GPL-3.0-or-later

# The library of one folder:
#   trueflank_library(<folder> [GLUE]
#     DEPENDS <other folders>...       may be included in our headers
#     PUBLIC_PACKAGES <packages>...    header-only, may be included in our headers
#     PACKAGES <packages>...           included in .cpp only
#     ALONE <package> <file>...        sources with a package whose flags or headers the others are spared
#     HEADERS <file>...                installed where cmake/public_headers.cmake names them
#     COMPUTES <file>...               of a GLUE folder, what is not glue: compiled with full optimisation
#     SOURCES <file>...)
# Target trueflank_<folder>, alias trueflank::<folder>. A folder without sources is header-only, and
# its PACKAGES are not looked for. GLUE: it calls what computes and computes little itself; a release compiles it with -O1,
# in half the time (docs/decisions/0250).
function(trueflank_library folder)
  cmake_parse_arguments(arg "GLUE" "" "DEPENDS;PUBLIC_PACKAGES;PACKAGES;ALONE;COMPUTES;HEADERS;SOURCES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "trueflank_library(${folder}): what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()
  get_filename_component(name ${folder} NAME)  # a room of a folder has a target of its own
  set(target trueflank_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(interface PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(interface INTERFACE)
  endif()
  add_library(trueflank::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ON
    UNITY_BUILD_BATCH_SIZE 28)
  target_compile_features(${target} ${interface} cxx_std_20)
  # The folders stand at the top level and are included as trueflank/<folder>/..., in the tree as after
  # installation: a link in the build folder makes it so.
  set(include_root ${PROJECT_BINARY_DIR}/include)
  file(MAKE_DIRECTORY ${include_root}/trueflank)
  if(name STREQUAL folder)
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/trueflank/${folder} SYMBOLIC)
  endif()
  set(public "")
  foreach(header IN LISTS arg_HEADERS)
    if(${folder}/${header} IN_LIST TRUEFLANK_PUBLIC_HEADERS)
      list(APPEND public ${include_root}/trueflank/${folder}/${header})
    elseif(arg_SOURCES)
      target_sources(${target} PRIVATE ${header})
    endif()
  endforeach()
  target_sources(${target} ${interface}
    FILE_SET HEADERS BASE_DIRS ${include_root} FILES ${public})
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
  if(arg_GLUE)
    trueflank_glue(${target})
  else()
    target_precompile_headers(${target} REUSE_FROM trueflank_precompiled_library)
  endif()
  if(arg_COMPUTES)
    add_library(${target}_computes OBJECT ${arg_COMPUTES})
    # (twenty-eight took the compiler 2.3 GB)
    set_target_properties(${target}_computes PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD_BATCH_SIZE 14)
    target_include_directories(${target}_computes PRIVATE ${include_root})
    foreach(dependency IN LISTS arg_DEPENDS)
      target_link_libraries(${target}_computes PRIVATE trueflank::${dependency})
    endforeach()
    target_link_libraries(${target}_computes PRIVATE trueflank_options)
    target_precompile_headers(${target}_computes REUSE_FROM trueflank_precompiled_library)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_computes>)
  endif()
  foreach(package IN LISTS arg_PACKAGES)
    trueflank_find_package(${package} package_targets call)
    target_link_libraries(${target} PRIVATE ${package_targets})
    if(arg_COMPUTES)
      target_link_libraries(${target}_computes PRIVATE ${package_targets})
    endif()
    if(call)
      set_property(GLOBAL APPEND PROPERTY TRUEFLANK_DEPENDENCIES ${call})
    endif()
  endforeach()
  if(arg_ALONE)
    list(POP_FRONT arg_ALONE package)
    trueflank_find_package(${package} package_targets call)
    add_library(${target}_${package} OBJECT ${arg_ALONE})
    set_target_properties(${target}_${package} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target}_${package} PRIVATE ${include_root})
    foreach(dependency IN LISTS arg_DEPENDS)
      target_link_libraries(${target}_${package} PRIVATE trueflank::${dependency})
    endforeach()
    target_link_libraries(${target}_${package} PRIVATE trueflank_options ${package_targets})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${package}>)
    list(TRANSFORM package_targets REPLACE "(.+)" "$<LINK_ONLY:\\1>")
    target_link_libraries(${target} INTERFACE ${package_targets})
    set_property(GLOBAL APPEND PROPERTY TRUEFLANK_DEPENDENCIES ${call})
  endif()
endfunction()

# Compiles a target of the release with -O1, and with headers precompiled that way. Programs, too, as code of a library:
# g++ takes no precompiled header that was made without -fPIE for code with it, and says so by a warning alone.
function(trueflank_glue target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-fPIC>)
  target_precompile_headers(${target} REUSE_FROM trueflank_precompiled_glue)
endfunction()
