# SPDX-License-Identifier: GPL-3.0-or-later

function(trueflank_test_cost result slow said)
  if(NOT said STREQUAL "")
    set(${result} ${said} PARENT_SCOPE)
  elseif(slow)
    set(${result} 10 PARENT_SCOPE)
  else()
    set(${result} 0 PARENT_SCOPE)
  endif()
endfunction()

# The C library keeps freed memory, as the program tells it to (app/main.cpp): what the tests call is as quick as there.
# One variable, without a list, for gtest_discover_tests.
set(TRUEFLANK_TEST_MEMORY
  "GLIBC_TUNABLES=glibc.malloc.mmap_threshold=1073741824:glibc.malloc.trim_threshold=1073741824:glibc.malloc.top_pad=8388608:glibc.malloc.arena_max=1")

# All folders as one shared library, for tests of a release. What a test compiles for itself, with less optimisation, stays
# its own there: linked statically, the libraries would take the templates that both use from the test
# (docs/decisions/0553). Elsewhere tests link to the folders that they name.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(TRUEFLANK_TOGETHER ON)
else()
  set(TRUEFLANK_TOGETHER OFF)
endif()
function(trueflank_together target)
  set(folders base geometry train kinds search check solid machine export design loop report session)
  list(TRANSFORM folders PREPEND trueflank_ OUTPUT_VARIABLE libraries)
  list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE archives)
  list(JOIN archives "," whole)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Nothing: all folders are linked into its library.\n")
  add_library(${target} SHARED ${source})
  # the archives whole, and once more as what brings the packages
  target_link_libraries(${target} PUBLIC trueflank_tested_headers
    PRIVATE -Wl,--whole-archive,${whole},--no-whole-archive ${libraries} ${ARGN})
  target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions)
endfunction()
if(TRUEFLANK_TOGETHER)
  add_library(trueflank_tested_headers INTERFACE)
  trueflank_find_package(Eigen eigen call)
  trueflank_find_package(expected expected call)
  target_link_libraries(trueflank_tested_headers INTERFACE ${eigen} ${expected})
  target_include_directories(trueflank_tested_headers INTERFACE ${PROJECT_BINARY_DIR}/include)
  target_compile_features(trueflank_tested_headers INTERFACE cxx_std_20)
  trueflank_together(trueflank_tested)
  trueflank_together(trueflank_tested_same_digits trueflank_elementary_functions)
endif()

# Links a program of the tests, or (HEADERS) a library that such programs link to, to folders, by their targets
# trueflank::<folder>, and to other libraries.
#   trueflank_link_tested(<target> <scope> [HEADERS] [SAME_DIGITS] <library>...)
function(trueflank_link_tested target scope)
  cmake_parse_arguments(arg "HEADERS;SAME_DIGITS" "" "" ${ARGN})
  set(libraries ${arg_UNPARSED_ARGUMENTS})
  if(arg_SAME_DIGITS)
    target_link_libraries(${target} ${scope} trueflank_elementary_functions)
  endif()
  if(TRUEFLANK_TOGETHER)
    list(FILTER libraries EXCLUDE REGEX "^trueflank::")
    set(together trueflank_tested)
    if(arg_HEADERS)
      set(together trueflank_tested_headers)
    elseif(arg_SAME_DIGITS)
      set(together trueflank_tested_same_digits)
    endif()
    list(APPEND libraries ${together})
  endif()
  target_link_libraries(${target} ${scope} ${libraries})
endfunction()

