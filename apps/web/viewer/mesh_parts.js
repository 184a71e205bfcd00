// SPDX-License-Identifier: Apache-2.0
// The parts of what loaders of three.js give: geometries where the nodes of a scene place them.
import {Matrix4, Mesh} from 'three';
import {OBJLoader} from 'three/addons/loaders/OBJLoader.js';
import {PLYLoader} from 'three/addons/loaders/PLYLoader.js';
import {STLLoader} from 'three/addons/loaders/STLLoader.js';

/** All places of a node that draws its mesh several times. */
function placesOf(node) {
  if (!node.isInstancedMesh) return [node.matrixWorld];
  return Array.from({length: node.count}, (_, i) => {
    const place = new Matrix4();
    node.getMatrixAt(i, place);
    return place.premultiply(node.matrixWorld);
  });
}

/**
 * From the root down, children in order: {geometry, matrix, isSolid, node}. Those that are not
 * solid are points or lines.
 */
export function partsOf(scene) {
  const parts = [];
  scene.updateMatrixWorld(true);
  scene.traverse((node) => {
    if (!node.isMesh && !node.isPoints && !node.isLine) return;
    const {geometry, isMesh: isSolid} = node;
    for (const matrix of placesOf(node)) parts.push({geometry, matrix, isSolid, node});
  });
  return parts;
}

const textOf = (buffer) => new TextDecoder().decode(buffer);

/** By their usual extensions. Texture coordinates of these formats count from the bottom. */
export const READERS = {
  obj: (buffer) => partsOf(new OBJLoader().parse(textOf(buffer))),
  ply: (buffer) => partsOf(new Mesh(new PLYLoader().parse(buffer))),
  stl: (buffer) => partsOf(new Mesh(new STLLoader().parse(buffer))),
};
