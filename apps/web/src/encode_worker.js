// SPDX-License-Identifier: Apache-2.0
// Encodes away from the page's thread, once. The page hands over the compiled module.
import {EXHAUSTED} from './encoder_call.js';
import {encodeWith} from './encoder.js';
import {failureOf} from './instance.js';
import {builtIn} from './node.js';
import {encodeObjectWith} from './object_encoder.js';

/** The other end of this thread, which in Node has no `self`. */
const port = builtIn('node:worker_threads')?.parentPort ?? self;

/** By the call of the module. */
const ENCODERS = {web_encode: encodeWith, web_encode_object: encodeObjectWith};

port.onmessage = ({data: {module, call, input}}) => {
  try {
    const encoded = ENCODERS[call](module, input, (done) => port.postMessage({done}));
    port.postMessage({encoded}, [(encoded.stream ?? encoded).buffer]);
  } catch (error) {
    const {code, message} = failureOf(error, EXHAUSTED);
    port.postMessage({error: {code, message}});
  }
};
