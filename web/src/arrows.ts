/** Arrows of forces and torques at the body, by cause. */

import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  TorusGeometry,
  Vector3,
} from 'three';

/** Causes in words, with the colour of each. */
export const CAUSES: Record<string, { words: string; colour: string }> = {
  weight: { words: 'Weight', colour: '#8d6e63' },
  buoyancy: { words: 'Buoyancy', colour: '#26a0da' },
  added_mass: { words: 'Added mass (Munk)', colour: '#ab47bc' },
  drag: { words: 'Drag', colour: '#e53935' },
  normal_force: { words: 'Normal force', colour: '#2e9d4f' },
  rotational_lift: { words: 'Rotational lift', colour: '#f59f00' },
  damping: { words: 'Damping of spin', colour: '#d81b76' },
  lost_couple: { words: 'Couple lost to separation', colour: '#7a8b99' },
  friction: { words: 'Friction', colour: '#a08060' },
  turbulence: { words: 'Turbulence', colour: '#00a396' },
  fluid_acceleration: { words: 'Push of accelerating fluid', colour: '#5c6bc0' },
  outside: { words: 'From outside', colour: '#555555' },
};

const UP = new Vector3(0, 1, 0);
const FORWARD = new Vector3(0, 0, 1);

/** An arrow from the origin along +Y, of unit length and width. */
class Arrow extends Group {
  readonly #shaft: Mesh;
  readonly #head: Mesh;

  constructor(colour: string) {
    super();
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    this.#shaft = new Mesh(new CylinderGeometry(0.5, 0.5, 1, 10).translate(0, 0.5, 0), material);
    this.#head = new Mesh(new ConeGeometry(1.4, 3.4, 16).translate(0, 1.7, 0), material);
    this.#shaft.renderOrder = this.#head.renderOrder = 10;
    this.add(this.#shaft, this.#head);
  }

  point(vector: Vector3, length: number, width: number): void {
    this.visible = length > 0.5 * width;
    if (this.visible) {
      this.quaternion.setFromUnitVectors(UP, vector.clone().normalize());
      const shaft = Math.max(0, length - 3.4 * width);
      this.#shaft.scale.set(width, Math.max(shaft, 1e-9), width);
      this.#head.scale.setScalar(Math.min(width, length / 3.4));
      this.#head.position.y = shaft;
    }
  }
}

/** Three quarters of a ring with a head, around +Z, of unit radius. */
class Turn extends Group {
  constructor(colour: string) {
    super();
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    const ring = new Mesh(new TorusGeometry(1, 0.035, 8, 48, 1.5 * Math.PI), material);
    const head = new Mesh(new ConeGeometry(0.11, 0.28, 12), material);
    // At the end of the ring, along it.
    head.position.set(0, -1, 0);
    head.rotation.z = -Math.PI / 2;
    ring.renderOrder = head.renderOrder = 10;
    this.add(ring, head);
  }

  point(vector: Vector3, radius: number, least: number): void {
    this.visible = radius > least;
    if (this.visible) {
      this.quaternion.copy(new Quaternion().setFromUnitVectors(FORWARD, vector.clone().normalize()));
      this.scale.setScalar(radius);
    }
  }
}

export interface Shown {
  forces: boolean;
  torques: boolean;
  hidden: ReadonlySet<string>;
}

/** Arrows of all causes at one body. */
export class Arrows extends Group {
  readonly #forces: Arrow[];
  readonly #torques: Turn[];

  constructor(readonly causes: string[]) {
    super();
    const colours = causes.map((cause) => CAUSES[cause]?.colour ?? '#888888');
    this.#forces = colours.map((colour) => new Arrow(colour));
    this.#torques = colours.map((colour) => new Turn(colour));
    this.add(...this.#forces, ...this.#torques);
  }

  /**
   * Shows the loads of one frame: six numbers a cause. `unit` is the force (N) of an arrow as long as `size` (m); a torque
   * of `unit` times `size` has a ring of the same radius.
   */
  show(loads: Float32Array, place: Vector3, unit: number, size: number, shown: Shown): void {
    this.position.copy(place);
    this.causes.forEach((cause, number) => {
      const force = new Vector3().fromArray(loads, 6 * number);
      const torque = new Vector3().fromArray(loads, 6 * number + 3);
      const visible = !shown.hidden.has(cause);
      const length = visible && shown.forces ? (size * force.length()) / unit : 0;
      // Areas of rings as torques: small ones are seen beside large ones.
      const radius = visible && shown.torques ? size * Math.sqrt(torque.length() / (unit * size)) : 0;
      this.#forces[number]?.point(force, Math.min(length, 8 * size), 0.028 * size);
      this.#torques[number]?.point(torque, Math.min(radius, 2 * size), 0.06 * size);
    });
  }
}
