/** Pressures as colours: blue is suction, red is push. */

import { type BufferGeometry, Color, Vector3 } from 'three';
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
  #areas: Float32Array = new Float32Array();

  constructor(
    /** Pressures (Pa) at the vertices of the body at a frame. */
    readonly ask: (frame: number) => Promise<Float32Array>,
    /** Is told when the body may be painted otherwise, or another frame be asked for. */
    readonly onAnswer: () => void,
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
    this.#areas = actor === undefined ? new Float32Array() : areasOf(actor.mesh.geometry);
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
      this.onAnswer();
    }
  }

  #paint(actor: Actor, pressures: Float32Array, playing: boolean): void {
    // While it plays the scale follows slowly, or it would flicker.
    const now = typical(pressures, this.#areas);
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

/** A pressure (Pa) that nine tenths of the surface stay below: edges have suction without bound. */
function typical(pressures: Float32Array, areas: Float32Array): number {
  const order = Array.from(pressures.keys()).sort(
    (a, b) => Math.abs(pressures[a] ?? 0) - Math.abs(pressures[b] ?? 0),
  );
  let left = 0.9 * areas.reduce((sum, area) => sum + area, 0);
  const last = order.find((vertex) => (left -= areas[vertex] ?? 0) <= 0);
  return Math.max(Math.abs(pressures[last ?? 0] ?? 0), 1e-9);
}

/** Area around each vertex. */
function areasOf(geometry: BufferGeometry): Float32Array {
  const [position, index] = [geometry.getAttribute('position'), geometry.getIndex()];
  const areas = new Float32Array(position.count);
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  for (let corner = 0; index !== null && corner < index.count; corner += 3) {
    const corners = [0, 1, 2].map((next) => index.getX(corner + next));
    [a, b, c].forEach((point, place) => point.fromBufferAttribute(position, corners[place] ?? 0));
    const area = b.sub(a).cross(c.sub(a)).length() / 6;
    corners.forEach((vertex) => (areas[vertex] = (areas[vertex] ?? 0) + area));
  }
  return areas;
}

/** Two digits of a pressure. */
function pascals(pressure: number): string {
  return Math.abs(pressure) < 1e-6 ? '0 Pa' : `${Number(pressure.toPrecision(2))} Pa`.replace('-', '−');
}
