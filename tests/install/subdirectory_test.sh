#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# subdirectory_test.sh SOURCE: a C project that has the library as a folder links it, static and
# shared. It builds in unity, as a project may: many files at once, in a quarter of the time.
set -euo pipefail

source="$(cd "$1" && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

for shared in OFF ON; do
  cmake -S "$source/tests/install" -B "$scratch/build" -DTETRAKIS_SOURCE="$source" \
    -DLIBRARY=tetrakis::tetrakis_decoder -DBUILD_SHARED_LIBS="$shared" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_UNITY_BUILD=ON > "$scratch/log"
  cmake --build "$scratch/build" --target consumer -j "$(nproc)" >> "$scratch/log" ||
    { cat "$scratch/log"; exit 1; }
  "$scratch/build/consumer" "$source/conformance/vectors/geometry_budget_129x97.tks" ||
    { echo "the consumer fails"; exit 1; }
done
