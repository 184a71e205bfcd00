#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# subdirectory_test.sh SOURCE: a C project that has the library as a folder links the static or the
# shared one. The build is planned, not run: it would compile the decoder anew.
set -euo pipefail

source="$(cd "$1" && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

for shared in OFF ON; do
  ending=a
  [[ "$shared" == OFF ]] || ending=so
  cmake -S "$source/tests/install" -B "$scratch/$shared" -G Ninja -DTETRAKIS_SOURCE="$source" \
    -DLIBRARIES=tetrakis_decoder -DBUILD_SHARED_LIBS="$shared" > "$scratch/log" 2>&1 ||
    { cat "$scratch/log"; exit 1; }
  ninja -C "$scratch/$shared" -t commands consumer_tetrakis_decoder | tail -n 1 |
    grep -q "consumer_tetrakis_decoder .*libtetrakis_decoder\.$ending" ||
    { echo "the consumer does not link libtetrakis_decoder.$ending"; exit 1; }
done
