// SPDX-License-Identifier: Apache-2.0
// From where the viewer sees all of a terrain.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Vector3} from 'three';

import {placeFor} from '../src/fit.js';

test('all points are in the window, which they touch on two sides', () => {
  const ahead = new Vector3(-0.35, -0.62, -1).normalize();
  const right = new Vector3().crossVectors(ahead, new Vector3(0, 1, 0)).normalize();
  const up = new Vector3().crossVectors(right, ahead);
  const window = {left: -0.6, right: 0.2, low: -0.3, high: 0.35};
  for (const size of [[100, 20, 100], [10, 200, 5], [3000, 1, 10], [1, 0, 1]]) {
    const points = Array.from({length: 8}, (_, i) =>
      new Vector3(...size.map((side, axis) => (i >> axis & 1 ? side : -side) + 7 * axis)));
    const eye = placeFor({ahead, right, up}, window, (take) => points.forEach(take));
    const seen = points.map((point) => {
      const way = point.clone().sub(eye), depth = way.dot(ahead);
      assert.ok(depth > 0);
      return [way.dot(right) / depth, way.dot(up) / depth];
    });
    const [x, y] = [seen.map((place) => place[0]), seen.map((place) => place[1])];
    const gaps = [Math.min(...x) - window.left, window.right - Math.max(...x),
      Math.min(...y) - window.low, window.high - Math.max(...y)];
    assert.ok(gaps.every((gap) => gap > -1e-9), gaps.join(' '));
    assert.ok(gaps.filter((gap) => gap < 1e-9).length >= 2, gaps.join(' '));
  }
});
