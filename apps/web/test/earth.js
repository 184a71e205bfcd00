// SPDX-License-Identifier: Apache-2.0
// An Earth of 1080 x 540 heights, and the same on a cube, for tests: hills and deeps that go on
// behind the date line.

export const WIDTH = 1080, HEIGHT = 540;

/** The height in metres and the colour at a point of the unit sphere, whose z is north. */
function groundAt(x, y, z) {
  const wave = (n) => Math.sin(n * x + 2 * Math.cos(n * y)) * Math.cos(n * z + y);
  return {
    height: 2500 * wave(2) + 1200 * wave(5) + 600 * wave(13) + 300 * wave(37),
    // Red is never the least: the sky behind has less of it than of blue.
    colour: [190 + 60 * wave(5), 120 + 60 * wave(7), 60 + 40 * wave(3)],
  };
}

export const colourAt = (point) => groundAt(...point).colour.map(Math.floor);

/** A raster of heights and one of colours: point(i) is that of sample i. */
function rastersOf(width, height, point) {
  const heights = new Int16Array(width * height), texels = new Uint8Array(3 * width * height);
  for (let i = 0; i < width * height; ++i) {
    const {height: tall, colour} = groundAt(...point(i));
    heights[i] = tall;
    texels.set(colour, 3 * i);
  }
  return {heights, texels};
}

/** {heights, texture}: as encode() takes them. */
export function earth() {
  const {heights, texels} = rastersOf(WIDTH, HEIGHT, (i) => {
    const longitude = (((i % WIDTH) + 0.5) / WIDTH - 0.5) * 2 * Math.PI;
    const latitude = (0.5 - (Math.floor(i / WIDTH) + 0.5) / HEIGHT) * Math.PI;
    return [Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude),
      Math.sin(latitude)];
  });
  const place = {crs: 'EPSG:4326', registration: 'area', domain: 'cylinder', width: WIDTH,
    height: HEIGHT, geotransform: [-180, 360 / WIDTH, 0, 90, 0, -180 / HEIGHT]};
  return {heights: {...place, data: heights, unit: 'm'}, texture: {...place, data: texels}};
}

/** The same, rough up to its last detail. */
export function roughEarth() {
  const {heights, texture} = earth();
  let state = 1;
  const noise = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32 - 0.5;
  };
  texture.data.forEach((value, i, all) => (all[i] = Math.min(value + 30 + 60 * noise(), 255)));
  heights.data.forEach((value, i, all) => (all[i] = value + 300 * noise()));
  return {heights, texture};
}

/** Of a sample of a patch, `a` to the east and `b` to the north of its middle, from -1 to 1. */
function pointOnCube(patch, a, b) {
  const [x, y, z] = [
    [1, a, b], [-a, 1, b], [-1, -a, b], [a, -1, b], [-b, a, 1], [b, a, -1],
  ][patch];
  // Patches share samples, which are equal only where their points are.
  return [x, y, z].map((part) => Math.round((1e9 * part) / Math.hypot(1, a, b)) / 1e9);
}

/** The point of the unit sphere at a sample of a cube's raster: columns are at equal angles. */
export function pointOfSample(column, row, side) {
  const away = (place) => (place === 0 ? -1 : place === side - 1 ? 1
    : Math.tan((Math.PI / 2) * (place / (side - 1) - 0.5)));
  return pointOnCube(Math.floor(row / side), away(column), -away(row % side));
}

function rastersOnCube(depth) {
  const side = 2 ** depth + 1;
  const rasters =
    rastersOf(side, 6 * side, (i) => pointOfSample(i % side, Math.floor(i / side), side));
  return {...rasters, size: {width: side, height: 6 * side, domain: 'cube'}};
}

/** The same of a cube: patches of 2^depth squares a side of heights, twice as many of texels. */
export function earthOnCube(depth = 7) {
  const {heights, size} = rastersOnCube(depth), texture = rastersOnCube(depth + 1);
  return {
    heights: {...size, data: heights, unit: 'm', crs: 'EPSG:4326'},
    texture: {...texture.size, data: texture.texels},
  };
}
