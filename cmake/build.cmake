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
# What is compiled longest computes least: the host, and still more the words of the command line and the ground tools. They keep line
# numbers for a debugger; their variables are in a build of type Debug.
set(FULMAR_HOST_FLAGS $<$<NOT:$<CONFIG:Debug>>:-g1>)
set(FULMAR_TOOL_FLAGS $<$<NOT:$<CONFIG:Debug>>:-g1> $<$<NOT:$<CONFIG:Debug>>:-O1>)
if(FULMAR_SANITIZE)
  set(FULMAR_HOST_FLAGS -O0)
  set(FULMAR_TOOL_FLAGS -O0)
endif()
find_program(ccache_program ccache)
if(ccache_program)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache_program})
  set(CMAKE_C_COMPILER_LAUNCHER ${ccache_program})
endif()

# fulmar_harden(target...): what is shipped resists what a damaged file or a faulty plugin may do to it. Plugins built elsewhere have flags
# of their own. Fortified functions need an optimised build; the sanitizers replace them.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcf-protection FULMAR_HAS_CF_PROTECTION)
function(fulmar_harden)
  foreach(target ${ARGN})
    get_target_property(type ${target} TYPE)
    get_target_property(pic ${target} POSITION_INDEPENDENT_CODE)
    target_compile_options(${target} PRIVATE -fstack-protector-strong)
    if(FULMAR_HAS_CF_PROTECTION)
      target_compile_options(${target} PRIVATE -fcf-protection)
    endif()
    if(NOT FULMAR_SANITIZE)
      target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
    endif()
    if(NOT type STREQUAL MODULE_LIBRARY AND NOT pic)
      target_compile_options(${target} PRIVATE -fPIE)
    endif()
    if(type STREQUAL EXECUTABLE)
      target_link_options(${target} PRIVATE -pie)
    endif()
    if(NOT type STREQUAL STATIC_LIBRARY)
      target_link_options(${target} PRIVATE -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
    endif()
  endforeach()
endfunction()

# The folder beside the product that holds reference data, when it is there. Tests that need it skip with a message.
get_filename_component(FULMAR_REFERENCE_DATA "${CMAKE_SOURCE_DIR}/../shared/data" ABSOLUTE)

# fulmar_test(NAME source... [REAL_TIME] LINK library...): one doctest program build/bin/NAME and one ctest entry. Runs in the source tree's
# root. REAL_TIME: by the clock on the wall, so alone, and not with the sanitizers, which make it slow.
function(fulmar_test name)
  if(NOT FULMAR_TESTS)
    return()
  endif()
  # The sanitizers see these plugins when other tests fly them; their own tests are hours of flight.
  if(FULMAR_SANITIZE AND NOT FULMAR_ALL_TESTS
     AND CMAKE_CURRENT_SOURCE_DIR MATCHES "/plugins/(estimator_ekf|sim_aero|path|control_slc|control_tecs|score)$")
    return()
  endif()
  cmake_parse_arguments(arg "REAL_TIME" "" "LINK" ${ARGN})
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE fulmar_test_main fulmar::sdk ${arg_LINK})
  target_compile_definitions(${name} PRIVATE FULMAR_REFERENCE_DATA="${FULMAR_REFERENCE_DATA}" FULMAR_BIN_DIR="${CMAKE_BINARY_DIR}/bin"
                             FULMAR_PLUGIN_DIR="${CMAKE_BINARY_DIR}/lib/fulmar" FULMAR_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  # Compiles in half the time. Where a test holds no Eigen its own code need not be quick; what it tests is optimised in its library.
  target_compile_options(${name} PRIVATE -g1)
  if(FULMAR_SANITIZE OR CMAKE_CURRENT_SOURCE_DIR MATCHES "/(core|tools|plugins/fcu_serial)(/|$)")
    target_compile_options(${name} PRIVATE -O0)
  endif()
  if(arg_REAL_TIME AND FULMAR_SANITIZE)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  if(arg_REAL_TIME)
    set_tests_properties(${name} PROPERTIES RUN_SERIAL ON LABELS real_time)
  endif()
endfunction()
