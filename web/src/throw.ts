/** A body that is dragged in the picture and let go. */

import { Mesh, Object3D, Plane, Quaternion, Raycaster, Vector2, Vector3 } from 'three';
import type { View } from './view';

/** What is left of the hand's motion at release is that of its last tenth of a second. */
const MEMORY = 0.1;
/** Fastest throw (m/s). */
const FASTEST = 30;

/** Where a hand was, and when (s). */
interface Moment {
  time: number;
  at: Vector3;
}

/** A body, and a size around it that is easy to hit (m). */
export interface Grabbable {
  body: Object3D;
  size: number;
}

export interface ThrowEvents {
  /** What can be grabbed now. */
  target(): Grabbable | undefined;
  grabbed(): void;
  moved(position: Vector3): void;
  released(position: Vector3, orientation: Quaternion, velocity: Vector3): void;
}

export class Throw {
  readonly #view: View;
  readonly #events: ThrowEvents;
  readonly #ray = new Raycaster();
  #held: { body: Object3D; plane: Plane; offset: Vector3; path: Moment[] } | undefined;

  constructor(view: View, events: ThrowEvents) {
    this.#view = view;
    this.#events = events;
    const { canvas } = view;
    // Before the camera's controls, which must not turn it.
    canvas.addEventListener('pointerdown', (event) => this.#down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.#move(event), { capture: true });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      canvas.addEventListener(end, (event) => this.#up(event), { capture: true });
    }
  }

  get holding(): boolean {
    return this.#held !== undefined;
  }

  #aim(event: PointerEvent): void {
    const { left, top, width, height } = this.#view.canvas.getBoundingClientRect();
    const at = new Vector2(
      (2 * (event.clientX - left)) / width - 1,
      1 - (2 * (event.clientY - top)) / height,
    );
    this.#ray.setFromCamera(at, this.#view.camera);
  }

  /** Whether the pointer is on the body, or close: thin sheets are hard to hit. */
  #hits(body: Object3D, size: number): boolean {
    const centre = body.getWorldPosition(new Vector3());
    const near = this.#ray.ray.distanceToPoint(centre) < 0.6 * size;
    return near || (body instanceof Mesh && this.#ray.intersectObject(body, false).length > 0);
  }

  #down(event: PointerEvent): void {
    const target = this.#events.target();
    if (target === undefined || event.button !== 0) {
      return;
    }
    this.#aim(event);
    if (!this.#hits(target.body, target.size)) {
      return;
    }
    const at = target.body.getWorldPosition(new Vector3());
    const facing = this.#view.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(facing, at);
    const point = this.#ray.ray.intersectPlane(plane, new Vector3()) ?? at;
    this.#held = {
      body: target.body,
      plane,
      offset: at.clone().sub(point),
      path: [{ time: event.timeStamp / 1000, at }],
    };
    this.#view.controls.enabled = false;
    this.#view.canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
    this.#events.grabbed();
  }

  #move(event: PointerEvent): void {
    if (this.#held === undefined) {
      return;
    }
    this.#aim(event);
    const point = this.#ray.ray.intersectPlane(this.#held.plane, new Vector3());
    if (point !== null) {
      const at = point.add(this.#held.offset);
      this.#held.path.push({ time: event.timeStamp / 1000, at });
      this.#events.moved(at);
    }
    event.stopImmediatePropagation();
  }

  #up(event: PointerEvent): void {
    const held = this.#held;
    if (held === undefined) {
      return;
    }
    this.#held = undefined;
    this.#view.controls.enabled = true;
    event.stopImmediatePropagation();
    const velocity = velocityAt(event.timeStamp / 1000, held.path).clampLength(0, FASTEST);
    const at = held.path.at(-1)?.at ?? held.body.position;
    this.#events.released(at, held.body.quaternion, velocity);
  }
}

/** Velocity of a hand that is let go now (m/s). Where the page is slow, few of its places are known. */
function velocityAt(now: number, path: Moment[]): Vector3 {
  const since = now - MEMORY;
  const next = path.findIndex(({ time }) => time > since);
  const [before, after, last] = [path[next - 1], path[next], path.at(-1)];
  if (after === undefined || last === undefined) {
    return new Vector3();
  }
  // Between two places it went straight.
  const share = before === undefined ? 1 : (since - before.time) / (after.time - before.time);
  const begin = (before ?? after).at.clone().lerp(after.at, share);
  const duration = before === undefined ? now - after.time : MEMORY;
  return duration > 0 ? last.at.clone().sub(begin).divideScalar(duration) : new Vector3();
}
