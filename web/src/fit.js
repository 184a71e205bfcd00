// SPDX-License-Identifier: Apache-2.0
// From where a camera of a given direction sees all of a terrain, as near as it can.
import {Vector3} from 'three';

/**
 * The place of a camera that looks along `ahead` and has all points in its picture. `window`: where
 * in the picture, {left, right, low, high} as tangents of angles to the axis. `eachPoint` calls
 * what it is given with every point.
 */
export function placeFor({ahead, right, up}, window, eachPoint) {
  // A point is in the picture where (x - cx) / (z - cz) lies between `left` and `right`, with x, y,
  // z along the axes of the camera and (cx, cy, cz) its place; likewise y. Each border bounds one
  // difference, for instance cx - right cz, by an extreme of the same difference of all points.
  const bounds = {left: Infinity, right: -Infinity, low: Infinity, high: -Infinity};
  eachPoint((point) => {
    const x = point.dot(right), y = point.dot(up), z = point.dot(ahead);
    bounds.left = Math.min(bounds.left, x - window.left * z);
    bounds.right = Math.max(bounds.right, x - window.right * z);
    bounds.low = Math.min(bounds.low, y - window.low * z);
    bounds.high = Math.max(bounds.high, y - window.high * z);
  });
  const cz = Math.min((bounds.left - bounds.right) / (window.right - window.left),
    (bounds.low - bounds.high) / (window.high - window.low));
  const cx = (bounds.left + bounds.right + (window.left + window.right) * cz) / 2;
  const cy = (bounds.low + bounds.high + (window.low + window.high) * cz) / 2;
  return new Vector3()
    .addScaledVector(right, cx).addScaledVector(up, cy).addScaledVector(ahead, cz);
}
