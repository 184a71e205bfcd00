// SPDX-License-Identifier: Apache-2.0
// The declarations, as TypeScript takes them beside those of the libraries.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {test} from 'node:test';

const web = new URL('..', import.meta.url).pathname;

/** What the compiler says of test/user.ts and of our own declarations. */
function complaints(...options) {
  const {stdout} = spawnSync('node_modules/.bin/tsc', [
    '--noEmit', '--strict', '--target', 'es2022', ...options, 'test/user.ts',
  ], {cwd: web, encoding: 'utf8'});
  return stdout.split('\n').filter((line) => /^(src|test)\//.test(line) || /^error/.test(line));
}

test('what users write in TypeScript is accepted, with any kind of resolution', () => {
  const lib = ['--lib', 'es2022,dom,dom.iterable,esnext.disposable'];
  for (const [module, resolution] of [['esnext', 'bundler'], ['nodenext', 'nodenext']]) {
    const said = complaints(...lib, '--module', module, '--moduleResolution', resolution);
    assert.deepEqual(said, [], resolution);
  }
});
