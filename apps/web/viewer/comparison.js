// SPDX-License-Identifier: Apache-2.0
// The original right of an edge, and the stream left of it: where the page has coded the stream.
import {originalOf} from './original.js';
import {originalInLink} from './original_link.js';
import {$, tell} from './page.js';

export class Comparison {
  #picture;
  #source = null;
  #info = null;

  constructor(picture) {
    this.#picture = picture;
    $('compared').addEventListener('change', () => this.#show());
    $('edge').addEventListener('input', () => this.#moveEdge());
  }

  /** What a stream was coded from, as encode() takes it; null: nobody knows. */
  of(source, info) {
    [this.#source, this.#info] = [source, info];
    $('compare').hidden = source === null;
    $('compared').checked = false;
    this.#show();
  }
  /** Fetches what the stream of the page's address was made of, if the address says so; `isOpen()`:
   * whether that is still shown then. */
  async ofLink(info, isOpen) {
    try {
      const original = await originalInLink(info);
      if (original && isOpen()) this.of(original, info);
    } catch (error) {
      if (isOpen()) tell(error.message);
    }
  }
  #show() {
    const isShown = this.#source !== null && $('compared').checked;
    $('edge').hidden = !isShown;
    this.#picture.setOriginal(isShown ? originalOf(this.#source, this.#info) : null);
    this.#moveEdge();
  }
  #moveEdge() {
    const share = $('edge').value / 1000, percent = Math.round(100 * share);
    $('edge').setAttribute('aria-valuetext', `${percent} % stream, ${100 - percent} % original`);
    this.#picture.setEdge(share);
  }
}
