/** The address bar: a whole scene in the fragment of an address, which no server sees. */

import { SceneDocument } from './scene';

/** Longest fragment: browsers and messengers cut longer addresses. */
const LONGEST = 60_000;

async function through(bytes: Uint8Array, stream: GenericTransformStream): Promise<Uint8Array> {
  const piped = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair);
  return new Uint8Array(await new Response(piped as ReadableStream).arrayBuffer());
}

async function pack(bytes: Uint8Array): Promise<string> {
  const packed = await through(bytes, new CompressionStream('deflate-raw'));
  let text = '';
  for (const byte of packed) {
    text += String.fromCharCode(byte);
  }
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

async function unpack(text: string): Promise<Uint8Array> {
  const raw = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  const bytes = Uint8Array.from(raw, (letter) => letter.charCodeAt(0));
  return through(bytes, new DecompressionStream('deflate-raw'));
}

/** What a fragment holds. */
export interface Linked {
  scene: SceneDocument;
  /** Of the engine that made the link, if it says. */
  version: string | undefined;
}

/** The fragment of a scene; none where its files are too long for an address. */
export async function toFragment(scene: SceneDocument, version: string): Promise<string | undefined> {
  const parts = new URLSearchParams();
  parts.set('version', version);
  parts.set('name', scene.name);
  parts.set('scene', await pack(new TextEncoder().encode(scene.text())));
  for (const [path, bytes] of scene.files) {
    parts.append('file', `${path}:${await pack(bytes)}`);
  }
  const fragment = `#${parts}`;
  return fragment.length <= LONGEST ? fragment : undefined;
}

/**
 * The scene of a fragment; none where there is none. `#leaf` is the built-in scene of that name.
 *
 * @throws where the fragment is damaged
 */
export async function ofFragment(
  fragment: string,
  builtIn: (name: string) => string | undefined,
): Promise<Linked | undefined> {
  const bare = decodeURIComponent(fragment.replace(/^#/, ''));
  const text = builtIn(bare);
  if (text !== undefined) {
    return { scene: SceneDocument.parse(bare, text), version: undefined };
  }
  const parts = new URLSearchParams(fragment.replace(/^#/, ''));
  const packed = parts.get('scene');
  if (packed === null) {
    if (bare !== '') {
      throw new Error(`the link names no scene: there is none called “${bare}”`);
    }
    return undefined;
  }
  try {
    const files = new Map<string, Uint8Array>();
    for (const file of parts.getAll('file')) {
      const end = file.lastIndexOf(':');
      files.set(file.slice(0, end), await unpack(file.slice(end + 1)));
    }
    const text = new TextDecoder('utf-8', { fatal: true }).decode(await unpack(packed));
    const scene = SceneDocument.parse(parts.get('name') ?? 'scene', text, files);
    return { scene, version: parts.get('version') ?? undefined };
  } catch {
    throw new Error('the link is damaged: a part of it is missing or was changed');
  }
}
