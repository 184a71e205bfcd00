// SPDX-License-Identifier: Apache-2.0
// Codes what users have, heights, an image over them, or both, into a stream on this page.
import {encode} from '../src/encode.js';
import {encoder} from './decoder.js';

/** What files are coded into: so many bits for each height and texel. */
const BITS = 1, LEAST_BYTES = 32768;

/** Whether there is nothing to code. */
export async function isStream(file) {
  if (/\.tks$/i.test(file.name)) return true;
  const first = await file.slice(0, 3).arrayBuffer().catch(() => new ArrayBuffer(0));
  return new TextDecoder().decode(first) === 'TKS';
}

/** {heights, texture} of files, as encode() takes them. What reads them is loaded now. */
export async function inputOf(files) {
  const {readFiles} = await import('./read_files.js');
  return readFiles(files);
}

/** A stream of {heights, texture}, as a file beside the one of that name. */
export async function encodedFile(input, name, options) {
  const samples = [input.heights, input.texture].filter(Boolean)
    .reduce((sum, {width, height}) => sum + width * height, 0);
  const bytes = Math.max(LEAST_BYTES, Math.round((BITS * samples) / 8));
  const stream = await encode({...input, bytes, index: true}, {...encoder, ...options});
  return new File([stream], `${name.replace(/\.[^.]*$/, '')}.tks`);
}
