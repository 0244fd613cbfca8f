# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT, which defines fulmar::core::build_identity: VERSION, and a digest of the files listed in the file SOURCES and of FLAGS.
file(STRINGS ${SOURCES} files)
set(digests "${FLAGS}")
foreach(file IN LISTS files)
  file(SHA256 ${file} digest)
  string(APPEND digests " ${digest}")
endforeach()
string(SHA256 digest "${digests}")
string(SUBSTRING ${digest} 0 16 digest)
file(CONFIGURE OUTPUT ${OUT} CONTENT [=[
#include "core/build.hpp"
const char fulmar::core::build_identity[] = "@VERSION@ @digest@";
]=] @ONLY)
