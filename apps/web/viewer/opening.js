// SPDX-License-Identifier: Apache-2.0
// What the page opens: a stream or a sequence by its bytes or its address, or what a server sends
// of a sequence for the page's camera.
import {open, receive} from '../src/index.js';
import {decoder} from './decoder.js';

/** `input`: {live: address} of what `tetrakis serve` prints, or else as open() takes it. */
export const opened = (input, options) => (input.live
  ? receive(input.live, {...decoder, ...options}) : open(input, {...decoder, ...options}));

/** What the address of the page asks for: ?tks=URL or ?live=URL; null: nothing. */
export function inputOfPage() {
  const asked = new URLSearchParams(location.search), live = asked.get('live');
  return live ? {live} : asked.get('tks') || null;
}
export const addressOf = (input) => input.live ?? input;
