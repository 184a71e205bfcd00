// SPDX-License-Identifier: Apache-2.0
// A thread of Node with the calls of a browser's Worker that this package makes.
import {Worker} from 'node:worker_threads';

export function nodeWorker(url) {
  // Options of the process, such as --input-type, need not hold for a file.
  const thread = new Worker(url, {execArgv: []});
  const worker = {
    postMessage: (message) => thread.postMessage(message),
    terminate: () => thread.terminate(),
  };
  thread.on('message', (data) => worker.onmessage({data}));
  thread.on('error', (error) => worker.onerror(error));
  return worker;
}
