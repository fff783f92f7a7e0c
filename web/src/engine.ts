/** The engine as the page sees it: a worker that can be stopped and started again. */

import wasm from '../engine/engine_bg.wasm?url';
import { Client, type OnProgress } from './rpc';
import type { EngineMethods } from './worker';

/** Compiled once, for all workers. */
const compiled = WebAssembly.compileStreaming(fetch(wasm));

type Call = Client<EngineMethods>['call'];

/** Why a call has no answer: it was stopped. */
export class Stopped extends Error {
  constructor() {
    super('stopped');
  }
}

export class Engine {
  #worker: Worker | undefined;
  #client: Promise<Client<EngineMethods>> | undefined;
  readonly #files = new Map<string, Uint8Array>();
  about = { version: '', causes: [] as string[] };

  /** Calls a method, in a worker that is started where none runs. */
  readonly call: Call = async (method, args, onProgress?: OnProgress) => {
    this.#client ??= this.#start();
    return (await this.#client).call(method, args, onProgress);
  };

  /** Hands a file over, also to workers that are started later. */
  async putFile(path: string, bytes: Uint8Array): Promise<void> {
    this.#files.set(path, bytes);
    await this.call('putFile', [path, bytes]);
  }

  /** Ends what is under way; those who wait for it hear `Stopped`. What was open is closed. */
  stop(): void {
    this.#worker?.terminate();
    const client = this.#client;
    this.#client = undefined;
    void client?.then((client) => client.fail(new Stopped()));
  }

  async #start(): Promise<Client<EngineMethods>> {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    this.#worker = worker;
    const client = new Client<EngineMethods>(worker);
    this.about = await client.call('start', [await compiled]);
    for (const [path, bytes] of this.#files) {
      await client.call('putFile', [path, bytes]);
    }
    return client;
  }
}
