/** The picture: camera, light, ground, and what stands and falls there. */

import {
  AmbientLight,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  CircleGeometry,
  DirectionalLight,
  DoubleSide,
  EdgesGeometry,
  Fog,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  MeshStandardMaterial,
  Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  RepeatWrapping,
  SRGBColorSpace,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { CSS2DRenderer } from 'three/addons/renderers/CSS2DRenderer.js';
import { colour } from './dom';
import type { Stage } from './told';

const UP = new Vector3(0, 1, 0);

/** Frees what an object and all below it hold on the graphics card. */
export function dispose(object: Object3D): void {
  object.removeFromParent();
  object.traverse((part) => {
    if (part instanceof Mesh || part instanceof LineSegments) {
      part.geometry.dispose();
      for (const material of [part.material].flat()) {
        (material as MeshStandardMaterial).map?.dispose();
        material.dispose();
      }
    }
  });
}

export class View {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(38, 1, 1e-4, 1000);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #labels = new CSS2DRenderer();
  readonly #sun = new DirectionalLight(0xffffff, 1.9);
  #surroundings = new Group();
  #ground = 0;
  /** Size of what is looked at (m). */
  #scale = 0.1;
  /** Whether the picture is no longer what was drawn last. */
  #stale = true;
  /** Where the camera was then, and what it looked at. */
  readonly #from = new Vector3();
  readonly #to = new Vector3();

  /** @throws where the browser has no WebGL2 */
  constructor(readonly frame: HTMLElement) {
    this.#renderer = new WebGLRenderer({ antialias: true });
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.shadowMap.type = PCFShadowMap;
    this.canvas = this.#renderer.domElement;
    this.canvas.addEventListener('webglcontextrestored', () => this.changed());
    this.#labels.domElement.className = 'labels';
    this.frame.append(this.canvas, this.#labels.domElement);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = true;
    this.#sun.castShadow = true;
    this.#sun.shadow.mapSize.set(2048, 2048);
    this.scene.add(
      new HemisphereLight(0xffffff, 0xb5b5a2, 1.7),
      new AmbientLight(0xffffff, 0.5),
      this.#sun,
      this.#sun.target,
      this.#surroundings,
    );
    this.recolour();
    new ResizeObserver(() => this.resize()).observe(frame);
    this.resize();
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.frame;
    if (width > 0 && height > 0) {
      this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      this.#renderer.setSize(width, height);
      this.#labels.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.changed();
    }
  }

  /** What is in the picture is not where it was, or looks different: the next frame draws it. */
  changed(): void {
    this.#stale = true;
  }

  /** Takes the colours of the page's theme. */
  recolour(): void {
    const canvas = Object.assign(document.createElement('canvas'), { width: 2, height: 256 });
    const paint = canvas.getContext('2d');
    if (paint !== null) {
      const sky = paint.createLinearGradient(0, 0, 0, 256);
      sky.addColorStop(0, colour('sky-top'));
      sky.addColorStop(0.45, colour('sky-bottom'));
      paint.fillStyle = sky;
      paint.fillRect(0, 0, 2, 256);
    }
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = SRGBColorSpace;
    this.scene.background = texture;
    this.#stage?.();
    this.changed();
  }

  #stage: (() => void) | undefined;

  /** Puts up what stands around bodies of this size (m), over an area of this radius (m) around a place. */
  surround(stage: Stage, scale: number, centre: Vector3, radius: number): void {
    this.#scale = scale;
    this.#stage = () => {
      dispose(this.#surroundings);
      this.scene.fog?.color.set(colour('sky-bottom'));
      this.#surroundings = surroundings(stage, scale, centre, radius);
      this.scene.add(this.#surroundings);
    };
    this.#stage();
    this.#ground = stage.ground ?? Number.NEGATIVE_INFINITY;
    this.scene.fog = new Fog(colour('sky-bottom'), 5 * radius, 12 * radius);
    this.camera.near = scale / 200;
    this.camera.far = Math.max(200 * scale, 60 * radius);
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = scale;
    this.controls.maxDistance = 20 * radius;
    this.changed();
  }

  /** Looks at a place from a distance (m), from where it looked before. */
  lookAt(place: Vector3, distance?: number): void {
    const from = this.camera.position.clone().sub(this.controls.target);
    if (distance !== undefined) {
      from.setLength(distance);
    }
    this.controls.target.copy(place);
    this.camera.position.copy(place).add(from);
  }

  /** Looks from here, a direction. */
  lookFrom(direction: Vector3): void {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.position
      .copy(direction)
      .setLength(distance || 1)
      .add(this.controls.target);
  }

  /** Turns the camera around what it looks at (radians), and moves it nearer or farther by a factor. */
  orbit(heading: number, height: number, distance: number): void {
    const from = this.camera.position.clone().sub(this.controls.target);
    const across = new Vector3().crossVectors(from, UP).normalize();
    from.applyQuaternion(new Quaternion().setFromAxisAngle(UP, heading));
    const raised = from.clone().applyQuaternion(new Quaternion().setFromAxisAngle(across, height));
    // Not over the top.
    if (Math.abs(raised.clone().normalize().y) < 0.98) {
      from.copy(raised);
    }
    this.camera.position.copy(this.controls.target).add(from.multiplyScalar(distance));
  }

  /** Whether the picture is no longer what was drawn last: something changed, or the camera moved. */
  get stale(): boolean {
    const { position } = this.camera;
    const { target } = this.controls;
    // The camera's controls round.
    const least = 1e-12 * position.distanceToSquared(target);
    const moved =
      position.distanceToSquared(this.#from) > least || target.distanceToSquared(this.#to) > least;
    return this.#stale || moved;
  }

  /** Draws; how long that took (ms), without what the graphics card does after. */
  draw(): number {
    const begun = performance.now();
    this.controls.update();
    // The camera stays above the ground.
    const floor = this.#ground + 0.2 * this.#scale;
    this.camera.position.y = Math.max(this.camera.position.y, floor);
    this.#light();
    this.#renderer.render(this.scene, this.camera);
    this.#labels.render(this.scene, this.camera);
    this.#from.copy(this.camera.position);
    this.#to.copy(this.controls.target);
    this.#stale = false;
    return performance.now() - begun;
  }

  /** Shadows of what is looked at are sharp. */
  #light(): void {
    const reach = Math.max(2 * this.#scale, this.camera.position.distanceTo(this.controls.target));
    const target = this.controls.target;
    this.#sun.target.position.copy(target);
    this.#sun.position
      .set(0.45, 1, 0.35)
      .multiplyScalar(4 * reach)
      .add(target);
    const box = this.#sun.shadow.camera;
    const half = 1.2 * reach;
    Object.assign(box, { left: -half, right: half, top: half, bottom: -half, near: 0, far: 12 * reach });
    box.updateProjectionMatrix();
    this.#sun.shadow.normalBias = reach / 400;
  }

  /** The picture as PNG. */
  png(): Promise<Blob> {
    // What was drawn before is no longer in the canvas to be read.
    this.draw();
    return new Promise((resolve, reject) =>
      this.canvas.toBlob(
        (blob) => (blob === null ? reject(new Error('the browser gave no picture')) : resolve(blob)),
        'image/png',
      ),
    );
  }
}

/** Distance of the lines on the ground (m): a round number about the size of the body. */
export function gridStep(scale: number): number {
  const power = 10 ** Math.floor(Math.log10(2 * scale));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= scale) ?? power;
}

function surroundings(stage: Stage, scale: number, centre: Vector3, radius: number): Group {
  const group = new Group();
  const reach = 4 * radius;
  if (stage.ground !== null) {
    const step = gridStep(scale);
    // As many whole cells as make a ground without end, which the fog hides.
    const half = 8 * step * Math.ceil((12 * radius) / (8 * step));
    const ground = new Mesh(
      new CircleGeometry(half, 96).rotateX(-Math.PI / 2),
      new MeshLambertMaterial({ map: lines(step, 2 * half) }),
    );
    ground.receiveShadow = true;
    const round = (place: number): number => Math.round(place / step) * step;
    ground.position.set(round(centre.x), stage.ground - 1e-3 * scale, round(centre.z));
    group.add(ground);
  }
  if (stage.water !== null) {
    const water = new Mesh(
      new PlaneGeometry(2 * reach, 2 * reach).rotateX(-Math.PI / 2),
      new MeshStandardMaterial({
        color: colour('water'),
        transparent: true,
        opacity: 0.55,
        roughness: 0.2,
        side: DoubleSide,
        depthWrite: false,
      }),
    );
    water.position.set(centre.x, stage.water, centre.z);
    group.add(water);
  }
  if (stage.walls !== null) {
    const [low, high] = stage.walls.map((corner) => new Vector3(...corner)) as [Vector3, Vector3];
    const sides = high.clone().sub(low);
    const box = new BoxGeometry(sides.x, sides.y, sides.z);
    const edges = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial({ color: colour('muted') }));
    box.dispose();
    edges.position.copy(low).add(high).multiplyScalar(0.5);
    group.add(edges);
  }
  for (const [point, normal] of stage.planes) {
    const plane = new Mesh(
      new PlaneGeometry(2 * reach, 2 * reach),
      new MeshLambertMaterial({ color: colour('ground'), side: DoubleSide }),
    );
    plane.position.set(...point);
    plane.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...normal).normalize());
    plane.receiveShadow = true;
    group.add(plane);
  }
  for (const { vertices, triangles } of stage.solids) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(vertices.flat()), 3));
    geometry.setIndex(triangles.flat());
    const flat = geometry.toNonIndexed();
    geometry.dispose();
    flat.computeVertexNormals();
    const solid = new Mesh(flat, new MeshStandardMaterial({ color: colour('solid'), roughness: 0.9 }));
    solid.castShadow = solid.receiveShadow = true;
    group.add(solid);
  }
  return group;
}

/** Lines at every `step` (m), on a surface whose texture is `across` wide (m). */
function lines(step: number, across: number): CanvasTexture {
  const cells = 4;
  const canvas = Object.assign(document.createElement('canvas'), { width: 512, height: 512 });
  const paint = canvas.getContext('2d');
  if (paint !== null) {
    paint.fillStyle = colour('ground');
    paint.fillRect(0, 0, 512, 512);
    paint.fillStyle = colour('grid');
    paint.globalAlpha = 0.5;
    for (let cell = 0; cell < cells; cell++) {
      const at = (cell * 512) / cells;
      paint.fillRect(at, 0, 3, 512);
      paint.fillRect(0, at, 512, 3);
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.setScalar(across / (cells * step));
  texture.anisotropy = 16;
  return texture;
}
