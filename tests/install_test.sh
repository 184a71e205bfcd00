#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install_test.sh BUILD: installs a build and links it like a user, by find_package and by pkg-config.
set -euo pipefail

build="$1"
source="$(cd "$(dirname "$0")/install" && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/prefix" > "$scratch/log"
cmake -S "$source" -B "$scratch/consumer" -DCMAKE_PREFIX_PATH="$scratch/prefix" >> "$scratch/log"
cmake --build "$scratch/consumer" >> "$scratch/log"
"$scratch/consumer/consumer"

pc="$(find "$scratch/prefix" -name tetrakis.pc)"
read -ra flags <<< "$(PKG_CONFIG_PATH="$(dirname "$pc")" \
  pkg-config --define-variable=prefix="$scratch/prefix" --cflags --libs tetrakis)"
"${CC:-cc}" "$source/consumer.c" -o "$scratch/from_c" "${flags[@]}"
"$scratch/from_c"

"$scratch/prefix/bin/tetrakis" --version
