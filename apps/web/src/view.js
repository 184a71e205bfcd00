// SPDX-License-Identifier: Apache-2.0
// What is looked at, as `view` of FrameOptions says it: 16 numbers, or these with a picture's size.
import {TksError} from './error.js';

/** More pixels a side than any picture has. */
const MOST_PIXELS = 2 ** 15;

const isMatrix = (numbers) => numbers?.length === 16;

/** Whether there is a picture of this view: none in a window without a size, or from nowhere. */
export function isDrawable({clip, width, height}) {
  return width >= 1 && height >= 1 && isFinite(width) && isFinite(height) && clip.every(isFinite);
}

/** A view as a plan needs it; nothing where there are but 16 numbers. */
export function plannedView(view) {
  if (!view || isMatrix(view)) return null;
  const {clip, width, height} = view;
  if (!isMatrix(clip) || !(width >= 1) || !(height >= 1)) {
    throw new TksError('usage', 'A view is 16 numbers, or takes clip, 16 numbers, and width and ' +
      'height, the pixels of its picture.');
  }
  const pixels = (side) => Math.min(MOST_PIXELS, Math.round(side));
  return {clip: [...clip], width: pixels(width), height: pixels(height)};
}

/** The 16 numbers outside of which a mesh is left out; nothing where all of it is wanted. */
export function cutOf(view) {
  const planned = plannedView(view);
  return planned && !view.cut ? null : planned?.clip ?? view;
}
