// SPDX-License-Identifier: Apache-2.0
// Tells a server what the camera looks at, and the page what comes from it.

export class LiveEdge {
  #tell;
  #timeline;
  #terrain = null;

  /** `tell(error)` hears why no more comes. */
  constructor(timeline, tell) {
    [this.#timeline, this.#tell] = [timeline, tell];
  }
  /** Of a terrain that was opened, until another is: `signal` aborts then. */
  begin(terrain, signal) {
    this.#terrain = terrain.isLive ? terrain : null;
    if (this.#terrain) this.#run(signal);
  }
  async #run(signal) {
    const terrain = this.#terrain;
    try {
      for (let before = terrain.sourceFrames; ;) {
        await terrain.changed({signal});
        const {sourceFrames} = terrain;
        await this.#timeline.advance(sourceFrames > before);
        before = sourceFrames;
      }
    } catch (error) {
      if (signal.aborted || terrain !== this.#terrain) return;
      this.#timeline.end();
      this.#tell(error);
    }
  }
  /** What `object` looks like to a camera, of flat ground: its bytes come first. */
  look(object, {camera, pixels, hasSize}) {
    if (!this.#terrain || !hasSize || object.isGlobe || object.isObject) return;
    this.#terrain.want({view: object.viewOf(camera, pixels)});
  }
}
