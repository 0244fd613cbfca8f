#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Core and links are independent of messages: of the SDK they include abi.h, diagnostic.hpp and quiet_thread.hpp alone, by the compiler's dependency lists.
set -euo pipefail
cd "$(dirname "$0")/../build"
mapfile -t sources < <(cd .. && find core links -name '*.cpp' ! -path '*/test/*')
# The list of an object names all its inputs: the source, or the sources that were compiled together, and every header.
read_files=$(ninja -t deps | awk -v sources="${sources[*]}" '
  function end_of_object(   i) {
    if (of_core) for (i = 1; i <= n_sdk; i++) print "message: " of_core " reads " sdk[i]
    of_core = ""; n_sdk = 0
  }
  BEGIN { n = split(sources, list, " "); for (i = 1; i <= n; i++) wanted[list[i]] = 1 }
  /^[^ ].*: #deps/ { end_of_object(); next }
  NF == 0 { next }
  /\/(core|links)\/.*\.cpp$/ { source = $1; if (!sub(/^.*\/core\//, "core/", source)) sub(/^.*\/links\//, "links/", source); if (source in wanted) { of_core = source; seen[source] = 1 } }
  /\/sdk\/include\// && !/\/sdk\/include\/fulmar\/(abi\.h|diagnostic\.hpp|quiet_thread\.hpp)$/ { sdk[++n_sdk] = $1 }
  END { end_of_object(); for (s in seen) print "source: " s }')
messages=$(sed -n 's/^message: //p' <<<"$read_files")
for source in "${sources[@]}"; do
  grep -qxF "source: $source" <<<"$read_files" || { echo "$source has not been compiled"; exit 1; }
done
[ -z "$messages" ] || { echo "$messages"; exit 1; }
echo "${#sources[@]} files of core and links read nothing of the SDK but abi.h, diagnostic.hpp and quiet_thread.hpp"
