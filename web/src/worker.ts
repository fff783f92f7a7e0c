/** The engine's thread: WebAssembly behind calls. */

import {
  Many,
  type Run,
  Session,
  type Skin,
  built_in_scenes,
  cause_names,
  check_mesh,
  get_file,
  initSync,
  put_file,
  version,
} from '../engine/engine.js';
import type { BodyOfRun, CheckedMesh, Description, Landing, OpenedRun, SceneText } from './told';
import { type OnProgress, serve } from './rpc';

/** What is open under a name. */
interface Place {
  session: Session;
  run: Run | undefined;
  skin: Skin | undefined;
}

const places = new Map<string, Place>();
let many: Many | undefined;

function place(slot: string): Place {
  const found = places.get(slot);
  if (found === undefined) {
    throw new Error('the scene is not open any more');
  }
  return found;
}

function close(slot: string): void {
  const { session, run, skin } = places.get(slot) ?? {};
  places.delete(slot);
  skin?.free();
  run?.free();
  session?.free();
}

/** Progress of the call under way. */
let progress: OnProgress = () => {};
Object.assign(globalThis, {
  reportProgress: (stage: string, fraction: number) => progress({ stage, fraction }),
});

/** A session in the place of what was open there. */
function opened(slot: string, name: string, text: string): Session {
  const session = new Session(name, text);
  close(slot);
  places.set(slot, { session, run: undefined, skin: undefined });
  return session;
}

const methods = {
  /** Comes before all else. */
  start(_onProgress: OnProgress, module: WebAssembly.Module): { version: string; causes: string[] } {
    initSync({ module });
    return { version: version(), causes: cause_names() };
  },

  scenes(): SceneText[] {
    return JSON.parse(built_in_scenes()) as SceneText[];
  },

  putFile(_onProgress: OnProgress, path: string, bytes: Uint8Array): void {
    put_file(path, bytes);
  },

  getFile(_onProgress: OnProgress, path: string): Uint8Array {
    return get_file(path);
  },

  checkMesh(
    onProgress: OnProgress,
    path: string,
    unit: string | undefined,
    thickness: number | undefined,
  ): CheckedMesh {
    progress = onProgress;
    return JSON.parse(check_mesh(path, unit, thickness)) as CheckedMesh;
  },

  /** Bakes a scene and drops its bodies; `tables` are those of a run that was made before. */
  open(
    onProgress: OnProgress,
    slot: string,
    name: string,
    text: string,
    tables?: { trajectory: string; bodies?: string | undefined },
  ): OpenedRun {
    progress = onProgress;
    const begun = performance.now();
    const session = new Session(name, text);
    const baked = performance.now();
    let run: Run;
    try {
      run = tables === undefined ? session.drop() : session.replay(tables.trajectory, tables.bodies);
    } catch (error) {
      session.free();
      throw error;
    }
    const ended = performance.now();
    close(slot);
    const description = JSON.parse(session.describe()) as Description;
    const bodies = JSON.parse(run.bodies()) as BodyOfRun[];
    const skins = description.kinds.map((_, kind) => session.skin(kind));
    places.set(slot, { session, run, skin: skins[0] });
    const shown = skins.map((skin) => ({
      positions: skin.positions(),
      normals: skin.normals(),
      triangles: skin.triangles(),
    }));
    skins.slice(1).forEach((skin) => skin.free());
    return {
      description,
      bodies,
      times: run.times(),
      poses: bodies.map((_, body) => run.poses(body)),
      skins: shown,
      curves: session.curves(run),
      loads: session.loads(run),
      milliseconds: { bake: baked - begun, run: ended - baked },
    };
  },

  close(_onProgress: OnProgress, slot: string): void {
    close(slot);
  },

  pressures(_onProgress: OnProgress, slot: string, frame: number): Float32Array {
    const { session, run, skin } = place(slot);
    return run === undefined || skin === undefined ? new Float32Array() : session.pressures(skin, run, frame);
  },

  /** Makes a scene ready for `landings` alone. */
  prepare(onProgress: OnProgress, slot: string, name: string, text: string): void {
    progress = onProgress;
    opened(slot, name, text);
  },

  landings(_onProgress: OnProgress, slot: string, from: number, to: number): Landing[] {
    return JSON.parse(place(slot).session.landings(from, to)) as Landing[];
  },

  export(_onProgress: OnProgress, slot: string, format: string, fps: number): Uint8Array {
    const { session, run } = place(slot);
    if (run === undefined) {
      throw new Error('there is no run to export');
    }
    return session.export(run, format, fps);
  },

  /** Lets many bodies of a scene go; their room and their shape. */
  startMany(onProgress: OnProgress, name: string, text: string, count: number) {
    progress = onProgress;
    many?.free();
    const session = opened('many', name, text);
    many = new Many(session, count);
    const skin = session.coarse_skin();
    const shape = {
      positions: skin.positions(),
      normals: skin.normals(),
      triangles: skin.triangles(),
    };
    skin.free();
    return { room: many.room(), shape, poses: many.poses() };
  },

  /** Moves them on; how long that took (ms). */
  advanceMany(_onProgress: OnProgress, duration: number): { poses: Float32Array; milliseconds: number } {
    const { session } = place('many');
    const begun = performance.now();
    many?.advance(session, duration);
    const milliseconds = performance.now() - begun;
    return { poses: many?.poses() ?? new Float32Array(), milliseconds };
  },
};

export type EngineMethods = typeof methods;

serve(methods);
