# SPDX-License-Identifier: BSD-3-Clause
# Python, both ways: components in Python (plugins/python) and the host as a module (tools/fulmar_module). Left out without python3-dev and
# pybind11-dev. The system's own Python is taken, whose packages are those of the distribution; another one: -DPython3_EXECUTABLE=...
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Embed Development.Module)
find_path(PYBIND11_INCLUDE_DIR pybind11/pybind11.h)
if(NOT Python3_Development.Embed_FOUND OR NOT PYBIND11_INCLUDE_DIR)
  set(missing "")
  if(NOT Python3_Development.Embed_FOUND)
    list(APPEND missing python3-dev)
  endif()
  if(NOT PYBIND11_INCLUDE_DIR)
    list(APPEND missing pybind11-dev)
  endif()
  list(JOIN missing " " missing)
  message(STATUS "Python is left out: it takes ${missing} (apt-get install ${missing})")
  return()
endif()
message(STATUS "Python: ${Python3_VERSION} of ${Python3_EXECUTABLE}")

add_subdirectory(plugins/python)
add_dependencies(flight python)
install(TARGETS python LIBRARY DESTINATION lib/fulmar OPTIONAL)
# the interpreter itself has no sanitizer, and a module that needs one cannot be loaded by it
if(NOT FULMAR_SANITIZE)
  add_subdirectory(tools/fulmar_module)
endif()

fulmar_add_plugin(bench_python_law bench/python_law.cpp)
target_include_directories(bench_python_law PRIVATE ${CMAKE_SOURCE_DIR})
set_target_properties(bench_python_law PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/fulmar-bench)
add_executable(bench_python bench/bench_python.cpp)
target_link_libraries(bench_python PRIVATE fulmar::sdk ${CMAKE_DL_LIBS})
target_compile_definitions(bench_python PRIVATE FULMAR_PYTHON_PLUGIN="$<TARGET_FILE:python>" FULMAR_LAW_SO="$<TARGET_FILE:bench_python_law>"
                           FULMAR_LAW_PY="${CMAKE_SOURCE_DIR}/examples/python/my_law.py")
add_dependencies(bench_python python bench_python_law)
