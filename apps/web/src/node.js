// SPDX-License-Identifier: Apache-2.0
// What Node has in another way than browsers do: files and threads. No module of Node is imported,
// because neither bundlers nor browsers would find it.

/** A module that Node has built in; nothing elsewhere. */
export const builtIn = (name) => globalThis.process?.getBuiltinModule?.(name);

/** A thread of Node with the calls of a browser's Worker that this package makes. */
export function nodeWorker(name, base) {
  const {Worker} = builtIn('node:worker_threads');
  // Options of the process, such as --input-type, need not hold for a file.
  const thread = new Worker(new URL(name, base), {execArgv: []});
  const worker = {
    postMessage: (message) => thread.postMessage(message),
    terminate: () => thread.terminate(),
  };
  thread.on('message', (data) => worker.onmessage({data}));
  thread.on('error', (error) => worker.onerror(error));
  return worker;
}
