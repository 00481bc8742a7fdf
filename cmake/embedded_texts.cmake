# SPDX-License-Identifier: GPL-3.0-or-later

# Sets `source` to a generated C++ source with the string constants that a header declares, each the text of a
# file in templates/:
#   trueflank_embedded_texts(<source> HEADER <trueflank/folder/name.h> NAMESPACE <name> TEXTS <constant>=<file>...)
function(trueflank_embedded_texts source)
  cmake_parse_arguments(arg "" "HEADER;NAMESPACE" "TEXTS" ${ARGN})
  set(templates ${PROJECT_SOURCE_DIR}/templates)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_texts.cmake)
  set(texts "")
  set(files "")
  foreach(entry IN LISTS arg_TEXTS)
    string(REPLACE "=" "=${templates}/" text ${entry})
    list(APPEND texts ${text})
    string(REGEX REPLACE "^.*=" "${templates}/" file ${entry})
    list(APPEND files ${file})
  endforeach()
  list(JOIN texts "," texts)
  get_filename_component(name ${arg_HEADER} NAME_WE)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  add_custom_command(OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${generated} -D NAMESPACE=${arg_NAMESPACE}
      -D HEADER=${arg_HEADER} -D TEXTS=${texts} -P ${script}
    DEPENDS ${files} ${script}
    COMMENT "Embedding the texts of ${name}" VERBATIM)
  set(${source} ${generated} PARENT_SCOPE)
endfunction()
