// SPDX-License-Identifier: Apache-2.0
// Bytes that come in pieces. A call that brings them is given `take`, which it awaits with each.

/** Smaller pieces are joined: each is a message to the worker. */
const LEAST_PIECE = 2 ** 14;

export function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let place = 0;
  for (const part of parts) {
    all.set(part, place);
    place += part.length;
  }
  return all;
}

/** All that `bring` brings. */
export async function gathered(bring) {
  const parts = [];
  await bring(async (part) => void parts.push(part));
  return joined(parts);
}

/** Gives `take` what `bring` brings, in pieces that are worth their while. */
export async function inLarger(take, bring) {
  let parts = [], length = 0;
  const pass = async () => {
    const piece = joined(parts);
    [parts, length] = [[], 0];
    await take(piece);
  };
  try {
    await bring(async (part) => {
      parts.push(part);
      length += part.length;
      if (length >= LEAST_PIECE) await pass();
    });
  } finally {
    if (length > 0) await pass();
  }
}
