# SPDX-License-Identifier: GPL-3.0-or-later

# Sets `source` to the generated definition of trueflank/session/search_page.h.
function(trueflank_search_page source)
  set(page ${PROJECT_SOURCE_DIR}/templates/search/page.html)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_texts.cmake)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/search_page.cpp)
  add_custom_command(OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${generated} -D NAMESPACE=trueflank
      -D HEADER=trueflank/session/search_page.h -D TEXTS=kSearchPage=${page} -P ${script}
    DEPENDS ${page} ${script}
    COMMENT "Embedding the page of a search" VERBATIM)
  set(${source} ${generated} PARENT_SCOPE)
endfunction()
