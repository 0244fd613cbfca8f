#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs into a scratch prefix, builds the template against it outside the tree, tests it, and flies it with the installed host.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix
cmake --install build --prefix "$prefix" >/dev/null
cp -r "$prefix/share/fulmar/template" "$scratch/my_law"
cd "$scratch/my_law"
sed -i "s|PREFIX|$prefix|" mission.yaml
cmake -B build -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
cmake --build build
ctest --test-dir build --output-on-failure
symbols=$(nm -D --defined-only build/lib/fulmar/my_law.so | awk '{print $3}')
[ "$symbols" = fulmar_plugin_entry ] || { echo "my_law.so exports: $symbols"; exit 1; }
"$prefix/bin/fulmar" inspect build/lib/fulmar/my_law.so
"$prefix/bin/fulmar" run mission.yaml --json >result.json
grep -q '"result": "flown"' result.json
grep -q '"guards": \[\]' result.json
"$prefix/bin/fulmar" run "$prefix/share/fulmar/missions/hourglass.yaml" --duration 60
echo "the installed prefix flies"
