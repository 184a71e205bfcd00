// SPDX-License-Identifier: Apache-2.0
// Encodes away from the page's thread, once. The page hands over the compiled module.
import {encodeWith} from './encoder.js';

self.onmessage = ({data: {module, input}}) => {
  try {
    const stream = encodeWith(module, input, (done) => self.postMessage({done}));
    self.postMessage({stream}, [stream.buffer]);
  } catch ({code, message}) {
    self.postMessage({error: {code: code ?? 'memory', message}});
  }
};
