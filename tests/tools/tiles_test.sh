#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tiles_test.sh TETRAKIS NODE_FOLDER: @here/quantized-mesh-decoder reads the tiles that the command
# line writes. Exits with 77 (skipped) where NODE_FOLDER has no decoder: scripts/test installs it.
set -euo pipefail
cli="$1" node_folder="$2"
here="$(cd "$(dirname "$0")" && pwd)"
[[ -d "$node_folder/node_modules/@here/quantized-mesh-decoder" ]] || exit 77

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tetrakis() { "$cli" -q "$@"; }

tetrakis synth -o "$work" --size 129
gdal_translate -q -a_srs EPSG:32611 -a_ullr 380000 3810000 383870 3806130 \
  "$work/height.tif" "$work/placed.tif"
tetrakis encode "$work/placed.tif" --bytes 16k -o "$work/a.tks"
tetrakis tiles "$work/a.tks" -o "$work/tiles"

cd "$node_folder"
node "$here/read_tiles.mjs" "$work/tiles"
