/** Bodies and fluids to choose from. */

import type { Values } from './scene';

export interface Choice {
  words: string;
  values: Values;
  /** Its look. */
  colour: string;
}

/** Colours of bodies by their shape, where the scene names none of `BODIES`. */
export const LOOKS: Record<string, string> = {
  leaf: '#d2691e',
  box: '#f2efe6',
  disc: '#f2efe6',
  coin: '#c98f4e',
  ellipsoid: '#d94f4f',
  cylinder: '#b98b5e',
  washer: '#9aa5ad',
  'elliptical-plate': '#8fb4c9',
  'paper-airplane': '#f2efe6',
  feather: '#e9e4dc',
  samara: '#b5793f',
};

/** The built-in shapes with dimensions that suit them. Airplane and maple seed are those of the scenes of their names. */
export const BODIES: Record<string, { words: string; values?: Values; scene?: string }> = {
  leaf: {
    words: 'Leaf',
    values: { shape: 'leaf', length: 0.08, width: 0.05, thickness: 3e-4, triangles: 1280, density: 400 },
  },
  sheet: {
    words: 'Sheet of paper',
    values: { shape: 'box', size: [0.148, 1e-4, 0.105], triangles: 1200, density: 800 },
  },
  card: {
    words: 'Business card',
    values: { shape: 'box', size: [0.085, 3e-4, 0.055], density: 900 },
  },
  disc: {
    words: 'Paper disc',
    values: { shape: 'disc', radius: 0.03, thickness: 3e-4, density: 800 },
  },
  coin: {
    words: 'Coin',
    values: { shape: 'coin', diameter: 0.0245, thickness: 0.00255, mass: 0.00762 },
  },
  washer: {
    words: 'Washer',
    values: {
      shape: 'washer',
      diameter: 0.03,
      inner_diameter: 0.012,
      thickness: 0.002,
      density: 7850,
    },
  },
  ball: {
    words: 'Ball',
    values: { shape: 'ellipsoid', semi_axes: [0.02, 0.02, 0.02], triangles: 1280, density: 1200 },
  },
  ellipsoid: {
    words: 'Ellipsoid',
    values: { shape: 'ellipsoid', semi_axes: [0.03, 0.01, 0.02], triangles: 1280, density: 1200 },
  },
  plate: {
    words: 'Elliptical plate',
    values: { shape: 'elliptical-plate', semi_axes: [0.05, 0.03], thickness: 0.001, density: 1200 },
  },
  cylinder: {
    words: 'Stick',
    values: { shape: 'cylinder', radius: 0.004, height: 0.12, density: 600 },
  },
  feather: { words: 'Feather', scene: 'feather' },
  airplane: { words: 'Paper airplane', scene: 'airplane' },
  seed: { words: 'Maple seed', scene: 'maple-seed' },
};

/** Fluids. Honey: 1.42 g/cm^3 and 10 Pa s at 20 degrees. */
export const FLUIDS: Record<string, { words: string; values: Values }> = {
  air: { words: 'Air', values: { preset: 'air' } },
  water: { words: 'Water', values: { preset: 'water' } },
  honey: { words: 'Honey', values: { density: 1420, viscosity: 7e-3 } },
};

/** Models, with the integrator that each is meant for. */
export const MODELS: Record<string, string> = {
  separated: 'Separated flow: flutters and tumbles',
  consistent: 'Langevin, consistent',
  published: 'Langevin, as printed in the paper',
  kirchhoff: 'Kirchhoff: no drag at all',
};
