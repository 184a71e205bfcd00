// SPDX-License-Identifier: Apache-2.0
// Runs all tests of this folder, a file on each core and one more, as pages often wait; `node
// --test` leaves one core to itself. Files with pages take longest, and begin first.
import {readFileSync, readdirSync} from 'node:fs';
import {availableParallelism} from 'node:os';
import {run} from 'node:test';
import {tap} from 'node:test/reporters';

const folder = new URL('.', import.meta.url).pathname;
const shows = (file) => /chromium|viewer_site/.test(readFileSync(file, 'utf8'));
const files = readdirSync(folder).filter((name) => name.endsWith('.test.js'))
  .map((name) => folder + name).sort((a, b) => shows(b) - shows(a));
run({files, concurrency: availableParallelism() + 1})
  .on('test:fail', () => { process.exitCode = 1; })
  .compose(tap).pipe(process.stdout);
