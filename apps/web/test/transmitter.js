// SPDX-License-Identifier: Apache-2.0
// Servers of sequences for tests: `tetrakis serve`, and a transmitter of groups that are all alike,
// with the faults that servers have.
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {createServer} from 'node:http';
import {crc32} from 'node:zlib';

import {CLI} from './sequences.js';

/** Runs `tetrakis serve` on a file: {url, end()}. */
export async function serveFile(path, ...options) {
  const served = spawn(CLI, ['serve', path, ...options], {stdio: ['ignore', 'pipe', 'inherit']});
  const [text] = await once(served.stdout, 'data');
  return {
    url: String(text).trim(),
    async end() {
      if (served.signalCode) return;
      const exit = once(served, 'exit');
      served.kill('SIGKILL');
      await exit;
    },
  };
}

function varint(value) {
  const bytes = [];
  for (; value >= 128; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
  return [...bytes, value];
}
const u32 = (value) => [0, 8, 16, 24].map((shift) => (value >>> shift) & 255);
const withCrc = (bytes) => Buffer.from([...bytes, ...u32(crc32(Buffer.from(bytes)))]);

/** Head and stream of a group of one frame (docs/FORMAT.md, section 14). */
export function groupOf(number, stream) {
  const fields = [...varint(number), ...varint(number), ...varint(1), ...varint(stream.length),
    ...varint(0), ...varint(2 * number)];
  const head = withCrc([0x54, 0x4b, 0x47, 0x1a, 1, ...varint(fields.length), ...fields]);
  return Buffer.concat([head, stream]);
}
/** An answer (docs/CONTROL.md) with pieces {group, place, bytes}. */
export function answerOf(number, endFrame, pieces) {
  const all = pieces.flatMap(({group, place = 0, bytes}) =>
    [Buffer.from([...varint(group), ...varint(place), ...varint(bytes.length)]), bytes]);
  return withCrc(Buffer.concat([
    Buffer.from([0x54, 0x4b, 0x41, 1, ...varint(number), ...varint(endFrame)]), ...all]));
}

/** The fields of a control message that tests look at. */
export function controlOf(bytes) {
  let at = 12;
  const next = () => {
    let value = 0;
    for (let times = 1; ; times *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * times;
      if (byte < 128) return value;
    }
  };
  const receiver = bytes.subarray(4, 12).toString('hex'), answers = next();
  const lost = bytes.readUInt32LE(at);
  at += 4;
  const [kept, frame, link, triangles, width] = [next(), next() - 1, next(), next(), next()];
  return {receiver, answers, lost, kept, frame, link, triangles, width};
}

/** An HTTP server that `respond({control, after, count}, response)` answers the POSTs of. */
export async function fakeServer(respond, port = 0) {
  let count = 0;
  const server = createServer(async (request, response) => {
    const parts = [];
    for await (const part of request) parts.push(part);
    const after = new URL(request.url, 'http://x').searchParams.get('after');
    const control = controlOf(Buffer.concat(parts));
    await respond({control, after, count: count++}, response);
  });
  server.listen(port, '127.0.0.1');
  await once(server, 'listening');
  return {
    port: server.address().port,
    url: `http://127.0.0.1:${server.address().port}/frames.tks`,
    get count() {
      return count;
    },
    close() {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}
