// SPDX-License-Identifier: Apache-2.0
// The WebAssembly modules, compiled once for all terrains of a page.
import {TksError} from './error.js';
import {builtIn} from './node.js';

const compiled = new Map();

/** A function with a vector in it: engines without SIMD refuse it. */
const VECTOR_FUNCTION = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
  253, 98, 11,
]);
const hasVectors = () => WebAssembly.validate(VECTOR_FUNCTION);

/** While it comes, where the server says that it is a module. Node fetches no files. */
export async function compileAt(url) {
  const files = String(url).startsWith('file:') && builtIn('node:fs');
  if (files) return WebAssembly.compile(await files.promises.readFile(new URL(url)));
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: the server answered ${answer.status}`);
  return answer.headers.get('content-type') === 'application/wasm'
    ? WebAssembly.compileStreaming(answer)
    : WebAssembly.compile(await answer.arrayBuffer());
}

function unloadable(error) {
  return new TksError('io', `The WebAssembly module cannot be loaded (${error.message}). Copy ` +
    'tetrakis/tetrakis.wasm (of encode() tetrakis/tetrakis-encode.wasm, of encodeObject() ' +
    'tetrakis/tetrakis-encode-object.wasm) to the page and give its address: {wasm: URL}.',
  {cause: error});
}

/** The bytes of a text in base64, compressed by gzip. */
function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

/** Its own file, or where a bundler has left that behind, what is packed in a script. */
async function compileOwn(assets) {
  const load = hasVectors() ? assets.full : assets.plain;
  try {
    return await load();
  } catch (error) {
    if (!hasVectors()) throw error;
    const {module} = await assets.packed();
    return WebAssembly.compile(await unpacked(module));
  }
}

function compileOnce(assets, url) {
  const key = url ? String(url) : assets;
  if (!compiled.has(key)) {
    const promise = (url ? compileAt(url) : compileOwn(assets)).catch((error) => {
      compiled.delete(key);
      throw error;
    });
    compiled.set(key, promise);
  }
  return compiled.get(key);
}

async function compileAny(assets, wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  const isAddress = !wasm || typeof wasm === 'string' || wasm instanceof URL;
  return isAddress ? compileOnce(assets, wasm) : WebAssembly.compile(wasm);
}

/** One of `assets`, or what the caller says: a URL, bytes, or a module. It has to have `call`. */
export async function compile(assets, wasm, call) {
  const module = await compileAny(assets, wasm).catch((error) => {
    throw unloadable(error);
  });
  if (WebAssembly.Module.exports(module).some(({name}) => name === call)) return module;
  throw new TksError('usage', `The WebAssembly module has no ${call}(): it is another one than ` +
    'this version of the package needs here.');
}
