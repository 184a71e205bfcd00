// SPDX-License-Identifier: Apache-2.0
// Decodes away from the page's thread. The page hands over the compiled module with the first
// message, so that this file loads nothing.
import {buffersOf} from './frame.js';
import {failureOf} from './instance.js';
import {Operations} from './operations.js';
import {EXHAUSTED} from './stream_decoder.js';

let operations;
const running = new Map();  // an AbortController for each call

async function answer({id, operation, argument}) {
  const stop = new AbortController();
  running.set(id, stop);
  try {
    const result = await operations.call(operation, argument, stop.signal);
    self.postMessage({id, result}, operation === 'decode' ? buffersOf(result) : []);
  } catch (error) {
    const {code, message, needed} = failureOf(error, EXHAUSTED);
    self.postMessage({id, error: {code, message, needed}});
  } finally {
    running.delete(id);
  }
}

self.onmessage = ({data}) => {
  const {id, operation, argument} = data;
  if (operation === 'stop') running.get(id)?.abort();
  else if (operation !== 'start') answer(data);
  else {
    operations = new Operations(argument);
    self.postMessage({id});
  }
};
