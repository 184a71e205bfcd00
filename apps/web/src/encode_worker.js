// SPDX-License-Identifier: Apache-2.0
// Encodes away from the page's thread. The page hands over the compiled module with what it asks.
import {EXHAUSTED} from './encoder_call.js';
import {CALLS} from './encoder_calls.js';
import {failureOf} from './instance.js';
import {builtIn} from './node.js';

/** The other end of this thread, which in Node has no `self`. */
const port = builtIn('node:worker_threads')?.parentPort ?? self;

port.onmessage = ({data: {module, call, input}}) => {
  try {
    const made = CALLS[call](module, input, (done) => port.postMessage({done}));
    port.postMessage({made}, [(made.stream ?? made).buffer]);
  } catch (error) {
    const {code, message} = failureOf(error, EXHAUSTED);
    port.postMessage({error: {code, message}});
  }
};
