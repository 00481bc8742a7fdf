# SPDX-License-Identifier: GPL-3.0-or-later
# The page behind report.html: templates/report becomes a C++ source of the export folder, with
# three.js bundled in where scripts/install-dependencies has put it. Nothing is downloaded here.

# Sets `source` to the generated file.
function(trueflank_report_page source)
  set(templates ${PROJECT_SOURCE_DIR}/templates/report)
  set(modules ${templates}/node_modules)
  set(viewer ${CMAKE_CURRENT_BINARY_DIR}/viewer.bundle.js)
  set(licence ${modules}/three/LICENSE)
  find_program(TRUEFLANK_NODE NAMES node nodejs)
  if(TRUEFLANK_NODE AND EXISTS ${modules}/three/package.json AND EXISTS ${modules}/esbuild/bin/esbuild)
    add_custom_command(OUTPUT ${viewer}
      COMMAND ${TRUEFLANK_NODE} ${modules}/esbuild/bin/esbuild ${templates}/viewer.js
        --bundle --minify --format=iife --legal-comments=inline --target=es2020
        --log-level=warning --outfile=${viewer}
      DEPENDS ${templates}/viewer.js ${templates}/solids.js ${templates}/section.js ${templates}/labels.js
        ${templates}/package-lock.json
      COMMENT "Bundling three.js into the report" VERBATIM)
  else()
    message(STATUS "trueflank: no three.js, report.html will have no picture in 3D "
      "(scripts/install-dependencies gets it)")
    set(viewer "")
    set(licence "")
  endif()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/report_page.cpp)
  add_custom_command(OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${generated} -D TEMPLATES=${templates}
      -D VIEWER=${viewer} -D LICENCE=${licence}
      -P ${PROJECT_SOURCE_DIR}/cmake/embed_report_page.cmake
    DEPENDS ${templates}/page.html ${templates}/style.css ${templates}/page.js
      ${templates}/dimensions.js
      ${templates}/meshes.js ${viewer}
      ${PROJECT_SOURCE_DIR}/cmake/embed_report_page.cmake
    COMMENT "Embedding the report's page" VERBATIM)
  set(${source} ${generated} PARENT_SCOPE)
endfunction()
