// SPDX-License-Identifier: Apache-2.0
// Files of what is shown, for other programs: a mesh (.glb), heights (.tif), a texture (.png).
import {isForest} from '../src/domains.js';
import {glbOf} from './glb.js';
import {$, tell} from './page.js';
import {geoTiffOf} from './tiff.js';

/** Along a side: what a canvas and the memory of a page take. */
const MOST_SAMPLES = 8192;

async function pngOf({width, height, data}) {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d').putImageData(new ImageData(data, width, height), 0, 0);
  return canvas.convertToBlob({type: 'image/png'});
}

/** The mesh as it is drawn, in metres, an object in its unit, without the exaggeration of the
 * page. */
async function meshFile({geometry: {attributes, index, drawRange}, frame}) {
  const {array: positions, count} = attributes.position;
  const drawn = Math.min(index.count, drawRange.count);
  const mesh = {
    positions, normals: attributes.normal.array, triangles: index.array.subarray(0, drawn),
    places: attributes.uv?.array ?? new Float32Array(2 * count), centre: frame.object?.centre,
  };
  if (!frame.texture) return new Blob([glbOf(mesh)], {type: 'model/gltf-binary'});
  const png = await pngOf(frame.texture);
  const picture = {
    bytes: new Uint8Array(await png.arrayBuffer()), type: png.type,
    hasAlpha: !frame.info.textureOpaque, repeats: frame.texture.repeats,
  };
  return new Blob([glbOf(mesh, picture)], {type: 'model/gltf-binary'});
}

/** All heights that the bytes tell. */
async function heightsFile({terrain, bytes, frame}) {
  const {surface, info} = await terrain.decode(
    {frame, bytes, mesh: false, texture: false, surface: true, samples: MOST_SAMPLES});
  // That of a forest is the place of the grid that it was made of.
  const hasGeotransform = info.hasGeotransform && !isForest(info.domain);
  const placed = {...info, hasGeotransform, geotransform: surface.geotransform};
  return new Blob([geoTiffOf(surface, placed)], {type: 'image/tiff'});
}

async function textureFile({terrain, bytes, frame}) {
  return pngOf((await terrain.decode({frame, bytes, mesh: false, texels: MOST_SAMPLES})).texture);
}

/** The file of a kind, 'glb', 'tif' or 'png', of the frame of a terrain whose `bytes` first bytes
 * are shown. */
function fileOf(kind, {object, ...shown}) {
  if (kind === 'glb') return meshFile(object);
  return kind === 'tif' ? heightsFile(shown) : textureFile(shown);
}

/** Has the browser keep a file. */
function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Buttons save what `shown()` gives: {object, terrain, bytes, frame, name}. */
export function listenToSaves(shown) {
  const save = async ({currentTarget: {dataset: {kind}}}) => {
    const {name, ...parts} = shown();
    try {
      download(await fileOf(kind, parts), `${name.replace(/\.[^.]*$/, '')}.${kind}`);
    } catch (error) {
      tell(error.message);
    }
  };
  for (const button of document.querySelectorAll('.saves')) button.addEventListener('click', save);
}

/** What was coded can be kept. */
export function offer(file) {
  URL.revokeObjectURL($('save').href);
  $('save').href = URL.createObjectURL(file);
  $('save').download = file.name;
  $('save').hidden = false;
}
