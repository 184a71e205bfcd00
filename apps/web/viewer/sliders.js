// SPDX-License-Identifier: Apache-2.0
// The sliders of bytes and triangles, which are logarithmic: 0 to 1000 from the least to the most.
import {$} from './page.js';
import {formatBytes, formatCount} from './read_out.js';
import {say} from './values.js';

/** What is fetched without being asked for. */
const FREE_BYTES = 8 << 20;
const LEAST_TRIANGLES = 100, MOST_TRIANGLES = 1e6, USUAL_TRIANGLES = 50000;

const fromSlider = (slider, least, most) => least * (most / least) ** (slider.value / 1000);
const toSlider = (value, least, most) => (1000 * Math.log(value / least)) / Math.log(most / least);

/** Of the header alone there is a surface too, and of a sketch. */
const leastBytes = (info) => Math.min(info.leastBytes, info.streamBytes - 1);
const mostTriangles = ({width, height}) =>
  Math.max(2 * LEAST_TRIANGLES, Math.min(MOST_TRIANGLES, 2 * width * height));

/** Puts both where they begin for a stream. */
export function setSliders(info) {
  $('bytes').value =
    toSlider(Math.min(info.streamBytes, FREE_BYTES), leastBytes(info), info.streamBytes);
  const most = mostTriangles(info);
  $('triangles').value = toSlider(Math.min(USUAL_TRIANGLES, most), LEAST_TRIANGLES, most);
}

/** {bytes, triangles}, which the page then says. */
export function readSliders(info) {
  const bytes = Math.round(fromSlider($('bytes'), leastBytes(info), info.streamBytes));
  const triangles = Math.round(fromSlider($('triangles'), LEAST_TRIANGLES, mostTriangles(info)));
  say('bytes', formatBytes(bytes));
  say('triangles', formatCount(triangles));
  return {bytes, triangles};
}
