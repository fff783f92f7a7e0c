/** Runs in the picture: their bodies, and what is told of them at the moment shown. */

import type { Vector3 } from 'three';
import { Actor, geometryOf } from './actor';
import { Arrows } from './arrows';
import { Camera, bodySize, bounds } from './camera';
import { Charts } from './charts';
import { byId } from './dom';
import { metres } from './landings';
import { LoadsTable } from './loads';
import type { Playback } from './playback';
import { frameAt } from './playback';
import type { Pressure } from './pressure';
import { type OpenedRun, curve } from './told';
import { type View, gridStep } from './view';

/** A run in the picture. */
export interface Showing {
  /** Its place in the engine. */
  slot: string;
  run: OpenedRun;
  actors: Actor[];
  colour: string;
  name: string;
  /** Whether it is shown beside the first, and not where it is. */
  aside: boolean;
}

/** How a run is shown. */
export interface Appearance {
  slot: string;
  /** Of its curves. */
  colour: string;
  name: string;
  /** Colour of a body. */
  look: (kind: number, number: number) => string;
  opacity: number;
  /** Whether its name stands beside it. */
  labelled: boolean;
  /** How far it is moved away from where it is (m). */
  aside?: Vector3;
}

export class Picture {
  showing: Showing[] = [];
  readonly camera: Camera;
  readonly #arrows: Arrows;
  readonly #loads: LoadsTable;
  readonly #charts: Charts;
  /** The moment at which everything was placed last. */
  #placed: number | undefined;

  constructor(
    readonly view: View,
    readonly playback: Playback,
    readonly pressure: Pressure,
    readonly causes: string[],
  ) {
    this.camera = new Camera(view);
    this.#charts = new Charts(byId('curves'), (time) => (playback.glimpse = time));
    this.#loads = new LoadsTable(byId('loads'), causes);
    this.#arrows = new Arrows(causes);
    view.scene.add(this.#arrows);
    // What is shown of a run, and of which causes.
    for (const id of ['switches', 'loads']) {
      byId(id).addEventListener('change', () => view.changed());
    }
    byId('follow').addEventListener('change', () => this.camera.frame(this.showing));
  }

  /** The run that a person made; the others are beside it. */
  get main(): Showing | undefined {
    return this.showing[0];
  }

  recolour(): void {
    this.view.recolour();
    this.#charts.recolour();
  }

  /** Makes room for a run that has nothing to do with those shown before. */
  begin(run: OpenedRun): void {
    const size = bodySize(run);
    const [low, high] = bounds(run);
    const radius = Math.max(0.5 * high.distanceTo(low), 3 * size);
    const centre = low.add(high).multiplyScalar(0.5);
    this.view.surround(run.description.stage, size, centre, radius);
    this.#loads.begin(run);
    for (const id of ['forces', 'torques', 'pressure']) {
      byId<HTMLInputElement>(id).disabled = run.loads.length === 0;
    }
  }

  /** Adds a run. */
  add(run: OpenedRun, { slot, colour, name, look, opacity, labelled, aside }: Appearance): void {
    const geometries = run.skins.map(geometryOf);
    const actors = run.bodies.flatMap((body, place) => {
      const [geometry, poses] = [geometries[body.kind], run.poses[place]];
      if (geometry === undefined || poses === undefined) {
        return [];
      }
      const actor = new Actor(geometry, poses, body.from, body.scale, {
        colour: look(body.kind, body.number),
        opacity,
        ...(labelled ? { label: name } : {}),
      });
      if (aside !== undefined) {
        actor.group.position.copy(aside);
      }
      this.view.scene.add(actor.group);
      return [actor];
    });
    const faint = opacity < 1 ? `${colour}66` : colour;
    this.showing.push({ slot, run, actors, colour: faint, name, aside: aside !== undefined });
    if (this.showing.length === 1) {
      this.pressure.begin(actors[0]);
    }
    this.#charts.show(this.showing);
    this.view.changed();
  }

  /** Takes all runs away; the places in the engine that are free now. */
  clear(): string[] {
    this.pressure.begin(undefined);
    const slots = this.showing.map(({ slot, actors }) => {
      actors.forEach((actor) => actor.dispose());
      return slot;
    });
    this.showing = [];
    this.view.changed();
    return slots;
  }

  /** Hides what `from` and the later ones are, or shows it again. */
  visible(on: boolean, from = 0): void {
    for (const { actors } of this.showing.slice(from)) {
      actors.forEach(({ group }) => (group.visible = on));
    }
    this.view.changed();
  }

  /** Whether all is drawn as it is at the moment shown. */
  get current(): boolean {
    return this.#placed === this.playback.shown && !this.view.stale;
  }

  /** Everything where it is at the moment shown. */
  place(): void {
    this.#placed = this.playback.shown;
    const checked = (id: string): boolean => byId<HTMLInputElement>(id).checked;
    for (const { run, actors } of this.showing) {
      const { frame, share } = frameAt(run.times, this.playback.shown);
      const alone = actors.length === 1;
      actors.forEach((actor) =>
        actor.place(frame, share, alone && checked('trail'), alone && checked('copies')),
      );
    }
    this.camera.follow(this.showing);
    if (this.main !== undefined) {
      this.#showLoads(this.main);
      const { frame } = frameAt(this.main.run.times, this.playback.shown);
      void this.pressure.show(frame, this.playback.playing);
    }
  }

  #showLoads({ run, actors: [actor] }: Showing): void {
    const width = 6 * this.causes.length;
    const { frame } = frameAt(run.times, this.playback.shown);
    const loads = run.loads.subarray(frame * width, (frame + 1) * width);
    const [forces, torques] = ['forces', 'torques'].map((id) => byId<HTMLInputElement>(id).checked);
    this.#arrows.visible = loads.length > 0 && (forces === true || torques === true);
    if (loads.length === 0 || actor === undefined) {
      return;
    }
    if (this.#arrows.visible) {
      const { mass, gravity } = run.description;
      // An arrow of 1.4 lengths is the weight.
      const unit = mass * Math.hypot(...gravity) || 1e-3;
      this.#arrows.show(loads, actor.mesh.position, unit, 1.4 * bodySize(run), {
        forces: forces === true,
        torques: torques === true,
        hidden: this.#loads.hidden,
      });
    }
    this.#loads.show(loads);
  }

  /** Numbers at the moment shown. */
  tell(): void {
    if (this.main === undefined) {
      return;
    }
    const { run, actors } = this.main;
    const time = this.playback.shown;
    const { ground } = run.description.stage;
    const lines = [`${time.toFixed(2)} s`];
    const speed = curve(run, 'speed')?.[frameAt(run.times, time).frame];
    if (speed !== undefined) {
      const height = (actors[0]?.mesh.position.y ?? 0) - (ground ?? 0);
      lines.push(`${speed.toFixed(2)} m/s`, `${metres(height)} up`);
    } else {
      lines.push(`${run.bodies.length} bodies`);
    }
    if (ground !== null) {
      lines.push(`grid ${metres(gridStep(bodySize(run)))}`);
    }
    byId('hud').textContent = lines.join('   ');
    this.#charts.mark(time);
  }
}
