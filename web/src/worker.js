// SPDX-License-Identifier: Apache-2.0
// Decodes away from the page's thread. The page hands over the compiled module with the first
// message, so that this file loads nothing.
import {Decoder, buffersOf} from './module.js';

let decoder;

const operations = {
  start: ({module, memory}) => {
    decoder = new Decoder(module, memory);
  },
  put: ({place, chunk}) => decoder.put(place, chunk),
  decode: ({request}) => decoder.decode(request),
  plan: ({request}) => decoder.plan(request),
  needed: ({request}) => decoder.needed(request),
};

self.onmessage = ({data}) => {
  try {
    const result = operations[data.operation](data);
    self.postMessage({id: data.id, result}, data.operation === 'decode' ? buffersOf(result) : []);
  } catch (error) {
    const {code, message, needed} = error;
    self.postMessage({id: data.id, error: {code: code ?? 'memory', message, needed}});
  }
};
