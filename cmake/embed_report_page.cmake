# SPDX-License-Identifier: GPL-3.0-or-later
# Script: writes OUTPUT, the definitions of trueflank/report/report_page.h, from TEMPLATES, VIEWER
# and LICENCE (the last two may be empty).
function(append_constant name file)
  set(text "")
  if(file)
    file(READ "${file}" text)
  endif()
  # Inside a script element these would end or confuse it; they stand in strings and comments only,
  # where a backslash changes nothing.
  if(file MATCHES "\\.js$")
    string(REPLACE "</script" "<\\/script" text "${text}")
    string(REPLACE "<!--" "<\\!--" text "${text}")
  endif()
  # A raw string ends only at its own delimiter, which no text here holds.
  string(FIND "${text}" ")flank\"" delimiter)
  if(NOT delimiter EQUAL -1)
    message(FATAL_ERROR "${file} holds the delimiter of the raw string")
  endif()
  file(APPEND "${OUTPUT}.new" "const std::string_view ${name} = R\"flank(")
  file(APPEND "${OUTPUT}.new" "${text}")
  file(APPEND "${OUTPUT}.new" ")flank\";\n")
endfunction()

file(WRITE "${OUTPUT}.new" "// Generated from templates/report.\n"
  "#include \"trueflank/report/report_page.h\"\n\nnamespace trueflank::io::page {\n")
append_constant(kFrame "${TEMPLATES}/page.html")
append_constant(kStyle "${TEMPLATES}/style.css")
append_constant(kScript "${TEMPLATES}/page.js")
append_constant(kDimensions "${TEMPLATES}/dimensions.js")
append_constant(kMeshes "${TEMPLATES}/meshes.js")
append_constant(kViewer "${VIEWER}")
append_constant(kLicence "${LICENCE}")
file(APPEND "${OUTPUT}.new" "}  // namespace trueflank::io::page\n")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
