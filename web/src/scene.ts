/** A scene as text and as values that controls change. */

import { parse, stringify } from 'smol-toml';

export type Values = Record<string, unknown>;

/** A scene: its name, its values as in the TOML file, and the files that it names. */
export class SceneDocument {
  constructor(
    readonly name: string,
    readonly values: Values,
    readonly files: ReadonlyMap<string, Uint8Array> = new Map(),
  ) {}

  /** From the text of a TOML file. */
  static parse(name: string, text: string, files?: ReadonlyMap<string, Uint8Array>): SceneDocument {
    // Numbers beyond 2^53 are seeds, and keep every digit.
    return new SceneDocument(name, parse(text, { integersAsBigInt: 'asNeeded' }) as Values, files);
  }

  text(): string {
    return stringify(this.values);
  }

  /** The value at a path as `release.tilt`. */
  get(path: string): unknown {
    let value: unknown = this.values;
    for (const key of path.split('.')) {
      value = (value as Values | undefined)?.[key];
    }
    return value;
  }

  number(path: string, otherwise: number): number {
    const value = this.get(path);
    return typeof value === 'number' || typeof value === 'bigint' ? Number(value) : otherwise;
  }

  vector(path: string): [number, number, number] {
    const value = this.get(path);
    const [x, y, z] = Array.isArray(value) ? value.map(Number) : [];
    return [x ?? 0, y ?? 0, z ?? 0];
  }

  /** The scene with other values; undefined takes one away. */
  with(changes: Values, name = this.name, files = this.files): SceneDocument {
    const values = structuredClone(this.values);
    for (const [path, value] of Object.entries(changes)) {
      const keys = path.split('.');
      const last = keys.pop() ?? '';
      let table = values;
      for (const key of keys) {
        table[key] ??= {};
        table = table[key] as Values;
      }
      if (value === undefined) {
        delete table[last];
      } else {
        table[last] = value;
      }
    }
    return new SceneDocument(name, values, files);
  }
}
