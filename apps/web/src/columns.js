// SPDX-License-Identifier: Apache-2.0
// Between which columns of a raster a place lies. Of rasters that go round the Earth the last
// column lies beside the first one, at the date line or wherever they meet.

export class Columns {
  #count;
  #period;
  /** Two columns, and how far from the left to the right one the place lies. */
  left = 0;
  right = 0;
  share = 0;

  /** `period`: in how many columns, of which there are `count`, a raster goes round; at coarse mip
   * levels that need be no whole number. 0: it does not. */
  constructor(count, period) {
    this.#count = count;
    this.#period = period;
  }

  /** Of a place, where 0 is the first column. */
  find(place) {
    const last = this.#count - 1, period = this.#period;
    const x = period > 0 ? place - period * Math.floor(place / period)
      : Math.min(Math.max(place, 0), last);
    this.left = Math.min(Math.floor(x), last);
    if (this.left < last) {
      this.right = this.left + 1;
      this.share = x - this.left;
    } else {
      this.right = period > 0 ? 0 : last;
      this.share = period > 0 ? (x - last) / (period - last) : 0;
    }
  }
}
