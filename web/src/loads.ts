/** The table of loads by cause at the moment that is shown. */

import { CAUSES } from './arrows';
import { h } from './dom';
import { Vector3 } from 'three';
import type { OpenedRun } from './told';

export class LoadsTable {
  readonly hidden = new Set<string>();
  #rows: { row: HTMLElement; force: HTMLElement; torque: HTMLElement; seen: boolean }[] = [];
  readonly #hint = h('p', { className: 'hint' });

  constructor(
    readonly place: HTMLElement,
    readonly causes: string[],
  ) {
    const head = h('tr', {}, header('Cause'), header('Force, mN'), header('Torque, µN m'));
    const body = h('tbody');
    for (const cause of causes) {
      const box = h('input', { type: 'checkbox', checked: true });
      box.addEventListener('change', () => {
        if (box.checked) {
          this.hidden.delete(cause);
        } else {
          this.hidden.add(cause);
        }
      });
      const dot = h('span', { className: 'dot' });
      dot.style.background = CAUSES[cause]?.colour ?? '';
      const name = h('th', {}, h('label', { className: 'check' }, box, dot, CAUSES[cause]?.words ?? cause));
      name.scope = 'row';
      const [force, torque] = [h('td'), h('td')];
      const row = h('tr', {}, name, force, torque);
      row.hidden = true;
      body.append(row);
      this.#rows.push({ row, force, torque, seen: false });
    }
    place.append(this.#hint, h('table', {}, h('thead', {}, head), body));
  }

  /** A run with these loads: causes that never act are left out. */
  begin({ loads, description }: OpenedRun): void {
    this.#hint.textContent =
      loads.length === 0
        ? 'Loads are those of a single body in one fluid.'
        : `What acts at the moment shown${description.world ? ', without what it touches' : ''}. Those that are ticked have arrows where Forces or Torques are on.`;
    this.#rows.forEach((row, number) => {
      row.seen = false;
      for (let at = 6 * number; at < loads.length && !row.seen; at += 6 * this.causes.length) {
        row.seen = loads.subarray(at, at + 6).some((load) => load !== 0);
      }
      row.row.hidden = !row.seen;
    });
  }

  /** The loads of a frame, six numbers a cause. */
  show(loads: Float32Array): void {
    this.#rows.forEach(({ force, torque, seen }, number) => {
      if (seen) {
        force.textContent = size(loads, 6 * number, 1e3);
        torque.textContent = size(loads, 6 * number + 3, 1e6);
      }
    });
  }
}

function header(words: string): HTMLElement {
  const cell = h('th', {}, words);
  cell.scope = 'col';
  return cell;
}

function size(loads: Float32Array, at: number, unit: number): string {
  const length = unit * new Vector3().fromArray(loads, at).length();
  return length === 0
    ? '–'
    : length.toPrecision(3).replace(/e.*/, '') === length.toPrecision(3)
      ? length.toPrecision(3)
      : length.toExponential(1);
}
