/** Meshes from files: checked, mended where that is possible, and put into a scene. */

import { words } from './dom';
import type { Engine } from './engine';
import { metres } from './landings';
import { working } from './messages';
import type { MeshTold } from './panel';
import type { SceneDocument, Values } from './scene';
import type { CheckedMesh } from './told';

/** Density of a body of which nothing else is known (kg/m^3). */
const DENSITY = 500;

/** A mesh as its file has it. */
export interface MeshFile {
  name: string;
  bytes: Uint8Array;
}

/** How it is read, where the file does not tell. */
export interface Reading {
  unit?: string | undefined;
  /** Of an open sheet (m). */
  thickness?: number | undefined;
}

/** A file under a name that scenes and addresses can hold. */
export async function meshFile(file: File): Promise<MeshFile> {
  const name = file.name.replaceAll(/[^\p{L}\p{N}._-]/gu, '-');
  return { name, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/**
 * The scene with the mesh as its body.
 *
 * @throws where the mesh is none, or none that can be mended
 */
export async function withMesh(
  engine: Engine,
  scene: SceneDocument,
  { name, bytes }: MeshFile,
  { unit, thickness }: Reading,
): Promise<{ scene: SceneDocument; told: MeshTold }> {
  await engine.putFile(name, bytes);
  const checked = await working('Checking the mesh', (news) =>
    engine.call('checkMesh', [name, unit, thickness], news),
  );
  const mended = checked.mended.length > 0;
  const path = mended ? `${name}.mended.obj` : name;
  const content = mended ? await engine.call('getFile', [path]) : bytes;
  const density = (scene.get('body') as Values)['density'] ?? DENSITY;
  const ground = scene.number('run.ground', 0);
  const [x, y, z] = scene.vector('release.position');
  // High enough to fall.
  const height = Math.max(y, ground + 8 * Math.max(...checked.size));
  return {
    scene: scene.with(
      {
        body: { mesh: path, unit: mended ? 'm' : checked.unit, density },
        'release.position': [x, height, z],
      },
      name.replace(/\.[^.]*$/, ''),
      new Map([[path, content]]),
    ),
    told: {
      name,
      words: about(name, checked),
      unit: checked.unit,
      guessed: checked.unit_guessed || unit !== undefined,
      trouble: false,
      sheet: thickness !== undefined,
      thickness,
    },
  };
}

/** What is told of a mesh that cannot be used. */
export function unusable(name: string, error: unknown, { unit, thickness }: Reading): MeshTold {
  const said = words(error);
  const named = said.startsWith(name) || said.includes(`\`${name}\``);
  return {
    name,
    words: [named ? said : `${name}: ${said}`],
    unit,
    guessed: false,
    trouble: true,
    sheet: said.includes('needs a thickness'),
    thickness,
  };
}

function about(name: string, { triangles, size, mended, notices }: CheckedMesh): string[] {
  const sides = size.map(metres).join(' × ');
  return [`${name}: ${triangles.toLocaleString('en')} triangles, ${sides}`, ...mended, ...notices];
}
