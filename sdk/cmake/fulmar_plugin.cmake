# SPDX-License-Identifier: BSD-3-Clause
# fulmar_add_plugin(NAME source... [GEODESY] [LINK library...] [TEST source...])
#
# One shared object with one exported symbol. Without a version script, or with unique symbols on gcc, a library stays mapped after it is
# closed and a swap would silently fly the old code; the target fulmar::sdk has the flag against them. TEST adds a program NAME_test and a ctest entry; doctest's main is there.
# GEODESY links what <fulmar/flight/earth/geodesy.hpp> needs, GeographicLib: that header and the navigator, which includes it, need more than headers. Targets of other
# kinds link fulmar::geodesy after fulmar_find_geodesy().
set(FULMAR_VERSION_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/plugin.version CACHE INTERNAL "exports the entry alone")
set(FULMAR_TEST_MAIN ${CMAKE_CURRENT_LIST_DIR}/test_main.cpp CACHE INTERNAL "doctest's main")

# Looked for only where it is used: the SDK does without.
function(fulmar_find_geodesy)
  if(TARGET fulmar::geodesy)
    return()
  endif()
  find_library(FULMAR_GEOGRAPHIC_LIBRARY NAMES GeographicLib Geographic DOC "GeographicLib, for fulmar/flight/earth/geodesy.hpp")
  find_path(FULMAR_GEOGRAPHIC_INCLUDE NAMES GeographicLib/LocalCartesian.hpp DOC "headers of GeographicLib")
  if(NOT FULMAR_GEOGRAPHIC_LIBRARY OR NOT FULMAR_GEOGRAPHIC_INCLUDE)
    message(FATAL_ERROR "GEODESY needs GeographicLib, which is not here. On Debian and Ubuntu: apt install libgeographiclib-dev (older: libgeographic-dev)")
  endif()
  add_library(fulmar::geodesy INTERFACE IMPORTED GLOBAL)
  set_target_properties(fulmar::geodesy PROPERTIES INTERFACE_LINK_LIBRARIES ${FULMAR_GEOGRAPHIC_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${FULMAR_GEOGRAPHIC_INCLUDE})
endfunction()

function(fulmar_add_plugin name)
  cmake_parse_arguments(arg "GEODESY" "" "LINK;TEST" ${ARGN})
  if(arg_GEODESY)
    fulmar_find_geodesy()
    list(APPEND arg_LINK fulmar::geodesy)
  endif()
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE fulmar::sdk ${arg_LINK})
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON C_VISIBILITY_PRESET hidden
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/fulmar LINK_DEPENDS ${FULMAR_VERSION_SCRIPT})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_compile_options(${name} PRIVATE -ffp-contract=off -fno-math-errno $<$<CXX_COMPILER_ID:Clang>:-fconstexpr-steps=20000000>)
  # now: symbols are bound when the plugin is loaded, not by the first call in flight
  target_link_options(${name} PRIVATE -Wl,--version-script=${FULMAR_VERSION_SCRIPT} -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
  if(NOT FULMAR_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  set_property(GLOBAL APPEND PROPERTY FULMAR_PLUGINS ${name})
  if(arg_TEST)
    if(NOT TARGET fulmar_plugin_test_main)  # compiled once: half of what a small test takes to build
      add_library(fulmar_plugin_test_main STATIC ${FULMAR_TEST_MAIN})
      target_compile_features(fulmar_plugin_test_main PRIVATE cxx_std_20)
      target_compile_options(fulmar_plugin_test_main PRIVATE -O0)
    endif()
    add_executable(${name}_test ${arg_TEST})
    target_link_libraries(${name}_test PRIVATE fulmar::sdk fulmar_plugin_test_main ${arg_LINK})
    target_compile_options(${name}_test PRIVATE -O0)  # compiles in half the time; the plugin beside it is optimised
    target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    add_test(NAME ${name}_test COMMAND ${name}_test)
  endif()
endfunction()
