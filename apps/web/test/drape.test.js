// SPDX-License-Identifier: Apache-2.0
// Where samples lie on a texture that has a place of its own.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {drapeOf, drapedTransform} from '../src/drape.js';

const heights = {
  width: 11, height: 21, crs: 'EPSG:32611+5773', hasGeotransform: true,
  geotransform: [500000, 30, 0, 4000000, 0, -30],
};

function placedOn(textureCrs, textureGeotransform) {
  return drapeOf({
    ...heights, textureHasGeotransform: true, textureCrs, textureGeotransform, textureWidth: 66,
    textureHeight: 126,
  });
}

test('a texture of a known place is laid there, whatever the vertical part of its CRS', () => {
  const finer = [500000 - 165, 10, 0, 4000000 + 315, 0, -10];
  for (const crs of ['EPSG:32611+5773', 'EPSG:32611', 'epsg:32611']) {
    assert.deepEqual(placedOn(crs, finer)(0, 0), [18 / 66, 33 / 126], crs);
    assert.deepEqual(placedOn(crs, finer)(10, 20), [48 / 66, 93 / 126], crs);
  }
});

test('a texture of another CRS, or of no place, reaches from the first sample to the last', () => {
  for (const crs of ['EPSG:32612', 'PROJCRS["a"]', '']) {
    assert.deepEqual(placedOn(crs, heights.geotransform)(10, 5), [1, 0.25], crs);
  }
  const unplaced = {...heights, textureHasGeotransform: false, textureWidth: 40, textureHeight: 80};
  assert.deepEqual(drapeOf(unplaced)(5, 20), [0.5, 1]);
  const draped = drapedTransform(unplaced);
  const placed = drapeOf({...unplaced, textureHasGeotransform: true,
    textureCrs: heights.crs, textureGeotransform: draped});
  assert.deepEqual(placed(10, 20), [1, 1]);
});
