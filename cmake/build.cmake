# SPDX-License-Identifier: BSD-3-Clause
# Flags of everything built in this tree, and fulmar_test().

add_compile_options(-Wall -Wextra -Wconversion -Wshadow -ffp-contract=off)
# Nobody reads errno after sqrt, and a root is one instruction without it: 8 % of a simulated step, the same bits.
add_compile_options(-fno-math-errno)
if(FULMAR_WERROR)
  add_compile_options(-Werror)
endif()
# gcc collects garbage from 128 MB on: with more room it compiles a tenth faster.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=400000>)
# The tests with threads, for the thread sanitizer: `ctest -L threads`.
add_custom_target(threads)
if(FULMAR_SANITIZE_THREADS)
  set(FULMAR_SANITIZE ON)  # slow, with an allocator of its own
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  # its allocation functions, too, are not weak: those of a test that counts come first
  add_link_options(-fsanitize=thread -Wl,--allow-multiple-definition)
elseif(FULMAR_SANITIZE)
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
find_program(gold_program ld.gold)
if(ccache_program)
  # ccache stores what a precompiled header takes part in only when it is asked to
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${ccache_program})
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

# fulmar_unite(TARGET [FILES]): compiles the sources of each folder of TARGET in batches of FILES (8). What the files of a folder share, headers
# and above all the templates of the standard library, is then read, expanded and optimised once a batch. Each file compiles alone as well:
# ./check --long builds everything with -DFULMAR_UNITE=OFF.
option(FULMAR_UNITE "Several source files are compiled together" ON)
function(fulmar_unite target)
  if(NOT FULMAR_UNITE)
    return()
  endif()
  set(files 8)
  if(ARGC GREATER 1)
    set(files ${ARGV1})
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} ABSOLUTE)
    get_filename_component(folder ${folder} DIRECTORY)
    file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "of_${folder}" folder)
    math(EXPR batch "${count_${folder}}0 / ${files}0")
    math(EXPR count_${folder} "${count_${folder}}0 / 10 + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
  # what one file keeps to itself is no fault in the struct that it defines, though another file has included it
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# The folder beside the product that holds reference data, when it is there. Tests that need it skip with a message.
get_filename_component(FULMAR_REFERENCE_DATA "${CMAKE_SOURCE_DIR}/../shared/data" ABSOLUTE)

# fulmar_test(NAME source... [REAL_TIME] [ALONE] [WAITS] [FLIES] [THREADS] [PARTS case...] [COST seconds] [ENVIRONMENT variable=value] LINK library...):
# one doctest program build/bin/NAME. Runs in the source tree's root.
#   REAL_TIME    by the clock on the wall: not beside what computes, and not with the sanitizers, which make it slow
#   ALONE        nor beside another one by the clock
#   WAITS        for others more than it computes: takes half a processor of `ctest -j`, which counts halves
#   FLIES        computes in its own code
#   THREADS      of several threads: also under the thread sanitizer, and nothing else is
#   PARTS        one ctest entry for each range of cases; what is given are the numbers of the first cases of all ranges but the first one.
#                Each part runs by itself, so a case in one uses nothing that a case in another one has made
#   COST         roughly how long it takes: the longest begin first, also where no run has measured them
function(fulmar_test name)
  if(NOT FULMAR_TESTS)
    return()
  endif()
  # The sanitizers see these plugins and the headers under them when other tests fly them; their own tests are hours of flight.
  if(FULMAR_SANITIZE AND NOT FULMAR_ALL_TESTS
     AND (name MATCHES "^(navigation|sim)_test$" OR CMAKE_CURRENT_SOURCE_DIR MATCHES "/plugins/(sim_aero|path|control_slc|control_tecs|control_manual|signal|safety|score)$"))
    return()
  endif()
  cmake_parse_arguments(arg "REAL_TIME;ALONE;WAITS;FLIES;THREADS" "COST;ENVIRONMENT" "LINK;PARTS" ${ARGN})
  set(batch 6)
  if(arg_FLIES)  # the estimator and the simulator in one batch: their templates are most of it
    set(batch 12)
  endif()
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE fulmar_test_main fulmar::sdk ${arg_LINK})
  target_compile_definitions(${name} PRIVATE FULMAR_REFERENCE_DATA="${FULMAR_REFERENCE_DATA}" FULMAR_BIN_DIR="${CMAKE_BINARY_DIR}/bin"
                             FULMAR_PLUGIN_DIR="${CMAKE_BINARY_DIR}/lib/fulmar" FULMAR_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  # A test's own code need not be quick, and what it tests is optimised in its library: -O0 compiles in half the time. Only where it holds
  # the plugin itself and integrates flights with it, that is worth -O1.
  target_compile_options(${name} PRIVATE -g1 $<IF:$<AND:$<BOOL:${arg_FLIES}>,$<OR:$<NOT:$<BOOL:${FULMAR_SANITIZE}>>,$<BOOL:${FULMAR_ALL_TESTS}>>>,-O1,-O0>)
  fulmar_unite(${name} ${batch})
  if(FULMAR_UNITE AND NOT arg_FLIES)
    target_precompile_headers(${name} REUSE_FROM fulmar_test_headers)
  endif()
  # a test program takes half as long to link with gold
  if(gold_program AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT FULMAR_SANITIZE)
    target_link_options(${name} PRIVATE -fuse-ld=gold)
  endif()
  if((arg_REAL_TIME AND FULMAR_SANITIZE) OR (FULMAR_SANITIZE_THREADS AND NOT arg_THREADS))
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  fulmar_test_entries(${name})
endfunction()

# The ctest entries of fulmar_test(), whose arguments it reads.
function(fulmar_test_entries name)
  set(processors 2)
  if(arg_WAITS OR arg_REAL_TIME)
    set(processors 1)
  endif()
  # The suite `amounts` asserts something of large amounts: long series of random numbers, files of many megabytes. A fault in memory that
  # shows there shows in small ones too, and under the sanitizers they take minutes.
  set(without "")
  if(FULMAR_SANITIZE AND NOT FULMAR_ALL_TESTS)
    set(without --test-suite-exclude=amounts)
  endif()
  set(first 1)
  set(number 1)
  if(arg_THREADS)
    add_dependencies(threads ${name})
  endif()
  foreach(next IN LISTS arg_PARTS ITEMS end)
    set(entry ${name})
    set(range "")
    if(arg_PARTS)
      set(entry ${name}_${number})
      set(range --first=${first})
      if(NOT next STREQUAL end)
        math(EXPR last "${next} - 1")
        list(APPEND range --last=${last})
      endif()
    endif()
    add_test(NAME ${entry} COMMAND ${name} ${range} ${without} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
    set_tests_properties(${entry} PROPERTIES PROCESSORS ${processors} ENVIRONMENT "${arg_ENVIRONMENT}")
    if(arg_REAL_TIME)
      set_tests_properties(${entry} PROPERTIES LABELS real_time)
    elseif(arg_THREADS)
      set_tests_properties(${entry} PROPERTIES LABELS threads)
    endif()
    if(arg_ALONE)
      set_tests_properties(${entry} PROPERTIES RUN_SERIAL ON)
    endif()
    if(arg_COST)
      set_tests_properties(${entry} PROPERTIES COST ${arg_COST})
    endif()
    set(first ${next})
    math(EXPR number "${number} + 1")
  endforeach()
endfunction()
