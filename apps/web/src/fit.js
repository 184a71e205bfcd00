// SPDX-License-Identifier: Apache-2.0
// From where a camera of a given direction sees all of a terrain, as near as it can.
import {Box3, MathUtils, Vector3} from 'three';

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

/** From the south, above. */
const USUAL = new Vector3(-0.35, -0.62, -1);
/** Of half of the picture, that is left around the terrain. */
const MARGIN = 0.04;

/** Unit axes of a camera that looks along `direction` with the y axis upright. */
function axesOf(direction) {
  const ahead = direction.clone().normalize();
  const isUpright = Math.abs(ahead.y) > 0.9999;
  const above = isUpright ? new Vector3(0, 0, -1) : new Vector3(0, 1, 0);
  const right = new Vector3().crossVectors(ahead, above).normalize();
  return {ahead, right, up: new Vector3().crossVectors(right, ahead)};
}

/** Tangents of the angles from the axis to the edges of a picture. */
function windowOf(camera) {
  const high = ((1 - MARGIN) * Math.tan(MathUtils.degToRad(camera.fov) / 2)) / camera.zoom;
  return {left: -high * camera.aspect, right: high * camera.aspect, low: -high, high};
}

/** Calls take(point) with every vertex of an object, where it lies in the world. */
function eachPlace({geometry, matrixWorld}, take) {
  const places = geometry.getAttribute('position'), point = new Vector3();
  for (let i = 0; i < places.count; ++i) {
    take(point.fromBufferAttribute(places, i).applyMatrix4(matrixWorld));
  }
}

/** The least zoom by which an orthographic camera at `eye` has all of a box in its picture. */
function zoomFor(camera, {right, up}, eye, corners) {
  const reach = (axis) => Math.max(
    ...corners.map((corner) => Math.abs(corner.clone().sub(eye).dot(axis))), Number.MIN_VALUE);
  return ((1 - MARGIN) / 2) * Math.min(
    (camera.right - camera.left) / reach(right), (camera.top - camera.bottom) / reach(up));
}

/** Puts a camera so that an object fills its picture; gives the middle of the object. */
export function fitCamera(camera, object, direction = USUAL) {
  object.updateWorldMatrix(true, false);
  const box = new Box3().setFromObject(object, true), axes = axesOf(direction);
  const middle = box.getCenter(new Vector3());
  const radius = box.getSize(new Vector3()).length() / 2 || 1;
  const corners = Array.from({length: 8}, (_, i) => new Vector3(...['x', 'y', 'z'].map(
    (axis, k) => box[i >> k & 1 ? 'max' : 'min'][axis])));
  if (camera.isOrthographicCamera) {
    camera.position.copy(middle).addScaledVector(axes.ahead, -2 * radius);
    camera.zoom = zoomFor(camera, axes, camera.position, corners);
  } else {
    camera.position.copy(placeFor(axes, windowOf(camera), (take) => eachPlace(object, take)));
  }
  const reach = camera.position.distanceTo(middle) + radius;
  let nearest = Infinity;
  eachPlace(object, (point) => {
    nearest = Math.min(nearest, point.sub(camera.position).dot(axes.ahead));
  });
  // The place of the camera may be the tip of a peak that points at it.
  const back = Math.max(0, reach / 2500 - nearest);
  camera.position.addScaledVector(axes.ahead, -back);
  camera.up.set(0, 1, 0);
  camera.near = Math.min(reach / 5000, (nearest + back) / 2);
  camera.far = 4 * reach;
  camera.lookAt(camera.position.clone().add(axes.ahead));
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  return middle;
}
