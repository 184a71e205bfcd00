// SPDX-License-Identifier: Apache-2.0
// The first script of the page: asks for the stream (?tks=URL) and starts its decoder while what draws
// it is still on its way.
import {open} from '../src/index.js';
import {decoder} from './decoder.js';

const address = new URLSearchParams(location.search).get('tks');
let asked = null;
if (address) {
  const stop = new AbortController();
  asked = {address, stop, terrain: open(address, {...decoder, signal: stop.signal})};
  asked.terrain.catch(() => {});  // the viewer tells why
}
const {begin} = await import('./viewer.js');
begin(asked);
