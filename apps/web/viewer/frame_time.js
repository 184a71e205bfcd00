// SPDX-License-Identifier: Apache-2.0
// When a frame is, in words: by its clock where there is one, else by its number.

const EPOCH =
  /^(\d{4}-\d\d-\d\d)(?:[T ](\d\d:\d\d(?::\d\d(?:\.\d+)?)?))?\s*(Z|UTC|[+-]\d\d:?\d\d)?$/i;
/** Calendars of CF in which days are those of Date. */
const USUAL = /^(standard|gregorian|proleptic_gregorian)?$/;

/** Milliseconds of an epoch, as RFC 3339 or CF has it; NaN: it is no such date. */
function epochOf({epoch, calendar}) {
  const parts = USUAL.test(calendar) ? EPOCH.exec(epoch) : null;
  if (!parts) return NaN;
  const [, date, time = '00:00', zone = 'Z'] = parts;
  const offset = zone.replace(/UTC|z/i, 'Z').replace(/^([+-]\d\d)(\d\d)$/, '$1:$2');
  return Date.parse(`${date}T${time}${offset}`);
}

const withoutZeros = (number) => String(Number(number.toFixed(3)));

/** RFC 3339 where the clock has an epoch, seconds where it has none, else ticks, or the number of
 * the frame where they are the same, or not known yet. */
export function frameTime(clock, time, number) {
  if (time === undefined || (!clock && time === number)) return `frame ${number}`;
  if (!clock) return `tick ${time}`;
  const seconds = (time * clock.numerator) / clock.denominator;
  const date = new Date(epochOf(clock) + 1000 * seconds);
  if (!Number.isNaN(date.getTime())) return date.toISOString().replace('.000Z', 'Z');
  const since = clock.epoch ? ` since ${clock.epoch}` : '';
  return `${withoutZeros(seconds)} s${since}`;
}

/** The frames of a terrain, from `first` on: of a server all that it has. */
export const framesOf = ({isLive, firstFrame, frames, sourceFrames}) =>
  (isLive ? {first: 0, end: sourceFrames} : {first: firstFrame, end: frames});

/** How many frames a second are played where nothing says it, or says what cannot be watched. */
const USUAL_RATE = 5, LEAST_RATE = 1, MOST_RATE = 60;

/** Frames a second by the clock and the times of two frames that follow each other. */
export function rateOf(clock, first, second) {
  const rate = clock ? clock.denominator / (clock.numerator * (second - first)) : NaN;
  return rate >= LEAST_RATE && rate <= MOST_RATE ? rate : USUAL_RATE;
}
