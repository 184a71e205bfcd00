// SPDX-License-Identifier: Apache-2.0
// The ellipsoid of a stream: by its keys, by WKT, by a name; and globes that lie on it.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {EARTH, bodyOf} from '../src/body.js';
import {encode} from '../src/encode.js';
import {groundScale, open} from '../src/index.js';

const MOON = {semiMajor: 1737400, semiMinor: 1737400};
const MOON_KEYS = '1024=2 2048=32767 2049="Moon (2015)|2057=1|" 2054=9102 2056=32767 ' +
  '2057=1737400.0 2058=1737400.0 2061=0.0';

test('keys, WKT and names tell the ellipsoid; nothing else does', () => {
  for (const [info, {semiMajor, semiMinor}] of [
    [{geoKeys: MOON_KEYS, crs: 'GCS Name = Mars'}, MOON],
    [{geoKeys: '1024=2 2057=3396190 2059=169.894447223612'},
      {semiMajor: 3396190, semiMinor: 3376200}],
    [{geoKeys: '1024=2', crs: 'IAU_2015:30100'}, MOON],
    [{crs: 'GEOGCRS["Mars (2015)",DATUM["Mars",ELLIPSOID["Mars (2015)",3396190,169.894447223612,' +
      'LENGTHUNIT["metre",1]]]]'}, {semiMajor: 3396190, semiMinor: 3376200}],
    [{crs: 'GEOGCS["GCS_Moon_2000",DATUM["D",SPHEROID["Moon_2000_IAU_IAG",1737400.0,0.0]]]'}, MOON],
    [{crs: 'ESRI:104905'}, {semiMajor: 3396190, semiMinor: 3376200}],
    [{crs: 'GCS_Moon_2000'}, MOON],
    [{crs: 'EPSG:4326', geoKeys: ''}, EARTH], [{crs: 'Marseille'}, EARTH], [{}, EARTH],
  ]) {
    const body = bodyOf(info);
    assert.equal(body.semiMajor, semiMajor, JSON.stringify(info));
    assert.ok(Math.abs(body.semiMinor - semiMinor) < 0.1, JSON.stringify(info));
  }
});

test('a globe has the size of its body, unless the caller says otherwise', async () => {
  const heights = {data: new Int16Array(36 * 18).fill(100), width: 36, height: 18, unit: 'm',
    crs: 'GCS Name = Moon', geoKeys: MOON_KEYS, geotransform: [-180, 10, 0, 90, 0, -10]};
  const terrain = await open(await encode({heights}));
  const {y} = groundScale(terrain.info);
  assert.ok(Math.abs(y - (10 * Math.PI * 1737400) / 180) < 1e-6, `${y} m between rows`);
  for (const [globe, radius] of [[{}, 1737500], [{exaggeration: 10}, 1738400],
    [{semiMajor: 2e6, semiMinor: 2e6}, 2000100]]) {
    const {globe: {positions}} = await terrain.decode({globe});
    for (let i = 0; i < positions.length; i += 3) {
      const away = Math.hypot(...positions.subarray(i, i + 3));
      assert.ok(Math.abs(away - radius) < 1e-3, `${away} m`);
    }
  }
  terrain.dispose();
});
