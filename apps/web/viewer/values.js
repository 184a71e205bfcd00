// SPDX-License-Identifier: Apache-2.0
// Sliders say their values beside them, and to who does not see them.
import {$} from './page.js';

/** `text` stands beside the slider of this name; `spoken`, where signs would be read badly. */
export function say(name, text, spoken = text) {
  $(`${name}-value`).textContent = text;
  $(name).setAttribute('aria-valuetext', spoken);
}
