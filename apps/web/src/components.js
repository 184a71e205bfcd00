// SPDX-License-Identifier: Apache-2.0
// The rasters of a stream, of which those that are asked for are taken as its heights and texture.
import {TksError} from './error.js';

/** By the numbers of tks_component_kind. */
export const KINDS = ['heights', 'texture', 'unknown'];

/** The names and numbers that a caller gives: one, several or none. */
export function askedOf(component) {
  const asked = [component ?? []].flat();
  for (const one of asked) {
    const isNumber = Number.isInteger(one) && one >= 0 && one < 2 ** 32;
    if (typeof one === 'string' || isNumber) continue;
    throw new TksError('usage', '`component` is a name or a number of `info.components`, or an ' +
      'array of these.');
  }
  return asked;
}

/** Those of a name, or that of a number. Heights and a texture may have one name. */
function namedBy(asked, components) {
  const named = components.filter(({name}) => name !== '' && name === asked);
  const found = named.length > 0 ? named
    : components.filter(({number}) => String(number) === String(asked));
  if (found.length > 0) return found;
  throw new TksError('usage', `The stream has no component ${JSON.stringify(asked)}: ` +
    '`info.components` lists those that it has.');
}

/** The numbers of the heights and of the texture to take, of names and numbers; -1: the first. */
export function choiceOf(asked, components) {
  const choice = {heights: -1, texture: -1};
  for (const {number, kind} of asked.flatMap((one) => namedBy(one, components))) {
    if (!(kind in choice)) {
      throw new TksError('unsupported', `This decoder does not know what component ${number} is.`);
    }
    choice[kind] = number;
  }
  return choice;
}
