// SPDX-License-Identifier: Apache-2.0
// Normals of triangles that are coded as they are: smooth round prisms of many sides, sharp at
// edges, whatever vertices the texture needs.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {creased} from '../src/creased_mesh.js';

const random = (i) => (Math.imul(i + 1, 0x9e3779b1) >>> 8) / 2 ** 24;

/** An upright prism of `sides` sides: those, then both ends round their middles. Of `seams` sides
 * each beginning has vertices with other texcoords than the end of the one before. */
function prism(sides, seams) {
  const positions = [], texcoords = [], triangles = [], numbers = new Map();
  const vertex = (corner, height, chart) => {
    const key = `${corner % sides} ${height} ${chart}`;
    if (!numbers.has(key)) {
      const angle = (2 * Math.PI * (corner % sides)) / sides, radius = corner < 0 ? 0 : 1;
      numbers.set(key, positions.length / 3);
      positions.push(radius * Math.cos(angle), radius * Math.sin(angle), height);
      texcoords.push(chart, height);
    }
    return numbers.get(key);
  };
  for (let side = 0; side < sides; ++side) {
    const chart = Math.floor((side * seams) / sides);
    const [a, b, c, d] = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([right, height]) =>
      vertex(side + right, height, chart));
    triangles.push(a, b, c, a, c, d);
  }
  for (let side = 0; side < sides; ++side) {
    triangles.push(vertex(side, 1, 0), vertex(side + 1, 1, 0), vertex(-1, 1, 0));
    triangles.push(vertex(side + 1, 0, 0), vertex(side, 0, 0), vertex(-1, 0, 0));
  }
  return {
    positions: Float64Array.from(positions), texcoords: Float64Array.from(texcoords),
    triangles: Uint32Array.from(triangles),
  };
}

const at = (values, width, vertex) => [...values.subarray(width * vertex, width * (vertex + 1))];

test('corners keep their places, on a texture too, and no vertex comes twice', () => {
  for (const sides of [3, 8, 9, 40]) {
    for (const seams of [1, 2, sides]) {
      const mesh = prism(sides, seams), made = creased(mesh), all = new Set();
      mesh.triangles.forEach((vertex, corner) => {
        const other = made.triangles[corner];
        assert.deepEqual(at(made.positions, 3, other), at(mesh.positions, 3, vertex));
        assert.deepEqual(at(made.texcoords, 2, other), at(mesh.texcoords, 2, vertex));
      });
      const count = made.positions.length / 3;
      for (let v = 0; v < count; ++v) {
        all.add([made.positions, made.normals].flatMap((values) => at(values, 3, v)).join() +
          ` ${at(made.texcoords, 2, v)}`);
      }
      assert.deepEqual([all.size, new Set(made.triangles).size], [count, count]);
      assert.equal(creased({...mesh, texcoords: null}).texcoords, null);
    }
  }
});

test('sides are smooth below 40 degrees, across seams too, and ends are flat', () => {
  for (const sides of [3, 4, 8, 10, 24, 2e4]) {
    for (const seams of [1, 3]) {
      const mesh = prism(sides, seams), {positions, normals, triangles} = creased(mesh);
      triangles.forEach((vertex, corner) => {
        const normal = at(normals, 3, vertex), [x, y] = at(positions, 3, vertex);
        const triangle = Math.floor(corner / 3), side = triangle >> 1;
        const middle = (2 * Math.PI * (side + 0.5)) / sides;
        const expected = triangle >= 2 * sides ? [0, 0, triangle % 2 ? -1 : 1]
          : sides > 8 ? [x, y, 0] : [Math.cos(middle), Math.sin(middle), 0];
        // A side is two triangles, and at its corners both or one count.
        const most = sides > 8 && triangle < 2 * sides ? 1.1 * Math.PI / sides : 1e-5;
        const off = Math.hypot(...normal.map((part, axis) => part - expected[axis]));
        assert.ok(off < most, `${sides} sides, ${seams} seams: ${normal} for ${expected}`);
      });
    }
  }
});

test('meshes of any triangles have normals of length 1, or none', () => {
  for (let i = 0; i < 200; ++i) {
    const points = 3 + Math.floor(9 * random(i)), triangles = new Uint32Array(3 * (i % 40));
    for (let k = 0; k < triangles.length; ++k)
      triangles[k] = Math.floor(points * random(31 * i + 7 * k));
    const positions = Float64Array.from({length: 3 * points}, (_, k) =>
      Math.round(4 * random(1000 * i + k)));
    const made = creased({positions, texcoords: null, triangles});
    assert.equal(made.triangles.length, triangles.length);
    for (let v = 0; v < made.normals.length / 3; ++v) {
      const length = Math.hypot(...at(made.normals, 3, v));
      assert.ok(length === 0 || Math.abs(length - 1) < 1e-6, `${length}`);
    }
  }
});
