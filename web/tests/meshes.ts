/** A small box as a mesh, and as files of it. */

export type Triple = [number, number, number];

export interface Mesh {
  vertices: Triple[];
  triangles: Triple[];
}

/** Of 60 by 3 by 40. */
export const BOX: Mesh = {
  vertices: [
    [0, 0, 0],
    [60, 0, 0],
    [60, 3, 0],
    [0, 3, 0],
    [0, 0, 40],
    [60, 0, 40],
    [60, 3, 40],
    [0, 3, 40],
  ],
  triangles: [
    [0, 2, 1],
    [0, 3, 2],
    [4, 5, 6],
    [4, 6, 7],
    [0, 1, 5],
    [0, 5, 4],
    [3, 7, 6],
    [3, 6, 2],
    [0, 4, 7],
    [0, 7, 3],
    [1, 2, 6],
    [1, 6, 5],
  ],
};

/** Its lower side alone: a sheet without thickness. */
export const SHEET: Mesh = { vertices: BOX.vertices, triangles: BOX.triangles.slice(4, 6) };

export function obj({ vertices, triangles }: Mesh): string {
  const lines = [
    ...vertices.map((vertex) => `v ${vertex.join(' ')}`),
    ...triangles.map((triangle) => `f ${triangle.map((corner) => corner + 1).join(' ')}`),
  ];
  return `${lines.join('\n')}\n`;
}

/** Binary. */
export function stl({ vertices, triangles }: Mesh): Buffer {
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((triangle, facet) => {
    const corners = triangle.flatMap((corner) => vertices[corner] ?? []);
    corners.forEach((number, place) => bytes.writeFloatLE(number, 96 + 50 * facet + 4 * place));
  });
  return bytes;
}

export function ply({ vertices, triangles }: Mesh): string {
  return [
    'ply',
    'format ascii 1.0',
    `element vertex ${vertices.length}`,
    'property float x',
    'property float y',
    'property float z',
    `element face ${triangles.length}`,
    'property list uchar int vertex_indices',
    'end_header',
    ...vertices.map((vertex) => vertex.join(' ')),
    ...triangles.map((triangle) => `3 ${triangle.join(' ')}`),
    '',
  ].join('\n');
}

/** Metres, as glTF has them: of 60 by 3 by 40 mm. */
export function glb({ vertices, triangles }: Mesh): Buffer {
  const positions = vertices.map((vertex) => vertex.map((number) => number / 1000));
  const floats = Buffer.from(new Float32Array(positions.flat()).buffer);
  const indices = Buffer.from(new Uint32Array(triangles.flat()).buffer);
  const binary = Buffer.concat([floats, indices]);
  const axis = (of: (...numbers: number[]) => number): number[] =>
    [0, 1, 2].map((place) => of(...positions.map((position) => Math.fround(position[place] ?? 0))));
  const json = JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        count: vertices.length,
        type: 'VEC3',
        min: axis(Math.min),
        max: axis(Math.max),
      },
      { bufferView: 1, componentType: 5125, count: 3 * triangles.length, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: floats.length },
      { buffer: 0, byteOffset: floats.length, byteLength: indices.length },
    ],
    buffers: [{ byteLength: binary.length }],
  });
  const text = Buffer.from(json.padEnd(4 * Math.ceil(json.length / 4)));
  const chunk = (kind: string, bytes: Buffer): Buffer => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length);
    head.write(kind, 4, 'latin1');
    return Buffer.concat([head, bytes]);
  };
  const head = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  head.writeUInt32LE(12 + 8 + text.length + 8 + binary.length, 8);
  return Buffer.concat([head, chunk('JSON', text), chunk('BIN\0', binary)]);
}
