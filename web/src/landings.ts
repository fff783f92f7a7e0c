/** The map of landings, which fills while drops go on in a worker of its own. */

import { colour, h, words } from './dom';
import { Engine, Stopped } from './engine';
import type { SceneDocument } from './scene';
import type { Landing } from './told';

/** Falls between two looks at the map; a multiple of what falls together. */
const TOGETHER = 64;
const MOST = 4096;

const MOTIONS: Record<string, { words: string; colour: string }> = {
  steady: { words: 'steady', colour: '#5c6bc0' },
  flutter: { words: 'flutter', colour: '#2e9d4f' },
  tumble: { words: 'tumble', colour: '#e8710a' },
  chaotic: { words: 'chaotic', colour: '#d81b76' },
};

export class Landings {
  readonly #engine = new Engine();
  readonly #canvas = h('canvas', { width: 600, height: 600 });
  readonly #told = h('p', { className: 'hint' });
  readonly #button = h('button', { type: 'button', className: 'primary' }, 'Drop many');
  #scene: SceneDocument | undefined;
  #landings: Landing[] = [];
  #running = false;
  #release: [number, number] = [0, 0];

  constructor(place: HTMLElement) {
    this.#canvas.setAttribute('role', 'img');
    const legend = h(
      'ul',
      { className: 'legend' },
      ...Object.values(MOTIONS).map(({ words, colour }) => {
        const dot = h('span', { className: 'dot' });
        dot.style.background = colour;
        return h('li', {}, dot, words);
      }),
    );
    place.append(this.#button, this.#told, this.#canvas, legend);
    this.#button.addEventListener('click', () => (this.#running ? this.stop() : void this.#run()));
    this.#draw();
  }

  /** Another scene: the map is empty. */
  show(scene: SceneDocument): void {
    this.stop();
    this.#scene = scene;
    this.#landings = [];
    const [x, , z] = scene.vector('release.position');
    this.#release = [x, z];
    this.#draw();
  }

  recolour(): void {
    this.#draw();
  }

  stop(): void {
    if (this.#running) {
      this.#running = false;
      this.#engine.stop();
      this.#draw();
    }
  }

  async #run(): Promise<void> {
    const scene = this.#scene;
    if (scene === undefined) {
      return;
    }
    this.#running = true;
    if (this.#landings.length >= MOST) {
      this.#landings = [];
    }
    this.#draw();
    try {
      for (const [path, bytes] of scene.files) {
        await this.#engine.putFile(path, bytes);
      }
      await this.#engine.call('prepare', ['landings', scene.name, scene.text()]);
      while (this.#running && this.#scene === scene && this.#landings.length < MOST) {
        const from = this.#landings.length;
        const landings = await this.#engine.call('landings', ['landings', from, from + TOGETHER]);
        this.#landings.push(...landings);
        this.#draw();
      }
      this.#running = false;
      this.#draw();
    } catch (error) {
      this.#running = false;
      this.#draw();
      if (!(error instanceof Stopped)) {
        this.#told.textContent = words(error);
        this.#told.classList.add('trouble');
      }
    }
  }

  #draw(): void {
    const down = this.#landings.filter(({ ending }) => ending === 'ground' || ending === 'rest');
    this.#button.textContent = this.#running
      ? 'Stop'
      : this.#landings.length > 0 && this.#landings.length < MOST
        ? 'Go on'
        : 'Drop many';
    this.#told.classList.remove('trouble');
    this.#told.textContent = this.#summary(down);
    this.#canvas.setAttribute('aria-label', `Map of landings. ${this.#told.textContent}`);
    const paint = this.#canvas.getContext('2d');
    if (paint !== null) {
      this.#paint(paint, down);
    }
  }

  #summary(down: Landing[]): string {
    if (this.#landings.length === 0) {
      return 'Where it lands over many drops, each with its own release and turbulence.';
    }
    const distances = down.map(({ distance }) => distance).sort((a, b) => a - b);
    const middle = distances[distances.length >> 1];
    const many = `${down.length} of ${this.#landings.length} landed`;
    return middle === undefined
      ? `${many}.`
      : `${many}; half within ${metres(middle)} of the point below the release.`;
  }

  #paint(paint: CanvasRenderingContext2D, down: Landing[]): void {
    const { width, height } = this.#canvas;
    paint.fillStyle = colour('surface');
    paint.fillRect(0, 0, width, height);
    const distances = down.map(({ distance }) => distance).sort((a, b) => a - b);
    // All but the farthest of a hundred.
    const reach = Math.max(distances[Math.floor(0.99 * distances.length)] ?? 0.5, 1e-3) * 1.15;
    const scale = width / 2 / reach;
    const step = ring(reach);
    paint.strokeStyle = colour('line');
    paint.lineWidth = 2;
    for (let radius = step; radius < 1.4 * reach; radius += step) {
      paint.beginPath();
      paint.arc(width / 2, height / 2, radius * scale, 0, 2 * Math.PI);
      paint.stroke();
    }
    paint.globalAlpha = 0.75;
    for (const { place, motion } of down) {
      paint.fillStyle = MOTIONS[motion ?? '']?.colour ?? colour('accent');
      paint.beginPath();
      const [x, y] = [place[0] - this.#release[0], place[1] - this.#release[1]];
      paint.arc(width / 2 + x * scale, height / 2 + y * scale, 5, 0, 2 * Math.PI);
      paint.fill();
    }
    paint.globalAlpha = 1;
    this.#name(paint, step, 1.4 * reach, scale);
    paint.strokeStyle = colour('text');
    paint.lineWidth = 3;
    paint.beginPath();
    paint.moveTo(width / 2 - 10, height / 2);
    paint.lineTo(width / 2 + 10, height / 2);
    paint.moveTo(width / 2, height / 2 - 10);
    paint.lineTo(width / 2, height / 2 + 10);
    paint.stroke();
  }

  /** Says how far the rings are, over what lies there. */
  #name(paint: CanvasRenderingContext2D, step: number, end: number, scale: number): void {
    const { width, height } = this.#canvas;
    paint.font = '22px system-ui';
    paint.lineWidth = 6;
    paint.lineJoin = 'round';
    paint.strokeStyle = colour('surface');
    paint.fillStyle = colour('text');
    for (let radius = step; radius < end; radius += step) {
      const top = height / 2 - radius * scale - 6;
      if (top > 24) {
        paint.strokeText(metres(radius), width / 2 + 6, top);
        paint.fillText(metres(radius), width / 2 + 6, top);
      }
    }
  }
}

/** A round distance, a few of which fit. */
function ring(reach: number): number {
  const power = 10 ** Math.floor(Math.log10(reach));
  return [0.2, 0.5, 1].map((step) => step * power).find((step) => reach / step < 5) ?? 2 * power;
}

/** A length in words. */
export function metres(length: number): string {
  const size = Math.abs(length);
  if (size >= 1) {
    return `${Number(length.toPrecision(3))} m`;
  }
  return size >= 0.01
    ? `${Number((100 * length).toPrecision(3))} cm`
    : `${Number((1000 * length).toPrecision(3))} mm`;
}
