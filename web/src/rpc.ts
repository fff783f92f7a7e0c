/** Calls from the page to its worker: `{id, method, args}` there; `{id, progress}`, then `{id, value}` or `{id, error}` back. */

/** How far a call is. */
export interface Progress {
  stage: string;
  /** Of this stage, from 0 to 1. */
  fraction: number;
}

/** Takes news of a call. */
export type OnProgress = (progress: Progress) => void;

/** What a worker answers: by name, functions that are told where news goes and then what they were called with. */
export type Methods = { [name: string]: (onProgress: OnProgress, ...args: never[]) => unknown };

type Args<F> = F extends (onProgress: OnProgress, ...args: infer A) => unknown ? A : never;
type Value<F> = F extends (...args: never[]) => infer V ? Awaited<V> : never;

interface Request {
  id: number;
  method: string;
  args: never[];
}

type Reply =
  { id: number; progress: Progress } | { id: number; value: unknown } | { id: number; error: string };

interface Pending {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
  onProgress: OnProgress | undefined;
}

/** The page's end. */
export class Client<M extends Methods> {
  readonly #worker: Worker;
  readonly #pending = new Map<number, Pending>();
  #last = 0;

  constructor(worker: Worker) {
    this.#worker = worker;
    worker.addEventListener('message', ({ data }: MessageEvent<Reply>) => this.#take(data));
    worker.addEventListener('error', (event) =>
      this.fail(new Error(event.message || 'the engine did not load')),
    );
  }

  /** What the method returns; rejected with what it throws. */
  call<K extends keyof M & string>(
    method: K,
    args: Args<M[K]>,
    onProgress?: OnProgress,
  ): Promise<Value<M[K]>> {
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#pending.set(id, { resolve, reject, onProgress });
      this.#worker.postMessage({ id, method, args });
    });
  }

  #take(reply: Reply): void {
    const pending = this.#pending.get(reply.id);
    if (pending === undefined) {
      return;
    }
    if ('progress' in reply) {
      pending.onProgress?.(reply.progress);
      return;
    }
    this.#pending.delete(reply.id);
    if ('error' in reply) {
      pending.reject(new Error(reply.error));
    } else {
      pending.resolve(reply.value as never);
    }
  }

  /** Ends all calls that are waited for. */
  fail(error: Error): void {
    for (const { reject } of this.#pending.values()) {
      reject(error);
    }
    this.#pending.clear();
  }
}

/** The worker's end: answers calls of these methods. */
export function serve(methods: Methods): void {
  const reply = (message: Reply): void => self.postMessage(message);
  self.addEventListener('message', async ({ data: { id, method, args } }: MessageEvent<Request>) => {
    try {
      const call = methods[method];
      if (call === undefined) {
        throw new Error(`there is no method ${method}`);
      }
      reply({ id, value: await call((progress) => reply({ id, progress }), ...args) });
    } catch (error) {
      reply({ id, error: error instanceof Error ? error.message : String(error) });
    }
  });
}
