#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks the layout of every source against .clang-format and web/.prettierrc.json.   format.sh [--fix]
set -euo pipefail
cd "$(dirname "$0")/.."
fix=${1:-}

# Releases of clang-format differ in details; release 14 is the reference.
check_cpp() {
  local program mode=(--dry-run -Werror)
  program=$(command -v clang-format-14 || command -v clang-format || true)
  if [ -z "$program" ] || [[ $("$program" --version) != *"version 14."* ]]; then
    echo "skipped: clang-format 14 decides, and it is not here"
    return
  fi
  [ "$fix" = --fix ] && mode=(-i)
  git ls-files -z '*.cpp' '*.hpp' '*.h' '*.c' | xargs -0 -n 40 -P 2 "$program" "${mode[@]}" || return 1
  echo "every source is laid out as .clang-format says"
}

# With the prettier of web/package-lock.json, from the packages of the page's build.
check_web() {
  local mode=--check
  if command -v npm >/dev/null; then cmake -DNPM=npm -DSOURCE="$PWD/web" -DWORK="$PWD/build/web" -DALL=1 -P web/fetch.cmake; fi
  if [ ! -e build/web/fetched ] || ! command -v npm >/dev/null; then
    echo "skipped: npm could not fetch prettier, so the layout of web/ was not checked"
    return
  fi
  [ "$fix" = --fix ] && mode=--write
  git ls-files -z 'web/*.ts' 'web/*.mjs' 'web/*.css' 'web/*.html' | xargs -0 build/web/node_modules/.bin/prettier --log-level warn "$mode" || return 1
  echo "every source of web/ is laid out as prettier does"
}

bad=0
check_cpp || bad=1
check_web || bad=1
exit $bad
