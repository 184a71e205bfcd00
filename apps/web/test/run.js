// SPDX-License-Identifier: Apache-2.0
// Runs all tests of this folder, a file on each core: `node --test` leaves one core to itself.
import {readdirSync} from 'node:fs';
import {availableParallelism} from 'node:os';
import {run} from 'node:test';
import {tap} from 'node:test/reporters';

const folder = new URL('.', import.meta.url).pathname;
const files = readdirSync(folder).filter((name) => name.endsWith('.test.js'))
  .map((name) => folder + name);
run({files, concurrency: availableParallelism()})
  .on('test:fail', () => { process.exitCode = 1; })
  .compose(tap).pipe(process.stdout);
