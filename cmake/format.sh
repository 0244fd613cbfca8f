#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Whether every source is laid out as .clang-format says.   format.sh [--fix]
set -euo pipefail
cd "$(dirname "$0")/.."
# Releases of clang-format differ in the details; it is 14 that decides.
program=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$program" ] || [[ $("$program" --version) != *"version 14."* ]]; then
  echo "skipped: clang-format 14 decides, and it is not here"
  exit 0
fi
mode=(--dry-run -Werror)
[ "${1:-}" = --fix ] && mode=(-i)
git ls-files -z '*.cpp' '*.hpp' '*.h' '*.c' | xargs -0 -n 40 -P 2 "$program" "${mode[@]}"
echo "every source is laid out as .clang-format says"
