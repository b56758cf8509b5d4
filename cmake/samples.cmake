# `make samples`: the sample drawings as PNG files in build/samples.
find_program(RSVG_CONVERT rsvg-convert)
file(GLOB sample_sources CONFIGURE_DEPENDS samples/*.svg)

set(sample_pictures)
foreach(source ${sample_sources})
  cmake_path(GET source STEM name)
  set(picture ${PROJECT_BINARY_DIR}/samples/${name}.png)
  add_custom_command(OUTPUT ${picture} DEPENDS ${source}
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/samples
                     COMMAND ${RSVG_CONVERT} --output ${picture} ${source})
  list(APPEND sample_pictures ${picture})
endforeach()
add_custom_target(samples DEPENDS ${sample_pictures})
