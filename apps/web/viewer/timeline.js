// SPDX-License-Identifier: Apache-2.0
// The bar below the picture that plays the frames of a sequence, goes to any of them, and follows
// the newest one of a server.
import {givenFrame, linkedFrame} from './camera_link.js';
import {frameTime, framesOf} from './frame_time.js';
import {$} from './page.js';
import {Player} from './player.js';
import {say} from './values.js';

export class Timeline {
  #player;
  #onplay;
  #onrest;
  #terrain = null;
  #follows = false;  // the newest frame
  #hasGrown = false;

  /** `decode`, `show` and `fail` as Player takes them; `onplay()` is called before frames play
   * or another one is sought, `onrest()` where one stays. */
  constructor({decode, show, fail, onplay, onrest}) {
    [this.#onplay, this.#onrest] = [onplay, onrest];
    const shown = (frame) => {
      this.#say(frame.number);
      this.#want(frame.number);
      show(frame);
      if (!this.#player.isPlaying) this.#rest();
    };
    const failed = (error) => {
      this.#follows = false;
      this.#drawButton();
      fail(error);
    };
    this.#player =
      new Player({decode, show: shown, fail: failed, onend: () => this.#ended()});
    $('play').addEventListener('click', () =>
      (this.isPlaying || this.#follows ? this.pause() : this.play()));
    $('frame').addEventListener('input', () => this.#chosen(Number($('frame').value)));
    $('live').addEventListener('click', () => this.follow());
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
    const {isLive = false} = terrain;
    this.#follows = isLive && linkedFrame(terrain) === null;
    this.#hasGrown = false;
    this.#player.begin(terrain, givenFrame(terrain));
    $('timeline').hidden = true;
    [$('live').hidden, $('loop').parentElement.hidden] = [!isLive, isLive];
    this.#say(this.number);
    this.#drawButton();
  }
  get isShown() {
    if (!this.#terrain) return false;
    const {first, end} = framesOf(this.#terrain);
    return end > first + 1;
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
    const isUsual = this.#follows || this.number === framesOf(this.#terrain).first;
    return this.isShown && !isUsual ? this.number : null;
  }

  /** Shows the bar, once there is a picture, and with it the time of its frame. */
  reveal() {
    $('timeline').hidden = !this.isShown;
    this.#say(this.number);
  }
  play() {
    if (this.#hasGrown && this.number + 1 === framesOf(this.#terrain).end) return this.follow();
    this.#onplay();
    this.#player.play();
    this.#drawButton();
  }
  pause() {
    this.#follows = false;
    this.#player.pause();
    this.#rest();
  }

  /** Shows the newest frame from now on, whichever that is. */
  follow() {
    this.#player.pause();
    this.#follows = true;
    this.#want();
    this.#drawButton();
    return this.advance();
  }
  /** More has come from a server. Resolves once what is newest is drawn, if that is followed. */
  async advance(hasGrown = false) {
    this.#hasGrown ||= hasGrown;
    this.reveal();
    const newest = this.#terrain.frames - 1;
    if (this.#follows && newest !== this.number) await this.seek(newest);
  }
  /** No more will come. */
  end() {
    this.#follows = false;
    this.#drawButton();
  }
  /** Who drags to the end follows it. */
  #chosen(number) {
    if (this.#hasGrown && number + 1 === framesOf(this.#terrain).end) return this.follow();
    this.#follows = false;
    return this.seek(number);
  }
  /** Tells a server which frame is shown. */
  #want(number) {
    this.#terrain.want?.({frame: this.#follows ? 'newest' : number});
  }
  #ended() {
    if (this.#hasGrown) this.follow();
    else this.#rest();
  }
  seek(number) {
    this.#onplay();
    this.#say(number);
    this.#want(number);
    return this.#player.seek(number);
  }
  /** Goes to the frame of the address. */
  followLink() {
    if (!this.#terrain || this.#follows) return;
    const number = givenFrame(this.#terrain);
    if (number !== this.number) this.seek(number);
  }
  #rest() {
    this.#drawButton();
    this.#onrest();
  }
  /** Times of frames that were not asked for yet may not be known. */
  #say(number) {
    const {clock, times} = this.#terrain, time = frameTime(clock, times[number], number);
    const {first, end} = framesOf(this.#terrain);
    [$('frame').min, $('frame').max] = [first, end - 1];
    $('frame').value = number;
    say('frame', time, time.startsWith('frame') ? `${time} of ${end}`
      : `${time}, frame ${number} of ${end}`);
  }
  #drawButton() {
    const isPlaying = this.#player.isPlaying || this.#follows;
    $('live').setAttribute('aria-pressed', String(this.#follows));
    $('play').setAttribute('aria-label', isPlaying ? 'Pause' : 'Play');
    $('play').classList.toggle('playing', isPlaying);
  }
}
