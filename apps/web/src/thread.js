// SPDX-License-Identifier: Apache-2.0
// The worker that a decoder or an encoder works in, as callers say it.
import {TksError} from './error.js';
import {OwnWorker} from './own_worker.js';

/** Workers that callers gave: each answers one decoder, which ends it. */
const taken = new WeakSet();

function workerAt(url) {
  try {
    return new Worker(url, {type: 'module'});
  } catch (error) {
    throw new TksError('io', `The worker ${url} cannot be started (${error.message}). Its ` +
      'address has to be of the origin of the page.', {cause: error});
  }
}

/** Tells `hear`, by a TksError, that a worker failed or did not start. */
export function onFailure(worker, hear) {
  worker.onerror = (event) => {
    event.preventDefault?.();
    const reason = event.message ?? 'it did not start';
    hear(new TksError('io', `The worker failed: ${reason}. Where it cannot start, copy ` +
      'tetrakis/worker (of encode() tetrakis/encode_worker), bundled, to the page and give its ' +
      'address, {worker: URL}, or work on this thread, {worker: false}.'));
  };
}

/** The worker of `assets`; nothing in Node, where there is none. */
function ownWorker(assets) {
  let worker = null;
  try {
    worker = assets.worker();
    if (typeof Worker === 'undefined') return worker;
  } catch {
    // Pages may not start workers of another origin.
  }
  return new OwnWorker(worker, assets);
}

/** `worker`: as OpenOptions has it. Nothing: the work stays on this thread. */
export function threadOf(worker, assets) {
  if (worker === false) return null;
  if (typeof worker === 'string' || worker instanceof URL) return workerAt(worker);
  if (worker === undefined || worker === true) return ownWorker(assets);
  if (taken.has(worker)) {
    throw new TksError('usage', 'This Worker serves another terrain, or did so: give each a ' +
      'Worker of its own, or the address of one.');
  }
  taken.add(worker);
  return worker;
}
