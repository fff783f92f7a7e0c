/** Pressures as colours: blue is suction, red is push. */

import { Color } from 'three';

const RAMP = ['#2166ac', '#92c5de', '#f7f7f7', '#f4a582', '#b2182b'].map((at) => new Color(at));

/** Colours of pressures between -`most` and `most` (Pa), three numbers each. */
export function coloured(pressures: Float32Array, most: number): Float32Array {
  const colours = new Float32Array(3 * pressures.length);
  const mixed = new Color();
  pressures.forEach((pressure, vertex) => {
    const place = 2 + 2 * Math.min(1, Math.max(-1, pressure / most));
    const below = Math.min(3, Math.floor(place));
    mixed.lerpColors(RAMP[below] ?? mixed, RAMP[below + 1] ?? mixed, place - below);
    mixed.toArray(colours, 3 * vertex);
  });
  return colours;
}

/** A pressure that all but a few of the strongest stay below (Pa): edges have suction without bound. */
export function typical(pressures: Float32Array): number {
  const sizes = pressures.map(Math.abs).sort();
  return Math.max(sizes[Math.floor(0.9 * sizes.length)] ?? 0, 1e-9);
}
