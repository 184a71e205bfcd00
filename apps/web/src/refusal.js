// SPDX-License-Identifier: Apache-2.0
// What there is to say where fetch() fails, which tells nobody why.

export const BROKE = ': the connection broke.';
/** Of an answer that ended before it told what it is: codes of Node's errors. */
const BROKEN = ['UND_ERR_SOCKET', 'ECONNRESET', 'EPIPE'];
/** Whether fetch() failed so. Pages are not told; Node is. */
export const hasBroken = (error) => BROKEN.includes(error?.cause?.code);

function addressOf(text, page) {
  try {
    return new URL(text, page);
  } catch {
    return null;
  }
}

/** Why nothing comes from an address, as the end of a sentence that begins with it. */
export async function refusalOf(url, signal) {
  const page = globalThis.document?.baseURI ?? globalThis.location?.href;
  const address = addressOf(url, page);
  if (!address) {
    return ' is no address. Outside of a page give all of it, or the bytes of a file.';
  }
  if (address.protocol === 'file:') {
    return ' is a file, which cannot be fetched. Give its bytes or a Blob.';
  }
  const origin = page && new URL(page).origin;
  // Of a server that lets no page read its answers a page still sees that it answers.
  const answers = origin && address.origin !== origin &&
    (await fetch(url, {method: 'HEAD', mode: 'no-cors', signal}).catch(() => null));
  return answers
    ? ` cannot be read: its server answers, but does not allow pages of ${origin} to read what ` +
      'it sends (CORS). It has to send the header Access-Control-Allow-Origin.'
    : ' cannot be fetched: its server cannot be reached, or broke the connection.';
}
