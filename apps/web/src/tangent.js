// SPDX-License-Identifier: Apache-2.0
// The plane that touches the sphere of longitudes and latitudes at a place, projected
// stereographically (docs/FORMAT.md, section 2, Ground positions): no pole and no date line breaks
// it, and most maps are nearly similar to it.

const RADIANS = Math.PI / 180;

export class TangentPlane {
  #longitude;
  #sine;
  #cosine;

  /** Touches at this longitude and latitude, in degrees. */
  constructor([longitude, latitude]) {
    this.#longitude = longitude;
    this.#sine = Math.sin(latitude * RADIANS);
    this.#cosine = Math.cos(latitude * RADIANS);
  }
  project(longitude, latitude) {
    const away = (longitude - this.#longitude) * RADIANS;
    const sine = Math.sin(latitude * RADIANS), cosine = Math.cos(latitude * RADIANS);
    const north = this.#cosine * sine - this.#sine * cosine * Math.cos(away);
    const up = this.#sine * sine + this.#cosine * cosine * Math.cos(away);
    return [(2 * cosine * Math.sin(away)) / (1 + up), (2 * north) / (1 + up)];
  }
  /** Longitudes within half a turn of where it touches, to go on behind 180. */
  unproject([x, y]) {
    const up = 1 - (x * x + y * y) / 4;
    const toPole = this.#sine * up + this.#cosine * y, toAxis = this.#cosine * up - this.#sine * y;
    return [
      this.#longitude + Math.atan2(x, toAxis) / RADIANS,
      Math.atan2(toPole, Math.hypot(x, toAxis)) / RADIANS,
    ];
  }
}

/** Newton's method squares the error: far fewer do on maps. */
const MOST_STEPS = 12;
/** Of columns and rows. */
const EXACT = 1e-4;

/**
 * The inverse of point(column, row) on a raster of this size, which is nearly affine, from points
 * to columns and rows. Points that it does not reach get some outside.
 */
export function inverseOf(point, width, height) {
  /** How a point changes with the column and with the row. */
  const slopes = (column, row, [x, y], step) => {
    const [xa, ya] = point(column + step, row), [xb, yb] = point(column, row + step);
    return [(xa - x) / step, (xb - x) / step, (ya - y) / step, (yb - y) / step];
  };
  /** The step in columns and rows that moves a point by (x, y). */
  const solve = ([a, b, c, d], x, y) => {
    const area = a * d - b * c;
    return [(d * x - b * y) / area, (a * y - c * x) / area];
  };
  const middle = [width / 2, height / 2], centre = point(...middle);
  const affine = slopes(...middle, centre, Math.max(width, height) / 8);
  const within = (value, side) => Math.min(Math.max(value, -side), 2 * side);
  return (x, y) => {
    const [across, down] = solve(affine, x - centre[0], y - centre[1]);
    const guess = [middle[0] + across, middle[1] + down];
    let column = within(guess[0], width), row = within(guess[1], height);
    for (let i = 0; i < MOST_STEPS; ++i) {
      const at = point(column, row);
      const [right, below] = solve(slopes(column, row, at, 1), x - at[0], y - at[1]);
      const next = [within(column + right, width), within(row + below, height)];
      const moved = Math.hypot(next[0] - column, next[1] - row);
      [column, row] = next;
      if (moved > EXACT) continue;
      // At the end of the reach a point farther off is only pushed there.
      return Math.hypot(right, below) > 1 ? guess : [column, row];
    }
    return guess.map((value, k) => (Math.abs(value) < Infinity ? value : -[width, height][k]));
  };
}
