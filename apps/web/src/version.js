// SPDX-License-Identifier: Apache-2.0
// Whether answers of a server are of one version of a file.

/** Proxies that compress on the way mark an ETag as weak (W/): the file is the same. */
const tagOf = (headers) => headers.get('etag')?.replace(/^W\//, '') ?? null;

/** Bytes of the whole file, or nothing where the answer does not tell. */
function sizeOf({status, headers}) {
  const range = /\/(\d+)$/.exec(headers.get('content-range') ?? '');
  if (range) return Number(range[1]);
  const isWhole = status === 200 && !headers.has('content-encoding');
  return isWhole && headers.has('content-length') ? Number(headers.get('content-length')) : null;
}

export class Version {
  #tag = null;
  #modified = null;
  #size = null;

  /** Whether this answer is of the version of those before, as far as both tell. */
  agrees(answer) {
    const {headers, status} = answer, size = sizeOf(answer);
    const [tag, modified] = status === 416 ? [null, null]  // of an error page
      : [tagOf(headers), headers.get('last-modified')];
    const differ = (known, stated) => known !== null && stated !== null && known !== stated;
    const isTagged = this.#tag !== null && tag !== null;
    const hasChanged = differ(this.#size, size) ||
      (isTagged ? this.#tag !== tag : differ(this.#modified, modified));
    this.#tag ??= tag;
    this.#modified ??= modified;
    this.#size ??= size;
    return !hasChanged;
  }
}
