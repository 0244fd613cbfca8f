#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Core knows no message: of the SDK it reads abi.h alone, as the compiler's own lists of what it read tell.
set -euo pipefail
cd "$(dirname "$0")/../build"
mapfile -t sources < <(cd .. && find core -name '*.cpp' ! -path '*/test/*')
read_files=$(ninja -t deps | awk -v sources="${sources[*]}" '
  BEGIN { n = split(sources, list, " "); for (i = 1; i <= n; i++) wanted[list[i]] = 1 }
  /^[^ ].*: #deps/ { object = $1; first = 1; next }
  NF == 0 { next }
  first { first = 0; source = $1; sub(/^.*\/core\//, "core/", source); keep = (source in wanted); if (keep) seen[source] = 1 }
  keep && /\/sdk\/include\// && !/\/sdk\/include\/fulmar\/abi\.h$/ { print "message: " source " reads " $1 }
  END { for (s in seen) print "source: " s }')
messages=$(sed -n 's/^message: //p' <<<"$read_files")
for source in "${sources[@]}"; do
  grep -qxF "source: $source" <<<"$read_files" || { echo "$source has not been compiled"; exit 1; }
done
[ -z "$messages" ] || { echo "$messages"; exit 1; }
echo "${#sources[@]} files of core read nothing of the SDK but abi.h"
