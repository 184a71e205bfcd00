// SPDX-License-Identifier: Apache-2.0
// Where a line of sight meets a terrain: steps along it until it is below the ground, then halves
// the last one. Ridges thinner than a step are missed.
import {Matrix4, Ray, Raycaster, Vector2, Vector3} from 'three';

const STEPS = 512, HALVINGS = 20;

/** The line of sight through a place of the page, in the coordinates of the object. */
function sightOf(object, camera, x, y) {
  const [u, v] = [(2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight];
  const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const ahead = new Vector3(u, v, 0.5).unproject(camera).sub(eye).normalize();
  return new Ray(eye, ahead).applyMatrix4(new Matrix4().copy(object.matrixWorld).invert());
}

/** From where to where a ray is inside of a box, as factors of its direction; null: nowhere. */
function spanOf({origin, direction}, box) {
  let near = 0, far = Infinity;
  for (const axis of ['x', 'y', 'z']) {
    const ends = [box.min[axis], box.max[axis]].map((side) =>
      (side - origin[axis]) / (direction[axis] || Number.MIN_VALUE));
    near = Math.max(near, Math.min(...ends));
    far = Math.min(far, Math.max(...ends));
  }
  return near < far ? [near, far] : null;
}

/** Where the line of sight through a place of the page meets the triangles of a mesh that is no
 * terrain: as Raycaster tells it; nothing where it does not. */
export function hitOn(mesh, camera, x, y) {
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2((2 * x) / innerWidth - 1, 1 - (2 * y) / innerHeight), camera);
  return ray.intersectObject(mesh)[0];
}

/** The first point of the terrain on the way, or null. */
export function pointOn(object, camera, x, y) {
  const {geometry} = object, ray = sightOf(object, camera, x, y), point = new Vector3();
  if (!geometry.boundingBox) geometry.computeBoundingBox();
  // Flat ground has a box without a height.
  const box = geometry.boundingBox.clone().expandByScalar(1e-3);
  const span = spanOf(ray, box);
  if (!span) return null;
  const above = (share) => {
    ray.at(span[0] + share * (span[1] - span[0]), point);
    return point.y - object.heightAt(point.x, point.z);
  };
  let before = above(0);
  for (let i = 1; i <= STEPS; ++i) {
    const here = above(i / STEPS);
    if (before >= 0 && here <= 0) {
      let [low, high] = [(i - 1) / STEPS, i / STEPS];
      for (let k = 0; k < HALVINGS; ++k) {
        const middle = (low + high) / 2;
        if (above(middle) >= 0) low = middle;
        else high = middle;
      }
      above(high);
      return {x: point.x, y: object.heightAt(point.x, point.z), z: point.z};
    }
    before = here;
  }
  return null;
}
