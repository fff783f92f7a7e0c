/** The engine's thread: WebAssembly behind calls. */

import { initSync, scene_names } from '../engine/engine.js';
import { type OnProgress, serve } from './rpc';

const methods = {
  /** Comes before all else. */
  start(_onProgress: OnProgress, module: WebAssembly.Module): void {
    initSync({ module });
  },

  sceneNames(): string[] {
    return scene_names();
  },
};

export type EngineMethods = typeof methods;

serve(methods);
