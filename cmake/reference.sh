#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the reference of the shipped plugins: BUILD/docs/reference/<plugin>.md, messages.md and README.md. Fails when a plugin, component
# or parameter has no description, or when a description or a help text breaks docs/style.md.   cmake/reference.sh [BUILD]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
out=$build/docs/reference
rm -rf "$out" && mkdir -p "$out"
for plugin in "$build"/lib/fulmar/*.so; do
  "$build/bin/fulmar" inspect --markdown "$plugin" >"$out/$(basename "$plugin" .so).md"
done
/usr/bin/python3 cmake/reference.py "$out" configs/missions/*.yaml -- sdk/include/fulmar/msg/*.hpp plugins/*/*.hpp
/usr/bin/python3 cmake/prose.py --built "$build"
