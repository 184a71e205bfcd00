// SPDX-License-Identifier: Apache-2.0
// Receivers of servers that lose answers, damage them, lie, stall, forget, or serve for very long.
import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {before, test} from 'node:test';

import {receive} from '../src/index.js';
import {HEIGHTS, countingMemory, using} from './sequences.js';
import {answerOf, fakeServer, groupOf} from './transmitter.js';

const vectors = new URL('../../../conformance/vectors/', import.meta.url);
let stream;

before(async () => {
  stream = await readFile(new URL('geometry_budget_129x97.tks', vectors));
});

/** What a transmitter knows of receivers, by their numbers: how many answers they got. */
class Transmitter {
  answers = new Map();
  /** The next answer to a receiver, or nothing where it tells of more than it got. */
  answer({receiver, answers}, endFrame, pieces) {
    const given = this.answers.get(receiver) ?? 0;
    if (answers > given) return null;
    this.answers.set(receiver, given + 1);
    return answerOf(given, endFrame, pieces);
  }
}
const groups = (...numbers) =>
  numbers.map((group) => ({group, bytes: groupOf(group, stream)}));

async function faking(respond, use) {
  const server = await fakeServer(respond);
  try {
    return await use(server);
  } finally {
    await server.close();
  }
}
/** A server whose first answer has frame 0; `second(answer, response)` spoils the second one. Frame
 * 1 comes in a later one, which has to tell that the second one was lost. */
async function spoiling(second, use = () => {}) {
  const transmitter = new Transmitter(), controls = [];
  await faking(({control, count}, response) => {
    controls.push(control);
    const isLater = controls.length > 2;
    const pieces = count === 0 ? groups(0) : count === 1 || controls.length === 3 ? groups(1) : [];
    const answer = transmitter.answer(control, isLater || count > 0 ? 2 : 1, pieces);
    if (count === 1) return second(answer, response);
    if (!answer) return response.writeHead(409, {'content-type': 'text/plain'}).end('lies\n');
    response.end(answer);
  }, ({url}) => using(receive(url, {timeout: 300}), async (reception) => {
    while (reception.frames < 2) await reception.changed();
    const {surface} = await reception.decode(HEIGHTS);
    assert.equal(surface.width, 129);
    assert.equal(reception.error, null);
    await use(controls, reception);
  }));
}

test('answers that break, are damaged, late or refused come again', async () => {
  const spoilt = {
    cut: (answer, response) => {
      response.writeHead(200, {'content-length': answer.length});
      response.write(answer.subarray(0, 50), () => response.destroy());
    },
    short: (answer, response) => response.end(answer.subarray(0, 50)),
    flipped: (answer, response) => {
      answer[answer.length >> 1] ^= 1;
      response.end(answer);
    },
    refused: (answer, response) => response.writeHead(503).end(),
    destroyed: (answer, response) => response.destroy(),
    late: () => {},
    stalled: (answer, response) => response.write(answer.subarray(0, 50)),
  };
  for (const [name, second] of Object.entries(spoilt)) {
    await spoiling(second, (controls) => {
      const [, , third, fourth] = controls;
      assert.equal(third.answers, 1, name);
      // The second answer, number 1, did not come: the next message says so.
      if (fourth) assert.deepEqual([fourth.answers, fourth.lost & 1], [3, 1], name);
    });
  }
});

test('a server that has become another one gets another number, and begins anew', async () => {
  const transmitter = new Transmitter(), numbers = new Set();
  await faking(({control, count}, response) => {
    numbers.add(control.receiver);
    if (count === 2) transmitter.answers.clear();
    const [first, end] = numbers.size === 1 ? [5, 6] : [0, 1];
    const answer = transmitter.answer(control, end, control.answers === 0 ? groups(first) : []);
    if (!answer) return response.writeHead(409, {'content-type': 'text/plain'}).end('lies\n');
    response.end(answer);
  }, ({url}) => using(receive(url), async (reception) => {
    assert.equal(reception.frames, 6);
    while (reception.frames === 6) {
      assert.equal((await reception.decode(HEIGHTS)).number, 5);  // until others come
      await reception.changed();
    }
    assert.deepEqual([reception.firstFrame, reception.frames, numbers.size], [0, 1, 2]);
    assert.equal((await reception.decode(HEIGHTS)).number, 0);
  }));
});

