/** Play, pause, steps and the slider. */

import { byId } from './dom';
import type { Playback } from './playback';

export class Transport {
  readonly #slider = byId<HTMLInputElement>('time');
  /** What was told last. */
  #told = '';

  constructor(readonly playback: Playback) {
    byId('play').addEventListener('click', () => this.toggle());
    byId('back').addEventListener('click', () => playback.step(-1));
    byId('forth').addEventListener('click', () => playback.step(1));
    byId('again').addEventListener('click', () => this.again());
    this.#slider.addEventListener('input', () => this.seek(this.#slider.valueAsNumber));
    byId<HTMLSelectElement>('rate').addEventListener('change', ({ target }) => {
      playback.rate = Number((target as HTMLSelectElement).value);
    });
  }

  toggle(): void {
    if (this.playback.playing) {
      this.playback.playing = false;
    } else {
      this.playback.play();
    }
  }

  again(): void {
    this.playback.time = this.playback.start;
    this.playback.playing = true;
  }

  /** Stops at a time (s). */
  seek(time: number): void {
    this.playback.playing = false;
    this.playback.seek(time);
  }

  /** To a share of the run. */
  seekShare(share: number): void {
    const { start, end } = this.playback;
    this.playback.seek(start + share * (end - start));
  }

  /** Frames that go on until a time (s). */
  frames(times: Float64Array): void {
    this.playback.times = times;
    this.#slider.min = String(this.playback.start);
    this.#slider.max = String(this.playback.end);
  }

  /** Shows where the run is. */
  tell(): void {
    const { shown, start, end, playing } = this.playback;
    const now = [shown, start, end, playing].join();
    if (now === this.#told) {
      return;
    }
    this.#told = now;
    byId('clock').textContent = `${shown.toFixed(2)} / ${end.toFixed(2)} s`;
    this.#slider.value = String(shown);
    this.#slider.setAttribute('aria-valuetext', `${shown.toFixed(2)} seconds`);
    const play = byId('play');
    const words = playing ? 'Pause' : 'Play';
    if (play.getAttribute('aria-label') !== words) {
      play.setAttribute('aria-label', words);
      play.dataset['playing'] = String(playing);
    }
  }
}
