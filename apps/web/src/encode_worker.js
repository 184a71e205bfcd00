// SPDX-License-Identifier: Apache-2.0
// Encodes away from the page's thread, once. The page hands over the compiled module.
import {EXHAUSTED, encodeWith} from './encoder.js';
import {failureOf} from './instance.js';
import {builtIn} from './node.js';

/** The other end of this thread, which in Node has no `self`. */
const port = builtIn('node:worker_threads')?.parentPort ?? self;

port.onmessage = ({data: {module, input}}) => {
  try {
    const stream = encodeWith(module, input, (done) => port.postMessage({done}));
    port.postMessage({stream}, [stream.buffer]);
  } catch (error) {
    const {code, message} = failureOf(error, EXHAUSTED);
    port.postMessage({error: {code, message}});
  }
};
