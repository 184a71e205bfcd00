// SPDX-License-Identifier: Apache-2.0
// An Earth of 1080 x 540 heights, for tests: hills and deeps that go on behind the date line.

export const WIDTH = 1080, HEIGHT = 540;

/** {heights, texture}: as encode() takes them. */
export function earth() {
  const heights = new Int16Array(WIDTH * HEIGHT), texels = new Uint8Array(3 * WIDTH * HEIGHT);
  for (let i = 0; i < WIDTH * HEIGHT; ++i) {
    const longitude = (((i % WIDTH) + 0.5) / WIDTH - 0.5) * 2 * Math.PI;
    const latitude = (0.5 - (Math.floor(i / WIDTH) + 0.5) / HEIGHT) * Math.PI;
    const x = Math.cos(latitude) * Math.cos(longitude), z = Math.sin(latitude);
    const y = Math.cos(latitude) * Math.sin(longitude);
    const wave = (n) => Math.sin(n * x + 2 * Math.cos(n * y)) * Math.cos(n * z + y);
    heights[i] = 2500 * wave(2) + 1200 * wave(5) + 600 * wave(13) + 300 * wave(37);
    // Red is never the least: the sky behind has less of it than of blue.
    texels.set([190 + 60 * wave(5), 120 + 60 * wave(7), 60 + 40 * wave(3)], 3 * i);
  }
  const place = {crs: 'EPSG:4326', registration: 'area', domain: 'cylinder'};
  return {
    heights: {...place, data: heights, width: WIDTH, height: HEIGHT, unit: 'm',
      geotransform: [-180, 360 / WIDTH, 0, 90, 0, -180 / HEIGHT]},
    texture: {...place, data: texels, width: WIDTH, height: HEIGHT,
      geotransform: [-180, 360 / WIDTH, 0, 90, 0, -180 / HEIGHT]},
  };
}
