// SPDX-License-Identifier: Apache-2.0
// The page around the picture: its elements, and what it says.

export const $ = (id) => document.getElementById(id);

/** Up to this width, in pixels, the panel lies below the terrain: as in style.css. */
export const NARROW = 640;
const SMALL_SCREEN = `(max-width: ${NARROW}px), (max-height: 520px)`;
export const isSmallScreen = () => matchMedia(SMALL_SCREEN).matches;

/** What neither the name nor the panel lies over. */
export function freeArea() {
  const margin = 24, name = document.querySelector('header').getBoundingClientRect();
  const panel = $('panel').getBoundingClientRect();
  const isBelow = panel.width >= innerWidth, isBeside = panel.width > 0 && !isBelow;
  const bar = $('timeline').getBoundingClientRect(), bottom = isBelow ? panel.top : innerHeight;
  const isUnder = bar.width > 0 && bar.top > innerHeight / 2;
  return {
    left: margin, right: (isBeside ? panel.left : innerWidth) - margin,
    top: (isBelow && bar.width > 0 ? bar.bottom : name.bottom) + margin,
    bottom: Math.min(bottom, isUnder ? bar.top : bottom) - margin,
  };
}

/** An error, or a note on what is shown; no text: nothing. */
export function tell(text, isNote = false) {
  $('message').textContent = text;
  $('message').classList.toggle('note', isNote);
  $('message').hidden = !text;
}

/** What the page calls what it shows, or is about to. */
export function entitle({name, title, size}) {
  $('name').textContent = name;
  document.title = title;
  $('size').textContent = size;
}

/** How to move. */
export function explainMoves(isFlying) {
  const [touched, byHand] = isFlying
    ? ['One finger looks around, a second one goes ahead.',
      'A drag looks around. W A S D or arrows go, Q and E sink and rise, Shift hurries.']
    : ['One finger turns, two move and zoom.',
      'A drag turns, with Shift it moves; the wheel zooms, a double click goes there. ' +
        'Keys: arrows, + −, Home.'];
  $('help').textContent = matchMedia('(hover: none)').matches ? touched : byHand;
}
