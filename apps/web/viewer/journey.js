// SPDX-License-Identifier: Apache-2.0
// A camera on its way to a place, slow at both ends.
import {MathUtils, Vector3} from 'three';

/** In ms: of a short way, and how much more a long one takes. */
const SHORT = 900, LONGER = 700;
/** How far a camera rises half way round a globe, in radii for each radian. */
const RISE = 0.25;

const longitudeOf = ({x, z}) => Math.atan2(-z, x);
const latitudeOf = (eye) => Math.asin(MathUtils.clamp(eye.y / eye.length(), -1, 1));

/** From one place above a globe to another: the shorter way, with north above all the time. */
export function wayRound(from, to, radius) {
  const [west, south] = [longitudeOf(from), latitudeOf(from)];
  const turn = longitudeOf(to) - west, across = turn - 2 * Math.PI * Math.round(turn / 2 / Math.PI);
  const up = latitudeOf(to) - south, angle = from.angleTo(to);
  const [low, high] = [from, to].map((eye) => Math.log(Math.max(eye.length() / radius - 1, 1e-6)));
  return {
    ms: SHORT + LONGER * angle,
    at(share) {
      const longitude = west + share * across, latitude = south + share * up;
      const rise = RISE * angle * 4 * share * (1 - share);
      const away = radius * (1 + Math.exp(MathUtils.lerp(low, high, share)) + rise);
      const eye = new Vector3(Math.cos(latitude) * Math.cos(longitude), Math.sin(latitude),
        -Math.cos(latitude) * Math.sin(longitude)).multiplyScalar(away);
      return {eye, target: new Vector3()};
    },
  };
}

/** Straight from {eye, target} to others. */
export const wayAcross = (from, to) => ({
  ms: SHORT,
  at: (share) => ({
    eye: from.eye.clone().lerp(to.eye, share), target: from.target.clone().lerp(to.target, share),
  }),
});

export class Journey {
  #way = null;
  #begun = 0;

  constructor(camera, orbit) {
    this.camera = camera;
    this.orbit = orbit;
  }
  /** `ms`: how long it takes, by default what the way says; 0: the camera is there at once. */
  begin(way, ms = way.ms) {
    this.#way = {...way, ms};
    this.#begun = performance.now();
  }
  end() {
    this.#way = null;
  }

  /** Puts the camera where it is by now. Whether there is a picture more to draw. */
  step(now) {
    if (!this.#way) return false;
    const {ms, at} = this.#way;
    const time = ms > 0 ? MathUtils.clamp((now - this.#begun) / ms, 0, 1) : 1;
    const {eye, target} = at(MathUtils.smootherstep(time, 0, 1));
    this.camera.position.copy(eye);
    this.orbit.target.copy(target);
    if (time === 1) this.#way = null;
    return this.#way !== null;
  }
}
