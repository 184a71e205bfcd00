// SPDX-License-Identifier: Apache-2.0
// The ellipsoid that a CRS lies on: the Earth's, or that of another body.

/** WGS 84, metres. */
export const EARTH = {semiMajor: 6378137, semiMinor: 6356752.314245};

/** Bodies whose CRS may be named without its axes, as the IAU gave these in 2000 and 2015. */
const NAMED = [
  [/^IAU(_\d+)?:301|^ESRI:104903\b|(^|[^a-z])Moon([^a-z]|$)/i,
    {semiMajor: 1737400, semiMinor: 1737400}],
  [/^IAU(_\d+)?:499|^ESRI:104905\b|(^|[^a-z])Mars([^a-z]|$)/i,
    {semiMajor: 3396190, semiMinor: 3376200}],
];
/** Of WKT of either kind: a name, the long axis, and the inverse of the flattening. */
const WKT = /(?:ELLIPSOID|SPHEROID)\["[^"]*",\s*([\d.e+]+),\s*([\d.e+]+)/i;

/** The keys of a GeoTIFF, as a stream holds them (docs/FORMAT.md, section 2). */
export function keysOf(text) {
  const pairs = text.matchAll(/(\d+)=("(?:[^"]|"")*"|[^ ]*)/g);
  return Object.fromEntries(Array.from(pairs, ([, id, value]) => [id, value]));
}

/** An inverse flattening of 0 is that of a sphere. */
const flattened = (semiMajor, inverse) =>
  ({semiMajor, semiMinor: semiMajor * (1 - (inverse > 0 ? 1 / inverse : 0))});

/** Axes that keys state; null: none. */
function statedAxes(text) {
  const {2057: major, 2058: minor, 2059: inverse} = keysOf(text), semiMajor = Number(major);
  if (!(semiMajor > 0)) return null;
  if (Number(inverse) > 0) return flattened(semiMajor, Number(inverse));
  return {semiMajor, semiMinor: Number(minor) > 0 ? Number(minor) : semiMajor};
}

/** {semiMajor, semiMinor} in metres of what the heights of a stream lie on. */
export function bodyOf({crs = '', geoKeys = ''}) {
  const stated = statedAxes(geoKeys);
  if (stated) return stated;
  const [, major, inverse] = (WKT.exec(crs) ?? []).map(Number);
  if (major > 0) return flattened(major, inverse);
  return NAMED.find(([name]) => name.test(crs))?.[1] ?? EARTH;
}

/** A globe of that kind, on the ellipsoid of the stream unless the caller gives another. */
export function globeOn(globe, info) {
  const body = bodyOf(info);
  const {exaggeration = 1, semiMajor = body.semiMajor, semiMinor = body.semiMinor} = globe;
  return {exaggeration, semiMajor, semiMinor};
}

/** The square of its eccentricity. */
export const eccentricityOf = ({semiMajor, semiMinor}) => 1 - (semiMinor / semiMajor) ** 2;
