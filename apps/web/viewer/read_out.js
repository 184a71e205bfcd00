// SPDX-License-Identifier: Apache-2.0
// What the panel says of a frame: its bytes, its triangles, its quality.
import {$} from './page.js';

export function formatBytes(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  const [value, unit] = bytes < 1e6 ? [bytes / 1e3, 'kB'] : [bytes / 1e6, 'MB'];
  return `${value.toFixed(value < 10 ? 1 : 0)} ${unit}`;
}
export const formatCount = (count) => count.toLocaleString('en').replaceAll(',', '\u2009');

function readQuality(info, isScattered) {
  $('heights-quality').hidden = !info.hasHeights;
  $('texture-quality').hidden = !info.hasTexture;
  // The stream states what its packets in their order bring. Where bytes came for a view, as many
  // or more are here, and the ground that is looked at is better than that.
  const [most, least] = isScattered ? ['≤ ', '≥ '] : ['', ''];
  const rmse = info.heightsRmse;
  $('rmse').textContent =
    rmse < 0 ? '–' : rmse === 0 ? 'exact'
    : `${most}${Number(rmse.toPrecision(2))} ${info.unit}`.trim();
  $('psnr').textContent = info.texturePsnr < 0 ? '–'
    : isFinite(info.texturePsnr) ? `${least}${info.texturePsnr.toFixed(1)} dB` : 'exact';
}

function readShares(info) {
  const share = (bytes) => `${(100 * bytes) / info.streamBytes}%`;
  const [surface, surfaceBytes] = info.objectTriangles
    ? ['mesh', info.headerBytes] : ['heights', info.geometryBytes];
  $('split-heights').style.width = share(surfaceBytes);
  $('split-texture').style.width = share(info.textureBytes);
  $('heights-share').textContent = `${surface} ${formatBytes(surfaceBytes)}`;
  $('texture-share').textContent = `texture ${formatBytes(info.textureBytes)}`;
  $('heights-share').hidden = !info.hasHeights && !info.isObject;
  $('texture-share').hidden = !info.hasTexture;
}

function readFetched({requests, bytes}) {
  const plural = requests === 1 ? '' : 's';
  const how = requests ? `fetched in ${requests} request${plural}` : 'read';
  const where = $('ground').hidden ? '' : ', and for which ground';
  $('fetched-text').textContent = `${formatBytes(bytes)} ${how}${where}`;
}

/** `loaded`: of its terrain. */
export function readOut({info, bytes, mesh, globe, object, surface: grid}, loaded) {
  $('bytes-here').textContent = formatBytes(bytes);
  $('bytes-of').textContent = `of ${formatBytes(info.streamBytes)}`;
  const surface = mesh ?? globe ?? object;
  const ofGrid = grid ? 2 * (grid.width - 1) * (grid.height - 1) : 2;
  $('triangles-here').textContent =
    formatCount(surface ? surface.triangles.length / 3 : ofGrid);
  readQuality(info, loaded.ranges.length > 1);
  readShares(info);
  readFetched(loaded);
}

/** What leaves the picture empty, if anything does. */
export function emptiness({info, mesh, globe, object, texture, complete}) {
  if (!complete) return '';
  if (info.hasHeights && (mesh ?? globe ?? object)?.triangles.length === 0) {
    return 'All heights of this stream are voids';
  }
  if (!info.textureCutout || !texture) return '';
  for (let i = 3; i < texture.data.length; i += 4) if (texture.data[i] > 0) return '';
  return 'The cut-out of this stream hides all texels';
}

/** How large a stream is, in words. */
export function sizeOf(info) {
  const sizes = [], {width, height, textureWidth, objectTriangles} = info;
  if (objectTriangles) sizes.push(`${formatCount(objectTriangles)} triangles`);
  else if (info.isObject) {
    const texels = info.hasTexture ? ` · ${textureWidth} × ${textureWidth} texels` : '';
    return `${height / width} patches of ${width} × ${width} heights${texels}`;
  }
  if (info.hasHeights) sizes.push(`${info.width} × ${info.height} heights`);
  if (info.hasTexture) sizes.push(`${info.textureWidth} × ${info.textureHeight} texels`);
  return sizes.join(' · ');
}
