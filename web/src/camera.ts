/** Where the camera looks: at the body, or at its whole way. */

import { MathUtils, Vector3 } from 'three';
import { byId } from './dom';
import type { Showing } from './picture';
import type { OpenedRun } from './told';
import type { View } from './view';

/** Body lengths from which a body is followed, alone and beside another. */
const NEAR = 9;
const NEAR_BOTH = 13;

export class Camera {
  constructor(readonly view: View) {}

  /** A scene is new: from the usual side, and following a body that is alone. */
  begin(run: OpenedRun): void {
    this.view.lookFrom(new Vector3(0.35, 0.16, 1));
    byId<HTMLInputElement>('follow').checked = run.bodies.length === 1;
  }

  /** Near the body where it is followed, else far enough to see the whole way. */
  frame([main, ...others]: Showing[]): void {
    if (main === undefined) {
      return;
    }
    const size = bodySize(main.run);
    if (this.#follows(main)) {
      const near = beside(others) === undefined ? NEAR : NEAR_BOTH;
      this.view.lookAt(middle(main, others), near * size);
    } else {
      const [low, high] = bounds(main.run);
      const radius = 0.5 * high.distanceTo(low) + size;
      const half = MathUtils.degToRad(0.5 * this.view.camera.fov);
      const narrow = Math.min(1, this.view.camera.aspect);
      this.view.lookAt(low.add(high).multiplyScalar(0.5), (1.15 * radius) / Math.sin(half) / narrow);
    }
  }

  /** Goes with the body, far enough to see what it is compared with. */
  follow([main, ...others]: Showing[]): void {
    if (main !== undefined && this.#follows(main)) {
      this.view.lookAt(middle(main, others), this.#wideEnough(main, others));
    }
  }

  #follows({ run }: Showing): boolean {
    return byId<HTMLInputElement>('follow').checked && run.bodies.length === 1;
  }

  /** A distance from which both are seen; none where they are. */
  #wideEnough(main: Showing, others: Showing[]): number | undefined {
    const there = beside(others);
    const wide = there === undefined ? 0 : 2.2 * place(main).distanceTo(there);
    const { camera, controls } = this.view;
    return wide > camera.position.distanceTo(controls.target) ? wide : undefined;
  }
}

/** Length of a body (m). */
export function bodySize(run: OpenedRun): number {
  return 2 * run.description.half_extents[0];
}

/** The box that the bodies of a run pass through. */
export function bounds({ poses, description }: OpenedRun): [Vector3, Vector3] {
  const low = new Vector3().setScalar(Infinity);
  const high = new Vector3().setScalar(-Infinity);
  const point = new Vector3();
  for (const track of poses) {
    for (let at = 0; at < track.length; at += 7) {
      point.fromArray(track, at);
      low.min(point);
      high.max(point);
    }
  }
  const released = new Vector3(...description.position);
  return Number.isFinite(low.x) ? [low, high] : [released, released.clone()];
}

function place({ actors }: Showing): Vector3 {
  const [actor] = actors;
  return actor === undefined ? new Vector3() : actor.mesh.position.clone().add(actor.group.position);
}

/** Where the body under another model is. */
function beside(others: Showing[]): Vector3 | undefined {
  const other = others.find(({ aside }) => aside);
  return other === undefined ? undefined : place(other);
}

function middle(main: Showing, others: Showing[]): Vector3 {
  const there = beside(others);
  return there === undefined ? place(main) : place(main).add(there).multiplyScalar(0.5);
}
