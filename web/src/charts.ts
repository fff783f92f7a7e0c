/** Curves of a run over time; the pointer over one shows its moment in the picture. */

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { colour, h } from './dom';
import { frameAt } from './playback';
import { type CurveName, type OpenedRun, curve } from './told';

/** Points of a curve at most: more than a screen has. */
const MOST = 1200;

const SHOWN: { name: CurveName; title: string; unit: string; digits: number; ticks?: number[] }[] = [
  { name: 'speed', title: 'Speed', unit: 'm/s', digits: 2 },
  { name: 'tilt', title: 'Tilt', unit: '°', digits: 0, ticks: [0, 90, 180] },
  { name: 'spin', title: 'Spin', unit: 'turns/s', digits: 2 },
  { name: 'energy', title: 'Energy', unit: 'mJ', digits: 3 },
  { name: 'attachment', title: 'Attachment of the flow', unit: '', digits: 2, ticks: [0, 0.5, 1] },
];

/** A run with the colour of its curves. */
export interface Charted {
  run: OpenedRun;
  colour: string;
  name: string;
}

interface Panel {
  plot: uPlot;
  playhead: HTMLElement;
  value: HTMLElement;
  of: (typeof SHOWN)[number];
}

export class Charts {
  #panels: Panel[] = [];
  #runs: Charted[] = [];
  #times: number[] = [];
  #present = 0;

  constructor(
    readonly place: HTMLElement,
    /** Is told the time under the pointer (s), and when it left. */
    readonly onGlimpse: (time: number | undefined) => void,
  ) {
    new ResizeObserver(() => this.#resize()).observe(place);
  }

  show(runs: Charted[]): void {
    this.#runs = runs.filter(({ run }) => run.curves.length > 0);
    this.place.dataset['runs'] = String(this.#runs.length);
    this.#rebuild();
  }

  /** Takes the colours of the page's theme. */
  recolour(): void {
    this.#rebuild();
  }

  /** Moves the line of the present, and tells the numbers there. */
  mark(time: number): void {
    this.#present = time;
    const first = this.#runs[0]?.run;
    if (first === undefined) {
      return;
    }
    const place = frameAt(first.times, time).frame;
    for (const { plot, playhead, value, of } of this.#panels) {
      const left = plot.valToPos(time, 'x') + plot.bbox.left / devicePixelRatio;
      playhead.style.transform = `translateX(${left.toFixed(1)}px)`;
      const number = curve(first, of.name)?.[place];
      value.textContent =
        number === undefined || Number.isNaN(number)
          ? '–'
          : `${scaled(of.name, number).toFixed(of.digits)} ${of.unit}`;
    }
  }

  #rebuild(): void {
    this.#panels.forEach(({ plot }) => plot.destroy());
    this.#panels = [];
    this.place.replaceChildren();
    const [first] = this.#runs;
    if (first === undefined) {
      this.place.append(h('p', { className: 'hint' }, 'Curves are those of a single body.'));
      return;
    }
    const longest = this.#runs.reduce((a, b) => (b.run.times.length > a.run.times.length ? b : a));
    const stride = Math.max(1, Math.ceil(longest.run.times.length / MOST));
    this.#times = Array.from(longest.run.times).filter((_, frame) => frame % stride === 0);
    for (const of of SHOWN) {
      this.#add(of);
    }
    this.#resize();
  }

  #add(of: (typeof SHOWN)[number]): void {
    const columns = this.#runs.map(({ run }) => this.#column(run, of.name));
    if (columns.every((column) => column.every((number) => number === null))) {
      return;
    }
    const value = h('output', { className: 'value' });
    const playhead = h('div', { className: 'playhead' });
    const holder = h('div', { className: 'plot' }, playhead);
    const about = `${of.title} over time${of.unit === '' ? '' : `, ${of.unit}`}: ${this.#summary(columns, of)}`;
    const figure = h('figure', { className: 'chart' }, h('figcaption', {}, of.title, value), holder);
    holder.setAttribute('role', 'img');
    holder.setAttribute('aria-label', about);
    this.place.append(figure);
    const text = colour('muted');
    const axis = { stroke: text, font: '11px system-ui', grid: { stroke: colour('line'), width: 1 } };
    const plot = new uPlot(
      {
        width: 280,
        height: 96,
        legend: { show: false },
        cursor: { y: false, sync: { key: 'run' }, points: { size: 5 }, drag: { setScale: false } },
        scales: { x: { time: false }, ...(of.ticks ? { y: { range: [0, of.ticks.at(-1) ?? 1] } } : {}) },
        axes: [
          { ...axis, size: 20, gap: 1, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
          { ...axis, size: 42, gap: 3, space: 24, ...(of.ticks ? { splits: of.ticks } : {}) },
        ],
        series: [
          {},
          ...this.#runs.map(({ colour, name }) => ({
            label: name,
            stroke: colour,
            width: 1.5,
            points: { show: false },
          })),
        ],
        hooks: {
          setCursor: [
            (plot) => {
              // Only the one under the pointer; the others follow it.
              if (plot.over.matches(':hover')) {
                const { left } = plot.cursor;
                const over = left !== undefined && left >= 0;
                this.onGlimpse(over ? plot.posToVal(left, 'x') : undefined);
              }
            },
          ],
        },
      },
      [this.#times, ...columns] as uPlot.AlignedData,
      holder,
    );
    plot.over.addEventListener('pointerleave', () => this.onGlimpse(undefined));
    this.#panels.push({ plot, playhead, value, of });
  }

  #column(run: OpenedRun, name: CurveName): (number | null)[] {
    const numbers = curve(run, name);
    const end = run.times[run.times.length - 1] ?? 0;
    return this.#times.map((time) => {
      const number = time > end ? undefined : numbers?.[frameAt(run.times, time).frame];
      return number === undefined || Number.isNaN(number) ? null : scaled(name, number);
    });
  }

  #summary(columns: (number | null)[][], of: (typeof SHOWN)[number]): string {
    const numbers = columns.flat().filter((number) => number !== null);
    const [least, most] = [Math.min(...numbers), Math.max(...numbers)];
    return `from ${least.toFixed(of.digits)} to ${most.toFixed(of.digits)}`;
  }

  #resize(): void {
    const width = this.place.clientWidth;
    if (width > 0) {
      this.#panels.forEach(({ plot }) => plot.setSize({ width, height: 96 }));
      this.mark(this.#present);
    }
  }
}

/** Joules in millijoules, all else as it is. */
function scaled(name: CurveName, number: number): number {
  return name === 'energy' ? 1000 * number : number;
}
