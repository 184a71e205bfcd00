// SPDX-License-Identifier: Apache-2.0
// A terrain made of waves and roughness, for tests that need more than the conformance vectors.

/** {heights, texture} of `side` x `side` samples. */
export function terrainOf(side) {
  const heights = new Int16Array(side * side), texels = new Uint8Array(3 * side * side);
  for (let i = 0; i < side * side; ++i) {
    const x = (i % side) / side, y = Math.floor(i / side) / side;
    const wave = (n) => Math.sin(n * x + 3 * Math.cos(n * y)) / n;
    const rough = (Math.imul(i + 1, 0x9e3779b1) >>> 24) / 8;
    heights[i] = 900 * wave(5) + 900 * wave(17) + 400 * wave(61) + rough;
    texels.set(
      [110 + 600 * wave(43) + rough, 110 + 900 * wave(29) + rough, 128 + 500 * wave(7)], 3 * i);
  }
  return {
    heights: {data: heights, width: side, height: side, spacing: 30, unit: 'm', crs: 'EPSG:32611',
      geotransform: [5e5, 30, 0, 4e6, 0, -30], registration: 'area'},
    texture: {data: texels, width: side, height: side},
  };
}

/** Bytes of a value of TIFF's types ASCII, SHORT and DOUBLE. */
const SIZES = {2: 1, 3: 2, 12: 8};

/** A TIFF of one strip of samples (int16), little-endian. `tags`: [number, type, count, value]
 * more, or instead. */
export function tiffOf({data, width, height}, tags = []) {
  const all = [...new Map([[256, 4, 1, width], [257, 4, 1, height], [258, 3, 1, 16], [259, 3, 1, 1],
    [262, 3, 1, 1], [273, 4, 1, 8], [277, 3, 1, 1], [278, 4, 1, height],
    [279, 4, 1, 2 * data.length], [339, 3, 1, 2],
    ...tags].map((tag) => [tag[0], tag])).values()].sort((a, b) => a[0] - b[0]);
  const directory = 8 + 2 * data.length;
  const behind = directory + 2 + 12 * all.length + 4;
  const file = new DataView(new ArrayBuffer(behind + 1024));
  [0x4949, 42].forEach((word, i) => file.setUint16(2 * i, word, true));
  file.setUint32(4, directory, true);
  data.forEach((v, i) => file.setInt16(8 + 2 * i, v, true));
  file.setUint16(directory, all.length, true);
  let place = behind;
  all.forEach(([number, type, count, value], i) => {
    const entry = directory + 2 + 12 * i;
    file.setUint16(entry, number, true);
    file.setUint16(entry + 2, type, true);
    file.setUint32(entry + 4, count, true);
    if (!Array.isArray(value)) return file.setUint32(entry + 8, value, true);
    const inEntry = count * SIZES[type] <= 4;
    let at = inEntry ? entry + 8 : place;
    if (!inEntry) file.setUint32(entry + 8, place, true);
    for (const v of value) {
      if (type === 12) file.setFloat64(at, v, true);
      else if (type === 2) file.setUint8(at, v);
      else file.setUint16(at, v, true);
      at += SIZES[type];
    }
    if (!inEntry) place = at;
  });
  return new Uint8Array(file.buffer);
}
