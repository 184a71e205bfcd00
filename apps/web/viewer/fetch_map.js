// SPDX-License-Identifier: Apache-2.0
// What was fetched: the file as a bar, filled where its bytes are here, and of streams in regions
// the ground, the brighter the more of what it takes is here.
import {straightAxes} from '../src/axes.js';

const LONG_SIDE = 12;  // cells of the ground
/** Of the map of the ground, in pixels: that of a long strip is drawn wider than it is. */
const LONGEST = 64, NARROWEST = 16;

/** How many bytes of `ranges` are in `held`. */
function overlap(ranges, held) {
  let sum = 0;
  for (const [b, e] of ranges) {
    for (const [b2, e2] of held) sum += Math.max(0, Math.min(e, e2) - Math.max(b, b2));
  }
  return sum;
}
const lengthOf = (ranges) => ranges.reduce((sum, [b, e]) => sum + e - b, 0);

export class FetchMap {
  #bar;
  #ground;
  #terrain = null;
  #cells = [];

  constructor(bar, ground) {
    this.#bar = bar;
    this.#ground = ground;
  }

  async show(terrain) {
    this.#terrain = terrain;
    this.#cells = [];
    const {info} = terrain, part = info.hasTexture ? 'texture' : 'heights';
    const side = info.hasTexture ? info.textureRegions : info.regions;
    this.#ground.hidden = !info.hasIndex || !side;
    if (this.#ground.hidden) return;
    const width = info.hasTexture ? info.textureWidth : info.width;
    const height = info.hasTexture ? info.textureHeight : info.height;
    const cell = Math.max(width, height) / LONG_SIDE;
    const columns = Math.max(1, Math.round(width / cell));
    const rows = Math.max(1, Math.round(height / cell));
    const {along, down} = straightAxes(info);
    this.#ground.style.transform = `scale(${along[0]}, ${down[1]})`;  // north is above
    this.#ground.width = columns;
    this.#ground.height = rows;
    const most = Math.max(columns, rows);
    const pixels = (count) => `${Math.max(NARROWEST, (LONGEST * count) / most)}px`;
    [this.#ground.style.width, this.#ground.style.height] = [pixels(columns), pixels(rows)];
    try {
      for (let i = 0; i < columns * rows; ++i) {
        const x = Math.floor(((i % columns) * width) / columns);
        const y = Math.floor((Math.floor(i / columns) * height) / rows);
        const window = {x, y, width: Math.max(1, Math.floor(width / columns)),
          height: Math.max(1, Math.floor(height / rows))};
        const ranges = await terrain.needed({part, window});
        if (terrain !== this.#terrain) return;
        this.#cells.push(ranges);
      }
      this.draw();
    } catch {
      this.#ground.hidden = true;  // closed meanwhile, or too large to tell
    }
  }

  draw() {
    const {loaded, info} = this.#terrain;
    const bar = this.#bar, context = bar.getContext('2d');
    context.clearRect(0, 0, bar.width, bar.height);
    context.fillStyle = getComputedStyle(bar).color;
    for (const [b, e] of loaded.ranges) {
      const x = (b / info.streamBytes) * bar.width;
      context.fillRect(x, 0, Math.max(1, (e / info.streamBytes) * bar.width - x), bar.height);
    }
    const ground = this.#ground.getContext('2d');
    this.#cells.forEach((ranges, i) => {
      const all = lengthOf(ranges), share = all ? overlap(ranges, loaded.ranges) / all : 1;
      ground.fillStyle = `hsl(128 30% ${8 + 50 * share}%)`;
      ground.fillRect(i % this.#ground.width, Math.floor(i / this.#ground.width), 1, 1);
    });
    this.#bar.dataset.bytes = loaded.bytes;
  }
}
