// SPDX-License-Identifier: Apache-2.0
// Colours by height, for terrains without a texture: RGBA of a grid of heights.

// Share of the range, and red, green, blue: meadow, hay, rock, snow.
const RAMP = [
  [0, 92, 128, 84], [0.25, 141, 158, 98], [0.5, 190, 172, 126], [0.75, 158, 140, 124],
  [1, 246, 246, 248],
];

function colourAt(share) {
  let i = 1;
  while (i < RAMP.length - 1 && share > RAMP[i][0]) ++i;
  const low = RAMP[i - 1], high = RAMP[i];
  const t = Math.min(1, Math.max(0, (share - low[0]) / (high[0] - low[0])));
  return [1, 2, 3].map((channel) => low[channel] + t * (high[channel] - low[channel]));
}

/** Heights of objects are told by their shape. */
export const hasTint = ({hasTexture, isObject}) => !hasTexture && !isObject;

export function tint({width, height, data}) {
  let least = Infinity, most = -Infinity;
  for (const value of data) {
    if (value < least) least = value;
    if (value > most) most = value;
  }
  const table = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) table.set(colourAt(i / 255), 3 * i);
  const rgba = new Uint8ClampedArray(4 * width * height);
  const scale = most > least ? 255 / (most - least) : 0;
  data.forEach((value, i) => {
    const entry = 3 * Math.round((value - least) * scale || 0);
    rgba.set(table.subarray(entry, entry + 3), 4 * i);
    rgba[4 * i + 3] = 255;
  });
  return {width, height, data: rgba};
}
