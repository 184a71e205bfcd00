// SPDX-License-Identifier: Apache-2.0
// The WebAssembly modules, compiled once for all terrains of a page.
import {TksError} from './error.js';

const compiled = new Map();

/** A function with a vector in it: engines without SIMD refuse it. */
const VECTOR_FUNCTION = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
  253, 98, 11,
]);
const hasVectors = () => WebAssembly.validate(VECTOR_FUNCTION);

/** While it comes, where the server says that it is a module. */
export async function compileAt(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: the server answered ${answer.status}`);
  return answer.headers.get('content-type') === 'application/wasm'
    ? WebAssembly.compileStreaming(answer)
    : WebAssembly.compile(await answer.arrayBuffer());
}

/** One of `assets`, or what the caller says: a URL, bytes, or a module. */
export async function compile(assets, wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm && typeof wasm !== 'string' && !(wasm instanceof URL)) return WebAssembly.compile(wasm);
  const load = hasVectors() ? assets.full : assets.plain, key = wasm ? String(wasm) : load;
  if (!compiled.has(key)) {
    const promise = (wasm ? compileAt(wasm) : load()).catch((error) => {
      compiled.delete(key);
      throw new TksError('io', `The WebAssembly module cannot be loaded (${error.message}). ` +
        'Bundlers may need {wasm: URL}.', {cause: error});
    });
    compiled.set(key, promise);
  }
  return compiled.get(key);
}
