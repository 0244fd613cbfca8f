# SPDX-License-Identifier: BSD-3-Clause
# cmake -DNODE= -DNPM= -DSOURCE= -DWORK= -DOUT= -DALL= -P page.cmake: fetches what the page is made of, and makes the page. What cannot be
# fetched is no reason not to fly: a message says so, and there is no page.
include(${CMAKE_CURRENT_LIST_DIR}/fetch.cmake)
if(NOT EXISTS ${WORK}/fetched)
  message("No page of the flight: npm could not fetch its packages. With a network, build again.\n${said}")
  return()
endif()
execute_process(COMMAND ${NODE} ${SOURCE}/build.mjs ${WORK}/node_modules ${OUT} COMMAND_ERROR_IS_FATAL ANY)
