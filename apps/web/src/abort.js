// SPDX-License-Identifier: Apache-2.0
// Promises that an AbortSignal ends.

/** The promise, or the signal's reason once it aborts, of which `stopped` then hears. */
export function abortable(promise, signal, stopped = () => {}) {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const stop = () => {
      reject(signal.reason);
      stopped();
    };
    // First of all the promise has a handler: one that fails without ends a Node process.
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', stop));
    if (signal.aborted) stop();
    else signal.addEventListener('abort', stop, {once: true});
  });
}

const followers = new WeakMap();  // of a signal: AbortControllers

/** `stop` aborts when the signal does, until the function is called that this gives. */
function follow(signal, stop) {
  let all = followers.get(signal);
  if (!all) {
    followers.set(signal, (all = new Set()));
    const abort = () => all.forEach((each) => each.abort(signal.reason));
    signal.addEventListener('abort', abort, {once: true});
  }
  all.add(stop);
  return () => all.delete(stop);
}

/** What `use` resolves to. Until then `stop` aborts when the signal does. */
export async function stoppedBy(signal, stop, use) {
  signal?.throwIfAborted();
  const leave = signal && follow(signal, stop);
  try {
    return await use();
  } finally {
    leave?.();
  }
}
