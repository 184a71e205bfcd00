// SPDX-License-Identifier: Apache-2.0
// What lies under the pointer: its height, and its place on Earth as far as that is known.
import {groundAxes, unplacedOn} from '../src/axes.js';
import {isForest} from '../src/domains.js';
import {groundScale} from '../src/ground.js';
import {isPlaced, placeOf} from '../src/place.js';
import {$} from './page.js';

/** Digits of a degree that are about a metre. */
const DIGITS = 5;

export function degreesText([longitude, latitude]) {
  const east = longitude - 360 * Math.round(longitude / 360);
  return `${Math.abs(latitude).toFixed(DIGITS)}° ${latitude < 0 ? 'S' : 'N'} ` +
    `${Math.abs(east).toFixed(DIGITS)}° ${east < 0 ? 'W' : 'E'}`;
}

/** From column and row to the text of a place: degrees, or coordinates of an unknown CRS. */
function placeText(info) {
  const part = info.hasHeights ? 'heights' : 'texture';
  if (!isPlaced(info) || isForest(info.domain)) return () => '';
  try {
    const {degrees} = placeOf(info, part);
    return (column, row) => degreesText(degrees(column, row));
  } catch {
    const [x0, a, b, y0, c, d] = info.hasHeights ? info.geotransform : info.textureGeotransform;
    return (column, row) =>
      `x ${(x0 + a * column + b * row).toFixed(1)} y ${(y0 + c * column + d * row).toFixed(1)}`;
  }
}

/** Gives the text of a point in metres around the middle of a terrain, as its mesh has it. */
export function describer(info) {
  const scale = info.hasHeights ? groundScale(info) : {x: 1, y: 1};
  const unplaced = unplacedOn(groundAxes(info.hasHeights ? info : {}));
  const textOf = placeText(info);
  const width = info.hasHeights ? info.width : info.textureWidth;
  const height = info.hasHeights ? info.height : info.textureHeight;
  const digits = info.heightsRmse > 0 && info.heightsRmse < 0.05 ? 2 : 1;
  return ({x, y, z}) => {
    const [along, down] = unplaced(x, z);
    const place = textOf(along / scale.x + width / 2, down / scale.y + height / 2);
    if (!info.hasHeights) return place;
    const tall = `${(y / scale.height).toFixed(digits)} ${info.unit}`.trim();
    return place ? `${tall} · ${place}` : tall;
  };
}

/** Says what lies under the pointer, once a picture; `describe`: gives the text of a point. */
export function listenToPointer(picture, describe) {
  const canvas = $('picture');
  let pending = false;
  canvas.addEventListener('pointermove', ({clientX, clientY}) => {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      const point = picture.pointAt(clientX, clientY);
      $('under').textContent = point ? describe(point) : '';
    });
  });
  canvas.addEventListener('pointerleave', () => ($('under').textContent = ''));
}
