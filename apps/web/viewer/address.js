// SPDX-License-Identifier: Apache-2.0
// How a stream is called, by its address.

/** The last part of an address. */
export function nameOf(address) {
  const [path] = String(address).split(/[?#]/), name = path.split('/').pop();
  try {
    return decodeURIComponent(name);
  } catch {
    return name;  // with a stray %
  }
}
