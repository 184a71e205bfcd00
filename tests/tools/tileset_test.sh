#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tileset_test.sh TETRAKIS NODE_FOLDER: 3D Tiles that the command line writes keep the rules of the
# specification, and their meshes pass the Khronos glTF validator. Exits with 77 (skipped) where
# NODE_FOLDER has no validator: scripts/test installs it.
set -euo pipefail
cli="$1" node_folder="$2"
here="$(cd "$(dirname "$0")" && pwd)"
[[ -d "$node_folder/node_modules/gltf-validator" ]] || exit 77

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tetrakis() { "$cli" -q "$@"; }

tetrakis synth -o "$work" --size 129
gdal_translate -q -a_srs EPSG:32611 -a_ullr 380000 3810000 383870 3806130 \
  "$work/height.tif" "$work/placed.tif"
gdal_translate -q -a_srs EPSG:4326 -a_ullr -0.05 0.04 0.08 -0.09 -a_nodata 0 \
  "$work/height.tif" "$work/around.tif"
cd "$node_folder"
for name in placed around; do
  tetrakis encode "$work/$name.tif" --texture "$work/texture.png" --bytes 16k -o "$work/$name.tks"
  tetrakis tiles "$work/$name.tks" --format 3dtiles -o "$work/$name"
  node "$here/read_tileset.mjs" "$work/$name"
done
