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

/** The colours of RAMP in 256 steps, each as four bytes of RGBA. */
function rampTable() {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) table.set([...colourAt(i / 255), 255], 4 * i);
  return new Uint32Array(table.buffer);
}
const TABLE = rampTable();

/** What heights the colours reach from and to. It grows with what it colours, so that the frames of
 * a sequence have the same ones. */
class Range {
  least = Infinity;
  most = -Infinity;
  take(heights) {
    let {least, most} = this;
    for (const value of heights) {
      if (value < least) least = value;
      if (value > most) most = value;
    }
    [this.least, this.most] = [least, most];
  }
}

/** RGBA of a grid of heights. */
export function tint({width, height, data}, range = new Range()) {
  range.take(data);
  const {least, most} = range, scale = most > least ? 255 / (most - least) : 0;
  const rgba = new Uint32Array(width * height);
  for (let i = 0; i < rgba.length; ++i) {
    rgba[i] = TABLE[Math.round((data[i] - least) * scale) || 0];
  }
  return {width, height, data: new Uint8ClampedArray(rgba.buffer)};
}

const ranges = new WeakMap();  // of terrains with several frames

/** The same of a surface of a terrain, whose frames have the same colours. */
export function tinted(terrain, surface) {
  if (terrain.frames > 1 && !ranges.has(terrain)) ranges.set(terrain, new Range());
  return tint(surface, ranges.get(terrain));
}
