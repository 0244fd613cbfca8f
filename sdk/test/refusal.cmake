# SPDX-License-Identifier: BSD-3-Clause
# COMPILER must refuse CASE of refusals.cpp, with SENTENCE in its first error and not more than 20 lines before it.
execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -DCASE=${CASE} -I${SDK}/include -isystem ${EIGEN} ${SDK}/test/refusals.cpp
                RESULT_VARIABLE code ERROR_VARIABLE said)
if(code EQUAL 0)
  message(FATAL_ERROR "it compiles")
endif()
string(FIND "${said}" "${SENTENCE}" place)
if(place LESS 0)
  message(FATAL_ERROR "the sentence is not there: ${said}")
endif()
string(SUBSTRING "${said}" 0 ${place} before)
string(REGEX MATCHALL "\n" lines "${before}")
string(REGEX MATCHALL "error:" errors "${before}")
list(LENGTH lines lines)
list(LENGTH errors errors)
if(lines GREATER 20 OR errors GREATER 1)
  message(FATAL_ERROR "${lines} lines and ${errors} errors before the sentence: ${said}")
endif()
