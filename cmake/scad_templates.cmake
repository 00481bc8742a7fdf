# SPDX-License-Identifier: GPL-3.0-or-later

# Sets `source` to the generated definitions of trueflank/export/scad/scad_template_texts.h.
function(trueflank_scad_templates source)
  set(folder ${PROJECT_SOURCE_DIR}/templates/openscad)
  set(texts "")
  set(files "")
  foreach(entry IN ITEMS kHousing=housing kCarrier=carrier kMotorAdapter=motor_adapter
      kOutputFlange=output_flange kTestJig=test_jig kFitCoupon=fit_coupon)
    string(REPLACE "=" ";" pair ${entry})
    list(GET pair 0 name)
    list(GET pair 1 stem)
    list(APPEND files ${folder}/template_${stem}.scad)
    list(APPEND texts ${name}=${folder}/template_${stem}.scad)
  endforeach()
  list(JOIN texts "," texts)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_texts.cmake)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/scad_template_texts.cpp)
  add_custom_command(OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${generated} -D NAMESPACE=trueflank::io::scad_template
      -D HEADER=trueflank/export/scad/scad_template_texts.h -D TEXTS=${texts} -P ${script}
    DEPENDS ${files} ${script}
    COMMENT "Embedding the OpenSCAD templates" VERBATIM)
  set(${source} ${generated} PARENT_SCOPE)
endfunction()
