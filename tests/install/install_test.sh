#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install_test.sh BUILD: installs a build, looks at what is there, and links it like a user: from C and
# C++, static and shared (where the build has shared libraries), by find_package and by pkg-config.
set -euo pipefail

build="$1"
source="$(cd "$(dirname "$0")" && pwd)"
stream="$source/../../conformance/vectors/geometry_budget_129x97.tks"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
prefix="$scratch/prefix"

quiet() { "$@" > "$scratch/log" 2>&1 || { cat "$scratch/log"; return 1; }; }
fail() { echo "$*"; exit 1; }

# consume LANGUAGE LIBRARY...: configures and builds the user's project, and runs its programs.
consume() {
  local folder="$scratch/consumers-$1" input=() libraries="${*:2}"
  quiet cmake -S "$source" -B "$folder" -DCMAKE_PREFIX_PATH="$prefix" -DCONSUMER_LANGUAGE="$1" \
    -DLIBRARIES="${libraries// /;}"
  quiet cmake --build "$folder"
  if [[ "$1" == C ]]; then input=("$stream"); fi
  for library in "${@:2}"; do
    "$folder/consumer_$library" "${input[@]}" || fail "the $1 consumer of $library fails"
  done
}

# config LIBRARY OPTIONS...: what pkg-config says.
config() { PKG_CONFIG_PATH="$(dirname "$pc")" pkg-config --cflags --libs "${@:2}" "$1"; }

quiet cmake --install "$build" --prefix "$prefix"
pc="$(find "$prefix" -name tetrakis.pc)"
libraries="$(dirname "$(dirname "$pc")")"
[[ "$(cd "$prefix" && find . -name '*.a' -printf '%f ')" =~ ^(libtetrakis(_decoder)?\.a ){2}$ ]] ||
  fail "other archives than two: $(find "$prefix" -name '*.a')"

kinds=("" _static)
if [[ -e "$libraries/libtetrakis.so" ]]; then kinds+=(_shared); fi
consume C "${kinds[@]/#/tetrakis}" "${kinds[@]/#/tetrakis_decoder}"
consume CXX "${kinds[@]/#/tetrakis}"

# Linked by hand: what the archives need beside themselves stands in the files.
for name in tetrakis tetrakis_decoder; do
  read -ra flags <<< "$(config "$name" --static)"
  flags=("${flags[@]/#-l$name/$libraries/lib$name.a}")
  "${CC:-cc}" -std=c99 -pedantic -Werror "$source/consumer.c" -o "$scratch/from_c" "${flags[@]}"
  "$scratch/from_c" "$stream" || fail "C with $name.pc --static fails"
  read -ra flags <<< "$(config "$name")"
  "${CC:-cc}" "$source/consumer.c" -o "$scratch/from_c" "${flags[@]}"
  LD_LIBRARY_PATH="$libraries" "$scratch/from_c" "$stream" || fail "C with $name.pc fails"
done
for header in components mosaic sequence transmit; do  # and what they include
  printf '#include <tetrakis/%s.h>\n' "$header" |
    "${CXX:-c++}" -x c++ -std=c++98 -Wno-long-long -pedantic -Werror -fsyntax-only \
      -I"$prefix/include" -
  printf '#include <tetrakis/%s.h>\n' "$header" |
    "${CC:-cc}" -x c -std=c99 -pedantic -Werror -fsyntax-only -I"$prefix/include" -
done

for library in "$libraries"/libtetrakis*.so; do
  [[ -e "$library" ]] || continue
  readelf -d "$library" | grep -q "SONAME.*$(basename "$library")\.[0-9]*\]" ||
    fail "$library names no major version"
  others="$(nm -D --defined-only "$library" | awk '$3 !~ /^tks_/')"
  [[ -z "$others" ]] || fail "$library exports $others"
done
if [[ -e "$libraries/libtetrakis_decoder.so" ]]; then
  headers=("$prefix"/include/tetrakis/{tetrakis,components,sequence,transmit}.h)
  declared="$(sed -n 's/.*\b\(tks_[a-z_]*\)(.*/\1/p' "${headers[@]}" |
    grep -vx 'tks_cube_from_grid\|tks_encode\|tks_encode_object\|tks_fit_positions\|tks_find_[a-z_]*' |
    grep -vx 'tks_free_buffer\|tks_combine\|tks_reorder\|tks_encode_frames' |
    grep -vx 'tks_sequence_encoder_[a-z]*' |
    grep -vx 'tks_sequence_push\|tks_sequence_flush\|tks_sequence_take\|tks_sequence_thin' |
    grep -vx 'tks_receiver_write\|tks_transmitter_[a-z_]*' |
    sort -u)"
  for function in $declared; do
    nm -D --defined-only "$libraries/libtetrakis_decoder.so" | grep -q " $function$" ||
      fail "libtetrakis_decoder.so lacks $function"
  done
fi

"$prefix/bin/tetrakis" --version
# Greymaps are read through the module of picture formats.
printf 'P2\n3 2\n255\n1 2 3 4 5 6\n' > "$scratch/a.pgm"
quiet "$prefix/bin/tetrakis" encode "$scratch/a.pgm" --lossless -o "$scratch/a.tks"
