// SPDX-License-Identifier: Apache-2.0
// What a stream was made of, where the page's address says so: ?tks=URL&original=URL, once for
// heights and once for an image over them.
import {nameOf} from './address.js';
import {inputOf} from './coding.js';

async function fetched(address) {
  const name = nameOf(address);
  const answer = await fetch(address).catch((error) => {
    throw new Error(`The original ${name} cannot be fetched (${error.message}).`, {cause: error});
  });
  if (!answer.ok) throw new Error(`The original ${name} cannot be fetched (${answer.status}).`);
  return new File([await answer.blob()], name);
}

const sizeOf = (part) => (part ? `${part.width} × ${part.height}` : 'no');

/** A stream has as many heights and texels as what it was made of. */
function check({heights, texture}, info) {
  const own = {
    heights: info.hasHeights && {width: info.width, height: info.height},
    texels: info.hasTexture && {width: info.textureWidth, height: info.textureHeight},
  };
  for (const [name, part] of Object.entries({heights, texels: texture})) {
    if (sizeOf(part) === sizeOf(own[name])) continue;
    throw new Error(`The original has ${sizeOf(part)} ${name}, and the stream has ` +
      `${sizeOf(own[name])} ${name}.`);
  }
}

/** {heights, texture} as encode() takes them; null where the address names no original. */
export async function originalInLink(info) {
  const addresses = new URLSearchParams(location.search).getAll('original');
  if (addresses.length === 0) return null;
  const original = await inputOf(await Promise.all(addresses.map(fetched)));
  check(original, info);
  return original;
}
