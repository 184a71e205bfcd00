// SPDX-License-Identifier: Apache-2.0
// Columns and rows of a raster at a grid of longitudes and latitudes. Projecting each place would
// take most of a tile's time: between some that are projected, rows of the grid are taken as
// straight where that is as good.

/** The longest piece, in places: the middle of a long one can lie on the line by chance. */
const PIECE = 64;

/** Indices [from, to) of the longitudes, which grow, between west and east. */
function indicesOf(longitudes, west, east) {
  const from = longitudes.findIndex((longitude) => longitude >= west);
  const to = longitudes.findLastIndex((longitude) => longitude <= east) + 1;
  return from < 0 ? [0, 0] : [from, to];
}

export class Scan {
  #pixels;
  #longitudes;
  #tolerance;
  #put;
  #latitude = 0;
  #first = 0;

  /** `pixels(longitude, latitude)`: as of placeOf(). `tolerance`: of its columns and rows.
   * put(i, column, row) hears of place i of the grid. */
  constructor(pixels, longitudes, tolerance, put) {
    this.#pixels = pixels;
    this.#longitudes = longitudes;
    this.#tolerance = tolerance;
    this.#put = put;
  }

  /** The part between west and east of the grid's row at a latitude; `first`: its first place. */
  row(latitude, first, west, east) {
    const [from, to] = indicesOf(this.#longitudes, west, east);
    if (from >= to) return;
    this.#latitude = latitude;
    this.#first = first;
    let begin = from, start = this.#at(from);
    while (begin < to - 1) {
      const end = Math.min(begin + PIECE, to - 1), stop = this.#at(end);
      this.#between(begin, end, start, stop);
      [begin, start] = [end, stop];
    }
    this.#put(this.#first + begin, start[0], start[1]);
  }
  #at(i) {
    return this.#pixels(this.#longitudes[i], this.#latitude);
  }
  /** Places [a, b), of which `start` and `stop` are projected. */
  #between(a, b, start, stop) {
    const middle = (a + b) >> 1, share = (middle - a) / (b - a);
    const at = middle > a ? this.#at(middle) : start;
    const off = (k) => Math.abs(start[k] + share * (stop[k] - start[k]) - at[k]);
    if (middle > a && !(off(0) <= this.#tolerance && off(1) <= this.#tolerance)) {
      this.#between(a, middle, start, at);
      return this.#between(middle, b, at, stop);
    }
    this.#put(this.#first + a, start[0], start[1]);
    const across = (stop[0] - start[0]) / (b - a), down = (stop[1] - start[1]) / (b - a);
    for (let i = a + 1; i < b; ++i) {
      this.#put(this.#first + i, start[0] + (i - a) * across, start[1] + (i - a) * down);
    }
  }
}
