// SPDX-License-Identifier: Apache-2.0
// Encodes away from the page's thread, once. The page hands over the compiled module.
import {EXHAUSTED, encodeWith} from './encoder.js';
import {failureOf} from './instance.js';

self.onmessage = ({data: {module, input}}) => {
  try {
    const stream = encodeWith(module, input, (done) => self.postMessage({done}));
    self.postMessage({stream}, [stream.buffer]);
  } catch (error) {
    const {code, message} = failureOf(error, EXHAUSTED);
    self.postMessage({error: {code, message}});
  }
};
