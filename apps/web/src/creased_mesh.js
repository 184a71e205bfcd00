// SPDX-License-Identifier: Apache-2.0
// Normals of triangles that are coded as they are, such as those of designed parts: smooth where
// they meet at a small angle, as facets of a round surface do, and of either side at a sharp edge.
// Vertices at such an edge come once for each side.
import {areasOf, firstAtPosition, meansOf} from './joined_normals.js';

/** Of the angle up to which triangles belong to one smooth surface: 40 degrees. */
const LEAST_COSINE = Math.cos((40 * Math.PI) / 180);

/** Side s of a mesh runs from corner s to the next one of its triangle. */
const next = (corner) => (corner % 3 === 2 ? corner - 2 : corner + 1);

/** For each side one that runs back between the same points; -1: there is none. */
function oppositesOf(points) {
  const last = 2 ** Math.ceil(Math.log2(2 * points.length + 2)) - 1;
  const table = new Int32Array(last + 1).fill(-1);
  const slotOf = (from, to) => {
    const hash = Math.imul(Math.imul(from, 0x9e3779b1) ^ to, 0x85ebca6b);
    let slot = (hash ^ (hash >>> 15)) & last;
    for (; table[slot] >= 0; slot = (slot + 1) & last) {
      const side = table[slot];
      if (points[side] === from && points[next(side)] === to) break;
    }
    return slot;
  };
  points.forEach((point, side) => (table[slotOf(point, points[next(side)])] = side));
  return Int32Array.from(points, (point, side) => table[slotOf(points[next(side)], point)]);
}

/** Groups of corners at one point: for each corner the number of its group, and how many there are.
 * isJoined tells it of two corners of triangles that lie side by side. */
function groupsOf(opposites, isJoined) {
  const parents = opposites.map((_, corner) => corner);
  const rootOf = (corner) => {
    while (parents[corner] !== corner) corner = parents[corner] = parents[parents[corner]];
    return corner;
  };
  const join = (a, b) => {
    if (isJoined(a, b)) parents[rootOf(a)] = rootOf(b);
  };
  opposites.forEach((opposite, side) => {
    if (opposite < 0) return;
    join(side, next(opposite));
    join(next(side), opposite);
  });
  const numbers = new Int32Array(parents.length).fill(-1);
  let count = 0;
  const groups = parents.map((_, corner) => {
    const root = rootOf(corner);
    return numbers[root] < 0 ? (numbers[root] = count++) : numbers[root];
  });
  return {groups, count};
}

/** Tells of two corners whether their triangles are of one smooth surface. */
function smoothness(areas) {
  const dot = (a, b) =>
    areas[a] * areas[b] + areas[a + 1] * areas[b + 1] + areas[a + 2] * areas[b + 2];
  return (a, b) => {
    const s = a - (a % 3), t = b - (b % 3);
    return dot(s, t) > LEAST_COSINE * Math.sqrt(dot(s, s) * dot(t, t));
  };
}

/** The same triangles, {positions, texcoords, triangles, normals}; texcoords: null if there are
 * none. */
export function creased(mesh) {
  const {positions, texcoords, triangles} = mesh, areas = areasOf(mesh);
  const first = firstAtPosition(positions), opposites = oppositesOf(triangles.map((v) => first[v]));
  const isSmooth = smoothness(areas), surfaces = groupsOf(opposites, isSmooth);
  const {groups, count} =
    groupsOf(opposites, (a, b) => triangles[a] === triangles[b] && isSmooth(a, b));
  const corners = new Uint32Array(count);
  groups.forEach((group, corner) => (corners[group] = corner));
  const gathered = (values, width, indices) => {
    const parts = new values.constructor(width * count);
    corners.forEach((corner, vertex) => {
      const from = width * indices[corner];
      for (let i = 0; i < width; ++i) parts[width * vertex + i] = values[from + i];
    });
    return parts;
  };
  return {
    positions: gathered(positions, 3, triangles),
    texcoords: texcoords && gathered(texcoords, 2, triangles),
    triangles: Uint32Array.from(groups),
    normals: gathered(meansOf(areas, surfaces.groups, surfaces.count), 3, surfaces.groups),
  };
}
