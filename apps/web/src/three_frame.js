// SPDX-License-Identifier: Apache-2.0
// A frame of a stream as three.js has it: a geometry and a texture. x points east, y up, z south
// (of streams without a place along the rows and down the columns); metres, with the middle of the
// terrain at (0, 0).
import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, DataTexture, LinearFilter,
  LinearMipmapLinearFilter, RGBAFormat, RepeatWrapping, SRGBColorSpace,
} from 'three';

import {groundAxes, normalsOn, placedOn, trianglesOn} from './axes.js';
import {drapeOf} from './drape.js';
import {groundScale} from './ground.js';

/** The geometry of the mesh, or of the flat rectangle of an image without heights. */
export function geometryOf(frame) {
  const {info, mesh} = frame;
  const geometry = new BufferGeometry();
  const flat = !mesh;
  const width = flat ? 2 : info.width, height = flat ? 2 : info.height;
  const grid = flat ? [0, 1, 2, 3] : mesh.gridIndex;
  const scale = flat
    ? {x: info.textureWidth, y: info.textureHeight, height: 1}
    : groundScale(info);
  const drape = drapeOf(flat ? {width, height} : info);
  const axes = groundAxes(flat ? {} : info), placed = placedOn(axes);
  const positions = new Float32Array(3 * grid.length), places = new Float32Array(2 * grid.length);
  for (let i = 0; i < grid.length; ++i) {
    const column = grid[i] % width, row = Math.floor(grid[i] / width);
    const [east, south] =
      placed((column - (width - 1) / 2) * scale.x, (row - (height - 1) / 2) * scale.y);
    positions.set([east, flat ? 0 : mesh.heights[i] * scale.height, south], 3 * i);
    places.set(drape(column, row), 2 * i);
  }
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('uv', new BufferAttribute(places, 2));
  const triangles = flat ? new Uint32Array([0, 2, 1, 1, 2, 3]) : trianglesOn(axes, mesh.triangles);
  geometry.setIndex(new BufferAttribute(triangles, 1));
  if (mesh?.normals) {
    geometry.setAttribute('normal', new BufferAttribute(normalsOn(axes, mesh.normals), 3));
  } else {
    geometry.computeVertexNormals();
  }
  return geometry;
}

/** A texture of RGBA rows, the first row at v = 0. That of an atlas has no mip levels, which would
 * mix patches: frames have one of the size that is seen. */
export function textureOf({width, height, gutter, repeats, data}) {
  const bytes = new Uint8Array(data.buffer, data.byteOffset, data.length);
  const texture = new DataTexture(bytes, width, height, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.generateMipmaps = !gutter;
  texture.minFilter = gutter ? LinearFilter : LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.anisotropy = gutter ? 1 : 8;
  texture.wrapS = texture.wrapT = repeats ? RepeatWrapping : ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

/** The mesh of a geometry as it is drawn while it is `left` of the way from its end. */
export function meshOf({attributes, index, morphAttributes}, left) {
  const drawn = (name) => {
    const end = attributes[name].array, start = morphAttributes[name]?.[0].array;
    return left > 0 && start ? end.map((v, i) => v + left * (start[i] - v)) : end;
  };
  return {positions: drawn('position'), normals: drawn('normal'), triangles: index.array};
}
