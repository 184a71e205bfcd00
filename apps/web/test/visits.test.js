// SPDX-License-Identifier: Apache-2.0
// Places that the viewer's camera goes to: how they are written, the way there, and that what is
// asked for comes to the middle of the picture, on globes and on flat ground.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {Vector3} from 'three';

import {encode} from '../src/encode.js';
import {wayRound} from '../viewer/journey.js';
import {placeIn} from '../viewer/places.js';
import {earth, earthOnCube} from './earth.js';
import {terrainOf} from './terrain.js';
import {MIDDLE, viewerSite} from './viewer_site.js';

const TIMEOUT = {timeout: 120000};
let site;

before(async () => {
  site = await viewerSite({
    'earth.tks': await encode({heights: earth().heights, bytes: 40000}),
    'cube.tks': await encode({heights: earthOnCube().heights, bytes: 40000}),
    'flat.tks': await encode({...terrainOf(129), bytes: 40000}),
  });
});
after(() => site.close());

test('places are written in several ways', () => {
  for (const [text, place] of [
    ['46.5, 8.2', [8.2, 46.5]], ['-33.9,18.4', [18.4, -33.9]], ['33.9° S 18.4° E', [18.4, -33.9]],
    ['10N 20w', [-20, 10]], ['90;-180', [-180, 90]], ['+1. 2', [2, 1]],
    ['91, 0', null], ['5', null], ['', null], ['here, there', null], [null, null],
    ['1, 2, 3', null],
  ]) assert.deepEqual(placeIn(text), place, text);
});

test('the way round a globe is the shorter one, stays above it, and ends where it shall', () => {
  const at = (longitude, latitude, away) => new Vector3().setFromSphericalCoords(away,
    ((90 - latitude) * Math.PI) / 180, ((longitude + 90) * Math.PI) / 180);
  for (const [from, to] of [
    [at(170, 10, 3), at(-170, -20, 1.1)], [at(0, 80, 1.05), at(180, 80, 1.05)],
    [at(20, 0, 2), at(20, 0, 2)],
  ]) {
    const way = wayRound(from, to, 1);
    assert.ok(way.at(0).eye.distanceTo(from) < 1e-6);
    assert.ok(way.at(1).eye.distanceTo(to) < 1e-6);
    let length = 0, before = from.clone().normalize();
    for (let share = 0; share <= 1; share += 0.01) {
      const {eye, target} = way.at(share);
      assert.ok(eye.length() > 1.04 && target.length() === 0);
      const here = eye.clone().normalize();
      length += here.angleTo(before);
      before = here;
    }
    // Not over a pole: north stays above.
    assert.ok(length < 1.7 * from.angleTo(to) + 1e-3, `${length}`);
  }
});

/** [longitude, latitude] that the page tells of what it draws there. */
async function degreesAt(page, {x, y}) {
  await page.mouse.move(x + 1, y);
  await page.mouse.move(x, y);
  await page.waitForTimeout(200);
  const text = await page.locator('#under').textContent();
  const [, latitude, n, longitude, e] = /([\d.]+)° ([NS]) ([\d.]+)° ([EW])/.exec(text);
  return [Number(longitude) * (e === 'W' ? -1 : 1), Number(latitude) * (n === 'S' ? -1 : 1)];
}
function assertNear(got, wanted, degrees) {
  const [across, up] = got.map((value, i) => value - wanted[i]);
  const away = Math.hypot(across - 360 * Math.round(across / 360), up);
  assert.ok(away < degrees, `${got}, not ${wanted}`);
}
/** Metres from the centre of a globe, or from what is looked at. */
const farness = (page) => page.evaluate(() => {
  const numbers = (name) =>
    new URLSearchParams(location.hash.slice(1)).get(name).split(',').map(Number);
  const [eye, target] = [numbers('eye'), numbers('target')];
  return Math.hypot(...eye.map((value, i) => value - target[i]));
});
/** Calls go(), and waits until the camera is where that takes it: at once where no motion is
 * wanted, which the address then tells. */
async function arrived(page, go, isMoving = false) {
  await page.emulateMedia({reducedMotion: isMoving ? 'no-preference' : 'reduce'});
  const before = await page.evaluate(() => location.hash);
  await go();
  if (isMoving) await page.waitForTimeout(3000);
  else await page.waitForFunction((hash) => location.hash !== hash, before);
}

test('a double click brings a place to the middle, and nearer', TIMEOUT, async () => {
  for (const [name, degrees, isMoving] of [['earth', 1, true], ['cube', 1], ['flat', 0.002]]) {
    await site.withPage(`tks=${name}.tks`, async (page) => {
      const corner = {x: MIDDLE.x + 70, y: MIDDLE.y - 40}, place = await degreesAt(page, corner);
      await arrived(page, () => page.mouse.dblclick(corner.x, corner.y), isMoving);
      const far = await farness(page);
      assertNear(await degreesAt(page, MIDDLE), place, degrees);
      await arrived(page, () => page.mouse.dblclick(MIDDLE.x, MIDDLE.y), isMoving);
      assert.ok(await farness(page) < far, name);
    });
  }
});

test('a place in the address, or typed, is gone to', TIMEOUT, async () => {
  for (const name of ['earth', 'cube']) {
    await site.withPage(`tks=${name}.tks&place=-33.9,18.4`, async (page) => {
      await page.waitForTimeout(2500);
      assertNear(await degreesAt(page, MIDDLE), [18.4, -33.9], 0.5);
      await page.locator('#place').fill('40 N 178.5 W');
      await arrived(page, () => page.locator('#place').press('Enter'));
      assertNear(await degreesAt(page, MIDDLE), [-178.5, 40], 0.5);
      await page.locator('#place').fill('nowhere');
      await page.locator('#place').press('Enter');
      assert.match(await page.locator('#place').evaluate((place) => place.validationMessage),
        /Latitude and longitude/);
    });
  }
  await site.withPage('tks=flat.tks', async (page) => {
    const place = await degreesAt(page, {x: MIDDLE.x - 60, y: MIDDLE.y});
    await page.locator('#place').fill(`${place[1]}, ${place[0]}`);
    await arrived(page, () => page.getByRole('button', {name: 'Go'}).click());
    assertNear(await degreesAt(page, MIDDLE), place, 0.002);
    await page.locator('#place').fill('0, 0');
    await page.locator('#place').press('Enter');
    assert.match(await page.locator('#place').evaluate((place) => place.validationMessage),
      /does not reach/);
  });
});

test('arrows go round a globe, by less where it is near', TIMEOUT, async () => {
  await site.withPage('tks=earth.tks&place=10,20', async (page) => {
    await page.waitForTimeout(2500);
    const begin = await degreesAt(page, MIDDLE);
    await page.locator('#picture').focus();
    for (const [key, axis, sign] of [['ArrowLeft', 0, 1], ['ArrowRight', 0, -1], ['ArrowUp', 1, -1],
      ['ArrowDown', 1, 1]]) {
      const before = await degreesAt(page, MIDDLE);
      await page.keyboard.press(key);
      await page.waitForTimeout(1000);
      const moved = (await degreesAt(page, MIDDLE))[axis] - before[axis];
      assert.ok(moved * sign > 0.1 && moved * sign < 3, `${key}: ${moved} degrees`);
    }
    assertNear(await degreesAt(page, MIDDLE), begin, 1.5);
  });
});
