// SPDX-License-Identifier: Apache-2.0
// Where this page finds its decoder and its encoders.

const beside = (name) => new URL(name, document.baseURI);
export const decoder = {wasm: beside('tetrakis.wasm'), worker: beside('worker.js')};
export const encoder = {wasm: beside('tetrakis-encode.wasm'), worker: beside('encode_worker.js')};
export const objectEncoder = {...encoder, wasm: beside('tetrakis-encode-object.wasm')};
