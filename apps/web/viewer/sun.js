// SPDX-License-Identifier: Apache-2.0
// Where the light comes from: two sliders.
import {$} from './page.js';
import {say} from './values.js';

const WINDS = ['north', 'north-east', 'east', 'south-east', 'south', 'south-west', 'west',
  'north-west'];

/** The sliders set the sun of a picture, now and whenever they move. */
export function listenToSun(picture) {
  const set = () => {
    const [azimuth, elevation] = ['sun', 'rise'].map((name) => Number($(name).value));
    const wind = WINDS[Math.round(azimuth / 45) % WINDS.length];
    const letters = wind.split('-').map(([first]) => first.toUpperCase()).join('');
    say('sun', `${azimuth}° ${letters}`, `${azimuth} degrees, ${wind}`);
    say('rise', `${elevation}°`, `${elevation} degrees`);
    picture.setSun(azimuth, elevation);
  };
  for (const name of ['sun', 'rise']) $(name).addEventListener('input', set);
  set();
}
