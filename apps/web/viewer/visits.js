// SPDX-License-Identifier: Apache-2.0
// Takes the camera to places: double-clicked, typed into the panel, or in the page's address.
import {isForest} from '../src/domains.js';
import {isPlaced} from '../src/place.js';
import {$} from './page.js';
import {placeIn, placeInAddress, pointOf} from './places.js';

const STILL = matchMedia('(prefers-reduced-motion: reduce)');

/** Whether places can be gone to by their latitude and longitude. */
const hasPlaces = (object, info) => object.isGlobe || (isPlaced(info) && !isForest(info.domain));

export class Visits {
  #picture;
  #shown;

  /** `shown()`: {object, info}, of what is drawn, or null before that. */
  constructor(picture, shown) {
    this.#picture = picture;
    this.#shown = shown;
    $('picture').addEventListener('dblclick', ({clientX, clientY}) => {
      const point = picture.fly.enabled ? null : picture.pointAt(clientX, clientY);
      if (point) picture.visit(point, STILL.matches);
    });
    $('go').addEventListener('submit', (event) => {
      event.preventDefault();
      $('place').setCustomValidity(this.#goTo(placeIn($('place').value)));
      $('place').reportValidity();
    });
    $('place').addEventListener('input', () => $('place').setCustomValidity(''));
  }
  /** For what is open now. */
  prepare(object, info) {
    for (const part of document.querySelectorAll('.of-place'))
      part.hidden = !hasPlaces(object, info);
  }
  /** To the place that the address gives, if it does. */
  follow() {
    const place = placeInAddress();
    if (place) this.#goTo(place);
  }

  /** Why the camera stays, or nothing. */
  #goTo(place) {
    const shown = this.#shown();
    if (!place) return 'Latitude and longitude in degrees: 46.5, 8.2';
    const point = shown && pointOf(shown.object, shown.info, place);
    if (!point) return 'This ground does not reach there.';
    this.#picture.visit(point, STILL.matches);
    return '';
  }
}
