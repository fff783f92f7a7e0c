/** Thousands of bodies in the picture, each an instance of one shape. */

import {
  DynamicDrawUsage,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
  Color,
} from 'three';
import { geometryOf } from './actor';
import type { SkinArrays } from './told';

export class Swarm {
  readonly mesh: InstancedMesh;
  readonly #matrix = new Matrix4();
  readonly #position = new Vector3();
  readonly #orientation = new Quaternion();
  readonly #unit = new Vector3(1, 1, 1);

  constructor(skin: SkinArrays, count: number, colour: string) {
    this.mesh = new InstancedMesh(geometryOf(skin), new MeshLambertMaterial(), count);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    // Not all of one tree.
    const tint = new Color();
    for (let body = 0; body < count; body++) {
      const share = ((body * 0.618034) % 1) - 0.5;
      this.mesh.setColorAt(body, tint.set(colour).offsetHSL(0.06 * share, 0, 0.16 * share));
    }
  }

  show(poses: Float32Array): void {
    for (let body = 0; body < this.mesh.count; body++) {
      this.#position.fromArray(poses, 7 * body);
      this.#orientation.fromArray(poses, 7 * body + 3);
      this.#matrix.compose(this.#position, this.#orientation, this.#unit);
      this.mesh.setMatrixAt(body, this.#matrix);
    }
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.dispose();
  }
}
