# SPDX-License-Identifier: GPL-3.0-or-later
# `cmake --install` gives find_package(trueflank): a target for each folder, trueflank::geometry and
# so on, and trueflank::trueflank for all of them.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(folders base geometry train kinds search check solid machine export design loop report session)
add_library(trueflank_all INTERFACE)
add_library(trueflank::trueflank ALIAS trueflank_all)
set_target_properties(trueflank_all PROPERTIES EXPORT_NAME trueflank)
list(TRANSFORM folders PREPEND trueflank:: OUTPUT_VARIABLE folder_aliases)
target_link_libraries(trueflank_all INTERFACE ${folder_aliases})

list(TRANSFORM folders PREPEND trueflank_ OUTPUT_VARIABLE folder_targets)
install(TARGETS ${folder_targets} trueflank_all EXPORT trueflank
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT trueflank NAMESPACE trueflank:: FILE trueflankTargets.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trueflank)
if(TARGET trueflank_program)
  install(TARGETS trueflank_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

get_property(dependencies GLOBAL PROPERTY TRUEFLANK_DEPENDENCIES)
list(REMOVE_DUPLICATES dependencies)
set(TRUEFLANK_FIND_DEPENDENCIES "")
foreach(dependency IN LISTS dependencies)
  string(APPEND TRUEFLANK_FIND_DEPENDENCIES "find_dependency(${dependency})\n")
endforeach()
configure_package_config_file(cmake/trueflankConfig.cmake.in trueflankConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trueflank)
write_basic_package_version_file(trueflankConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/trueflankConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/trueflankConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trueflank)
install(FILES ${PROJECT_SOURCE_DIR}/app/shell/trueflank.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_SOURCE_DIR}/app/shell/trueflank.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME trueflank)
