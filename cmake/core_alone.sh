#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Core knows no message: it compiles against abi.h alone, with the rest of the SDK out of sight.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/include/fulmar"
cp sdk/include/fulmar/abi.h "$scratch/include/fulmar/"
for file in core/error.cpp core/*/*.cpp; do
  echo "$file"
  ${CXX:-g++} -std=c++20 -fsyntax-only -DBOOST_DLL_USE_STD_FS -DSPDLOG_COMPILED_LIB -I. -I"$scratch/include" "$file"
done