test('groups that cannot be are refused, by a new receiver too, and what came stays', async () => {
  const transmitter = new Transmitter(), numbers = new Set();
  await faking(({control, count}, response) => {
    numbers.add(control.receiver);
    const misnamed = [{group: 7, bytes: groupOf(3, stream)}];
    response.end(transmitter.answer(control, 6, count === 0 ? groups(5) : misnamed));
  }, ({url}) => using(receive(url, {patience: 1000}), async (reception) => {
    await assert.rejects(async () => {
      for (;;) await reception.changed();
    }, {code: 'corrupt'});
    assert.ok(numbers.size > 1);
    assert.equal((await reception.decode(HEIGHTS)).number, 5);
  }));
});

test('what answers with no answers, too much, or too late is told', async () => {
  await faking((asked, response) => response.end('<!doctype html>'), async ({url}) =>
    assert.rejects(receive(url), ({code, message}) =>
      code === 'corrupt' && message.startsWith(`${url} answers`)));
  await faking(() => {}, async ({url}) =>
    assert.rejects(receive(url, {timeout: 100}), /sends nothing for 0.1 s/));
  await faking((asked, response) => {
    const more = () => response.write(Buffer.alloc(2 ** 22), (error) => error ?? more());
    more();
  }, async ({url}) => assert.rejects(receive(url), {code: 'limit'}));
});

test('what is wanted goes with the next message, whatever the server waits for', async () => {
  const transmitter = new Transmitter(), asked = [];
  await faking(async ({control, after, count}, response) => {
    asked.push(control);
    if (after !== null) await new Promise((resolve) => setTimeout(resolve, 5000));
    if (!response.destroyed) response.end(transmitter.answer(control, 1, count ? [] : groups(0)));
  }, ({url}) => using(receive(url, {link: 1000, triangles: 500}), async (reception) => {
    while (asked.length < 3) await new Promise((resolve) => setTimeout(resolve, 10));
    const {frame, link, triangles, width} = asked[0];
    assert.deepEqual([frame, link, triangles, width], [-1, 1000, 500, 0]);
    const begun = performance.now(), clip = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    reception.want({frame: 0, link: 2000, triangles: 0, view: {clip, width: 640, height: 480}});
    while (asked.length < 4) await new Promise((resolve) => setTimeout(resolve, 10));
    const {frame: next, link: more, triangles: any, width: wide} = asked[3];
    assert.deepEqual([next, more, any, wide], [0, 2000, 0, 640]);
    assert.ok(performance.now() - begun < 1000);
  }));
});

test('a server without frames to come is not asked all the time', async () => {
  const transmitter = new Transmitter();
  await faking(({control, count}, response) =>
    response.end(transmitter.answer(control, 1, count ? [] : groups(0))),
  (server) => using(receive(server.url), async () => {
    await new Promise((resolve) => setTimeout(resolve, 1500));
    assert.ok(server.count < 12, `${server.count} messages`);
  }));
});

test('ten thousand frames leave memory where it was', {timeout: 120000}, async () => {
  const FRAMES = 10000, KEEP = 16, AT_ONCE = 4, transmitter = new Transmitter();
  let next = 0;
  await countingMemory(({size}) => faking(({control}, response) => {
    const numbers = Array.from({length: Math.min(AT_ONCE, FRAMES - next)}, () => next++);
    response.end(transmitter.answer(control, next, groups(...numbers)));
  }, ({url}) => using(receive(url, {keep: KEEP}), async (reception) => {
    let before = null, shown = 0;
    for await (const {number} of reception.newest({...HEIGHTS, samples: 33})) {
      ++shown;
      assert.ok(reception.frames - reception.firstFrame <= KEEP + 2 * AT_ONCE);
      assert.ok(Object.keys(reception.times).length <= KEEP + 2 * AT_ONCE);
      if (number > 1000) before ??= size();
      if (number === FRAMES - 1) break;
    }
    assert.ok(shown > 100);
    assert.ok(size() <= before, `${size()} after ${before} bytes`);
    await assert.rejects(
      reception.decode({...HEIGHTS, frame: 5, signal: AbortSignal.timeout(500)}));
    assert.ok(size() <= 2 * before);
  })));
});
