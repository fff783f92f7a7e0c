/** The engine's thread: WebAssembly behind calls. */

import { built_in_scenes, initSync } from '../engine/engine.js';
import { type OnProgress, serve } from './rpc';

const methods = {
  /** Comes before all else. */
  start(_onProgress: OnProgress, module: WebAssembly.Module): void {
    initSync({ module });
  },

  sceneNames(): string[] {
    const scenes = JSON.parse(built_in_scenes()) as { name: string }[];
    return scenes.map(({ name }) => name);
  },
};

export type EngineMethods = typeof methods;

serve(methods);
