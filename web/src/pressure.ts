/** Pressures as colours: blue is suction, red is push. */

import { Color } from 'three';
import { byId } from './dom';
import type { Actor } from './actor';

const RAMP = ['#2166ac', '#92c5de', '#f7f7f7', '#f4a582', '#b2182b'].map((at) => new Color(at));

/** Asks the engine for the pressures of a frame, and paints them. */
export class Pressure {
  #frame = -1;
  #waiting = false;
  /** The end of the scale (Pa). */
  #most = 0;
  #actor: Actor | undefined;

  constructor(
    /** Pressures (Pa) at the vertices of the body at a frame. */
    readonly ask: (frame: number) => Promise<Float32Array>,
    readonly onTrouble: (error: unknown) => void,
  ) {
    byId('pressure').addEventListener('change', () => this.begin(this.#actor));
  }

  get wanted(): boolean {
    const box = byId<HTMLInputElement>('pressure');
    return box.checked && !box.disabled;
  }

  /** Another body, or another wish. */
  begin(actor: Actor | undefined): void {
    this.#actor = actor;
    this.#frame = -1;
    this.#most = 0;
    byId('pressure-scale').hidden = !this.wanted;
    if (!this.wanted) {
      actor?.paint(undefined);
    }
  }

  /** Shows a frame, unless it is shown or another is waited for. */
  async show(frame: number, playing: boolean): Promise<void> {
    const actor = this.#actor;
    if (!this.wanted || this.#waiting || this.#frame === frame || actor === undefined) {
      return;
    }
    this.#waiting = true;
    try {
      const pressures = await this.ask(frame);
      if (this.wanted && this.#actor === actor) {
        this.#frame = frame;
        this.#paint(actor, pressures, playing);
      }
    } catch (error) {
      byId<HTMLInputElement>('pressure').checked = false;
      this.begin(actor);
      this.onTrouble(error);
    } finally {
      this.#waiting = false;
    }
  }

  #paint(actor: Actor, pressures: Float32Array, playing: boolean): void {
    // While it plays the scale follows slowly, or it would flicker.
    const now = typical(pressures);
    this.#most = playing && this.#most > 0 ? this.#most + 0.08 * (now - this.#most) : now;
    actor.paint(coloured(pressures, this.#most));
    byId('pressure-low').textContent = pascals(-this.#most);
    byId('pressure-high').textContent = pascals(this.#most);
  }
}

/** Colours of pressures between -`most` and `most` (Pa), three numbers each. */
function coloured(pressures: Float32Array, most: number): Float32Array {
  const colours = new Float32Array(3 * pressures.length);
  const mixed = new Color();
  pressures.forEach((pressure, vertex) => {
    const place = 2 + 2 * Math.min(1, Math.max(-1, pressure / most));
    const below = Math.min(3, Math.floor(place));
    mixed.lerpColors(RAMP[below] ?? mixed, RAMP[below + 1] ?? mixed, place - below);
    mixed.toArray(colours, 3 * vertex);
  });
  return colours;
}

/** A pressure that all but a few of the strongest stay below (Pa): edges have suction without bound. */
function typical(pressures: Float32Array): number {
  const sizes = pressures.map(Math.abs).sort();
  return Math.max(sizes[Math.floor(0.9 * sizes.length)] ?? 0, 1e-9);
}

/** Two digits of a pressure. */
function pascals(pressure: number): string {
  return Math.abs(pressure) < 1e-6 ? '0 Pa' : `${Number(pressure.toPrecision(2))} Pa`.replace('-', '−');
}
