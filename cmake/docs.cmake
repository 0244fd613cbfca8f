# SPDX-License-Identifier: BSD-3-Clause
# The target `reference` writes the pages of the shipped plugins; they are installed when they are there. The programs that read sources and
# documentation are tested without a build.
add_custom_target(reference COMMAND ${CMAKE_SOURCE_DIR}/cmake/reference.sh ${CMAKE_BINARY_DIR} DEPENDS flight VERBATIM)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs PATTERN reference EXCLUDE PATTERN pictures.sh EXCLUDE PATTERN pictures.mjs EXCLUDE
        PATTERN inputs.txt EXCLUDE)
install(DIRECTORY ${CMAKE_BINARY_DIR}/docs/reference DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs OPTIONAL)

if(FULMAR_TESTS)
  foreach(program tutorials reference layers code_size commas docstrings mutate quotes)
    add_test(NAME ${program}_py_test COMMAND /usr/bin/python3 -B ${CMAKE_SOURCE_DIR}/cmake/${program}_test.py)
  endforeach()
endif()
