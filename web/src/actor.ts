/** A body of a run in the picture: its surface, its trail, its copies, its ghostliness. */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  Line,
  LineBasicMaterial,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Quaternion,
  Vector3,
} from 'three';
import { CSS2DObject } from 'three/addons/renderers/CSS2DRenderer.js';
import { h } from './dom';
import type { SkinArrays } from './told';
import { dispose } from './view';

/** Copies of a body along its way. */
const COPIES = 28;

export function geometryOf(skin: SkinArrays): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(skin.positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(skin.normals, 3));
  geometry.setIndex(new BufferAttribute(skin.triangles, 1));
  return geometry;
}

export interface Look {
  colour: string;
  /** 1 is solid. */
  opacity: number;
  /** What stands beside it. */
  label?: string;
}

/** The pose in `poses` at a place between two frames. */
export function poseAt(
  poses: Float32Array,
  frame: number,
  share: number,
  position: Vector3,
  orientation: Quaternion,
): void {
  const last = poses.length / 7 - 1;
  const a = 7 * Math.min(last, Math.max(0, frame));
  const b = 7 * Math.min(last, Math.max(0, frame + 1));
  position.fromArray(poses, a);
  orientation.fromArray(poses, a + 3);
  if (share > 0 && b > a) {
    position.lerp(new Vector3().fromArray(poses, b), share);
    orientation.slerp(new Quaternion().fromArray(poses, b + 3), share);
  }
}

export class Actor {
  readonly group = new Group();
  readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  readonly #trail: Line<BufferGeometry, LineBasicMaterial>;
  readonly #copies: InstancedMesh<BufferGeometry, MeshStandardMaterial>;
  readonly #colour: Color;

  constructor(
    geometry: BufferGeometry,
    readonly poses: Float32Array,
    /** Frame of the run at which it is let go. */
    readonly from: number,
    scale: number,
    look: Look,
  ) {
    this.#colour = new Color(look.colour);
    const solid = look.opacity >= 1;
    const material = (opacity: number) =>
      new MeshStandardMaterial({
        color: this.#colour,
        roughness: 0.75,
        transparent: opacity < 1,
        opacity,
        depthWrite: opacity >= 1,
      });
    this.mesh = new Mesh(geometry, material(look.opacity));
    this.mesh.scale.setScalar(scale);
    this.mesh.castShadow = solid;
    this.mesh.receiveShadow = solid;

    const count = poses.length / 7;
    const points = new Float32Array(3 * count);
    for (let frame = 0; frame < count; frame++) {
      points.set(poses.subarray(7 * frame, 7 * frame + 3), 3 * frame);
    }
    const line = new BufferGeometry();
    line.setAttribute('position', new BufferAttribute(points, 3));
    this.#trail = new Line(
      line,
      new LineBasicMaterial({ color: this.#colour, transparent: true, opacity: solid ? 0.9 : 0.5 }),
    );
    this.#trail.frustumCulled = false;

    this.#copies = new InstancedMesh(geometry, material(0.28), COPIES);
    this.#copies.frustumCulled = false;
    const [position, orientation] = [new Vector3(), new Quaternion()];
    for (let copy = 0; copy < COPIES; copy++) {
      poseAt(poses, this.#frameOf(copy), 0, position, orientation);
      const size = new Vector3().setScalar(scale);
      this.#copies.setMatrixAt(copy, new Matrix4().compose(position, orientation, size));
    }
    this.group.add(this.mesh, this.#trail, this.#copies);
    if (look.label !== undefined) {
      const label = new CSS2DObject(h('span', { className: 'label' }, look.label));
      label.element.style.setProperty('--of', look.colour);
      label.center.set(0.5, 2.2);
      this.mesh.add(label);
    }
  }

  #frameOf(copy: number): number {
    return Math.round((copy * (this.poses.length / 7 - 1)) / (COPIES - 1));
  }

  /** Puts it where it is at a place between two frames of the run. */
  place(frame: number, share: number, trail: boolean, copies: boolean): void {
    const own = frame - this.from;
    const there = own + share >= 0;
    this.mesh.visible = there;
    poseAt(this.poses, own, own < 0 ? 0 : share, this.mesh.position, this.mesh.quaternion);
    this.#trail.visible = trail && there;
    this.#trail.geometry.setDrawRange(0, Math.max(0, own + 1));
    this.#copies.visible = copies && there;
    let shown = 0;
    while (shown < COPIES && this.#frameOf(shown) <= own) {
      shown++;
    }
    this.#copies.count = shown;
  }

  /** Colours each vertex; none gives its own colour back. */
  paint(colours: Float32Array | undefined): void {
    const { geometry, material } = this.mesh;
    if (colours === undefined) {
      geometry.deleteAttribute('color');
      material.color.copy(this.#colour);
    } else {
      let attribute = geometry.getAttribute('color') as BufferAttribute | undefined;
      if (attribute?.count !== colours.length / 3) {
        attribute = new BufferAttribute(new Float32Array(colours.length), 3).setUsage(DynamicDrawUsage);
        geometry.setAttribute('color', attribute);
      }
      attribute.copyArray(colours);
      attribute.needsUpdate = true;
      material.color.set(0xffffff);
    }
    const painted = colours !== undefined;
    if (material.vertexColors !== painted) {
      material.vertexColors = painted;
      material.needsUpdate = true;
    }
  }

  dispose(): void {
    this.mesh.children.slice().forEach((label) => label.removeFromParent());
    this.#copies.dispose();
    dispose(this.group);
  }
}
