# SPDX-License-Identifier: BSD-3-Clause
# Flags of everything built in this tree, and fulmar_test().

add_compile_options(-Wall -Wextra -Wconversion -Wshadow -ffp-contract=off)
if(FULMAR_WERROR)
  add_compile_options(-Werror)
endif()
if(FULMAR_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
find_program(ccache_program ccache)
if(ccache_program)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache_program})
  set(CMAKE_C_COMPILER_LAUNCHER ${ccache_program})
endif()

# The folder beside the product that holds reference data, when it is there. Tests that need it skip with a message.
get_filename_component(FULMAR_REFERENCE_DATA "${CMAKE_SOURCE_DIR}/../shared/data" ABSOLUTE)

# fulmar_test(NAME source... LINK library...): one doctest program build/bin/NAME and one ctest entry. Runs in the source tree's root.
function(fulmar_test name)
  if(NOT FULMAR_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE fulmar_test_main fulmar::sdk ${arg_LINK})
  target_compile_definitions(${name} PRIVATE FULMAR_REFERENCE_DATA="${FULMAR_REFERENCE_DATA}" FULMAR_BIN_DIR="${CMAKE_BINARY_DIR}/bin"
                             FULMAR_PLUGIN_DIR="${CMAKE_BINARY_DIR}/lib/fulmar" FULMAR_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endfunction()
