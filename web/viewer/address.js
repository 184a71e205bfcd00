// SPDX-License-Identifier: Apache-2.0
// What addresses say: of the page, where to look from; of a stream, how it is called.

/** Three numbers of the page's address under a name; null: there are none. */
export function place(name) {
  const numbers = (new URLSearchParams(location.search).get(name) ?? '').split(',').map(Number);
  return numbers.length === 3 && numbers.every(isFinite) ? numbers : null;
}

/** The last part of an address. */
export function nameOf(address) {
  const [path] = String(address).split(/[?#]/), name = path.split('/').pop();
  try {
    return decodeURIComponent(name);
  } catch {
    return name;  // with a stray %
  }
}