# The tests of one folder:
#   trueflank_test(<name> [SLOW] [WHOLE | TOGETHER <filter>] [OPTIMISED] [SAME_DIGITS] [COST <s>]
#                  SOURCES <file>... [LIBRARIES <target>...])
# builds test_<name> and makes every TEST in it a test of its own, `<name>.Subject.Statement`.
# It links to trueflank::<name> where there is such a folder, to LIBRARIES, and to tests/support.
# SLOW: labelled slow, not <name>; not run by the dev preset. WHOLE: one ctest entry for all, for tests that share
# something expensive; TOGETHER: one for those of a gtest filter without dashes, `<name>.<filter>`.
# OPTIMISED: what the sources themselves compute takes long; others are compiled with -Og in a release, in two thirds of
# the time (docs/decisions/0553). SAME_DIGITS: with the elementary functions of our programs, for recorded figures, which
# are those of every processor. COST: the longest start first, so that no processor waits for them at the end; seconds
# on a quiet one, for SLOW 10 where nothing is said.
function(trueflank_test name)
  cmake_parse_arguments(arg "SLOW;WHOLE;OPTIMISED;SAME_DIGITS" "COST;TOGETHER" "SOURCES;LIBRARIES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "trueflank_test(${name}): what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()
  if(NOT arg_SOURCES)
    return()
  endif()
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  set(digits "")
  if(arg_SAME_DIGITS)
    set(digits SAME_DIGITS)
  endif()
  set(folder "")
  if(TARGET trueflank::${name})
    set(folder trueflank::${name})
  endif()
  trueflank_link_tested(${target} PRIVATE ${digits}
    ${folder} ${arg_LIBRARIES} trueflank::kinds trueflank_test_support trueflank_options GTest::gtest_main)
  target_compile_options(${target} PRIVATE -Wno-conversion)
  if(arg_OPTIMISED)
    target_compile_options(${target} PRIVATE -fPIC)  # as its precompiled headers
    target_precompile_headers(${target} REUSE_FROM trueflank_precompiled_library)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
    target_precompile_headers(${target} REUSE_FROM trueflank_precompiled_test)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 20)
  # One label a test: gtest_discover_tests passes on no lists.
  set(label ${name})
  if(arg_SLOW)
    set(label slow)
  endif()
  trueflank_test_cost(cost "${arg_SLOW}" "${arg_COST}")
  if(arg_WHOLE)
    add_test(NAME ${name} COMMAND ${target})
    set_tests_properties(${name} PROPERTIES LABELS ${label} COST ${cost} ENVIRONMENT "${TRUEFLANK_TEST_MEMORY}")
  else()
    set(others "*")
    if(arg_TOGETHER)
      set(others "-${arg_TOGETHER}")
      add_test(NAME ${name}.${arg_TOGETHER} COMMAND ${target} --gtest_filter=${arg_TOGETHER})
      set_tests_properties(${name}.${arg_TOGETHER} PROPERTIES LABELS ${label} COST ${cost} ENVIRONMENT "${TRUEFLANK_TEST_MEMORY}")
    endif()
    # At test time, not after each link: listing tests is no part of building.
    gtest_discover_tests(${target} TEST_PREFIX "${name}." TEST_FILTER "${others}" DISCOVERY_MODE PRE_TEST
      DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES PROPERTIES LABELS ${label} COST ${cost} ENVIRONMENT "${TRUEFLANK_TEST_MEMORY}")
  endif()
endfunction()

# The surveys of test_<name> with all their random trials (survey_size.h), of which `make test` makes the first ones:
#   trueflank_campaign(<name> <gtest filter>)
# Label campaign: `make campaign` runs it, `make test` does not.
function(trueflank_campaign name filter)
  add_test(NAME campaign.${name} COMMAND test_${name} --gtest_filter=${filter})
  set_tests_properties(campaign.${name} PROPERTIES
    ENVIRONMENT TRUEFLANK_CAMPAIGN=1 LABELS campaign TIMEOUT 7200)
endfunction()

# A test written as a script, run by the distribution's Python:
#   trueflank_script_test(<name> [SLOW | CAMPAIGN] [WITHOUT_PROGRAM] [COST <s>] SCRIPT <file.py> [ARGUMENTS <argument>...])
# The script finds the repository in TRUEFLANK_SOURCE_DIR, the program in TRUEFLANK_PROGRAM, and a
# folder for its output, its own, in TRUEFLANK_TEST_OUTPUT. WITHOUT_PROGRAM: it does not run the program;
# all others are left out where the program is not built (TRUEFLANK_BUILD_PROGRAM=OFF). CAMPAIGN: labelled campaign,
# with TRUEFLANK_CAMPAIGN in its environment; `make campaign` runs it.
function(trueflank_script_test name)
  cmake_parse_arguments(arg "SLOW;CAMPAIGN;WITHOUT_PROGRAM" "SCRIPT;COST" "ARGUMENTS" ${ARGN})
  if(NOT arg_WITHOUT_PROGRAM AND NOT TARGET trueflank_program)
    return()
  endif()
  add_test(NAME ${name}
    COMMAND ${TRUEFLANK_PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/${arg_SCRIPT} ${arg_ARGUMENTS})
  set(output ${PROJECT_BINARY_DIR}/test_output/${name})
  file(MAKE_DIRECTORY ${output})
  # The C library keeps freed memory: NumPy's large arrays get new pages for each result otherwise, a third of the time
  # of some scripts (docs/decisions/0470). The program says so itself.
  set(environment
    MALLOC_MMAP_THRESHOLD_=1073741824
    MALLOC_TRIM_THRESHOLD_=1073741824
    TRUEFLANK_SOURCE_DIR=${PROJECT_SOURCE_DIR}
    TRUEFLANK_BINARY_DIR=${PROJECT_BINARY_DIR}
    TRUEFLANK_TEST_OUTPUT=${output})
  if(TARGET trueflank_program)
    list(APPEND environment TRUEFLANK_PROGRAM=$<TARGET_FILE:trueflank_program>)
  endif()
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME label)
  if(arg_SLOW)
    set(label slow)
  endif()
  if(arg_CAMPAIGN)
    set(label campaign)
    list(APPEND environment TRUEFLANK_CAMPAIGN=1)
    set_tests_properties(${name} PROPERTIES TIMEOUT 7200)
  endif()
  trueflank_test_cost(cost "${arg_SLOW}" "${arg_COST}")
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${environment}" LABELS ${label} COST ${cost})
endfunction()
