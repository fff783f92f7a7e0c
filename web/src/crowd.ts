/** Thousands of bodies at once, which fall without end. */

import { Vector3 } from 'three';
import { LOOKS } from './bodies';
import { bodySize } from './camera';
import { byId } from './dom';
import type { Engine } from './engine';
import { working } from './messages';
import type { Picture } from './picture';
import type { Playback } from './playback';
import type { SceneDocument, Values } from './scene';
import { Swarm } from './swarm';

const MANY = 5000;
/** Triangles of each, where its shape is made of a wished number. */
const COARSE = 96;

export class Crowd {
  #swarm: Swarm | undefined;
  #waiting = false;
  /** Time that a frame takes (ms), smoothed. */
  #simulation = 0;
  #drawing = 0;

  constructor(
    readonly engine: Engine,
    readonly picture: Picture,
    readonly playback: Playback,
  ) {}

  get on(): boolean {
    return this.#swarm !== undefined;
  }

  /** Lets bodies of a scene go in place of its run; `wanted` says at the end whether they still are. */
  async start(scene: SceneDocument, wanted: () => boolean): Promise<void> {
    const shape = (scene.get('body') as Values)['shape'];
    const coarse = shape === undefined ? scene : scene.with({ 'body.triangles': COARSE });
    const told = await working(`Letting ${MANY.toLocaleString('en')} go`, (news) =>
      this.engine.call('startMany', [coarse.name, coarse.text(), MANY], news),
    );
    const { main, view } = this.picture;
    if (!wanted() || main === undefined) {
      return;
    }
    const swarm = new Swarm(told.shape, MANY, LOOKS[String(shape)] ?? '#6f93ad');
    swarm.show(told.poses);
    view.scene.add(swarm.mesh);
    this.picture.visible(false);
    const [side = 1, height = 1, , x = 0, ground = 0, z = 0] = told.room;
    const centre = new Vector3(x, ground + 0.5 * height, z);
    const reach = Math.max(side, height);
    view.surround({ ...main.run.description.stage, ground }, bodySize(main.run), centre, 0.6 * reach);
    byId<HTMLInputElement>('follow').checked = false;
    view.lookFrom(new Vector3(0.35, 0.1, 1));
    view.lookAt(centre, 0.8 * reach);
    this.#simulation = this.#drawing = 0;
    this.#swarm = swarm;
    document.body.dataset['many'] = 'on';
  }

  /** Takes them away; whether there were any. */
  stop(): boolean {
    const on = this.on;
    this.#swarm?.dispose();
    this.#swarm = undefined;
    delete document.body.dataset['many'];
    return on;
  }

  /** A frame of the page: moves them on, once they have come from the last. */
  async frame(): Promise<void> {
    if (this.picture.view.stale) {
      this.#draw();
    }
    const swarm = this.#swarm;
    if (swarm === undefined || this.#waiting || !this.playback.playing) {
      return;
    }
    this.#waiting = true;
    try {
      const moved = await this.engine.call('advanceMany', [this.playback.rate / 60]);
      this.#simulation += 0.1 * (moved.milliseconds - this.#simulation) || moved.milliseconds;
      if (this.#swarm === swarm) {
        swarm.show(moved.poses);
        this.picture.view.changed();
      }
    } finally {
      this.#waiting = false;
    }
  }

  #draw(): void {
    const took = this.picture.view.draw();
    this.#drawing += 0.1 * (took - this.#drawing) || took;
    byId('hud').textContent = [
      `${MANY.toLocaleString('en')} bodies`,
      `simulation ${this.#simulation.toFixed(1)} ms a frame of 1/60 s`,
      `drawing ${this.#drawing.toFixed(1)} ms`,
    ].join('\n');
  }
}
