/** The engine as the page sees it. */

import wasm from '../engine/engine_bg.wasm?url';
import { Client } from './rpc';
import type { EngineMethods } from './worker';

export class Engine {
  readonly #client: Client<EngineMethods>;

  private constructor(client: Client<EngineMethods>) {
    this.#client = client;
  }

  /** Compiles the engine and starts it in a worker of its own. */
  static async start(): Promise<Engine> {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    const client = new Client<EngineMethods>(worker);
    await client.call('start', [await WebAssembly.compileStreaming(fetch(wasm))]);
    return new Engine(client);
  }

  /** Names of the built-in scenes. */
  sceneNames(): Promise<string[]> {
    return this.#client.call('sceneNames', []);
  }
}
