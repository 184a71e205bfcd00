// SPDX-License-Identifier: Apache-2.0
// The bar below the picture that plays the frames of a sequence, and goes to any of them.
import {givenFrame} from './camera_link.js';
import {frameTime} from './frame_time.js';
import {$} from './page.js';
import {Player} from './player.js';
import {say} from './values.js';

export class Timeline {
  #player;
  #onplay;
  #onrest;
  #terrain = null;

  /** `decode`, `show` and `fail` as Player takes them; `onplay()` is called before frames play
   * or another one is sought, `onrest()` where one stays. */
  constructor({decode, show, fail, onplay, onrest}) {
    [this.#onplay, this.#onrest] = [onplay, onrest];
    const shown = (frame) => {
      this.#say(frame.number);
      show(frame);
      if (!this.#player.isPlaying) this.#rest();
    };
    const failed = (error) => {
      this.#drawButton();
      fail(error);
    };
    this.#player =
      new Player({decode, show: shown, fail: failed, onend: () => this.#rest()});
    $('play').addEventListener('click', () =>
      (this.isPlaying ? this.pause() : this.play()));
    $('frame').addEventListener('input', () => this.seek(Number($('frame').value)));
    $('speed').addEventListener('change', () => (this.#player.speed = Number($('speed').value)));
    $('loop').addEventListener('change', () => (this.#player.loops = $('loop').checked));
    $('picture').addEventListener('keydown', (event) => {
      if (event.key !== ' ' || $('timeline').hidden) return;
      event.preventDefault();
      $('play').click();
    });
  }

  /** Of a terrain that was opened; its first frame is that of the address, or the first. */
  begin(terrain) {
    this.#terrain = terrain;
    const {firstFrame, frames} = terrain;
    this.#player.begin(terrain, givenFrame(terrain));
    $('timeline').hidden = true;
    [$('frame').min, $('frame').max] = [firstFrame, frames - 1];
    this.#say(this.number);
    this.#drawButton();
  }
  get isShown() {
    return this.#terrain?.frames > this.#terrain?.firstFrame + 1;
  }
  get isPlaying() {
    return this.#player.isPlaying;
  }
  /** Of the frame that is shown. */
  get number() {
    return this.#player.number;
  }
  /** What the address keeps; null: it is the first. */
  get kept() {
    return this.isShown && this.number !== this.#terrain.firstFrame ? this.number : null;
  }

  /** Shows the bar, once there is a picture, and with it the time of its frame. */
  reveal() {
    $('timeline').hidden = !this.isShown;
    this.#say(this.number);
  }
  play() {
    this.#onplay();
    this.#player.play();
    this.#drawButton();
  }
  pause() {
    this.#player.pause();
    this.#rest();
  }
  seek(number) {
    this.#onplay();
    this.#say(number);
    return this.#player.seek(number);
  }
  /** Goes to the frame of the address. */
  follow() {
    const number = this.#terrain ? givenFrame(this.#terrain) : this.number;
    if (number !== this.number) this.seek(number);
  }
  #rest() {
    this.#drawButton();
    this.#onrest();
  }
  /** Times of frames that were not asked for yet may not be known. */
  #say(number) {
    const {clock, times, frames} = this.#terrain, time = frameTime(clock, times[number], number);
    $('frame').value = number;
    say('frame', time, time.startsWith('frame') ? `${time} of ${frames}`
      : `${time}, frame ${number} of ${frames}`);
  }
  #drawButton() {
    const {isPlaying} = this.#player;
    $('play').setAttribute('aria-label', isPlaying ? 'Pause' : 'Play');
    $('play').classList.toggle('playing', isPlaying);
  }
}
