// SPDX-License-Identifier: Apache-2.0
// Fills the voids of a raster of heights with those of the nearest samples, so that no ground falls
// to 0 beside them.

/** The cells that a pass has left behind it, and how far they lie. */
const BEFORE = [[-1, 0, 1], [0, -1, 1], [-1, -1, Math.SQRT2], [1, -1, Math.SQRT2]];

/**
 * A raster {data, width, height} without NaN, unless all are. Distances are those of steps to the
 * eight neighbours (Borgefors, Distance transformations in digital images, 1986).
 */
export function filled(raster) {
  const {width, height} = raster, data = raster.data.slice();
  if (!data.some(Number.isNaN)) return raster;
  const far = Float32Array.from(data, (v) => (Number.isNaN(v) ? Infinity : 0));
  const visit = (x, y, sign) => {
    const i = y * width + x;
    if (far[i] === 0) return;
    for (const [dx, dy, step] of BEFORE) {
      const left = x + sign * dx, above = y + sign * dy, j = above * width + left;
      if (left < 0 || left >= width || above < 0 || above >= height) continue;
      if (far[j] + step < far[i]) [far[i], data[i]] = [far[j] + step, data[j]];
    }
  };
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) visit(x, y, 1);
  for (let y = height - 1; y >= 0; --y) for (let x = width - 1; x >= 0; --x) visit(x, y, -1);
  return {...raster, data};
}
