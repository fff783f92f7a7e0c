/** What the engine tells the page. */

export type Vec3 = [number, number, number];
export type Quat = [number, number, number, number];

export interface SceneText {
  name: string;
  text: string;
}

/** What stands around the bodies (m, world frame). */
export interface Stage {
  ground: number | null;
  water: number | null;
  walls: [Vec3, Vec3] | null;
  planes: [Vec3, Vec3][];
  solids: { vertices: Vec3[]; triangles: Vec3[] }[];
}

export interface Description {
  name: string;
  description: string;
  world: boolean;
  kinds: string[];
  mass: number;
  volume: number;
  density: number;
  fluid: string | null;
  fluid_density: number;
  fluid_viscosity: number;
  half_extents: Vec3;
  added_mass: number[];
  falling_speed: number;
  falling_reynolds: number;
  error_estimate: number;
  notices: string[];
  time_step: number;
  gravity: Vec3;
  position: Vec3;
  orientation: Quat;
  velocity: Vec3;
  angular_velocity: Vec3;
  stage: Stage;
}

export interface BodyOfRun {
  number: number;
  kind: number;
  scale: number;
  ending: string;
  trouble: string | null;
  from: number;
}

/** The surface of a body: three numbers a vertex, three a triangle. */
export interface SkinArrays {
  positions: Float32Array;
  normals: Float32Array;
  triangles: Uint32Array;
}

/** A scene and its run. */
export interface OpenedRun {
  description: Description;
  bodies: BodyOfRun[];
  times: Float64Array;
  /** For each body seven numbers a frame, from its first: position, orientation. */
  poses: Float32Array[];
  skins: SkinArrays[];
  /** The curves one after the other, in the order of `CURVES`; empty of several bodies. */
  curves: Float32Array;
  /** Force and torque of each cause, frame by frame; empty of several bodies. */
  loads: Float32Array;
  milliseconds: { bake: number; run: number };
}

export interface Landing {
  run: number;
  ending: string;
  time: number;
  place: [number, number];
  distance: number;
  motion: string | null;
}

export interface CheckedMesh {
  triangles: number;
  size: Vec3;
  unit: string;
  unit_guessed: boolean;
  mended: string[];
  notices: string[];
}

/** The curves of a run, in the engine's order. */
export const CURVES = ['speed', 'tilt', 'spin', 'energy', 'attachment'] as const;
export type CurveName = (typeof CURVES)[number];

/** One of the curves of a run; none of several bodies. */
export function curve(run: OpenedRun, name: CurveName): Float32Array | undefined {
  const frames = run.times.length;
  const place = CURVES.indexOf(name) * frames;
  const numbers = run.curves.subarray(place, place + frames);
  return numbers.length === frames ? numbers : undefined;
}
